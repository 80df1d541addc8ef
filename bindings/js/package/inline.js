// Entry point `muslin/inline`: the package with its WebAssembly module embedded as base64 text. In
// Node, Bun and Deno it is `muslin` too.

import { load, loadSync } from "./load.js";
import text from "./bytes.js";

export { Cloth } from "./cloth.js";
export { version } from "./version.js";

/** Loads the embedded module; see inline.d.ts. */
export default function init(source) {
  return load(source, embeddedBytes);
}

/** Loads the embedded module synchronously; see inline.d.ts. */
export function initSync(source) {
  loadSync(source ?? embeddedBytes());
}

function embeddedBytes() {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}
