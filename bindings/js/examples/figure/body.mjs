// Meshes of the figure: rings of vertices around its bones, with smooth skin weights.

import { boneIndex, smooth } from "./skeleton.mjs";

// Cross-sections: height, half width, half depth, and how far the centre is in front [m].
const TRUNK = [
  [0.82, 0.09, 0.06, -0.012], [0.86, 0.148, 0.1, -0.012], [0.915, 0.164, 0.11, -0.014], [0.985, 0.15, 0.1, -0.009],
  [1.045, 0.127, 0.088, -0.002], [1.09, 0.121, 0.084, 0.001], [1.16, 0.13, 0.091, 0.004], [1.235, 0.144, 0.104, 0.009],
  [1.305, 0.15, 0.098, 0.003], [1.37, 0.15, 0.079, -0.008], [1.412, 0.124, 0.065, -0.013], [1.438, 0.08, 0.055, -0.014],
  [1.462, 0.056, 0.049, -0.011], [1.51, 0.045, 0.045, -0.004], [1.55, 0.038, 0.038, 0],
];
const LEG = [
  [0.97, 0.05, 0.053, 0], [0.93, 0.078, 0.082, 0], [0.87, 0.086, 0.091, 0], [0.8, 0.084, 0.09, 0.002],
  [0.73, 0.077, 0.084, 0.004], [0.65, 0.067, 0.074, 0.004], [0.57, 0.056, 0.063, 0.004], [0.49, 0.051, 0.056, 0.003],
  [0.41, 0.048, 0.056, -0.006], [0.33, 0.047, 0.054, -0.013], [0.22, 0.034, 0.04, -0.008], [0.11, 0.027, 0.032, 0],
  [0.06, 0.025, 0.03, 0],
];
const ARM = [
  [1.434, 0.018, 0.018, 0], [1.412, 0.041, 0.043, 0], [1.375, 0.045, 0.047, 0], [1.24, 0.035, 0.039, 0],
  [1.105, 0.029, 0.033, 0], [1.05, 0.031, 0.034, 0], [0.97, 0.027, 0.029, 0], [0.89, 0.02, 0.023, 0],
  [0.825, 0.018, 0.036, 0.006], [0.785, 0.017, 0.038, 0.008], [0.735, 0.013, 0.031, 0.005], [0.692, 0.005, 0.01, 0.003],
];
const HEAD = [
  [1.51, 0.015, 0.02, 0.026], [1.536, 0.046, 0.068, 0.014], [1.582, 0.064, 0.085, 0.01], [1.632, 0.071, 0.092, 0.008],
  [1.68, 0.067, 0.087, 0.004], [1.714, 0.05, 0.065, 0.001], [1.732, 0.026, 0.034, 0], [1.738, 0.006, 0.008, 0],
];
// Along the foot from heel to toes; the depth is vertical, and the centre is above the sole.
const FOOT = [
  [-0.06, 0.01, 0.012, 0.03], [-0.032, 0.03, 0.034, 0.036], [0.005, 0.031, 0.044, 0.046], [0.055, 0.034, 0.033, 0.034],
  [0.105, 0.04, 0.022, 0.023], [0.145, 0.037, 0.015, 0.016], [0.175, 0.012, 0.008, 0.011],
];

/** Adds a closed tube through `sections`. `weight` returns the two bones and the share of the second. */
function addTube(mesh, sections, columns, place, weight, isMirrored = false) {
  const first = mesh.positions.length / 3;
  const isDescending = sections[0][0] > sections[1][0];
  for (const [along, wide, deep, ahead] of sections) {
    const [a, b, share] = weight(along);
    for (let column = 0; column < columns; column++) {
      const angle = (2 * Math.PI * column) / columns;
      mesh.positions.push(...place([wide * Math.sin(angle), along, ahead + deep * Math.cos(angle)]));
      mesh.joints.push(boneIndex(a), boneIndex(b), 0, 0);
      mesh.weights.push(1 - share, share, 0, 0);
    }
  }
  const add = (a, b, c) => mesh.indices.push(...(isDescending !== isMirrored ? [a, c, b] : [a, b, c]));
  for (let ring = 0; ring < sections.length - 1; ring++) {
    for (let column = 0; column < columns; column++) {
      const [a, b] = [column, (column + 1) % columns].map((i) => first + ring * columns + i);
      add(a, b, a + columns);
      add(b, b + columns, a + columns);
    }
  }
  const last = first + (sections.length - 1) * columns;
  for (let column = 1; column < columns - 1; column++) {
    add(first, first + column + 1, first + column);
    add(last, last + column, last + column + 1);
  }
}

const emptyMesh = () => ({ positions: [], joints: [], weights: [], indices: [] });

/** Returns trunk and legs, which the clothes collide with: fewer than 1,500 vertices. */
export function makeBody() {
  const mesh = emptyMesh();
  addTube(mesh, TRUNK, 20, (p) => p, (y) => (y > 1.35 ? ["chest", "head", smooth(1.45, 1.53, y)] : ["hips", "chest", smooth(1.06, 1.2, y)]));
  for (const [side, x] of [["Left", 0.088], ["Right", -0.088]]) {
    addTube(mesh, LEG, 14, ([a, b, c]) => [a + x, b, c], (y) => [`thigh${side}`, `shin${side}`, 1 - smooth(0.41, 0.57, y)]);
  }
  return mesh;
}

/** Returns head, arms and feet, which are only drawn. */
export function makeLimbs() {
  const mesh = emptyMesh();
  addTube(mesh, HEAD, 24, (p) => p, () => ["head", "head", 0]);
  for (const [side, sign] of [["Left", 1], ["Right", -1]]) {
    addTube(mesh, ARM, 16, ([a, b, c]) => [a + 0.165 * sign, b, c], (y) => [`arm${side}`, `forearm${side}`, 1 - smooth(1.06, 1.15, y)]);
    // Swapping two axes mirrors the tube.
    addTube(mesh, FOOT, 16, ([a, b, c]) => [a + 0.088 * sign, c, b], () => [`foot${side}`, `foot${side}`, 0], true);
  }
  return mesh;
}
