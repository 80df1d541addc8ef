// As app/main.js, without a bundler: every import is a full path.

import init, { Cloth, version } from "./node_modules/muslin/index.js";
import { Pointers } from "./node_modules/muslin/pointers.js";
import { withThree } from "./node_modules/muslin/three-with.js";
import * as THREE from "../vendor/three.module.js";
import { hexOf, playScript } from "./script.mjs";

await init();
const { ClothGeometry } = withThree(THREE);
const cloth = Cloth.grid();
const vertices = new ClothGeometry(cloth).cloth.positions.length / 3;
const pointers = new Pointers(cloth);
pointers.press(1, [1, -1, 5], [0, 0, -1]);
pointers.drag(1, [1.1, -1, 5], [0, 0, -1]);
const held = pointers.size;
cloth.free();
const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
worker.addEventListener("message", ({ data }) => {
  window.result = { version: version(), hash: hexOf(playScript(Cloth).stateHash()), worker: data, vertices, held };
});
