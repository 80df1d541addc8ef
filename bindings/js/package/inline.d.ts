/**
 * Muslin with its module inside, as text: one import, no second file to be found or fetched, a third
 * larger. The module is the one with vectors, which engines have had since 2021 (Safari since 2023).
 *
 * @module
 */

import type { CompiledModule, Source } from "./index.js";

export * from "./index.js";

/** Loads the module that is inside, or what you give; see `init` of `muslin`. */
export default function init(source?: Source | Promise<Source>): Promise<void>;

/** As `init()`, at once; browsers may allow it on a worker only. */
export function initSync(source?: ArrayBuffer | ArrayBufferView | CompiledModule): void;
