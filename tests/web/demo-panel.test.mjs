// The panel of the demo: controls, keyboard shortcuts, stored settings, accessibility.

import assert from "node:assert/strict";
import { test } from "node:test";

import {
  cameraPosition,
  checkShareMetadata,
  distance,
  hash,
  particle,
  settings,
  stats,
  visit,
  visitRunning,
  waitFrames,
  waitUntil,
  waitUntilRunning,
} from "./demo-visit.mjs";

/** Stores a value under the key of the settings before the page loads. */
const storing = (kept) => (page) =>
  page.addInitScript((kept) => localStorage.setItem("cloth3d.settings.v1", kept), kept);

test("every control changes its own setting and no other, by mouse and by key", async () => {
  const { context, page, complaints } = await visitRunning();
  const usual = await settings(page);
  const names = await page.locator("#controls input, #controls fieldset").evaluateAll((found) => [
    ...new Set(found.map((one) => one.closest("fieldset")?.id ?? one.id)),
  ]);
  assert.ok(names.length >= 11, `${names}`);
  const keys = { scene: "e", fabric: "l", pinning: "p", resolution: "n", paused: " ", wireframe: "f" };
  for (const id of names) {
    const name = id.replace("control-", "");
    const control = page.locator(`#${id}`);
    const before = await settings(page);
    if (await control.evaluate((one) => one.tagName === "FIELDSET")) {
      await control.locator("input:not(:checked)").first().check();
    } else if ((await control.getAttribute("type")) === "range") {
      await control.fill(await control.getAttribute("max"));
    } else {
      await control.click();
    }
    const after = await settings(page);
    const changed = Object.keys(usual).filter((key) => after[key] !== before[key]);
    // Another scene also sets its own fabric.
    const wanted = name === "scene" ? ["scene", "fabric"] : [name];
    assert.deepEqual(changed.toSorted(), wanted.toSorted(), `${id} changed ${changed}`);
    if (keys[name]) {
      await page.locator("#stage").focus();
      await page.keyboard.press(keys[name]);
      assert.notEqual((await settings(page))[name], after[name], `${keys[name]} does nothing`);
    }
    // Back to the first scene: others disable some of the controls.
    if (name === "scene") await control.locator("input").first().check();
  }
  await page.locator("#control-drop").click();
  await waitFrames(page, 4);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("controls without an effect in a scene are disabled there", async () => {
  const { context, page, complaints } = await visitRunning();
  const off = () => page.locator("#controls fieldset, #controls button").evaluateAll((found) =>
    found.filter((one) => one.disabled).map((one) => one.id.replace("control-", "")),
  );
  const scenes = page.locator("#control-scene input");
  for (const [scene, wanted] of [[3, ["fabric", "pinning", "drop"]], [4, ["pinning"]], [5, ["pinning", "resolution", "drop"]], [6, ["pinning", "drop"]], [7, ["pinning"]], [8, []], [0, []]]) {
    await scenes.nth(scene).check();
    assert.deepEqual(await off(), wanted);
    await waitFrames(page, 2);
  }
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the resolution changes the particles, and the panel shows the times of all stages", async () => {
  const { context, page, complaints } = await visitRunning();
  await page.locator("#control-resolution input").last().check();
  assert.equal((await stats(page)).particles, 128 * 128);
  await page.locator("#control-resolution input").first().check();
  assert.equal((await stats(page)).particles, 24 * 24);
  await page.locator("#stages summary").click();
  await waitFrames(page, 6);
  const stages = await page.evaluate(() => window.muslinDemo.stages());
  const named = (name) => stages.find((stage) => stage.name === name)?.milliseconds;
  for (const name of ["forces", "stretch", "normals", "upload", "draw calls"]) {
    assert.ok(named(name) >= 0, `no ${name} in ${JSON.stringify(stages)}`);
  }
  assert.ok(stages.some((stage) => stage.milliseconds > 0), JSON.stringify(stages));
  await page.waitForFunction((count) => document.querySelectorAll("#stage-times dd").length === count, stages.length);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("corrupt and out-of-range settings are corrected, and the stored settings are those in use", async () => {
  for (const kept of ["{ wind:", "null", '{"pinning": "glue"}']) {
    const { context, page, complaints } = await visitRunning({}, storing(kept));
    const { wind, gravity, resolution, pinning } = await settings(page);
    assert.deepEqual({ wind, gravity, resolution, pinning }, { wind: 0.8, gravity: 9.8, resolution: 40, pinning: "top-edge" });
    assert.deepEqual(complaints, []);
    await context.close();
  }
  const wild = '{"wind": 1e9, "gravity": -3, "stiffness": 4000, "damping": 7, "resolution": 100000}';
  const { context, page, complaints } = await visitRunning({}, storing(wild));
  const { wind, gravity, stiffness, damping, resolution } = await settings(page);
  assert.deepEqual([wind, gravity, stiffness, resolution], [3, 0, 12, 40]);
  assert.ok(Math.abs(damping - 0.06) < 1e-6, `damping is ${damping}`);
  assert.deepEqual(JSON.parse(await page.evaluate(() => localStorage.getItem("cloth3d.settings.v1"))), await settings(page));
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the demo runs without localStorage", async () => {
  const { context, page, complaints } = await visitRunning({}, (page) =>
    page.addInitScript(() => {
      const refuse = () => {
        throw new DOMException("denied", "SecurityError");
      };
      Storage.prototype.getItem = refuse;
      Storage.prototype.setItem = refuse;
    }),
  );
  await page.locator("#control-wireframe").click();
  assert.equal((await settings(page)).wireframe, true);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("controls have labels, focus rings and contrast, and the footer has its link", async () => {
  const { context, page, complaints } = await visitRunning();
  const nameless = await page.locator("#controls input").evaluateAll((inputs) =>
    inputs.filter((input) => !input.labels?.[0]?.textContent.trim()).map((input) => input.id),
  );
  assert.deepEqual(nameless, []);
  assert.ok((await page.locator("#stage").getAttribute("aria-label")).length > 40);
  await page.locator("#collapse").focus();
  // Tab reaches every control, and each shows a focus ring.
  const reached = new Set();
  for (let i = 0; i < 24; i++) {
    await page.keyboard.press("Tab");
    const [id, ring] = await page.evaluate(() => {
      const focused = document.activeElement;
      const shown = focused.matches(".segments input") ? focused.nextSibling : focused;
      return [focused.id, getComputedStyle(shown).outlineStyle];
    });
    reached.add(id.replace(/-\d$/, ""));
    if (id) assert.notEqual(ring, "none", `${id} has no focus ring`);
  }
  for (const name of ["wind", "gravity", "stiffness", "damping", "wireframe", "tearing", "blade", "paused", "reset", "drop"]) {
    assert.ok(reached.has(`control-${name}`), `Tab does not reach ${name}: ${[...reached]}`);
  }
  // Contrast on the panel's surface over the brightest part of the background.
  const contrasts = await page.evaluate(() => {
    const luminance = ([r, g, b]) => {
      const linear = (c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
      return 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    };
    const numbers = (colour) => colour.match(/[\d.]+/g).map(Number);
    const [r, g, b, a = 1] = numbers(getComputedStyle(document.getElementById("panel")).backgroundColor);
    const surface = [r, g, b].map((c, i) => a * c + (1 - a) * [30, 34, 48][i]);
    return ["h1", ".name", ".chip", "#stats dt", "#stats dd", "#stages summary", "#controls button"].map((where) => {
      const [high, low] = [luminance(numbers(getComputedStyle(document.querySelector(where)).color)), luminance(surface)];
      return [where, (high + 0.05) / (low + 0.05)];
    });
  });
  for (const [where, contrast] of contrasts) assert.ok(contrast >= 4.5, `${where}: ${contrast}`);
  const link = page.locator("footer a");
  assert.equal(await link.textContent(), "Built with a one-shot prompt from 1ShotGen");
  assert.deepEqual(
    [await link.getAttribute("href"), await link.getAttribute("target"), await link.getAttribute("rel")],
    ["https://1shotgen.com", "_blank", "noopener noreferrer"],
  );
  assert.deepEqual(complaints, []);
  await context.close();
});

test("panel and instructions open and close, and on a narrow screen the panel starts closed", async () => {
  const visited = await visit({ viewport: { width: 390, height: 700 }, reducedMotion: "reduce" });
  const { context, page, complaints } = visited;
  const help = page.locator("#help");
  await help.waitFor({ state: "visible" });
  await waitUntilRunning(visited);
  await help.waitFor({ state: "hidden" });
  const rows = page.locator("#rows");
  assert.equal(await rows.isVisible(), false);
  await page.locator("#collapse").click();
  assert.equal(await rows.isVisible(), true);
  const box = await page.locator("#panel").boundingBox();
  assert.ok(box.x >= 0 && box.x + box.width <= 390 && box.y + box.height <= 700, JSON.stringify(box));
  await page.keyboard.press("c");
  assert.equal(await rows.isVisible(), false);
  await page.keyboard.press("?");
  await help.waitFor({ state: "visible" });
  await page.keyboard.press("Escape");
  await help.waitFor({ state: "hidden" });
  await page.locator("#ask").click();
  await help.waitFor({ state: "visible" });
  await page.mouse.click(200, 300);
  await help.waitFor({ state: "hidden" });
  const transition = await help.evaluate((it) => getComputedStyle(it).transitionDuration);
  assert.ok(parseFloat(transition) <= 0.0011, `with reduced motion there is still a transition: ${transition}`);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("on a phone every target is at least 44 pixels high and wide", async () => {
  const phone = { viewport: { width: 390, height: 844 }, hasTouch: true };
  const { context, page, complaints } = await visitRunning(phone);
  await page.locator("#collapse").tap();
  const { y: top } = await page.locator("#panel").boundingBox();
  await waitUntil(page, () => particle(page, 40 * 40 - 1), ([, y]) => y < top, "the panel covers a corner");
  const targets = page.locator("button:visible, #controls .segments label, #controls input[type=range], summary, footer a");
  assert.ok((await targets.count()) > 30);
  for (const target of await targets.all()) {
    const { width, height } = await target.boundingBox();
    const text = await target.evaluate((it) => it.id || it.textContent.trim());
    assert.ok(width >= 44 && height >= 44, `${text} has ${width} x ${height} pixels`);
  }
  // A switch is smaller than its target, which reaches beyond it.
  for (const toggle of await page.locator("#controls input[type=checkbox]").all()) {
    await toggle.scrollIntoViewIfNeeded();
    const reached = await toggle.evaluate((it) => {
      const { left, top, width, height } = it.getBoundingClientRect();
      const at = (x, y) => document.elementFromPoint(left + width / 2 + x, top + height / 2 + y) === it;
      return [at(-21, 0), at(21, 0), at(0, -21), at(0, 21)];
    });
    assert.deepEqual(reached, [true, true, true, true], await toggle.getAttribute("id"));
  }
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a link names scene and fabric, and unknown names change nothing", async () => {
  const linked = await visitRunning({ path: "?scene=curtain&fabric=denim&wind=3" });
  const { scene, fabric, wind } = await settings(linked.page);
  assert.deepEqual([scene, fabric, wind.toFixed(1)], ["curtain", "denim", "0.8"]);
  assert.ok(await linked.page.locator("#control-scene input").nth(4).isChecked());
  assert.deepEqual(linked.complaints, []);
  await linked.context.close();
  const { context, page, complaints } = await visitRunning({ path: "?scene=rug&fabric=" });
  assert.equal((await settings(page)).scene, "sheet");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a scene has a page of its own, with a picture for previews of links", async () => {
  const { context, page, complaints } = await visitRunning({ path: "storm.html?fabric=denim" });
  const { scene, fabric } = await settings(page);
  assert.deepEqual([scene, fabric], ["storm", "denim"]);
  assert.equal(await page.title(), "Muslin: a torn flag in a storm");
  await checkShareMetadata(page);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("links open the new scenes with their own fabrics, and the mouse walks through the doorway", async () => {
  for (const [scene, fabric] of [["glass", "silk"], ["storm", "flag"], ["doorway", "cotton"]]) {
    const { context, page, complaints } = await visitRunning({ path: `?scene=${scene}` });
    const set = await settings(page);
    assert.deepEqual([set.scene, set.fabric], [scene, fabric]);
    const first = await hash(page);
    await waitUntil(page, () => hash(page), (now) => now !== first, `${scene} does not move`);
    if (scene === "doorway") {
      // The far end of the floor, and then the near one.
      for (const [y, far] of [[40, true], [390, false]]) {
        await page.mouse.move(480, y);
        const walker = () => page.evaluate(() => window.muslinDemo.walker());
        await waitUntil(page, walker, (at) => at[2] < -0.8 === far && Math.abs(at[2]) > 0.6, `nobody walks to ${y}`);
      }
    }
    assert.deepEqual(complaints, []);
    await context.close();
  }
});

test("the keyboard grabs the cloth, pulls it and lets it go", async () => {
  const { context, page, complaints } = await visitRunning();
  const hand = page.locator("#hand");
  const cursor = () => page.evaluate(() => document.getElementById("stage").style.cursor);
  await page.locator("#stage").focus();
  await page.keyboard.press("Enter");
  assert.equal(await hand.isVisible(), true);
  const before = await hand.boundingBox();
  const eye = await cameraPosition(page);
  for (let i = 0; i < 4; i++) await page.keyboard.press("ArrowRight");
  const after = await hand.boundingBox();
  assert.ok(after.x - before.x > 80 && after.y === before.y, JSON.stringify([before, after]));
  assert.ok(distance(await cameraPosition(page), eye) < 0.02, "the arrows turned the camera");
  await page.mouse.move(690, 390);
  await waitUntil(page, cursor, (now) => now === "grabbing", "the keyboard holds no cloth");
  await page.keyboard.press("Enter");
  assert.equal(await hand.isVisible(), false);
  await page.mouse.move(680, 390);
  await waitUntil(page, cursor, (now) => now !== "grabbing", "the keyboard did not let go");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("arrow keys walk the person through the doorway, and the instructions say so", async () => {
  const { context, page, complaints } = await visitRunning({ path: "?scene=doorway", reducedMotion: "reduce" });
  const walker = () => page.evaluate(() => window.muslinDemo.walker());
  const start = await walker();
  assert.ok(start[2] > 0.8, `the person starts at ${start}`);
  await page.keyboard.press("?");
  await page.locator("#help").waitFor();
  const text = await page.locator("#help").innerText();
  assert.match(text, /hold arrow keys to walk/);
  await page.keyboard.press("Escape");
  // One press is a step, also if no frame is drawn while it is held.
  await page.keyboard.press("ArrowUp");
  await waitUntil(page, walker, (at) => start[2] - at[2] > 0.2, "a short press is no step");
  const eye = await cameraPosition(page);
  await page.keyboard.down("ArrowUp");
  await waitUntil(page, walker, (at) => at[2] < -0.6, "nobody walks through the curtain");
  await page.keyboard.down("ArrowLeft");
  await page.keyboard.up("ArrowUp");
  await waitUntil(page, walker, (at) => at[0] < -0.3, "nobody walks to the left");
  await page.keyboard.up("ArrowLeft");
  assert.ok(distance(await cameraPosition(page), eye) < 0.02, "the arrows turned the camera");
  await page.keyboard.press("Shift+ArrowLeft");
  const turned = (at) => distance(at, eye) > 0.05;
  await waitUntil(page, () => cameraPosition(page), turned, "Shift and an arrow do not orbit");
  await page.locator("#control-scene input").first().check();
  assert.equal(await page.locator("#help .walk:not([hidden])").count(), 0);
  await page.locator("#stage").focus();
  const before = await cameraPosition(page);
  await page.keyboard.press("ArrowRight");
  await waitUntil(page, () => cameraPosition(page), (at) => distance(at, before) > 0.05, "an arrow does not orbit the sheet");
  assert.deepEqual(complaints, []);
  await context.close();
});
