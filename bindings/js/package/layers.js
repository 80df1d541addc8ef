// Layers: the surface of another cloth as a collider. The state of each cloth remembers the colliders of
// the cloths that it met.

import { check } from "./check.js";
import { Collider, CONSTRUCTOR_KEY } from "./handles.js";
import { stateOf } from "./state.js";

/**
 * Makes the surface of another cloth a collider, or updates it, and returns it. `live` returns the
 * RawCloth of the cloth with `state`; `other` is the state of the other cloth, if it is one.
 */
export function collideWith(state, live, other) {
  const cloth = live();
  check(other && other !== state, "other", "be another cloth");
  check(other.live, "other", "be live, but was freed");
  const layers = (state.layers ??= new WeakMap());
  const known = layers.get(other);
  const before = known ? stateOf(known, "Collider").handle : 0;
  const handle = cloth.collide_with(other.live, before);
  if (before !== 0) return known;
  const layer = new Collider(CONSTRUCTOR_KEY, live, handle, [0, 0, 0, 1]);
  layers.set(other, layer);
  return layer;
}
