// Views of the module's memory, and the other getters and methods of Cloth.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";

await init();

const LISTS = ["positions", "relativePositions", "normals", "uvs", "indices", "sourceVertices", "vertexParticles", "frayed"];

/** Creates cloths until the memory grows, which detaches `view`. */
function growMemory(view) {
  const cloths = [];
  while (view.length > 0) {
    assert.ok(cloths.length < 2000, "the memory does not grow");
    cloths.push(Cloth.grid({ columns: 100, rows: 100 }));
  }
  cloths.forEach((cloth) => cloth.free());
}

test("a new grid has views of the right sizes and values", () => {
  const cloth = Cloth.grid({ columns: 3, rows: 2, spacing: 0.5, origin: [1, 2, 3] });
  assert.deepEqual([...cloth.positions], [1, 2, 3, 1.5, 2, 3, 2, 2, 3, 1, 1.5, 3, 1.5, 1.5, 3, 2, 1.5, 3]);
  const [x, y, z] = cloth.normals;
  assert.deepEqual([Math.abs(x), Math.abs(y), Math.abs(z)], [0, 0, 1]);
  assert.equal(cloth.normals.length, 18);
  assert.equal(cloth.uvs.length, 12);
  assert.equal(cloth.indices.length, 12);
  assert.ok(cloth.indices.every((vertex) => vertex < 6));
  assert.deepEqual([...cloth.sourceVertices], [0, 1, 2, 3, 4, 5]);
  assert.equal(cloth.vertexCapacity, 12);
  assert.equal(cloth.indexCapacity, 30, "with capacity for cuts");
  assert.deepEqual([...cloth.pinned], [0, 1, 2]);
});

test("a getter returns a valid view after the memory has grown", () => {
  const cloth = Cloth.grid();
  cloth.step(10);
  const copies = Object.fromEntries(LISTS.map((name) => [name, Array.from(cloth[name])]));
  const held = cloth.positions;
  growMemory(held);
  assert.equal(held.length, 0, "the old view is detached");
  for (const name of LISTS) assert.deepEqual(Array.from(cloth[name]), copies[name], name);
  assert.notEqual(cloth.positions.buffer, held.buffer);
});

test("a getter never returns a detached view, whatever was called before", () => {
  const cloth = Cloth.grid();
  const calls = {
    step: () => cloth.step(1),
    save: () => cloth.save(),
    events: () => cloth.events(),
    stats: () => cloth.stats,
    reset: () => cloth.reset(),
    restore: () => Cloth.restore(cloth.save()),
    grow: () => growMemory(cloth.positions),
  };
  for (const [call, run] of Object.entries(calls)) {
    for (const name of LISTS) {
      run();
      const view = cloth[name];
      assert.ok(view.length > 0 && view.buffer.byteLength > 0, `${name} after ${call}`);
    }
  }
});

test("a getter returns the same view while memory and length stay the same", () => {
  const cloth = Cloth.grid();
  for (const name of LISTS) {
    const view = cloth[name];
    cloth.step(1);
    assert.equal(cloth[name], view, name);
  }
});

test("a view that is kept shows the current positions", () => {
  const cloth = Cloth.grid({ pinMode: "none" });
  const { positions } = cloth;
  const before = positions[1];
  cloth.step(10);
  assert.ok(positions[1] < before, "the kept view shows the fall");
});

test("positions are relative to an origin that follows cloth far from zero", () => {
  const cloth = Cloth.grid();
  assert.deepEqual(cloth.origin, [0, 0, 0]);
  assert.deepEqual(cloth.relativePositions, cloth.positions);
  cloth.teleport([5000, 0, -300]);
  cloth.step(1);
  const { origin, positions, relativePositions } = cloth;
  assert.deepEqual(origin, [5000, 0, -300]);
  assert.ok(positions.every((x, i) => x === Math.fround(origin[i % 3] + relativePositions[i])));
  const buffer = new Float32Array(positions.length);
  cloth.writeVertices([{ attribute: "position", buffer }], { relative: true });
  assert.deepEqual(buffer, relativePositions.slice());
});

