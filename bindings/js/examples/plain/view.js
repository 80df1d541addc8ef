// A camera that looks at a sheet of 2 m, from as far as it takes to see all of it.

const SLOPE = 0.36; // half a picture's height, a metre ahead
const MIDDLE = -0.18;
const [NEAR, FAR] = [0.5, 60];

const distance = (aspect) => 1.5 / (SLOPE * Math.min(aspect, 1.05));

/** The matrix for a shader, columns first. */
export function perspective(aspect) {
  const [x, y, z] = [1 / (SLOPE * aspect), 1 / SLOPE, -(FAR + NEAR) / (FAR - NEAR)];
  const away = distance(aspect);
  const depth = (-2 * FAR * NEAR) / (FAR - NEAR);
  return [x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, -1, 0, -y * MIDDLE, -z * away + depth, away];
}

/** The ray at a place of the picture, each from -1 to 1: where it starts and where it goes. */
export function eyeRay(x, y, aspect) {
  return [[0, MIDDLE, distance(aspect)], [x * SLOPE * aspect, y * SLOPE, -1]];
}
