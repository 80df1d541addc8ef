/**
 * Muslin as plain JavaScript: for pages whose policy is `script-src 'self'`, without
 * `'wasm-unsafe-eval'`. The same calls, the same bits; many times slower, and larger.
 *
 * @module
 */

export * from "../index.js";

/** Readies the module, which is part of this build: it takes no source. */
export default function init(): Promise<void>;

/** As `init()`, at once. */
export function initSync(): void;
