/// <reference lib="esnext.disposable" />

import type { QuatLike, Vec3, Vec3Like } from "./check.js";
import type { ColliderDesc, GridDesc, Material, MaterialLike, MeshDesc, Settings, Wind } from "./fields.js";
import type { Attachment, Collider, Grab } from "./handles.js";
import type { Changes, ClothEvent, Hit, MeshReport, Stats } from "./reports.js";
import type { Stream, WriteDesc } from "./write.js";

/** A piece of cloth. */
export class Cloth {
  private constructor();

  /**
   * Makes a cloth from a regular grid: by default 40 × 40 particles, 5 cm apart, pinned along its top.
   *
   * @throws if a field cannot be, or `init()` was not awaited
   */
  static grid(desc?: GridDesc): Cloth;

  /**
   * Makes a cloth from any triangle mesh. What cannot be cloth in it is repaired, see `meshReport`.
   *
   * @throws if a field cannot be, or the mesh is beyond repair: an area is not finite, or no triangle has any
   */
  static mesh(desc: MeshDesc): Cloth;

  /**
   * The cloth that `save()` was asked of; it goes on in the same bits.
   *
   * @throws if the bytes are not a saved cloth of this version, or were damaged
   */
  static restore(buffer: Uint8Array | ArrayBuffer): Cloth;

  /** Gives the memory back. Any later use throws, but for another `free()`. */
  free(): void;
  /** The same, for `using`. */
  [Symbol.dispose](): void;
  /** Whether it was freed. */
  readonly isFreed: boolean;

  /**
   * Runs the ticks that a frame of `seconds` [s] owes, and says how many ran. What is left over waits
   * for the next frame, see `blend`; a late frame owes at most `maxTicksPerAdvance`.
   *
   * @throws if `seconds` is negative or not finite
   */
  advance(seconds: number): number;
  /** Runs exactly `ticks` ticks; 1. */
  step(ticks?: number): void;
  /**
   * Back to the start: rest shape, untorn, at rest, pinned as it was made. No grab, attachment, leash or mass
   * scale outlives it.
   */
  reset(): void;
  /** Time since it was made or reset [s]. */
  readonly time: number;
  /** The share of a tick that `advance` still owes, 0 to 1. */
  readonly blend: number;
  /** Whether the stages of a tick are timed, for `stats.seconds`; false. Costs a little. */
  timing: boolean;

  /** How time runs. Reading gives all, frozen; what is set is merged, from the next tick on. */
  get settings(): Readonly<Settings>;
  set settings(settings: Partial<Settings>);
  /** What it is made of. Reading gives all, frozen; what is set is merged, from the next tick on. */
  get material(): Readonly<Material>;
  set material(material: MaterialLike);
  /** The air around it. Reading gives all, frozen; what is set is merged, from the next tick on. */
  get wind(): Readonly<Wind>;
  set wind(wind: Partial<Wind>);

  /**
   * Positions of the vertices, x y z x y z … [m].
   *
   * This and the other lists are views of the module's own memory: read them, and do not write to them.
   * Ask anew each frame, which is cheap: what you are given is live. One that you keep follows the cloth
   * in place until the cloth tears, is cut, reset or freed, or the memory grows because another cloth is
   * made or saved; then it is of length 0 or out of date.
   */
  readonly positions: Float32Array;
  /** Unit normals of the vertices, computed when first asked for after a change. */
  readonly normals: Float32Array;
  /** Texture coordinates of the vertices, u v u v …. */
  readonly uvs: Float32Array;
  /** Three vertices a triangle, counter-clockwise. */
  readonly indices: Uint32Array;
  /** Which original vertex each vertex came from; for one that a cut made on an edge, the nearer end's. */
  readonly sourceVertices: Uint32Array;
  /**
   * 1 for a vertex at a border that a tear or a cut made, which a renderer may fringe; 0 for others, those
   * at the borders that the cloth was made with among them.
   */
  readonly frayed: Uint8Array;
  /**
   * The particle of each vertex. A mesh that was welded or had sheets to be parted has several vertices to a
   * particle; else each vertex is the particle of its number. Positions, normals, uvs, source vertices, frayed
   * borders and indices are those of vertices. Calls that touch the cloth (pins, grabs, tears by hand, positions and
   * velocities) take particles, and what a ray hits tells one. Triangles have the same numbers in both.
   */
  readonly vertexParticles: Uint32Array;
  /** What had to be repaired of the mesh that it was made of; nothing of a grid. */
  readonly meshReport: Readonly<MeshReport>;
  /** How many vertices there may ever be. */
  readonly vertexCapacity: number;
  /** How many indices there may ever be. */
  readonly indexCapacity: number;
  /** Changes when the triangles do. */
  readonly topologyRevision: number;
  /** Changes when positions do. */
  readonly stateRevision: number;

