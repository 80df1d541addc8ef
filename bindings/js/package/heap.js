// Runtime of code.js, the core compiled to JavaScript: traps, and memory that grows.

/** The unit in which memory grows [B], as in WebAssembly. */
const PAGE = 2 ** 16;

/** The most memory there can be [B]: addresses in code.js are signed 32-bit integers. */
const MAX_SIZE = 2 ** 31 - PAGE;

/** Thrown where WebAssembly would trap. */
export class Trap extends Error {
  name = "Trap";
}

export function trap() {
  throw new Trap("unreachable");
}

/**
 * Returns a buffer of at least `size` bytes that holds the contents of `old`; undefined if there is
 * no memory for it. Detaches `old` if it returns another buffer: its views become empty, as those
 * of a WebAssembly memory do.
 */
export function grow(old, size) {
  if (size <= old.byteLength) return old;
  // Half as much again at least, so that many small steps do not copy everything each time.
  const wanted = Math.min(PAGE * Math.ceil(Math.max(size, 1.5 * old.byteLength) / PAGE), MAX_SIZE);
  if (size > wanted) return undefined;
  try {
    const grown = new ArrayBuffer(wanted);
    new Uint8Array(grown).set(new Uint8Array(old));
    structuredClone(old, { transfer: [old] });
    return grown;
  } catch {
    return undefined; // the engine has no memory left
  }
}
