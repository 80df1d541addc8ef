// The demo page, used by pointer, wheel, keys and the panel.

import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";

import { variable } from "./browser.mjs";
import "./demo-panel.test.mjs";
import "./demo-photo.test.mjs";
import "./demo-robust.test.mjs";
import "./demo-transfer.test.mjs";
import "./tender.test.mjs";
import {
  MIDDLE,
  cameraPosition,
  checkShareMetadata,
  distance,
  fingers,
  hash,
  particle,
  settings,
  stats,
  visitRunning,
  waitFrames,
  waitUntil,
  waitUntilRunning,
} from "./demo-visit.mjs";

const shots = variable("MUSLIN_SHOTS");

test("the sheet moves, and the page fits a wide and a tall screen", async () => {
  for (const [width, height] of [[1280, 720], [390, 844]]) {
    const { context, page, complaints } = await visitRunning({ viewport: { width, height }, deviceScaleFactor: 1 });
    const first = await hash(page);
    await waitUntil(page, () => hash(page), (now) => now !== first, "nothing moves");
    await waitFrames(page, 20);
    const box = await page.locator("#stage").boundingBox();
    assert.deepEqual([box.x, box.y, box.width, box.height], [0, 0, width, height]);
    await checkShareMetadata(page);
    const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wider <= 0, `the page is ${wider} pixels wider than the screen`);
    await page.screenshot({ path: join(shots, `web-${width}x${height}.png`) });
    assert.deepEqual(complaints, []);
    await context.close();
  }
});

