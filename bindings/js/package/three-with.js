// What three.js draws of a cloth, made with the three.js that a page has: any release from r159 on, under any address.

import { Pointers } from "./pointers.js";

/** Puts a part of a view into a buffer; only that is uploaded, with what still waits to be. */
function upload(attribute, view, first = 0, count = view.length) {
  if (count === 0) return;
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

export function withThree(three) {
  const ClothGeometry = geometryOf(three);
  return { ClothGeometry, ClothPointers: pointersOf(three) };
}

function geometryOf({ Box3, BufferAttribute, BufferGeometry, DynamicDrawUsage, Sphere }) {
  const box = new Box3();

  /** Room for the most that a list may become, given to the graphics card in parts. */
  function roomFor(count, Kind, size) {
    const attribute = new BufferAttribute(new Kind(size * count), size);
    attribute.setUsage(DynamicDrawUsage);
    return attribute;
  }

  return class ClothGeometry extends BufferGeometry {
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
  };
}

function pointersOf({ Matrix4, Raycaster, Vector2, Vector3 }) {
  const [caster, place, facing, toCloth] = [new Raycaster(), new Vector2(), new Vector3(), new Matrix4()];

  return class ClothPointers {
    #pointers;
    #mesh;
    #camera;
    #element;
    #listening = new AbortController();
    enabled = true;

    constructor(mesh, camera, element, options) {
      this.#pointers = new Pointers(mesh.geometry.cloth, options);
      [this.#mesh, this.#camera, this.#element] = [mesh, camera, element];
      element.style.touchAction = "none"; // or the browser takes the gesture for its own
      const { signal } = this.#listening;
      // In the capturing phase: what turns the camera listens later, and learns of no press that is ours.
      const on = (type, listener) => element.addEventListener(type, listener, { capture: true, signal });
      on("pointerdown", (event) => this.#press(event));
      on("pointermove", (event) => this.#drag(event));
      for (const type of ["pointerup", "pointercancel", "lostpointercapture"]) {
        on(type, (event) => this.#pointers.lift(event.pointerId));
      }
    }

    /** How many pointers hold the cloth. */
    get size() {
      return this.#pointers.size;
    }

    meets(event) {
      return this.#pointers.cloth.raycast(...this.#ray(event)) !== undefined;
    }

    liftAll() {
      this.#pointers.liftAll();
    }

    dispose() {
      this.#listening.abort();
      if (!this.#pointers.cloth.isFreed) this.liftAll();
    }

    #press(event) {
      if (!this.enabled || event.button !== 0) return;
      const ray = this.#ray(event);
      this.#camera.getWorldDirection(facing).transformDirection(toCloth);
      if (!this.#pointers.press(event.pointerId, ...ray, facing.toArray())) return;
      this.#element.setPointerCapture(event.pointerId);
      event.stopImmediatePropagation();
    }

    #drag(event) {
      if (!this.#pointers.holds(event.pointerId)) return;
      this.#pointers.drag(event.pointerId, ...this.#ray(event));
      event.stopImmediatePropagation();
    }

    /** The ray under a pointer, as the cloth has it: it knows nothing of where its mesh was put. */
    #ray({ clientX, clientY }) {
      const { left, top, width, height } = this.#element.getBoundingClientRect();
      place.set((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
      caster.setFromCamera(place, this.#camera);
      this.#mesh.updateWorldMatrix(true, false);
      toCloth.copy(this.#mesh.matrixWorld).invert();
      const { origin, direction } = caster.ray.applyMatrix4(toCloth);
      return [origin.toArray(), direction.toArray()];
    }
  };
}
