// A project with a bundler: uses the package and stores its findings in `window.result`.

import init, { Cloth, version } from "muslin";
import { Pointers } from "muslin/pointers";
import { ClothGeometry } from "muslin/three";
import { hexOf, playScript } from "./script.mjs";

/** Returns the hash of the script in a worker. */
async function hashInWorker() {
  const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
  const hash = await new Promise((resolve, reject) => {
    worker.addEventListener("message", ({ data }) => resolve(data));
    worker.addEventListener("error", ({ message }) => reject(new Error(message)));
  });
  worker.terminate();
  return hash;
}

async function run() {
  await init();
  const cloth = Cloth.grid();
  const vertices = new ClothGeometry(cloth).cloth.positions.length / 3;
  const pointers = new Pointers(cloth);
  pointers.press(1, [1, -1, 5], [0, 0, -1]);
  pointers.drag(1, [1.1, -1, 5], [0, 0, -1]);
  const held = pointers.size;
  cloth.free();
  return { version: version(), hash: hexOf(playScript(Cloth).stateHash()), worker: await hashInWorker(), vertices, held };
}

run().then((result) => (window.result = result), (error) => console.error(error));
