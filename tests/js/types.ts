// Uses the whole interface; it is type-checked in strict mode and never run.

import init, {
  Cloth,
  initSync,
  version,
  type Attachment,
  type Changes,
  type ClothEvent,
  type ClothMass,
  type Collider,
  type ColliderDesc,
  type Grab,
  type GridDesc,
  type Hit,
  type Material,
  type MeshDesc,
  type MeshReport,
  type Pose,
  type Preset,
  type Quat,
  type Settings,
  type Skin,
  type SkinDesc,
  type Stage,
  type Stats,
  type Stream,
  type Vec3,
  type Wind,
  type WriteDesc,
} from "muslin";
import initInline from "muslin/inline";
import initLight, { Cloth as LightCloth } from "muslin/light";
import initWithout, { Cloth as ClothWithout, initSync as initWithoutSync } from "muslin/no-wasm";
import { Pointers } from "muslin/pointers";
import { ClothGeometry } from "muslin/three";
import { BufferGeometry, Mesh } from "three";

const loaded: Promise<void> = init();
await init("https://example.org/raw_bg.wasm");
await init(new URL("raw_bg.wasm", "https://example.org"));
await init(fetch("raw_bg.wasm"));
await init(new Uint8Array(8));
initSync(new WebAssembly.Module(new Uint8Array(8)));
// @ts-expect-error: a number is no source
await init(7);
// @ts-expect-error: a URL cannot be loaded synchronously
initSync("raw_bg.wasm");
const versionText: string = version();

// muslin/no-wasm loads nothing, and has the same classes.
const ready: Promise<void> = initWithout();
initWithoutSync();
// @ts-expect-error: there is no source to pass
await initWithout("raw_bg.wasm");
const without: Cloth = ClothWithout.grid({ columns: 8, rows: 8 });
const pulls: boolean = new Pointers(without, { radius: 0.1 }).press(1, [0, 0, 1], [0, 0, -1]);
await initInline();
await initLight();
await initLight(fetch("light_bg.wasm"));
const light: Cloth = LightCloth.grid({ columns: 8, rows: 8 });

const desc: GridDesc = {
  columns: 40,
  rows: 40,
  spacing: 0.05,
  origin: [0, 1, 0],
  right: new Float32Array([1, 0, 0]),
  down: [0, -1, 0],
  pinMode: "top-corners",
  extraParticles: 100,
  material: { preset: "denim", bendStiffness: 1e-4 },
  settings: { iterations: 6, gravity: [0, -9.81, 0], tearing: true },
};
const cloth: Cloth = Cloth.grid(desc);
Cloth.grid();
// @ts-expect-error: no such field
Cloth.grid({ colums: 4 });
// @ts-expect-error: no such pin mode
Cloth.grid({ pinMode: "left-edge" });
// @ts-expect-error: no such preset
Cloth.grid({ material: "wool" });
// @ts-expect-error: the constructor is private
new Cloth();

const sheet: MeshDesc = {
  positions: new Float32Array(9),
  indices: new Uint16Array([0, 2, 1]),
  uvs: [0, 0, 1, 0, 0, 1],
  pinned: new Uint32Array([0]),
  weldDistance: -1,
  simplifyBelow: 0.001,
  material: "flag-nylon",
};
using other = Cloth.mesh(sheet);
// @ts-expect-error: indices are required
Cloth.mesh({ positions: [0, 0, 0] });

cloth.settings = { iterations: 6 };
cloth.settings = cloth.settings;
const settings: Readonly<Settings> = cloth.settings;
// @ts-expect-error: the copy that was read is read-only
cloth.settings.iterations = 6;
// @ts-expect-error: no such setting
cloth.settings = { iteration: 6 };
// @ts-expect-error: a boolean, not a number
cloth.settings = { tearing: 1 };
const preset: Preset = "silk";
cloth.material = preset;
cloth.material = { tearStretch: 1.5 };
const material: Readonly<Material> = cloth.material;
cloth.wind = { model: "sine-field", velocity: [0, 0, 2], gust: 0.5, seed: 7 };
const wind: Readonly<Wind> = cloth.wind;
// @ts-expect-error: no such model
cloth.wind = { model: "storm" };
cloth.timing = true;

