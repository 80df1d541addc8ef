// `node tick.mjs SCRIPT [no-simd] [--test]` prints the time of a tick with one build of the core [ms];
// with `--test` without a warm-up.

import { cpuTime, median } from "./measure.mjs";

const [script, ...options] = process.argv.slice(2);
const warmUp = options.includes("--test") ? 0 : 3000; // ms
if (options.includes("no-simd")) WebAssembly.validate = () => false;
const { default: init, Cloth } = await import(new URL(script, new URL("../../dist/js/", import.meta.url)));
await init();
const cloth = Cloth.grid({ columns: 40, rows: 40, spacing: 2 / 39 });
const runTicks = (count) => {
  for (let tick = 0; tick < count; tick++) {
    cloth.step(1);
    cloth.normals;
  }
};
// Warm-up: until the code is optimised and the sheet hangs.
const start = performance.now();
do {
  runTicks(20);
  await new Promise(setImmediate);
} while (performance.now() - start < warmUp);
const rounds = Array.from({ length: 15 }, () => (1e3 / 20) * cpuTime(() => runTicks(20)));
console.log(median(rounds).toFixed(3));
