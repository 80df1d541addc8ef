// The site: its links, its policy, its search, its pages at two widths in light and dark, the demo,
// and the playground with its links and its errors.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { launch, open, url, variable } from "./browser.mjs";
import { brokenLinks, pagesIn } from "./site-links.mjs";

const [shots, site, modules] = ["MUSLIN_SHOTS", "MUSLIN_SITE", "MUSLIN_SITE_MODULES"].map(variable);

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

const WIDE = { width: 1440, height: 900 };
const NARROW = { width: 390, height: 844 };

/** One page of each kind. */
const PAGES = {
  landing: "",
  manual: "manual/materials.html",
  integration: "manual/integration.html",
  godot: "manual/godot.html",
  unity: "manual/unity.html",
  "api-c": "api/c/functions.html",
  "api-js": "api/javascript/muslin/classes/Cloth.html",
  "api-python": "api/python/cloth.html",
  "api-rust": "api/rust/muslin/struct.Cloth.html",
  playground: "playground.html",
  benchmarks: "benchmarks.html",
};

/** Pages whose colours others choose. */
const FOREIGN = ["api-rust"];

async function visit(path, options = {}) {
  const visited = await open(browser, { viewport: WIDE, ...options });
  visited.page.setDefaultTimeout(90_000);
  await visited.page.goto(new URL(path, url).href);
  return visited;
}

/** The complaints but for requests that ended with the visit: VitePress loads linked pages early. */
const problems = (complaints) => complaints.filter((text) => !text.endsWith("net::ERR_ABORTED"));

test("every_internal_link_leads_to_a_page_and_a_place_of_the_site", async () => {
  const { broken, count } = await brokenLinks(site);
  assert.ok(count > 5000, `only ${count} links were found`);
  assert.deepEqual(broken, []);
});

test("every_page_has_a_policy_without_unsafe_scripts_or_other_hosts", async () => {
  for (const page of await pagesIn(site)) {
    const [, policy] = (await readFile(join(site, page), "utf8")).match(/http-equiv="Content-Security-Policy"\s+content="([^"]*)"/) ?? [];
    assert.ok(policy, `${page} has no policy`);
    const [scripts] = policy.match(/script-src [^;]*/);
    assert.ok(!/unsafe-inline|'unsafe-eval'|https?:|\*/.test(scripts), `${page}: ${scripts}`);
    assert.ok(!/https?:|\*/.test(policy), `${page}: ${policy}`);
  }
});

test("the_policy_is_active", async () => {
  const { page, context } = await visit("benchmarks.html");
  const refused = await page.evaluate(async () => {
    const violations = [];
    addEventListener("securitypolicyviolation", (event) => violations.push(event.effectiveDirective));
    const script = document.createElement("script");
    script.textContent = "window.hasRun = true";
    document.body.append(script);
    await fetch("https://example.org/").catch(() => {});
    await new Promise((done) => setTimeout(done, 100));
    return { violations, hasRun: Boolean(window.hasRun) };
  });
  assert.deepEqual(refused, { violations: ["script-src-elem", "connect-src"], hasRun: false });
  await context.close();
});

