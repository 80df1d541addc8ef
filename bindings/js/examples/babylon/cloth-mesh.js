// A Babylon.js mesh that follows a cloth, and pointers that pull the cloth. Copy this file into
// your project.

import { Pointers } from "../muslin/pointers.js";

/**
 * Makes a mesh that draws a cloth. Call the returned `update` each frame, after `cloth.advance()`.
 */
export function makeClothMesh(BABYLON, cloth, scene) {
  const { VertexBuffer } = BABYLON;
  const mesh = new BABYLON.Mesh("cloth", scene);
  // Buffers are allocated once, with the capacity for everything that tears may add; unused indices
  // are 0.
  const allocate = (size) => new Float32Array(size * cloth.vertexCapacity);
  const [positions, normals, uvs] = [allocate(3), allocate(3), allocate(2)];
  const indices = new Uint32Array(cloth.indexCapacity);
  let [topology, state] = [0, -1];

  /** Copies the cloth into the buffers, and returns whether its topology changed. */
  function copy() {
    positions.set(cloth.positions);
    normals.set(cloth.normals);
    state = cloth.stateRevision;
    if (topology === cloth.topologyRevision) return false;
    uvs.set(cloth.uvs);
    indices.set(cloth.indices);
    indices.fill(0, cloth.indices.length);
    topology = cloth.topologyRevision;
    return true;
  }

  copy();
  mesh.setVerticesData(VertexBuffer.PositionKind, positions, true);
  mesh.setVerticesData(VertexBuffer.NormalKind, normals, true);
  mesh.setVerticesData(VertexBuffer.UVKind, uvs, true);
  mesh.setIndices(indices, cloth.vertexCapacity, true);
  mesh.alwaysSelectAsActiveMesh = true; // no culling: its bounds change every frame
  mesh.isPickable = false; // Pointers casts rays at the cloth itself, which is faster
  mesh.subMeshes[0].indexCount = cloth.indices.length;

  const update = () => {
    if (state === cloth.stateRevision && topology === cloth.topologyRevision) return;
    const isTorn = copy();
    mesh.updateVerticesData(VertexBuffer.PositionKind, positions);
    mesh.updateVerticesData(VertexBuffer.NormalKind, normals);
    if (!isTorn) return;
    mesh.updateVerticesData(VertexBuffer.UVKind, uvs);
    mesh.updateIndices(indices);
    mesh.subMeshes[0].indexCount = cloth.indices.length;
  };
  return { mesh, update };
}

/**
 * Lets mice and fingers pull the cloth of a mesh. While a pointer holds the cloth, the camera does
 * not turn.
 */
export function pullClothMesh(BABYLON, cloth, mesh, scene) {
  const pointers = new Pointers(cloth, { radius: 0.04 });
  const { POINTERDOWN, POINTERMOVE, POINTERUP } = BABYLON.PointerEventTypes;

  /**
   * Returns the ray under the pointer in the local space of the mesh, which is that of the cloth.
   */
  function ray() {
    const toCloth = mesh.computeWorldMatrix(true);
    const { origin, direction } = scene.createPickingRay(scene.pointerX, scene.pointerY, toCloth, scene.activeCamera);
    return [origin.asArray(), direction.asArray()];
  }

  scene.onPrePointerObservable.add((info) => {
    const id = info.event.pointerId;
    if (info.type === POINTERDOWN && info.event.button === 0) {
      const toCloth = BABYLON.Matrix.Invert(mesh.computeWorldMatrix(true));
      const ahead = scene.activeCamera.getForwardRay().direction;
      const facing = BABYLON.Vector3.TransformNormal(ahead, toCloth).asArray();
      if (!pointers.press(id, ...ray(), facing)) return;
      scene.activeCamera.detachControl();
      info.skipOnPointerObservable = true;
    } else if (info.type === POINTERMOVE) {
      pointers.drag(id, ...ray());
    } else if (info.type === POINTERUP && pointers.lift(id)) {
      scene.activeCamera.attachControl(true);
    }
  });
  return pointers;
}
