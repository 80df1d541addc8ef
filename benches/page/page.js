// Benchmarks in a page: Muslin and a hand-written loop. Stores the rows of the tables in
// `window.result`. `?test` runs everything once in a small size, `?brief` only the receipt for a
// second or two. A test that opens the page may offer `window.threadTime`: then the receipt is timed by
// processor time.

import { compare } from "/peers/compare.js";
import { measureReceipt } from "/peers/receipt.js";
import init, { Cloth, version } from "/js/index.js";

/** Rounds and seconds per round, by the query of the page. */
const EFFORTS = {
  "": { rounds: 15, slice: 0.25 },
  "?brief": { rounds: 5, slice: 0.1 },
  "?test": { rounds: 1, slice: 0 },
};

async function run() {
  const { search } = location;
  await init();
  const receipts = await measureReceipt({ Cloth }, EFFORTS[search], window.threadTime);
  if (search === "?brief") return { receipts };
  const sides = [40];
  const rows = await compare({ Cloth }, { sides, isTest: search === "?test", log: (text) => console.log(text) });
  return { version: version(), rows, receipts };
}

window.result = await run().catch((error) => ({ error: `${error.stack ?? error}` }));
