// Entry point `muslin` in pages: start with `await init()`, then `Cloth.grid()` or `Cloth.mesh()`.
// In Node, Bun and Deno it is inline.js, which needs no second file.

import { load } from "./load.js";
import { moduleUrl } from "./url.js";

export { loadSync as initSync } from "./load.js";
export { Cloth } from "./cloth.js";
export { version } from "./version.js";

/** Loads the module; see index.d.ts. */
export default function init(source) {
  return load(source, moduleUrl);
}
