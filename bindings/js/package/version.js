// Which version this is.

import { version as rawVersion } from "./raw.js";
import { ready } from "./memory.js";

/** The version of the library, "major.minor.patch". */
export function version() {
  ready();
  return rawVersion();
}
