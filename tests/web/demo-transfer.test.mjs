// What the demo page sends, as its server sends it, and how soon it draws.

import assert from "node:assert/strict";
import { once } from "node:events";
import { get } from "node:http";
import { test } from "node:test";
import { gunzipSync } from "node:zlib";

import { url } from "./browser.mjs";
import { visit, waitForStart, waitFrames } from "./demo-visit.mjs";

/** Most bytes that a first visit transfers. */
const MAX_BYTES = 1_100_000;

test("a first visit transfers less than 1.1 MB, compressed", async (t) => {
  for (const path of ["", "tender.html"]) {
    const requests = [];
    const visited = await visit({ path }, (page) => page.on("requestfinished", (request) => requests.push(request)));
    await waitForStart(visited);
    await waitFrames(visited.page, 1);
    const milliseconds = await visited.page.evaluate(() => performance.now());
    let sum = 0;
    for (const request of requests.filter((request) => request.url().startsWith("http"))) {
      const { responseBodySize, responseHeadersSize } = await request.sizes();
      sum += responseBodySize + responseHeadersSize;
      const headers = (await request.response()).headers();
      assert.equal(headers["content-encoding"], "gzip", `${request.url()} is not compressed`);
    }
    const page = path || "index.html";
    t.diagnostic(`${page}: ${requests.length} requests, ${sum} bytes, first frame after ${milliseconds.toFixed(0)} ms`);
    assert.ok(sum > 400_000 && sum < MAX_BYTES, `${page} transfers ${sum} bytes`);
    assert.deepEqual(visited.complaints, []);
    await visited.context.close();
  }
});

test("who takes no gzip gets the same bytes without it", async () => {
  for (const path of ["", "main.js", "muslin_demo_bg.wasm"]) {
    const [plain, packed] = [await bytes(path, {}), await bytes(path, { "accept-encoding": "gzip" })];
    assert.deepEqual([plain.coding, packed.coding], [undefined, "gzip"], path);
    assert.ok(plain.body.length > 2 * packed.body.length, `${path} has ${plain.body.length} bytes`);
    assert.ok(gunzipSync(packed.body).equals(plain.body), `${path} is another file`);
  }
});

/** Returns what the server sends for these headers, as it sends it. */
async function bytes(path, headers) {
  const [answer] = await once(get(new URL(path, url), { headers }), "response");
  const parts = [];
  for await (const part of answer) parts.push(part);
  return { coding: answer.headers["content-encoding"], body: Buffer.concat(parts) };
}
