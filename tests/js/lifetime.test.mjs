// Loading and freeing, and the errors around both.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";

import init, { Cloth, initSync, version } from "muslin";

const { resolve } = createRequire(import.meta.url);
const shipped = (file) => pathToFileURL(resolve(`muslin/${file}`));
const [wasm, manifest] = [shipped("raw_bg.wasm"), shipped("package.json")];

/** Runs `body` in a new Node process, in which nothing is loaded yet. */
async function inFreshNode(body) {
  await inNode(`
    import assert from "node:assert/strict";
    import { readFile } from "node:fs/promises";
    import init, { Cloth, initSync, version } from "muslin";
    const bytes = await readFile(new URL(${JSON.stringify(wasm)}));
    const works = () => { const c = Cloth.grid(); c.step(1); assert.ok(c.stateHash()); c.free(); };
    ${body}`);
}

/** Runs a module that may import the installed packages, and fails if it prints anything. */
async function inNode(module) {
  const args = ["--input-type=module", "--eval", module];
  const { stdout, stderr } = await promisify(execFile)(process.execPath, args, {
    cwd: new URL(".", import.meta.url),
  });
  assert.equal(stdout + stderr, "");
}

test("before init() every constructor throws and says to call init()", () =>
  inFreshNode(`
    for (const use of [() => Cloth.grid(), () => Cloth.mesh({}), () => Cloth.restore(bytes), version]) {
      assert.throws(use, /call await init\\(\\) first/);
    }
  `));

for (const [what, source] of Object.entries({
  "the file beside the module": "undefined",
  "a file URL": `new URL(${JSON.stringify(wasm)})`,
  "a file URL as a string": JSON.stringify(wasm),
  "bytes": "bytes",
  "an ArrayBuffer": "new Uint8Array(bytes).buffer",
  "a promise of bytes": "Promise.resolve(bytes)",
  "a compiled module": "new WebAssembly.Module(bytes)",
  "a response": `new Response(bytes, { headers: { "content-type": "application/wasm" } })`,
  "a response of no type": "Promise.resolve(new Response(bytes))",
  "a data URL": "`data:application/wasm;base64,${bytes.toString('base64')}`",
})) {
  test(`init takes ${what}`, () => inFreshNode(`await init(${source}); works();`));
}

test("initSync takes bytes and modules", async () => {
  await inFreshNode("initSync(bytes); works(); initSync(bytes); await init(); works();");
  await inFreshNode("initSync(new WebAssembly.Module(bytes)); works();");
  await inFreshNode("initSync(); works();"); // in Node the module is embedded
});

test("init() called twice, in sequence or concurrently, loads once", () =>
  inFreshNode(`
    await Promise.all([init(), init(bytes), init()]);
    const cloth = Cloth.grid();
    const { buffer } = cloth.positions;
    await init(bytes);
    await init();
    assert.equal(cloth.positions.buffer, buffer);
    works();
  `));

test("initSync() throws while init() is running", () =>
  inFreshNode(`
    const loading = init();
    assert.throws(() => initSync(bytes), /init\\(\\) is under way/);
    await loading;
    works();
  `));

test("a failed init() says why and can be called again", () =>
  inFreshNode(`
    const empty = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0);
    await assert.rejects(init(empty), /\`source\` must be the raw_bg.wasm of this package/);
    await assert.rejects(init(bytes.subarray(0, 100)), WebAssembly.CompileError);
    await assert.rejects(init(7), /\`source\` must be a URL/);
    await assert.rejects(init({}), /\`source\` must be a URL/);
    await assert.rejects(init(new URL("nowhere.wasm", ${JSON.stringify(wasm)})), /^Error: Muslin cannot read file:.*ENOENT.*: import muslin\\/inline/);
    await assert.rejects(init("nowhere.wasm"), /^Error: Muslin cannot read nowhere.wasm .*: import muslin\\/inline/);
    await assert.rejects(init(new Response("", { status: 404 })), /\`source\` must be found/);
    assert.throws(() => initSync(empty), /\`source\` must be the raw_bg.wasm/);
    assert.throws(() => initSync("file"), /\`source\` must be bytes/);
    assert.throws(() => Cloth.grid(), /call await init/);
    await init();
    works();
  `));

