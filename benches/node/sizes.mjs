// What a page loads: `node sizes.mjs PACKAGE.tgz` prints the parts of dist/js as they are, and compressed.

import { readFile, readdir } from "node:fs/promises";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { Table } from "./table.mjs";

const dist = new URL("../../dist/js/", import.meta.url);
const read = (name) => readFile(new URL(name, dist));
const scripts = (await readdir(dist)).filter((name) => name.endsWith(".js"));

/** Scripts that only some pages load. */
const EXTRA = ["bytes.js", "inline.js", "three.js", "three-with.js", "pointers.js"];

const parts = [
  ["module with vectors", ["raw_bg.wasm"]],
  ["module without vectors, in its place", ["plain_bg.wasm"]],
  ["scripts", scripts.filter((name) => !EXTRA.includes(name))],
  ["muslin/three", ["three.js", "three-with.js", "pointers.js"]],
  ["muslin/inline, in place of a module", ["inline.js", "bytes.js"]],
];

const table = new Table(["part"], ["bytes", "gzip", "brotli"]);
for (const [part, names] of parts) {
  const all = Buffer.concat(await Promise.all(names.map(read)));
  const small = { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_SIZE_HINT]: all.length };
  const sizes = [all, gzipSync(all, { level: 9 }), brotliCompressSync(all, { params: small })];
  table.rows.push([part, ...sizes.map(({ length }) => length.toLocaleString("en"))]);
}
const [tarball] = process.argv.slice(2);
table.rows.push(["the file that npm installs", "", (await readFile(tarball)).length.toLocaleString("en"), ""]);
console.log(`\n${table}`);
