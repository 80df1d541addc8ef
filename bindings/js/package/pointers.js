// Entry point `muslin/pointers`: pointers (mice, fingers, controllers) that grab and drag a cloth
// by rays. It needs no rendering engine.

import { check, checkKeys, toNumber, toVector } from "./check.js";
import { setState, stateOf } from "./state.js";

/**
 * The smallest angle between ray and plane at which a drag moves the grab [rad]. A flatter ray
 * meets the plane so far away that it would throw the cloth to the horizon.
 */
const MIN_ANGLE = 0.02;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const length = (a) => Math.sqrt(dot(a, a));

/** Returns the cloth, the radius and what each pointer holds. */
function partsOf(pointers) {
  return stateOf(pointers, "Pointers");
}

/**
 * Runs an action on a pointer's grab, and returns whether it succeeded. A grab is stale if its
 * cloth was reset or freed: the pointer then holds nothing any more.
 */
function tryGrab(held, pointer, action) {
  try {
    action();
    return true;
  } catch {
    held.delete(pointer);
    return false;
  }
}

export class Pointers {
  constructor(cloth, options = {}) {
    check(typeof cloth?.grabRay === "function", "cloth", "be a cloth");
    const { radius = 0 } = checkKeys(options, "options", ["radius"]);
    setState(this, { cloth, radius: toNumber(radius, "radius"), held: new Map() });
  }

  get cloth() {
    return partsOf(this).cloth;
  }

  get size() {
    return partsOf(this).held.size;
  }

  holds(pointer) {
    return partsOf(this).held.has(pointer);
  }

  press(pointer, origin, direction, facing = direction) {
    const { cloth, radius, held } = partsOf(this);
    const normal = toVector(facing, "facing");
    this.lift(pointer);
    const grab = cloth.grabRay(origin, direction, { radius });
    if (grab) held.set(pointer, { grab, normal });
    return grab !== undefined;
  }

  drag(pointer, origin, direction) {
    const { held } = partsOf(this);
    if (!held.has(pointer)) return false;
    const { grab, normal } = held.get(pointer);
    const [from, along] = [toVector(origin, "origin"), toVector(direction, "direction")];
    const slope = dot(along, normal);
    const distance = dot(grab.position, normal) - dot(from, normal);
    const isHit = Math.abs(slope) > MIN_ANGLE * length(along) * length(normal) && distance * slope > 0;
    return isHit && tryGrab(held, pointer, () => grab.moveTo(from.map((x, i) => x + (along[i] * distance) / slope)));
  }

  lift(pointer) {
    const { held } = partsOf(this);
    if (!held.has(pointer)) return false;
    const { grab } = held.get(pointer);
    tryGrab(held, pointer, () => grab.release());
    held.delete(pointer);
    return true;
  }

  liftAll() {
    for (const pointer of [...partsOf(this).held.keys()]) this.lift(pointer);
  }
}
