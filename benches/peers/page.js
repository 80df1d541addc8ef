// Compares Muslin with other engines in a page; stores the rows of the tables in `window.result`.

import RAPIER from "/peers/node_modules/@dimforge/rapier3d-compat/dist/rapier.mjs";
import initJolt from "/peers/node_modules/jolt-physics/dist/jolt-physics.wasm-compat.js";
import init, { Cloth } from "/js/index.js";
import { compare, timeReading } from "./compare.js";
import { measureReceipt } from "./receipt.js";

async function run() {
  const isTest = location.search === "?test";
  await init();
  await RAPIER.init();
  const modules = { Cloth, RAPIER, Jolt: await initJolt() };
  const rows = await compare(modules, { isTest, log: (text) => console.log(text) });
  const effort = isTest ? { rounds: 1, slice: 0 } : { rounds: 15, slice: 0.25 };
  return { rows, micros: timeReading(modules, isTest), receipts: await measureReceipt(modules, effort) };
}

window.result = await run().catch((error) => ({ error: `${error.stack ?? error}` }));
