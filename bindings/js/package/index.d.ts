/// <reference lib="esnext.disposable" />

/**
 * Muslin: cloth that hangs, is grabbed, blows and tears.
 *
 * Metres, kilograms, seconds, radians; right-handed, y up by default (gravity is a setting). The same
 * calls give the same bits on every machine. A refused call throws an `Error` that names the argument
 * and the rule, and changes nothing.
 *
 * @module
 */

/** x, y, z; read from an array or a typed array of three numbers. */
export type Vec3 = readonly [number, number, number];

/** x, y, z, w: a unit quaternion. */
export type Quat = readonly [number, number, number, number];

/** Three numbers as you have them. */
export type Vec3Like = Vec3 | readonly number[] | Float32Array | Float64Array;

/** Four numbers as you have them. */
export type QuatLike = Quat | readonly number[] | Float32Array | Float64Array;

/** A compiled module. TypeScript's own type for it has no members, so that even numbers would pass. */
export type CompiledModule = WebAssembly.Module & object;

/** Where the module may come from. */
export type Source =
  | string
  | URL
  | Request
  | Response
  | ArrayBuffer
  | ArrayBufferView
  | CompiledModule;

/**
 * Loads the module: `raw_bg.wasm` beside this file, or what you give. In a page under a content
 * security policy this needs `'wasm-unsafe-eval'` in `script-src`, and nothing else.
 *
 * Loads once: further calls, also at the same time, wait for the same module. One that failed may be
 * tried again.
 *
 * @throws if the module cannot be loaded, or is not the one of this package
 */
export default function init(source?: Source | Promise<Source>): Promise<void>;

/**
 * Loads the module from bytes or a compiled module, at once. Browsers allow this on their main thread
 * for small modules only.
 *
 * @throws if it is not the module of this package, or `init()` is under way
 */
export function initSync(source: ArrayBuffer | ArrayBufferView | CompiledModule): void;

/** The version of the library, "major.minor.patch". */
export function version(): string;

/** How time runs: ticks, sweeps, gravity, damping and the switches of the solver. */
export interface Settings {
  /** Length of a tick [s]; 1/60. Above 0, at most 1. */
  tick: number;
  /** Substeps in a tick; 4. From 1 to 1000. At the same cost they stiffen more than iterations do. */
  substeps: number;
  /** Sweeps over the links in a substep; 2. From 1 to 1000. With a single one all motion is braked. */
  iterations: number;
  /** Ticks that one `advance` may run; 5. What a late frame owes beyond it is dropped. */
  maxTicksPerAdvance: number;
  /** Acceleration of everything [m/s²]; [0, -9.81, 0]. */
  gravity: Vec3Like;
  /** Rate at which velocity decays [1/s]: as exp(−damping · t), whatever the step; 0.5. At least 0. */
  damping: number;
  /** The farthest that a particle moves in a substep, in mean rest lengths; 0.5. Above 0. */
  maxDisplacement: number;
  /**
   * The most that any thread or diagonal is stretched after a tick, unless pins or grabs hold it
   * apart: 0.02 is 2 %; 0 is no bound.
   */
  maxStretch: number;
  /**
   * Long-range attachments that keep every particle within reach of the pins; true. From two
   * iterations on, whole lines of links are solved at once as well.
   */
  tethers: boolean;
  /** Layers of the cloth keep apart; false. Nothing else is supported yet. */
  selfCollision: boolean;
  /** Distance between layers [m]; 0 takes the material's thickness. */
  selfDistance: number;
  /** Over-stretched links tear, see `tearStretch` of the material; false. */
  tearing: boolean;
  /** Vertices that tearing may split in one tick, the worst first; 8. At least 1. */
  maxTearsPerTick: number;
}

