// Descriptors: their fields in the order of src/numbers.rs, and the way between objects and lists.

import { choice, flag, keys, number, vector, whole } from "./check.js";

const NUMBER = { size: 1, read: (list, at) => list[at], write: number };
const WHOLE = { size: 1, read: (list, at) => list[at], write: whole };
const FLAG = { size: 1, read: (list, at) => list[at] !== 0, write: flag };
const VECTOR = { size: 3, read: (list, at) => sliceOf(list, at, 3), write: (v, name) => vector(v, name) };
const ROTATION = {
  size: 4,
  read: (list, at) => sliceOf(list, at, 4),
  write: (value, name) => vector(value, name, "x, y, z, w"),
};
const TRANSFORM = {
  size: 12,
  read: (list, at) => sliceOf(list, at, 12),
  write: (value, name) => vector(value, name, "xx, xy, xz, x, yx, yy, yz, y, zx, zy, zz, z"),
};
const CHOICE = (...names) => ({
  size: 1,
  read: (list, at) => names[list[at]],
  write: (value, name) => choice(value, name, names),
});

export const PRESETS = ["silk", "cotton", "denim", "leather", "paper", "flag-nylon"];

export const SETTINGS = {
  tick: NUMBER,
  substeps: WHOLE,
  iterations: WHOLE,
  maxTicksPerAdvance: WHOLE,
  gravity: VECTOR,
  damping: NUMBER,
  maxDisplacement: NUMBER,
  maxStretch: NUMBER,
  tethers: FLAG,
  selfCollision: CHOICE(false, true, "particles"),
  selfDistance: NUMBER,
  tearing: FLAG,
  maxTearsPerTick: WHOLE,
  sleepSpeed: NUMBER,
};

export const MATERIAL = {
  density: NUMBER,
  thickness: NUMBER,
  stretchStiffnessWarp: NUMBER,
  stretchStiffnessWeft: NUMBER,
  shearStiffness: NUMBER,
  bendStiffness: NUMBER,
  bendDamping: NUMBER,
  stretchDamping: NUMBER,
  friction: NUMBER,
  restitution: NUMBER,
  drag: NUMBER,
  lift: NUMBER,
  tearStretch: NUMBER,
  tearVariation: NUMBER,
  yieldAngle: NUMBER,
  yieldCreep: NUMBER,
  foldLength: NUMBER,
  yieldHardening: NUMBER,
  yieldWeakening: NUMBER,
};

export const WIND = {
  model: CHOICE("surface", "sine-field"),
  velocity: VECTOR,
  gust: NUMBER,
  wander: NUMBER,
  turbulence: NUMBER,
  airDensity: NUMBER,
  seed: WHOLE,
};

export const GRID = {
  columns: WHOLE,
  rows: WHOLE,
  spacing: NUMBER,
  origin: VECTOR,
  right: VECTOR,
  down: VECTOR,
  pinMode: CHOICE("none", "top-edge", "top-corners", "corners"),
  extraParticles: WHOLE,
};

export const MESH = { weldDistance: NUMBER, extraParticles: WHOLE };

export const COLLIDER = {
  shape: CHOICE("plane", "sphere", "capsule", "box", "convex", "mesh", "heightfield"),
  position: VECTOR,
  rotation: ROTATION,
  friction: NUMBER,
  restitution: NUMBER,
  tangentialRestitution: NUMBER,
  thickness: NUMBER,
  radius: NUMBER,
  topRadius: NUMBER,
  halfHeight: NUMBER,
  halfExtents: VECTOR,
  spacing: NUMBER,
  columns: WHOLE,
  rows: WHOLE,
};

export const WRITE = {
  firstVertex: WHOLE,
  vertexCount: WHOLE,
  blend: NUMBER,
  transform: TRANSFORM,
  flipNormals: FLAG,
  offset: NUMBER,
};

/** A list as an object that cannot be changed by mistake. */
export function unpack(fields, list) {
  let at = 0;
  const entries = Object.entries(fields).map(([key, { size, read }]) => {
    const value = read(list, at);
    at += size;
    return [key, value];
  });
  return Object.freeze(Object.fromEntries(entries));
}

/** A list with what an object says written over it. Nothing is written unless all of it can be. */
export function pack(fields, list, object, prefix) {
  const written = Float64Array.from(list);
  let at = 0;
  for (const [key, { size, write }] of Object.entries(fields)) {
    const value = object[key];
    if (value !== undefined) {
      const packed = write(value, prefix ? `${prefix}.${key}` : key);
      written.set(Array.isArray(packed) ? packed : [packed], at);
    }
    at += size;
  }
  return written;
}

/** The same for an object of which every key must be a field. */
export function merge(fields, list, object, name) {
  return pack(fields, list, keys(object, name, Object.keys(fields)), name);
}

/** A material: the name of a preset, or an object, which may name one to start from. */
export function mergeMaterial(list, material, presetList) {
  const preset = (value, name) => presetList(choice(value, name, PRESETS));
  if (typeof material === "string") return preset(material, "material");
  keys(material, "material", ["preset", ...Object.keys(MATERIAL)]);
  const start = material.preset === undefined ? list : preset(material.preset, "material.preset");
  return pack(MATERIAL, start, material, "material");
}

function sliceOf(list, at, size) {
  return Object.freeze(Array.from(list.subarray(at, at + size)));
}
