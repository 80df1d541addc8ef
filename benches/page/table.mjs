// Prints the tables of a page: `node table.mjs [--test]`. `cargo xtask bench page` serves the page.

import { Table } from "../node/table.mjs";
import { HEAD } from "../peers/compare.js";
import { RECEIPT_HEAD, receiptRows } from "../peers/receipt.js";
import { runPage } from "./chromium.mjs";

const log = (text) => console.error(`  ${text}`);
const search = process.argv.includes("--test") ? "?test" : "";
const { where, version, rows, receipts } = await runPage(process.env.MUSLIN_URL + search, log);
const [table, brief] = [new Table(...HEAD), new Table(...RECEIPT_HEAD)];
table.rows.push(...rows);
brief.rows.push(...receiptRows(receipts));
console.log(`
Muslin ${version} in ${where}: ms per frame of 1/60 s with positions and normals, for a sheet that hangs by its top edge in
still air; and ms per tick of 1/120 s with normals, for the receipt of the brief with particle collision. Minimum and median of
rounds.
`);
console.log(`${table}\n${brief}`);
