// A BufferGeometry that follows a cloth.

import { Box3, BufferAttribute, BufferGeometry, DynamicDrawUsage, Sphere } from "three";

/** Room for the most that a list may become, given to the graphics card in parts. */
function roomFor(count, Kind, size) {
  const attribute = new BufferAttribute(new Kind(size * count), size);
  attribute.setUsage(DynamicDrawUsage);
  return attribute;
}

/** Puts a part of a view into a buffer; only that is uploaded, with what still waits to be. */
function upload(attribute, view, first = 0, count = view.length) {
  attribute.array.set(view.subarray(first, first + count), first);
  let end = first + count;
  for (const waiting of attribute.updateRanges) {
    end = Math.max(end, waiting.start + waiting.count);
    first = Math.min(first, waiting.start);
  }
  attribute.clearUpdateRanges();
  attribute.addUpdateRange(first, end - first);
  attribute.needsUpdate = true;
}

export class ClothGeometry extends BufferGeometry {
  #cloth;
  #vertexCount = 0;
  #topology = 0;
  #state;

  constructor(cloth) {
    super();
    this.#cloth = cloth;
    const capacity = cloth.vertexCapacity;
    this.setAttribute("position", roomFor(capacity, Float32Array, 3));
    this.setAttribute("normal", roomFor(capacity, Float32Array, 3));
    this.setAttribute("uv", roomFor(capacity, Float32Array, 2));
    this.setIndex(roomFor(cloth.indexCapacity, Uint32Array, 1));
    this.update();
  }

  get cloth() {
    return this.#cloth;
  }

  update() {
    const cloth = this.#cloth;
    const { topologyRevision, stateRevision } = cloth;
    const isRetied = topologyRevision !== this.#topology;
    const isMoved = isRetied || stateRevision !== this.#state;
    if (isRetied) {
      const { indices } = cloth;
      const changes = cloth.changes(this.#topology);
      upload(this.index, indices, changes.firstIndex, changes.indexCount);
      upload(this.attributes.uv, cloth.uvs, 2 * changes.firstVertex, 2 * changes.vertexCount);
      this.setDrawRange(0, indices.length);
    }
    if (isMoved) {
      const { positions } = cloth;
      upload(this.attributes.position, positions);
      upload(this.attributes.normal, cloth.normals);
      this.#vertexCount = positions.length / 3;
      this.computeBoundingSphere();
      if (this.boundingBox) this.computeBoundingBox();
    }
    this.#topology = topologyRevision;
    this.#state = stateRevision;
    return isMoved;
  }

  /** The positions that are in use: behind them is room, which is nowhere. */
  #used() {
    return this.attributes.position.array.subarray(0, 3 * this.#vertexCount);
  }

  computeBoundingBox() {
    this.boundingBox ??= new Box3();
    this.boundingBox.setFromArray(this.#used());
  }

  computeBoundingSphere() {
    this.boundingSphere ??= new Sphere();
    const used = this.#used();
    const { center } = this.boundingSphere;
    box.setFromArray(used).getCenter(center);
    let farthest = 0;
    for (let at = 0; at < used.length; at += 3) {
      const [x, y, z] = [used[at] - center.x, used[at + 1] - center.y, used[at + 2] - center.z];
      farthest = Math.max(farthest, x * x + y * y + z * z);
    }
    this.boundingSphere.radius = Math.sqrt(farthest);
  }

  /** A still copy, which follows nothing. */
  clone() {
    return new BufferGeometry().copy(this);
  }
}

const box = new Box3();
