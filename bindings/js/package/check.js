// Validation of arguments. A failed check throws an Error that names the argument and the rule.

import { isModuleMemory } from "./memory.js";

const MAX_UINT32 = 0xffffffff;

/** Throws "`name` must …" unless `isValid`. `rule` is the rest of the sentence. */
export function check(isValid, name, rule) {
  if (!isValid) throw new Error(`\`${name}\` must ${rule}`);
}

/** Describes a wrong value for an error message. */
function describe(value) {
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value === "bigint") return `${value}n`;
  if (value === null || ["number", "boolean", "undefined"].includes(typeof value)) return `${value}`;
  return Array.isArray(value) ? "an array" : `a ${typeof value}`;
}

/** Returns a number other than NaN. The core checks whether it may be infinite or negative. */
export function toNumber(value, name) {
  return toNumberAt(value, name, "");
}

/** The same for a number at some `place` of a list, such as " at index 3". */
function toNumberAt(value, name, place) {
  const isValid = typeof value === "number" && !Number.isNaN(value);
  if (!isValid) check(false, name, `be a number, but is ${describe(value)}${place}`);
  return value;
}

/** Returns an integer of 32 bits without a sign: a particle, a count or a handle. */
export function toUint32(value, name) {
  const isValid = Number.isInteger(value) && value >= 0 && value <= MAX_UINT32;
  if (!isValid) check(false, name, `be a whole number from 0 to ${MAX_UINT32}, but is ${describe(value)}`);
  return value;
}

/** Returns a boolean. */
export function toBoolean(value, name) {
  check(typeof value === "boolean", name, `be true or false, but is ${describe(value)}`);
  return value;
}

/** Returns the index of `value` in `choices`. */
export function toChoiceIndex(value, name, choices) {
  const index = choices.indexOf(value);
  const list = choices.map((choice) => JSON.stringify(choice)).join(", ");
  if (index < 0) check(false, name, `be one of ${list}, but is ${describe(value)}`);
  return index;
}

/** Returns an array of as many numbers as `axes` names, from an array or a typed array. */
export function toVector(value, name, axes = "x, y, z") {
  const size = axes.split(", ").length;
  const isList = Array.isArray(value) || isNumericArray(value);
  if (!isList || value.length !== size) {
    const found = isList ? `has ${value.length}` : `is ${describe(value)}`;
    check(false, name, `be ${size} numbers [${axes}], but ${found}`);
  }
  return Array.from(value, (component) => toNumber(component, name));
}

/** Returns numbers as a Float32Array whose length is a multiple of `size`. */
export function toFloat32Array(value, name, size) {
  const isList = Array.isArray(value) || isNumericArray(value);
  check(isList, name, `be a Float32Array or numbers, but is ${describe(value)}`);
  if (Array.isArray(value)) value.forEach((number, i) => toNumberAt(number, name, ` at index ${i}`));
  const isWhole = value.length % size === 0;
  if (!isWhole) check(false, name, `hold a multiple of ${size} numbers, but has ${value.length}`);
  return toSafeArray(value, Float32Array);
}

/** Returns integers of 32 bits without a sign as a Uint32Array. */
export function toUint32Array(value, name) {
  const isList = Array.isArray(value) || isNumericArray(value);
  check(isList, name, `be a Uint32Array or whole numbers, but is ${describe(value)}`);
  if (!(value instanceof Uint32Array)) for (const number of value) toUint32(number, name);
  return toSafeArray(value, Uint32Array);
}

/** Returns bytes as a Uint8Array. */
export function toUint8Array(value, name) {
  check(isBytes(value), name, `be a Uint8Array or an ArrayBuffer, but is ${describe(value)}`);
  const { buffer, byteOffset, byteLength } = ArrayBuffer.isView(value) ? value : new Uint8Array(value);
  return toSafeArray(new Uint8Array(buffer, byteOffset, byteLength), Uint8Array);
}

/** Returns an object of which every key is in `known`. The value of a key may be undefined. */
export function checkKeys(value, name, known) {
  const isObject = typeof value === "object" && value !== null;
  const isValid = isObject && !Array.isArray(value) && !ArrayBuffer.isView(value);
  check(isValid, name, `be an object, but is ${describe(value)}`);
  for (const key of Object.keys(value)) {
    if (known.includes(key)) continue;
    const similar = known.find((each) => editDistance(each.toLowerCase(), key.toLowerCase()) <= 2);
    const hint = similar ? `; did you mean \`${similar}\`?` : "";
    throw new Error(`\`${name}.${key}\` is not known${hint}`);
  }
  return value;
}

/** Returns whether `value` is an ArrayBuffer or a view of one. */
export function isBytes(value) {
  return value instanceof ArrayBuffer || ArrayBuffer.isView(value);
}

/** Returns whether `value` is a typed array of numbers (not of bigints). */
function isNumericArray(value) {
  if (!ArrayBuffer.isView(value) || value instanceof DataView) return false;
  return !(value instanceof BigInt64Array || value instanceof BigUint64Array);
}

/**
 * Returns `list` as an array of `Kind` that can be passed to the module: a copy if the type
 * differs, or if `list` lies in the module's own memory, which may move while arguments are copied
 * into it.
 */
function toSafeArray(list, Kind) {
  return list instanceof Kind && !isModuleMemory(list) ? list : new Kind(list);
}

/** Returns the Levenshtein distance between two strings. */
function editDistance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, i) => i);
  for (let i = 0; i < a.length; i++) {
    const next = [i + 1];
    for (let j = 0; j < b.length; j++) {
      next.push(Math.min(row[j] + (a[i] === b[j] ? 0 : 1), row[j + 1] + 1, next[j] + 1));
    }
    row = next;
  }
  return row[b.length];
}
