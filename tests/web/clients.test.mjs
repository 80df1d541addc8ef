// The packed npm package, installed as users do: in Node, in a page, with Vite and with webpack.

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
/** Address of the same pages under the content security policy `script-src 'self'`. */
const strictUrl = variable("MUSLIN_STRICT");
const here = fileURLToPath(new URL("../clients", import.meta.url));
const modules = fileURLToPath(new URL("../node_modules", import.meta.url));
const golden = (await readFile(new URL("../script.hash", import.meta.url), "utf8")).trim();
const run = promisify(execFile);

let browser;
before(async () => {
  browser = await launch();
  // Tools and three.js are resolved from the parent folder, the package from each project.
  await symlink(modules, join(work, "node_modules"));
});
after(() => browser?.close());

/** Creates a project with the packed package installed, and returns its folder. */
async function createProject(name, ...sources) {
  const dir = join(work, name);
  await mkdir(dir);
  for (const source of [name, ...sources]) await cp(join(here, source), dir, { recursive: true });
  await cp(new URL("../js/script.mjs", import.meta.url), join(dir, "script.mjs"));
  await writeFile(join(dir, "package.json"), JSON.stringify({ name, private: true, type: "module" }));
  const flags = ["--offline", "--ignore-scripts", "--no-audit", "--no-fund"];
  await run("npm", ["install", ...flags, variable("MUSLIN_TARBALL")], { cwd: dir });
  return dir;
}

/** Opens a page of a client from `server` and checks its result. */
async function checkPage(address, server = url) {
  const { context, page, complaints } = await open(browser, {}, server);
  await page.goto(address);
  const result = await resultOf(page);
  assert.deepEqual(complaints, []);
  await context.close();
  assert.deepEqual(result, { version: await packedVersion(), hash: golden, worker: golden, vertices: 1600, held: 1 });
}

/** Returns the `window.result` of a page; undefined if it sets none. */
async function resultOf(page, timeout = 60_000) {
  await page.waitForFunction(() => window.result, null, { timeout }).catch(() => {});
  return page.evaluate(() => window.result);
}

async function packedVersion() {
  return JSON.parse(await readFile(join(work, "node/node_modules/muslin/package.json"), "utf8")).version;
}

test("the package contains every file that it names, and no other", async () => {
  const dir = join(await createProject("node"), "node_modules/muslin");
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

  const filesOf = (to) => (typeof to === "string" ? [to] : Object.values(to).flatMap(filesOf));
  const targets = Object.values(manifest.exports).flatMap(filesOf);
  for (const target of targets) assert.ok(files.includes(target.replace("./", "")), target);
  // Every imported file exists, and every file is imported or exported, except the licences and
  // the README.
  const named = new Set(targets.map((target) => target.replace("./", "")));
  for (const file of files.filter((name) => /\.(js|d\.ts)$/.test(name))) {
    const text = await readFile(join(dir, file), "utf8");
    const isTypes = file.endsWith(".d.ts");
    // Scripts have no comments and no line breaks; types have examples in comments.
    const imports = isTypes ? /^(?:import|export|\}).* from "\.\/([^"]+)"/gm : /\bfrom\s*"\.\/([^"]+)"/g;
    for (const [, name] of text.matchAll(imports)) {
      const wanted = isTypes ? name.replace(/\.js$/, ".d.ts") : name;
      assert.ok(files.includes(wanted), `${file} names ${wanted}`);
      named.add(wanted);
    }
  }
  const left = files.filter((name) => !named.has(name) && !/^(LICENSE-|README)/.test(name));
  assert.deepEqual(left, []);
});

test("Node runs the package as a module, from CommonJS and in a worker, and tsc finds its types as bundlers do", async () => {
  const dir = join(work, "node");
  for (const script of ["module.mjs", "common.cjs"]) {
    const { stdout } = await run(process.execPath, [script], { cwd: dir });
    assert.equal(stdout.trim(), golden, script);
  }
  const tsc = join(modules, "typescript/bin/tsc");
  const flags = ["--noEmit", "--strict", "--target", "es2022", "--module", "esnext", "--moduleResolution", "bundler"];
  await run(process.execPath, [tsc, ...flags, "types.ts"], { cwd: dir });
});

test("a page without a bundler loads the package from its folder", async () => {
  await createProject("page");
  await checkPage(new URL("page/", url).href);
});

