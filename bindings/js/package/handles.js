// Handles to the grabs, attachments and colliders of a cloth. Each holds a function `live` that
// returns the cloth's RawCloth, or throws if the cloth was freed.

import { toFloat32Array, toVector } from "./check.js";
import { setState, stateOf } from "./state.js";

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

/** Returns origin and direction as a flat list. */
export function packRay(origin, direction) {
  return Float64Array.of(...toVector(origin, "origin"), ...toVector(direction, "direction"));
}

/** Returns the rotation of a pose that `packPose` made. */
function rotationOf(pose) {
  return Array.from(pose.subarray(3));
}

/** Returns the state and the handle of an object, and its RawCloth. Throws if the cloth was freed. */
function liveStateOf(object, kind) {
  const state = stateOf(object, kind);
  return { state, live: state.live(), handle: state.handle };
}

export class Grab {
  constructor(key, live, handle, position) {
    checkConstructorKey(key, "a grab is made by cloth.grabRay() or cloth.grabParticle()");
    setState(this, { live, handle });
    this.position = Object.freeze(Array.from(position));
    Object.freeze(this);
  }

  moveTo(target) {
    const { live, handle } = liveStateOf(this, "Grab");
    live.move_grab(handle, ...toVector(target, "target"));
  }

  release() {
    const { live, handle } = liveStateOf(this, "Grab");
    live.release(handle);
  }
}

/** Returns position and rotation as a flat list; without `rotation`, that of the last pose. */
function nextPose(state, position, rotation = state.rotation) {
  return packPose(position, rotation);
}

export class Attachment {
  constructor(key, live, handle, rotation) {
    checkConstructorKey(key, "an attachment is made by cloth.attach()");
    setState(this, { live, handle, rotation });
  }

  get particles() {
    const { live, handle } = liveStateOf(this, "Attachment");
    return live.attached(handle);
  }

  moveTo(position, rotation) {
    const { state, live, handle } = liveStateOf(this, "Attachment");
    const pose = nextPose(state, position, rotation);
    live.move_attachment(handle, pose);
    state.rotation = rotationOf(pose);
  }

  detach() {
    const { live, handle } = liveStateOf(this, "Attachment");
    live.detach(handle);
  }
}

export class Collider {
  constructor(key, live, handle, rotation) {
    checkConstructorKey(key, "a collider is made by cloth.addCollider() or cloth.collideWith()");
    setState(this, { live, handle, rotation });
  }

  moveTo(position, rotation) {
    const { state, live, handle } = liveStateOf(this, "Collider");
    const pose = nextPose(state, position, rotation);
    live.move_collider(handle, pose);
    state.rotation = rotationOf(pose);
  }

  teleport(position, rotation) {
    const { state, live, handle } = liveStateOf(this, "Collider");
    const pose = nextPose(state, position, rotation);
    live.teleport_collider(handle, pose);
    state.rotation = rotationOf(pose);
  }

  update(positions) {
    const { live, handle } = liveStateOf(this, "Collider");
    live.update_collider(handle, toFloat32Array(positions, "positions", 3));
  }

  get pose() {
    const { live, handle } = liveStateOf(this, "Collider");
    const list = Array.from(live.collider_pose(handle));
    return Object.freeze({ position: Object.freeze(list.slice(0, 3)), rotation: Object.freeze(list.slice(3)) });
  }

  get impulse() {
    const { live, handle } = liveStateOf(this, "Collider");
    const list = Array.from(live.collider_impulse(handle));
    const vectorAt = (start) => Object.freeze(list.slice(start, start + 3));
    return Object.freeze({ linear: vectorAt(0), angular: vectorAt(3) });
  }

  remove() {
    const { state, live, handle } = liveStateOf(this, "Collider");
    live.remove_collider(handle);
    state.handle = 0;
  }
}
