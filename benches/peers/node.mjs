// The peers in node, then in Chromium: `node node.mjs [--test]`. `cargo xtask bench peers` installs what it needs.

import RAPIER from "@dimforge/rapier3d-compat";
import initJolt from "jolt-physics";
import init, { Cloth, version } from "../../dist/js/index.js";
import { Table } from "../node/table.mjs";
import { HEAD, compare, reading } from "./compare.js";
import { RECEIPT_HEAD, receipt, receiptRows } from "./receipt.js";

const isTest = process.argv.includes("--test");

function print(where, { rows, micros, receipts }) {
  const [table, brief] = [new Table(...HEAD), new Table(...RECEIPT_HEAD)];
  table.rows.push(...rows);
  brief.rows.push(...receiptRows(receipts));
  console.log(`
Muslin ${version()} and its peers in ${where}: ms of a frame, 1/60 s and its positions and normals, of a sheet that hangs by its top
edge in still air; least and median of rounds in turn. Reading both views of Muslin's again takes ${micros.toFixed(3)} µs.
`);
  console.log(`${table}\n${brief}`);
}

await init();
await RAPIER.init();
const modules = { Cloth, RAPIER, Jolt: await initJolt() };
const say = (text) => console.error(`  ${text}`);
const rows = await compare(modules, { isTest, say });
const effort = isTest ? { rounds: 1, slice: 0 } : { rounds: 15, slice: 0.25 };
print(`node ${process.version}`, { rows, micros: reading(modules, isTest), receipts: receipt(modules, effort) });

const { MUSLIN_URL: url } = process.env;
if (url) {
  const { played } = await import("../page/chromium.mjs");
  const result = await played(`${url}?${isTest ? "test" : ""}`, say);
  print(result.where, result);
}
