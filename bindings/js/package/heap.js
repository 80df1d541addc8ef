// What code.js, the core as JavaScript, has in place of a machine: traps, and memory that grows.

/** Memory comes in these [B]. */
const PAGE = 2 ** 16;

/** Addresses are signed numbers there: memory ends where they do [B]. */
const MOST = 2 ** 31 - PAGE;

/** What is thrown where the core cannot go on. */
export class Trap extends Error {
  name = "Trap";
}

export function trap() {
  throw new Trap("unreachable");
}

/**
 * Memory of `size` bytes or more, with what `old` holds; nothing if there is none. Lists in the old one are of no
 * length from now on, as those of WebAssembly's memory would be.
 */
export function grow(old, size) {
  if (size <= old.byteLength) return old;
  // More than asked for, so that many small steps do not copy all of it each.
  const wanted = Math.min(PAGE * Math.ceil(Math.max(size, 1.5 * old.byteLength) / PAGE), MOST);
  if (size > wanted) return undefined;
  try {
    const grown = new ArrayBuffer(wanted);
    new Uint8Array(grown).set(new Uint8Array(old));
    structuredClone(old, { transfer: [old] });
    return grown;
  } catch {
    return undefined; // the engine has no room
  }
}
