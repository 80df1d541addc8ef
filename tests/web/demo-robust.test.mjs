// Robustness of the demo page: resizing, hidden tabs, long frames, lost contexts, no WebGL, random
// input.

import assert from "node:assert/strict";
import { test } from "node:test";

import {
  MIDDLE,
  distance,
  fingers,
  hash,
  particle,
  state,
  stats,
  visit,
  visitRunning,
  waitFrames,
  waitUntil,
} from "./demo-visit.mjs";

/** Least number of rounds of random input: each key is pressed once. */
const RANDOM_INPUT_ROUNDS = 18;
/** Least duration of the random input [s]; the environment variable MUSLIN_ABUSE overrides it. */
const RANDOM_INPUT_SECONDS = Number(process.env.MUSLIN_ABUSE ?? 5);

test("without WebGL the page shows a message and logs no error", async () => {
  const { context, page, complaints } = await visit({}, (page) =>
    page.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null;
    }),
  );
  const failure = page.locator("#failure");
  await failure.waitFor({ state: "visible" });
  assert.match(await failure.textContent(), /needs WebGL.*current browser/);
  assert.equal(await state(page), "failed");
  assert.equal(await page.locator("#panel").isVisible(), false);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("after a lost context is restored the cloth is drawn and moves again", async () => {
  const { context, page, complaints } = await visitRunning();
  await page.evaluate(() => {
    const gl = document.getElementById("stage").getContext("webgl2");
    window.lose = gl.getExtension("WEBGL_lose_context");
    window.lose.loseContext();
  });
  await page.waitForFunction(() => document.documentElement.dataset.state === "lost");
  const lost = await hash(page);
  await waitFrames(page, 4);
  assert.equal(await hash(page), lost, "the cloth moved while the context was lost");
  await page.locator("#control-fabric input").last().check();
  await page.evaluate(() => window.lose.restoreContext());
  await page.waitForFunction(() => document.documentElement.dataset.state === "running");
  const back = await hash(page);
  await waitUntil(page, () => hash(page), (now) => now !== back, "the cloth does not move again");
  const drawn = await page.evaluate(async () => {
    await new Promise(requestAnimationFrame);
    const gl = document.getElementById("stage").getContext("webgl2");
    return [gl.isContextLost(), gl.getError()];
  });
  assert.deepEqual(drawn, [false, 0]);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the canvas follows its window, with at most two device pixels per CSS pixel", async () => {
  const dense = { viewport: { width: 300, height: 300 }, deviceScaleFactor: 3 };
  const { context, page, complaints } = await visitRunning(dense);
  const size = () => page.evaluate(() => {
    const { width, height } = document.getElementById("stage");
    return [width, height];
  });
  const is = (wide, high) => ([width, height]) => width === wide && height === high;
  await waitUntil(page, size, is(600, 600), "the canvas has another size");
  await page.setViewportSize({ width: 420, height: 260 });
  await waitUntil(page, size, is(840, 520), "the canvas did not follow");
  await page.setViewportSize({ width: 300, height: 300 });
  await waitUntil(page, size, is(600, 600), "the canvas did not come back");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a hidden tab pauses, and neither it nor a long frame makes the cloth jump", async () => {
  const { context, page, complaints } = await visitRunning();
  const hide = (hidden) => page.evaluate((hidden) => {
    Object.defineProperty(document, "hidden", { value: hidden, configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
  }, hidden);
  await waitFrames(page, 10);
  await hide(true);
  await waitFrames(page, 2);
  const [still, where] = [await hash(page), await particle(page, MIDDLE)];
  await page.waitForTimeout(1500);
  assert.equal(await hash(page), still, "the cloth moved in a hidden tab");
  await hide(false);
  await waitFrames(page, 2);
  const after = await particle(page, MIDDLE);
  assert.ok(distance(after, where) < 60, `the cloth jumped from ${where} to ${after}`);
  await waitUntil(page, () => hash(page), (now) => now !== still, "the cloth does not move again");
  // Blocks the page for two seconds.
  const before = await particle(page, MIDDLE);
  await page.evaluate(() => {
    for (const start = performance.now(); performance.now() - start < 2000; ) Math.random();
  });
  await waitFrames(page, 2);
  const late = await particle(page, MIDDLE);
  assert.ok(distance(late, before) < 60, `the cloth jumped in the long frame from ${before} to ${late}`);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("extreme sliders and random input cause no error and no explosion", async () => {
  const { context, page, complaints } = await visitRunning({ hasTouch: true });
  const sliders = page.locator("#controls input[type=range]");
  for (const end of ["max", "min", "max"]) {
    for (const slider of await sliders.all()) await slider.fill(await slider.getAttribute(end));
    await waitFrames(page, 3);
  }
  await page.locator("#control-tearing").click();
  const touch = await fingers(page);
  // A seeded generator: the same input in each run.
  let seed = 7;
  const random = (min, max) => {
    seed = (seed * 48271) % 2147483647;
    return min + ((max - min) * seed) / 2147483647;
  };
  const end = Date.now() + 1000 * RANDOM_INPUT_SECONDS;
  for (let round = 0; Date.now() < end || round < RANDOM_INPUT_ROUNDS; round++) {
    const place = () => [random(290, 690), random(10, 390)];
    await touch("touchStart", place());
    await touch("touchStart", place(), place());
    for (let i = 0; i < 5; i++) await touch("touchMove", place(), place());
    await touch(round % 2 ? "touchEnd" : "touchCancel");
    if (round % 3 === 0) await page.keyboard.press("brnfle"[(round / 3) % 6]);
    if (round % 4 === 0) await page.setViewportSize({ width: round % 8 ? 700 : 660, height: 394 });
    await waitFrames(page, 1);
    const at = await particle(page, MIDDLE);
    assert.ok(!at || at.every((x) => Math.abs(x) < 1e5), `a particle is at ${at}`);
  }
  const { particles, constraints, pieces } = await stats(page);
  assert.ok(particles > 0 && constraints >= 0 && pieces > 0, "the cloth has no particles or pieces");
  await page.locator("#control-reset").click();
  const fresh = await hash(page);
  await waitUntil(page, () => hash(page), (now) => now !== fresh, "the simulation does not run after a reset");
  assert.deepEqual(complaints, []);
  await context.close();
});
