/**
 * Muslin: cloth that hangs, is grabbed, blows and tears.
 *
 * Metres, kilograms, seconds, radians; right-handed, y up by default (gravity is a setting). The same
 * calls give the same bits on every machine. A refused call throws an `Error` that names the argument
 * and the rule, and changes nothing.
 *
 * @module
 */

export type { Quat, QuatLike, Vec3, Vec3Like } from "./check.js";
export { Cloth } from "./cloth.js";
export type * from "./fields.js";
export type * from "./handles.js";
export type * from "./reports.js";
export type * from "./write.js";

/** A compiled module. TypeScript's own type for it has no members, so that even numbers would pass. */
export type CompiledModule = WebAssembly.Module & object;

/** Where the module may come from. */
export type Source =
  | string
  | URL
  | Request
  | Response
  | ArrayBuffer
  | ArrayBufferView
  | CompiledModule;

/**
 * Loads the module: `raw_bg.wasm` beside this file, or what you give. In a page under a content
 * security policy this needs `'wasm-unsafe-eval'` in `script-src`, and nothing else;
 * `muslin/no-wasm` does without.
 *
 * Loads once: further calls, also at the same time, wait for the same module. One that failed may be
 * tried again.
 *
 * @throws if the module cannot be loaded, or is not the one of this package
 */
export default function init(source?: Source | Promise<Source>): Promise<void>;

/**
 * Loads the module from bytes or a compiled module, at once. Browsers allow this on their main thread
 * for small modules only.
 *
 * @throws if it is not the module of this package, or `init()` is under way
 */
export function initSync(source: ArrayBuffer | ArrayBufferView | CompiledModule): void;

/** The version of the library, "major.minor.patch". */
export function version(): string;
