// Compares Muslin with other engines in Node, then in Chromium: `node node.mjs [--test]`. `cargo
// xtask bench peers` installs what it needs.

import RAPIER from "@dimforge/rapier3d-compat";
import initJolt from "jolt-physics";
import init, { Cloth, version } from "../../dist/js/index.js";
import { Table } from "../node/table.mjs";
import { HEAD, compare, timeReading } from "./compare.js";
import { RECEIPT_HEAD, measureReceipt, receiptRows } from "./receipt.js";

const isTest = process.argv.includes("--test");

function print(where, { rows, micros, receipts }) {
  const [table, brief] = [new Table(...HEAD), new Table(...RECEIPT_HEAD)];
  table.rows.push(...rows);
  brief.rows.push(...receiptRows(receipts));
  console.log(`
Muslin ${version()} and its peers in ${where}: ms per frame of 1/60 s with positions and normals, for a sheet that hangs by its
top edge in still air; minimum and median of interleaved rounds. Reading both views of Muslin again takes ${micros.toFixed(3)} µs.
`);
  console.log(`${table}\n${brief}`);
}

await init();
await RAPIER.init();
const modules = { Cloth, RAPIER, Jolt: await initJolt() };
const log = (text) => console.error(`  ${text}`);
const rows = await compare(modules, { isTest, log });
const effort = isTest ? { rounds: 1, slice: 0 } : { rounds: 15, slice: 0.25 };
print(`node ${process.version}`, { rows, micros: timeReading(modules, isTest), receipts: await measureReceipt(modules, effort) });

const { MUSLIN_URL: url } = process.env;
if (url) {
  const { runPage } = await import("../page/chromium.mjs");
  const result = await runPage(`${url}?${isTest ? "test" : ""}`, log);
  print(result.where, result);
}
