// Wrong arguments: every error names the argument, and the cloth does not change.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";

await init();

const NOT_NUMBERS = [NaN, "1", null, {}, [1], true, 1n];
const NOT_WHOLE = [...NOT_NUMBERS, -1, 0.5, 2 ** 32, Infinity];
const NOT_VECTORS = [1, "xyz", null, {}, [0, 0], [0, 0, 0, 0], [0, NaN, 0], [0, "0", 0], [, 0, 0]];
const NOT_FINITE = [...NOT_VECTORS, [0, Infinity, 0], [0, 1e300, 0], new Float32Array([0, 0, NaN])];
const NOT_OBJECTS = [null, 1, true, [], new Float32Array(3)];
const NOT_LISTS = [null, 1, "0, 1, 2", {}, new BigInt64Array(3), new DataView(new ArrayBuffer(12))];

/** Returns a cloth in motion: torn, with a grab, pins and a collider. */
function movingCloth() {
  const cloth = Cloth.grid({ columns: 8, rows: 8, settings: { tearing: true }, extraParticles: 32 });
  const [grab, collider] = [cloth.grabParticle(60), cloth.addCollider({ position: [0, -2, 0] })];
  cloth.wind = { velocity: [0, 0, 1] };
  cloth.step(5);
  cloth.tearEdge(27, 28);
  return { cloth, grab, collider };
}

/** Returns everything that a refused call could have changed, as text. */
function stateOf(cloth) {
  const { settings, material, wind, topologyRevision, stateRevision, timing } = cloth;
  const values = [settings, material, wind, topologyRevision, stateRevision, timing];
  return JSON.stringify([values, `${cloth.stateHash()}`, Array.from(cloth.save())]);
}

/**
 * Tests that `call` throws an Error that names the argument for each value, and does not change the
 * cloth.
 */
function refuses(name, values, call) {
  test(`wrong values of ${name} throw and change nothing`, () => {
    const moving = movingCloth();
    const before = stateOf(moving.cloth);
    for (const value of values) {
      const namesArgument = (error) => error.constructor === Error && error.message.includes(`\`${name}\``);
      assert.throws(() => call(value, moving), namesArgument, `${name}: ${String(value)}`);
      assert.equal(stateOf(moving.cloth), before, `${name}: ${String(value)} changed the cloth`);
    }
    moving.cloth.step(1);
    moving.cloth.free();
  });
}

// Descriptors
const grid = (key) => (value) => Cloth.grid({ [key]: value });
refuses("desc", NOT_OBJECTS, (value) => Cloth.grid(value));
refuses("columns", [...NOT_WHOLE, 0, 1], grid("columns"));
refuses("rows", [...NOT_WHOLE, 0, 1], grid("rows"));
refuses("columns", [4097], (columns) => Cloth.grid({ columns, rows: 4096 }));
refuses("spacing", [...NOT_NUMBERS, 0, -1, Infinity, 1e300], grid("spacing"));
refuses("origin", NOT_FINITE, grid("origin"));
refuses("right", [...NOT_FINITE, [0, 0, 0], [2, 0, 0]], grid("right"));
refuses("down", [...NOT_FINITE, [0, 0, 0], [1, 0, 0]], grid("down"));
refuses("pinMode", [null, 0, "", "top", "TOP-EDGE", ["corners"]], grid("pinMode"));
refuses("extraParticles", [...NOT_WHOLE, 2 ** 31], grid("extraParticles"));
refuses("material", NOT_OBJECTS, grid("material"));
refuses("settings", [...NOT_OBJECTS, "fast"], grid("settings"));
refuses("desc.coloumns", [3], grid("coloumns"));

