// A cloth: what it is asked, checked; what it answers, named.

import * as raw from "./raw.js";
import { check, bytes, flag, floats, keys, number, vector, whole, wholes } from "./check.js";
import { isTrap, ready } from "./memory.js";
import * as fields from "./fields.js";
import { Attachment, Collider, Grab, OURS, onlyOurs } from "./handles.js";
import { readChanges, readEvents, readHit, readMeshReport, readStats } from "./reports.js";
import { writeIndices, writeVertices } from "./write.js";

const GRID_KEYS = [...Object.keys(fields.GRID), "material", "settings"];
const MESH_LISTS = ["positions", "indices", "uvs", "pinned"];
const COLLIDER_KEYS = [...Object.keys(fields.COLLIDER), "positions", "indices", "heights"];
const MESH_KEYS = [...MESH_LISTS, ...Object.keys(fields.MESH), "material", "settings"];

/** The material and the settings of a descriptor, as lists. */
function clothing({ material = {}, settings = {} }) {
  return [
    fields.mergeMaterial(raw.default_material(), material, raw.preset_material),
    fields.merge(fields.SETTINGS, raw.default_settings(), settings, "settings"),
  ];
}

/** Makes a cloth, or says that there is no room for it. */
function make(build) {
  try {
    return new Cloth(OURS, build());
  } catch (error) {
    if (!isTrap(error)) throw error;
    throw new Error("no memory is left for such a cloth", { cause: error });
  }
}

export class Cloth {
  #raw;
  #views = {};

  constructor(key, raw) {
    onlyOurs(key, "a cloth is made by Cloth.grid(), Cloth.mesh() or Cloth.restore()");
    this.#raw = raw;
  }

  static grid(desc = {}) {
    ready();
    keys(desc, "desc", GRID_KEYS);
    const grid = fields.pack(fields.GRID, raw.default_grid(), desc);
    const [material, settings] = clothing(desc);
    return make(() => raw.RawCloth.grid(grid, material, settings));
  }

  static mesh(desc) {
    ready();
    keys(desc, "desc", MESH_KEYS);
    const positions = floats(desc.positions, "positions", 3);
    const indices = wholes(desc.indices, "indices");
    const uvs = floats(desc.uvs ?? [], "uvs", 2);
    const pinned = wholes(desc.pinned ?? [], "pinned");
    const mesh = fields.pack(fields.MESH, raw.default_mesh(), desc);
    const [material, settings] = clothing(desc);
    return make(() => raw.RawCloth.mesh(positions, indices, uvs, pinned, mesh, material, settings));
  }