// The HTML page of the README is tested by tests/web/clients.test.mjs.
test("the JavaScript in the package's README runs", async () => {
  const readme = await readFile(new URL("README.md", manifest), "utf8");
  const blocks = [...readme.matchAll(/```js\n(.*?)```/gs)].map(([, code]) => code);
  assert.equal(blocks.length, 3);
  // What works everywhere comes first, also in the README of the repository.
  const repository = await readFile(new URL("../../README.md", import.meta.url), "utf8");
  for (const text of [readme, repository]) {
    const [first] = text.match(/^ *import init, .*/m);
    assert.match(first, /^import init, \{ Cloth \} from "muslin\/inline";/);
  }
  await inNode(`
    const uploads = [];
    const gl = { bufferSubData: (target, at, list) => uploads.push(list) };
    ${blocks.join("")}
    cloth.cut([-1, -1, -1], [3, -1.1, -1], [0, 0, 2]);
    frame(1 / 60);
    if (uploads.length !== 2 || !uploads[1].every(Number.isFinite)) throw new Error("no vertices were written");`);
});

test("version() returns the version of the package", async () => {
  await init();
  assert.equal(version(), JSON.parse(await readFile(manifest, "utf8")).version);
});

test("free() can be called twice, and every use after it throws", async () => {
  await init();
  const cloth = Cloth.grid();
  const [grab, collider] = [cloth.grabParticle(800), cloth.addCollider()];
  assert.equal(cloth.isFreed, false);
  cloth.free();
  cloth.free();
  assert.equal(cloth.isFreed, true);
  const freed = /`cloth` must be live, but was freed/;
  const calls = {
    advance: [0],
    velocity: [0],
    mass: [0],
    setPosition: [0, [0, 0, 0]],
    setVelocity: [0, [0, 0, 0]],
    pin: [0],
    unpin: [0],
    setPinTargets: [[0], [0, 0, 0]],
    raycast: [[0, 0, 1], [0, 0, -1]],
    grabRay: [[0, 0, 1], [0, 0, -1]],
    grabParticle: [0],
    changes: [0],
    cut: [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
    tearEdge: [0, 1],
  };
  for (const [name, { get, set, value }] of Object.entries(
    Object.getOwnPropertyDescriptors(Cloth.prototype),
  )) {
    if (["constructor", "free", "isFreed"].includes(name)) continue;
    if (value) assert.throws(() => cloth[name](...(calls[name] ?? [])), freed, name);
    if (get) assert.throws(() => cloth[name], freed, name);
    if (set) assert.throws(() => (cloth[name] = {}), freed, name);
  }
  for (const use of [() => grab.moveTo([0, 0, 0]), () => grab.release()]) assert.throws(use, freed);
  for (const use of [() => collider.moveTo([0, 0, 0]), () => collider.remove()]) assert.throws(use, freed);
});

test("Symbol.dispose frees the cloth, as `using` does", async () => {
  await init();
  const cloth = Cloth.grid();
  const symbols = Object.getOwnPropertySymbols(Cloth.prototype);
  assert.deepEqual(symbols, Symbol.dispose ? [Symbol.dispose] : [], "if this Node has Symbol.dispose");
  for (const dispose of symbols) cloth[dispose]();
  assert.equal(cloth.isFreed, symbols.length > 0);
});

test("a grab is stale after its release and after a reset", async () => {
  await init();
  const cloth = Cloth.grid();
  const stale = /`grab` must be a live grab of this cloth/;
  for (const end of [(grab) => grab.release(), () => cloth.reset()]) {
    const grab = cloth.grabParticle(800);
    end(grab);
    const other = cloth.grabParticle(800);
    assert.throws(() => grab.release(), stale);
    assert.throws(() => grab.moveTo([0, 0, 0]), stale);
    other.release();
  }
});

test("constructors of cloths, grabs and colliders throw when called directly", async () => {
  await init();
  const cloth = Cloth.grid();
  assert.throws(() => new Cloth(), /Cloth.grid\(\)/);
  assert.throws(() => new (cloth.grabParticle(800).constructor)(), /cloth.grabRay\(\)/);
  assert.throws(() => new (cloth.addCollider().constructor)(), /cloth.addCollider\(\)/);
});

test("cloths that are not freed are garbage-collected", async () => {
  await init();
  setFlagsFromString("--expose-gc");
  const collect = runInNewContext("gc");
  const bytes = () => Cloth.grid({ columns: 2, rows: 2 }).positions.buffer.byteLength;
  for (let i = 0; i < 60; i++) {
    Cloth.grid({ columns: 200, rows: 200 }).step(1);
    collect();
    await new Promise(setImmediate);
  }
  const each = Cloth.grid({ columns: 200, rows: 200 }).stats.bytes;
  assert.ok(bytes() < 20 * each, `60 cloths of ${each} bytes take ${bytes()} bytes`);
});

test("creating, tearing and freeing a thousand cloths does not grow the memory", async () => {
  await init();
  const memory = () => {
    const cloth = Cloth.grid({ columns: 2, rows: 2 });
    const { byteLength } = cloth.positions.buffer;
    cloth.free();
    return byteLength;
  };
  const live = () => {
    const cloth = Cloth.grid({ columns: 24, rows: 24, settings: { tearing: true } });
    const grab = cloth.grabParticle(300);
    cloth.addCollider();
    grab.moveTo([0.6, -0.6, 0.5]);
    cloth.step(1);
    assert.ok(cloth.cut([-1, -0.5, -1], [3, -0.55, -1], [0, 0, 2]) > 20);
    assert.ok(cloth.save().length > 0 && cloth.events().length > 0);
    cloth.writeIndices(new Uint32Array(cloth.indexCapacity));
    return cloth;
  };
  for (let i = 0; i < 20; i++) live().free();
  const before = memory();
  for (let i = 0; i < 1000; i++) live().free();
  assert.equal(memory(), before);
});

test("a new cloth grows the memory in one step, so that garbage is hardly collected", async () => {
  await inNode(`
    import assert from "node:assert/strict";
    import { PerformanceObserver, constants } from "node:perf_hooks";
    import init, { Cloth } from "muslin";
    await init();
    let collections = 0;
    const isMajor = ({ detail }) => detail.kind === constants.NODE_PERFORMANCE_GC_MAJOR;
    const count = (list) => (collections += list.getEntries().filter(isMajor).length);
    new PerformanceObserver(count).observe({ entryTypes: ["gc"] });
    const grid = Cloth.grid();
    const mesh = { positions: grid.positions.slice(), indices: grid.indices.slice() };
    const saved = grid.save();
    const kept = [];
    for (const make of [() => Cloth.grid(), () => Cloth.mesh(mesh), () => Cloth.restore(saved)]) {
      collections = 0;
      for (let i = 0; i < 25; i++) kept.push(make());
      await new Promise((resolve) => setTimeout(resolve, 50));
      assert.ok(collections < 50, \`\${collections} collections for 25 cloths, by \${make}\`);
    }
    assert.equal(kept.filter(({ isFreed }) => isFreed).length, 0);
  `);
});

test("forgotten cloths are counted, and one warning says to free them", async () => {
  await inNode(`
    import assert from "node:assert/strict";
    import init, { Cloth } from "muslin";
    await init();
    const warnings = [];
    console.warn = (text) => warnings.push(text);
    const make = () => Cloth.grid({ columns: 200, rows: 200 });
    const { bytes } = make().stats;
    for (let i = 0; i < 40; i++) make().free();
    for (let i = 0; i < 30; i++) make();
    assert.ok(31 * bytes > 2 ** 28, "the cloths are too small for a warning");
    assert.deepEqual(warnings, [], "freed cloths count, or few cloths are enough");
    for (let i = 0; i < 3; i++) make();
    const [warning, ...others] = warnings;
    assert.match(warning, /^Muslin: 32 cloths hold \\d+ MiB. Call free\\(\\)/);
    const held = Number(/hold (\\d+) MiB/.exec(warning)[1]);
    assert.equal(held, Math.round((32 * bytes) / 2 ** 20));
    assert.deepEqual(others, []);
  `);
});

test("cloths and handles work through proxies of them, as Vue makes", async () => {
  await init();
  const through = (object) => new Proxy(object, {});
  const target = Cloth.grid();
  const cloth = through(target);
  const twin = Cloth.grid();
  const play = (cloth, wrap) => {
    cloth.wind = { velocity: [0, 0, 2] };
    const collider = wrap(cloth.addCollider({ shape: "sphere", position: [1, -1, 0.6], radius: 0.5 }));
    const attachment = wrap(cloth.attach([0, 1], [0, 0, 0]));
    const grab = wrap(cloth.grabParticle(800));
    cloth.step(10);
    collider.moveTo([1, -1, 0.4]);
    attachment.moveTo([0, 0.1, 0], [0, 0, 0, 1]);
    grab.moveTo([1, -1, 0.5]);
    cloth.advance(1 / 30);
    assert.equal(collider.impulse.linear.length, 3);
    assert.deepEqual([...attachment.particles], [0, 1]);
    grab.release();
    attachment.detach();
    collider.remove();
    cloth.step(5);
    return cloth.stateHash();
  };
  assert.equal(play(cloth, through), play(twin, (handle) => handle));
  assert.equal(cloth.positions, target.positions);
  cloth.free();
  assert.ok(cloth.isFreed && target.isFreed);
});

test("methods of another object say which class they belong to", async () => {
  await init();
  const cloth = Cloth.grid();
  const { advance } = cloth;
  for (const wrong of [undefined, {}]) {
    assert.throws(() => advance.call(wrong, 1), /`this` must be a Cloth/);
  }
  assert.throws(() => cloth.addCollider().remove.call({}), /`this` must be a Collider/);
  assert.throws(() => cloth.grabParticle(8).release.call({}), /`this` must be a Grab/);
  assert.equal(cloth.constructor.name, "Cloth");
});
