/**
 * Muslin simulates cloth: it hangs, collides, blows in the wind, is pulled, tears and is cut.
 *
 * Units are metres, kilograms, seconds and radians. Axes are right-handed; y is up unless you set
 * another gravity. The same calls give the same bits on every machine.
 *
 * A call with a wrong argument throws an `Error` that names the argument and the rule that it
 * breaks; the cloth is unchanged then.
 *
 * @example
 * ```js
 * import init, { Cloth } from "muslin";
 * await init();
 *
 * const cloth = Cloth.grid({ columns: 40, rows: 40, spacing: 0.05, material: "cotton" });
 * function frame(seconds) {
 *   cloth.advance(seconds);
 *   draw(cloth.positions, cloth.normals, cloth.indices);
 * }
 * ```
 *
 * @module
 */

export type { Quat, QuatLike, Vec3, Vec3Like } from "./check.js";
export { Cloth } from "./cloth.js";
export type * from "./fields.js";
export type * from "./handles.js";
export type * from "./reports.js";
export type * from "./skin.js";
export type * from "./write.js";

/**
 * A compiled WebAssembly module. (TypeScript's own type for it has no members, so that any value
 * would be assignable, even a number.)
 */
export type CompiledModule = WebAssembly.Module & object;

/** Where `init` loads the WebAssembly module from. A string is a URL. */
export type Source =
  | string
  | URL
  | Request
  | Response
  | ArrayBuffer
  | ArrayBufferView
  | CompiledModule;

/**
 * Loads the WebAssembly module. Await it once, before you create a cloth.
 *
 * Without `source` it loads the file beside this script: `raw_bg.wasm`, or `plain_bg.wasm` in
 * engines without SIMD. Vite, webpack, Parcel, Next, Nuxt and SvelteKit bundle both by themselves;
 * if your bundler does not, use `muslin/inline`, or pass the address of the file. In Node, Bun and
 * Deno the module is embedded, as in `muslin/inline`.
 *
 * Further calls, also concurrent ones, wait for the same module and ignore their `source`. After a
 * failure you can call it again.
 *
 * Under a content security policy the page needs `'wasm-unsafe-eval'` in `script-src` and nothing
 * else; `muslin/no-wasm` works without.
 *
 * @param source the module, or where it is; a promise is awaited
 * @throws if the module cannot be loaded, or is not the one of this package
 *
 * @example
 * ```js
 * await init();
 * await init(new URL("/assets/raw_bg.wasm", location.href));
 * ```
 */
export default function init(source?: Source | Promise<Source>): Promise<void>;

/**
 * Loads the WebAssembly module synchronously, from bytes or a compiled module. Use it in workers
 * and in Node: browsers compile only small modules synchronously on their main thread. In Node, Bun
 * and Deno `source` may be left out at run time; its type asks for it because pages need it.
 *
 * @throws if it is not the module of this package, or if `init()` has not finished yet
 */
export function initSync(source: ArrayBuffer | ArrayBufferView | CompiledModule): void;

/**
 * Returns the version of the library, "major.minor.patch".
 *
 * @throws if the module is not loaded
 */
export function version(): string;
