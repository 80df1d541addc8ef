/**
 * Muslin with a smaller module, for pages that need less of it: cloth that hangs, blows in the wind,
 * is pinned, grabbed and attached, tears, and collides with planes, spheres, capsules, boxes and,
 * by its particles, with itself.
 *
 * All exports are those of `muslin`, and what the module has moves with the same bits. These throw an
 * `Error` that names them:
 *
 * - `cut`, `save`, `Cloth.restore` and `duplicate`;
 * - `sew` and `skin`;
 * - `selfCollision: true`; `"particles"` works;
 * - colliders of the shapes `"convex"`, `"mesh"` and `"heightfield"`, `Collider.update` and
 *   `collideWith`.
 *
 * The module needs WebAssembly with SIMD, which engines support since 2021 (Safari since 2023). All
 * entry points share one module: the first `init()` that succeeds decides which, so import either
 * `muslin` or `muslin/light` in a page.
 *
 * @example
 * ```js
 * import init, { Cloth } from "muslin/light";
 * await init();
 * const cloth = Cloth.grid({ columns: 40, rows: 40, spacing: 0.05, material: "cotton" });
 * ```
 *
 * @module
 */

import type { Source } from "./index.js";

export * from "./index.js";

/**
 * Loads `light_bg.wasm` beside this script, or `source` if you pass one; otherwise as `init` of
 * `muslin`. In Node, Bun and Deno it reads that file too.
 */
export default function init(source?: Source | Promise<Source>): Promise<void>;
