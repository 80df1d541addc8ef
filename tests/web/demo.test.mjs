// The demo's page, used as a visitor uses it: by pointer, wheel, keys and the panel.

import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { launch, open, url, variable } from "./browser.mjs";

const shots = variable("MUSLIN_SHOTS");
const MIDDLE = 20 * 40 + 20; // of the 40 x 40 particles

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/** A page that runs, with the help out of the way. A busy machine without a graphics card draws slowly. */
async function visit(options) {
  const visit = await open(browser, { viewport: { width: 960, height: 540 }, ...options });
  visit.page.setDefaultTimeout(180_000);
  await visit.page.goto(url);
  await running(visit);
  return visit;
}

async function running({ page, complaints }) {
  const state = () => document.documentElement.dataset.state;
  await page.waitForFunction(state, null, { timeout: 180_000 }).catch(() => {});
  const reason = await page.locator("#reason").textContent();
  assert.equal(await page.evaluate(state), "running", `${reason} ${complaints.join("; ")}`);
  await page.locator("#dismiss").click();
}

const stats = (page) => page.evaluate(() => window.muslinDemo.stats());
const settings = (page) => page.evaluate(() => window.muslinDemo.settings());
const hash = (page) => page.evaluate(() => window.muslinDemo.stateHash());
const particle = (page, i) => page.evaluate((i) => window.muslinDemo.particleScreen(i), i);
const eye = (page) => page.evaluate(() => window.muslinDemo.eye());
const apart = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

/** Waits until frames have been drawn: the demo moves in them, not in time. */
const frames = (page, count) =>
  page.evaluate(async (count) => {
    for (let i = 0; i < count; i++) await new Promise(requestAnimationFrame);
  }, count);

/** Waits until `read` gives what `fits`; fails with what it gave last. */
async function becomes(page, read, fits, what) {
  let last;
  for (let i = 0; i < 120; i++) {
    last = await read();
    if (fits(last)) return last;
    await frames(page, 2);
  }
  assert.fail(`${what}: ${JSON.stringify(last)}`);
}

test("the sheet moves, and its picture fits a wide and a tall screen", async () => {
  for (const [width, height] of [[1280, 720], [390, 844]]) {
    const { context, page, complaints } = await visit({ viewport: { width, height } });
    const first = await hash(page);
    await becomes(page, () => hash(page), (now) => now !== first, "nothing moves");
    await frames(page, 20);
    const box = await page.locator("#stage").boundingBox();
    assert.deepEqual([box.x, box.y, box.width, box.height], [0, 0, width, height]);
    const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wider <= 0, `the page is ${wider} pixels wider than the screen`);
    await page.screenshot({ path: join(shots, `web-${width}x${height}.png`) });
    assert.deepEqual(complaints, []);
    await context.close();
  }
});

