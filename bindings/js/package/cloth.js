// The class Cloth: checks arguments, passes flat lists to the module's RawCloth, and converts its
// answers to objects and views.

import * as raw from "./raw.js";
import {
  check,
  checkKeys,
  toBoolean,
  toChoiceIndex,
  toFloat32Array,
  toNumber,
  toUint32,
  toUint32Array,
  toUint8Array,
  toVector,
} from "./check.js";
import { advanceMany } from "./crowd.js";
import { isTrap, requireMemory, viewOf } from "./memory.js";
import { setState, stateOf } from "./state.js";
import { countCloth, discountCloth } from "./usage.js";
import * as fields from "./fields.js";
import { Attachment, Collider, CONSTRUCTOR_KEY, Grab, checkConstructorKey, packPose, packRay } from "./handles.js";
import { collideWith } from "./layers.js";
import {
  readBytes,
  readChanges,
  readEvents,
  readHit,
  readMeshReport,
  readStats,
  withMassOfCloth,
} from "./reports.js";
import { makeSkin } from "./skin.js";
import { writeIndices, writeVertices } from "./write.js";

const GRID_KEYS = [...Object.keys(fields.GRID), "material", "settings"];
const MESH_LISTS = ["positions", "indices", "uvs", "pinned"];
const COLLIDER_KEYS = [...Object.keys(fields.COLLIDER), "positions", "indices", "heights"];
const MESH_KEYS = [...MESH_LISTS, ...Object.keys(fields.MESH), "material", "settings"];

/** No rotation. */
const IDENTITY = [0, 0, 0, 1];

/** Makes a cloth; turns a trap of the module into an error about memory. */
function makeCloth(build) {
  try {
    return new Cloth(CONSTRUCTOR_KEY, build());
  } catch (error) {
    if (!isTrap(error)) throw error;
    throw new Error("there is not enough memory for this cloth", { cause: error });
  }
}

/** Returns the RawCloth. Throws if the cloth was freed. */
function rawOf(cloth) {
  const { live } = stateOf(cloth, "Cloth");
  check(live, "cloth", "be live, but was freed");
  return live;
}

/** Returns a view of the module's memory, see `viewOf`. */
function viewOfCloth(cloth, name, Kind, address, length) {
  return viewOf(stateOf(cloth, "Cloth").views, name, Kind, address, length);
}

export class Cloth {
  constructor(key, live) {
    checkConstructorKey(key, "a cloth is made by Cloth.grid(), Cloth.mesh() or Cloth.restore()");
    const state = { live, address: live.address(), views: {} };
    setState(this, state);
    countCloth(this, state, readBytes(live.stats()));
  }

  static grid(desc = {}) {
    requireMemory();
    checkKeys(desc, "desc", GRID_KEYS);
    const grid = fields.pack(fields.GRID, raw.default_grid(), desc);
    const [material, settings] = fields.packMaterialAndSettings(desc, raw);
    return makeCloth(() => raw.RawCloth.grid(grid, material, settings));
  }

  static mesh(desc) {
    requireMemory();
    checkKeys(desc, "desc", MESH_KEYS);
    const positions = toFloat32Array(desc.positions, "positions", 3);
    const indices = toUint32Array(desc.indices, "indices");
    const uvs = toFloat32Array(desc.uvs ?? [], "uvs", 2);
    const pinned = toUint32Array(desc.pinned ?? [], "pinned");
    const mesh = fields.pack(fields.MESH, raw.default_mesh(), desc);
    const [material, settings] = fields.packMaterialAndSettings(desc, raw);
    return makeCloth(() => raw.RawCloth.mesh(positions, indices, uvs, pinned, mesh, material, settings));
  }

  static restore(buffer) {
    requireMemory();
    const saved = toUint8Array(buffer, "buffer");
    return makeCloth(() => raw.RawCloth.restore(saved));
  }

  duplicate() {
    const live = rawOf(this);
    return makeCloth(() => live.duplicate());
  }

  static advanceMany(cloths, seconds) {
    return advanceMany(cloths, (cloth) => cloth instanceof Cloth && stateOf(cloth, "Cloth"), seconds);
  }

