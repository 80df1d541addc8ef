/**
 * Muslin without WebAssembly, for pages that may not use it: the core as JavaScript, in the same bits, many times
 * slower. It runs under a content security policy of `script-src 'self'` and nothing else.
 *
 * The classes are those of `muslin`, and so are `muslin/three` and `muslin/pointers`. Whichever `init()` was first
 * makes the core ready, so a page can try the one and fall back on the other.
 *
 * @module
 */

export * from "./index.js";

/** Makes the core ready. Nothing is loaded: it is a script that came with the import. */
export default function init(): Promise<void>;

/** As `init()`, at once. */
export function initSync(): void;
