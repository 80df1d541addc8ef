// A page under the content security policy `script-src 'self'`: it draws a cloth that a pointer can
// drag.

import init, { Cloth, version } from "./node_modules/muslin/no-wasm.js";
import { withThree } from "./node_modules/muslin/three-with.js";
import * as THREE from "../vendor/three.module.js";
import { hexOf, playScript } from "./script.mjs";

let isForbidden = false;
try {
  new WebAssembly.Module(Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0));
} catch {
  isForbidden = true;
}
await init();
const { ClothGeometry, ClothPointers } = withThree(THREE);
const canvas = document.querySelector("canvas");
const camera = new THREE.PerspectiveCamera(40, canvas.width / canvas.height, 0.1, 50);
camera.position.z = 3.4;
const sheet = new THREE.Mesh(
  new ClothGeometry(Cloth.grid({ origin: [-1, 1, 0], pinMode: "top-corners" })),
  new THREE.MeshNormalMaterial({ side: THREE.DoubleSide }),
);
const scene = new THREE.Scene().add(sheet);
const renderer = new THREE.WebGLRenderer({ canvas, preserveDrawingBuffer: true });
const pointers = new ClothPointers(sheet, camera, canvas);
const { cloth } = sheet.geometry;
renderer.setAnimationLoop(() => {
  cloth.step(1);
  sheet.geometry.update();
  renderer.render(scene, camera);
  const { size: held } = pointers;
  const right = cloth.positions.reduce((max, x, i) => (i % 3 === 0 ? Math.max(max, x) : max), -Infinity);
  window.pulled = { held, right };
});

const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
worker.addEventListener("message", ({ data }) => {
  window.result = { version: version(), hash: hexOf(playScript(Cloth).stateHash()), worker: data, isForbidden };
});