  free() {
    const state = stateOf(this, "Cloth");
    state.live?.free();
    [state.live, state.views] = [undefined, {}];
    discountCloth(state);
  }

  get isFreed() {
    return stateOf(this, "Cloth").live === undefined;
  }

  // Time

  advance(seconds) {
    return rawOf(this).advance(toNumber(seconds, "seconds"));
  }

  step(ticks = 1) {
    rawOf(this).step(toUint32(ticks, "ticks"));
  }

  reset() {
    rawOf(this).reset();
  }

  get time() {
    return rawOf(this).time();
  }

  get blend() {
    return rawOf(this).blend();
  }

  get ticks() {
    return rawOf(this).ticks();
  }

  get asleep() {
    return rawOf(this).asleep();
  }

  get timing() {
    return rawOf(this).is_timed();
  }

  set timing(timing) {
    rawOf(this).set_timed(toBoolean(timing, "timing"));
  }

  // Settings, material, wind

  get settings() {
    return fields.unpack(fields.SETTINGS, rawOf(this).settings());
  }

  set settings(settings) {
    const live = rawOf(this);
    live.set_settings(fields.merge(fields.SETTINGS, live.settings(), settings, "settings"));
  }

  get material() {
    return fields.unpack(fields.MATERIAL, rawOf(this).material());
  }

  set material(material) {
    const live = rawOf(this);
    live.set_material(fields.mergeMaterial(live.material(), material, raw.preset_material));
  }

  get wind() {
    return fields.unpack(fields.WIND, rawOf(this).wind());
  }

  set wind(wind) {
    const live = rawOf(this);
    live.set_wind(fields.merge(fields.WIND, live.wind(), wind, "wind"));
  }

  // Views

  get positions() {
    const live = rawOf(this);
    return viewOfCloth(this, "positions", Float32Array, live.positions_ptr(), 3 * live.vertex_count());
  }

  get relativePositions() {
    const live = rawOf(this);
    return viewOfCloth(this, "relative", Float32Array, live.relative_positions_ptr(), 3 * live.vertex_count());
  }

  get origin() {
    return Array.from(rawOf(this).origin());
  }

  get normals() {
    const live = rawOf(this);
    return viewOfCloth(this, "normals", Float32Array, live.normals_ptr(), 3 * live.vertex_count());
  }

  get uvs() {
    const live = rawOf(this);
    return viewOfCloth(this, "uvs", Float32Array, live.uvs_ptr(), 2 * live.vertex_count());
  }

  get indices() {
    const live = rawOf(this);
    return viewOfCloth(this, "indices", Uint32Array, live.indices_ptr(), live.index_count());
  }

  get sourceVertices() {
    const live = rawOf(this);
    return viewOfCloth(this, "sources", Uint32Array, live.source_vertices_ptr(), live.vertex_count());
  }

  get frayed() {
    const live = rawOf(this);
    return viewOfCloth(this, "frayed", Uint8Array, live.frayed_ptr(), live.vertex_count());
  }

  get vertexParticles() {
    const live = rawOf(this);
    return viewOfCloth(this, "particles", Uint32Array, live.vertex_particles_ptr(), live.vertex_count());
  }

  get meshReport() {
    return readMeshReport(rawOf(this).mesh_report());
  }

  changes(sinceTopologyRevision) {
    const since = toUint32(sinceTopologyRevision, "sinceTopologyRevision");
    return readChanges(rawOf(this).changes(since));
  }

  // Writing to buffers of the caller

  writeVertices(streams, desc = {}) {
    return writeVertices(rawOf(this), streams, desc);
  }

  writeIndices(buffer, options = {}) {
    return writeIndices(rawOf(this), buffer, options);
  }

  skin(desc) {
    return makeSkin(() => rawOf(this), desc);
  }

  get vertexCapacity() {
    return rawOf(this).vertex_capacity();
  }

  get indexCapacity() {
    return rawOf(this).index_capacity();
  }

  get topologyRevision() {
    return rawOf(this).topology_revision();
  }

