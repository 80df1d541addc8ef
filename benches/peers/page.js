// The peers in a page; leaves its rows in `window.result`.

import RAPIER from "/peers/node_modules/@dimforge/rapier3d-compat/dist/rapier.mjs";
import initJolt from "/peers/node_modules/jolt-physics/dist/jolt-physics.wasm-compat.js";
import init, { Cloth } from "/js/index.js";
import { compare, reading } from "./compare.js";
import { receipt } from "./receipt.js";

async function play() {
  const isTest = location.search === "?test";
  await init();
  await RAPIER.init();
  const modules = { Cloth, RAPIER, Jolt: await initJolt() };
  const rows = await compare(modules, { isTest, say: (text) => console.log(text) });
  return { rows, micros: reading(modules, isTest), receipts: receipt(modules, isTest ? { rounds: 1, slice: 0 } : { rounds: 15, slice: 0.25 }) };
}

window.result = await play().catch((error) => ({ error: `${error.stack ?? error}` }));
