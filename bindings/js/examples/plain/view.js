// A camera that looks at a sheet of 2 m from far enough to see all of it.

const SLOPE = 0.36; // tangent of half the vertical field of view
const MIDDLE = -0.18; // height of the camera [m]
const [NEAR, FAR] = [0.5, 60];

const distance = (aspect) => 1.5 / (SLOPE * Math.min(aspect, 1.05));

/** Returns the view-projection matrix in column-major order. */
export function perspective(aspect) {
  const [x, y, z] = [1 / (SLOPE * aspect), 1 / SLOPE, -(FAR + NEAR) / (FAR - NEAR)];
  const eyeDistance = distance(aspect);
  const depth = (-2 * FAR * NEAR) / (FAR - NEAR);
  return [x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, -1, 0, -y * MIDDLE, -z * eyeDistance + depth, eyeDistance];
}

/**
 * Returns the origin and direction of the ray through a point of the picture; x and y are from -1
 * to 1.
 */
export function eyeRay(x, y, aspect) {
  return [[0, MIDDLE, distance(aspect)], [x * SLOPE * aspect, y * SLOPE, -1]];
}
