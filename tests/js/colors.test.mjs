// Vertex colours as maps, pins and distances, by the function of the example pages.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";
import { colorChannel } from "../../bindings/js/examples/colors.js";

await init();

/** A square of 2 × 2 vertices whose left and right half meet in doubled vertices. */
const WELDED = {
  positions: [0, 0, 0, 1, 0, 0, 1, -1, 0, 0, -1, 0, 1, 0, 0, 2, 0, 0, 2, -1, 0, 1, -1, 0],
  indices: [0, 3, 1, 1, 3, 2, 4, 7, 5, 5, 7, 6],
  weldDistance: 0,
};

test("a channel of floats or normalised integers has one number per particle", () => {
  const cloth = Cloth.mesh(WELDED);
  assert.equal(cloth.meshReport.particles, 6);
  const shares = [0, 0.2, 0.4, 0.6, 0.2, 0.8, 1, 0.4];
  for (const [Kind, one] of [[Float32Array, 1], [Uint8Array, 255], [Uint16Array, 65535]]) {
    for (const components of [3, 4]) {
      const colors = new Kind(8 * components);
      shares.forEach((share, vertex) => (colors[components * vertex + 1] = share * one));
      const values = colorChannel(cloth, colors, 1, components);
      assert.equal(values.length, 6);
      cloth.vertexParticles.forEach((particle, vertex) => {
        assert.ok(Math.abs(values[particle] - shares[vertex]) < 1e-6, `${Kind.name}, vertex ${vertex}`);
      });
      assert.deepEqual([...colorChannel(cloth, colors, 0, components)], [0, 0, 0, 0, 0, 0]);
      const before = cloth.stateHash();
      cloth.setMap("tear", values);
      assert.notEqual(cloth.stateHash(), before);
      cloth.setMap("tear", null);
    }
  }
});
