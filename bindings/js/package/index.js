// Entry point `muslin`: start with `await init()`, then `Cloth.grid()` or `Cloth.mesh()`.

export { default, initSync } from "./load.js";
export { Cloth } from "./cloth.js";
export { version } from "./version.js";
