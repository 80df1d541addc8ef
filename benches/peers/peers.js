// The same sheet, pinned along its top edge, in every engine that is compared. `frame()` runs a
// tick of 1/60 s and returns what a page needs to draw it: positions and normals in typed arrays.

import { HandwrittenSheet, computeNormals } from "./handwritten.js";

const SIZE = 2;
const TICK = 1 / 60;
const SWEEPS = 6;

/**
 * Returns the contenders for the modules that are given; `make(side)` creates a sheet of `side` by
 * `side` particles.
 */
export function contenders({ Cloth, Jolt, RAPIER }) {
  const always = [
    { name: "muslin, 6 sweeps", make: (side) => muslin(Cloth, side, { substeps: 1, iterations: SWEEPS }) },
    { name: "muslin", make: (side) => muslin(Cloth, side, {}) },
    { name: "hand-written JS, 6 sweeps", make: handwritten },
  ];
  const jolts = [
    { name: "Jolt, 6 sweeps", make: (side) => jolt(Jolt, side, false) },
    { name: "Jolt, 6 sweeps, LRA", make: (side) => jolt(Jolt, side, true) },
  ];
  // With 128 particles per side a frame takes most of a second.
  const rapiers = [{ name: "Rapier cloth", make: (side) => rapier(RAPIER, side), maxSide: 64 }];
  return [...always, ...(Jolt ? jolts : []), ...(RAPIER ? rapiers : [])];
}

/** Returns the largest strain between neighbours of a sheet. */
function maxStretch(positions, side) {
  const rest = SIZE / (side - 1);
  let largest = 0;
  const compare = (i, j) => {
    const span = [0, 1, 2].map((axis) => positions[3 * i + axis] - positions[3 * j + axis]);
    largest = Math.max(largest, Math.hypot(...span) / rest - 1);
  };
  for (let row = 0; row < side; row++) {
    for (let column = 0; column < side; column++) {
      const at = row * side + column;
      if (column + 1 < side) compare(at, at + 1);
      if (row + 1 < side) compare(at, at + side);
    }
  }
  return largest;
}

function muslin(Cloth, side, settings) {
  const cloth = Cloth.grid({ columns: side, rows: side, spacing: SIZE / (side - 1), origin: [-1, 1, 0], settings });
  return {
    frame() {
      cloth.advance(TICK);
      return [cloth.positions, cloth.normals];
    },
    // For the time to read both views.
    read: () => cloth.positions.length + cloth.normals.length,
    stretch: () => maxStretch(cloth.positions, side),
    free: () => cloth.free(),
  };
}

function handwritten(side) {
  const sheet = new HandwrittenSheet(side, SIZE);
  return {
    frame() {
      sheet.tick(TICK);
      return [sheet.positions, sheet.normals];
    },
    stretch: () => maxStretch(sheet.positions, side),
    free() {},
  };
}

/** Returns a function that computes normals, for engines that leave that to the page. */
function normalsFor(side) {
  const { indices, normals } = new HandwrittenSheet(side, SIZE);
  return (positions) => {
    computeNormals(positions, indices, normals);
    return [positions, normals];
  };
}

