// The page of the receipt scene, used by pointer, touch and keys.

import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";

import { variable } from "./browser.mjs";
import {
  cameraPosition,
  checkShareMetadata,
  distance,
  fingers,
  hash,
  particle,
  stats,
  visit,
  waitForStart,
  waitFrames,
  waitUntil,
} from "./demo-visit.mjs";

const shots = variable("MUSLIN_SHOTS");
/** A particle in the middle of the last row, by the number of particles of the sheet. */
const BOTTOM_PARTICLES = { 2400: 59 * 40 + 20, 864: 35 * 24 + 12 };

async function visitReceipt(options, prepare) {
  const visited = await visit({ path: "tender.html", ...options }, prepare);
  await waitForStart(visited);
  return visited;
}

const bottomParticle = async (page) => BOTTOM_PARTICLES[(await stats(page)).particles];
const isOn = (page, name) => page.evaluate((name) => window.muslinDemo.isOn(name), name);

test("the receipt has a page of its own, which fits a wide and a tall screen", async () => {
  for (const [width, height, hasTouch] of [[1280, 720, false], [390, 844, true]]) {
    const { context, page, complaints } = await visitReceipt({ viewport: { width, height }, deviceScaleFactor: 1, hasTouch });
    assert.equal(await page.title(), "Tender — Receipt Paper Physics");
    assert.equal((await stats(page)).particles, hasTouch ? 24 * 36 : 40 * 60);
    await checkShareMetadata(page);
    const instructions = page.locator("#instructions");
    assert.match(await instructions.textContent(), /Click and drag to grab the paper/);
    await page.waitForFunction(() => getComputedStyle(document.getElementById("instructions")).opacity === "0");
    const box = await page.locator("#stage").boundingBox();
    assert.deepEqual([box.x, box.y, box.width, box.height], [0, 0, width, height]);
    const keyless = ["paused", "counter"].map((name) => page.locator(`#control-${name}`));
    for (const pill of keyless) assert.equal(await pill.isVisible(), hasTouch);
    for (const pill of await page.locator("#pills button:visible").all()) {
      const { x, y, width: wide, height: high } = await pill.boundingBox();
      assert.ok(x >= 0 && x + wide <= width && y + high <= height && high >= (hasTouch ? 44 : 36));
    }
    const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wider <= 0, `the page is ${wider} pixels wider than the screen`);
    await page.screenshot({ path: join(shots, `tender-${width}x${height}.png`) });
    assert.deepEqual(complaints, []);
    await context.close();
  }
});

