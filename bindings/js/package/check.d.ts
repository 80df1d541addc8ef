// Numbers as they are given and taken.

/** x, y, z; read from an array or a typed array of three numbers. */
export type Vec3 = readonly [number, number, number];

/** x, y, z, w: a unit quaternion. */
export type Quat = readonly [number, number, number, number];

/** Three numbers as you have them. */
export type Vec3Like = Vec3 | readonly number[] | Float32Array | Float64Array;

/** Four numbers as you have them. */
export type QuatLike = Quat | readonly number[] | Float32Array | Float64Array;