test("a pointer drags the particle that it grabs, and nothing else turns", async () => {
  const { context, page, complaints } = await visit();
  const from = await particle(page, MIDDLE);
  const before = await eye(page);
  await page.mouse.move(...from);
  await page.mouse.down();
  const to = [from[0] + 120, from[1] - 60];
  await page.mouse.move(...to, { steps: 8 });
  // The particle under the pointer may be a neighbour: the sheet sways.
  const near = (at) => apart(at, to) < 25;
  await becomes(page, () => particle(page, MIDDLE), near, `the particle did not come to ${to}`);
  assert.ok(apart(await eye(page), before) < 0.02, "the camera turned with the drag");
  await page.mouse.up();
  const away = (at) => apart(at, to) > 40;
  await becomes(page, () => particle(page, MIDDLE), away, "the particle was not let go");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("with tearing on a hard pull rips the sheet, with tearing off it does not", async () => {
  const { context, page, complaints } = await visit();
  const pull = async () => {
    const from = await particle(page, MIDDLE);
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(from[0] + 380, from[1] + 190, { steps: 12 });
    await frames(page, 20);
    await page.mouse.up();
  };
  const tearing = page.locator("#control-tearing");
  if (await tearing.isChecked()) await tearing.click();
  assert.equal((await settings(page)).tearing, false);
  const whole = await stats(page);
  await pull();
  assert.equal((await stats(page)).constraints, whole.constraints);
  await tearing.click();
  assert.equal((await settings(page)).tearing, true);
  await page.locator("#control-reset").click();
  await frames(page, 5);
  await pull();
  const torn = ({ constraints }) => constraints < whole.constraints;
  await becomes(page, () => stats(page), torn, `nothing tore of ${whole.constraints}`);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a swipe with Shift held cuts, and so does a finger with the blade switched on", async () => {
  const { context, page, complaints } = await visit({ hasTouch: true });
  const swipe = async (down, move, up) => {
    const [left, right] = [await particle(page, 20 * 40), await particle(page, 20 * 40 + 39)];
    const at = (share) => left.map((x, i) => x + (right[i] - x) * share);
    await down(at(-0.1));
    for (let i = 1; i <= 12; i++) await move(at(-0.1 + 0.07 * i));
    await up();
  };
  const whole = await stats(page);
  const before = await eye(page);
  await page.keyboard.down("Shift");
  await swipe(
    async (at) => (await page.mouse.move(...at), await page.mouse.down()),
    (at) => page.mouse.move(...at),
    () => page.mouse.up(),
  );
  await page.keyboard.up("Shift");
  const cut = await stats(page);
  assert.ok(cut.particles > whole.particles + 20, `${cut.particles} of ${whole.particles}`);
  assert.equal(cut.pieces, 1);
  assert.ok(apart(await eye(page), before) < 0.02, "the camera turned with the swipe");

  await page.locator("#control-reset").click();
  await page.locator("#control-blade").click();
  const touch = await context.newCDPSession(page);
  const finger = (type) => async (at) => {
    const touchPoints = at ? [{ x: at[0], y: at[1], id: 1 }] : [];
    await touch.send("Input.dispatchTouchEvent", { type, touchPoints });
  };
  await frames(page, 4);
  await swipe(finger("touchStart"), finger("touchMove"), finger("touchEnd"));
  const touched = ({ particles }) => particles > whole.particles + 20;
  await becomes(page, () => stats(page), touched, "the finger cut nothing");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the wheel zooms, a drag beside the sheet orbits", async () => {
  const { context, page, complaints } = await visit();
  const first = await eye(page);
  await page.mouse.move(480, 270);
  await page.mouse.wheel(0, -600);
  const nearer = (at) => apart(at, first) > 0.1;
  const zoomed = await becomes(page, () => eye(page), nearer, "the wheel did not zoom");
  await page.mouse.wheel(0, 600);
  await frames(page, 20);
  await page.mouse.move(740, 500);
  await page.mouse.down();
  await page.mouse.move(900, 470, { steps: 6 });
  await page.mouse.up();
  const turned = (at) => Math.abs(at[0] - zoomed[0]) > 0.1;
  await becomes(page, () => eye(page), turned, "the drag did not orbit");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a slider and a key change the settings, which outlive a reload", async () => {
  const visited = await visit();
  const { context, page, complaints } = visited;
  const before = await settings(page);
  const slider = page.locator("#control-gravity");
  await slider.focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press("ArrowLeft");
  await page.locator("#stage").focus();
  await page.keyboard.press("f");
  const changed = await settings(page);
  assert.notEqual(changed.gravity, before.gravity);
  assert.equal(changed.wireframe, !before.wireframe);
  await page.reload();
  await running(visited);
  assert.deepEqual(await settings(page), changed);
  assert.equal(Number(await slider.inputValue()).toFixed(1), changed.gravity.toFixed(1));
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a pause stops the sheet and a reset hangs a fresh one", async () => {
  const { context, page, complaints } = await visit();
  await frames(page, 10);
  await page.locator("#control-paused").click();
  await frames(page, 2);
  const still = await hash(page);
  await frames(page, 10);
  assert.equal(await hash(page), still);
  await page.locator("#control-reset").click();
  await becomes(page, () => hash(page), (now) => now !== still, "the reset did nothing");
  assert.deepEqual(complaints, []);
  await context.close();
});
