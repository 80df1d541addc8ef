// Loading the module: it is JavaScript, so it is here already.

import { initSync as instantiate } from "./raw.js";
import { check } from "./check.js";
import { WebAssembly } from "./engine.js";
import { hold, isLoaded } from "./memory.js";

/** Loads the module; see index.d.ts. */
export default async function init(source) {
  initSync(source);
}

/** Loads the module at once; see index.d.ts. */
export function initSync(source) {
  check(source === undefined, "source", "be left out: this build has the module in it");
  if (!isLoaded()) hold(instantiate({ module: new WebAssembly.Module() }).memory);
}
