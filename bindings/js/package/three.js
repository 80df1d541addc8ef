// The classes of three-with.js, made with the package `three`.

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

/** What is named here is all that a bundler has to keep of three.js. */
const parts = { Box3, BufferAttribute, BufferGeometry, DynamicDrawUsage, Matrix4, Raycaster, Sphere, Vector2, Vector3 };

export const { ClothGeometry, ClothPointers } = /* @__PURE__ */ withThree(parts);