function jolt(Jolt, side, isTethered) {
  const layers = new Jolt.ObjectLayerPairFilterTable(1);
  const broad = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  broad.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
  const settings = new Jolt.JoltSettings();
  settings.mObjectLayerPairFilter = layers;
  settings.mBroadPhaseLayerInterface = broad;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 1, layers, 1);
  const world = new Jolt.JoltInterface(settings);
  const bodies = world.GetPhysicsSystem().GetBodyInterface();

  const shared = new Jolt.SoftBodySharedSettings();
  const sheet = new HandwrittenSheet(side, SIZE);
  for (let i = 0; i < side * side; i++) {
    const vertex = new Jolt.SoftBodySharedSettingsVertex();
    vertex.mPosition = new Jolt.Float3(...sheet.positions.subarray(3 * i, 3 * i + 3));
    vertex.mInvMass = i < side ? 0 : 1;
    shared.mVertices.push_back(vertex);
  }
  for (let at = 0; at < sheet.indices.length; at += 3) {
    shared.AddFace(new Jolt.SoftBodySharedSettingsFace(...sheet.indices.subarray(at, at + 3), 0));
  }
  const attributes = new Jolt.SoftBodySharedSettingsVertexAttributes();
  attributes.mCompliance = attributes.mShearCompliance = attributes.mBendCompliance = 1e-5; // as in its own samples; stiffer links are unstable
  attributes.mLRAType = isTethered ? Jolt.SoftBodySharedSettings_ELRAType_EuclideanDistance : Jolt.SoftBodySharedSettings_ELRAType_None;
  attributes.mLRAMaxDistanceMultiplier = 1;
  shared.CreateConstraints(attributes, 1, Jolt.SoftBodySharedSettings_EBendType_Distance);
  shared.Optimize();
  const creation = new Jolt.SoftBodyCreationSettings(shared, new Jolt.RVec3(0, 0, 0), new Jolt.Quat(0, 0, 0, 1), 0);
  creation.mNumIterations = SWEEPS;
  creation.mUpdatePosition = false;
  creation.mAllowSleeping = false;
  const body = bodies.CreateSoftBody(creation);
  bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);

  const vertices = Jolt.castObject(body.GetMotionProperties(), Jolt.SoftBodyMotionProperties).GetVertices();
  const offset = Jolt.SoftBodyVertexTraits.prototype.mPositionOffset;
  // Reads the memory of the module directly, without an object per vertex, as a careful page does.
  const starts = Uint32Array.from({ length: side * side }, (_, i) => (Jolt.getPointer(vertices.at(i)) + offset) / 4);
  const positions = new Float32Array(3 * side * side);
  const withNormals = normalsFor(side);
  const read = () => {
    const memory = Jolt.HEAPF32;
    for (let i = 0; i < starts.length; i++) {
      positions[3 * i] = memory[starts[i]];
      positions[3 * i + 1] = memory[starts[i] + 1];
      positions[3 * i + 2] = memory[starts[i] + 2];
    }
    return positions;
  };
  return {
    frame() {
      world.Step(TICK, 1);
      return withNormals(read());
    },
    stretch: () => maxStretch(read(), side),
    free: () => Jolt.destroy(world),
  };
}

function rapier(RAPIER, side) {
  const world = new RAPIER.World({ x: 0, y: -9.81, z: 0 });
  const spacing = SIZE / (side - 1);
  const [origin, right, down] = [{ x: -1, y: 1, z: 0 }, { x: spacing, y: 0, z: 0 }, { x: 0, y: -spacing, z: 0 }];
  const desc = RAPIER.SoftBodyDesc.cloth(origin, right, down, side, side);
  // Rapier orders the particles itself, so the top row is found by position.
  desc.canSleep = false;
  const probe = new RAPIER.World({ x: 0, y: 0, z: 0 });
  const start = probe.createSoftBody(desc).particlePositions();
  probe.free();
  const order = Array.from({ length: side * side }, (_, i) => i).sort((i, j) => {
    const rows = Math.round((start[3 * j + 1] - start[3 * i + 1]) / spacing);
    return rows || start[3 * i] - start[3 * j];
  });
  desc.pinnedParticles = Uint32Array.from(order.slice(0, side));
  const body = world.createSoftBody(desc);
  const withNormals = normalsFor(side);
  const ordered = new Float32Array(3 * side * side);
  const read = () => {
    const unordered = body.particlePositions();
    for (let i = 0; i < order.length; i++) {
      for (let axis = 0; axis < 3; axis++) ordered[3 * i + axis] = unordered[3 * order[i] + axis];
    }
    return ordered;
  };
  return {
    frame() {
      world.step();
      return withNormals(read());
    },
    stretch: () => maxStretch(read(), side),
    free: () => world.free(),
  };
}
