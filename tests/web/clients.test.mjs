// The packed npm package, installed and used as others do: in node, from a page, with Vite and with webpack.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { cp, mkdir, readFile, readdir, symlink, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

import { build, createServer } from "vite";
import webpack from "webpack";

import { launch, open, url, variable } from "./browser.mjs";

const work = variable("MUSLIN_WORK");
/** As `url`, under a policy of `script-src 'self'` and nothing else. */
const strict = variable("MUSLIN_STRICT");
const here = fileURLToPath(new URL("../clients", import.meta.url));
const modules = fileURLToPath(new URL("../node_modules", import.meta.url));
const golden = (await readFile(new URL("../script.hash", import.meta.url), "utf8")).trim();
const run = promisify(execFile);

let browser;
before(async () => {
  browser = await launch();
  // Tools and three.js are found a folder above; the package itself in each project.
  await symlink(modules, join(work, "node_modules"));
});
after(() => browser?.close());

/** A project of this name with the packed package in it; gives its folder. */
async function project(name, ...sources) {
  const dir = join(work, name);
  await mkdir(dir);
  for (const source of [name, ...sources]) await cp(join(here, source), dir, { recursive: true });
  await cp(new URL("../js/script.mjs", import.meta.url), join(dir, "script.mjs"));
  await writeFile(join(dir, "package.json"), JSON.stringify({ name, private: true, type: "module" }));
  const how = ["--offline", "--ignore-scripts", "--no-audit", "--no-fund"];
  await run("npm", ["install", ...how, variable("MUSLIN_TARBALL")], { cwd: dir });
  return dir;
}

/** Opens a page of a client, and looks at what it found; `server` is where it comes from. */
async function visit(address, server = url) {
  const { context, page, complaints } = await open(browser, {}, server);
  await page.goto(address);
  const result = await resultOf(page);
  assert.deepEqual(complaints, []);
  await context.close();
  assert.deepEqual(result, { version: await packedVersion(), hash: golden, worker: golden, vertices: 1600, held: 1 });
}

/** What a page found; nothing if it finds nothing. */
async function resultOf(page, timeout = 60_000) {
  await page.waitForFunction(() => window.result, null, { timeout }).catch(() => {});
  return page.evaluate(() => window.result);
}

async function packedVersion() {
  return JSON.parse(await readFile(join(work, "node/node_modules/muslin/package.json"), "utf8")).version;
}

test("the package holds what it says, and nothing that it does not need", async () => {
  const dir = join(await project("node"), "node_modules/muslin");
  const files = (await readdir(dir)).sort();
  const manifest = JSON.parse(await readFile(join(dir, "package.json"), "utf8"));
  const { version, commit, compiler } = JSON.parse(await readFile(join(dir, "build.json"), "utf8"));
  const cargo = await readFile(new URL("../../Cargo.toml", import.meta.url), "utf8");
  assert.equal(version, /^version = "(.*)"$/m.exec(cargo)[1]);
  assert.equal(manifest.version, version);
  assert.match(compiler, /^rustc /);
  assert.match(commit ?? "0".repeat(40), /^[0-9a-f]{40}(-dirty)?$/);
  assert.equal(manifest.sideEffects, false);
  assert.deepEqual([manifest.dependencies, manifest.scripts], [undefined, undefined]);
  for (const license of ["LICENSE-MIT", "LICENSE-APACHE", "README.md"]) assert.ok(files.includes(license), license);

  const targets = Object.values(manifest.exports).flatMap((to) => (typeof to === "string" ? [to] : Object.values(to)));
  for (const target of targets) assert.ok(files.includes(target.replace("./", "")), target);
  // What is named by a file is there; what is there is named by a file, or is for people.
  const named = new Set(targets.map((target) => target.replace("./", "")));
  for (const file of files.filter((name) => /\.(js|d\.ts)$/.test(name))) {
    const text = await readFile(join(dir, file), "utf8");
    for (const [, name] of text.matchAll(/^(?:import|export|\}).* from "\.\/([^"]+)"/gm)) {
      const isTypes = file.endsWith(".d.ts");
      const wanted = isTypes ? name.replace(/\.js$/, ".d.ts") : name;
      assert.ok(files.includes(wanted), `${file} names ${wanted}`);
      named.add(wanted);
    }
  }
  const left = files.filter((name) => !named.has(name) && !/^(LICENSE-|README)/.test(name));
  assert.deepEqual(left, []);
});

