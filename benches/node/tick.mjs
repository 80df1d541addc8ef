// `node tick.mjs SCRIPT [no-vectors]`: what a tick takes with one way to have the core [ms].

import { median, seconds } from "./measure.mjs";

const [script, lacks] = process.argv.slice(2);
if (lacks === "no-vectors") WebAssembly.validate = () => false;
const { default: init, Cloth } = await import(new URL(script, new URL("../../dist/js/", import.meta.url)));
await init();
const cloth = Cloth.grid({ columns: 40, rows: 40, spacing: 2 / 39 });
const ticks = (count) => {
  for (let tick = 0; tick < count; tick++) {
    cloth.step(1);
    cloth.normals;
  }
};
// Until what is hot is compiled well, and the sheet hangs.
const start = performance.now();
do {
  ticks(20);
  await new Promise(setImmediate);
} while (performance.now() - start < 3000);
const rounds = Array.from({ length: 15 }, () => (1e3 / 20) * seconds(() => ticks(20)));
console.log(median(rounds).toFixed(3));