test("topologyRevision and stateRevision change with triangles and positions", () => {
  const cloth = Cloth.grid();
  const revisions = () => [cloth.topologyRevision, cloth.stateRevision];
  const [topology, state] = revisions();
  cloth.advance(0);
  cloth.settings = { damping: 1 };
  assert.deepEqual(revisions(), [topology, state]);
  cloth.step(1);
  assert.equal(cloth.topologyRevision, topology);
  assert.notEqual(cloth.stateRevision, state);
  cloth.tearEdge(820, 860);
  assert.notEqual(cloth.topologyRevision, topology);
});

test("a tear adds a vertex and moves triangles to it", () => {
  const cloth = Cloth.grid();
  const before = Array.from(cloth.indices);
  assert.equal(cloth.tearEdge(820, 860), true);
  assert.equal(cloth.positions.length, 3 * 1601);
  assert.equal(cloth.normals.length, 3 * 1601);
  assert.equal(cloth.uvs.length, 2 * 1601);
  const { indices, sourceVertices } = cloth;
  assert.equal(indices.length, before.length);
  const changed = before.filter((vertex, at) => indices[at] !== vertex);
  assert.ok(changed.length > 0);
  const source = sourceVertices[1600];
  assert.ok(changed.every((vertex) => vertex === source), "only triangles of the split vertex change");
  assert.deepEqual([...cloth.uvs.subarray(3200)], [...cloth.uvs.subarray(2 * source, 2 * source + 2)]);
  const events = cloth.events();
  const [torn, split] = ["edge-torn", "vertex-split"].map((kind) => events.find((e) => e.kind === kind));
  assert.deepEqual([torn.particleA, torn.particleB].sort(), [820, 860]);
  assert.deepEqual(Object.keys(torn), ["kind", "tick", "position", "particleA", "particleB"]);
  assert.deepEqual([split.vertex, split.source], [1600, source]);
  assert.deepEqual(Object.keys(split), ["kind", "tick", "position", "vertex", "source"]);
});

test("changes() returns the ranges of a tear, and frayed marks its border", () => {
  const cloth = Cloth.grid();
  const since = cloth.topologyRevision;
  const nothing = { firstVertex: 0, vertexCount: 0, firstIndex: 0, indexCount: 0 };
  assert.deepEqual(cloth.changes(since), nothing);
  assert.deepEqual(cloth.changes(0), { firstVertex: 0, vertexCount: 1600, firstIndex: 0, indexCount: 9126 });
  const before = Array.from(cloth.indices);
  assert.ok(cloth.frayed.every((frayed) => frayed === 0));
  assert.equal(cloth.tearEdge(820, 860), true);
  const { firstVertex, vertexCount, firstIndex, indexCount } = cloth.changes(since);
  const changed = before.flatMap((vertex, at) => (cloth.indices[at] === vertex ? [] : [at]));
  assert.deepEqual([changed[0], changed.at(-1)], [firstIndex, firstIndex + indexCount - 1]);
  assert.equal(firstVertex, cloth.frayed.indexOf(1));
  assert.equal(firstVertex + vertexCount, 1601);
  assert.deepEqual([cloth.frayed[1600], cloth.frayed[cloth.sourceVertices[1600]]], [1, 1]);
  assert.deepEqual(cloth.changes(cloth.topologyRevision), nothing);
});

test("a cut divides triangles and sets the sources of its vertices", () => {
  const cloth = Cloth.grid();
  const [triangles, vertices] = [cloth.indices.length / 3, cloth.positions.length / 3];
  const opened = cloth.cut([-1, -0.51, -1], [3, -0.83, -1], [0, 0, 2]);
  assert.ok(opened > 40);
  assert.ok(cloth.indices.length / 3 > triangles && cloth.indices.length <= cloth.indexCapacity);
  assert.equal(cloth.stats.pieces, 2);
  assert.ok(cloth.sourceVertices.every((source) => source < vertices));
  const events = cloth.events();
  const count = (kind) => events.filter((event) => event.kind === kind).length;
  assert.equal(count("edge-torn"), opened);
  assert.equal(count("edge-divided") + count("vertex-split"), cloth.positions.length / 3 - vertices);
  const divided = events.find(({ kind }) => kind === "edge-divided");
  assert.deepEqual(Object.keys(divided), ["kind", "tick", "position", "particleA", "particleB", "vertex"]);
  assert.equal(cloth.cut([-1, -0.51, -1], [3, -0.83, -1], [0, 0, 2]), 0, "a second cut in the same place opens nothing");
});

