// Many cloths in one call of the module.

import * as raw from "./raw.js";
import { check, toNumber } from "./check.js";

/**
 * Advances cloths by `seconds` [s], and returns how many ticks each of them ran. `stateOf` returns
 * the state of a cloth, and false for other values.
 */
export function advanceMany(cloths, stateOf, seconds) {
  check(Array.isArray(cloths), "cloths", "be an array of cloths");
  const addresses = new Set();
  cloths.forEach((cloth, index) => {
    const { live, address } = stateOf(cloth);
    if (!live || addresses.has(address)) check(false, `cloths[${index}]`, "be a live cloth that is not in the list twice");
    addresses.add(address);
  });
  return raw.advance_many(Uint32Array.from(addresses), toNumber(seconds, "seconds"));
}