test("muslin/no-wasm runs under `script-src 'self'`, and a pointer drags its cloth", async () => {
  await createProject("no-wasm");
  const { context, page, complaints } = await open(browser, { viewport: { width: 400, height: 300 } }, strictUrl);
  await page.goto(new URL("no-wasm/", strictUrl).href);
  const found = { version: await packedVersion(), hash: golden, worker: golden, isForbidden: true };
  assert.deepEqual(await resultOf(page), found);
  const { right } = await page.evaluate(() => window.pulled);
  await page.mouse.move(250, 150); // the middle of the sheet
  await page.mouse.down();
  await page.mouse.move(340, 130, { steps: 6 });
  await page.waitForFunction((right) => window.pulled.held === 1 && window.pulled.right > right + 0.1, right);
  await page.screenshot({ path: join(work, "no-wasm.png") });
  await page.mouse.up();
  await page.waitForFunction(() => window.pulled.held === 0);
  // The only problem is the attempt of the page to use WebAssembly, which must be forbidden.
  assert.deepEqual(complaints, ["error: policy: script-src wasm-eval"]);
  await context.close();
});

test("the package with its wasm module does not start under `script-src 'self'`", async () => {
  const { context, page, complaints } = await open(browser, {}, strictUrl);
  await page.goto(new URL("page/", strictUrl).href);
  assert.equal(await resultOf(page, 3_000), undefined);
  assert.match(complaints.join("\n"), /policy: script-src wasm-eval/);
  await context.close();
});

test("the HTML page of the package's README works as it is", async () => {
  await symlink(join(modules, "three"), join(work, "page/node_modules/three"));
  const readme = await readFile(join(work, "node/node_modules/muslin/README.md"), "utf8");
  const [, pasted] = /```html\n(.*?)```/s.exec(readme);
  const { context, page, complaints } = await open(browser, { viewport: { width: 640, height: 480 } });
  // It has an inline script, so it is served without a content security policy.
  const address = new URL("page/pasted.html", url).href;
  await page.route(address, (route) => route.fulfill({ contentType: "text/html", body: pasted }));
  await page.goto(address);
  const shot = () => page.screenshot();
  await page.waitForFunction(() => document.querySelector("canvas").style.touchAction === "none"); // ClothPointers listens
  await page.evaluate(() => document.querySelector("canvas").addEventListener("gotpointercapture", () => (window.isHeld = true)));
  const first = await shot();
  await page.waitForTimeout(500);
  await page.mouse.move(320, 300);
  await page.mouse.down();
  await page.mouse.move(420, 240, { steps: 4 });
  await page.waitForTimeout(500);
  assert.notDeepEqual(await shot(), first, "the picture does not change");
  assert.ok(await page.evaluate(() => window.isHeld), "the press did not grab the cloth");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a Vite build runs under a strict content security policy", async () => {
  const root = await createProject("vite", "app");
  await build({ root, base: "./", logLevel: "warn", build: { chunkSizeWarningLimit: 1000 } });
  const assets = await readdir(join(root, "dist/assets"));
  assert.ok(assets.some((name) => /^raw_bg-.*\.wasm$/.test(name)), assets.join());
  await checkPage(new URL("vite/dist/", url).href);
});

test("Vite's development server runs the package without configuration", async () => {
  const root = join(work, "vite");
  const server = await createServer({ root, logLevel: "warn", server: { host: "127.0.0.1", port: 0, fs: { strict: false } } });
  try {
    await server.listen();
    const address = `http://127.0.0.1:${server.httpServer.address().port}/`;
    await checkPage(address, address);
  } finally {
    await server.close();
  }
});

test("a webpack build runs under a strict content security policy", async () => {
  const root = await createProject("webpack", "app");
  const compiler = webpack({
    context: root,
    mode: "production",
    entry: "./main.js",
    output: { path: join(root, "dist"), publicPath: "auto" },
    performance: { hints: false }, // it warns about files of half a megabyte
    optimization: { minimize: false },
  });
  const stats = await promisify(compiler.run.bind(compiler))();
  await promisify(compiler.close.bind(compiler))();
  const { errors, warnings } = stats.toJson({ all: false, errors: true, warnings: true });
  assert.deepEqual([...errors, ...warnings], []);
  await cp(join(root, "built.html"), join(root, "dist/index.html"));
  await checkPage(new URL("webpack/dist/", url).href);
});
