// Muslin with its module inside: one import, no second file to be found or fetched.

import load, { initSync as loadSync } from "./load.js";
import text from "./bytes.js";

export * from "./index.js";

/** Loads the module; see inline.d.ts. */
export default function init(source) {
  return load(source ?? bytes());
}

/** Loads the module at once; see inline.d.ts. */
export function initSync(source) {
  loadSync(source ?? bytes());
}

function bytes() {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}
