/// <reference lib="esnext.disposable" />

import type { QuatLike, Vec3, Vec3Like } from "./check.js";
import type {
  GridDesc,
  MapName,
  Material,
  MaterialLike,
  MeshDesc,
  Settings,
  SewOptions,
  Wind,
} from "./fields.js";
import type { Attachment, Collider, ColliderDesc, Grab } from "./handles.js";
import type { Changes, ClothEvent, ClothMass, Hit, MeshReport, Stats } from "./reports.js";
import type { Skin, SkinDesc } from "./skin.js";
import type { Stream, WriteDesc } from "./write.js";

/**
 * A cloth: particles joined by links, made from a grid or from any triangle mesh.
 *
 * A cloth simulates particles and draws vertices. On grids and on clean meshes both have the same
 * indices; on a mesh that was welded or split, `vertexParticles` gives the particle of each vertex.
 * Positions, normals, uvs, indices and other views are per vertex; pins, grabs, tears, and
 * positions and velocities of single particles are per particle.
 *
 * Every method throws an `Error` that names the argument and the rule if an argument is wrong, and
 * leaves the cloth unchanged. Every member except `free()` and `isFreed` throws after `free()`.
 */
export class Cloth {
  private constructor();

  /**
   * Creates a cloth from a regular grid. Without `desc` it has 40 × 40 particles, 5 cm apart,
   * pinned along the top edge.
   *
   * @throws if a field is wrong, if `init()` was not awaited, or if there is not enough memory
   *
   * @example
   * ```js
   * const flag = Cloth.grid({ columns: 60, rows: 40, spacing: 0.02, material: "flag-nylon" });
   * ```
   */
  static grid(desc?: GridDesc): Cloth;

  /**
   * Creates a cloth from a triangle mesh. The mesh is repaired where necessary, see `meshReport`.
   *
   * @throws if a field is wrong, if `init()` was not awaited, if there is not enough memory, or if
   * the mesh cannot be repaired: an area is not finite, or no triangle has an area
   *
   * @example
   * ```js
   * const cape = Cloth.mesh({ positions, indices, uvs, pinned: [0, 1, 2], weldDistance: 0 });
   * ```
   */
  static mesh(desc: MeshDesc): Cloth;

  /**
   * Creates a cloth from the bytes of `save()`. It continues with the same bits as the saved one.
   *
   * @throws if the bytes are damaged or were saved by another version
   */
  static restore(buffer: Uint8Array | ArrayBuffer): Cloth;

  /**
   * Creates an independent copy of the cloth, in the same state. Both continue with the same bits
   * as long as they get the same calls. Grabs, attachments and colliders act on the copy too, but
   * their objects belong to this cloth and change only this cloth. Skins are not copied.
   *
   * @throws if there is not enough memory
   */
  duplicate(): Cloth;

  /**
   * Frees the memory of the cloth at once. Calling it again has no effect. A cloth that you do not
   * free is freed some time after its last reference is gone and the page has yielded; a loop that
   * never yields runs out of memory. The console gets one warning when 32 cloths or more hold 256
   * MiB.
   */
  free(): void;
  /** The same as `free()`, for `using cloth = Cloth.grid()`. */
  [Symbol.dispose](): void;
  /** Whether the cloth was freed. */
  readonly isFreed: boolean;

  // Time