for (const [size, viewport] of [["1440", WIDE], ["390", NARROW]]) {
  for (const colorScheme of ["light", "dark"]) {
    test(`pages_are_readable_at_${size}_px_in_${colorScheme}_and_log_nothing`, async () => {
      const axe = await readFile(join(modules, "axe-core/axe.min.js"), "utf8");
      const { page, complaints, context } = await visit("", { viewport, colorScheme, reducedMotion: "reduce" });
      for (const [name, path] of Object.entries(PAGES)) {
        await page.goto(new URL(path, url).href);
        await page.waitForLoadState("load");
        if (!FOREIGN.includes(name)) await page.waitForFunction(() => document.querySelector("#app").__vue_app__);
        if (name === "playground") await page.locator("#ticks").waitFor();
        const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(overflow <= 0, `${name} is ${overflow} px too wide`);
        await page.screenshot({ path: join(shots, `${name}-${size}-${colorScheme}.png`) });
        if (FOREIGN.includes(name)) continue;
        await page.evaluate(axe);
        const violations = await page.evaluate(async () => {
          const { violations } = await window.axe.run(document, { runOnly: ["wcag2a", "wcag2aa"], iframes: false });
          return violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map(({ html, failureSummary }) => `${html.slice(0, 200)} ${failureSummary}`).join(" | ")}`);
        });
        assert.deepEqual(violations, [], name);
      }
      assert.deepEqual(problems(complaints), []);
      await context.close();
    });
  }
}

test("the_search_finds_tethers_and_opens_with_a_key", async () => {
  const { page, complaints, context } = await visit("manual/");
  await page.waitForFunction(() => document.querySelector("#app")?.__vue_app__);
  await page.keyboard.press("Control+k");
  const input = page.locator(".VPLocalSearchBox input");
  await input.fill("tether");
  await page.locator(".VPLocalSearchBox .result").first().waitFor();
  const titles = (await page.locator(".VPLocalSearchBox .result").allTextContents()).join("\n");
  assert.match(titles, /tether/i);
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => location.pathname !== "/manual/" && /tether/i.test(document.querySelector("main").textContent));
  assert.deepEqual(problems(complaints), []);
  await context.close();
});

test("the_search_and_the_menu_work_at_390_px", async () => {
  const { page, complaints, context } = await visit("manual/", { viewport: NARROW, hasTouch: true });
  await page.waitForFunction(() => document.querySelector("#app")?.__vue_app__);
  await page.getByRole("button", { name: "Search" }).tap();
  await page.locator(".VPLocalSearchBox input").fill("Godot");
  const result = page.locator(".VPLocalSearchBox .result", { hasText: "Godot" }).first();
  await result.tap();
  await page.waitForFunction(() => /Godot/.test(document.querySelector("main h1")?.textContent));
  await page.locator(".VPNavBarHamburger").tap();
  await page.locator(".VPNavScreen").getByRole("link", { name: "Benchmarks" }).tap();
  await page.locator("h1", { hasText: "Benchmarks" }).waitFor();
  assert.deepEqual(problems(complaints), []);
  await context.close();
});

test("words_and_numbers_in_tables_stay_whole_at_390_px", async () => {
  const { page, context } = await visit("", { viewport: NARROW });
  for (const name of ["godot", "integration", "performance"]) {
    await page.goto(new URL(`manual/${name}.html`, url).href);
    const broken = await page.evaluate(() => {
      /** The number of lines that a word without a place to break takes. */
      const lines = (word, node, start) => {
        const range = document.createRange();
        range.setStart(node, start);
        range.setEnd(node, start + word.length);
        return new Set([...range.getClientRects()].map(({ top }) => Math.round(top))).size;
      };
      const found = [];
      for (const cell of document.querySelectorAll(".vp-doc td")) {
        const walker = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
        while (walker.nextNode()) {
          for (const { 0: word, index } of walker.currentNode.textContent.matchAll(/[\w.]+/g)) {
            if (lines(word, walker.currentNode, index) > 1) found.push(word);
          }
        }
      }
      return found;
    });
    assert.deepEqual(broken, [], name);
  }
  await context.close();
});

test("links_of_the_menu_and_to_the_rust_reference_open", async () => {
  const { page, complaints, context } = await visit("");
  for (const name of ["Manual", "API", "Playground", "Benchmarks"]) {
    await page.locator(".VPNavBarMenu").getByRole("link", { name, exact: true }).click();
    await page.waitForFunction((name) => document.querySelector("h1")?.textContent.toLowerCase().includes(name.toLowerCase()), name);
  }
  for (const [part, name] of [["main", "crate muslin"], [".VPSidebar", "Rust"]]) {
    await page.goto(new URL("api/", url).href);
    await page.locator(part).getByRole("link", { name }).click();
    await page.locator("h1", { hasText: "Crate muslin" }).waitFor();
    await page.getByRole("link", { name: "Muslin’s site" }).click();
    await page.getByRole("button", { name: "Run the demo" }).waitFor();
  }
  assert.deepEqual(problems(complaints), []);
  await context.close();
});

test("the_demo_starts_when_it_is_asked_to", async () => {
  const { page, complaints, context } = await visit("", { viewport: { width: 1100, height: 620 } });
  assert.equal(page.frames().length, 1, "the demo loads before anybody wants it");
  await page.getByRole("button", { name: "Run the demo" }).click();
  await page.locator(".stage iframe").waitFor();
  const frame = page.frameLocator(".stage iframe");
  await frame.locator("html[data-state=running]").waitFor({ timeout: 180_000 });
  assert.deepEqual(problems(complaints), []);
  await context.close();
});