const sheet = { positions: [0, 0, 0, 1, 0, 0, 0, -1, 0, 1, -1, 0], indices: [0, 2, 1, 1, 2, 3] };
const mesh = (key) => (value) => Cloth.mesh({ ...sheet, [key]: value });
refuses("desc", [...NOT_OBJECTS, undefined], (value) => Cloth.mesh(value));
refuses("positions", [...NOT_LISTS, undefined, [], [0, 0], [0, 0, 0], [0, 0, 0, "1"]], mesh("positions"));
refuses("positions", [new Float32Array(12).fill(NaN), Array(12).fill(Infinity)], mesh("positions"));
refuses("indices", [...NOT_LISTS, undefined, [], [0, 2], [0, 1.5, 2], [0, -1, 2]], mesh("indices"));
refuses("indices", [[0, 1, 4], [0, 0, 1], [0, 0, 1, 1, 2, 1]], mesh("indices"));
refuses("uvs", [...NOT_LISTS.slice(1), [0], [0, 0], Array(8).fill(NaN)], mesh("uvs"));
refuses("pinned", [...NOT_LISTS.slice(1), [4], [-1], [0.5]], mesh("pinned"));
refuses("weldDistance", [...NOT_NUMBERS, Infinity], mesh("weldDistance"));
refuses("simplifyBelow", [...NOT_NUMBERS, -1, Infinity, 1.1], mesh("simplifyBelow"));
refuses("desc.uv", [[0, 0]], mesh("uv"));

// Settings, material, wind: every key, in a setter and in a descriptor
const NUMBERS = { tick: [0, -1, 2], damping: [-1, Infinity], maxDisplacement: [0, -1, Infinity] };
const counts = { substeps: [0, 1001], iterations: [0, 1001], maxTicksPerAdvance: [0], maxTearsPerTick: [0] };
const settings = {
  ...Object.fromEntries(Object.entries(NUMBERS).map(([key, bad]) => [key, [...NOT_NUMBERS, ...bad]])),
  ...Object.fromEntries(Object.entries(counts).map(([key, bad]) => [key, [...NOT_WHOLE, ...bad]])),
  maxStretch: [...NOT_NUMBERS, -1, Infinity],
  selfDistance: [...NOT_NUMBERS, -1, Infinity],
  sleepSpeed: [...NOT_NUMBERS, -1, Infinity],
  pressure: [...NOT_NUMBERS, Infinity],
  gravity: NOT_FINITE,
  tethers: [0, 1, null, "true"],
  tearing: [0, 1, null, "true"],
  selfCollision: [0, null, "true", "surface"],
  iteration: [3],
};
for (const [key, values] of Object.entries(settings)) {
  refuses(`settings.${key}`, values, (value, { cloth }) => {
    cloth.settings = { substeps: 9, [key]: value };
  });
  refuses(`settings.${key}`, values, (value) => Cloth.grid({ settings: { [key]: value } }));
}

const material = {
  density: [...NOT_NUMBERS, 0, -1, Infinity],
  tearStretch: [...NOT_NUMBERS, 0.5, 1, -1, Infinity],
  preset: [null, 0, "wool", "Denim"],
  colour: ["red"],
};
for (const key of ["restitution", "tearVariation", "yieldCreep"]) material[key] = [...NOT_NUMBERS, -0.1, 1.1];
for (const key of ["thickness", "stretchStiffnessWarp", "stretchStiffnessWeft", "shearStiffness"]) {
  material[key] = [...NOT_NUMBERS, -1, Infinity];
}
for (const key of ["bendStiffness", "friction", "drag", "lift"]) {
  material[key] = [...NOT_NUMBERS, -1, Infinity];
}
for (const key of [
  "bendDamping",
  "stretchDamping",
  "yieldAngle",
  "foldLength",
  "yieldHardening",
  "yieldWeakening",
]) {
  material[key] = [...NOT_NUMBERS, -1, Infinity];
}
for (const [key, values] of Object.entries(material)) {
  refuses(`material.${key}`, values, (value, { cloth }) => {
    cloth.material = { thickness: 0.001, [key]: value };
  });
  refuses(`material.${key}`, values, (value) => Cloth.grid({ material: { [key]: value } }));
}
refuses("material", [...NOT_OBJECTS, undefined, "wool"], (value, { cloth }) => {
  cloth.material = value;
});

