// Muslin: cloth for the web. Start with `await init()`, then `Cloth.grid()` or `Cloth.mesh()`.

export { default, initSync } from "./load.js";
export { Cloth } from "./cloth.js";
export { version } from "./version.js";
