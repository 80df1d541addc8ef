// Copies of a cloth, and many cloths that advance in one call.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";

await init();

/** Returns a sheet of 8 × 8 particles, in the wind unless it may sleep. */
function sheet(settings = {}) {
  const cloth = Cloth.grid({ columns: 8, rows: 8, settings });
  if (!settings.sleepSpeed) cloth.wind = { velocity: [0, 0, 3], gust: 0.5 };
  return cloth;
}

test("a duplicate continues with the same bits and is independent", () => {
  const cloth = sheet({ tearing: true });
  cloth.step(10);
  cloth.tearEdge(27, 28);
  cloth.timing = true;
  const copy = cloth.duplicate();
  assert.equal(copy.stateHash(), cloth.stateHash());
  assert.equal(copy.timing, true);
  assert.notEqual(copy.positions.byteOffset, cloth.positions.byteOffset);
  for (const each of [cloth, copy]) each.advance(0.1);
  assert.equal(copy.stateHash(), cloth.stateHash());
  assert.deepEqual(copy.normals, cloth.normals);
  const before = copy.stateHash();
  cloth.step(5);
  cloth.free();
  assert.equal(copy.stateHash(), before);
  assert.throws(() => cloth.duplicate(), /`cloth` must be live/);
  copy.free();
});

test("many cloths in one call get the bits of separate calls", () => {
  const make = () => [...Array(40)].map((_, index) => sheet({ sleepSpeed: index % 3 ? 0.02 : 0, damping: 2 }));
  const [together, apart] = [make(), make()];
  for (let frame = 0; frame < 120; frame++) {
    const seconds = [1 / 60, 0, 0.05, 0.004, 1][frame % 5];
    const ticks = Cloth.advanceMany(together, seconds);
    assert.deepEqual(ticks, Uint32Array.from(apart, (cloth) => cloth.advance(seconds)));
  }
  assert.deepEqual(
    together.map((cloth) => cloth.stateHash()),
    apart.map((cloth) => cloth.stateHash()),
  );
  assert.ok(together[1].asleep && !together[0].asleep);
  assert.deepEqual(Cloth.advanceMany([], 1), new Uint32Array(0));
  for (const cloth of [...together, ...apart]) cloth.free();
});

test("a wrong element or number of seconds is named, and no cloth advances", () => {
  const cloths = [sheet(), sheet(), sheet()];
  const freed = sheet();
  freed.free();
  const before = cloths.map((cloth) => cloth.stateHash());
  for (const wrong of [freed, cloths[0], null, undefined, 7, {}]) {
    const list = [...cloths, wrong];
    assert.throws(() => Cloth.advanceMany(list, 0.1), /^Error: `cloths\[3\]` must be a live cloth/, String(wrong));
  }
  for (const wrong of [undefined, null, cloths[0], "cloths", new Set(cloths)]) {
    assert.throws(() => Cloth.advanceMany(wrong, 0.1), /^Error: `cloths` must be an array/);
  }
  for (const wrong of [undefined, "1", NaN, -1, Infinity]) {
    assert.throws(() => Cloth.advanceMany(cloths, wrong), /^Error: `seconds` must be/, String(wrong));
  }
  assert.deepEqual(
    cloths.map((cloth) => cloth.stateHash()),
    before,
  );
  for (const cloth of cloths) cloth.free();
});
