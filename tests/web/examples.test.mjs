// Every example page of the npm package, used by a visitor: the cloth is where the pointer drags it, nothing complains.

import assert from "node:assert/strict";
import { readdir } from "node:fs/promises";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { fingers, launch, open, url, variable } from "./browser.mjs";

const shots = variable("MUSLIN_SHOTS");
/** The same pages with the newest three.js. */
const newest = variable("MUSLIN_NEWEST");

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/** Small, since a busy machine without a graphics card draws slowly; all of a sheet is above the panel. */
const SIZE = { width: 300, height: 620 };
/**
 * On the cloth, low and to the right, and beside it, higher; from where the sheet hangs [pixels]. As far
 * from its other corner, so that it can get there: cloth that cannot is torn, and a scrap is all that follows.
 */
const [ON, BESIDE] = [[228, 182], [272, 50]];

/** A patch of a picture that is compared, and how many of its pixels it takes to make it another [pixels]. */
const [WIDTH, HEIGHT, MANY] = [24, 32, 40];

/** In how many steps the cloth is dragged. */
const STEPS = 8;

/** A page that draws: its readout tells of particles. */
async function visit(name, { home = url, ...options } = {}) {
  const visited = await open(browser, { viewport: SIZE, ...options }, home);
  visited.page.setDefaultTimeout(120_000);
  await visited.page.goto(new URL(`${name}/`, home).href);
  await visited.page.waitForFunction(() => /^[1-9]\d+ particles/.test(document.getElementById("stats").textContent));
  return visited;
}

/** The pixels about a place, more of them below it, where cloth hangs that is held there. */
async function patch(page, [x, y]) {
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

/** How many pixels of two patches are of different colours. */
function differing(a, b) {
  let count = 0;
  for (let at = 0; at < a.length; at += 4) {
    const apart = Math.hypot(a[at] - b[at], a[at + 1] - b[at + 1], a[at + 2] - b[at + 2]);
    if (apart > 30) count++;
  }
  return count;
}

/** Waits until what is drawn at a place is other than it was, or as it was. */
async function becomes(page, place, before, isOther) {
  let last;
  for (let i = 0; i < 60; i++) {
    last = differing(await patch(page, place), before);
    if (last > MANY === isOther) return;
    await page.waitForTimeout(100);
  }
  assert.fail(`at ${place} ${last} pixels differ, where ${isOther ? "many" : "few"} should`);
}

/** Waits until the page drew so many pictures more, however long it takes for each. */
const pictures = (page, count) =>
  page.evaluate(
    (count) => new Promise((done) => {
      const next = () => (count-- > 0 ? requestAnimationFrame(next) : done());
      next();
    }),
    count,
  );

/** Drags a sheet that hangs at `top` to where there is none, and gives that place and the colours that it had. */
async function drag(page, top, pace) {
  const [on, beside] = [ON, BESIDE].map(([x, y]) => [x, top + y]);
  const background = await patch(page, beside);
  await page.mouse.move(...on);
  await page.mouse.down();
  for (let step = 1; step <= STEPS; step++) {
    await page.mouse.move(...on.map((from, i) => from + (step / STEPS) * (beside[i] - from)));
    // Or it is torn out of the cloth rather than pulled: a page that draws slowly is slow to follow, too.
    await Promise.all([page.waitForTimeout(pace), pictures(page, 8)]);
  }
  await becomes(page, beside, background, true);
  return [beside, background];
}

test("the list names every folder of examples, and each is looked at here", async () => {
  const { context, page, complaints } = await open(browser);
  await page.goto(url);
  const links = await page.locator("a").evaluateAll((links) => links.map((link) => link.getAttribute("href").replace("/", "")));
  await page.screenshot({ path: join(shots, "../examples-list.png") });
  assert.deepEqual(complaints, []);
  await context.close();
  const dirs = await readdir(new URL("../../bindings/js/examples", import.meta.url), { withFileTypes: true });
  const names = dirs.filter((dir) => dir.isDirectory()).map(({ name }) => name).sort();
  assert.deepEqual(links.sort(), names);
  assert.deepEqual(names, ["babylon", "drape", "plain", "worker"]);
});

// Each with where its sheet hangs, and how long a step takes [ms]: a worker's pictures are not counted by the page.
for (const [name, version, home, top, pace] of [
  ["drape", "r160", url, 73, 100],
  ["drape", "newest", newest, 73, 100],
  ["worker", "r160", url, 110, 800],
  ["plain", "", url, 191, 100],
  ["babylon", "", url, 191, 100],
]) {
  test(`${name} ${version}: a drag brings the cloth along, and lets it go`, async () => {
    const { context, page, complaints } = await visit(name, { home });
    await page.screenshot({ path: join(shots, `${name}${version}.png`) });
    const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wider <= 0, `the page is ${wider} pixels wider than a small phone`);
    const [beside, background] = await drag(page, top, pace);
    await page.screenshot({ path: join(shots, `${name}${version}-dragged.png`) });
    await page.mouse.up();
    await page.locator("#reset").click();
    await becomes(page, beside, background, false);
    assert.deepEqual(complaints, []);
    await context.close();
  });
}