  /**
   * Runs the ticks that `seconds` of frame time are due, and returns how many ran. Call it once per
   * frame. The remainder, less than a tick, is kept for the next call; see `blend`. If more than
   * `maxTicksPerAdvance` ticks are due, the rest is dropped.
   *
   * Poses that were given since the last tick (targets of pins and grabs, attachments, anchors,
   * colliders, the frame of `moveFrame`) are reached evenly over the ticks of this call, and
   * exactly at the end of the last one. If no tick runs, they wait for the next call.
   *
   * @param seconds time since the last frame [s]
   * @throws if `seconds` is negative or not finite
   */
  advance(seconds: number): number;
  /**
   * Advances many cloths by `seconds` of frame time, each as `advance` does and with the same bits,
   * and returns how many ticks each of them ran. One call for a crowd costs less than one per cloth:
   * a cloth that sleeps costs next to nothing.
   *
   * @throws if an element is not a live cloth or occurs twice, which names its index, or if
   * `seconds` is negative or not finite; then no cloth advances
   */
  static advanceMany(cloths: readonly Cloth[], seconds: number): Uint32Array;
  /**
   * Runs exactly `ticks` ticks; default 1. Poses that were given before the call are reached in the
   * first of them.
   */
  step(ticks?: number): void;
  /**
   * Puts the cloth back into its initial state: rest shape, untorn, at rest, with its initial pins,
   * at time 0. Grabs, attachments, anchors, mass scales, pending events and added folds are
   * removed; settings, material, wind and colliders stay.
   */
  reset(): void;
  /** Simulated time since creation or reset [s]. */
  readonly time: number;
  /**
   * The share of a tick that `advance` has not run yet, 0 to 1. Use it to interpolate between the
   * last two ticks when you draw, see `WriteDesc.blend`.
   */
  readonly blend: number;
  /** Ticks since creation or reset. */
  readonly ticks: number;
  /** Whether the cloth sleeps, see `sleepSpeed`: ticks then move nothing until something wakes it. */
  readonly asleep: boolean;
  /** Whether the stages of a tick are timed, for `stats.seconds`; costs a little. Default false. */
  timing: boolean;

  // Settings, material, wind

  /**
   * How the solver runs. Reading returns a frozen copy of all fields; assigning changes the fields
   * that are given, from the next tick on.
   *
   * @throws if a field is wrong or not known; nothing changes then
   *
   * @example
   * ```js
   * cloth.settings = { iterations: 6, gravity: [0, 0, -9.81] };
   * ```
   */
  get settings(): Readonly<Settings>;
  set settings(settings: Partial<Settings>);
  /**
   * What the cloth is made of. Reading returns a frozen copy of all fields; assigning a preset
   * replaces the material, and assigning an object changes the fields that are given, from the next
   * tick on.
   *
   * @throws if a field is wrong or not known; nothing changes then
   */
  get material(): Readonly<Material>;
  set material(material: MaterialLike);
  /**
   * The air around the cloth. Reading returns a frozen copy of all fields; assigning changes the
   * fields that are given, from the next tick on.
   *
   * @throws if a field is wrong or not known; nothing changes then
   */
  get wind(): Readonly<Wind>;
  set wind(wind: Partial<Wind>);

  // Views

  /**
   * Positions of the vertices, x y z x y z … [m].
   *
   * This and the following lists are views of the module's own memory. Read them, do not write to
   * them, and get them anew in each frame, which is cheap. A view that you keep follows the cloth
   * until the cloth tears, is cut, reset or freed, or until the memory grows because another cloth
   * is created or saved; from then on it is empty or out of date.
   */
  readonly positions: Float32Array;
  /**
   * The point that the cloth is simulated relative to [m], in whole metres.
   *
   * It is zero while most of the cloth stays within 16 m of zero along each axis. Beyond, it
   * follows the cloth, so that positions far from zero are as exact as near it. All positions that
   * you pass or read are absolute, except for `relativePositions` and what `writeVertices` writes
   * with `relative`. Only ticks and calls that place particles move the origin.
   */
  readonly origin: Vec3;
  /**
   * Positions of the vertices relative to `origin`, x y z x y z … [m]. They are exact where
   * `positions` are rounded: by up to 0.25 mm at 5 km. Computed at the first read after a change.
   */
  readonly relativePositions: Float32Array;
  /** Unit normals of the vertices, x y z x y z …. Computed at the first read after a change. */
  readonly normals: Float32Array;
  /** Texture coordinates of the vertices, u v u v …. */
  readonly uvs: Float32Array;
  /** Three vertices per triangle, counter-clockwise when seen from the front. */
  readonly indices: Uint32Array;
  /**
   * The vertex of the initial mesh that each vertex came from. A vertex that a cut made on an edge
   * has the source of the nearer end of the edge.
   */
  readonly sourceVertices: Uint32Array;
  /**
   * 1 for each vertex on a border that a tear or cut made, otherwise 0 (also on the borders of the
   * initial mesh). Use it to draw frayed edges.
   */
  readonly frayed: Uint8Array;
  /**
   * The particle of each vertex. A mesh that was welded, or whose sheets were separated, can have
   * several vertices per particle; otherwise vertex i is particle i. Triangles have the same
   * indices for vertices and particles.
   */
  readonly vertexParticles: Uint32Array;
  /** How the mesh was repaired at creation. A grid needs no repairs. */
  readonly meshReport: Readonly<MeshReport>;
  /** The largest number of vertices that the cloth can ever have, tears and cuts included. */
  readonly vertexCapacity: number;
  /** The largest number of indices that the cloth can ever have. */
  readonly indexCapacity: number;
  /** A number that changes whenever the triangles change. */
  readonly topologyRevision: number;
  /** A number that changes whenever positions change. */
  readonly stateRevision: number;

