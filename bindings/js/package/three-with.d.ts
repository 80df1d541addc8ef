import type * as Three from "three";
import type { ClothGeometry, ClothPointers } from "./three.js";

/** The parts of three.js that are used. You can pass the whole module. */
export type ThreeParts = Pick<
  typeof Three,
  | "Box3"
  | "BufferAttribute"
  | "BufferGeometry"
  | "DynamicDrawUsage"
  | "Matrix4"
  | "Raycaster"
  | "Sphere"
  | "Vector2"
  | "Vector3"
>;

/**
 * Makes the classes of `muslin/three` for the three.js that you pass. Use it if no bundler or
 * import map resolves `"three"`, or with `three/webgpu`. It needs release 159 or newer. Call it
 * once: each call makes new classes.
 *
 * @example
 * ```js
 * import * as THREE from "./vendor/three.module.js";
 * import { withThree } from "./muslin/three-with.js";
 * const { ClothGeometry, ClothPointers } = withThree(THREE);
 * ```
 */
export function withThree(three: ThreeParts): {
  ClothGeometry: typeof ClothGeometry;
  ClothPointers: typeof ClothPointers;
};