  get stateRevision() {
    return rawOf(this).state_revision();
  }

  // Particles

  position(particle) {
    return Array.from(rawOf(this).position(toUint32(particle, "particle")));
  }

  velocity(particle) {
    return Array.from(rawOf(this).velocity(toUint32(particle, "particle")));
  }

  get mass() {
    rawOf(this);
    const massOfParticle = (particle) => rawOf(this).mass(toUint32(particle, "particle"));
    return withMassOfCloth(massOfParticle, () => rawOf(this).mass_properties());
  }

  setPosition(particle, position) {
    rawOf(this).set_position(toUint32(particle, "particle"), ...toVector(position, "position"));
  }

  setVelocity(particle, velocity) {
    rawOf(this).set_velocity(toUint32(particle, "particle"), ...toVector(velocity, "velocity"));
  }

  // Pins

  get pinned() {
    return rawOf(this).pinned();
  }

  get pins() {
    return this.pinned;
  }

  get pinTargets() {
    return rawOf(this).pin_targets();
  }

  pin(particle, target) {
    const live = rawOf(this);
    toUint32(particle, "particle");
    if (target === undefined) live.pin_here(particle);
    else live.pin_at(particle, ...toVector(target, "target"));
  }

  unpin(particle) {
    rawOf(this).unpin(toUint32(particle, "particle"));
  }

  unpinAll() {
    rawOf(this).unpin_all();
  }

  setPinTargets(particles, targets) {
    const live = rawOf(this);
    live.set_pin_targets(toUint32Array(particles, "particles"), toFloat32Array(targets, "targets", 3));
  }

  setPinStiffness(particles, stiffness) {
    const live = rawOf(this);
    live.set_pin_stiffness(toUint32Array(particles, "particles"), toNumber(stiffness, "stiffness"));
  }

  get velocities() {
    return rawOf(this).velocities();
  }

  get restPositions() {
    return rawOf(this).rest_positions();
  }

  setPositions(positions, first = 0) {
    const live = rawOf(this);
    live.set_positions(toUint32(first, "first"), toFloat32Array(positions, "positions", 3));
  }

  setVelocities(velocities, first = 0) {
    const live = rawOf(this);
    live.set_velocities(toUint32(first, "first"), toFloat32Array(velocities, "velocities", 3));
  }

  setMassScales(particles, scales) {
    rawOf(this).set_mass_scales(toUint32Array(particles, "particles"), toFloat32Array(scales, "scales", 1));
  }

  setMap(map, scales) {
    const live = rawOf(this);
    const number = toChoiceIndex(map, "map", fields.MAPS);
    live.set_map(number, scales === null ? undefined : toFloat32Array(scales, "scales", 1));
  }

  map(map) {
    return rawOf(this).map(toChoiceIndex(map, "map", fields.MAPS)) ?? null;
  }

  // Attachments, anchors, frame

  attach(particles, position, rotation = IDENTITY) {
    const live = rawOf(this);
    const handle = live.attach(toUint32Array(particles, "particles"), packPose(position, rotation));
    return new Attachment(CONSTRUCTOR_KEY, () => rawOf(this), handle, Array.from(rotation));
  }

  setMaxDistances(particles, distances) {
    const live = rawOf(this);
    live.set_max_distances(toUint32Array(particles, "particles"), toFloat32Array(distances, "distances", 1));
  }

  setBackstops(particles, distances, radii) {
    const live = rawOf(this);
    const lengths = [toFloat32Array(distances, "distances", 1), toFloat32Array(radii, "radii", 1)];
    live.set_backstops(toUint32Array(particles, "particles"), ...lengths);
  }

  setAnchors(particles, positions, normals = []) {
    const live = rawOf(this);
    const vectors = [toFloat32Array(positions, "positions", 3), toFloat32Array(normals, "normals", 3)];
    live.set_anchors(toUint32Array(particles, "particles"), ...vectors);
  }

  clearLeashes() {
    rawOf(this).clear_leashes();
  }

  setFrame(position, rotation = IDENTITY) {
    rawOf(this).set_frame(packPose(position, rotation));
  }

