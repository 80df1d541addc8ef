// Vectors and rotations, as arguments and as results.

/** A vector [x, y, z]. */
export type Vec3 = readonly [number, number, number];

/** A rotation as a unit quaternion [x, y, z, w]. */
export type Quat = readonly [number, number, number, number];

/** A vector as an argument: an array or a typed array of exactly three numbers. */
export type Vec3Like = Vec3 | readonly number[] | Float32Array | Float64Array;

/** A unit quaternion [x, y, z, w] as an argument: exactly four numbers, of length 1. */
export type QuatLike = Quat | readonly number[] | Float32Array | Float64Array;