  /**
   * Which vertices and indices are new or not as they were when `topologyRevision` was that: all that a
   * renderer must upload again of what does not change with every tick. Everything, if that is more
   * than 64 changes ago, or was never (0 is never).
   */
  changes(sinceTopologyRevision: number): Changes;

  /**
   * Writes vertices into buffers of your own, each attribute where and how its stream says: separate,
   * interleaved or one behind the other, 1 to 16 at once. Nothing else in the buffers changes. Says how many
   * vertices that were. With room for `vertexCapacity` vertices they fit for ever.
   *
   * @throws if a field cannot be, the vertices do not fit, two streams write the same bytes, or normals or
   * tangents are asked for with a transform that cannot be inverted; nothing is written then
   */
  writeVertices(streams: readonly Stream[], desc?: WriteDesc): number;
  /**
   * Writes the indices of all triangles to the beginning of `buffer`, 16 bits wide or 32 as that is; each
   * with `baseVertex` added, 0, and every triangle turned round if `flip` is set. Says how many. With room
   * for `indexCapacity` indices they fit for ever.
   *
   * @throws unless the indices fit, and for 16 bits if one is above 65534; nothing is written then
   */
  writeIndices(
    buffer: Uint16Array | Uint32Array,
    options?: { flip?: boolean; baseVertex?: number },
  ): number;

  /** Where a particle is [m]. */
  position(particle: number): Vec3;
  /** Velocity of a particle [m/s]. */
  velocity(particle: number): Vec3;
  /** Mass of a particle [kg]. */
  mass(particle: number): number;
  /** Puts a particle somewhere [m], at once; it keeps its velocity. A pin goes with it. */
  setPosition(particle: number, position: Vec3Like): void;
  /** Gives a particle a velocity [m/s]. */
  setVelocity(particle: number, velocity: Vec3Like): void;

  /** The pinned particles, lowest first. */
  readonly pinned: Uint32Array;
  /** Holds a particle at `target` [m], or where it is. The target is reached over the next tick. */
  pin(particle: number, target?: Vec3Like): void;
  /** Lets a particle go. One that is not pinned stays as it is. */
  unpin(particle: number): void;
  /** Lets every particle go. */
  unpinAll(): void;
  /** Gives many pins their targets, x y z x y z … [m]; particles that are not pinned yet become so. */
  setPinTargets(
    particles: Uint32Array | Uint16Array | readonly number[],
    targets: Float32Array | Float64Array | readonly number[],
  ): void;

  /**
   * Says how hard pins pull towards their targets [N/m]: as springs, or exactly if `stiffness` is 0, as they do
   * at first. A soft pin holds a load of 1 N 1/`stiffness` from its target; the cloth counts as free there, for
   * tears and for `maxStretch`, and is not tethered to it. 1e3 feels firm, 10 lets a sheet of cotton sag by a
   * few centimetres. A tear through a soft pin shares its stiffness out by mass.
   *
   * @throws if one is not pinned, or unless `stiffness` is at least 0 and finite
   */
  setPinStiffness(particles: Uint32Array | Uint16Array | readonly number[], stiffness: number): void;
  /**
   * Makes particles heavier or lighter than their material, by a factor each, from 0.001 to 1000: 1, as at
   * first, is what its density and the area about them give. A hem of 5 hangs straight; a coin sewn in may be
   * 100. Factors stay when the density changes. Neighbours may well be a hundredfold apart; where it is
   * thousands, what hangs by the light ones stretches them until there are more substeps.
   */
  setMassScales(
    particles: Uint32Array | Uint16Array | readonly number[],
    scales: Float32Array | Float64Array | readonly number[],
  ): void;

