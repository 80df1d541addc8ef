// Runs the script of tests/js/script.mjs in a page and stores the result in `window.result`.

import init, { Cloth } from "/js/index.js";
import { hexOf, playScript } from "/tests/js/script.mjs";

async function run() {
  await init();
  const golden = (await (await fetch("/tests/script.hash")).text()).trim();
  const cloth = playScript(Cloth);
  const hash = hexOf(cloth.stateHash());
  const isFinite = cloth.positions.every(Number.isFinite) && cloth.normals.every(Number.isFinite);
  cloth.free();
  return { hash, ok: isFinite && hash === golden, errors: [] };
}

window.result = await run().catch((error) => ({ ok: false, errors: [`${error.stack ?? error}`] }));
