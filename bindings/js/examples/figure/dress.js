// Clothes on the skinned figure of a glTF file: the pattern pieces are one coarse cloth, so that they
// collide with each other, with a fine skin for each. The collider gets the skinned vertices of the
// body in every frame.

import * as THREE from "three";
import { Cloth } from "../muslin/index.js";

const vertex = new THREE.Vector3();

/** Writes the skinned positions of a mesh, in the world, into `positions`. */
function skinVertices(mesh, positions) {
  const count = mesh.geometry.attributes.position.count;
  for (let i = 0; i < count; i++) {
    mesh.getVertexPosition(i, vertex).applyMatrix4(mesh.matrixWorld).toArray(positions, 3 * i);
  }
}

/** Returns position and rotation of a bone in the world. */
function poseOf(bone) {
  const [position, rotation] = [new THREE.Vector3(), new THREE.Quaternion()];
  bone.matrixWorld.decompose(position, rotation, new THREE.Vector3());
  return [position.toArray(), rotation.toArray()];
}

/** Returns a mesh that draws a skin. */
function makeMesh(skin, { uvs, indices }, material) {
  const geometry = new THREE.BufferGeometry();
  const attribute = (values, size) => new THREE.BufferAttribute(Float32Array.from(values), size).setUsage(THREE.DynamicDrawUsage);
  geometry.setAttribute("position", attribute(skin.positions, 3));
  geometry.setAttribute("normal", attribute(skin.normals, 3));
  geometry.setAttribute("uv", attribute(uvs, 2));
  geometry.setIndex(new THREE.BufferAttribute(indices, 1));
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.castShadow = mesh.receiveShadow = true;
  return mesh;
}

/** A figure with its clip and its clothes. */
export class Dressed {
  #mixer;
  #body;
  #positions;
  #collider;
  /** The bones that hold a piece, with their attachments. */
  #held = [];
  #skins = [];

  /** `gltf` is a loaded file; `materials` has one for each pattern piece, by name. */
  constructor(gltf, materials) {
    this.figure = gltf.scene;
    this.#body = this.figure.getObjectByName("body");
    this.#mixer = new THREE.AnimationMixer(this.figure);
    this.#mixer.clipAction(gltf.animations[0]).play();
    this.#mixer.setTime(0);
    this.figure.updateMatrixWorld(true);
    this.#positions = new Float32Array(3 * this.#body.geometry.attributes.position.count);
    skinVertices(this.#body, this.#positions);

    const pieces = Object.keys(materials).map((name) => this.#piece(name));
    const whole = { positions: [], uvs: [], indices: [] };
    for (const piece of pieces) {
      piece.first = whole.positions.length / 3;
      whole.positions.push(...piece.coarse.positions);
      whole.uvs.push(...piece.coarse.uvs);
      for (const vertex of piece.coarse.indices) whole.indices.push(piece.first + vertex);
    }
    const settings = { maxStretch: 0.06, selfCollision: true, selfDistance: 0.005 };
    this.cloth = Cloth.mesh({ ...whole, material: "cotton", settings });
    for (const { first, held, bone } of pieces) {
      const attachment = this.cloth.attach(held.map((vertex) => first + vertex), ...poseOf(bone));
      this.#held.push([bone, attachment]);
    }
    const indices = Uint32Array.from(this.#body.geometry.index.array);
    this.#collider = this.cloth.addCollider({
      shape: "mesh", positions: this.#positions, indices, thickness: 0.006, friction: 0.25,
    });
    this.#skins = pieces.map(({ fine }) => this.cloth.skin(fine));
    this.meshes = pieces.map(({ name, fine }, i) => makeMesh(this.#skins[i], fine, materials[name]));
  }

  /** Returns a pattern piece where its bone carries it. The pieces of the file lie around the rest pose. */
  #piece(name) {
    const piece = this.figure.getObjectByName(name);
    const { bones, boneInverses } = this.#body.skeleton;
    const index = bones.findIndex((bone) => bone.name === piece.userData.bone);
    const toWorld = bones[index].matrixWorld.clone().multiply(boneInverses[index]);
    const [coarse, fine] = [piece, this.figure.getObjectByName(`${name}Skin`)].map(({ geometry }) => ({
      positions: geometry.attributes.position.clone().applyMatrix4(toWorld).array,
      uvs: geometry.attributes.uv.array,
      indices: Uint32Array.from(geometry.index.array),
    }));
    return { name, coarse, fine, held: piece.userData.held, bone: bones[index] };
  }

  advance(seconds) {
    this.#mixer.update(seconds);
    this.figure.updateMatrixWorld(true);
    skinVertices(this.#body, this.#positions);
    this.#collider.update(this.#positions);
    for (const [bone, attachment] of this.#held) attachment.moveTo(...poseOf(bone));
    this.cloth.advance(seconds);
  }

  /** Copies the skins to the geometries. */
  draw() {
    this.meshes.forEach(({ geometry }, i) => {
      const { position, normal } = geometry.attributes;
      position.array.set(this.#skins[i].positions);
      normal.array.set(this.#skins[i].normals);
      position.needsUpdate = normal.needsUpdate = true;
    });
  }

  free() {
    this.#mixer.stopAllAction();
    for (const { geometry } of this.meshes) geometry.dispose();
    this.cloth.free();
  }
}
