// The playground of the site: it steps a cloth, its links reproduce the bits, it shows the errors of
// code where they are, and its code reaches nothing of the site.

import assert from "node:assert/strict";
import { createServer } from "node:http";
import { after, before, test } from "node:test";

import { launch, open, url } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

const page = new URL("playground.html", url).href;

/** Opens the playground, and waits until its code has made a cloth. */
async function visit(address = page, options = {}) {
  const visited = await open(browser, { viewport: { width: 620, height: 560 }, ...options });
  visited.page.setDefaultTimeout(90_000);
  await visited.page.goto(address);
  await visited.page.locator("#ticks").waitFor();
  await visited.page.locator(".cm-content").waitFor();
  return visited;
}

const ticks = async (page) => Number(await page.locator("#ticks").textContent());
const hash = (page) => page.locator("#hash").textContent();
const button = (page, name) => page.getByRole("button", { name, exact: true });

/** Replaces the code and runs it. */
async function type(page, code) {
  await page.locator(".cm-content").fill(code);
  await button(page, "Run").click();
}

/** Sets a control of the panel as a user does. */
async function slide(page, name, value) {
  await page.locator(`input[name=${name}]`).fill(String(value));
}

/** Runs the code anew without time, and steps it. */
async function stepFromStart(page, count) {
  if (await button(page, "Pause").count()) await button(page, "Pause").click();
  await button(page, "Run").click();
  for (let step = 0; step <= count; step++) {
    await page.waitForFunction((step) => document.getElementById("ticks")?.textContent === String(step), step);
    if (step < count) await button(page, "Step").click();
  }
  return hash(page);
}

/** A program that shows a cloth, then does what `more` says. */
const program = (more) => `import { Cloth } from "muslin";
import { onFrame, show } from "playground";
const cloth = Cloth.grid({ columns: 8, rows: 8 });
show(cloth);
onFrame((seconds) => cloth.advance(seconds));
${more}`;

