// Grabs, attachments and colliders of a cloth, and the descriptor of a collider.

import type { Quat, QuatLike, Vec3, Vec3Like } from "./check.js";
import type { Shape } from "./fields.js";

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
 * A collider: its shape, its pose and its surface. Fields that the shape does not use are ignored.
 *
 * @example
 * ```js
 * cloth.addCollider({ shape: "sphere", position: [0, 1, 0], radius: 0.4, friction: 0.6 });
 * ```
 */
export interface ColliderDesc {
  /** The shape. @defaultValue "plane" */
  shape?: Shape;
  /** Position of the local frame [m]. @defaultValue [0, 0, 0] */
  position?: Vec3Like;
  /** Rotation of the local frame, a unit quaternion. @defaultValue [0, 0, 0, 1] */
  rotation?: QuatLike;
  /** Coulomb friction coefficient; −1 means that of the material. @defaultValue -1 */
  friction?: number;
  /** Restitution, 0 to 1; −1 means that of the material. @defaultValue -1 */
  restitution?: number;
  /**
   * Share of the sliding velocity that remains after each substep of contact, 0 to 1, in addition
   * to friction. 1 has no effect.
   *
   * @defaultValue 1
   */
  tangentialRestitution?: number;
  /**
   * Gap that the cloth keeps from the surface [m]; −1 means the thickness of the material. On
   * curved surfaces particles stay farther away, by as much as the flat triangles between them
   * would penetrate: a fifth of the mean edge at most on spheres and capsules, a tenth on other
   * shapes.
   *
   * @defaultValue -1
   */
  thickness?: number;
  /** Sphere, capsule: radius [m]; above 0. @defaultValue 0.5 */
  radius?: number;
  /** Capsule: radius of the upper end [m]; above 0, or −1 for `radius`. @defaultValue -1 */
  topRadius?: number;
  /**
   * Capsule: distance from its centre to the centres of its ends [m]; at least 0.
   *
   * @defaultValue 0.5
   */
  halfHeight?: number;
  /** Box: distances from its centre to its faces [m]; above 0. @defaultValue [0.5, 0.5, 0.5] */
  halfExtents?: Vec3Like;
  /** Heightfield: distance between heights [m]; above 0. @defaultValue 1 */
  spacing?: number;
  /** Heightfield: number of heights along x, 2 to 4096. */
  columns?: number;
  /** Heightfield: number of heights along z, 2 to 4096. */
  rows?: number;
  /**
   * Mesh: largest depth from which particles inside are pushed out [m]; at least 0 and below 1e6. 0:
   * both sides of its triangles are outside. Above 0 the mesh must be closed and consistently wound:
   * every edge in two triangles, once in each direction. Normals may point inward or outward.
   * Particles move towards the closest point of the surface at 0.05 m/s. Each tick makes one
   * closest-point query per particle in the bounds of the mesh.
   *
   * @defaultValue 0
   */
  solid?: number;
  /** Convex hull (at most 1024 points), mesh: points x y z x y z … [m]. They are copied. */
  positions?: Float32Array | Float64Array | readonly number[];
  /** Mesh: three points per triangle. They are copied. */
  indices?: Uint32Array | Uint16Array | readonly number[];
  /** Heightfield: `columns` × `rows` heights [m], row by row along x. They are copied. */
  heights?: Float32Array | Float64Array | readonly number[];
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