  static restore(buffer) {
    ready();
    const saved = bytes(buffer, "buffer");
    return make(() => raw.RawCloth.restore(saved));
  }

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
    return this.#live.advance(number(seconds, "seconds"));
  }

  step(ticks = 1) {
    this.#live.step(whole(ticks, "ticks"));
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
    this.#live.set_timed(flag(timing, "timing"));
  }

  // How it behaves

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
    const since = whole(sinceTopologyRevision, "sinceTopologyRevision");
    return readChanges(this.#live.changes(since));
  }

  // Buffers of one's own

  writeVertices(streams, desc = {}) {
    return writeVertices(this.#live, streams, desc);
  }

  writeIndices(buffer, options = {}) {
    return writeIndices(this.#live, buffer, options);
  }

  /** The view of last time if it still fits: the same memory, place and length. */
  #view(name, Kind, at, length) {
    const { buffer } = ready(); // asked last: whoever gave `at` may have made the memory grow
    const last = this.#views[name];
    const fits = last?.buffer === buffer && last.byteOffset === at && last.length === length;
    return fits ? last : (this.#views[name] = new Kind(buffer, at, length));
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
    return Array.from(this.#live.position(whole(particle, "particle")));
  }

  velocity(particle) {
    return Array.from(this.#live.velocity(whole(particle, "particle")));
  }

  mass(particle) {
    return this.#live.mass(whole(particle, "particle"));
  }

  setPosition(particle, position) {
    this.#live.set_position(whole(particle, "particle"), ...vector(position, "position"));
  }

  setVelocity(particle, velocity) {
    this.#live.set_velocity(whole(particle, "particle"), ...vector(velocity, "velocity"));
  }

  // Pins

  get pinned() {
    return this.#live.pinned();
  }

  pin(particle, target) {
    const live = this.#live;
    whole(particle, "particle");
    if (target === undefined) live.pin_here(particle);
    else live.pin_at(particle, ...vector(target, "target"));
  }

  unpin(particle) {
    this.#live.unpin(whole(particle, "particle"));
  }

  unpinAll() {
    this.#live.unpin_all();
  }

  setPinTargets(particles, targets) {
    const live = this.#live;
    live.set_pin_targets(wholes(particles, "particles"), floats(targets, "targets", 3));
  }

  setPinStiffness(particles, stiffness) {
    const live = this.#live;
    live.set_pin_stiffness(wholes(particles, "particles"), number(stiffness, "stiffness"));
  }

  setMassScales(particles, scales) {
    this.#live.set_mass_scales(wholes(particles, "particles"), floats(scales, "scales", 1));
  }

  // On a body

  attach(particles, position, rotation = [0, 0, 0, 1]) {
    const live = this.#live;
    const handle = live.attach(wholes(particles, "particles"), pose(position, rotation));
    return new Attachment(OURS, () => this.#live, handle, Array.from(rotation));
  }

  setMaxDistances(particles, distances) {
    const live = this.#live;
    live.set_max_distances(wholes(particles, "particles"), floats(distances, "distances", 1));
  }

  setBackstops(particles, distances, radii) {
    const live = this.#live;
    const lengths = [floats(distances, "distances", 1), floats(radii, "radii", 1)];
    live.set_backstops(wholes(particles, "particles"), ...lengths);
  }

  setAnchors(particles, positions, normals = []) {
    const live = this.#live;
    const vectors = [floats(positions, "positions", 3), floats(normals, "normals", 3)];
    live.set_anchors(wholes(particles, "particles"), ...vectors);
  }

  clearLeashes() {
    this.#live.clear_leashes();
  }

  setFrame(position, rotation = [0, 0, 0, 1]) {
    this.#live.set_frame(pose(position, rotation));
  }

  teleport(position, rotation = [0, 0, 0, 1]) {
    this.#live.teleport(pose(position, rotation));
  }

  moveFrame(position, rotation = [0, 0, 0, 1], inertia = 0) {
    this.#live.move_frame(pose(position, rotation), number(inertia, "inertia"));
  }

  // Pointing, grabbing, cutting and tearing

  raycast(origin, direction, maxDistance = Infinity) {
    const live = this.#live;
    return readHit(live.raycast(ray(origin, direction), number(maxDistance, "maxDistance")));
  }

  grabRay(origin, direction, options = {}) {
    const live = this.#live;
    const { radius = 0 } = keys(options, "options", ["radius"]);
    const held = live.grab_ray(ray(origin, direction), number(radius, "radius"));
    return held.length === 0 ? undefined : new Grab(OURS, () => this.#live, held[0], held.subarray(1));
  }

  grabParticle(particle) {
    const grab = this.#live.grab_particle(whole(particle, "particle"));
    const at = this.positions.subarray(3 * particle, 3 * particle + 3);
    return new Grab(OURS, () => this.#live, grab, at);
  }

  cut(from, to, sweep) {
    const live = this.#live;
    const blade = [vector(from, "from"), vector(to, "to"), vector(sweep, "sweep")];
    return live.cut(Float64Array.from(blade.flat()));
  }

  crease(from, to, angle) {
    const live = this.#live;
    const line = [vector(from, "from"), vector(to, "to")];
    live.crease(Float64Array.from(line.flat()), number(angle, "angle"));
  }

  tearEdge(particleA, particleB) {
    const live = this.#live;
    return live.tear_edge(whole(particleA, "particleA"), whole(particleB, "particleB"));
  }

  // Colliders

  addCollider(collider = {}) {
    const live = this.#live;
    keys(collider, "collider", COLLIDER_KEYS);
    const desc = fields.pack(fields.COLLIDER, raw.default_collider(), collider, "collider");
    const positions = floats(collider.positions ?? [], "collider.positions", 3);
    const indices = wholes(collider.indices ?? [], "collider.indices");
    const heights = floats(collider.heights ?? [], "collider.heights", 1);
    const { rotation } = fields.unpack(fields.COLLIDER, desc);
    const handle = live.add_collider(desc, positions, indices, heights);
    return new Collider(OURS, () => this.#live, handle, rotation);
  }

  // What happened, and how it stands

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

function pose(position, rotation) {
  const turned = vector(rotation, "rotation", "x, y, z, w");
  return Float64Array.of(...vector(position, "position"), ...turned);
}

function ray(origin, direction) {
  return Float64Array.of(...vector(origin, "origin"), ...vector(direction, "direction"));
}

// Where the engine knows `using`.
if (Symbol.dispose) {
  const hidden = (value) => ({ value, writable: true, configurable: true });
  Object.defineProperty(Cloth.prototype, Symbol.dispose, hidden(Cloth.prototype.free));
}