  /**
   * Returns which vertices and indices changed since `topologyRevision` had the given value: the
   * parts of index, uv and other static buffers that a renderer uploads again. Returns everything
   * if that was more than 64 changes ago, or if there was no such revision (0 never is one).
   *
   * @example
   * ```js
   * if (cloth.topologyRevision !== seen) {
   *   const { firstIndex, indexCount } = cloth.changes(seen);
   *   upload(cloth.indices.subarray(firstIndex, firstIndex + indexCount), firstIndex);
   *   seen = cloth.topologyRevision;
   * }
   * ```
   */
  changes(sinceTopologyRevision: number): Changes;

  // Writing to buffers of your own

  /**
   * Writes vertices to your own buffers, each attribute in the place and format of its stream:
   * separate, interleaved, or one block after the other. Bytes between the attributes do not
   * change. Buffers for `vertexCapacity` vertices are large enough for every tear.
   *
   * @param streams 1 to 16 streams
   * @returns the number of vertices that were written
   * @throws if a field is wrong, if the vertices do not fit, if two streams overlap, or if normals
   * or tangents are written with a transform that is not invertible; nothing is written then
   *
   * @example
   * ```js
   * const data = new Float32Array(6 * cloth.vertexCapacity);
   * cloth.writeVertices([
   *   { attribute: "position", buffer: data, stride: 24 },
   *   { attribute: "normal", buffer: data, stride: 24, offset: 12 },
   * ], { blend: cloth.blend });
   * ```
   */
  writeVertices(streams: readonly Stream[], desc?: WriteDesc): number;
  /**
   * Writes the indices of all triangles to the start of `buffer`, with 16 or 32 bits as the type of
   * `buffer` says. A buffer for `indexCapacity` indices is large enough for every tear.
   *
   * @param options.flip whether the orientation of every triangle is reversed; default false
   * @param options.baseVertex added to each index; default 0
   * @returns the number of indices that were written
   * @throws if the indices do not fit, or if an index is above 65534 with 16 bits; nothing is
   * written then
   */
  writeIndices(
    buffer: Uint16Array | Uint32Array,
    options?: { flip?: boolean; baseVertex?: number },
  ): number;

  /**
   * Binds a render mesh, usually finer than the cloth, to the cloth as it is now.
   *
   * Each vertex is bound to the nearest point of the cloth, at its distance from it, and moves along
   * with the cloth on a surface that is curved over each triangle. Make the skin while the cloth has
   * the shape that the mesh was modelled in, usually before the first tick: on a folded cloth the
   * nearest layer may be another one.
   *
   * A triangle of the skin that a tear or cut would stretch goes with one side, that of its center.
   * Its corners on the other side are copied, so the number of vertices may grow. `reset()` restores
   * the given mesh.
   *
   * @throws if a field is wrong, if a vertex is too far from the cloth, or if there is not enough
   * memory
   *
   * @example
   * ```js
   * const skin = cloth.skin({ positions, indices, uvs });
   * cloth.advance(1 / 60);
   * draw(skin.positions, skin.normals, skin.indices);
   * ```
   */
  skin(desc: SkinDesc): Skin;

  // Particles

