// The page that tests/clean-root/react.sh built shows a cloth that moves.

import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { launch, open, url, variable } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

test("the page of the README in a new project of Vite and React draws a cloth that moves", async () => {
  const { context, page, complaints } = await open(browser, { viewport: { width: 640, height: 480 } });
  await page.goto(url);
  const canvas = page.locator("canvas");
  await canvas.waitFor();
  // react-three-fiber sets the size of the canvas in a frame after the first.
  const hasFilled = page.waitForFunction(() => document.querySelector("canvas").clientHeight === innerHeight, null, { timeout: 5000 });
  await hasFilled.catch(() => {});
  const box = await canvas.boundingBox();
  const first = await page.screenshot();
  await page.waitForTimeout(1000);
  assert.notDeepEqual(await page.screenshot(), first, "the picture does not change");
  await page.screenshot({ path: join(variable("MUSLIN_WORK"), "react.png") });
  assert.equal(box.height, 480, "the canvas is not as high as the page");
  // react-three-fiber uses a class of three.js that is out of date.
  assert.deepEqual(complaints.filter((text) => !text.includes("THREE.Clock")), []);
  await context.close();
});