const wind = {
  model: [null, 0, "breeze"],
  velocity: NOT_FINITE,
  gust: [...NOT_NUMBERS, -0.1, 1.1],
  wander: [...NOT_NUMBERS, -0.1, 3.2],
  turbulence: [...NOT_NUMBERS, -0.1, 1.1],
  airDensity: [...NOT_NUMBERS, -1, Infinity],
  seed: NOT_WHOLE,
  speed: [2],
};
for (const [key, values] of Object.entries(wind)) {
  refuses(`wind.${key}`, values, (value, { cloth }) => {
    cloth.wind = { airDensity: 1, [key]: value };
  });
}
refuses("settings", [...NOT_OBJECTS, undefined], (value, { cloth }) => (cloth.settings = value));
refuses("wind", [...NOT_OBJECTS, undefined], (value, { cloth }) => (cloth.wind = value));
refuses("timing", [0, 1, null, "on"], (value, { cloth }) => (cloth.timing = value));

// Time
refuses("seconds", [...NOT_NUMBERS, undefined, -1, Infinity, 1e300], (value, { cloth }) =>
  cloth.advance(value),
);
refuses("ticks", NOT_WHOLE, (value, { cloth }) => cloth.step(value));

// Particles and pins
const NOT_PARTICLES = [...NOT_WHOLE, undefined, 2 ** 31, 1000];
const methods = ["velocity", "mass", "pin", "unpin", "grabParticle"];
for (const name of methods) refuses("particle", NOT_PARTICLES, (value, { cloth }) => cloth[name](value));
refuses("particle", NOT_PARTICLES, (value, { cloth }) => cloth.setPosition(value, [0, 0, 0]));
refuses("particle", NOT_PARTICLES, (value, { cloth }) => cloth.setVelocity(value, [0, 0, 0]));
refuses("position", [...NOT_FINITE, undefined], (value, { cloth }) => cloth.setPosition(1, value));
refuses("velocity", [...NOT_FINITE, undefined], (value, { cloth }) => cloth.setVelocity(1, value));
for (const [name, method] of [["positions", "setPositions"], ["velocities", "setVelocities"]]) {
  const lists = [...NOT_LISTS, undefined, [0], [0, 0, "1"], new Float32Array(3 * 100), [0, 0, NaN]];
  refuses(name, lists, (value, { cloth }) => cloth[method](value));
  refuses(`${name}[2]`, [[6, Infinity], [8, NaN], [7, -Infinity]], ([at, bad], { cloth }) => {
    const list = new Float32Array(3 * cloth.positions.length);
    list[at] = bad;
    cloth[method](list.subarray(0, 12), 1);
  });
  refuses("first", [...NOT_WHOLE, 1000], (value, { cloth }) => cloth[method]([0, 0, 0], value));
}
refuses("target", NOT_FINITE, (value, { cloth }) => cloth.pin(1, value));
const targets = new Float32Array(6);
const NOT_ROTATIONS = [1, "x", null, [0, 0, 0], [0, 0, 0, 2], [0, 0, 0, NaN], [0, 0, 0, 0]];
const NOT_PARTICLE_LISTS = [...NOT_LISTS, undefined, [1, -1], [1, 0.5], [1, 1000]];
const PAIR = [0, 1];
const pairsOf = (value, { cloth }) => cloth.sew(value);
refuses("pairs", [...NOT_LISTS, undefined, [1], [1, -1, 2, 3], [[0, 1], [2, -1]]], pairsOf);
refuses("pairs[0]", [[1, 1], [1000, 0]], pairsOf);
refuses("pairs[1]", [[0, 1, 2, 1000], [[0, 1], [5, 5]]], pairsOf);
refuses("speed", [...NOT_NUMBERS, 0, -1, Infinity], (value, { cloth }) => cloth.sew(PAIR, { speed: value }));
refuses("kind", ["knot", 1, null], (value, { cloth }) => cloth.sew(PAIR, { kind: value }));
refuses("tearForce", [...NOT_NUMBERS, -1, Infinity], (value, { cloth }) => cloth.sew(PAIR, { tearForce: value }));
refuses("options", NOT_OBJECTS, (value, { cloth }) => cloth.sew(PAIR, value));
refuses("particles", NOT_PARTICLE_LISTS, (value, { cloth }) => cloth.attach(value, [0, 0, 0]));
refuses("position", [...NOT_FINITE, undefined], (value, { cloth }) => cloth.attach(PAIR, value));
refuses("rotation", NOT_ROTATIONS, (value, { cloth }) => cloth.attach(PAIR, [0, 0, 0], value));
refuses("particles", [...NOT_PARTICLE_LISTS, [9]], (value, { cloth }) => cloth.setPinStiffness(value, 5));
refuses("stiffness", [...NOT_NUMBERS, undefined, -1, Infinity], (value, { cloth }) =>
  cloth.setPinStiffness(PAIR, value),
);
refuses("particles", NOT_PARTICLE_LISTS, (value, { cloth }) => cloth.setMassScales(value, PAIR));
refuses("scales", [...NOT_LISTS, undefined, [1], [1, 0], [1, NaN]], (value, { cloth }) =>
  cloth.setMassScales(PAIR, value),
);
refuses("map", ["colour", "", 0, null, undefined], (value, { cloth }) => cloth.setMap(value, null));
refuses("scales", ["x", 3, undefined, [], [1]], (value, { cloth }) => cloth.setMap("tear", value));
refuses("distances", [...NOT_LISTS, undefined, [1], [1, -1], [1, NaN]], (value, { cloth }) =>
  cloth.setMaxDistances(PAIR, value),
);
refuses("distances", [[1], [1, -1], [1, Infinity]], (value, { cloth }) =>
  cloth.setBackstops(PAIR, value, [1, 1]),
);
refuses("radii", [undefined, [1], [1, -1], [1, Infinity]], (value, { cloth }) =>
  cloth.setBackstops(PAIR, [1, 1], value),
);
refuses("positions", [undefined, [0, 0, 0], targets.map(() => NaN)], (value, { cloth }) =>
  cloth.setAnchors(PAIR, value),
);
refuses("normals", [[0, 0, 1], targets, targets.map(() => NaN)], (value, { cloth }) =>
  cloth.setAnchors(PAIR, targets, value),
);
refuses("position", [...NOT_FINITE, undefined], (value, { cloth }) => cloth.setFrame(value));
refuses("position", [...NOT_FINITE, undefined], (value, { cloth }) => cloth.teleport(value));
refuses("rotation", NOT_ROTATIONS, (value, { cloth }) => cloth.teleport([0, 0, 0], value));
refuses("position", [...NOT_FINITE, undefined], (value, { cloth }) => cloth.moveFrame(value));
refuses("rotation", NOT_ROTATIONS, (value, { cloth }) => cloth.moveFrame([0, 0, 0], value));
refuses("inertia", [-0.1, 1.1, NaN, "1"], (value, { cloth }) =>
  cloth.moveFrame([0, 0, 0], undefined, value),
);
refuses("position", [...NOT_VECTORS, undefined], (value, { collider }) => collider.teleport(value));
refuses("collider.position", [[0, Infinity, 0]], (value, { collider }) => collider.teleport(value));
refuses("particles", [...NOT_LISTS, undefined, [1, -1], [1, 0.5], [1, 1000]], (value, { cloth }) =>
  cloth.setPinTargets(value, targets),
);
refuses("targets", [...NOT_LISTS, undefined, [0], [0, 0, 0], targets.map(() => NaN)], (value, { cloth }) =>
  cloth.setPinTargets([60, 61], value),
);

