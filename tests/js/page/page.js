// Plays the script in a page and leaves what came out in `window.result`.

import init, { Cloth } from "/js/index.js";
import { hexOf, playScript } from "/tests/js/script.mjs";

async function play() {
  await init();
  const golden = (await (await fetch("/tests/script.hash")).text()).trim();
  const cloth = playScript(Cloth);
  const hash = hexOf(cloth.stateHash());
  const drawable = cloth.positions.every(Number.isFinite) && cloth.normals.every(Number.isFinite);
  cloth.free();
  return { hash, ok: drawable && hash === golden, errors: [] };
}

window.result = await play().catch((error) => ({ ok: false, errors: [`${error.stack ?? error}`] }));
