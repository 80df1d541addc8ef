// What a page loads: `node sizes.mjs PACKAGE.tgz` prints the parts of dist/js as they are, and compressed, and what a
// tick takes with each way to have the core.

import { execFile } from "node:child_process";
import { readFile, readdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { Table } from "./table.mjs";

const dist = new URL("../../dist/js/", import.meta.url);
const read = (name) => readFile(new URL(name, dist));
const scripts = (await readdir(dist)).filter((name) => name.endsWith(".js"));

/** Scripts that only some pages load. */
const EXTRA = [
  ...["bytes.js", "inline.js", "no-wasm.js", "heap.js", "code.js"],
  ...["three.js", "three-with.js", "pointers.js"],
];

/** Parts, and the build whose ticks are timed for it. */
const parts = [
  ["module with vectors", ["raw_bg.wasm"], ["index.js"]],
  ["module without vectors, in its place", ["plain_bg.wasm"], ["index.js", "no-vectors"]],
  ["`muslin/inline`, in place of a module", ["inline.js", "bytes.js"], ["inline.js"]],
  ["`muslin/no-wasm`, in place of a module", ["no-wasm.js", "heap.js", "code.js"], ["no-wasm.js"]],
  ["scripts", scripts.filter((name) => !EXTRA.includes(name))],
  ["`muslin/three`", ["three.js", "three-with.js", "pointers.js"]],
];

/** What a tick of a hanging sheet of 40 x 40 takes in a node of its own [ms]. */
async function tick(build) {
  const script = fileURLToPath(new URL("tick.mjs", import.meta.url));
  const { stdout } = await promisify(execFile)(process.execPath, [script, ...build]);
  return stdout.trim();
}

const number = (value) => value.toLocaleString("en");
const table = new Table(["part"], ["bytes", "gzip", "brotli", "ms a tick"]);
for (const [part, names, build] of parts) {
  const all = Buffer.concat(await Promise.all(names.map(read)));
  const small = { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_SIZE_HINT]: all.length };
  const sizes = [all, gzipSync(all, { level: 9 }), brotliCompressSync(all, { params: small })];
  table.rows.push([part, ...sizes.map(({ length }) => number(length)), build ? await tick(build) : ""]);
}
const [tarball] = process.argv.slice(2);
table.rows.push(["the file that npm installs", "", number((await readFile(tarball)).length), "", ""]);
console.log(`\nOf a hanging sheet of 40 x 40, normals included: median of ticks in node ${process.version}.\n\n${table}`);