test("node: as a module, from CommonJS, in a worker, and with the types that bundlers find", async () => {
  const dir = join(work, "node");
  for (const script of ["module.mjs", "common.cjs"]) {
    const { stdout } = await run(process.execPath, [script], { cwd: dir });
    assert.equal(stdout.trim(), golden, script);
  }
  const tsc = join(modules, "typescript/bin/tsc");
  const how = ["--noEmit", "--strict", "--target", "es2022", "--module", "esnext", "--moduleResolution", "bundler"];
  await run(process.execPath, [tsc, ...how, "types.ts"], { cwd: dir });
});

test("a page without a bundler, from its own folder", async () => {
  await project("page");
  await visit(new URL("page/", url).href);
});

test("a page that may run its own scripts and nothing else", async () => {
  await project("no-wasm");
  const { context, page, complaints } = await open(browser, { viewport: { width: 400, height: 300 } }, strict);
  await page.goto(new URL("no-wasm/", strict).href);
  const found = { version: await packedVersion(), hash: golden, worker: golden, isForbidden: true };
  assert.deepEqual(await resultOf(page), found);
  const { right } = await page.evaluate(() => window.pulled);
  await page.mouse.move(250, 150); // amid the sheet
  await page.mouse.down();
  await page.mouse.move(340, 130, { steps: 6 });
  await page.waitForFunction((right) => window.pulled.held === 1 && window.pulled.right > right + 0.1, right);
  await page.screenshot({ path: join(work, "no-wasm.png") });
  await page.mouse.up();
  await page.waitForFunction(() => window.pulled.held === 0);
  // It tried WebAssembly, to see that it may not have it; there is nothing else to complain about.
  assert.deepEqual(complaints, ["error: policy: script-src wasm-eval"]);
  await context.close();
});

test("under such a policy the package with its module cannot start", async () => {
  const { context, page, complaints } = await open(browser, {}, strict);
  await page.goto(new URL("page/", strict).href);
  assert.equal(await resultOf(page, 3_000), undefined);
  assert.match(complaints.join("\n"), /policy: script-src wasm-eval/);
  await context.close();
});

test("the page of the package's README, pasted", async () => {
  await symlink(join(modules, "three"), join(work, "page/node_modules/three"));
  const readme = await readFile(join(work, "node/node_modules/muslin/README.md"), "utf8");
  const [, pasted] = /```html\n(.*?)```/s.exec(readme);
  const { context, page, complaints } = await open(browser, { viewport: { width: 640, height: 480 } });
  // It has its script inside, which only a page without a policy may have.
  const address = new URL("page/pasted.html", url).href;
  await page.route(address, (route) => route.fulfill({ contentType: "text/html", body: pasted }));
  await page.goto(address);
  const shot = () => page.screenshot();
  await page.waitForFunction(() => document.querySelector("canvas").style.touchAction === "none"); // it listens
  await page.evaluate(() => document.querySelector("canvas").addEventListener("gotpointercapture", () => (window.holds = true)));
  const first = await shot();
  await page.waitForTimeout(500);
  await page.mouse.move(320, 300);
  await page.mouse.down();
  await page.mouse.move(420, 240, { steps: 4 });
  await page.waitForTimeout(500);
  assert.notDeepEqual(await shot(), first, "nothing moves");
  assert.ok(await page.evaluate(() => window.holds), "the press took no hold of the cloth");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("Vite, built and served under a strict policy", async () => {
  const root = await project("vite", "app");
  await build({ root, base: "./", logLevel: "warn", build: { chunkSizeWarningLimit: 1000 } });
  const assets = await readdir(join(root, "dist/assets"));
  assert.ok(assets.some((name) => /^raw_bg-.*\.wasm$/.test(name)), assets.join());
  await visit(new URL("vite/dist/", url).href);
});

test("Vite's server for development, as it is", async () => {
  const root = join(work, "vite");
  const server = await createServer({ root, logLevel: "warn", server: { host: "127.0.0.1", port: 0, fs: { strict: false } } });
  try {
    await server.listen();
    const address = `http://127.0.0.1:${server.httpServer.address().port}/`;
    await visit(address, address);
  } finally {
    await server.close();
  }
});

test("webpack, served under a strict policy", async () => {
  const root = await project("webpack", "app");
  const compiler = webpack({
    context: root,
    mode: "production",
    entry: "./main.js",
    output: { path: join(root, "dist"), publicPath: "auto" },
    performance: { hints: false }, // it finds half a megabyte a lot
    optimization: { minimize: false },
  });
  const stats = await promisify(compiler.run.bind(compiler))();
  await promisify(compiler.close.bind(compiler))();
  const { errors, warnings } = stats.toJson({ all: false, errors: true, warnings: true });
  assert.deepEqual([...errors, ...warnings], []);
  await cp(join(root, "built.html"), join(root, "dist/index.html"));
  await visit(new URL("webpack/dist/", url).href);
});
