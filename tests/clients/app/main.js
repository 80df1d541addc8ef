// What a project with a bundler does with the package; leaves what it found in `window.result`.

import init, { Cloth, version } from "muslin";
import { Pointers } from "muslin/pointers";
import { ClothGeometry } from "muslin/three";
import { hexOf, playScript } from "./script.mjs";

async function inWorker() {
  const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
  const said = await new Promise((resolve, reject) => {
    worker.addEventListener("message", ({ data }) => resolve(data));
    worker.addEventListener("error", ({ message }) => reject(new Error(message)));
  });
  worker.terminate();
  return said;
}

async function play() {
  await init();
  const cloth = Cloth.grid();
  const vertices = new ClothGeometry(cloth).cloth.positions.length / 3;
  const pointers = new Pointers(cloth);
  pointers.press(1, [1, -1, 5], [0, 0, -1]);
  pointers.drag(1, [1.1, -1, 5], [0, 0, -1]);
  const held = pointers.size;
  cloth.free();
  return { version: version(), hash: hexOf(playScript(Cloth).stateHash()), worker: await inWorker(), vertices, held };
}

play().then((result) => (window.result = result), (error) => console.error(error));
