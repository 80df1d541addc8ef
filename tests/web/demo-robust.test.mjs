// What a page goes through: other sizes, hidden tabs, long frames, lost contexts, no WebGL, abuse.

import assert from "node:assert/strict";
import { test } from "node:test";

import { MIDDLE, apart, becomes, fingers, frames, hash, particle, state, stats, visit, visitRunning } from "./demo-visit.mjs";

/** How long the abuse lasts [s]; the environment may ask for more. */
const ABUSE = Number(process.env.MUSLIN_ABUSE ?? 20);

test("without WebGL there is a message and no error", async () => {
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

test("a lost context comes back, and the cloth with it", async () => {
  const { context, page, complaints } = await visitRunning();
  await page.evaluate(() => {
    const gl = document.getElementById("stage").getContext("webgl2");
    window.lose = gl.getExtension("WEBGL_lose_context");
    window.lose.loseContext();
  });
  await page.waitForFunction(() => document.documentElement.dataset.state === "lost");
  const lost = await hash(page);
  await frames(page, 4);
  assert.equal(await hash(page), lost, "the cloth moved where nobody could see it");
  await page.locator("#control-fabric input").last().check();
  await page.evaluate(() => window.lose.restoreContext());
  await page.waitForFunction(() => document.documentElement.dataset.state === "running");
  const back = await hash(page);
  await becomes(page, () => hash(page), (now) => now !== back, "nothing moves any more");
  const drawn = await page.evaluate(async () => {
    await new Promise(requestAnimationFrame);
    const gl = document.getElementById("stage").getContext("webgl2");
    return [gl.isContextLost(), gl.getError()];
  });
  assert.deepEqual(drawn, [false, 0]);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the canvas follows its window and has at most two pixels to one of the page's", async () => {
  const dense = { viewport: { width: 300, height: 300 }, deviceScaleFactor: 3 };
  const { context, page, complaints } = await visitRunning(dense);
  const size = () => page.evaluate(() => {
    const { width, height } = document.getElementById("stage");
    return [width, height];
  });
  const is = (wide, high) => ([width, height]) => width === wide && height === high;
  await becomes(page, size, is(600, 600), "the canvas has another size");
  await page.setViewportSize({ width: 420, height: 260 });
  await becomes(page, size, is(840, 520), "the canvas did not follow");
  await page.setViewportSize({ width: 300, height: 300 });
  await becomes(page, size, is(600, 600), "the canvas did not come back");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a hidden tab stands still, and neither it nor a long frame flings the cloth", async () => {
  const { context, page, complaints } = await visitRunning();
  const hide = (hidden) => page.evaluate((hidden) => {
    Object.defineProperty(document, "hidden", { value: hidden, configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
  }, hidden);
  await frames(page, 10);
  await hide(true);
  await frames(page, 2);
  const [still, where] = [await hash(page), await particle(page, MIDDLE)];
  await page.waitForTimeout(1500);
  assert.equal(await hash(page), still, "a hidden tab goes on");
  await hide(false);
  await frames(page, 2);
  const after = await particle(page, MIDDLE);
  assert.ok(apart(after, where) < 60, `the cloth jumped from ${where} to ${after}`);
  await becomes(page, () => hash(page), (now) => now !== still, "it does not go on");
  // Two seconds in which the page can do nothing.
  const before = await particle(page, MIDDLE);
  await page.evaluate(() => {
    for (const start = performance.now(); performance.now() - start < 2000; ) Math.random();
  });
  await frames(page, 2);
  const late = await particle(page, MIDDLE);
  assert.ok(apart(late, before) < 60, `the long frame flung it from ${before} to ${late}`);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("with every slider at its end and wild hands nothing explodes and nobody complains", async () => {
  const { context, page, complaints } = await visitRunning({ hasTouch: true });
  const sliders = page.locator("#controls input[type=range]");
  for (const end of ["max", "min", "max"]) {
    for (const slider of await sliders.all()) await slider.fill(await slider.getAttribute(end));
    await frames(page, 3);
  }
  await page.locator("#control-tearing").click();
  const touch = await fingers(page);
  // The same hands each time.
  let seed = 7;
  const dice = (least, most) => {
    seed = (seed * 48271) % 2147483647;
    return least + ((most - least) * seed) / 2147483647;
  };
  const end = Date.now() + 1000 * ABUSE;
  for (let round = 0; Date.now() < end || round < 6; round++) {
    const place = () => [dice(290, 690), dice(10, 390)];
    await touch("touchStart", place());
    await touch("touchStart", place(), place());
    for (let i = 0; i < 5; i++) await touch("touchMove", place(), place());
    await touch(round % 2 ? "touchEnd" : "touchCancel");
    if (round % 3 === 0) await page.keyboard.press("brnfle"[(round / 3) % 6]);
    if (round % 4 === 0) await page.setViewportSize({ width: round % 8 ? 700 : 660, height: 394 });
    await frames(page, 1);
    const at = await particle(page, MIDDLE);
    assert.ok(!at || at.every((x) => Math.abs(x) < 1e5), `a particle is at ${at}`);
  }
  const { particles, constraints, pieces } = await stats(page);
  assert.ok(particles > 0 && constraints >= 0 && pieces > 0, "the cloth is no more");
  await page.locator("#control-reset").click();
  const fresh = await hash(page);
  await becomes(page, () => hash(page), (now) => now !== fresh, "the sim is frozen");
  assert.deepEqual(complaints, []);
  await context.close();
});
