// Prints the tables `kernels` and `ticks` of benches/tables for wasm: `node tables.mjs PLAIN.wasm
// [--test]`.
//
// Needs the package in dist/js and the module of benches/plain; `cargo xtask bench node` builds
// both.

import { readFile } from "node:fs/promises";
import init, { version } from "../../dist/js/index.js";
import { printKernels } from "./kernels.mjs";
import { loadPlainSheets } from "./sheets.mjs";
import { printTicks } from "./ticks.mjs";

const [plainFile, ...options] = process.argv.slice(2);
const isTest = options.includes("--test");
const cases = JSON.parse(await readFile(new URL("../cases.json", import.meta.url), "utf8"));

await init();
const makePlain = await loadPlainSheets(plainFile);
console.log(`Muslin ${version()}, wasm with simd128: node ${process.version} on ${process.arch}`);
await printKernels(cases.kernels, makePlain, isTest);
await printTicks(cases.ticks, makePlain, isTest);