test("a crease folds the sheet", () => {
  const cloth = Cloth.grid({
    columns: 12,
    rows: 12,
    spacing: 0.02,
    pinMode: "none",
    material: { bendStiffness: 1e-3 },
    settings: { gravity: [0, 0, 0] },
  });
  const depth = () => {
    const z = cloth.positions.filter((_, i) => i % 3 === 2);
    return Math.max(...z) - Math.min(...z);
  };
  cloth.step(30);
  assert.ok(depth() < 1e-6);
  cloth.crease([0.11, 1, 0], [0.11, -1, 0], 1);
  cloth.step(60);
  assert.ok(depth() > 0.02, `folded by ${depth()} m`);
  cloth.free();
});

test("a mesh can be made from the views of another cloth, although memory moves meanwhile", () => {
  const grid = Cloth.grid({ columns: 150, rows: 150 });
  for (let i = 0; i < 20; i++) {
    const { positions, indices, uvs, pinned } = grid;
    const mesh = Cloth.mesh({ positions, indices, uvs, pinned });
    assert.deepEqual(mesh.positions, grid.positions);
    assert.deepEqual(mesh.indices, grid.indices);
  }
});

test("selfCollision and selfDistance read back as they were set", () => {
  const cloth = Cloth.grid({ settings: { selfCollision: "particles", selfDistance: 0.03125 } });
  const read = ({ settings }) => [settings.selfCollision, settings.selfDistance];
  assert.deepEqual(read(cloth), ["particles", 0.03125]);
  assert.deepEqual(read(Cloth.restore(cloth.save())), ["particles", 0.03125]);
  cloth.settings = { selfCollision: true, selfDistance: 0.0078125 };
  assert.deepEqual(read(cloth), [true, 0.0078125]);
  cloth.step(1);
  assert.deepEqual(read(Cloth.restore(cloth.save())), [true, 0.0078125]);
  cloth.settings = { selfCollision: false };
  assert.deepEqual(read(cloth), [false, 0.0078125]);
});

test("settings, material and wind read as frozen copies", () => {
  const cloth = Cloth.grid({ material: "denim" });
  const { settings, material, wind, stats } = cloth;
  for (const read of [settings, settings.gravity, material, wind, wind.velocity]) {
    assert.ok(Object.isFrozen(read));
  }
  assert.equal(settings.substeps, 4);
  assert.deepEqual(settings.gravity, [0, Math.fround(-9.81), 0]);
  assert.equal(settings.tethers, true);
  assert.equal(material.density, Math.fround(0.38));
  assert.equal(material.bendStiffness, Math.fround(1e-4));
  assert.deepEqual(wind, {
    model: "surface",
    velocity: [0, 0, 0],
    gust: 0,
    wander: 0,
    turbulence: 0,
    airDensity: Math.fround(1.2),
    seed: 0,
  });
  assert.deepEqual([stats.particles, stats.triangles, stats.pieces, stats.ticks], [1600, 3042, 1, 0]);
  assert.equal(stats.constraints, stats.activeConstraints);
  assert.equal(stats.asleep, false);
  assert.equal(stats.substeps, 4);
  assert.ok(stats.bytes > 100_000);
});