  /** Returns the position of a particle [m]. */
  position(particle: number): Vec3;
  /** Returns the velocity of a particle [m/s]. */
  velocity(particle: number): Vec3;
  /**
   * Mass, center of mass and momentum of the whole cloth, computed when one of them is first read;
   * as a function it returns the mass of one particle [kg].
   *
   * @example
   * ```js
   * const { total, center } = cloth.mass;
   * const ofCorner = cloth.mass(0);
   * ```
   */
  readonly mass: Readonly<ClothMass> & ((particle: number) => number);
  /** Moves a particle at once [m]. It keeps its velocity, and a pin moves with it. */
  setPosition(particle: number, position: Vec3Like): void;
  /** Sets the velocity of a particle [m/s]. */
  setVelocity(particle: number, velocity: Vec3Like): void;
  /** Velocities of all particles, x y z x y z … [m/s]. The array is a copy of its own. */
  readonly velocities: Float32Array;
  /**
   * Positions of all particles in the rest shape, x y z x y z … [m]: where they were at creation,
   * whatever moved them since. A particle that a tear split off has that of its source; one that a
   * cut added has the point of the rest edge that was cut. The array is a copy of its own.
   */
  readonly restPositions: Float32Array;
  /**
   * Places the particles from `first` on at once, x y z x y z … [m]: a whole pose, if there are
   * three numbers for every particle. They keep their velocities, so set these too to continue from
   * a recorded state. Pinned particles stay pinned, at the new positions.
   *
   * @param first the first particle; default 0
   * @throws if there are more positions than particles from `first` on, or if one is not finite;
   * the message names it, such as `positions[71]`
   *
   * @example
   * ```js
   * const [pose, speeds] = [cloth.positions.slice(), cloth.velocities];
   * // later:
   * cloth.setPositions(pose);
   * cloth.setVelocities(speeds);
   * ```
   */
  setPositions(
    positions: Float32Array | Float64Array | readonly number[],
    first?: number,
  ): void;
  /**
   * Sets the velocities of the particles from `first` on, x y z x y z … [m/s].
   *
   * @param first the first particle; default 0
   * @throws as `setPositions`, for `velocities`
   */
  setVelocities(
    velocities: Float32Array | Float64Array | readonly number[],
    first?: number,
  ): void;
  /**
   * Sets factors on the masses of particles, 0.001 to 1000, one for each. 1, the initial value, is
   * the mass that follows from the density and the area around the particle; factors stay when the
   * density changes. Use 5 for a hem that hangs straight, 100 for a sewn-in coin.
   *
   * Neighbours may differ by a factor of 100. Where they differ by thousands, links stretch under
   * the heavy particles unless there are more substeps.
   *
   * @throws if there are not as many scales as particles, or if one is out of range
   */
  setMassScales(
    particles: Uint32Array | Uint16Array | readonly number[],
    scales: Float32Array | Float64Array | readonly number[],
  ): void;
  /**
   * Paints a property: multiplies what the material says by one scale per particle, 0 to 1000; 1 is
   * as the material says. `null` takes the map away.
   *
   * A link, a hinge or a triangle takes the mean of the scales at its corners; a contact interpolates
   * them at its point, and two layers take the mean of both sides. Own values of a collider are
   * scaled too. Maps stay when the material changes and when the cloth is reset. A particle that a
   * tear splits off takes the scale of its source; one that a cut adds to an edge takes the scale
   * between those of its ends.
   *
   * @throws if `map` is not a name of a map, if there is not one scale per particle, or if one is out
   * of range
   */
  setMap(
    map: MapName,
    scales: Float32Array | Float64Array | readonly number[] | null,
  ): void;
  /**
   * Returns the scales of a painted map, one per particle, in an array of its own; `null` if it is not
   * set. Particles that tears and cuts added are at the end.
   *
   * @throws if `map` is not a name of a map
   */
  map(map: MapName): Float32Array | null;

  // Pins

  /** The pinned particles, in ascending order. */
  readonly pins: Uint32Array;
  /** The same as `pins`. */
  readonly pinned: Uint32Array;
  /**
   * The targets of `pins`, in their order, x y z x y z … [m]. Those of attached particles follow
   * from the pose of their attachment.
   */
  readonly pinTargets: Float32Array;
  /**
   * Pins a particle: holds it at `target` [m], or at its current position. A new target is reached
   * evenly over the ticks of the next `advance`, or in the next tick of `step`.
   */
  pin(particle: number, target?: Vec3Like): void;
  /** Removes the pin of a particle. If it is not pinned, nothing changes. */
  unpin(particle: number): void;
  /** Removes all pins. */
  unpinAll(): void;
  /**
   * Sets the targets of many pins at once, x y z x y z … [m]. Particles that are not pinned yet
   * become so. Use it for animated pins. Targets are reached as those of `pin`.
   *
   * @throws if there are not three numbers for each particle; nothing changes then
   */
  setPinTargets(
    particles: Uint32Array | Uint16Array | readonly number[],
    targets: Float32Array | Float64Array | readonly number[],
  ): void;
  /**
   * Makes pins soft: each pulls its particle to the target as a spring of this stiffness [N/m]. 0,
   * the initial value, holds it exactly.
   *
   * Under a load of F [N] a soft pin is F / stiffness [m] away from its target. Tears, `maxStretch`
   * and tethers treat its particle as free. 1000 feels firm; 10 lets a sheet of cotton sag by a few
   * centimetres. If a tear splits the particle, the stiffness is divided in proportion to the
   * masses.
   *
   * @throws if a particle is not pinned, or if `stiffness` is negative or not finite
   */
  setPinStiffness(
    particles: Uint32Array | Uint16Array | readonly number[],
    stiffness: number,
  ): void;

