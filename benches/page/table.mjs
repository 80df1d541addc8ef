// The table of a page: `node table.mjs [--test]`. `cargo xtask bench page` serves what it needs.

import { Table } from "../node/table.mjs";
import { HEAD } from "../peers/compare.js";
import { RECEIPT_HEAD, receiptRows } from "../peers/receipt.js";
import { played } from "./chromium.mjs";

const say = (text) => console.error(`  ${text}`);
const search = process.argv.includes("--test") ? "?test" : "";
const { where, version, rows, receipts } = await played(process.env.MUSLIN_URL + search, say);
const [table, brief] = [new Table(...HEAD), new Table(...RECEIPT_HEAD)];
table.rows.push(...rows);
brief.rows.push(...receiptRows(receipts));
console.log(`
Muslin ${version} in ${where}: ms of a frame, 1/60 s and its positions and normals, of a sheet that hangs by its top edge in
still air; and of a tick, 1/120 s and normals, of the receipt of the brief, whose particles push each other apart. Least and
median of rounds.
`);
console.log(`${table}\n${brief}`);