test("assigning an object changes only its fields, and a preset replaces the material first", () => {
  const cloth = Cloth.grid();
  cloth.settings = { iterations: 6, gravity: new Float32Array([0, 0, -1]) };
  cloth.settings = { tearing: true, iterations: undefined };
  const { iterations, tearing, gravity, substeps } = cloth.settings;
  assert.deepEqual([iterations, tearing, gravity, substeps], [6, true, [0, 0, -1], 4]);
  cloth.material = { preset: "silk", drag: 2 };
  cloth.material = { lift: 0.5 };
  const { density, drag, lift } = cloth.material;
  assert.deepEqual([density, drag, lift], [Math.fround(0.1), 2, 0.5]);
  cloth.wind = { model: "sine-field", seed: 4294967295 };
  cloth.wind = { gust: 0.25 };
  assert.deepEqual([cloth.wind.model, cloth.wind.seed, cloth.wind.gust], ["sine-field", 4294967295, 0.25]);
});

test("stages are timed only while `timing` is on", () => {
  const cloth = Cloth.grid();
  const total = () => Object.values(cloth.stats.seconds).reduce((sum, each) => sum + each, 0);
  cloth.step(20);
  assert.equal(total(), 0);
  cloth.timing = true;
  const start = performance.now();
  cloth.step(20);
  const wall = (performance.now() - start) / 1000;
  assert.equal(cloth.timing, true);
  assert.ok(total() > 0 && total() <= wall * 1.01, `${total()} s of ${wall} s`);
  assert.ok(cloth.stats.seconds.stretch > 0);
});

test("a cloth at rest falls asleep, and wakes when a velocity is set", () => {
  const cloth = Cloth.grid({ columns: 10, rows: 10, settings: { sleepSpeed: 0.01 } });
  cloth.step(600);
  assert.equal(cloth.stats.asleep, true);
  const { stateRevision } = cloth;
  cloth.step(10);
  assert.equal(cloth.stateRevision, stateRevision);
  cloth.setVelocity(55, [0, 0, 1]);
  cloth.step(1);
  assert.equal(cloth.stats.asleep, false);
});

test("raycast() returns the first hit, and a grab moves its particle to the target", () => {
  const cloth = Cloth.grid({ pinMode: "corners", settings: { gravity: [0, 0, 0] } });
  const hit = cloth.raycast([1.01, -0.99, 5], [0, 0, -2]);
  assert.deepEqual([hit.distance, hit.position[2], hit.normal[2]], [5, 0, 1]);
  assert.equal(hit.particle, 20 * 40 + 20);
  assert.equal(cloth.raycast([1, -1, 5], [0, 0, -1], 4), undefined);
  assert.equal(cloth.raycast([1, -1, 5], [0, 0, 1]), undefined);
  assert.equal(cloth.grabRay([-0.05, -1, 5], [0, 0, -1]), undefined);
  const grab = cloth.grabRay([-0.05, -1, 5], [0, 0, -1], { radius: 0.06 });
  assert.deepEqual(grab.position, [...cloth.positions.subarray(3 * 800, 3 * 800 + 3)]);
  grab.moveTo([0, -1, 0.1]);
  cloth.step(20);
  const [x, y, z] = cloth.positions.subarray(3 * 800);
  assert.deepEqual([x, y, z], [0, -1, Math.fround(0.1)]);
  grab.release();
});

