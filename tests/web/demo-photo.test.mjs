// The photo mode of the demo page: by key, by button, by touch; the saved file.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";

import { variable } from "./browser.mjs";
import {
  MIDDLE,
  cameraPosition,
  distance,
  fingers,
  hash,
  particle,
  visitRunning,
  waitFrames,
  waitUntil,
} from "./demo-visit.mjs";

const OVERLAYS = ["#panel", "#ask", "footer", "#help"];

test("the photo mode hides all overlays, holds time, still orbits, and saves a picture of 3840 x 2160", async () => {
  const { context, page, complaints } = await visitRunning();
  await page.keyboard.press("o");
  const save = page.locator("#photo-save");
  await save.waitFor({ state: "visible" });
  for (const overlay of OVERLAYS) assert.equal(await page.locator(overlay).isVisible(), false, overlay);
  assert.equal(await page.evaluate(() => document.activeElement.id), "photo-save");
  const still = await hash(page);
  const eye = await cameraPosition(page);
  await page.mouse.move(...(await particle(page, MIDDLE)));
  await page.mouse.down();
  await page.mouse.move(200, 200, { steps: 5 });
  await page.mouse.up();
  await waitUntil(page, () => cameraPosition(page), (at) => distance(at, eye) > 0.1, "the drag did not orbit");
  assert.equal(await hash(page), still, "time did not stand still");

  const download = page.waitForEvent("download");
  await save.focus();
  await page.keyboard.press("Enter");
  const file = await download;
  assert.equal(file.suggestedFilename(), "muslin-sheet.png");
  const path = join(variable("MUSLIN_SHOTS"), "web-photo.png");
  await file.saveAs(path);
  const bytes = await readFile(path);
  assert.equal(bytes.toString("latin1", 1, 4), "PNG");
  assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [3840, 2160]);
  await page.locator("#photo-status", { hasText: /^Saved$/ }).waitFor();
  assert.equal(await hash(page), still, "the picture moved the cloth");

  await page.keyboard.press("Escape");
  await page.locator("#panel").waitFor({ state: "visible" });
  assert.equal(await page.locator("#photo").isVisible(), false);
  await waitUntil(page, () => hash(page), (now) => now !== still, "the cloth does not move again");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("on a phone the photo mode begins and ends by touch, with large targets and an upright picture", async () => {
  const phone = { viewport: { width: 390, height: 700 }, hasTouch: true };
  const { context, page, complaints } = await visitRunning(phone);
  await page.locator("#collapse").tap();
  await page.locator("#control-photo").tap();
  await page.locator("#photo").waitFor({ state: "visible" });
  assert.equal(await page.locator("#photo-save").textContent(), "Save 2160 × 3840");
  for (const button of await page.locator("#photo button").all()) {
    const box = await button.boundingBox();
    assert.ok(box.height >= 44 && box.width >= 44 && box.x >= 0 && box.x + box.width <= 390, JSON.stringify(box));
  }
  const eye = await cameraPosition(page);
  const touch = await fingers(page);
  await touch("touchStart", [190, 300]);
  await touch("touchMove", [120, 300]);
  await touch("touchEnd");
  await waitUntil(page, () => cameraPosition(page), (at) => distance(at, eye) > 0.1, "a finger did not orbit");
  await waitFrames(page, 2);
  await page.locator("#photo-leave").tap();
  await page.locator("#ask").waitFor({ state: "visible" });
  assert.equal(await page.locator("#photo").isVisible(), false);
  assert.deepEqual(complaints, []);
  await context.close();
});