/** What a cloth is made of, in SI units. */
export interface Material {
  /** Mass per area [kg/m²]; 0.18, a cotton. Above 0. */
  density: number;
  /** Gap kept from anything touched [m]; 0.00035. Keep it below half the shortest edge. */
  thickness: number;
  /** Membrane stiffness down a grid [N/m]; 0 is as stiff as the sweeps allow. */
  stretchStiffnessWarp: number;
  /** Membrane stiffness across a grid [N/m]; 0 is as stiff as the sweeps allow. */
  stretchStiffnessWeft: number;
  /** Stiffness against shear [N/m]; 0 is as the stretch stiffness. */
  shearStiffness: number;
  /** Bending rigidity per width [N·m]; 2.5e-5. 0 is limp, 1 or more as rigid as the sweeps allow. */
  bendStiffness: number;
  /** Damping of bending [s]; 0. No other value is supported yet. */
  bendDamping: number;
  /** Damping of stretching [s]; 0. No other value is supported yet. */
  stretchDamping: number;
  /** Coulomb coefficient against colliders; 0.4. At least 0. */
  friction: number;
  /** Share of the normal speed that a bounce gives back; 0. From 0 to 1. */
  restitution: number;
  /** Pressure coefficient of a triangle square to the wind; 1.2. At least 0. */
  drag: number;
  /** Lift coefficient of a triangle aslant to the wind; 0. At least 0. */
  lift: number;
  /**
   * Length over rest length at which an edge tears; 4. Above 1, or 0: never. At the end of a slit it takes
   * less, as the finer the mesh is the more of the load is there: √(16 · `thickness` / mean edge) of
   * the strain, at least a fifth of it; so a notch runs on at the same load whatever the mesh.
   */
  tearStretch: number;
  /** How uneven the weave is: 0 tears all edges alike, 1 varies the limit by half; 0.2. */
  tearVariation: number;
  /** Angle at which a fold stays [rad]; 0: never. No other value is supported yet. */
  yieldAngle: number;
  /** Share of a fold beyond `yieldAngle` that stays; 0. No other value is supported yet. */
  yieldCreep: number;
}

/** The fabrics that come with Muslin. */
export type Preset = "silk" | "cotton" | "denim" | "leather" | "paper" | "flag-nylon";

/** A preset's name, or what is to be different: from `preset`, or else from what is there. */
export type MaterialLike = Preset | (Partial<Material> & { preset?: Preset });

/** The air around a cloth. The default is still air. */
export interface Wind {
  /**
   * How the air pushes: "surface", on each triangle by the square of the relative speed; "sine-field",
   * on each particle as a field of sine waves, with the length of `velocity` as its strength [m/s²].
   */
  model: "surface" | "sine-field";
  /** Mean velocity of the air [m/s]; still. */
  velocity: Vec3Like;
  /** How much the speed swells and falls, as a share of it; 0. From 0 to 1. */
  gust: number;
  /** How far the direction strays [rad]; 0. From 0 to π. */
  wander: number;
  /** Swirls in space, as a share of the speed; 0. From 0 to 1. */
  turbulence: number;
  /** Density of the air [kg/m³]; 1.2. At least 0; 0 is a vacuum. */
  airDensity: number;
  /** Which gusts and swirls; 0. A whole number. */
  seed: number;
}

/** What grids and meshes have in common. */
export interface ClothDesc {
  /** Particles that tears may add; as many as the cloth starts with. */
  extraParticles?: number;
  /** What it is made of. */
  material?: MaterialLike;
  /** How its time runs. */
  settings?: Partial<Settings>;
}

/** A regular grid of particles; particle = row · columns + column. */
export interface GridDesc extends ClothDesc {
  /** Particles across; 40. At least 2. */
  columns?: number;
  /** Particles down; 40. At least 2. */
  rows?: number;
  /** Distance between neighbours [m]; 0.05. Above 0. */
  spacing?: number;
  /** Where particle 0, the top left, is [m]; [0, 0, 0]. */
  origin?: Vec3Like;
  /** Unit direction of a row; [1, 0, 0]. */
  right?: Vec3Like;
  /** Unit direction of a column, square to `right`; [0, -1, 0]. */
  down?: Vec3Like;
  /** What is pinned from the start; "top-edge". */
  pinMode?: "none" | "top-edge" | "top-corners" | "corners";
}

/** Any triangle mesh: every edge with one or two triangles, no two parts joined by a mere point. */
export interface MeshDesc extends ClothDesc {
  /** Where the vertices are at rest, x y z x y z … [m]; particle = vertex. */
  positions: Float32Array | Float64Array | readonly number[];
  /** Three vertices a triangle, counter-clockwise seen from its front. */
  indices: Uint32Array | Uint16Array | readonly number[];
  /** Texture coordinates, u v u v …, one pair a vertex; or none at all. */
  uvs?: Float32Array | Float64Array | readonly number[];
  /** Vertices that are pinned from the start; none. */
  pinned?: Uint32Array | Uint16Array | readonly number[];
  /** Vertices nearer to each other than this are one [m]; −1 leaves all apart. No other yet. */
  weldDistance?: number;
}

/** A collider: its shape, where it is and how it feels. */
export interface ColliderDesc {
  /** What it is; "plane": all that is below `position` along the turned y axis. */
  shape?: "plane";
  /** Where it is [m]; [0, 0, 0]. */
  position?: Vec3Like;
  /** How it is turned, a unit quaternion; [0, 0, 0, 1]. */
  rotation?: QuatLike;
  /** Coulomb coefficient; −1 takes the material's. */
  friction?: number;
  /** Share of the normal speed that a bounce gives back, 0 to 1; −1 takes the material's. */
  restitution?: number;
  /** Share of the sliding speed that every substep of touching leaves, beside friction; 1. */
  tangentialRestitution?: number;
}

