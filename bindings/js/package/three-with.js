// Entry point `muslin/three-with`: ClothGeometry and ClothPointers for the three.js that the page
// passes in, release 159 or newer, loaded from any address.

import { Pointers } from "./pointers.js";

/**
 * Copies a part of a view into an attribute and marks it for upload. Grows the pending range to
 * cover the new part, so that an attribute has one range at most.
 */
function upload(attribute, view, first = 0, count = view.length) {
  if (count === 0) return;
  attribute.array.set(view.subarray(first, first + count), first);
  let end = first + count;
  for (const pending of attribute.updateRanges) {
    end = Math.max(end, pending.start + pending.count);
    first = Math.min(first, pending.start);
  }
  attribute.clearUpdateRanges();
  attribute.addUpdateRange(first, end - first);
  attribute.needsUpdate = true;
}

export function withThree(three) {
  const ClothGeometry = makeClothGeometry(three);
  return { ClothGeometry, ClothPointers: makeClothPointers(three) };
}

function makeClothGeometry({ Box3, BufferAttribute, BufferGeometry, DynamicDrawUsage, Sphere }) {
  const box = new Box3();

  /** Makes an attribute with the full capacity, of which parts are uploaded. */
  function makeAttribute(count, Kind, size) {
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
      this.setAttribute("position", makeAttribute(capacity, Float32Array, 3));
      this.setAttribute("normal", makeAttribute(capacity, Float32Array, 3));
      this.setAttribute("uv", makeAttribute(capacity, Float32Array, 2));
      this.setIndex(makeAttribute(cloth.indexCapacity, Uint32Array, 1));
      this.update();
    }

    get cloth() {
      return this.#cloth;
    }

    update() {
      const cloth = this.#cloth;
      const { topologyRevision, stateRevision } = cloth;
      const hasNewTopology = topologyRevision !== this.#topology;
      const hasChanged = hasNewTopology || stateRevision !== this.#state;
      if (hasNewTopology) {
        const { indices } = cloth;
        const changes = cloth.changes(this.#topology);
        upload(this.index, indices, changes.firstIndex, changes.indexCount);
        upload(this.attributes.uv, cloth.uvs, 2 * changes.firstVertex, 2 * changes.vertexCount);
        this.setDrawRange(0, indices.length);
      }
      if (hasChanged) {
        const { positions } = cloth;
        upload(this.attributes.position, positions);
        upload(this.attributes.normal, cloth.normals);
        this.#vertexCount = positions.length / 3;
        this.computeBoundingSphere();
        if (this.boundingBox) this.computeBoundingBox();
      }
      this.#topology = topologyRevision;
      this.#state = stateRevision;
      return hasChanged;
    }

    /** Returns the positions that are in use; the rest of the attribute is spare capacity. */
    #usedPositions() {
      return this.attributes.position.array.subarray(0, 3 * this.#vertexCount);
    }

    computeBoundingBox() {
      this.boundingBox ??= new Box3();
      this.boundingBox.setFromArray(this.#usedPositions());
    }

    computeBoundingSphere() {
      this.boundingSphere ??= new Sphere();
      const used = this.#usedPositions();
      const { center } = this.boundingSphere;
      box.setFromArray(used).getCenter(center);
      let farthest = 0;
      for (let at = 0; at < used.length; at += 3) {
        const [x, y, z] = [used[at] - center.x, used[at + 1] - center.y, used[at + 2] - center.z];
        farthest = Math.max(farthest, x * x + y * y + z * z);
      }
      this.boundingSphere.radius = Math.sqrt(farthest);
    }

    /** Returns a copy of the current state that follows no cloth. */
    clone() {
      return new BufferGeometry().copy(this);
    }
  };
}

function makeClothPointers({ Matrix4, Raycaster, Vector2, Vector3 }) {
  const [caster, ndc, facing, toCloth] = [new Raycaster(), new Vector2(), new Vector3(), new Matrix4()];

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
      // In the capturing phase: camera controls listen in a later phase, so a press that grabs the
      // cloth can be kept from them.
      const on = (type, listener) => element.addEventListener(type, listener, { capture: true, signal });
      on("pointerdown", (event) => this.#press(event));
      on("pointermove", (event) => this.#drag(event));
      for (const type of ["pointerup", "pointercancel", "lostpointercapture"]) {
        on(type, (event) => this.#pointers.lift(event.pointerId));
      }
    }

    /** Returns the number of pointers that hold the cloth. */
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

    /**
     * Returns the ray under a pointer in the space of the cloth, which is the local space of its
     * mesh.
     */
    #ray({ clientX, clientY }) {
      const { left, top, width, height } = this.#element.getBoundingClientRect();
      ndc.set((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
      caster.setFromCamera(ndc, this.#camera);
      this.#mesh.updateWorldMatrix(true, false);
      toCloth.copy(this.#mesh.matrixWorld).invert();
      const { origin, direction } = caster.ray.applyMatrix4(toCloth);
      return [origin.toArray(), direction.toArray()];
    }
  };
}
