// The example pages of the npm package: the cloth follows the pointer, and there are no errors.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readdir, readFile } from "node:fs/promises";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

import { fingers, launch, open, url, variable } from "./browser.mjs";

const shots = variable("MUSLIN_SHOTS");
/** Address of the same pages with the newest three.js. */
const newest = variable("MUSLIN_NEWEST");

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/**
 * Small, because a busy machine without a graphics card draws slowly; the whole sheet is above the
 * panel.
 */
const SIZE = { width: 300, height: 620 };
/**
 * A point on the cloth, at its lower right, and a point beside it, higher up; relative to the top
 * of the sheet [pixels]. Both are equally far from the opposite corner, so that the cloth reaches
 * the second point without tearing.
 */
const [ON, BESIDE] = [[228, 182], [272, 50]];

/**
 * Size of the part of a picture that is compared, and how many different pixels count as a change.
 */
const [WIDTH, HEIGHT, MIN_CHANGED] = [24, 32, 40];

/** Number of steps in which the cloth is dragged. */
const STEPS = 8;

/** Opens an example and waits until it draws: its status line shows a number of particles. */
async function visit(name, { home = url, ...options } = {}) {
  const visited = await open(browser, { viewport: SIZE, ...options }, home);
  visited.page.setDefaultTimeout(120_000);
  await visited.page.goto(new URL(`${name}/`, home).href);
  await visited.page.waitForFunction(() => /^[1-9]\d+ particles/.test(document.getElementById("stats").textContent));
  return visited;
}

/**
 * Returns the pixels around a position, more of them below it, where the cloth hangs from the
 * pointer.
 */
async function readPixels(page, [x, y]) {
  const clip = { x: x - WIDTH / 2, y: y - HEIGHT / 4, width: WIDTH, height: HEIGHT };
  const picture = (await page.screenshot({ clip })).toString("base64");
  return page.evaluate(async ([picture, width, height]) => {
    const image = new Image();
    image.src = `data:image/png;base64,${picture}`;
    await image.decode();
    const canvas = new OffscreenCanvas(width, height).getContext("2d");
    canvas.drawImage(image, 0, 0);
    return [...canvas.getImageData(0, 0, width, height).data];
  }, [picture, WIDTH, HEIGHT]);
}

/** Returns how many pixels differ in colour. */
function countDifferent(a, b) {
  let count = 0;
  for (let i = 0; i < a.length; i += 4) {
    const difference = Math.hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]);
    if (difference > 30) count++;
  }
  return count;
}

/** Waits until the pixels at a position differ from `before`, or equal it again. */
async function waitForPixels(page, place, before, isDifferent) {
  let last;
  for (let i = 0; i < 60; i++) {
    last = countDifferent(await readPixels(page, place), before);
    if (last > MIN_CHANGED === isDifferent) return;
    await page.waitForTimeout(100);
  }
  assert.fail(`at ${place} ${last} pixels differ, where ${isDifferent ? "many" : "few"} should`);
}

/** Waits for a number of frames, however long each takes. */
const waitFrames = (page, count) =>
  page.evaluate(
    (count) => new Promise((done) => {
      const next = () => (count-- > 0 ? requestAnimationFrame(next) : done());
      next();
    }),
    count,
  );

/**
 * Drags a sheet that hangs at `top` over the background. Returns the position and the pixels it had
 * before.
 */
async function drag(page, top, pace) {
  const [on, beside] = [ON, BESIDE].map(([x, y]) => [x, top + y]);
  const background = await readPixels(page, beside);
  await page.mouse.move(...on);
  await page.mouse.down();
  for (let step = 1; step <= STEPS; step++) {
    await page.mouse.move(...on.map((from, i) => from + (step / STEPS) * (beside[i] - from)));
    // Slowly: a page with few frames per second follows slowly, and a fast drag would tear a scrap
    // out of the cloth.
    await Promise.all([page.waitForTimeout(pace), waitFrames(page, 8)]);
  }
  await waitForPixels(page, beside, background, true);
  return [beside, background];
}

test("the index page links every example folder", async () => {
  const { context, page, complaints } = await open(browser);
  await page.goto(url);
  const links = await page.locator("a").evaluateAll((links) => links.map((link) => link.getAttribute("href").replace("/", "")));
  await page.screenshot({ path: join(shots, "../examples-list.png") });
  assert.deepEqual(complaints, []);
  await context.close();
  const dirs = await readdir(new URL("../../bindings/js/examples", import.meta.url), { withFileTypes: true });
  const names = dirs.filter((dir) => dir.isDirectory()).map(({ name }) => name).sort();
  assert.deepEqual(links.sort(), names);
  assert.deepEqual(names, ["babylon", "drape", "figure", "plain", "worker"]);
});

// The top of each sheet [pixels], and the time of a step [ms]: the page cannot count the frames of
// a worker.
for (const [name, version, home, top, pace] of [
  ["drape", "r160", url, 73, 100],
  ["drape", "newest", newest, 73, 100],
  ["worker", "r160", url, 110, 800],
  ["plain", "", url, 191, 100],
  ["babylon", "", url, 191, 100],
]) {
  test(`${name} ${version}: the cloth follows a drag, and a reset brings it back`, async () => {
    const { context, page, complaints } = await visit(name, { home });
    await page.screenshot({ path: join(shots, `${name}${version}.png`) });
    const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wider <= 0, `the page is ${wider} pixels wider than a small phone`);
    const [beside, background] = await drag(page, top, pace);
    await page.screenshot({ path: join(shots, `${name}${version}-dragged.png`) });
    await page.mouse.up();
    await page.locator("#reset").click();
    await waitForPixels(page, beside, background, false);
    assert.deepEqual(complaints, []);
    await context.close();
  });
}

