// Handles to the grabs, attachments and colliders of a cloth. Each holds a function `live` that
// returns the cloth's RawCloth, or throws if the cloth was freed.

import { toVector } from "./check.js";

/** Passed to constructors by this package only, so that nobody else can construct these classes. */
export const CONSTRUCTOR_KEY = Symbol("made by muslin");

/** Throws `message` unless `key` is the constructor key. */
export function checkConstructorKey(key, message) {
  if (key !== CONSTRUCTOR_KEY) throw new Error(message);
}

/** Returns position and rotation as a flat list of seven numbers. */
export function packPose(position, rotation) {
  const quaternion = toVector(rotation, "rotation", "x, y, z, w");
  return Float64Array.of(...toVector(position, "position"), ...quaternion);
}

/** Returns the rotation of a pose that `packPose` made. */
function rotationOf(pose) {
  return Array.from(pose.subarray(3));
}

export class Grab {
  #live;
  #handle;

  constructor(key, live, handle, position) {
    checkConstructorKey(key, "a grab is made by cloth.grabRay() or cloth.grabParticle()");
    this.#live = live;
    this.#handle = handle;
    this.position = Object.freeze(Array.from(position));
    Object.freeze(this);
  }

  moveTo(target) {
    this.#live().move_grab(this.#handle, ...toVector(target, "target"));
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
    checkConstructorKey(key, "an attachment is made by cloth.attach()");
    this.#live = live;
    this.#handle = handle;
    this.#rotation = rotation;
  }

  get particles() {
    return this.#live().attached(this.#handle);
  }

  moveTo(position, rotation = this.#rotation) {
    const live = this.#live();
    const pose = packPose(position, rotation);
    live.move_attachment(this.#handle, pose);
    this.#rotation = rotationOf(pose);
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
    checkConstructorKey(key, "a collider is made by cloth.addCollider()");
    this.#live = live;
    this.#handle = handle;
    this.#rotation = rotation;
  }

  moveTo(position, rotation = this.#rotation) {
    const live = this.#live();
    const pose = packPose(position, rotation);
    live.move_collider(this.#handle, pose);
    this.#rotation = rotationOf(pose);
  }

  teleport(position, rotation = this.#rotation) {
    const live = this.#live();
    const pose = packPose(position, rotation);
    live.teleport_collider(this.#handle, pose);
    this.#rotation = rotationOf(pose);
  }

  get impulse() {
    const list = Array.from(this.#live().collider_impulse(this.#handle));
    const vectorAt = (start) => Object.freeze(list.slice(start, start + 3));
    return Object.freeze({ linear: vectorAt(0), angular: vectorAt(3) });
  }

  remove() {
    this.#live().remove_collider(this.#handle);
  }
}
