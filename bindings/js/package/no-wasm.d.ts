/**
 * Muslin without WebAssembly: the core compiled to JavaScript, for pages whose content security
 * policy is `script-src 'self'` and nothing else. It gives the same bits as `muslin`, and takes
 * some 27 times as long.
 *
 * The classes are those of `muslin`; `muslin/three` and `muslin/pointers` work with it too. All
 * entry points share one core: the first `init()` that succeeds decides which. So a page can try
 * `muslin` and fall back to this.
 *
 * @example
 * ```js
 * import init, { Cloth } from "muslin";
 * import initWithoutWasm from "muslin/no-wasm";
 * await init().catch(initWithoutWasm);
 * ```
 *
 * @module
 */

export * from "./index.js";

/** Makes the core ready. It loads nothing: the core is a script that the import brought along. */
export default function init(): Promise<void>;

/** Makes the core ready, synchronously. */
export function initSync(): void;
