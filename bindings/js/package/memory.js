// The instance of the WebAssembly module, once it is loaded, and its memory.

import * as raw from "./raw.js";

/** The imports of the module. */
export const IMPORTS = { "./raw_bg.js": raw };

let memory;
let TrapError;

/**
 * Makes an instance of the module the one that all cloths live in.
 *
 * @param exports the exports of the instance
 * @param Trap the class of error that the instance throws when it traps, such as when it runs out
 * of memory
 */
export function setInstance(exports, Trap) {
  raw.__wbg_set_wasm(exports);
  [memory, TrapError] = [exports.memory, Trap];
}

/** Returns whether an error is a trap of the module. */
export function isTrap(error) {
  return error instanceof TrapError;
}

/** Returns whether the module is loaded. */
export function isLoaded() {
  return memory !== undefined;
}

/** Returns the memory of the module. Throws if the module is not loaded. */
export function requireMemory() {
  if (!memory) throw new Error("Muslin is not loaded: call await init() first");
  return memory;
}

/**
 * Returns a view of the module's memory: the one of this name in `views` if memory, address and
 * length are still the same.
 */
export function viewOf(views, name, Kind, address, length) {
  const { buffer } = requireMemory(); // read here: the call that returned `address` may have grown the memory
  const last = views[name];
  const fits = last?.buffer === buffer && last.byteOffset === address && last.length === length;
  return fits ? last : (views[name] = new Kind(buffer, address, length));
}

/**
 * Returns whether a typed array is a view of the module's own memory, which moves when it grows.
 */
export function isModuleMemory(list) {
  return list.buffer === memory?.buffer;
}