  // Attachments, anchors, frame

  /**
   * Attaches particles to a transform, such as a bone, a pole or a vehicle. They are pinned where
   * they are now, and `moveTo` of the returned attachment carries them from then on.
   *
   * Particles that are pinned or attached already keep their pin stiffness. A particle leaves the
   * attachment when you unpin it or give it a target of its own. Vertices that a tear or cut makes
   * of attached particles are attached too.
   *
   * @param position position of the transform [m]
   * @param rotation its rotation, a unit quaternion; default: none
   * @throws if there are 64 attachments already
   *
   * @example
   * ```js
   * const hand = cloth.attach([0, 1, 2], bone.position.toArray(), bone.quaternion.toArray());
   * // each frame, before cloth.advance():
   * hand.moveTo(bone.position.toArray(), bone.quaternion.toArray());
   * ```
   */
  attach(
    particles: Uint32Array | Uint16Array | readonly number[],
    position: Vec3Like,
    rotation?: QuatLike,
  ): Attachment;
  /**
   * Limits how far particles may be from their anchors [m]. The limit holds after every tick,
   * whatever pulls at them. Infinity, the initial value, is no limit; 0 holds a particle at its
   * anchor. Skirts and sleeves often have 0 at the seam and up to 0.2 at the hem.
   *
   * The anchor of a particle is set by `setAnchors`; until then it is its position at the time of
   * this call. Pinned and grabbed particles have no limit. If the limits hold the cloth apart, it
   * may stretch beyond `maxStretch`, which is reported as for pins.
   *
   * @throws if there are not as many distances as particles, or if one is negative or NaN
   */
  setMaxDistances(
    particles: Uint32Array | Uint16Array | readonly number[],
    distances: Float32Array | Float64Array | readonly number[],
  ): void;
  /**
   * Sets backstops: spheres behind the anchors that particles stay out of, so that a garment does
   * not sink into the body.
   *
   * ```text
   *          ( sphere of radius )◀─ distance ─▶● anchor ──▶ normal
   * ```
   *
   * A backstop needs a normal from `setAnchors`. A radius of 0 removes it.
   *
   * @param distances from each anchor back to the surface of its sphere [m], at least 0
   * @param radii of the spheres [m], at least 0
   * @throws if the lists differ in length, or if a number is negative or not finite
   */
  setBackstops(
    particles: Uint32Array | Uint16Array | readonly number[],
    distances: Float32Array | Float64Array | readonly number[],
    radii: Float32Array | Float64Array | readonly number[],
  ): void;
  /**
   * Sets the anchors of particles: the positions x y z x y z … [m] and outward normals that
   * animation gives them, for `setMaxDistances` and `setBackstops`. Call it each frame.
   *
   * Anchors reach the new positions evenly over the ticks of the next `advance`, or in the next
   * tick of `step`; new anchors are there at once.
   *
   * @param normals of any length but 0; without this argument the previous normals stay
   * @throws if the lists differ in length, or if a number is not finite
   */
  setAnchors(
    particles: Uint32Array | Uint16Array | readonly number[],
    positions: Float32Array | Float64Array | readonly number[],
    normals?: Float32Array | Float64Array | readonly number[],
  ): void;
  /** Removes all anchors, maximum distances and backstops. */
  clearLeashes(): void;
  /**
   * Sets the frame of the body that wears the cloth, and moves nothing. `teleport` and `moveFrame`
   * measure the motion of the body from here. At first, and after a reset, the frame is at the
   * origin.
   *
   * @param position of the body [m]
   * @param rotation unit quaternion; default: none
   */
  setFrame(position: Vec3Like, rotation?: QuatLike): void;
  /**
   * Moves the cloth at once along with its body, from the last frame to this one, as a rigid body
   * and without inertia. Velocities are rotated. Pins, attachments, grabs and anchors move along;
   * colliders do not, see `Collider.teleport`. Call it before `moveTo` and `setAnchors` of the same
   * frame.
   */
  teleport(position: Vec3Like, rotation?: QuatLike): void;
  /**
   * Moves the frame of the body from the last frame to this one, over the ticks of the next
   * `advance` or in the next tick of `step`, and chooses how much of that motion the cloth feels.
   * Use it to tame the cloth of a fast character.
   *
   * With an `inertia` of 1 the cloth feels all of the motion, as if you had not called this. With 0
   * it feels none, as if the body stood still and the world moved past. Numbers between apply that
   * share of the translation and rotation.
   *
   * The share that is not felt moves the particles at once, as a rigid body. Pins, attachments and
   * anchors reach their places on the body evenly over these ticks. Colliders and grabs stay where
   * you put them, and the cloth meets them with their velocity relative to the body. The air moves
   * along with the share that is not felt. Call it before `moveTo` and `setAnchors` of the same
   * frame.
   *
   * @param inertia 0 to 1; default 0
   * @throws if `inertia` is out of range
   */
  moveFrame(position: Vec3Like, rotation?: QuatLike, inertia?: number): void;