test("the_cloth_moves_and_follows_the_settings", async () => {
  const { page, complaints, context } = await visit();
  const first = await ticks(page);
  await page.waitForFunction((first) => Number(document.getElementById("ticks")?.textContent) > first, first);
  await slide(page, "columns", 12);
  await page.waitForFunction(() => document.querySelector(".state").textContent.includes("144 particles"));
  const calm = await stepFromStart(page, 5);
  await slide(page, "wind", 9);
  assert.notEqual(await stepFromStart(page, 5), calm);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("every_program_to_start_from_runs_for_two_seconds", async () => {
  const { page, complaints, context } = await visit();
  await slide(page, "columns", 12);
  const names = await page.locator(".sample option").allTextContents();
  assert.ok(names.length >= 4, `only ${names.length} programs`);
  for (const name of names) {
    await page.locator(".sample select").selectOption(name);
    await page.waitForFunction(() => Number(document.getElementById("ticks")?.textContent) > 120 || document.querySelector(".error"));
    assert.deepEqual(await page.locator(".error").allTextContents(), [], name);
  }
  assert.match(await page.locator(".log").textContent(), /^cut 1 divided [1-9]/);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a_shared_link_reproduces_settings_code_and_bits_also_at_390_px", async () => {
  const { page, complaints, context } = await visit();
  await page.locator("select[name=fabric]").selectOption("denim");
  await slide(page, "columns", 16);
  await slide(page, "wind", 6.5);
  await page.locator(".cm-content").fill(`${program("")}// shared`);
  const bits = await stepFromStart(page, 6);
  await button(page, "Copy link").click();
  await page.waitForFunction(() => location.hash.startsWith("#play="));
  const link = page.url();
  const other = await visit(link, { viewport: { width: 390, height: 844 }, hasTouch: true });
  assert.equal(await other.page.locator("select[name=fabric]").inputValue(), "denim");
  assert.equal(await other.page.locator("input[name=columns]").inputValue(), "16");
  assert.equal(await other.page.locator("input[name=wind]").inputValue(), "6.5");
  assert.match(await other.page.locator(".cm-content").textContent(), /\/\/ shared/);
  assert.equal(await stepFromStart(other.page, 6), bits);
  await other.page.evaluate(() => history.replaceState(null, "", location.pathname));
  await button(other.page, "Copy link").tap();
  await other.page.waitForFunction(() => location.hash.startsWith("#play="));
  assert.equal(other.page.url(), link);
  assert.deepEqual([...complaints, ...other.complaints], []);
  await context.close();
  await other.context.close();
});

test("a_damaged_link_is_refused_with_a_reason", async () => {
  const { page, context } = await visit(`${url}playground.html#play=AAAA`);
  assert.match(await page.locator(".notice").textContent(), /does not open: the link is damaged/);
  await context.close();
});

test("an_error_of_the_code_is_shown_with_its_line", async () => {
  const { page, context } = await visit();
  for (const [code, line, message] of [
    [program("onFrame(() => { throw new Error('too windy'); });"), 6, /too windy/],
    [program("nothing.at.all;"), 6, /ReferenceError: nothing is not defined/],
    [program("const = 1;"), 6, /SyntaxError/],
    [program("await null; cloth.settings = { substeps: 0 };"), 6, /substeps/],
  ]) {
    await type(page, code);
    await page.waitForFunction((source) => new RegExp(source).test(document.querySelector(".error")?.textContent), message.source);
    assert.match(await page.locator(".error").textContent(), new RegExp(`^Line ${line}: `), code);
    await page.locator(".cm-lint-marker-error").first().waitFor();
  }
  await type(page, program("console.log('all', 'is', { well: true });"));
  await page.locator(".log").waitFor();
  assert.equal(await page.locator(".log").textContent(), 'all is {"well":true}');
  assert.equal(await page.locator(".error").count(), 0);
  await context.close();
});

test("code_reaches_neither_the_site_nor_the_network", async () => {
  const { page, context } = await visit();
  const requests = [];
  const elsewhere = createServer(({ url: path }, response) => {
    requests.push(path);
    response.writeHead(200, { "access-control-allow-origin": "*" }).end("hello");
  });
  await new Promise((done) => elsewhere.listen(0, "127.0.0.1", done));
  const host = `http://127.0.0.1:${elsewhere.address().port}`;
  assert.equal(await (await fetch(`${host}/works`)).text(), "hello");
  const attempts = {
    storage: "localStorage.length",
    cookies: "document.cookie",
    parent: "parent.document.title",
    network: `await fetch("${host}/fetch")`,
    site: `await fetch("${url}index.html")`,
    worker: 'await new Promise((_, fail) => { new Worker("data:text/javascript,").onerror = fail; })',
  };
  const tries = Object.entries(attempts).map(([name, code]) =>
    `try { ${code}; results.push("${name} worked"); } catch { results.push("${name} refused"); }`);
  await type(page, program(`const results = [String(self.origin)];\n${tries.join("\n")}\nconsole.log(results.join(", "));`));
  await page.locator(".log").waitFor();
  const refused = Object.keys(attempts).map((name) => `${name} refused`);
  await page.waitForFunction(() => document.querySelector(".log").textContent.includes("null, "));
  const lines = (await page.locator(".log").textContent()).split("\n");
  assert.equal(lines.at(-1), ["null", ...refused].join(", "));
  // A picture, and leaving for another address, which the page around it does not allow.
  await type(page, program(`new Image().src = "${host}/image"; location.href = "${host}/leave";`));
  await page.waitForTimeout(1500);
  assert.deepEqual(requests, ["/works"]);
  elsewhere.close();
  await context.close();
});

test("the_page_that_runs_code_refuses_to_run_with_an_origin", async () => {
  const { page, context } = await visit();
  await page.evaluate(async (address) => {
    const frame = document.createElement("iframe");
    frame.src = address;
    const heard = [];
    addEventListener("message", (event) => event.source === frame.contentWindow && heard.push(event.data.type));
    document.body.append(frame);
    await new Promise((done) => frame.addEventListener("load", done));
    frame.contentWindow.postMessage({ type: "run", code: "parent.hasRun = true", settings: {}, isPaused: false }, "*");
    await new Promise((done) => setTimeout(done, 1500));
    window.heard = heard;
  }, new URL("play/frame.html", url).href);
  assert.deepEqual(await page.evaluate(() => [window.hasRun, window.heard]), [undefined, []]);
  await context.close();
});
