// Whole poses at once, and cheap questions.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";

await init();

/** A flag of 8 × 6 particles in the wind. */
function flag() {
  const cloth = Cloth.grid({ columns: 8, rows: 6, spacing: 0.05 });
  cloth.wind = { velocity: [0.5, 0, 3] };
  cloth.step(30);
  return cloth;
}

test("a pose has the bits of the same calls for single particles", () => {
  const [bulk, single] = [flag(), flag()];
  const pose = bulk.restPositions.map((x, i) => x + 0.01 * (i % 7));
  const speeds = pose.map((x) => 2 * x);
  bulk.setPositions(pose);
  bulk.setVelocities(Array.from(speeds.subarray(3 * 16)), 16);
  for (let i = 0; i < 48; i++) single.setPosition(i, pose.subarray(3 * i, 3 * i + 3));
  for (let i = 16; i < 48; i++) single.setVelocity(i, speeds.subarray(3 * i, 3 * i + 3));
  assert.equal(bulk.stateHash(), single.stateHash());
  assert.deepEqual(bulk.positions, pose);
  assert.deepEqual(bulk.velocities.subarray(48), speeds.subarray(48));
  assert.deepEqual([...bulk.velocities.subarray(141)], bulk.velocity(47));
  bulk.step(5);
  assert.notDeepEqual(bulk.positions, pose);
  bulk.setPositions([], 48);
});

test("positions and velocities of a cloth can be given back to it", () => {
  const cloth = flag();
  const [pose, speeds] = [cloth.positions.slice(), cloth.velocities];
  cloth.step(20);
  cloth.setPositions(cloth.positions);
  cloth.setPositions(pose);
  cloth.setVelocities(speeds);
  assert.deepEqual(cloth.positions, pose);
  assert.deepEqual(cloth.velocities, speeds);
});

test("rest positions are those at creation", () => {
  const cloth = Cloth.grid({ columns: 3, rows: 2, spacing: 0.5, origin: [1, 2, 3], pinMode: "none" });
  const start = cloth.positions.slice();
  cloth.step(10);
  assert.notDeepEqual(cloth.positions, start);
  assert.deepEqual(cloth.restPositions, start);
});

test("pins and their targets are readable in one order", () => {
  const cloth = flag();
  cloth.pin(40, [1, 2, 3]);
  assert.deepEqual([...cloth.pins], [0, 1, 2, 3, 4, 5, 6, 7, 40]);
  assert.deepEqual(cloth.pinned, cloth.pins);
  assert.deepEqual(cloth.pinTargets.subarray(0, 3), cloth.restPositions.subarray(0, 3));
  assert.deepEqual([...cloth.pinTargets.subarray(24)], [1, 2, 3]);
  cloth.unpinAll();
  assert.equal(cloth.pinTargets.length, 0);
});

test("time, ticks, blend, sleep and wind are readable", () => {
  const cloth = flag();
  cloth.advance(0.04);
  assert.equal(cloth.ticks, 32);
  assert.ok(Math.abs(cloth.time - 32 / 60) < 1e-6);
  assert.ok(Math.abs(cloth.blend - 0.4) < 1e-3);
  assert.equal(cloth.asleep, false);
  assert.deepEqual(cloth.wind.velocity, [0.5, 0, 3]);
  cloth.wind = { velocity: [0, 0, 0] };
  cloth.settings = { sleepSpeed: 0.05, damping: 5 };
  for (let i = 0; i < 60 && !cloth.asleep; i++) cloth.step(60);
  assert.equal(cloth.asleep, true);
  assert.equal(cloth.asleep, cloth.stats.asleep);
  cloth.setVelocities([0, 0, 1], 47);
  assert.equal(cloth.asleep, false);
});