// Ray casts, grabs, tears
const ahead = [0, 0, -1];
for (const name of ["raycast", "grabRay"]) {
  refuses("origin", [...NOT_FINITE, undefined], (value, { cloth }) => cloth[name](value, ahead));
  refuses("direction", [...NOT_FINITE, undefined, [0, 0, 0]], (value, { cloth }) =>
    cloth[name]([0, 0, 0], value),
  );
}
refuses("maxDistance", [...NOT_NUMBERS, -1], (value, { cloth }) => cloth.raycast([0, 0, 1], ahead, value));
refuses("radius", [...NOT_NUMBERS, -1, Infinity], (radius, { cloth }) =>
  cloth.grabRay([0, 0, 1], ahead, { radius }),
);
refuses("options", NOT_OBJECTS, (value, { cloth }) => cloth.grabRay([0, 0, 1], ahead, value));
refuses("target", [...NOT_FINITE, undefined], (value, { grab }) => grab.moveTo(value));
refuses("sinceTopologyRevision", NOT_WHOLE, (value, { cloth }) => cloth.changes(value));
refuses("from", NOT_FINITE, (value, { cloth }) => cloth.cut(value, [1, 0, 0], [0, 0, 1]));
refuses("to", [...NOT_FINITE, [0, 0, 0]], (value, { cloth }) => cloth.cut([0, 0, 0], value, [0, 0, 1]));
refuses("sweep", [...NOT_FINITE, [0, 0, 0], [2, 0, 0]], (value, { cloth }) => cloth.cut([0, 0, 0], [1, 0, 0], value));
refuses("from", NOT_FINITE, (value, { cloth }) => cloth.crease(value, [1, 0, 0], 1));
refuses("to", [...NOT_FINITE, [0, 0, 0]], (value, { cloth }) => cloth.crease([0, 0, 0], value, 1));
refuses("angle", [...NOT_NUMBERS, Infinity, 4, -4], (value, { cloth }) => cloth.crease([0, 0, 0], [1, 0, 0], value));
refuses("particleA", NOT_PARTICLES, (value, { cloth }) => cloth.tearEdge(value, 1));
refuses("particleB", [...NOT_PARTICLES, 0, 2], (value, { cloth }) => cloth.tearEdge(0, value));

