// What a page loads: `node sizes.mjs PACKAGE.tgz [--test]` prints the sizes of the parts of dist/js, raw
// and compressed, and the time of a tick with each build of the core. `--test` compresses less and times
// few ticks.

import { execFile } from "node:child_process";
import { readFile, readdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { Table } from "./table.mjs";

const [tarball, ...options] = process.argv.slice(2);
const isTest = options.includes("--test");
const dist = new URL("../../dist/js/", import.meta.url);
const read = (name) => readFile(new URL(name, dist));
const scripts = (await readdir(dist)).filter((name) => name.endsWith(".js"));

/** Scripts that only some pages load. */
const OPTIONAL = [
  ...["bytes.js", "inline.js", "light.js", "no-wasm.js", "heap.js", "code.js"],
  ...["three.js", "three-with.js", "pointers.js", "react.js"],
];

/** Name, files, and the arguments of tick.mjs for the build that is timed. */
const parts = [
  ["module with SIMD", ["raw_bg.wasm"], ["index.js"]],
  ["module without SIMD, in its place", ["plain_bg.wasm"], ["index.js", "no-simd"]],
  ["module of `muslin/light`, in its place", ["light_bg.wasm"], ["light.js"]],
  ["`muslin/inline`, in place of a module", ["inline.js", "bytes.js"], ["inline.js"]],
  ["`muslin/no-wasm`, in place of a module", ["no-wasm.js", "heap.js", "code.js"], ["no-wasm.js"]],
  ["scripts", scripts.filter((name) => !OPTIONAL.includes(name))],
  ["`muslin/three`", ["three.js", "three-with.js", "pointers.js"]],
];

/** Returns the time of a tick of a hanging sheet of 40 x 40 in a new Node process [ms]. */
async function timeTick(build) {
  const script = fileURLToPath(new URL("tick.mjs", import.meta.url));
  const { stdout } = await promisify(execFile)(process.execPath, [script, ...build, ...options]);
  return stdout.trim();
}

const formatInteger = (value) => value.toLocaleString("en");
const table = new Table(["part"], ["bytes", "gzip", "brotli", "ms per tick"]);
for (const [part, names, build] of parts) {
  const all = Buffer.concat(await Promise.all(names.map(read)));
  const small = { [constants.BROTLI_PARAM_QUALITY]: isTest ? 1 : 11, [constants.BROTLI_PARAM_SIZE_HINT]: all.length };
  const sizes = [all, gzipSync(all, { level: 9 }), brotliCompressSync(all, { params: small })];
  table.rows.push([part, ...sizes.map(({ length }) => formatInteger(length)), build ? await timeTick(build) : ""]);
}
table.rows.push(["the file that npm installs", "", formatInteger((await readFile(tarball)).length), "", ""]);
console.log(`\nms per tick: hanging sheet of 40 x 40, normals included, median, in node ${process.version}.\n\n${table}`);