/** Where a ray hits a cloth. */
export interface Hit {
  /** The triangle: indices `3 * triangle` and the two after it. */
  triangle: number;
  /** Its particle nearest to the hit. */
  particle: number;
  /** Weight of the triangle's second corner. */
  u: number;
  /** Weight of the triangle's third corner. */
  v: number;
  /** Distance from the ray's origin [m]. */
  distance: number;
  /** Where [m]. */
  position: Vec3;
  /** Unit normal of the triangle, on the side that was hit. */
  normal: Vec3;
}

/** Something that happened in a tick, counted from creation or reset, at a place [m]. */
export type ClothEvent = { tick: number; position: Vec3 } & (
  | {
      /** The edge between the two tore. */
      kind: "edge-torn";
      particleA: number;
      particleB: number;
    }
  | {
      /** `vertex` was split off from `source`. */
      kind: "vertex-split";
      vertex: number;
      source: number;
    }
  | {
      /** A piece of `count` triangles, one of them at `vertex`, came off. */
      kind: "piece-detached";
      vertex: number;
      count: number;
    }
  | {
      /** `count` particles had left the realm of numbers and were put back where they last were. */
      kind: "recovered";
      count: number;
    }
  | {
      /** Tearing stopped: the room that was reserved for it is used up. Told once. */
      kind: "reserve-used-up";
    }
  | {
      /**
       * Pins or grabs hold the cloth apart: `count` links are past `maxStretch`, one of them between
       * the two. Told once, until the bound holds again.
       */
      kind: "held-apart";
      particleA: number;
      particleB: number;
      count: number;
    }
  | {
      /** A cut made `vertex` on the edge between the two. */
      kind: "edge-divided";
      particleA: number;
      particleB: number;
      vertex: number;
    }
);

/** The stages of a tick. */
export type Stage =
  | "colliders"
  | "forces"
  | "predict"
  | "hold"
  | "tethers"
  | "stretch"
  | "shear"
  | "bend"
  | "contacts"
  | "velocities"
  | "tear"
  | "limit"
  | "guard"
  | "outputs";

/** Numbers about a cloth. */
export interface Stats {
  /** How many particles (vertices) there are. */
  particles: number;
  /** How many triangles there are. */
  triangles: number;
  /** How many links it was woven with. */
  constraints: number;
  /** How many links hold now. */
  activeConstraints: number;
  /** How many pieces hang together by edges. */
  pieces: number;
  /** Ticks since it was made or reset. */
  ticks: number;
  /** How far to blend from the last tick to this one when drawing. */
  blend: number;
  /** The greatest stretch of a stretch link: 0.01 is 1 % over its rest length. */
  maxStretch: number;
  /** The mean stretch of the stretch links. */
  meanStretch: number;
  /** Energy of motion [J]. */
  kineticEnergy: number;
  /** How many links are past `maxStretch`, if there is such a bound: pins or grabs hold them apart. */
  overStretched: number;
  /** Memory that it holds [B], about. */
  bytes: number;
  /** Time that each stage took in the last call that ran ticks [s]; zeros unless `timing` is on. */
  seconds: Record<Stage, number>;
}

/**
 * The parts of a cloth's lists that changed with its triangles: of what does not change with every tick, as
 * uvs, source vertices and frayed borders.
 */
export interface Changes {
  /** The first vertex that is new or not as it was. */
  firstVertex: number;
  /** How many vertices from there on. */
  vertexCount: number;
  /** The first index that is new or not as it was. */
  firstIndex: number;
  /** How many indices from there on. */
  indexCount: number;
}

/** A particle held by a pointer. Stale once released, or once the cloth is reset. */
export interface Grab {
  /** Where the particle was when it was taken [m]. */
  readonly position: Vec3;
  /** Gives it a new target [m]; the particle follows as fast as `maxDisplacement` allows. */
  moveTo(target: Vec3Like): void;
  /** Lets the particle go, with the velocity it has. Throws if it was released before. */
  release(): void;
}

/** A collider of a cloth. Stale once removed. */
export interface Collider {
  /** Moves it; it gets there over the next tick. Without a rotation it keeps the last one. */
  moveTo(position: Vec3Like, rotation?: QuatLike): void;
  /** Removes it. Throws if it was removed before. */
  remove(): void;
}

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
   * Makes a cloth from any triangle mesh.
   *
   * @throws if a field cannot be, or the mesh cannot be cloth; says where
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
  /** Back to the start: rest shape, untorn, at rest, pinned as it was made. No grab outlives it. */
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
   * Positions of the particles, x y z x y z … [m].
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