  /**
   * Attaches particles to a transform: a bone, a pole, the body of a car. They are pinned where they are now, and
   * from then on `moveTo` of what this gives carries them. Those that are pinned already, or attached to
   * something else, keep their stiffness. One that gets a target of its own later, or is unpinned, leaves the
   * attachment. Vertices that a tear or a cut makes of attached ones are attached too.
   *
   * @throws if there are 64 attachments already
   */
  attach(
    particles: Uint32Array | Uint16Array | readonly number[],
    position: Vec3Like,
    rotation?: QuatLike,
  ): Attachment;
  /**
   * Says how far particles may be from their anchors [m]: after every tick none is farther, whatever pulls at it.
   * Infinity, as at first, is as far as they like; 0 holds them there. The anchor of a particle is where
   * `setAnchors` has it, and until that was called where the particle is now. A pinned or grabbed particle goes by
   * that alone. What keeps a cloth apart so may stretch it past `maxStretch`, which is told as if pins did.
   */
  setMaxDistances(
    particles: Uint32Array | Uint16Array | readonly number[],
    distances: Float32Array | Float64Array | readonly number[],
  ): void;
  /**
   * Gives particles backstops: spheres behind their anchors that they stay out of, so that a garment does not sink
   * into the body that wears it. Each has a radius [m], 0 for none, and begins a distance [m] behind its anchor,
   * against the normal that `setAnchors` gave: without one there is no backstop.
   */
  setBackstops(
    particles: Uint32Array | Uint16Array | readonly number[],
    distances: Float32Array | Float64Array | readonly number[],
    radii: Float32Array | Float64Array | readonly number[],
  ): void;
  /**
   * Says where animation has particles, x y z x y z … [m], and which way is out of the body there, for
   * `setMaxDistances` and `setBackstops`. Call it each frame: anchors get there over the next tick, and those of
   * particles that had none are there at once. Normals need not be of length 1; without any those of before stay.
   */
  setAnchors(
    particles: Uint32Array | Uint16Array | readonly number[],
    positions: Float32Array | Float64Array | readonly number[],
    normals?: Float32Array | Float64Array | readonly number[],
  ): void;
  /** Takes away all anchors, maximum distances and backstops. */
  clearLeashes(): void;
  /**
   * Says where the body is that wears the cloth, and how it is turned: `teleport` and `moveFrame` go from there.
   * At first, and after a reset, that is the origin. It moves nothing.
   */
  setFrame(position: Vec3Like, rotation?: QuatLike): void;
  /**
   * Takes the cloth along as the body that wears it jumps from where `setFrame`, `moveFrame` or the last
   * `teleport` had it: at once, as a solid body, and without feeling it. Velocities turn with it. Pins, attachments, grabs and anchors
   * go along; colliders do not, see their own `teleport`. In a frame it comes before `moveTo` and `setAnchors`.
   */
  teleport(position: Vec3Like, rotation?: QuatLike): void;
  /**
   * Takes the cloth along as the body that wears it runs and turns on from where `setFrame`, `teleport` or the last
   * `moveFrame` had it: over the next tick, and with only a share of its `inertia`, 0. At 1 it feels all of the
   * body's motion, as if nothing were said; at 0 none, as if the body stood still and the rest of the world moved
   * past; between, so much of it, both of the way and of the turn.
   *
   * What is not felt takes particles along at once, as a solid body; over the tick they, pins, attachments and
   * anchors get to where the body has them then. Colliders and grabs stay where they are told to be, and the cloth
   * meets them as one who goes with the body sees them move. Air goes along as far as the motion is not felt. In a
   * frame it comes before `moveTo` and `setAnchors`.
   *
   * @throws if `inertia` is not from 0 to 1
   */
  moveFrame(position: Vec3Like, rotation?: QuatLike, inertia?: number): void;