  // Ray casts and grabs

  /**
   * Returns the first hit of a ray with the cloth, from either side, or undefined.
   *
   * @param direction of any length but 0
   * @param maxDistance [m]; default Infinity
   */
  raycast(origin: Vec3Like, direction: Vec3Like, maxDistance?: number): Hit | undefined;
  /**
   * Grabs the particle that a ray points at: the nearest corner of the triangle that it hits; if it
   * hits none, the particle nearest to the ray within `radius`. Returns undefined if there is none.
   *
   * @param options.radius [m]; default 0
   * @throws if 64 grabs are held already
   *
   * @example
   * ```js
   * const grab = cloth.grabRay(origin, direction, { radius: 0.05 });
   * grab?.moveTo([0, 1, 0.5]);
   * cloth.advance(1 / 60);
   * grab?.release();
   * ```
   */
  grabRay(origin: Vec3Like, direction: Vec3Like, options?: { radius?: number }): Grab | undefined;
  /**
   * Grabs a particle at its current position.
   *
   * @throws if 64 grabs are held already
   */
  grabParticle(particle: number): Grab;

  // Cuts, creases, tears

  /**
   * Cuts the cloth with a blade: the segment from `from` to `to` [m], swept along `sweep` [m].
   * Returns how many edges opened; with 0 the cloth is unchanged.
   *
   * ```text
   * from ●────────● to
   *      │ blade  │  sweep
   *      ▼        ▼
   * ```
   *
   * The triangles that the blade crosses are divided along it: each crossed edge gets a new vertex,
   * whose position and attributes are interpolated, and the mesh opens along the cut. The cut
   * passes through an existing vertex instead of a new one where a new one would be nearer than an
   * eighth of the edge to it, or would leave an angle below 5° or a triangle with less than 1/200
   * of the area of a square over the mean edge. Next to a pinned vertex it passes at an eighth of
   * the edge. Where the blade ends inside a triangle, the cut ends at the edge before.
   *
   * Vertices that a cut makes are free. A pinned vertex that it passes through is pinned on both
   * sides. Each crossed edge takes one particle of the reserve (`extraParticles`), and one more
   * where it opens.
   *
   * @throws if `from` equals `to`, if `sweep` is parallel to the line through both, or if the
   * reserve is too small for the whole cut
   *
   * @example
   * ```js
   * cloth.cut([-1, -0.5, -1], [3, -0.7, -1], [0, 0, 2]); // across a sheet in the xy plane
   * ```
   */
  cut(from: Vec3Like, to: Vec3Like, sweep: Vec3Like): number;
  /**
   * Adds a permanent fold of `angle` [rad] along a line. `from` and `to` [m] are positions in the
   * rest shape. The cloth then rests folded by that angle: towards its front (where triangles are
   * counter-clockwise) if `angle` is positive, otherwise away from it.
   *
   * The line need not follow the edges of the mesh: the fold is distributed over the cells next to
   * it. How strongly the cloth folds depends on `bendStiffness`. The fold stays until `reset`;
   * folding by −`angle` along the same line removes it, though not the hardening and weakening that
   * it caused. Parts of the line that are not on the cloth have no effect.
   *
   * @throws if `to` equals `from`, or if `angle` is not from −3 to 3
   */
  crease(from: Vec3Like, to: Vec3Like, angle: number): void;
  /**
   * Sews pairs of particles together: draws each pair together and joins it when its distance is
   * zero. Joined particles have one position and one velocity after every tick, and move as one
   * particle with the mass of both.
   *
   * Particles may be in several pairs, and pairs do not collide with each other. A held particle
   * draws the other one to it; two held ones stay where they are, which `overStretched` of the
   * stats and the event `"held-apart"` report. A torn stitch gives the event `"stitch-torn"`.
   * `reset` keeps the pairs and draws them together again from the rest shape.
   *
   * @param pairs particles a b a b …, or a list of pairs `[a, b]`
   * @throws if the particles of a pair are equal, do not exist or have no triangle, or if an option
   * is out of range
   */
  sew(
    pairs: Uint32Array | Uint16Array | readonly number[] | readonly (readonly [number, number])[],
    options?: SewOptions,
  ): void;
  /**
   * Tears the edge between two neighbouring particles, as too much stretch would, and returns
   * whether it tore. It does not if it is a border already, or if neither end can split: pinned and
   * grabbed particles do not split.
   *
   * @throws if the particles are not joined by an edge, or if the reserve (`extraParticles`) is
   * used up
   */
  tearEdge(particleA: number, particleB: number): boolean;

