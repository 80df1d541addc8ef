// Skins: a fine mesh on a coarse cloth, its views, its streams, tears and lifetime.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";

await init();

const SIDE = 31;

/** Returns a coarse cloth of 1.95 m × 1.95 m. */
const coarseCloth = () => Cloth.grid({ columns: 14, rows: 14, spacing: 0.15 });

/** Returns a sheet of the same size with 31 × 31 vertices. */
function fineSheet() {
  const [positions, indices, uvs] = [[], [], []];
  for (let i = 0; i < SIDE * SIDE; i++) {
    const [u, v] = [(i % SIDE) / (SIDE - 1), Math.floor(i / SIDE) / (SIDE - 1)];
    positions.push(1.95 * u, -1.95 * v, 0);
    uvs.push(u, v);
    if (u === 1 || v === 1) continue;
    indices.push(i, i + SIDE, i + 1, i + 1, i + SIDE, i + SIDE + 1);
  }
  return {
    positions: new Float32Array(positions),
    indices: new Uint32Array(indices),
    uvs: new Float32Array(uvs),
  };
}

test("a skin follows its cloth", () => {
  const [cloth, sheet] = [coarseCloth(), fineSheet()];
  const skin = cloth.skin(sheet);
  assert.deepEqual(skin.indices, sheet.indices);
  assert.deepEqual(skin.uvs, sheet.uvs);
  assert.equal(skin.topologyRevision, 1);
  assert.ok(skin.positions.every((x, i) => Math.abs(x - sheet.positions[i]) < 1e-5));
  cloth.unpinAll();
  cloth.step(30);
  const last = skin.positions.length - 2;
  assert.notEqual(skin.positions[last], sheet.positions[last]);
  for (let i = 0; i < skin.normals.length; i += 3) {
    assert.ok(Math.abs(Math.hypot(...skin.normals.subarray(i, i + 3)) - 1) < 1e-5);
  }
  // A skin of the cloth's own vertices has their positions.
  const own = cloth.skin({ positions: cloth.positions, indices: cloth.indices });
  cloth.step(5);
  assert.deepEqual(own.positions, cloth.positions);
});

test("streams hold the numbers of the views", () => {
  const cloth = coarseCloth();
  const skin = cloth.skin(fineSheet());
  cloth.step(10);
  const count = skin.positions.length / 3;
  const data = new Float32Array(6 * count);
  const written = skin.write([
    { attribute: "position", buffer: data, stride: 24 },
    { attribute: "normal", buffer: data, stride: 24, offset: 12 },
  ]);
  assert.equal(written, count);
  for (let v = 0; v < count; v++) {
    assert.deepEqual(data.subarray(6 * v, 6 * v + 3), skin.positions.subarray(3 * v, 3 * v + 3));
    assert.deepEqual(data.subarray(6 * v + 3, 6 * v + 6), skin.normals.subarray(3 * v, 3 * v + 3));
  }
  assert.throws(() => skin.write([{ attribute: "position", buffer: new Float32Array(3) }]), /streams\[0\].buffer/);
});

test("a cut adds vertices, and a reset removes them", () => {
  const [cloth, sheet] = [coarseCloth(), fineSheet()];
  const skin = cloth.skin(sheet);
  assert.ok(cloth.cut([0.52, -0.4, -1], [0.6, -1.5, -1], [0, 0, 2]) > 0);
  const count = skin.positions.length / 3;
  assert.ok(count > SIDE * SIDE && count <= skin.vertexCapacity);
  assert.equal(skin.topologyRevision, 2);
  assert.equal(skin.indices.length, sheet.indices.length);
  assert.deepEqual(skin.indices.map((v) => skin.sourceVertices[v]), sheet.indices);
  assert.ok(skin.frayed.includes(1));
  assert.equal(skin.frayed.length, count);
  cloth.reset();
  assert.deepEqual(skin.indices, sheet.indices);
});

test("wrong descriptors are refused", () => {
  const [cloth, sheet] = [coarseCloth(), fineSheet()];
  const refuses = (change, message) => assert.throws(() => cloth.skin({ ...sheet, ...change }), message);
  assert.throws(() => cloth.skin(), /`desc` must be an object/);
  refuses({ position: [] }, /did you mean `positions`/);
  refuses({ positions: [0, 1] }, /`positions` must hold a multiple of 3/);
  refuses({ positions: [] }, /`positions` must hold at least 3 vertices/);
  refuses({ positions: sheet.positions.map((x) => x + 9) }, /`positions` must be within half/);
  refuses({ positions: sheet.positions.map(() => NaN) }, /`positions` must be finite/);
  refuses({ indices: [0, 1] }, /`indices` must hold three entries/);
  refuses({ indices: [0, 1, 9999] }, /`indices` must be below 961, but is 9999/);
  refuses({ uvs: [0, 1] }, /`uvs` must have as many entries/);
  refuses({ smoothness: 2 }, /`smoothness` must be from 0 to 1/);
  refuses({ smoothness: "flat" }, /`smoothness` must be a number/);
});

test("a skin throws after it or its cloth was freed", () => {
  const cloth = coarseCloth();
  const [one, two] = [cloth.skin(fineSheet()), cloth.skin(fineSheet())];
  one.free();
  one.free();
  assert.ok(one.isFreed && !two.isFreed);
  assert.throws(() => one.positions, /`skin` must be live, but was freed/);
  assert.ok(two.positions.length > 0);
  cloth.free();
  assert.throws(() => two.positions, /`cloth` must be live, but was freed/);
  assert.throws(() => two.write([]), /`cloth` must be live/);
  two.free();
  assert.throws(() => new two.constructor(), /a skin is made by cloth.skin\(\)/);
});
