// Muslin: cloth for the web. Start with `await init()`, then `Cloth.grid()` or `Cloth.mesh()`.

import { version as rawVersion } from "./raw.js";
import { ready } from "./memory.js";

export { default, initSync } from "./load.js";
export { Cloth } from "./cloth.js";

/** The version of the library, "major.minor.patch". */
export function version() {
  ready();
  return rawVersion();
}
