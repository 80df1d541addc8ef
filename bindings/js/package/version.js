// The version of the library.

import { version as rawVersion } from "./raw.js";
import { requireMemory } from "./memory.js";

/** Returns the version of the library, "major.minor.patch". */
export function version() {
  requireMemory();
  return rawVersion();
}
