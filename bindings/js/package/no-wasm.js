// Entry point `muslin/no-wasm`: the core compiled to JavaScript, for pages whose policy forbids
// WebAssembly.

import { instantiate } from "./code.js";
import { Trap } from "./heap.js";
import { IMPORTS, isLoaded, setInstance } from "./memory.js";

export { Cloth } from "./cloth.js";
export { version } from "./version.js";

/** Makes the core ready; see no-wasm.d.ts. */
export default async function init() {
  initSync();
}

/** Makes the core ready synchronously; see no-wasm.d.ts. */
export function initSync() {
  if (!isLoaded()) setInstance(instantiate(IMPORTS), Trap);
}