const ticks: number = cloth.advance(1 / 60);
cloth.step();
cloth.step(10);
cloth.reset();
// @ts-expect-error: seconds are a number
cloth.advance("1");
const twin: Cloth = cloth.duplicate();
const ran: Uint32Array = Cloth.advanceMany([cloth, twin], 1 / 60);
// @ts-expect-error: an array of cloths
Cloth.advanceMany(cloth, 1 / 60);
const clocks: number = cloth.time + cloth.blend + ticks;

const floats: Float32Array[] = [cloth.positions, cloth.relativePositions, cloth.normals, cloth.uvs];
const placeOfOrigin: readonly number[] = cloth.origin;
const integers: Uint32Array[] = [cloth.indices, cloth.sourceVertices, cloth.vertexParticles, cloth.pinned];
const report: Readonly<MeshReport> = other.meshReport;
const repaired: number = report.weldedVertices + report.turnedTriangles + Number(report.isGrid);
const quality: number = report.shortestEdge + report.meanEdge + report.worstAspect + report.thinTriangles;
const sentences: readonly string[] = report.warnings;
// @ts-expect-error: the report is read-only
report.pieces = 2;
// @ts-expect-error: views cannot be assigned
cloth.positions = new Float32Array(3);
const sizes: number = cloth.vertexCapacity + cloth.indexCapacity;
const revisions: number = cloth.topologyRevision + cloth.stateRevision;

cloth.pin(0);
cloth.pin(0, [0, 1, 0]);
cloth.unpin(0);
cloth.unpinAll();
cloth.setPinTargets([0, 1], new Float32Array(6));
const body: Attachment = cloth.attach([0, 1], [0, 1, 0], [0, 0, 0, 1]);
body.moveTo([0, 1, 0]);
body.detach();
cloth.setPinStiffness([0, 1], 100);
cloth.setMaxDistances(new Uint32Array([4]), [0.1]);
cloth.setBackstops([4], [0], new Float32Array([1]));
cloth.setAnchors([4], [0, 0, 0], [0, 0, 1]);
cloth.setMassScales([4], [2]);
cloth.setMap("tear", new Float32Array(1600));
cloth.setMap("bend", null);
const painted: Float32Array | null = cloth.map("tear");
cloth.setFrame([0, 0, 0]);
cloth.teleport([1, 0, 0], [0, 0, 0, 1]);
cloth.moveFrame([1, 0, 0]);
cloth.moveFrame([1, 0, 0], [0, 0, 0, 1], 0.25);
cloth.setPosition(5, [0, 0, 0]);
cloth.setVelocity(5, new Float64Array(3));
const velocity: Vec3 = cloth.velocity(5);
const position: Vec3 = cloth.position(5);
const mass: number = cloth.mass(5) + cloth.mass.total;
const center: Vec3 = cloth.mass.center;
const { momentum }: Readonly<ClothMass> = cloth.mass;
cloth.setPositions(cloth.positions.slice());
cloth.setPositions([0, 0, 0], 5);
cloth.setVelocities(cloth.velocities, 0);
// @ts-expect-error: a list, not a vector per particle
cloth.setPositions([[0, 0, 0]]);
const copies: Float32Array[] = [cloth.velocities, cloth.restPositions, cloth.pinTargets];
const pins: Uint32Array = cloth.pins;
const awake: boolean = !cloth.asleep && cloth.ticks > 0;
// @ts-expect-error: a position has three numbers
cloth.pin(0, "here");

const hit: Hit | undefined = cloth.raycast([1, -1, 5], [0, 0, -1], 10);
const where: Vec3 | undefined = hit?.position;
const grab: Grab | undefined = cloth.grabRay([1, -1, 5], [0, 0, -1], { radius: 0.1 });
grab?.moveTo([0, 0, 0]);
grab?.release();
// @ts-expect-error: a ray may miss
grab.release();
const held: Vec3 = cloth.grabParticle(3).position;
const changed: Changes = cloth.changes(cloth.topologyRevision);
const atBorder: boolean = cloth.frayed[changed.firstVertex] === 1;
const opened: number = cloth.cut([-1, -0.5, -1], [3, -0.5, -1], new Float32Array([0, 0, 2]));
const tore: boolean = cloth.tearEdge(820, 860);

