// What pointers hold of a cloth: mice, fingers and controllers, each with a ray of its own. No engine is needed for it.

import { check, keys, number, vector } from "./check.js";

/** A ray that meets its plane at less than this slope [rad] would throw the cloth to the horizon. */
const FLAT = 0.02;

const along = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const length = (a) => Math.sqrt(along(a, a));

export class Pointers {
  #cloth;
  #radius;
  #held = new Map();

  constructor(cloth, options = {}) {
    check(typeof cloth?.grabRay === "function", "cloth", "be a cloth");
    const { radius = 0 } = keys(options, "options", ["radius"]);
    this.#cloth = cloth;
    this.#radius = number(radius, "radius");
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
    const normal = vector(facing, "facing");
    this.lift(pointer);
    const grab = this.#cloth.grabRay(origin, direction, { radius: this.#radius });
    if (grab) this.#held.set(pointer, { grab, normal });
    return grab !== undefined;
  }

  drag(pointer, origin, direction) {
    const held = this.#held.get(pointer);
    if (!held) return false;
    const { grab, normal } = held;
    const [from, way] = [vector(origin, "origin"), vector(direction, "direction")];
    const slope = along(way, normal);
    const distance = along(grab.position, normal) - along(from, normal);
    const isMet = Math.abs(slope) > FLAT * length(way) * length(normal) && distance * slope > 0;
    return isMet && this.#use(pointer, () => grab.moveTo(from.map((x, i) => x + (way[i] * distance) / slope)));
  }

  lift(pointer) {
    const held = this.#held.get(pointer);
    if (!held) return false;
    this.#use(pointer, () => held.grab.release());
    this.#held.delete(pointer);
    return true;
  }

  liftAll() {
    for (const pointer of [...this.#held.keys()]) this.lift(pointer);
  }

  /** A grab is over when its cloth was reset or freed meanwhile: then the pointer holds nothing any more. */
  #use(pointer, work) {
    try {
      work();
      return true;
    } catch {
      this.#held.delete(pointer);
      return false;
    }
  }
}
