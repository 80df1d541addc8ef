// Grabs, attachments and colliders: handles to what a cloth holds. `live` gives the cloth, or throws if it was freed.

import { vector } from "./check.js";

/** Cloths, grabs, attachments and colliders are made by this package only: from what the core gave. */
export const OURS = Symbol("made by muslin");

/** Refuses a maker from outside. */
export function onlyOurs(key, advice) {
  if (key !== OURS) throw new Error(advice);
}

export class Grab {
  #live;
  #handle;

  constructor(key, live, handle, position) {
    onlyOurs(key, "a grab is made by cloth.grabRay() or cloth.grabParticle()");
    this.#live = live;
    this.#handle = handle;
    this.position = Object.freeze(Array.from(position));
    Object.freeze(this);
  }

  moveTo(target) {
    this.#live().move_grab(this.#handle, ...vector(target, "target"));
  }

  release() {
    this.#live().release(this.#handle);
  }
}

export class Attachment {
  #live;
  #handle;
  #rotation;

  constructor(key, live, handle, rotation) {
    onlyOurs(key, "an attachment is made by cloth.attach()");
    this.#live = live;
    this.#handle = handle;
    this.#rotation = rotation;
  }

  get particles() {
    return this.#live().attached(this.#handle);
  }

  moveTo(position, rotation = this.#rotation) {
    const live = this.#live();
    const turned = vector(rotation, "rotation", "x, y, z, w");
    live.move_attachment(this.#handle, Float64Array.of(...vector(position, "position"), ...turned));
    this.#rotation = turned;
  }

  detach() {
    this.#live().detach(this.#handle);
  }
}

export class Collider {
  #live;
  #handle;
  #rotation;

  constructor(key, live, handle, rotation) {
    onlyOurs(key, "a collider is made by cloth.addCollider()");
    this.#live = live;
    this.#handle = handle;
    this.#rotation = rotation;
  }

  moveTo(position, rotation = this.#rotation) {
    const live = this.#live();
    const turned = vector(rotation, "rotation", "x, y, z, w");
    live.move_collider(this.#handle, Float64Array.of(...vector(position, "position"), ...turned));
    this.#rotation = turned;
  }

  teleport(position, rotation = this.#rotation) {
    const live = this.#live();
    const turned = vector(rotation, "rotation", "x, y, z, w");
    live.teleport_collider(this.#handle, Float64Array.of(...vector(position, "position"), ...turned));
    this.#rotation = turned;
  }

  get impulse() {
    const all = Array.from(this.#live().collider_impulse(this.#handle));
    const part = (from) => Object.freeze(all.slice(from, from + 3));
    return Object.freeze({ linear: part(0), angular: part(3) });
  }

  remove() {
    this.#live().remove_collider(this.#handle);
  }
}
