// Writes the figure as a binary glTF 2.0 file: skeleton, skinned meshes, clip, and pattern pieces.

import { makeBody, makeLimbs } from "./body.mjs";
import { DETAIL, makeShirt, makeSkirt } from "./garments.mjs";
import { BONES, boneIndex, DURATION, poseAt, STEP } from "./skeleton.mjs";

const [FLOAT, UINT16, UINT32] = [5126, 5123, 5125];
const [ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER] = [34962, 34963];

/** Returns the unit normals of a mesh; vertices at the same position share theirs. */
function normalsOf({ positions, indices }) {
  const sums = new Map();
  const keyOf = (i) => positions.slice(3 * i, 3 * i + 3).map((x) => x.toFixed(5)).join();
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => positions.slice(3 * indices[t + k], 3 * indices[t + k] + 3));
    const [u, v] = [b, c].map((p) => p.map((x, k) => x - a[k]));
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (const i of indices.slice(t, t + 3)) {
      const sum = sums.get(keyOf(i)) ?? [0, 0, 0];
      sums.set(keyOf(i), sum.map((x, k) => x + normal[k]));
    }
  }
  return Array.from({ length: positions.length / 3 }, (_, i) => {
    const sum = sums.get(keyOf(i));
    return sum.map((x) => x / Math.hypot(...sum));
  }).flat();
}

class Writer {
  json = { asset: { version: "2.0", generator: "write-figure.mjs" }, accessors: [], bufferViews: [], meshes: [], nodes: [] };
  #chunks = [];
  #length = 0;

  /** Appends an accessor and returns its index. */
  accessor(values, Kind, componentType, type, extra = {}, target) {
    const data = new Uint8Array(Kind.from(values).buffer);
    const size = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 }[type];
    this.json.bufferViews.push({ buffer: 0, byteOffset: this.#length, byteLength: data.length, ...(target && { target }) });
    this.#push(data);
    this.json.accessors.push({ bufferView: this.json.bufferViews.length - 1, componentType, count: values.length / size, type, ...extra });
    return this.json.accessors.length - 1;
  }

  #push(data) {
    const padded = new Uint8Array(Math.ceil(data.length / 4) * 4);
    padded.set(data);
    this.#chunks.push(padded);
    this.#length += padded.length;
  }

  floats(values, type, extra, target) {
    return this.accessor(values, Float32Array, FLOAT, type, extra, target);
  }

  /** Appends a mesh and a node for it. */
  mesh(name, { positions, indices, uvs, joints, weights }, node = {}, extras) {
    const axis = (k) => positions.filter((_, i) => i % 3 === k);
    const [min, max] = [Math.min, Math.max].map((of) => [0, 1, 2].map((k) => Math.fround(of(...axis(k)))));
    const attributes = { POSITION: this.floats(positions, "VEC3", { min, max }, ARRAY_BUFFER) };
    attributes.NORMAL = this.floats(normalsOf({ positions, indices }), "VEC3", {}, ARRAY_BUFFER);
    if (uvs) attributes.TEXCOORD_0 = this.floats(uvs, "VEC2", {}, ARRAY_BUFFER);
    if (joints) {
      attributes.JOINTS_0 = this.accessor(joints, Uint16Array, UINT16, "VEC4", {}, ARRAY_BUFFER);
      attributes.WEIGHTS_0 = this.floats(weights, "VEC4", {}, ARRAY_BUFFER);
    }
    const primitive = { attributes, indices: this.accessor(indices, Uint32Array, UINT32, "SCALAR", {}, ELEMENT_ARRAY_BUFFER) };
    this.json.meshes.push({ name, primitives: [primitive] });
    this.json.nodes.push({ name, mesh: this.json.meshes.length - 1, ...node, ...(extras && { extras }) });
  }

  /** Returns the file. */
  bytes() {
    this.json.buffers = [{ byteLength: this.#length }];
    const text = new TextEncoder().encode(JSON.stringify(this.json));
    const json = new Uint8Array(Math.ceil(text.length / 4) * 4).fill(0x20);
    json.set(text);
    const file = new Uint8Array(12 + 8 + json.length + 8 + this.#length);
    const view = new DataView(file.buffer);
    const header = [0x46546c67, 2, file.length, json.length, 0x4e4f534a];
    header.forEach((word, i) => view.setUint32(4 * i, word, true));
    file.set(json, 20);
    view.setUint32(20 + json.length, this.#length, true);
    view.setUint32(24 + json.length, 0x004e4942, true);
    let at = 28 + json.length;
    for (const chunk of this.#chunks) {
      file.set(chunk, at);
      at += chunk.length;
    }
    return file;
  }
}

/** Appends the bones as nodes 0, 1, … and the skin. */
function writeSkeleton(writer) {
  for (const [name, parent, joint] of BONES) {
    const origin = parent ? BONES[boneIndex(parent)][2] : [0, 0, 0];
    const children = BONES.flatMap(([, of], i) => (of === name ? [i] : []));
    writer.json.nodes.push({ name, translation: joint.map((x, k) => x - origin[k]), ...(children.length && { children }) });
  }
  const inverses = BONES.flatMap(([, , [x, y, z]]) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1]);
  const inverseBindMatrices = writer.floats(inverses, "MAT4");
  writer.json.skins = [{ joints: BONES.map((_, i) => i), inverseBindMatrices, skeleton: 0 }];
}

function writeClip(writer) {
  const count = Math.round(DURATION / STEP) + 1;
  const times = Array.from({ length: count }, (_, i) => i * STEP);
  const poses = times.map(poseAt);
  const input = writer.floats(times, "SCALAR", { min: [0], max: [Math.fround(times[count - 1])] });
  const [channels, samplers] = [[], []];
  const add = (node, path, values, type) => {
    channels.push({ sampler: samplers.length, target: { node, path } });
    samplers.push({ input, output: writer.floats(values, type), interpolation: "LINEAR" });
  };
  BONES.forEach(([name], node) => add(node, "rotation", poses.flatMap(({ pose }) => pose[name]), "VEC4"));
  add(0, "translation", poses.flatMap(({ height }) => [0, height, 0]), "VEC3");
  writer.json.animations = [{ name: "walk and kick", channels, samplers }];
}

/** Returns the bytes of the file. */
export function makeFigure() {
  const writer = new Writer();
  writeSkeleton(writer);
  writer.mesh("body", makeBody(), { skin: 0 });
  writer.mesh("limbs", makeLimbs(), { skin: 0 });
  for (const [name, make] of [["skirt", makeSkirt], ["shirt", makeShirt]]) {
    const { held, ...piece } = make(1);
    // The vertices that a bone holds.
    writer.mesh(name, piece, {}, { held, bone: name === "skirt" ? "hips" : "chest" });
    writer.mesh(`${name}Skin`, make(DETAIL));
  }
  writeClip(writer);
  const nodes = writer.json.nodes.map((_, i) => i);
  const roots = nodes.filter((i) => i === 0 || i >= BONES.length);
  Object.assign(writer.json, { scene: 0, scenes: [{ name: "figure", nodes: roots }] });
  return writer.bytes();
}