test("a drag moves the receipt, R resets it, and a drag with the right button turns the camera", async () => {
  const { context, page, complaints } = await visitReceipt();
  const grabbed = await bottomParticle(page);
  const from = await particle(page, grabbed);
  const before = await cameraPosition(page);
  await page.mouse.move(...from);
  await page.mouse.down();
  const to = [from[0] + 70, from[1] - 60];
  await page.mouse.move(...to, { steps: 6 });
  await waitUntil(page, () => particle(page, grabbed), (now) => distance(now, to) < 25, `it did not come to ${to}`);
  assert.ok(distance(await cameraPosition(page), before) < 0.02, "the camera turned with the drag");
  await page.mouse.up();
  await page.keyboard.press("r");
  const isBack = (now) => distance(now, from) < 8;
  await waitUntil(page, () => particle(page, grabbed), isBack, "it did not come back");
  await page.mouse.move(350, 200);
  await page.mouse.down({ button: "right" });
  await page.mouse.move(430, 200, { steps: 4 });
  await page.mouse.up({ button: "right" });
  await waitUntil(page, () => cameraPosition(page), (now) => distance(now, before) > 1, "the camera did not turn");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("space pauses and shows its overlay, I shows the counter, and W and the buttons switch their settings", async () => {
  const { context, page, complaints } = await visitReceipt();
  const paused = page.locator("#paused");
  assert.equal(await paused.isVisible(), false);
  await page.keyboard.press(" ");
  await paused.waitFor({ state: "visible" });
  assert.equal(await paused.innerText(), "PAUSED — press Space");
  await waitFrames(page, 2);
  const still = await hash(page);
  await waitFrames(page, 4);
  assert.equal(await hash(page), still, "the sheet moved while paused");
  await page.keyboard.press(" ");
  await paused.waitFor({ state: "hidden" });
  const counter = page.locator("#counter");
  assert.equal(await counter.isVisible(), false);
  await page.keyboard.press("i");
  await counter.waitFor({ state: "visible" });
  await page.waitForFunction(() => /^864/.test(document.getElementById("stat-particles").textContent));
  await page.keyboard.press("w");
  assert.equal(await isOn(page, "wind"), true);
  const wind = page.locator("#control-wind");
  assert.equal(await wind.getAttribute("aria-pressed"), "true");
  // Tab goes from button to button, each with a focus ring, and Enter presses it.
  await wind.focus();
  await page.keyboard.press("Enter");
  assert.equal(await isOn(page, "wind"), false);
  const reached = [];
  for (let i = 0; i < 5; i++) {
    await page.keyboard.press("Tab");
    reached.push(await page.evaluate(() => {
      const focused = document.activeElement;
      return [focused.id, getComputedStyle(focused).outlineStyle];
    }));
  }
  assert.deepEqual(reached.map(([id]) => id), ["drop", "crumple", "fold", "sheet", "reset"].map((name) => `control-${name}`));
  for (const [id, ring] of reached) assert.notEqual(ring, "none", `${id} has no focus ring`);
  await page.locator("#control-sheet").click();
  assert.equal(await isOn(page, "sheet"), false);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("on a phone the text is above the pins, and fingers pause and show the counter", async () => {
  const phone = { viewport: { width: 390, height: 844 }, hasTouch: true };
  const { context, page, complaints } = await visitReceipt(phone);
  const text = await page.locator("#instructions").boundingBox();
  const pins = () => Promise.all([0, 23].map((i) => particle(page, i)));
  const below = (pins) => pins.every(([, y]) => y > text.y + text.height + 8);
  await waitUntil(page, pins, below, `the pins are not below ${text.y + text.height}`);
  const pills = await page.locator("#pills").boundingBox();
  const [, bottom] = await particle(page, await bottomParticle(page));
  assert.ok(bottom < pills.y, `the paper ends at ${bottom}, the pills begin at ${pills.y}`);
  await page.locator("#control-paused").tap();
  const paused = page.locator("#paused");
  await paused.waitFor({ state: "visible" });
  assert.equal(await paused.innerText(), "PAUSED — press Pause");
  await waitFrames(page, 2);
  const still = await hash(page);
  await waitFrames(page, 4);
  assert.equal(await hash(page), still, "the sheet moved while paused");
  await page.locator("#control-paused").tap();
  await paused.waitFor({ state: "hidden" });
  await page.locator("#control-counter").tap();
  await page.locator("#counter").waitFor({ state: "visible" });
  const [counter, title] = [await page.locator("#counter").boundingBox(), await page.locator("h1").boundingBox()];
  assert.ok(counter.x > title.x && counter.x + counter.width <= 390, JSON.stringify([counter, title]));
  assert.deepEqual(complaints, []);
  await context.close();
});

test("two fingers hold two corners, and reduced motion starts the small sheet", async () => {
  const { context, page, complaints } = await visitReceipt({ hasTouch: true, reducedMotion: "reduce" });
  assert.equal((await stats(page)).particles, 24 * 36);
  await page.locator("#control-wind").click();
  const corners = [35 * 24 + 1, 35 * 24 + 22];
  const from = await Promise.all(corners.map((i) => particle(page, i)));
  const touch = await fingers(page);
  await touch("touchStart", from[0]);
  await touch("touchStart", ...from);
  const to = from.map(([x, y], i) => [x + (i ? 12 : -4), y - 50]);
  await touch("touchMove", ...to);
  for (const i of [0, 1]) {
    const near = (now) => distance(now, to[i]) < 25;
    await waitUntil(page, () => particle(page, corners[i]), near, `finger ${i} does not hold its corner`);
  }
  await touch("touchEnd");
  assert.deepEqual(complaints, []);
  await context.close();
});
