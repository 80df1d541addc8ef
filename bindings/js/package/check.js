// What a caller can get wrong, said in words that name the argument and the rule.

import { isOurs } from "./memory.js";

const MOST = 0xffffffff;

/** Refuses what breaks a rule. */
export function check(holds, name, must) {
  if (!holds) throw new Error(`\`${name}\` must ${must}`);
}

/** How to show a wrong value. */
function shown(value) {
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value === "bigint") return `${value}n`;
  if (value === null || ["number", "boolean", "undefined"].includes(typeof value)) return `${value}`;
  return Array.isArray(value) ? "an array" : `a ${typeof value}`;
}

/** A number. Whether it may be infinite or negative is the core's to say. */
export function number(value, name) {
  const holds = typeof value === "number" && !Number.isNaN(value);
  if (!holds) check(false, name, `be a number, but is ${shown(value)}`);
  return value;
}

/** A whole number that a particle, a count or a handle can be. */
export function whole(value, name) {
  const holds = Number.isInteger(value) && value >= 0 && value <= MOST;
  if (!holds) check(false, name, `be a whole number from 0 to ${MOST}, but is ${shown(value)}`);
  return value;
}

/** A switch. */
export function flag(value, name) {
  check(typeof value === "boolean", name, `be true or false, but is ${shown(value)}`);
  return value;
}

/** One of some names; gives its place among them. */
export function choice(value, name, names) {
  const at = names.indexOf(value);
  const told = names.map((each) => JSON.stringify(each)).join(", ");
  if (at < 0) check(false, name, `be one of ${told}, but is ${shown(value)}`);
  return at;
}

/** Three numbers, or as many as `axes` names: an array or a typed array. */
export function vector(value, name, axes = "x, y, z") {
  const size = axes.split(", ").length;
  const isList = Array.isArray(value) || isNumeric(value);
  if (!isList || value.length !== size) {
    check(false, name, `be ${size} numbers [${axes}], but is ${isList ? value.length : shown(value)}`);
  }
  return Array.from(value, (each) => number(each, name));
}

/** Numbers as a Float32Array, `each` of them a group. */
export function floats(value, name, each) {
  const isList = Array.isArray(value) || isNumeric(value);
  check(isList, name, `be a Float32Array or numbers, but is ${shown(value)}`);
  if (Array.isArray(value)) value.forEach((one) => number(one, name));
  check(value.length % each === 0, name, `hold ${each} numbers for each of its entries`);
  return own(value, Float32Array);
}

/** Whole numbers as a Uint32Array. */
export function wholes(value, name) {
  const isList = Array.isArray(value) || isNumeric(value);
  check(isList, name, `be a Uint32Array or whole numbers, but is ${shown(value)}`);
  if (!(value instanceof Uint32Array)) for (const one of value) whole(one, name);
  return own(value, Uint32Array);
}

/** Bytes, as a Uint8Array. */
export function bytes(value, name) {
  check(isBytes(value), name, `be a Uint8Array or an ArrayBuffer, but is ${shown(value)}`);
  const { buffer, byteOffset, byteLength } = ArrayBuffer.isView(value) ? value : new Uint8Array(value);
  return own(new Uint8Array(buffer, byteOffset, byteLength), Uint8Array);
}

/** An object with keys that are known; absent ones may be undefined. */
export function keys(value, name, known) {
  const isObject = typeof value === "object" && value !== null;
  const holds = isObject && !Array.isArray(value) && !ArrayBuffer.isView(value);
  check(holds, name, `be an object, but is ${shown(value)}`);
  for (const key of Object.keys(value)) {
    if (known.includes(key)) continue;
    const near = known.find((each) => distance(each.toLowerCase(), key.toLowerCase()) <= 2);
    const hint = near ? `; did you mean \`${near}\`?` : "";
    throw new Error(`\`${name}.${key}\` is not known${hint}`);
  }
  return value;
}

/** Bytes of any kind. */
export function isBytes(value) {
  return value instanceof ArrayBuffer || ArrayBuffer.isView(value);
}

/** A typed array of numbers. */
function isNumeric(value) {
  if (!ArrayBuffer.isView(value) || value instanceof DataView) return false;
  return !(value instanceof BigInt64Array || value instanceof BigUint64Array);
}

/** A list of this kind; a copy where it would move while it is handed over. */
function own(list, Kind) {
  return list instanceof Kind && !isOurs(list) ? list : new Kind(list);
}

/** How many letters have to be changed, added or dropped to make `b` of `a`. */
function distance(a, b) {
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
