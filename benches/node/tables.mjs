// The tables of benches/tables once more, in wasm: `node tables.mjs PLAIN.wasm [--test]`.
//
// Needs the package in dist/js; `cargo xtask bench node` builds it and the plain loop's module.

import { readFile } from "node:fs/promises";
import init, { version } from "../../dist/js/index.js";
import { kernels } from "./kernels.mjs";
import { plainSheets } from "./sheets.mjs";
import { ticks } from "./ticks.mjs";

const [plainFile, ...options] = process.argv.slice(2);
const isTest = options.includes("--test");
const cases = JSON.parse(await readFile(new URL("../cases.json", import.meta.url), "utf8"));

await init();
const makePlain = await plainSheets(plainFile);
console.log(`Muslin ${version()}, wasm with simd128: node ${process.version} on ${process.arch}`);
await kernels(cases.kernels, makePlain, isTest);
await ticks(cases.ticks, makePlain, isTest);