test("a pointer drags the particle that it grabs, and the camera does not turn", async () => {
  const { context, page, complaints } = await visitRunning();
  const from = await particle(page, MIDDLE);
  const before = await cameraPosition(page);
  await page.mouse.move(...from);
  await page.mouse.down();
  const to = [from[0] + 90, from[1] - 45];
  await page.mouse.move(...to, { steps: 8 });
  // The particle under the pointer may be a neighbour: the sheet sways.
  const near = (at) => distance(at, to) < 20;
  await waitUntil(page, () => particle(page, MIDDLE), near, `the particle did not come to ${to}`);
  assert.ok(distance(await cameraPosition(page), before) < 0.02, "the camera turned with the drag");
  await page.mouse.up();
  const away = (at) => distance(at, to) > 30;
  await waitUntil(page, () => particle(page, MIDDLE), away, "the particle was not released");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a hard pull tears the sheet only while tearing is on", async () => {
  const { context, page, complaints } = await visitRunning();
  const pull = async () => {
    const from = await particle(page, MIDDLE);
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(from[0] + 280, from[1] + 140, { steps: 12 });
    await waitFrames(page, 20);
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
  await waitFrames(page, 5);
  await pull();
  const torn = ({ constraints }) => constraints < whole.constraints;
  await waitUntil(page, () => stats(page), torn, `none of ${whole.constraints} links tore`);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a swipe cuts with Shift held, and a finger cuts while the blade is on", async () => {
  const { context, page, complaints } = await visitRunning({ hasTouch: true, uncovered: true });
  const swipe = async (down, move, up) => {
    const [left, right] = [await particle(page, 20 * 40), await particle(page, 20 * 40 + 39)];
    const at = (share) => left.map((x, i) => x + (right[i] - x) * share);
    await down(at(-0.1));
    for (let i = 1; i <= 12; i++) await move(at(-0.1 + 0.07 * i));
    await up();
  };
  // The sheet stands still, so that the steps of the swipe are one line: on a slow machine it blows
  // across them, and they cut a flap off.
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("Space");
  await waitUntil(page, () => settings(page), ({ paused }) => paused, "the sheet is not paused");
  const whole = await stats(page);
  const before = await cameraPosition(page);
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
  assert.ok(distance(await cameraPosition(page), before) < 0.02, "the camera turned with the swipe");

  await page.keyboard.press("Space");
  await page.keyboard.press("r");
  await page.keyboard.press("b");
  const touch = await fingers(page);
  await waitFrames(page, 4);
  await swipe(
    (at) => touch("touchStart", at),
    (at) => touch("touchMove", at),
    () => touch("touchEnd"),
  );
  const touched = ({ particles }) => particles > whole.particles + 20;
  await waitUntil(page, () => stats(page), touched, "the finger cut nothing");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the wheel zooms, and a drag beside the sheet orbits", async () => {
  const { context, page, complaints } = await visitRunning();
  const first = await cameraPosition(page);
  await page.mouse.move(350, 197);
  await page.mouse.wheel(0, -600);
  const nearer = (at) => distance(at, first) > 0.1;
  const zoomed = await waitUntil(page, () => cameraPosition(page), nearer, "the wheel did not zoom");
  await page.mouse.wheel(0, 600);
  await waitFrames(page, 20);
  await page.mouse.move(560, 385);
  await page.mouse.down();
  await page.mouse.move(670, 370, { steps: 6 });
  await page.mouse.up();
  const turned = (at) => Math.abs(at[0] - zoomed[0]) > 0.1;
  await waitUntil(page, () => cameraPosition(page), turned, "the drag did not orbit");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a slider and a key change the settings, which survive a reload", async () => {
  const visited = await visitRunning();
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
  await waitUntilRunning(visited);
  assert.deepEqual(await settings(page), changed);
  assert.equal(Number(await slider.inputValue()).toFixed(1), changed.gravity.toFixed(1));
  assert.deepEqual(complaints, []);
  await context.close();
});

test("pause stops the sheet and reset restores it", async () => {
  const { context, page, complaints } = await visitRunning();
  await waitFrames(page, 10);
  await page.locator("#control-paused").click();
  await waitFrames(page, 2);
  const still = await hash(page);
  await waitFrames(page, 10);
  assert.equal(await hash(page), still);
  await page.locator("#control-reset").click();
  await waitUntil(page, () => hash(page), (now) => now !== still, "the reset did nothing");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("two fingers pinch to zoom, and the camera does not jump when a finger is added or lifted", async () => {
  const { context, page, complaints } = await visitRunning({ hasTouch: true });
  const touch = await fingers(page);
  const far = async () => Math.hypot(...(await cameraPosition(page)));
  const settled = async () => {
    await waitFrames(page, 12);
    return far();
  };
  const still = await far();
  await touch("touchStart", [440, 386]);
  await touch("touchStart", [440, 386], [680, 386]);
  assert.ok(Math.abs((await settled()) - still) < 0.05, "the camera jumped when the second finger came down");
  for (let x = 670; x >= 560; x -= 10) await touch("touchMove", [440, 386], [x, 386]);
  await waitUntil(page, far, (now) => now > 1.3 * still, "the pinch did not zoom");
  await waitFrames(page, 30);
  const pinched = await settled();
  await touch("touchEnd", [440, 386]);
  assert.ok(Math.abs((await settled()) - pinched) < 0.05, "the camera jumped when a finger was lifted");
  await touch("touchEnd");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("two fingers hold the cloth at once, and a cancelled touch releases it", async () => {
  const { context, page, complaints } = await visitRunning({ hasTouch: true, uncovered: true });
  const touch = await fingers(page);
  const places = [12 * 40 + 12, 12 * 40 + 27];
  const [a, b] = [await particle(page, places[0]), await particle(page, places[1])];
  const before = await cameraPosition(page);
  await touch("touchStart", a);
  await touch("touchStart", a, b);
  const [toA, toB] = [[a[0] - 40, a[1] + 20], [b[0] + 40, b[1] + 20]];
  for (let i = 1; i <= 4; i++) {
    const on = (from, to) => from.map((x, axis) => x + ((to[axis] - x) * i) / 4);
    await touch("touchMove", on(a, toA), on(b, toB));
  }
  const held = async () => Promise.all(places.map((i) => particle(page, i)));
  const both = ([x, y]) => distance(x, toA) < 25 && distance(y, toB) < 25;
  await waitUntil(page, held, both, "the fingers do not hold both");
  assert.ok(distance(await cameraPosition(page), before) < 0.02, "the camera moved with the fingers");
  await touch("touchCancel");
  const free = ([x, y]) => distance(x, toA) > 8 && distance(y, toB) > 8;
  await waitUntil(page, held, free, "a cancelled touch still holds the cloth");
  assert.deepEqual(complaints, []);
  await context.close();
});

/** Rests the mouse on a particle until the cursor shows that the cloth can be grabbed there. */
async function hover(page, i) {
  // The sheet sways, and the camera eases towards its place.
  const over = async () => {
    await page.mouse.move(...(await particle(page, i)));
    return cursor(page);
  };
  await waitUntil(page, over, (now) => now === "grab", "the cursor does not show a hand over the sheet");
}

const cursor = (page) => page.evaluate(() => document.getElementById("stage").style.cursor);
const waitForCursor = (page, wanted) =>
  waitUntil(page, () => cursor(page), (now) => now === wanted, `the cursor is not ${wanted}`);

test("the cursor shows what can be grabbed, what is held, and that the blade is on", async () => {
  const { context, page, complaints } = await visitRunning();
  await page.mouse.move(690, 300);
  await waitForCursor(page, "default");
  await hover(page, MIDDLE);
  await page.mouse.down();
  await waitForCursor(page, "grabbing");
  await page.mouse.up();
  await page.keyboard.down("Shift");
  await waitForCursor(page, "crosshair");
  await page.keyboard.up("Shift");
  await hover(page, MIDDLE);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the cursor changes when the cloth moves away from a mouse that rests", async () => {
  const { context, page, complaints } = await visitRunning();
  await hover(page, 2 * 40 + 2);
  for (let i = 0; i < 8; i++) await page.keyboard.press("-");
  await waitForCursor(page, "default");
  assert.deepEqual(complaints, []);
  await context.close();
});