// The top of the sheet is at 73. The second finger drags the right border, below the first finger.
for (const count of [1, 2]) {
  test(`drape, ${count === 1 ? "a finger" : "two fingers"}: the cloth follows each of them, and a reset brings it back`, async () => {
    const { context, page, complaints } = await visit("drape", { hasTouch: true });
    const touch = await fingers(page);
    const places = (...each) => each.map(([x, y]) => [x, 73 + y]).slice(0, count);
    const [from, to] = [places(ON, [218, 110]), places(BESIDE, [276, 100])];
    const backgrounds = [];
    for (const place of to) backgrounds.push(await readPixels(page, place));
    // One touch comes after the other, as with real fingers.
    for (let down = 1; down <= count; down++) await touch("touchStart", ...from.slice(0, down));
    for (let step = 1; step <= STEPS; step++) {
      const share = step / STEPS;
      await touch("touchMove", ...from.map((at, i) => at.map((x, axis) => x + share * (to[i][axis] - x))));
      await Promise.all([page.waitForTimeout(100), waitFrames(page, 4)]);
    }
    for (const [i, place] of to.entries()) await waitForPixels(page, place, backgrounds[i], true);
    await page.screenshot({ path: join(shots, `drape-${count}-touched.png`) });
    await touch("touchEnd");
    await page.locator("#reset").click();
    for (const [i, place] of to.entries()) await waitForPixels(page, place, backgrounds[i], false);
    assert.deepEqual(complaints, []);
    await context.close();
  });
}

test("drape: with tearing on a hard pull tears the sheet, and a reset restores it", async () => {
  const { context, page, complaints } = await visit("drape");
  const particles = async () => parseInt(await page.locator("#stats").textContent());
  await page.locator("#tear").check();
  await page.mouse.move(180, 190);
  await page.mouse.down();
  for (const far of [[150, 40], [294, 350], [6, 350]]) await page.mouse.move(...far, { steps: 2 });
  await page.waitForFunction(() => parseInt(document.getElementById("stats").textContent) > 1600);
  assert.ok((await particles()) > 1600);
  await page.screenshot({ path: join(shots, "drape-torn.png") });
  await page.mouse.up(); // before this the canvas captures all pointer events
  await page.locator("#wire").check();
  await page.locator("#reset").click();
  await page.waitForFunction(() => /^1600 particles ·/.test(document.getElementById("stats").textContent));
  // New sheets with other pins: nothing of the old sheet causes an error.
  for (const pins of ["corners", "top-edge"]) await page.locator("#pins").selectOption(pins);
  await page.locator("#pause").click();
  assert.equal(await page.locator("#pause").getAttribute("aria-pressed"), "true");
  assert.deepEqual(complaints, []);
  await context.close();
});

for (const [version, home] of [["r160", url], ["newest", newest]]) {
  test(`figure ${version}: the figure walks in its clothes, and stands still while the page is paused`, async () => {
    const { context, page, complaints } = await visit("figure", { home });
    const middle = [150, 300];
    const first = await readPixels(page, middle);
    await waitForPixels(page, middle, first, true);
    await page.screenshot({ path: join(shots, `figure${version}.png`) });
    await page.locator("#pause").click();
    await waitFrames(page, 2);
    const paused = await readPixels(page, middle);
    await waitFrames(page, 6);
    assert.equal(countDifferent(await readPixels(page, middle), paused), 0);
    await page.locator("#reset").click();
    await waitForPixels(page, middle, paused, true);
    assert.deepEqual(complaints, []);
    await context.close();
  });
}

test("the script writes the figure as a binary glTF file with a skin and a clip", async () => {
  const file = join(shots, "../figure.glb");
  const script = fileURLToPath(new URL("../../bindings/js/examples/figure/write-figure.mjs", import.meta.url));
  await promisify(execFile)(process.execPath, [script, file]);
  const bytes = await readFile(file);
  assert.equal(bytes.toString("latin1", 0, 4), "glTF");
  assert.equal(bytes.readUInt32LE(8), bytes.length);
  const gltf = JSON.parse(bytes.toString("utf8", 20, 20 + bytes.readUInt32LE(12)));
  const body = gltf.meshes.find(({ name }) => name === "body").primitives[0].attributes;
  assert.ok(gltf.accessors[body.POSITION].count <= 1500);
  assert.equal(gltf.accessors[body.WEIGHTS_0].count, gltf.accessors[body.POSITION].count);
  assert.equal(gltf.skins[0].joints.length, gltf.accessors[gltf.skins[0].inverseBindMatrices].count);
  assert.equal(gltf.animations.length, 1);
});

test("a worker keeps simulating while its page is blocked", async () => {
  const { context, page, complaints } = await visit("worker");
  await page.locator("#busy").click();
  // The worker posts a message twice a second at most. Several messages that arrive together after
  // the block were posted during it; a worker that stood still would have posted one.
  const messages = await page.evaluate(async () => {
    let count = 0;
    const changes = new MutationObserver(() => count++);
    changes.observe(document.getElementById("stats"), { childList: true });
    const end = performance.now() + 4000;
    while (performance.now() < end);
    await new Promise((done) => setTimeout(done, 100));
    return count;
  });
  assert.ok(messages >= 2, `the worker posted ${messages} messages`);
  assert.deepEqual(complaints, []);
  await context.close();
});