// Colliders
const collider = {
  shape: [null, 0, "ball", "Plane"],
  position: NOT_FINITE,
  rotation: [1, null, [0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 2], [0, 0, 0, NaN]],
  friction: [...NOT_NUMBERS, -0.5, Infinity],
  restitution: [...NOT_NUMBERS, -0.5, 1.1],
  tangentialRestitution: [...NOT_NUMBERS, -1, 1.1],
  height: [1],
};
const shapes = {
  radius: [{ shape: "sphere" }, [...NOT_NUMBERS, 0, -1, Infinity]],
  topRadius: [{ shape: "capsule" }, [...NOT_NUMBERS, 0, -2, Infinity]],
  halfHeight: [{ shape: "capsule" }, [...NOT_NUMBERS, -1, Infinity]],
  halfExtents: [{ shape: "box" }, [...NOT_FINITE, [1, 0, 1], [1, -1, 1]]],
  thickness: [{}, [...NOT_NUMBERS, -0.5, Infinity]],
  columns: [{ shape: "heightfield", rows: 2 }, [...NOT_WHOLE, 0, 1, 5000]],
  heights: [{ shape: "heightfield", columns: 2, rows: 2 }, [1, [0, 0, 0], [0, 0, 0, Infinity], new Float32Array(5)]],
  positions: [{ shape: "convex" }, ["", [0, 0], [0, 0, 0], new Float32Array(12), [Infinity, 0, 0]]],
  // One triangle is not closed.
  solid: [{ shape: "mesh", positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], indices: [0, 1, 2] }, [...NOT_NUMBERS, -1, 1e6, 0.1]],
  indices: [{ shape: "mesh", positions: [0, 0, 0, 1, 0, 0, 0, 1, 0] }, [[], [0, 1], [0, 1, 3], [0, 0, 0], [0, 1, -1]]],
};
for (const [key, [desc, values]] of Object.entries(shapes)) {
  refuses(`collider.${key}`, values, (value, { cloth }) => cloth.addCollider({ ...desc, [key]: value }));
}
for (const [key, values] of Object.entries(collider)) {
  refuses(`collider.${key}`, values, (value, { cloth }) => cloth.addCollider({ [key]: value }));
}
refuses("collider", NOT_OBJECTS, (value, { cloth }) => cloth.addCollider(value));
refuses("position", [...NOT_VECTORS, undefined], (value, { collider }) => collider.moveTo(value));
refuses("collider.position", [[0, Infinity, 0]], (value, { collider }) => collider.moveTo(value));
refuses("rotation", [1, [0, 0, 0], [0, 0, 0, NaN]], (value, { collider }) =>
  collider.moveTo([0, 0, 0], value),
);
refuses("collider.rotation", [[0, 0, 0, 2]], (value, { collider }) =>
  collider.moveTo([0, 0, 0], value),
);