test("attachments carry particles, and maximum distances keep them near their anchors", () => {
  const cloth = Cloth.grid({ columns: 4, rows: 4, spacing: 0.1, pinMode: "none" });
  const body = cloth.attach([0, 1, 2, 3], [0, 0, 0]);
  assert.deepEqual([...body.particles], [0, 1, 2, 3]);
  cloth.setPinStiffness([1, 2], 20);
  const anchored = [12, 13, 14, 15];
  cloth.setMaxDistances(anchored, [0.05, 0.05, 0.05, Infinity]);
  cloth.setBackstops(anchored, [0, 0, 0, 0], [1, 1, 1, 1]);
  const mass = cloth.mass(15);
  cloth.setMassScales([15], [4]);
  assert.ok(Math.abs(cloth.mass(15) / mass - 4) < 1e-6);
  const anchors = anchored.flatMap((i) => cloth.position(i));
  for (let tick = 1; tick <= 60; tick++) {
    body.moveTo([0.002 * tick, 0, 0]);
    cloth.setAnchors(anchored, anchors.map((x, at) => x + (at % 3 === 0 ? 0.002 * tick : 0)), anchored.flatMap(() => [0, 0, 1]));
    cloth.step();
  }
  assert.ok(Math.abs(cloth.position(0)[0] - 0.12) < 1e-6);
  const off = cloth.position(13).map((x, axis) => x - anchors[3 + axis] - (axis === 0 ? 0.12 : 0));
  assert.ok(Math.hypot(...off) < 0.0501);
  const [x, y, z] = cloth.position(5);
  cloth.setFrame([0, 0, 0]);
  cloth.teleport([5, 0, 0], [0, 1, 0, 0]);
  const there = cloth.position(5);
  [5 - x, y, -z].forEach((each, axis) => assert.ok(Math.abs(there[axis] - each) < 1e-5));
  cloth.moveFrame([0, 0, 0]);
  const back = cloth.position(5);
  [x, y, z].forEach((each, axis) => assert.ok(Math.abs(back[axis] - each) < 1e-5));
  cloth.clearLeashes();
  body.detach();
  assert.equal(cloth.pinned.length, 0);
  assert.throws(() => body.moveTo([0, 0, 0]), /`attachment`/);
});

test("pins, positions and velocities are set as passed", () => {
  const cloth = Cloth.grid({ columns: 4, rows: 4, pinMode: "none" });
  cloth.setPinTargets([0, 3], [0, 1, 0, 0.5, 1, 0]);
  cloth.pin(5);
  const { positions } = cloth;
  const held = [...positions.subarray(15, 18)];
  cloth.step(3);
  assert.deepEqual([...cloth.pinned], [0, 3, 5]);
  assert.deepEqual([...positions.subarray(0, 3)], [0, 1, 0]);
  assert.deepEqual([...positions.subarray(9, 12)], [0.5, 1, 0]);
  assert.deepEqual([...positions.subarray(15, 18)], held);
  cloth.unpin(5);
  assert.deepEqual([...cloth.pinned], [0, 3]);
  cloth.unpinAll();
  assert.equal(cloth.pinned.length, 0);
  cloth.setPosition(7, [1, 2, 3]);
  assert.deepEqual([...cloth.positions.subarray(21, 24)], [1, 2, 3]);
  cloth.setVelocity(7, [0, 0, 2]);
  assert.deepEqual(cloth.velocity(7).map(Math.round), [0, 0, 2]);
  assert.ok(cloth.mass(7) > 0);
});

test("advance() runs whole ticks and keeps the remainder as the blend", () => {
  const cloth = Cloth.grid({ settings: { tick: 0.0625 } });
  assert.equal(cloth.advance(0.15625), 2);
  assert.equal(cloth.blend, 0.5);
  assert.equal(cloth.time, 0.125);
  assert.equal(cloth.advance(10), 5);
  assert.equal(cloth.stats.ticks, 7);
});

test("a plane stops the cloth, lifts it when it moves, and lets it fall when removed", () => {
  const cloth = Cloth.grid({ columns: 6, rows: 6, right: [1, 0, 0], down: [0, 0, 1], pinMode: "none" });
  const lowest = () => Math.min(...cloth.positions.filter((_, at) => at % 3 === 1));
  const floor = cloth.addCollider({ shape: "plane", position: [0, -0.5, 0], friction: 0.5 });
  cloth.step(120);
  assert.ok(Math.abs(lowest() + 0.5) < 0.01, `the cloth lies at ${lowest()} m`);
  for (let i = 1; i <= 60; i++) {
    floor.moveTo([0, -0.5 + i / 120, 0]);
    cloth.step(1);
  }
  assert.ok(lowest() > -0.02, `the cloth was lifted to ${lowest()} m`);
  floor.remove();
  cloth.step(60);
  assert.ok(lowest() < -1, `the cloth fell to ${lowest()} m`);
  assert.throws(() => floor.remove(), /`collider` must be a live collider of this cloth/);
  assert.throws(() => floor.moveTo([0, 0, 0]), /`collider` must be a live collider of this cloth/);
});
