// Muslin without WebAssembly, for pages whose policy forbids it: the core as JavaScript, in the same bits.

import { instantiate } from "./code.js";
import { Trap } from "./heap.js";
import { IMPORTS, hold, isLoaded } from "./memory.js";

export { Cloth } from "./cloth.js";
export { version } from "./version.js";

/** Makes the core ready; see no-wasm.d.ts. */
export default async function init() {
  initSync();
}

/** Makes the core ready at once; see no-wasm.d.ts. */
export function initSync() {
  if (!isLoaded()) hold(instantiate(IMPORTS), Trap);
}