// Saved bytes
refuses("buffer", [...NOT_OBJECTS.slice(0, 4), undefined, "MUSLINSV"], (value) =>
  Cloth.restore(value),
);
refuses("buffer", [new Uint8Array(0), new Uint8Array(64), new ArrayBuffer(64)], (value) =>
  Cloth.restore(value),
);

test("damaged and truncated saves throw", () => {
  const { cloth } = movingCloth();
  const saved = cloth.save();
  assert.equal(Cloth.restore(saved.buffer).stateHash(), cloth.stateHash());
  for (let at = 0; at < saved.length; at += 101) {
    const damaged = saved.slice();
    damaged[at] ^= 0x10;
    assert.throws(() => Cloth.restore(damaged), /`buffer` must hold a saved cloth/, `byte ${at}`);
    assert.throws(() => Cloth.restore(saved.subarray(0, at)), /`buffer` must/, `${at} bytes`);
  }
});

test("an error states the rule, the value and a similar name", () => {
  const { cloth } = movingCloth();
  const says = (call, message) => assert.throws(call, { name: "Error", message });
  const hint = "`settings.iteration` is not known; did you mean `iterations`?";
  says(() => (cloth.settings = { iteration: 3 }), hint);
  says(() => (cloth.settings = { zoom: 3 }), "`settings.zoom` is not known");
  says(() => (cloth.settings = { maxStretch: -1 }), "`settings.maxStretch` must be at least 0 and finite");
  says(() => Cloth.grid({ columns: 2.5 }), /^`columns` must be a whole number .*, but is 2.5$/);
  says(() => cloth.pin(1000), /^`particle` must be below \d+, but is 1000$/);
  says(() => cloth.setPositions([0, 0, 0, 0, NaN, 0]), "`positions` must be a number, but is NaN at index 4");
  says(() => cloth.setPositions(Float32Array.of(0, 0, 0, 0, NaN, 0)), "`positions[1]` must be finite");
  says(() => cloth.tearEdge(0, 5), "`particleB` must be joined to `particleA` by an edge");
});

test("a full list of grabs and a used-up reserve throw by name", () => {
  const cloth = Cloth.grid({ columns: 9, rows: 9, extraParticles: 0 });
  for (let i = 0; i < 64; i++) cloth.grabParticle(i);
  const before = cloth.stateHash();
  assert.throws(() => cloth.grabParticle(64), { message: "no room is left for another grab" });
  assert.throws(() => cloth.tearEdge(70, 71), { message: "no room is left for another torn vertex" });
  assert.equal(cloth.stateHash(), before);
});
