// Entry point `muslin/light`: the package with a smaller module, which lacks cuts, saves, sewing,
// skins, self-collision of the surface, and convex, mesh and heightfield colliders.

import { addressOf, hasSimd, load } from "./load.js";

export { loadSync as initSync } from "./load.js";
export { Cloth } from "./cloth.js";
export { version } from "./version.js";

/** Loads the module; see light.d.ts. */
export default function init(source) {
  return load(source, lightUrl);
}

function lightUrl() {
  if (!hasSimd()) throw new Error('muslin/light needs WebAssembly with SIMD: import "muslin", which also works without');
  return addressOf(() => new URL("light_bg.wasm", import.meta.url));
}