const floor: ColliderDesc = { shape: "plane", position: [0, -2, 0], friction: 0.5 };
const collider: Collider = cloth.addCollider(floor);
const layer: Collider = cloth.collideWith(Cloth.grid());
const pushed: readonly number[] = collider.impulse.linear;
cloth.addCollider({ shape: "mesh", positions: new Float32Array(9), indices: [0, 1, 2], thickness: 0.01 });
collider.moveTo([0, -1, 0]);
collider.moveTo([0, -1, 0], [0, 0, 0, 1]);
const pose: Pose = collider.pose;
const turnedBy: Quat = pose.rotation;
// @ts-expect-error: a pose is read-only
collider.pose = pose;
collider.remove();
// @ts-expect-error: no such shape
cloth.addCollider({ shape: "torus" });

function numberOf(event: ClothEvent): number {
  switch (event.kind) {
    case "edge-torn":
    case "stitch-torn":
      return event.particleA + event.particleB;
    case "vertex-split":
      return event.vertex + event.source;
    case "piece-detached":
      return event.vertex + event.count;
    case "recovered":
      // @ts-expect-error: this kind has no vertex
      return event.vertex;
    case "reserve-used-up":
      return event.tick + event.position[0];
    case "held-apart":
      return event.particleA + event.particleB + event.count;
    case "held-inside":
    case "free-inside":
      return event.particleA + event.count;
    case "layers-cross":
      return event.particleA + event.particleB + event.count;
    case "edge-divided":
      return event.particleA + event.particleB + event.vertex;
  }
}
const sum: number = cloth.events().reduce((total, event) => total + numberOf(event), 0);
const stats: Stats = cloth.stats;
const stages: Stage[] = ["stretch", "outputs"];
const seconds: number[] = stages.map((stage) => stats.seconds[stage]);

const hash: bigint = cloth.stateHash();
const saved: Uint8Array = cloth.save();
const restored: Cloth = Cloth.restore(saved);
const geometry: BufferGeometry = new ClothGeometry(restored);
const followed = new ClothGeometry(cloth);
const moved: boolean = followed.update();
const drawn = new Mesh(followed);
const kept: Cloth = drawn.geometry.cloth;
cloth.free();
const isFreed: boolean = cloth.isFreed;

const streams: Stream[] = [
  { attribute: "position", buffer: new Float32Array(9), stride: 12 },
  { attribute: "normal", format: "octahedral16", buffer: new ArrayBuffer(12), offset: 0 },
];
const writeDesc: WriteDesc = { blend: cloth.blend, transform: new Float32Array(12), flipNormals: true, relative: false };
const writtenVertices: number = cloth.writeVertices(streams, writeDesc);
const writtenIndices: number = cloth.writeIndices(new Uint16Array(3), { flip: true, baseVertex: 4 });
// @ts-expect-error: no such attribute
cloth.writeVertices([{ attribute: "colour", buffer: new Float32Array(9) }]);
// @ts-expect-error: an array is no buffer
cloth.writeVertices([{ attribute: "uv", buffer: [0, 0] }]);
// @ts-expect-error: indices are integers
cloth.writeIndices(new Float32Array(3));

export { clocks, floats, geometry, hash, held, isFreed, kept, loaded, mass, material, moved, other };
export { position, pulls, ready, repaired, revisions, seconds, settings, sizes, sum, versionText, tore, velocity, where, integers, wind };
export { writtenIndices, writtenVertices };

const skinDesc: SkinDesc = { positions: new Float32Array(9), indices: [0, 1, 2], smoothness: 0.5 };
const skin: Skin = cloth.skin(skinDesc);
const skinLists: [Float32Array, Float32Array, Float32Array, Uint32Array, Uint32Array, Uint8Array] = [
  skin.positions,
  skin.normals,
  skin.uvs,
  skin.indices,
  skin.sourceVertices,
  skin.frayed,
];
const skinCounts: [number, number, number] = [
  skin.vertexCapacity,
  skin.topologyRevision,
  skin.write([{ attribute: "position", buffer: new Float32Array(9) }], { blend: 0.5 }),
];
// @ts-expect-error: a skin has positions
cloth.skin({ indices: [0, 1, 2] });
skin.free();
const skinIsFreed: boolean = skin.isFreed;
