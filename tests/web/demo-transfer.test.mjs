// What the demo page sends, as its server sends it, and how soon it draws.

import assert from "node:assert/strict";
import { test } from "node:test";

import { visit, visitRunning, waitForStart, waitFrames } from "./demo-visit.mjs";

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

test("the page works from a server that sends nothing compressed", async () => {
  const codings = [];
  const plain = async (page) => {
    await page.route("**/*", (route) => route.continue({ headers: { ...route.request().headers(), "accept-encoding": "identity" } }));
    page.on("response", (response) => codings.push(response.headers()["content-encoding"]));
  };
  const { context, page, complaints } = await visitRunning({}, plain);
  await waitFrames(page, 2);
  assert.ok(codings.length > 5 && codings.every((coding) => coding === undefined), `${codings}`);
  assert.deepEqual(complaints, []);
  await context.close();
});
