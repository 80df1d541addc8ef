// Shared by the tests of the demo page: a browser, opening the page, and reading its state.

import assert from "node:assert/strict";
import { after, before } from "node:test";

import { launch, open, url } from "./browser.mjs";

export { fingers } from "./browser.mjs";

/** A particle in the middle of the 40 x 40 grid. */
export const MIDDLE = 20 * 40 + 20;

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/**
 * Opens the demo page; `prepare(page)` runs before it loads. A busy machine without a graphics card
 * draws slowly, so the page is small, it has half as many pixels a side, and the timeouts are long.
 */
export async function visit({ path = "", ...options } = {}, prepare) {
  const visit = await open(browser, { viewport: { width: 700, height: 394 }, deviceScaleFactor: 0.5, ...options });
  visit.page.setDefaultTimeout(180_000);
  await prepare?.(visit.page);
  await visit.page.goto(new URL(path, url).href);
  return visit;
}

/**
 * Opens the demo page and waits until it runs. Closes the help, and with `uncovered` also the
 * panel, and waits until the picture has moved into the place that they leave.
 */
export async function visitRunning({ uncovered, ...options } = {}, prepare) {
  const visited = await visit(options, prepare);
  await waitUntilRunning(visited);
  if (uncovered) await visited.page.locator("#collapse").click();
  await waitForPicture(visited.page);
  return visited;
}

/** Waits until the picture has moved into what overlays leave free: a held corner stands still. */
async function waitForPicture(page) {
  let last = [-Infinity, 0];
  const isStill = (at) => {
    const moved = distance(at, last);
    last = at;
    return moved < 1;
  };
  await waitUntil(page, () => particle(page, 0), isStill, "the picture does not come to rest");
}

export async function waitUntilRunning(visited) {
  await waitForStart(visited);
  await visited.page.locator("#dismiss").click();
}

/** Waits until the page draws, and fails with its message if it does not. */
export async function waitForStart({ page, complaints }) {
  const state = () => document.documentElement.dataset.state;
  await page.waitForFunction(state, null, { timeout: 180_000 }).catch(() => {});
  const reason = await page.locator("#reason").textContent();
  assert.equal(await page.evaluate(state), "running", `${reason} ${complaints.join("; ")}`);
}

export const stats = (page) => page.evaluate(() => window.muslinDemo.stats());
export const settings = (page) => page.evaluate(() => window.muslinDemo.settings());
export const hash = (page) => page.evaluate(() => window.muslinDemo.stateHash());
export const particle = (page, i) => page.evaluate((i) => window.muslinDemo.particleScreen(i), i);
export const cameraPosition = (page) => page.evaluate(() => window.muslinDemo.eye());
export const state = (page) => page.evaluate(() => document.documentElement.dataset.state);
export const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

/** Waits for a number of frames. The demo moves by frames, not by wall time. */
export const waitFrames = (page, count) =>
  page.evaluate(async (count) => {
    for (let i = 0; i < count; i++) await new Promise(requestAnimationFrame);
  }, count);

/**
 * Waits until `isDone` is true for the value of `read`, and returns that value. Fails with
 * `message` and the last value.
 */
export async function waitUntil(page, read, isDone, message) {
  let last;
  for (let i = 0; i < 120; i++) {
    last = await read();
    if (isDone(last)) return last;
    await waitFrames(page, 2);
  }
  assert.fail(`${message}: ${JSON.stringify(last)}`);
}

/**
 * Checks what other sites show when the page is shared: titles, descriptions, a picture that loads,
 * a favicon.
 */
export async function checkShareMetadata(page) {
  const metadata = await page.evaluate(() =>
    Object.fromEntries([...document.querySelectorAll("meta[content]")].map((meta) =>
      [meta.name || meta.getAttribute("property"), meta.content])));
  const title = await page.title();
  assert.ok(title.length > 5);
  assert.ok(metadata.description.length > 40, `the description is ${metadata.description}`);
  assert.equal(metadata["og:type"], "website");
  assert.equal(metadata["twitter:card"], "summary_large_image");
  for (const family of ["og", "twitter"]) {
    assert.equal(metadata[`${family}:title`], title);
    for (const name of ["description", "image:alt"]) {
      assert.ok(metadata[`${family}:${name}`]?.length > 20, `${family}:${name} is ${metadata[`${family}:${name}`]}`);
    }
    const image = await page.evaluate(async (address) => {
      const answer = await fetch(address);
      const { width, height } = await createImageBitmap(await answer.blob());
      return [answer.ok, answer.headers.get("content-type"), String(width), String(height)];
    }, metadata[`${family}:image`]);
    assert.deepEqual(image, [true, ...["type", "width", "height"].map((name) => metadata[`og:image:${name}`])]);
  }
  const icon = await page.locator("link[rel=icon]").getAttribute("href");
  assert.match(icon, /^data:image\/svg/);
  const isImage = await page.evaluate(async (icon) => {
    const image = new Image();
    image.src = icon;
    await image.decode();
    return image.naturalWidth > 0;
  }, icon);
  assert.ok(isImage, "the favicon does not load");
}