// The sheet hangs at 73. The second finger takes its right border and brings it along below the first.
for (const count of [1, 2]) {
  test(`drape, ${count === 1 ? "a finger" : "two fingers"}: each brings the cloth along, and lets it go`, async () => {
    const { context, page, complaints } = await visit("drape", { hasTouch: true });
    const touch = await fingers(page);
    const places = (...each) => each.map(([x, y]) => [x, 73 + y]).slice(0, count);
    const [from, to] = [places(ON, [218, 110]), places(BESIDE, [276, 100])];
    const backgrounds = [];
    for (const place of to) backgrounds.push(await patch(page, place));
    // One comes down after the other, as fingers do.
    for (let down = 1; down <= count; down++) await touch("touchStart", ...from.slice(0, down));
    for (let step = 1; step <= STEPS; step++) {
      const share = step / STEPS;
      await touch("touchMove", ...from.map((at, i) => at.map((x, axis) => x + share * (to[i][axis] - x))));
      await Promise.all([page.waitForTimeout(100), pictures(page, 4)]);
    }
    for (const [i, place] of to.entries()) await becomes(page, place, backgrounds[i], true);
    await page.screenshot({ path: join(shots, `drape-${count}-touched.png`) });
    await touch("touchEnd");
    await page.locator("#reset").click();
    for (const [i, place] of to.entries()) await becomes(page, place, backgrounds[i], false);
    assert.deepEqual(complaints, []);
    await context.close();
  });
}

test("drape, torn: with its switch on a hard pull makes pieces of it, and a reset makes it whole", async () => {
  const { context, page, complaints } = await visit("drape");
  const particles = async () => parseInt(await page.locator("#stats").textContent());
  await page.locator("#tear").check();
  await page.mouse.move(180, 190);
  await page.mouse.down();
  for (const far of [[150, 40], [294, 350], [6, 350]]) await page.mouse.move(...far, { steps: 2 });
  await page.waitForFunction(() => parseInt(document.getElementById("stats").textContent) > 1600);
  assert.ok((await particles()) > 1600);
  await page.screenshot({ path: join(shots, "drape-torn.png") });
  await page.mouse.up(); // until then every pointer event is the canvas's
  await page.locator("#wire").check();
  await page.locator("#reset").click();
  await page.waitForFunction(() => /^1600 particles ·/.test(document.getElementById("stats").textContent));
  // Hung anew, in the other ways: nothing of the sheet before is left to complain.
  for (const pins of ["corners", "top-edge"]) await page.locator("#pins").selectOption(pins);
  await page.locator("#pause").click();
  assert.equal(await page.locator("#pause").getAttribute("aria-pressed"), "true");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a worker goes on while its page is busy", async () => {
  const { context, page, complaints } = await visit("worker");
  await page.locator("#busy").click();
  // It tells of itself twice a second at most: what the page hears at once when it is free again was told meanwhile,
  // where a worker that stood still tells it once.
  const heard = await page.evaluate(async () => {
    let count = 0;
    const changes = new MutationObserver(() => count++);
    changes.observe(document.getElementById("stats"), { childList: true });
    const end = performance.now() + 4000;
    while (performance.now() < end);
    await new Promise((done) => setTimeout(done, 100));
    return count;
  });
  assert.ok(heard >= 2, `the page heard of the worker ${heard} times`);
  assert.deepEqual(complaints, []);
  await context.close();
});
