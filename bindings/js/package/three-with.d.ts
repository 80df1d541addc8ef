import type * as Three from "three";
import type { ClothGeometry, ClothPointers } from "./three.js";

/** What of three.js is used: the whole module will do. */
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
 * The classes of `muslin/three`, made with the three.js that you give: one that lies in your own folder, where
 * no bundler or import map says what `"three"` is, or `three/webgpu`. Release 159 or newer. Call it once.
 *
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
