// Clothes on the skinned figure of a glTF file: one coarse cloth for each pattern piece, with a fine
// skin, around a collider that gets the skinned vertices of the body in every frame.

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

/** A garment: its cloth, and the mesh that draws its skin. */
class Garment {
  #collider;
  #attachment;
  #bone;
  #skin;

  constructor(figure, name, material, bodyPositions, bodyIndices) {
    const piece = figure.getObjectByName(name);
    const { held, bone } = piece.userData;
    this.#bone = figure.getObjectByName(bone);
    // The pieces lie around the rest pose: the bone carries them to the present one.
    const toWorld = this.#bone.matrixWorld.clone().multiply(figure.restInverses.get(bone));
    const [coarse, fine] = [piece, figure.getObjectByName(`${name}Skin`)].map(({ geometry }) => ({
      positions: geometry.attributes.position.clone().applyMatrix4(toWorld).array,
      uvs: geometry.attributes.uv.array,
      indices: Uint32Array.from(geometry.index.array),
    }));
    this.cloth = Cloth.mesh({ ...coarse, material: "cotton", settings: { maxStretch: 0.06 } });
    this.#attachment = this.cloth.attach(held, ...poseOf(this.#bone));
    this.#collider = this.cloth.addCollider({
      shape: "mesh", positions: bodyPositions, indices: bodyIndices, thickness: 0.006, friction: 0.25,
    });
    this.#skin = this.cloth.skin(fine);
    const geometry = new THREE.BufferGeometry();
    const attribute = (values, size) => new THREE.BufferAttribute(Float32Array.from(values), size).setUsage(THREE.DynamicDrawUsage);
    geometry.setAttribute("position", attribute(this.#skin.positions, 3));
    geometry.setAttribute("normal", attribute(this.#skin.normals, 3));
    geometry.setAttribute("uv", attribute(fine.uvs, 2));
    geometry.setIndex(new THREE.BufferAttribute(fine.indices, 1));
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = this.mesh.receiveShadow = true;
  }

  advance(seconds, bodyPositions) {
    this.#collider.update(bodyPositions);
    this.#attachment.moveTo(...poseOf(this.#bone));
    this.cloth.advance(seconds);
  }

  /** Copies the skin to the geometry. */
  draw() {
    const { position, normal } = this.mesh.geometry.attributes;
    position.array.set(this.#skin.positions);
    normal.array.set(this.#skin.normals);
    position.needsUpdate = normal.needsUpdate = true;
  }

  free() {
    this.mesh.geometry.dispose();
    this.cloth.free();
  }
}

/** A figure with its clip and its clothes. */
export class Dressed {
  #mixer;
  #body;
  #positions;

  /** `gltf` is a loaded file; `materials` has one for each piece, by name. */
  constructor(gltf, materials) {
    const figure = gltf.scene;
    this.#body = figure.getObjectByName("body");
    const { bones, boneInverses } = this.#body.skeleton;
    figure.restInverses = new Map(bones.map((bone, i) => [bone.name, boneInverses[i]]));
    this.#mixer = new THREE.AnimationMixer(figure);
    this.#mixer.clipAction(gltf.animations[0]).play();
    this.#mixer.setTime(0);
    figure.updateMatrixWorld(true);
    this.#positions = new Float32Array(3 * this.#body.geometry.attributes.position.count);
    skinVertices(this.#body, this.#positions);
    const indices = Uint32Array.from(this.#body.geometry.index.array);
    this.garments = Object.entries(materials).map(
      ([name, material]) => new Garment(figure, name, material, this.#positions, indices),
    );
    this.figure = figure;
  }

  advance(seconds) {
    this.#mixer.update(seconds);
    this.figure.updateMatrixWorld(true);
    skinVertices(this.#body, this.#positions);
    for (const garment of this.garments) garment.advance(seconds, this.#positions);
  }

  draw() {
    for (const garment of this.garments) garment.draw();
  }

  get particles() {
    return this.garments.reduce((sum, { cloth }) => sum + cloth.stats.particles, 0);
  }

  free() {
    this.#mixer.stopAllAction();
    for (const garment of this.garments) garment.free();
  }
}
