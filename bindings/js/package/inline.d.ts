/**
 * Muslin with its WebAssembly module embedded in a script: one import, no second file to find or
 * fetch. The script is a third larger than the module. It is the module with SIMD, which engines
 * support since 2021 (Safari since 2023).
 *
 * All exports are those of `muslin`.
 *
 * @module
 */

import type { CompiledModule, Source } from "./index.js";

export * from "./index.js";

/** Loads the embedded module, or `source` if you pass one; otherwise as `init` of `muslin`. */
export default function init(source?: Source | Promise<Source>): Promise<void>;

/**
 * Loads the embedded module synchronously, or `source` if you pass one. Browsers may allow this in
 * workers only.
 */
export function initSync(source?: ArrayBuffer | ArrayBufferView | CompiledModule): void;
