// Sewing and pressure: a sheet sewn to a tube, stitches that tear, a tetrahedron that is inflated.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";

await init();

const [COLUMNS, ROWS] = [12, 6];
const sheet = (pinMode) => Cloth.grid({ columns: COLUMNS, rows: ROWS, pinMode });
const pairs = Array.from({ length: ROWS }, (_, row) => [row * COLUMNS, row * COLUMNS + COLUMNS - 1]);

test("sewn borders meet exactly, from either form of the pairs", () => {
  const [cloth, same] = [sheet("none"), sheet("none")];
  cloth.sew(pairs, { speed: 2 });
  same.sew(new Uint32Array(pairs.flat()), { speed: 2, kind: "weld" });
  for (const each of [cloth, same]) each.step(60);
  for (const [a, b] of pairs) assert.deepEqual(cloth.position(a), cloth.position(b));
  assert.equal(cloth.stateHash(), same.stateHash());
  const copy = Cloth.restore(cloth.save());
  for (const each of [cloth, copy]) each.step(10);
  assert.equal(copy.stateHash(), cloth.stateHash());
});

test("a torn stitch is an event", () => {
  const cloth = sheet("top-corners");
  cloth.sew(pairs.slice(1), { speed: 2, kind: "stitch", tearForce: 1e-4 });
  cloth.step(120);
  const torn = cloth.events().filter((event) => event.kind === "stitch-torn");
  assert.deepEqual(
    torn.map(({ particleA, particleB }) => [particleA, particleB]).sort((a, b) => a[0] - b[0]),
    pairs.slice(1),
  );
});

test("pressure inflates a closed mesh", () => {
  const cloth = Cloth.mesh({
    positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1],
    indices: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3],
    material: { stretchStiffnessWarp: 100, stretchStiffnessWeft: 100 },
    settings: { gravity: [0, 0, 0] },
  });
  assert.equal(cloth.settings.pressure, 0);
  cloth.settings = { pressure: 20 };
  assert.equal(cloth.settings.pressure, 20);
  cloth.step(120);
  const [a, b] = [cloth.position(0), cloth.position(1)];
  assert.ok(Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) > 1.01);
});
