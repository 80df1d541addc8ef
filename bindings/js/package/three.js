// Entry point `muslin/three`: the classes of three-with.js, made with the package `three`.

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  Matrix4,
  Raycaster,
  Sphere,
  Vector2,
  Vector3,
} from "three";
import { withThree } from "./three-with.js";

/** Named one by one, so that a bundler keeps only these parts of three.js. */
const parts = { Box3, BufferAttribute, BufferGeometry, DynamicDrawUsage, Matrix4, Raycaster, Sphere, Vector2, Vector3 };

export const { ClothGeometry, ClothPointers } = /* @__PURE__ */ withThree(parts);
