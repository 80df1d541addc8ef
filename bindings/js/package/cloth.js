// The class Cloth: checks arguments, passes flat lists to the module's RawCloth, and converts its
// answers to objects and views.

import * as raw from "./raw.js";
import {
  check,
  checkKeys,
  toBoolean,
  toFloat32Array,
  toNumber,
  toUint32,
  toUint32Array,
  toUint8Array,
  toVector,
} from "./check.js";
import { isTrap, requireMemory } from "./memory.js";
import * as fields from "./fields.js";
import { Attachment, Collider, CONSTRUCTOR_KEY, Grab, checkConstructorKey, packPose } from "./handles.js";
import { readChanges, readEvents, readHit, readMeshReport, readStats } from "./reports.js";
import { writeIndices, writeVertices } from "./write.js";

const GRID_KEYS = [...Object.keys(fields.GRID), "material", "settings"];
const MESH_LISTS = ["positions", "indices", "uvs", "pinned"];
const COLLIDER_KEYS = [...Object.keys(fields.COLLIDER), "positions", "indices", "heights"];
const MESH_KEYS = [...MESH_LISTS, ...Object.keys(fields.MESH), "material", "settings"];

/** No rotation. */
const IDENTITY = [0, 0, 0, 1];

/** Returns the material and the settings of a descriptor as flat lists. */
function packMaterialAndSettings({ material = {}, settings = {} }) {
  return [
    fields.mergeMaterial(raw.default_material(), material, raw.preset_material),
    fields.merge(fields.SETTINGS, raw.default_settings(), settings, "settings"),
  ];
}

/** Makes a cloth; turns a trap of the module into an error about memory. */
function makeCloth(build) {
  try {
    return new Cloth(CONSTRUCTOR_KEY, build());
  } catch (error) {
    if (!isTrap(error)) throw error;
    throw new Error("there is not enough memory for this cloth", { cause: error });
  }
}

export class Cloth {
  #raw;
  #views = {};

  constructor(key, raw) {
    checkConstructorKey(key, "a cloth is made by Cloth.grid(), Cloth.mesh() or Cloth.restore()");
    this.#raw = raw;
  }

  static grid(desc = {}) {
    requireMemory();
    checkKeys(desc, "desc", GRID_KEYS);
    const grid = fields.pack(fields.GRID, raw.default_grid(), desc);
    const [material, settings] = packMaterialAndSettings(desc);
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
    const [material, settings] = packMaterialAndSettings(desc);
    return makeCloth(() => raw.RawCloth.mesh(positions, indices, uvs, pinned, mesh, material, settings));
  }

  static restore(buffer) {
    requireMemory();
    const saved = toUint8Array(buffer, "buffer");
    return makeCloth(() => raw.RawCloth.restore(saved));
  }

  /** The RawCloth. Throws if the cloth was freed. */
  get #live() {
    check(this.#raw, "cloth", "be live, but was freed");
    return this.#raw;
  }

  free() {
    this.#raw?.free();
    this.#raw = undefined;
    this.#views = {};
  }

  get isFreed() {
    return this.#raw === undefined;
  }

  // Time

  advance(seconds) {
    return this.#live.advance(toNumber(seconds, "seconds"));
  }

  step(ticks = 1) {
    this.#live.step(toUint32(ticks, "ticks"));
  }

  reset() {
    this.#live.reset();
  }

  get time() {
    return this.#live.time();
  }

  get blend() {
    return this.#live.blend();
  }

  get timing() {
    return this.#live.is_timed();
  }

  set timing(timing) {
    this.#live.set_timed(toBoolean(timing, "timing"));
  }

  // Settings, material, wind

