// The script gives the same bits in JavaScript as in Rust and C.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";

import init, { Cloth } from "muslin";
import { hexOf, playScript } from "./script.mjs";

await init();

test("the script ends with the golden hash", async () => {
  const golden = (await readFile(new URL("../script.hash", import.meta.url), "utf8")).trim();
  const cloth = playScript(Cloth);
  assert.equal(hexOf(cloth.stateHash()), golden);
  const torn = cloth.events().filter(({ kind }) => kind === "edge-torn");
  assert.ok(torn.length >= 10, `the script must tear the cloth, but tore ${torn.length} edges`);
  assert.deepEqual(cloth.events(), [], "events() removes the events");
  cloth.free();
});

test("a restored cloth continues with the same bits", () => {
  const straight = playScript(Cloth);
  const saved = straight.save();
  const restored = Cloth.restore(saved);
  assert.equal(restored.stateHash(), straight.stateHash());
  for (const cloth of [straight, restored]) {
    cloth.step(60);
    cloth.tearEdge(400, 401);
    cloth.step(60);
  }
  assert.equal(restored.stateHash(), straight.stateHash());
  assert.deepEqual(restored.save(), straight.save());
  assert.notDeepEqual(straight.save(), saved);
});

test("a reset cloth moves as a new one", () => {
  const old = playScript(Cloth);
  old.reset();
  const { settings, material, wind } = old;
  const fresh = Cloth.grid({ settings, material });
  fresh.wind = wind;
  fresh.addCollider({ position: [0, -2.5, 0] });
  for (const cloth of [old, fresh]) cloth.step(100);
  assert.equal(old.stateHash(), fresh.stateHash());
});

test("plain arrays and typed arrays make the same cloth", () => {
  const positions = [0, 0, 0, 1, 0, 0, 0, -1, 0, 1, -1, 0];
  const [indices, uvs, pinned] = [[0, 2, 1, 1, 2, 3], [0, 1, 1, 1, 0, 0, 1, 0], [0, 1]];
  const plain = Cloth.mesh({ positions, indices, uvs, pinned, material: "paper" });
  const typed = Cloth.mesh({
    positions: Float64Array.from(positions),
    indices: Uint16Array.from(indices),
    uvs: Float32Array.from(uvs),
    pinned: Uint32Array.from(pinned),
    material: { preset: "paper" },
  });
  for (const cloth of [plain, typed]) {
    assert.deepEqual([...cloth.pinned], [0, 1]);
    cloth.step(30);
  }
  assert.equal(plain.stateHash(), typed.stateHash());
  assert.deepEqual([...plain.uvs], uvs);
});

test("free fall drops half g t squared", () => {
  const positions = [0, 0, 0, 1, 0, 0, 0, -1, 0];
  const cloth = Cloth.mesh({
    positions,
    indices: [0, 2, 1],
    settings: { damping: 0 },
    material: { drag: 0 },
  });
  cloth.step(60);
  const drop = -cloth.positions[1];
  assert.ok(Math.abs(drop - 0.5 * 9.81) < 0.03, `fell ${drop} m in a second`);
  const speed = -cloth.velocity(0)[1];
  assert.ok(Math.abs(speed - 9.81) < 0.03, `falls at ${speed} m/s after a second`);
  assert.ok(Math.abs(cloth.time - 1) < 1e-5, `its time is ${cloth.time} s`);
});
