// What the tests of the demo's page share: a browser, a visit, and how to read the page.

import assert from "node:assert/strict";
import { after, before } from "node:test";

import { launch, open, url } from "./browser.mjs";

export { fingers } from "./browser.mjs";

/** A particle in the middle of the 40 x 40. */
export const MIDDLE = 20 * 40 + 20;

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/**
 * A page that runs, with the help out of the way; `prepare(page)` comes before it loads. A busy machine
 * without a graphics card draws slowly, so the page is small and patience long.
 */
export async function visit({ path = "", ...options } = {}, prepare) {
  const visit = await open(browser, { viewport: { width: 700, height: 394 }, ...options });
  visit.page.setDefaultTimeout(180_000);
  await prepare?.(visit.page);
  await visit.page.goto(new URL(path, url).href);
  return visit;
}

/** The same once it runs, with the panel shut if `uncovered`. */
export async function visitRunning({ uncovered, ...options } = {}, prepare) {
  const visited = await visit(options, prepare);
  await running(visited);
  if (uncovered) await visited.page.locator("#collapse").click();
  return visited;
}

export async function running(visited) {
  await started(visited);
  await visited.page.locator("#dismiss").click();
}

/** Waits until a page draws, and fails with what it says if it does not. */
export async function started({ page, complaints }) {
  const state = () => document.documentElement.dataset.state;
  await page.waitForFunction(state, null, { timeout: 180_000 }).catch(() => {});
  const reason = await page.locator("#reason").textContent();
  assert.equal(await page.evaluate(state), "running", `${reason} ${complaints.join("; ")}`);
}

export const stats = (page) => page.evaluate(() => window.muslinDemo.stats());
export const settings = (page) => page.evaluate(() => window.muslinDemo.settings());
export const hash = (page) => page.evaluate(() => window.muslinDemo.stateHash());
export const particle = (page, i) => page.evaluate((i) => window.muslinDemo.particleScreen(i), i);
export const eye = (page) => page.evaluate(() => window.muslinDemo.eye());
export const state = (page) => page.evaluate(() => document.documentElement.dataset.state);
export const apart = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

/** Waits until frames have been drawn: the demo moves in them, not in time. */
export const frames = (page, count) =>
  page.evaluate(async (count) => {
    for (let i = 0; i < count; i++) await new Promise(requestAnimationFrame);
  }, count);

/** Waits until `read` gives what `fits`; fails with what it gave last. */
export async function becomes(page, read, fits, what) {
  let last;
  for (let i = 0; i < 120; i++) {
    last = await read();
    if (fits(last)) return last;
    await frames(page, 2);
  }
  assert.fail(`${what}: ${JSON.stringify(last)}`);
}

/** Looks at what others show of a page when it is shared: names, a favicon, and a picture that is there. */
export async function looksShared(page) {
  const told = await page.evaluate(() =>
    Object.fromEntries([...document.querySelectorAll("meta[content]")].map((meta) =>
      [meta.name || meta.getAttribute("property"), meta.content])));
  const title = await page.title();
  assert.ok(title.length > 5);
  assert.ok(told.description.length > 40, `the description is ${told.description}`);
  assert.equal(told["og:type"], "website");
  assert.equal(told["twitter:card"], "summary_large_image");
  for (const family of ["og", "twitter"]) {
    assert.equal(told[`${family}:title`], title);
    for (const name of ["description", "image:alt"]) {
      assert.ok(told[`${family}:${name}`]?.length > 20, `${family}:${name} is ${told[`${family}:${name}`]}`);
    }
    const image = await page.evaluate(async (address) => {
      const answer = await fetch(address);
      const { width, height } = await createImageBitmap(await answer.blob());
      return [answer.ok, answer.headers.get("content-type"), String(width), String(height)];
    }, told[`${family}:image`]);
    assert.deepEqual(image, [true, ...["type", "width", "height"].map((name) => told[`og:image:${name}`])]);
  }
  const icon = await page.locator("link[rel=icon]").getAttribute("href");
  assert.match(icon, /^data:image\/svg/);
  const isDrawn = await page.evaluate(async (icon) => {
    const image = new Image();
    image.src = icon;
    await image.decode();
    return image.naturalWidth > 0;
  }, icon);
  assert.ok(isDrawn, "the favicon is no picture");
}