  /** The first triangle along a ray, within `maxDistance` [m], Infinity; hit from either side. */
  raycast(origin: Vec3Like, direction: Vec3Like, maxDistance?: number): Hit | undefined;
  /**
   * Takes hold of the particle that a ray points at: the nearest one of the triangle that it hits, or
   * else the nearest one within `radius` [m], 0, of it.
   *
   * @throws if 64 grabs are held already
   */
  grabRay(origin: Vec3Like, direction: Vec3Like, options?: { radius?: number }): Grab | undefined;
  /** Takes hold of a particle where it is. Throws if 64 grabs are held already. */
  grabParticle(particle: number): Grab;
  /**
   * Cuts the cloth with a blade: the segment from `from` to `to` [m], swept along `sweep` [m]. Says how
   * many edges opened; 0 leaves the cloth as it was.
   *
   * Triangles that the blade goes through are divided along it: vertices come to be on the edges that it
   * crosses, between their ends in all that they have, and the mesh opens along them. Where it would
   * come nearer to a vertex than an eighth of an edge, or leave a triangle with an angle below 5° or less
   * area than one in 200 of a square of the mean edge, the cut goes through the nearer vertex instead;
   * past a pinned one it goes at an eighth of the edge. Where the blade ends inside a triangle, the cut
   * ends at the edge before. Vertices that a cut makes are free; a pinned one that it goes through is
   * pinned on both sides. Each edge that is crossed takes one particle of the reserve
   * (`extraParticles`), and one more where it opens.
   *
   * @throws unless `to` is apart from `from` and `sweep` leads away from the line through both, or if the
   * reserve cannot take the whole cut
   */
  cut(from: Vec3Like, to: Vec3Like, sweep: Vec3Like): number;
  /**
   * Gives the cloth a fold of `angle` [rad] along a line, from `from` to `to` [m], both where they are in the
   * cloth as it was made. From then on the cloth rests folded by so much more along it: towards its front,
   * where the triangles are counter-clockwise, if `angle` is above 0, and else away from it.
   *
   * The line need not follow the mesh: the fold is shared out over the cells beside it. It bends no more than
   * `bendStiffness` can make it, and stays until `reset`; folding by −`angle` along the same line takes it
   * away. Where the line is not on the cloth nothing is folded.
   *
   * @throws if `to` equals `from`, or unless `angle` is from −3 to 3
   */
  crease(from: Vec3Like, to: Vec3Like, angle: number): void;
  /**
   * Tears between two neighbouring particles, as over-stretching would. Says whether it tore: an end
   * that is pinned or grabbed does not give way, nor does an edge that is a border already.
   *
   * @throws unless the two are the ends of an edge, or if the room for tears is used up
   */
  tearEdge(particleA: number, particleB: number): boolean;

  /** Adds a collider. Throws if there are 1024 already. */
  addCollider(collider?: ColliderDesc): Collider;

  /**
   * All events since the last call, oldest first; the 1024 newest are kept.
   *
   * They come by tick; in a tick recoveries first, then tears, the worst first, and of each the vertices
   * that it split before the torn edge; then, if there was no room for another, that; then the pieces that
   * came off, in the order of their first triangles; then what is held apart. A cut tells the edges that
   * it divided, in its order; those that it opened; the vertices that it split; and the pieces.
   */
  events(): ClothEvent[];
  /** Numbers about the cloth as it is now. */
  readonly stats: Stats;
  /** All that the next tick depends on as one number, equal to the native one. */
  stateHash(): bigint;
  /** The cloth as bytes, for `Cloth.restore`. A copy of your own. */
  save(): Uint8Array;
}
