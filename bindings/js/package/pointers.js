// Entry point `muslin/pointers`: pointers (mice, fingers, controllers) that grab and drag a cloth
// by rays. It needs no rendering engine.

import { check, checkKeys, toNumber, toVector } from "./check.js";

/**
 * The smallest angle between ray and plane at which a drag moves the grab [rad]. A flatter ray
 * meets the plane so far away that it would throw the cloth to the horizon.
 */
const MIN_ANGLE = 0.02;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const length = (a) => Math.sqrt(dot(a, a));

export class Pointers {
  #cloth;
  #radius;
  #held = new Map();

  constructor(cloth, options = {}) {
    check(typeof cloth?.grabRay === "function", "cloth", "be a cloth");
    const { radius = 0 } = checkKeys(options, "options", ["radius"]);
    this.#cloth = cloth;
    this.#radius = toNumber(radius, "radius");
  }

  get cloth() {
    return this.#cloth;
  }

  get size() {
    return this.#held.size;
  }

  holds(pointer) {
    return this.#held.has(pointer);
  }

  press(pointer, origin, direction, facing = direction) {
    const normal = toVector(facing, "facing");
    this.lift(pointer);
    const grab = this.#cloth.grabRay(origin, direction, { radius: this.#radius });
    if (grab) this.#held.set(pointer, { grab, normal });
    return grab !== undefined;
  }

  drag(pointer, origin, direction) {
    const held = this.#held.get(pointer);
    if (!held) return false;
    const { grab, normal } = held;
    const [from, along] = [toVector(origin, "origin"), toVector(direction, "direction")];
    const slope = dot(along, normal);
    const distance = dot(grab.position, normal) - dot(from, normal);
    const isHit = Math.abs(slope) > MIN_ANGLE * length(along) * length(normal) && distance * slope > 0;
    return isHit && this.#tryGrab(pointer, () => grab.moveTo(from.map((x, i) => x + (along[i] * distance) / slope)));
  }

  lift(pointer) {
    const held = this.#held.get(pointer);
    if (!held) return false;
    this.#tryGrab(pointer, () => held.grab.release());
    this.#held.delete(pointer);
    return true;
  }

  liftAll() {
    for (const pointer of [...this.#held.keys()]) this.lift(pointer);
  }

  /**
   * Runs an action on a pointer's grab, and returns whether it succeeded. A grab is stale if its
   * cloth was reset or freed: the pointer then holds nothing any more.
   */
  #tryGrab(pointer, action) {
    try {
      action();
      return true;
    } catch {
      this.#held.delete(pointer);
      return false;
    }
  }
}
