// Every build of the package gives the same bits: with SIMD, without it, with the module embedded,
// without WebAssembly.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFile, stat } from "node:fs/promises";
import { test } from "node:test";
import { promisify } from "node:util";

const golden = (await readFile(new URL("../script.hash", import.meta.url), "utf8")).trim();

/** Returns the size of a module of the package [B]. */
async function sizeOf(name) {
  return (await stat(new URL(import.meta.resolve(`muslin/${name}`)))).size;
}

/** Runs tests/js/build.mjs and returns the object that it prints. */
async function run(...words) {
  const script = new URL("build.mjs", import.meta.url).pathname;
  const { stdout } = await promisify(execFile)(process.execPath, [script, ...words]);
  return JSON.parse(stdout);
}

/** The entry point of pages; that of Node has its module embedded. */
const page = new URL("index.js", import.meta.resolve("muslin")).href;

const BUILDS = [
  ["in Node", ["muslin"], "raw_bg.wasm"],
  ["in pages, with SIMD", [page], "raw_bg.wasm"],
  ["in pages, in an engine without SIMD", [page, "no-simd"], "plain_bg.wasm"],
  ["with its module embedded", ["muslin/inline"], "raw_bg.wasm"],
  ["in an engine without WebAssembly", ["muslin/no-wasm", "no-wasm"], undefined],
];

/** State hash of the small cloth in the first build. */
let small;

for (const [name, words, module] of BUILDS) {
  test(`the package ${name} gives the same bits`, async () => {
    const found = await run(...words);
    assert.equal(found.hash, golden);
    small ??= found.small;
    assert.match(small, /^0x[0-9a-f]{16}$/);
    assert.equal(found.small, small);
    assert.ok(found.isUnchanged && found.isRestored);
    assert.match(found.refusal, /columns/);
    if (words.includes("no-wasm")) assert.deepEqual(found.compiled, []);
    if (module) assert.deepEqual(found.compiled, [await sizeOf(module)]);
  });
}
