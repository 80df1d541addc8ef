// Pointers: grabbing and dragging a cloth by rays.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";
import { Pointers } from "muslin/pointers";

await init();

const AHEAD = [0, 0, -1];

/** Returns a sheet of 2 m around the origin, and pointers for it. */
function sheet(options) {
  const cloth = Cloth.grid({ columns: 41, rows: 41, spacing: 0.05, origin: [-1, 1, 0] });
  return { cloth, pointers: new Pointers(cloth, options) };
}

test("a press grabs the particle under the ray, and a drag moves it to where the ray hits the plane", () => {
  const { cloth, pointers } = sheet();
  assert.equal(pointers.cloth, cloth);
  assert.equal(pointers.press("mouse", [0, 0, 5], AHEAD), true);
  assert.ok(pointers.holds("mouse") && pointers.size === 1);
  // From the side: the plane still faces the ray of the press.
  const [x, z] = [0.3, 0];
  assert.equal(pointers.drag("mouse", [x + 5, 0.2, z + 5], [-1, 0, -1]), true);
  cloth.step(10); // `maxDisplacement` limits how fast it follows
  const held = cloth.position(20 * 41 + 20);
  for (const [axis, wanted] of [0.3, 0.2, 0].entries()) assert.ok(Math.abs(held[axis] - wanted) < 1e-5, `${held}`);
  assert.equal(pointers.lift("mouse"), true);
  assert.equal(pointers.lift("mouse"), false);
  assert.equal(pointers.drag("mouse", [0, 0, 5], AHEAD), false);
});

test("`facing` is the normal of the plane", () => {
  const { cloth, pointers } = sheet();
  pointers.press(1, [0, 0, 5], AHEAD, [0, 1, -1]);
  pointers.drag(1, [0, 0.25, 5], AHEAD);
  cloth.step(10); // `maxDisplacement` limits how fast it follows
  const held = cloth.position(20 * 41 + 20);
  for (const [axis, wanted] of [0, 0.25, 0.25].entries()) assert.ok(Math.abs(held[axis] - wanted) < 1e-5, `${held}`);
});

test("a ray that misses grabs nothing, unless it passes within the radius", () => {
  for (const [radius, isGrabbed] of [[0, false], [0.2, true]]) {
    const { pointers } = sheet({ radius });
    assert.equal(pointers.press(1, [1.1, 0, 5], AHEAD), isGrabbed);
    assert.equal(pointers.size, isGrabbed ? 1 : 0);
  }
});

test("a ray parallel to the plane, or away from it, moves nothing", () => {
  const { cloth, pointers } = sheet();
  pointers.press(1, [0, 0, 5], AHEAD);
  for (const [origin, direction] of [[[0, 0, 5], [1, 0, -0.001]], [[0, 0, 5], [0, 0, 1]]]) {
    assert.equal(pointers.drag(1, origin, direction), false);
  }
  cloth.step(1);
  assert.ok(Math.abs(cloth.position(20 * 41 + 20)[0]) < 1e-6);
  assert.ok(pointers.holds(1));
});

test("several pointers hold at once, and a second press of one releases its first grab", () => {
  const { cloth, pointers } = sheet();
  for (const finger of [0, 1, 2]) pointers.press(finger, [0.3 * finger - 0.3, 0, 5], AHEAD);
  assert.equal(pointers.size, 3);
  pointers.press(2, [5, 5, 5], AHEAD);
  assert.deepEqual([pointers.size, pointers.holds(2)], [2, false]);
  pointers.liftAll();
  assert.equal(pointers.size, 0);
  cloth.step(1);
});

test("after a reset or free all pointers let go without an error", () => {
  for (const end of [(cloth) => cloth.reset(), (cloth) => cloth.free()]) {
    const { cloth, pointers } = sheet();
    for (const finger of [1, 2]) pointers.press(finger, [0.1 * finger, 0, 5], AHEAD);
    end(cloth);
    assert.equal(pointers.drag(1, [0, 0, 5], AHEAD), false);
    assert.equal(pointers.lift(2), true);
    assert.equal(pointers.size, 0);
  }
});

test("an error names the wrong argument", () => {
  const { cloth, pointers } = sheet();
  assert.throws(() => new Pointers({}), /`cloth` must be a cloth/);
  assert.throws(() => new Pointers(cloth, { radios: 1 }), /`options.radios` is not known; did you mean `radius`/);
  assert.throws(() => new Pointers(cloth, { radius: "1" }), /`radius` must be a number/);
  assert.throws(() => pointers.press(1, [0, 0], AHEAD), /`origin` must be 3 numbers/);
  assert.throws(() => pointers.press(1, [0, 0, 5], AHEAD, [NaN, 0, 0]), /`facing` must be a number/);
  pointers.press(1, [0, 0, 5], AHEAD);
  assert.throws(() => pointers.drag(1, [0, 0, 5], [0, NaN, 0]), /`direction` must be a number/);
  assert.equal(pointers.holds(1), true);
});
