// The module, once it is loaded, and its memory.

import * as raw from "./raw.js";

/** What the module asks for. */
export const IMPORTS = { "./raw_bg.js": raw };

let memory;
let Trap;

/** From now on the module is loaded: these are its exports, and what it throws when it cannot go on. */
export function hold(exports, Thrown) {
  raw.__wbg_set_wasm(exports);
  [memory, Trap] = [exports.memory, Thrown];
}

/** Whether this is what the module throws when it cannot go on. */
export function isTrap(error) {
  return error instanceof Trap;
}

/** Whether the module is loaded. */
export function isLoaded() {
  return memory !== undefined;
}

/** The memory of the module; throws before there is one. */
export function ready() {
  if (!memory) throw new Error("Muslin is not loaded: call await init() first");
  return memory;
}

/** Whether a list lies in the module's own memory, which may move while the list is handed over. */
export function isOurs(list) {
  return list.buffer === memory?.buffer;
}
