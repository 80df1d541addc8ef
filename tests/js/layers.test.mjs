// Layers: the surface of another cloth as a collider.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";

await init();

/** A horizontal sheet of 7 × 7 particles around the y axis. */
function sheet(y, spacing, pinMode) {
  const origin = [-3 * spacing, y, -3 * spacing];
  return Cloth.grid({ columns: 7, rows: 7, spacing, origin, down: [0, 0, 1], pinMode });
}

test("a sheet lies on another one, which tears", () => {
  const [inner, outer] = [sheet(0, 0.1, "corners"), sheet(0.02, 0.04, "none")];
  const layers = new Set();
  for (let tick = 0; tick < 90; tick++) {
    if (tick === 60) assert.ok(inner.tearEdge(0, 7));
    inner.step();
    layers.add(outer.collideWith(inner));
    outer.step();
  }
  assert.equal(layers.size, 1);
  const [height, below] = [outer, inner].map((cloth) => cloth.mass.center[1]);
  assert.ok(height > below && height > -0.5, `${height} m, ${below} m`);
  const [layer] = layers;
  assert.ok(layer.impulse.linear[1] < 0);
  layer.remove();
  assert.throws(() => layer.impulse, /`collider` must be a live collider/);
  assert.notEqual(outer.collideWith(inner), layer);
});

test("a wrong layer is refused and changes nothing", () => {
  const [inner, outer] = [sheet(0, 0.1, "corners"), sheet(0.02, 0.04, "none")];
  const hash = outer.stateHash();
  for (const wrong of [undefined, null, {}, outer, "shirt"]) {
    assert.throws(() => outer.collideWith(wrong), /`other` must be another cloth/);
  }
  inner.free();
  assert.throws(() => outer.collideWith(inner), /`other` must be live, but was freed/);
  assert.equal(outer.stateHash(), hash);
  outer.free();
  assert.throws(() => outer.collideWith(sheet(0, 0.1, "none")), /`cloth` must be live, but was freed/);
});
