// Entry point `muslin/three-with`: ClothGeometry and ClothPointers for the three.js that the page
// passes in, release 159 or newer, loaded from any address.

import { Pointers } from "./pointers.js";
import { setState, stateOf } from "./state.js";

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

  /** Returns the positions that are in use; the rest of the attribute is spare capacity. */
  function usedPositions(geometry) {
    const { vertexCount } = stateOf(geometry, "ClothGeometry");
    return geometry.attributes.position.array.subarray(0, 3 * vertexCount);
  }

  return class ClothGeometry extends BufferGeometry {
    constructor(cloth) {
      super();
      setState(this, { cloth, vertexCount: 0, topology: 0, revision: undefined });
      const capacity = cloth.vertexCapacity;
      this.setAttribute("position", makeAttribute(capacity, Float32Array, 3));
      this.setAttribute("normal", makeAttribute(capacity, Float32Array, 3));
      this.setAttribute("uv", makeAttribute(capacity, Float32Array, 2));
      this.setIndex(makeAttribute(cloth.indexCapacity, Uint32Array, 1));
      this.update();
    }

    get cloth() {
      return stateOf(this, "ClothGeometry").cloth;
    }

    update() {
      const state = stateOf(this, "ClothGeometry");
      const { cloth } = state;
      const { topologyRevision, stateRevision } = cloth;
      const hasNewTopology = topologyRevision !== state.topology;
      const hasChanged = hasNewTopology || stateRevision !== state.revision;
      if (hasNewTopology) {
        const { indices } = cloth;
        const changes = cloth.changes(state.topology);
        upload(this.index, indices, changes.firstIndex, changes.indexCount);
        upload(this.attributes.uv, cloth.uvs, 2 * changes.firstVertex, 2 * changes.vertexCount);
        this.setDrawRange(0, indices.length);
      }
      if (hasChanged) {
        const { positions } = cloth;
        upload(this.attributes.position, positions);
        upload(this.attributes.normal, cloth.normals);
        state.vertexCount = positions.length / 3;
        this.computeBoundingSphere();
        if (this.boundingBox) this.computeBoundingBox();
      }
      state.topology = topologyRevision;
      state.revision = stateRevision;
      return hasChanged;
    }

    computeBoundingBox() {
      this.boundingBox ??= new Box3();
      this.boundingBox.setFromArray(usedPositions(this));
    }

    computeBoundingSphere() {
      this.boundingSphere ??= new Sphere();
      const used = usedPositions(this);
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

  /**
   * Returns the ray under a pointer in the space of the cloth, which is the local space of its
   * mesh.
   */
  function rayOf({ mesh, camera, element }, { clientX, clientY }) {
    const { left, top, width, height } = element.getBoundingClientRect();
    ndc.set((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
    caster.setFromCamera(ndc, camera);
    mesh.updateWorldMatrix(true, false);
    toCloth.copy(mesh.matrixWorld).invert();
    const { origin, direction } = caster.ray.applyMatrix4(toCloth);
    return [origin.toArray(), direction.toArray()];
  }

  function press(parts, event) {
    const { pointers, camera, element } = parts;
    const ray = rayOf(parts, event);
    camera.getWorldDirection(facing).transformDirection(toCloth);
    if (!pointers.press(event.pointerId, ...ray, facing.toArray())) return;
    element.setPointerCapture(event.pointerId);
    event.stopImmediatePropagation();
  }

  function drag(parts, event) {
    const { pointers } = parts;
    if (pointers.holds(event.pointerId)) pointers.drag(event.pointerId, ...rayOf(parts, event));
  }

  return class ClothPointers {
    enabled = true;

    constructor(mesh, camera, element, options) {
      const pointers = new Pointers(mesh.geometry.cloth, options);
      const listening = new AbortController();
      const parts = { pointers, mesh, camera, element, listening };
      setState(this, parts);
      element.style.touchAction = "none"; // or the browser takes the gesture for its own
      const { signal } = listening;
      // In the capturing phase: camera controls listen in a later phase, so a press that grabs the
      // cloth can be kept from them.
      const on = (type, listener) => element.addEventListener(type, listener, { capture: true, signal });
      on("pointerdown", (event) => this.enabled && event.button === 0 && press(parts, event));
      on("pointermove", (event) => drag(parts, event));
      for (const type of ["pointerup", "pointercancel", "lostpointercapture"]) {
        on(type, (event) => pointers.lift(event.pointerId));
      }
    }

    /** Returns the number of pointers that hold the cloth. */
    get size() {
      return stateOf(this, "ClothPointers").pointers.size;
    }

    meets(event) {
      const parts = stateOf(this, "ClothPointers");
      return parts.pointers.cloth.raycast(...rayOf(parts, event)) !== undefined;
    }

    liftAll() {
      stateOf(this, "ClothPointers").pointers.liftAll();
    }

    dispose() {
      const { pointers, listening } = stateOf(this, "ClothPointers");
      listening.abort();
      if (!pointers.cloth.isFreed) pointers.liftAll();
    }
  };
}