  get settings() {
    return fields.unpack(fields.SETTINGS, this.#live.settings());
  }

  set settings(settings) {
    const live = this.#live;
    live.set_settings(fields.merge(fields.SETTINGS, live.settings(), settings, "settings"));
  }

  get material() {
    return fields.unpack(fields.MATERIAL, this.#live.material());
  }

  set material(material) {
    const live = this.#live;
    live.set_material(fields.mergeMaterial(live.material(), material, raw.preset_material));
  }

  get wind() {
    return fields.unpack(fields.WIND, this.#live.wind());
  }

  set wind(wind) {
    const live = this.#live;
    live.set_wind(fields.merge(fields.WIND, live.wind(), wind, "wind"));
  }

  // Views

  get positions() {
    const live = this.#live;
    return this.#view("positions", Float32Array, live.positions_ptr(), 3 * live.vertex_count());
  }

  get relativePositions() {
    const live = this.#live;
    return this.#view("relative", Float32Array, live.relative_positions_ptr(), 3 * live.vertex_count());
  }

  get origin() {
    return Array.from(this.#live.origin());
  }

  get normals() {
    const live = this.#live;
    return this.#view("normals", Float32Array, live.normals_ptr(), 3 * live.vertex_count());
  }

  get uvs() {
    const live = this.#live;
    return this.#view("uvs", Float32Array, live.uvs_ptr(), 2 * live.vertex_count());
  }

  get indices() {
    const live = this.#live;
    return this.#view("indices", Uint32Array, live.indices_ptr(), live.index_count());
  }

  get sourceVertices() {
    const live = this.#live;
    return this.#view("sources", Uint32Array, live.source_vertices_ptr(), live.vertex_count());
  }

  get frayed() {
    const live = this.#live;
    return this.#view("frayed", Uint8Array, live.frayed_ptr(), live.vertex_count());
  }

  get vertexParticles() {
    const live = this.#live;
    return this.#view("particles", Uint32Array, live.vertex_particles_ptr(), live.vertex_count());
  }

  get meshReport() {
    return readMeshReport(this.#live.mesh_report());
  }

  changes(sinceTopologyRevision) {
    const since = toUint32(sinceTopologyRevision, "sinceTopologyRevision");
    return readChanges(this.#live.changes(since));
  }

  // Writing to buffers of the caller

  writeVertices(streams, desc = {}) {
    return writeVertices(this.#live, streams, desc);
  }

  writeIndices(buffer, options = {}) {
    return writeIndices(this.#live, buffer, options);
  }

  /**
   * Returns a view of the module's memory: the last one if memory, address and length are still the
   * same.
   */
  #view(name, Kind, address, length) {
    const { buffer } = requireMemory(); // read here: the call that returned `address` may have grown the memory
    const last = this.#views[name];
    const fits = last?.buffer === buffer && last.byteOffset === address && last.length === length;
    return fits ? last : (this.#views[name] = new Kind(buffer, address, length));
  }

  get vertexCapacity() {
    return this.#live.vertex_capacity();
  }

  get indexCapacity() {
    return this.#live.index_capacity();
  }

  get topologyRevision() {
    return this.#live.topology_revision();
  }

  get stateRevision() {
    return this.#live.state_revision();
  }

  // Particles

  position(particle) {
    return Array.from(this.#live.position(toUint32(particle, "particle")));
  }

  velocity(particle) {
    return Array.from(this.#live.velocity(toUint32(particle, "particle")));
  }

  mass(particle) {
    return this.#live.mass(toUint32(particle, "particle"));
  }

  setPosition(particle, position) {
    this.#live.set_position(toUint32(particle, "particle"), ...toVector(position, "position"));
  }

  setVelocity(particle, velocity) {
    this.#live.set_velocity(toUint32(particle, "particle"), ...toVector(velocity, "velocity"));
  }

  // Pins

  get pinned() {
    return this.#live.pinned();
  }

  pin(particle, target) {
    const live = this.#live;
    toUint32(particle, "particle");
    if (target === undefined) live.pin_here(particle);
    else live.pin_at(particle, ...toVector(target, "target"));
  }

  unpin(particle) {
    this.#live.unpin(toUint32(particle, "particle"));
  }

  unpinAll() {
    this.#live.unpin_all();
  }

  setPinTargets(particles, targets) {
    const live = this.#live;
    live.set_pin_targets(toUint32Array(particles, "particles"), toFloat32Array(targets, "targets", 3));
  }

  setPinStiffness(particles, stiffness) {
    const live = this.#live;
    live.set_pin_stiffness(toUint32Array(particles, "particles"), toNumber(stiffness, "stiffness"));
  }

  setMassScales(particles, scales) {
    this.#live.set_mass_scales(toUint32Array(particles, "particles"), toFloat32Array(scales, "scales", 1));
  }

  // Attachments, anchors, frame

  attach(particles, position, rotation = IDENTITY) {
    const live = this.#live;
    const handle = live.attach(toUint32Array(particles, "particles"), packPose(position, rotation));
    return new Attachment(CONSTRUCTOR_KEY, () => this.#live, handle, Array.from(rotation));
  }

  setMaxDistances(particles, distances) {
    const live = this.#live;
    live.set_max_distances(toUint32Array(particles, "particles"), toFloat32Array(distances, "distances", 1));
  }

  setBackstops(particles, distances, radii) {
    const live = this.#live;
    const lengths = [toFloat32Array(distances, "distances", 1), toFloat32Array(radii, "radii", 1)];
    live.set_backstops(toUint32Array(particles, "particles"), ...lengths);
  }

  setAnchors(particles, positions, normals = []) {
    const live = this.#live;
    const vectors = [toFloat32Array(positions, "positions", 3), toFloat32Array(normals, "normals", 3)];
    live.set_anchors(toUint32Array(particles, "particles"), ...vectors);
  }

  clearLeashes() {
    this.#live.clear_leashes();
  }

  setFrame(position, rotation = IDENTITY) {
    this.#live.set_frame(packPose(position, rotation));
  }

  teleport(position, rotation = IDENTITY) {
    this.#live.teleport(packPose(position, rotation));
  }

  moveFrame(position, rotation = IDENTITY, inertia = 0) {
    this.#live.move_frame(packPose(position, rotation), toNumber(inertia, "inertia"));
  }

  // Ray casts, grabs, cuts, creases and tears

  raycast(origin, direction, maxDistance = Infinity) {
    const live = this.#live;
    return readHit(live.raycast(packRay(origin, direction), toNumber(maxDistance, "maxDistance")));
  }

  grabRay(origin, direction, options = {}) {
    const live = this.#live;
    const { radius = 0 } = checkKeys(options, "options", ["radius"]);
    const held = live.grab_ray(packRay(origin, direction), toNumber(radius, "radius"));
    return held.length === 0 ? undefined : new Grab(CONSTRUCTOR_KEY, () => this.#live, held[0], held.subarray(1));
  }

  grabParticle(particle) {
    const grab = this.#live.grab_particle(toUint32(particle, "particle"));
    const at = this.positions.subarray(3 * particle, 3 * particle + 3);
    return new Grab(CONSTRUCTOR_KEY, () => this.#live, grab, at);
  }

  cut(from, to, sweep) {
    const live = this.#live;
    const blade = [toVector(from, "from"), toVector(to, "to"), toVector(sweep, "sweep")];
    return live.cut(Float64Array.from(blade.flat()));
  }

  crease(from, to, angle) {
    const live = this.#live;
    const line = [toVector(from, "from"), toVector(to, "to")];
    live.crease(Float64Array.from(line.flat()), toNumber(angle, "angle"));
  }

  tearEdge(particleA, particleB) {
    const live = this.#live;
    return live.tear_edge(toUint32(particleA, "particleA"), toUint32(particleB, "particleB"));
  }

  // Colliders

  addCollider(collider = {}) {
    const live = this.#live;
    checkKeys(collider, "collider", COLLIDER_KEYS);
    const desc = fields.pack(fields.COLLIDER, raw.default_collider(), collider, "collider");
    const positions = toFloat32Array(collider.positions ?? [], "collider.positions", 3);
    const indices = toUint32Array(collider.indices ?? [], "collider.indices");
    const heights = toFloat32Array(collider.heights ?? [], "collider.heights", 1);
    const { rotation } = fields.unpack(fields.COLLIDER, desc);
    const handle = live.add_collider(desc, positions, indices, heights);
    return new Collider(CONSTRUCTOR_KEY, () => this.#live, handle, rotation);
  }

  // Events, statistics, saved states

  events() {
    return readEvents(this.#live.events());
  }

  get stats() {
    return readStats(this.#live.stats(), raw.stage_names());
  }

  stateHash() {
    const [low, high] = this.#live.state_hash();
    return (BigInt(high) << 32n) | BigInt(low);
  }

  save() {
    return this.#live.save();
  }
}

/** Returns origin and direction as a flat list. */
function packRay(origin, direction) {
  return Float64Array.of(...toVector(origin, "origin"), ...toVector(direction, "direction"));
}

// In engines with `using`.
if (Symbol.dispose) {
  const notEnumerable = (value) => ({ value, writable: true, configurable: true });
  Object.defineProperty(Cloth.prototype, Symbol.dispose, notEnumerable(Cloth.prototype.free));
}
