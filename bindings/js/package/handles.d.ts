// Handles to the grabs, attachments and colliders of a cloth.

import type { Quat, QuatLike, Vec3, Vec3Like } from "./check.js";

/**
 * A particle that a pointer holds, made by `cloth.grabRay()` or `cloth.grabParticle()`.
 *
 * Its methods throw after `release()`, and after the cloth was reset or freed.
 */
export interface Grab {
  /** Position of the particle when it was grabbed [m]. */
  readonly position: Vec3;
  /**
   * Sets the target [m] that the particle is pulled to, and reaches evenly over the ticks of the
   * next `advance`, or in the next tick of `step`. It follows at most as fast as `maxDisplacement`
   * of the settings allows.
   *
   * @throws if the grab has ended, or if `target` is not finite
   */
  moveTo(target: Vec3Like): void;
  /**
   * Ends the grab. The particle keeps its velocity.
   *
   * @throws if the grab has ended already
   */
  release(): void;
}

/**
 * A transform that carries particles, made by `cloth.attach()`: a bone, a pole, the body of a car.
 *
 * Its members throw after `detach()`, and after the cloth was reset or freed.
 */
export interface Attachment {
  /** The attached particles, in ascending order. */
  readonly particles: Uint32Array;
  /**
   * Moves the transform to a new pose [m]. The particles reach it evenly over the ticks of the next
   * `advance`, or in the next tick of `step`, and follow the rotation on the way.
   *
   * @param rotation unit quaternion; default: the last one
   * @throws if the attachment has ended, or if the pose is wrong
   */
  moveTo(position: Vec3Like, rotation?: QuatLike): void;
  /**
   * Ends the attachment and unpins its particles, which keep their velocities.
   *
   * @throws if the attachment has ended already
   */
  detach(): void;
}

/**
 * The effect of the cloth on a collider in the last tick. Divide it by the length of a tick to get
 * force [N] and torque [N·m].
 */
export interface Impulse {
  /** Momentum that the collider received [kg·m/s]. */
  readonly linear: Vec3;
  /** Angular momentum that it received, about its own position [kg·m²/s]. */
  readonly angular: Vec3;
}

/** Position [m] and rotation, a unit quaternion. */
export interface Pose {
  readonly position: Vec3;
  readonly rotation: Quat;
}

/**
 * A collider of a cloth, made by `cloth.addCollider()` or `cloth.collideWith()`. It survives
 * `cloth.reset()`.
 *
 * Its members throw after `remove()`, and after the cloth was freed.
 */
export interface Collider {
  /**
   * Moves the collider to a new pose [m], which it reaches evenly over the ticks of the next
   * `advance`, or in the next tick of `step`. It sweeps the cloth along on the way.
   *
   * @param rotation unit quaternion; default: the last one
   * @throws if the collider was removed, or if the pose is wrong
   */
  moveTo(position: Vec3Like, rotation?: QuatLike): void;
  /**
   * Moves the collider to a new pose [m] at once, without a sweep.
   *
   * @param rotation unit quaternion; default: the last one
   * @throws if the collider was removed, or if the pose is wrong
   */
  teleport(position: Vec3Like, rotation?: QuatLike): void;
  /**
   * Gives a mesh collider new vertices, of the same number and with the same triangles: the body of a
   * character in its next pose, in the frame of the collider, x y z x y z … [m].
   *
   * Its surface reaches them evenly over the ticks of the next `advance`, or in the next tick of
   * `step`, and carries the cloth along on its way. The first call prepares the mesh for that, which
   * takes as long as adding it.
   *
   * @throws if the collider was removed or is no mesh, if the number of vertices differs, or if one
   * is not between −1e6 and 1e6; the message names it, such as `positions[71]`
   *
   * @example
   * ```js
   * const body = cloth.addCollider({ shape: "mesh", positions, indices });
   * // each frame, with the vertices of a skinned mesh:
   * body.update(skinned);
   * cloth.advance(seconds);
   * ```
   */
  update(positions: Float32Array | Float64Array | readonly number[]): void;
  /**
   * Where the collider is now: after the last tick, or where it was added or teleported to since. A
   * pose of `moveTo` counts once a tick has reached it.
   */
  readonly pose: Pose;
  /** The effect of the cloth on the collider in the last tick. */
  readonly impulse: Impulse;
  /**
   * Removes the collider from the cloth.
   *
   * @throws if it was removed already
   */
  remove(): void;
}