  // Colliders

  /**
   * Adds a collider; without `collider` it is the plane y = 0.
   *
   * @throws if a field is wrong, or if there are 1024 colliders already
   *
   * @example
   * ```js
   * const ball = cloth.addCollider({ shape: "sphere", position: [0, 1, 0], radius: 0.3 });
   * ball.moveTo([0.1, 1, 0]); // sweeps there during the next advance()
   * ```
   */
  addCollider(collider?: ColliderDesc): Collider;
  /**
   * Makes the surface of another cloth a collider of this one, and updates it from then on: clothes in
   * layers, the inner one first. Call it in each frame between the `advance` of the inner cloth,
   * `other`, and that of the outer one. It returns the same collider each time.
   *
   * The collider is at the present positions of `other` at first. After each later call it reaches them
   * evenly over the ticks of the next `advance`, or in the next tick of `step`, and is swept on its way.
   * It has two sides: this cloth stays on the side where it is. It keeps the mean of both thicknesses
   * away, half of each, and has the mean of both coefficients of friction, as in the call; maps of
   * `other` do not count. Where `other` has torn or been cut since, the collider takes its new
   * triangles, which takes as long as adding it.
   *
   * The effect is one-way: `other` does not feel this cloth. Several pieces in one mesh, with
   * `selfCollision: true`, bear on each other, and nothing passes through; a layer gives no such
   * guarantee where both cloths crumple or are squeezed.
   *
   * The motion since the last call is swept. After a `reset` or `teleport` of both cloths, `remove()`
   * the collider: the next call adds another one. A save contains the collider, but a restored cloth
   * does not know whose it is, so remove it before you save and call this again after both.
   *
   * @throws if `other` is this cloth or was freed, if none of its triangles has an area or a particle is
   * 1e6 m or more from its origin, or if there are 1024 colliders already
   *
   * @example
   * ```js
   * shirt.advance(seconds);
   * coat.collideWith(shirt);
   * coat.advance(seconds);
   * ```
   */
  collideWith(other: Cloth): Collider;

  // Events, statistics, saved states

  /**
   * Returns the events since the last call, oldest first, and removes them. At most 1024 are kept;
   * the oldest ones are dropped first.
   *
   * The order within a tick is: recovered particles; tears, those with the largest stretch first,
   * each as the vertices that it split and then the edge; a used-up reserve; detached pieces, in
   * the order of their first triangles; links that are held apart. A cut adds the edges that it
   * divided, in the order along the cut; the edges that opened; the split vertices; the detached
   * pieces.
   */
  events(): ClothEvent[];
  /** Statistics of the current state. */
  readonly stats: Stats;
  /**
   * Returns a hash of everything that the next tick depends on. Equal states have equal hashes on
   * every platform, also in Rust and C.
   */
  stateHash(): bigint;
  /** Returns the whole state as bytes for `Cloth.restore`. The array is a copy of its own. */
  save(): Uint8Array;
}
