// The address of the WebAssembly module beside the scripts of the package.

import { addressOf, hasSimd } from "./load.js";

/**
 * Returns the address of the module that the engine can run. Bundlers look for exactly this form of
 * `new URL`, so both are written out. Some put an object there whose address is relative to the
 * page and cannot be parsed again, so it is passed on as it is.
 */
export function moduleUrl() {
  return addressOf(
    () => [new URL("raw_bg.wasm", import.meta.url), new URL("plain_bg.wasm", import.meta.url)][hasSimd() ? 0 : 1],
  );
}