test("the mass of the cloth is the sum over its particles", () => {
  const cloth = flag();
  const sums = { total: 0, center: [0, 0, 0], momentum: [0, 0, 0] };
  for (let i = 0; i < 48; i++) {
    const mass = cloth.mass(i);
    sums.total += mass;
    for (const axis of [0, 1, 2]) {
      sums.center[axis] += mass * cloth.position(i)[axis];
      sums.momentum[axis] += mass * cloth.velocity(i)[axis];
    }
  }
  const { total, center, momentum } = cloth.mass;
  assert.ok(Math.abs(total / sums.total - 1) < 1e-6);
  for (const axis of [0, 1, 2]) {
    assert.ok(Math.abs(center[axis] - sums.center[axis] / sums.total) < 1e-6);
    assert.ok(Math.abs(momentum[axis] - sums.momentum[axis]) < 1e-6);
  }
  assert.ok(Math.hypot(...momentum) > 1e-3);
  cloth.free();
  assert.throws(() => cloth.mass, /freed/);
});

test("a mesh collider reaches new vertices and carries the cloth along", () => {
  const cloth = flag();
  const [x, y] = [0, 1].map((axis) => cloth.positions[cloth.positions.length - 3 + axis]);
  const positions = [x - 1, y - 0.3, -1, x + 1, y - 0.3, -1, x + 1, y - 0.3, 1, x - 1, y - 0.3, 1];
  const body = cloth.addCollider({ shape: "mesh", positions, indices: [0, 2, 1, 0, 3, 2] });
  body.update(positions.map((value, i) => (i % 3 === 1 ? y + 0.05 : value)));
  for (let tick = 0; tick < 3; tick++) cloth.advance(1 / 60);
  assert.ok(cloth.positions[cloth.positions.length - 2] > y + 0.05);
  const hash = cloth.stateHash();
  assert.throws(() => body.update(positions.slice(3)), /`count` must be the number of vertices of the collider/);
  assert.throws(() => body.update([...positions.slice(0, 11), 2e6]), /`positions\[3\]` must be between -1e6 and 1e6/);
  assert.throws(() => body.update(positions.slice(1)), /positions/);
  assert.equal(cloth.stateHash(), hash);
  body.remove();
  assert.throws(() => body.update(positions), /`collider` must be a live collider/);
});

test("a collider is where its last tick took it", () => {
  const cloth = flag();
  const ball = cloth.addCollider({ shape: "sphere", position: [0, 0, 2], radius: 0.1 });
  ball.moveTo([0, 0.5, 2], [0, 1, 0, 0]);
  assert.deepEqual(ball.pose, { position: [0, 0, 2], rotation: [0, 0, 0, 1] });
  cloth.step(1);
  assert.deepEqual(ball.pose, { position: [0, 0.5, 2], rotation: [0, 1, 0, 0] });
  ball.remove();
  assert.throws(() => ball.pose, /`collider` must be a live collider/);
});

test("a painted map scales what the material says until it is taken away", () => {
  const cloth = flag();
  const scales = Array.from({ length: 48 }, (_, i) => (i % 8 < 4 ? 0.25 : 1));
  for (const map of ["stretch", "bend", "tear", "friction", "thickness", "drag"]) {
    const before = cloth.stateHash();
    cloth.setMap(map, new Float32Array(scales));
    assert.notEqual(cloth.stateHash(), before, map);
    assert.deepEqual(cloth.map(map), new Float32Array(scales));
    cloth.setMap(map, null);
    assert.equal(cloth.map(map), null);
    assert.equal(cloth.stateHash(), before, map);
  }
  assert.throws(() => cloth.map("weight"), /`map` must be one of "stretch"/);
  assert.throws(() => cloth.setMap("tear", scales.with(17, -1)), /`scales\[17\]` must be from 0 to 1000/);
  assert.throws(() => cloth.setMap("tear", [1, 1]), /`scales` must have 48 entries, one per particle, but has 2/);
  cloth.reset();
  cloth.unpinAll();
  cloth.setMap("drag", scales);
  cloth.step(1);
  const pushed = [0, 0];
  cloth.velocities.forEach((v, i) => (pushed[Math.floor(i / 3) % 8 < 4 ? 0 : 1] += i % 3 === 2 ? v : 0));
  assert.ok(pushed[1] > 0.01 && pushed[0] < 0.5 * pushed[1], `${pushed}`);
  assert.equal(Cloth.restore(cloth.save()).stateHash(), cloth.stateHash());
});
