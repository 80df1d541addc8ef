// Tables of the descriptors' fields, and conversion between objects and the flat lists that the
// module takes. The order of the fields is that of src/packing.rs; each has a size in the list, a
// reader, and a writer that checks its value.

import { checkKeys, toBoolean, toChoiceIndex, toNumber, toUint32, toVector } from "./check.js";

const NUMBER = { size: 1, read: (list, start) => list[start], write: toNumber };
const UINT32 = { size: 1, read: (list, start) => list[start], write: toUint32 };
const BOOLEAN = { size: 1, read: (list, start) => list[start] !== 0, write: toBoolean };
const VECTOR = { size: 3, read: (list, start) => frozenSlice(list, start, 3), write: (v, name) => toVector(v, name) };
const ROTATION = {
  size: 4,
  read: (list, start) => frozenSlice(list, start, 4),
  write: (value, name) => toVector(value, name, "x, y, z, w"),
};
const TRANSFORM = {
  size: 12,
  read: (list, start) => frozenSlice(list, start, 12),
  write: (value, name) => toVector(value, name, "xx, xy, xz, x, yx, yy, yz, y, zx, zy, zz, z"),
};
const CHOICE = (...names) => ({
  size: 1,
  read: (list, start) => names[list[start]],
  write: (value, name) => toChoiceIndex(value, name, names),
});

export const PRESETS = ["silk", "cotton", "denim", "leather", "paper", "flag-nylon"];

/** The painted maps, in the order of their numbers. */
export const MAPS = ["stretch", "bend", "tear", "friction", "thickness", "drag"];

export const SETTINGS = {
  tick: NUMBER,
  substeps: UINT32,
  iterations: UINT32,
  maxTicksPerAdvance: UINT32,
  gravity: VECTOR,
  damping: NUMBER,
  maxDisplacement: NUMBER,
  maxStretch: NUMBER,
  tethers: BOOLEAN,
  selfCollision: CHOICE(false, true, "particles"),
  selfDistance: NUMBER,
  tearing: BOOLEAN,
  maxTearsPerTick: UINT32,
  sleepSpeed: NUMBER,
  pressure: NUMBER,
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
  seed: UINT32,
};

export const GRID = {
  columns: UINT32,
  rows: UINT32,
  spacing: NUMBER,
  origin: VECTOR,
  right: VECTOR,
  down: VECTOR,
  pinMode: CHOICE("none", "top-edge", "top-corners", "corners"),
  extraParticles: UINT32,
};

export const MESH = { weldDistance: NUMBER, extraParticles: UINT32, simplifyBelow: NUMBER };

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
  columns: UINT32,
  rows: UINT32,
  solid: NUMBER,
};

export const WRITE = {
  firstVertex: UINT32,
  vertexCount: UINT32,
  blend: NUMBER,
  transform: TRANSFORM,
  flipNormals: BOOLEAN,
  offset: NUMBER,
  relative: BOOLEAN,
};

/** Converts a flat list to a frozen object. */
export function unpack(fields, list) {
  let start = 0;
  const entries = Object.entries(fields).map(([key, { size, read }]) => {
    const value = read(list, start);
    start += size;
    return [key, value];
  });
  return Object.freeze(Object.fromEntries(entries));
}

/**
 * Returns a copy of a flat list with the fields of an object written over it. Throws if a value is
 * wrong; `prefix` names the object in the message.
 */
export function pack(fields, list, object, prefix) {
  const packed = Float64Array.from(list);
  let start = 0;
  for (const [key, { size, write }] of Object.entries(fields)) {
    const value = object[key];
    if (value !== undefined) {
      const packedValue = write(value, prefix ? `${prefix}.${key}` : key);
      packed.set(Array.isArray(packedValue) ? packedValue : [packedValue], start);
    }
    start += size;
  }
  return packed;
}

/** As `pack`, but throws also if the object has a key that is no field. */
export function merge(fields, list, object, name) {
  return pack(fields, list, checkKeys(object, name, Object.keys(fields)), name);
}

/**
 * As `merge` for a material, which may be the name of a preset, or an object with the field
 * `preset` to start from.
 */
export function mergeMaterial(list, material, presetList) {
  const preset = (value, name) => presetList(toChoiceIndex(value, name, PRESETS));
  if (typeof material === "string") return preset(material, "material");
  checkKeys(material, "material", ["preset", ...Object.keys(MATERIAL)]);
  const start = material.preset === undefined ? list : preset(material.preset, "material.preset");
  return pack(MATERIAL, start, material, "material");
}

function frozenSlice(list, start, size) {
  return Object.freeze(Array.from(list.subarray(start, start + size)));
}

/** Returns the material and the settings of a descriptor as flat lists. `raw` gives the defaults. */
export function packMaterialAndSettings({ material = {}, settings = {} }, raw) {
  return [
    mergeMaterial(raw.default_material(), material, raw.preset_material),
    merge(SETTINGS, raw.default_settings(), settings, "settings"),
  ];
}
