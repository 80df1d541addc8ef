// What a cloth has given out.

import type { QuatLike, Vec3, Vec3Like } from "./check.js";

/** A particle held by a pointer. Stale once released, or once the cloth is reset. */
export interface Grab {
  /** Where the particle was when it was taken [m]. */
  readonly position: Vec3;
  /** Gives it a new target [m]; the particle follows as fast as `maxDisplacement` allows. */
  moveTo(target: Vec3Like): void;
  /** Lets the particle go, with the velocity it has. Throws if it was released before. */
  release(): void;
}

/** A transform that particles of a cloth are attached to. Stale once detached, or once the cloth is reset. */
export interface Attachment {
  /** The particles that it carries, lowest first. Throws if it was detached. */
  readonly particles: Uint32Array;
  /**
   * Moves it; what it carries gets there over the next tick, turning on the way as it turns, and is exactly
   * there when that ends. Without a rotation it keeps the last one.
   */
  moveTo(position: Vec3Like, rotation?: QuatLike): void;
  /** Lets all go that it carries, with the velocity that they have. Throws if it was detached before. */
  detach(): void;
}

/** What a cloth did to a collider in the last tick; over the tick's length, force and torque. */
export interface Impulse {
  /** Momentum given [kg m/s]. */
  readonly linear: Vec3;
  /** Angular momentum given, about the collider's position [kg m²/s]. */
  readonly angular: Vec3;
}

/** A collider of a cloth. Stale once removed. */
export interface Collider {
  /** Moves it; it gets there over the next tick. Without a rotation it keeps the last one. */
  moveTo(position: Vec3Like, rotation?: QuatLike): void;
  /** Puts it somewhere at once: it does not sweep. Without a rotation it keeps the last one. */
  teleport(position: Vec3Like, rotation?: QuatLike): void;
  /** What the cloth did to it in the last tick. Throws if it was removed. */
  readonly impulse: Impulse;
  /** Removes it. Throws if it was removed before. */
  remove(): void;
}
