// `muslin/light` moves cloth with the bits of `muslin`, and throws where a part is missing.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { stat } from "node:fs/promises";
import { test } from "node:test";
import { promisify } from "node:util";

/** Runs tests/js/light.mjs and returns the object that it prints. */
async function run(...words) {
  const script = new URL("light.mjs", import.meta.url).pathname;
  const { stdout } = await promisify(execFile)(process.execPath, [script, ...words]);
  return JSON.parse(stdout);
}

const [light, full] = await Promise.all([run("muslin/light"), run("muslin")]);

test("the light module gives the bits of the full one", () => {
  assert.match(light.hash, /^0x[0-9a-f]{16}$/);
  assert.equal(light.hash, full.hash);
  assert.ok(light.torn > 0, "nothing tore");
  assert.equal(light.torn, full.torn);
});

test("init() of muslin/light loads light_bg.wasm alone", async () => {
  const { size } = await stat(new URL(import.meta.resolve("muslin/light_bg.wasm")));
  assert.deepEqual(light.compiled, [size]);
});

test("what the light module lacks throws an error that names it and changes nothing", () => {
  const where = 'is not in muslin/light; import it from "muslin"';
  const facets = `a convex, mesh or heightfield collider ${where}`;
  assert.deepEqual(light.answers, {
    cut: `\`cut\` ${where}`,
    save: `\`save\` ${where}`,
    restore: `\`Cloth.restore\` ${where}`,
    duplicate: `\`duplicate\` ${where}`,
    sew: `\`sew\` ${where}`,
    skin: `\`skin\` ${where}`,
    surface: `surface self-collision ${where}`,
    made: `surface self-collision ${where}`,
    convex: facets,
    mesh: facets,
    heightfield: facets,
    update: `\`Collider.update\` ${where}`,
    layer: `\`collideWith\` ${where}`,
  });
  assert.ok(light.isUnchanged);
});

test("the full module has what the light one lacks", () => {
  for (const part of ["cut", "save", "duplicate", "sew", "skin", "surface", "made", "convex", "mesh", "heightfield", "layer"]) {
    assert.equal(full.answers[part], "done", part);
  }
});

test("muslin/light asks for muslin in an engine without SIMD", async () => {
  await assert.rejects(run("muslin/light", "no-simd"), /muslin\/light needs WebAssembly with SIMD: import "muslin"/);
});
