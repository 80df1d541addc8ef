// What cloth costs a page, beside a loop by hand: leaves its rows in `window.result`. `?test` runs all of it once and
// tiny, `?brief` only the receipt, for a second or two.

import { compare } from "/peers/compare.js";
import { receipt } from "/peers/receipt.js";
import init, { Cloth, version } from "/js/index.js";

const EFFORTS = {
  "": { rounds: 15, slice: 0.25 },
  "?brief": { rounds: 5, slice: 0.1 },
  "?test": { rounds: 1, slice: 0 },
};

async function play() {
  const { search } = location;
  await init();
  const receipts = receipt({ Cloth }, EFFORTS[search]);
  if (search === "?brief") return { receipts };
  const sides = [40];
  const rows = await compare({ Cloth }, { sides, isTest: search === "?test", say: (text) => console.log(text) });
  return { version: version(), rows, receipts };
}

window.result = await play().catch((error) => ({ error: `${error.stack ?? error}` }));