  teleport(position, rotation = IDENTITY) {
    rawOf(this).teleport(packPose(position, rotation));
  }

  moveFrame(position, rotation = IDENTITY, inertia = 0) {
    rawOf(this).move_frame(packPose(position, rotation), toNumber(inertia, "inertia"));
  }

  // Ray casts, grabs, cuts, creases and tears

  raycast(origin, direction, maxDistance = Infinity) {
    const live = rawOf(this);
    return readHit(live.raycast(packRay(origin, direction), toNumber(maxDistance, "maxDistance")));
  }

  grabRay(origin, direction, options = {}) {
    const live = rawOf(this);
    const { radius = 0 } = checkKeys(options, "options", ["radius"]);
    const held = live.grab_ray(packRay(origin, direction), toNumber(radius, "radius"));
    return held.length === 0 ? undefined : new Grab(CONSTRUCTOR_KEY, () => rawOf(this), held[0], held.subarray(1));
  }

  grabParticle(particle) {
    const grab = rawOf(this).grab_particle(toUint32(particle, "particle"));
    const at = this.positions.subarray(3 * particle, 3 * particle + 3);
    return new Grab(CONSTRUCTOR_KEY, () => rawOf(this), grab, at);
  }

  cut(from, to, sweep) {
    const live = rawOf(this);
    const blade = [toVector(from, "from"), toVector(to, "to"), toVector(sweep, "sweep")];
    return live.cut(Float64Array.from(blade.flat()));
  }

  crease(from, to, angle) {
    const live = rawOf(this);
    const line = [toVector(from, "from"), toVector(to, "to")];
    live.crease(Float64Array.from(line.flat()), toNumber(angle, "angle"));
  }

  sew(pairs, options = {}) {
    const live = rawOf(this);
    checkKeys(options, "options", ["speed", "kind", "tearForce"]);
    const { speed = 0.5, kind = "weld", tearForce = 0 } = options;
    const list = toUint32Array(Array.isArray(pairs) ? pairs.flat() : pairs, "pairs");
    check(list.length % 2 === 0, "pairs", "hold two particles per pair");
    const isStitch = toChoiceIndex(kind, "kind", ["weld", "stitch"]) === 1;
    live.sew(list, toNumber(speed, "speed"), isStitch, toNumber(tearForce, "tearForce"));
  }

  tearEdge(particleA, particleB) {
    const live = rawOf(this);
    return live.tear_edge(toUint32(particleA, "particleA"), toUint32(particleB, "particleB"));
  }

  // Colliders

  addCollider(collider = {}) {
    const live = rawOf(this);
    checkKeys(collider, "collider", COLLIDER_KEYS);
    const desc = fields.pack(fields.COLLIDER, raw.default_collider(), collider, "collider");
    const positions = toFloat32Array(collider.positions ?? [], "collider.positions", 3);
    const indices = toUint32Array(collider.indices ?? [], "collider.indices");
    const heights = toFloat32Array(collider.heights ?? [], "collider.heights", 1);
    const { rotation } = fields.unpack(fields.COLLIDER, desc);
    const handle = live.add_collider(desc, positions, indices, heights);
    return new Collider(CONSTRUCTOR_KEY, () => rawOf(this), handle, rotation);
  }

  collideWith(other) {
    const inner = other instanceof Cloth && stateOf(other, "Cloth");
    return collideWith(stateOf(this, "Cloth"), () => rawOf(this), inner);
  }

  // Events, statistics, saved states

  events() {
    return readEvents(rawOf(this).events());
  }

  get stats() {
    return readStats(rawOf(this).stats(), raw.stage_names());
  }

  stateHash() {
    const [low, high] = rawOf(this).state_hash();
    return (BigInt(high) << 32n) | BigInt(low);
  }

  save() {
    return rawOf(this).save();
  }
}

// In engines with `using`.
if (Symbol.dispose) {
  const notEnumerable = (value) => ({ value, writable: true, configurable: true });
  Object.defineProperty(Cloth.prototype, Symbol.dispose, notEnumerable(Cloth.prototype.free));
}
