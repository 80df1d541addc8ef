// What is told to a cloth: how it runs, what it is made of, what is around it.

import type { QuatLike, Vec3Like } from "./check.js";

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
  /**
   * Whether and how parts of the cloth keep apart; false. "particles": particles keep from particles, as if
   * they were balls: cheap, without friction, and a fold may slip through where particles are farther apart
   * than `selfDistance`. Those that are woven into one piece nearer than that, or than one and a half mean
   * rest lengths, do not count; what is held neither. true: surface from surface, a material's thickness apart, so
   * that nothing crosses, with the material's friction. A thickness counts up to half of the mean rest length.
   * What is nearer than two thicknesses in the weave keeps half of that distance. The two sides of a slit
   * part by a thousandth of the mean rest length as it opens, so that they keep from each other too. What pins or
   * grabs hold takes along what is in its way, and what is caught between two such may be forced through. What
   * crosses all the same, from the start, as this is switched on or where particles are placed, is drawn out again
   * unless it is held: the smaller part goes back to the side of the rest, mostly within a second. It costs about as
   * much as the rest of a tick while little touches, several times that where layers lie on each other, and from
   * twenty to hundreds of times where sheets of thousands of particles crumple.
   */
  selfCollision: boolean | "particles";
  /**
   * Distance that they keep [m]; 0. Where surfaces keep apart 0 takes the material's thickness, and it is at
   * most half of the mean rest length; where particles do, 0 takes two thirds of that length, and it is at most
   * twice that length.
   */
  selfDistance: number;
  /** Over-stretched links tear, see `tearStretch` of the material; false. */
  tearing: boolean;
  /** Vertices that tearing may split in one tick, the worst first; 8. At least 1. */
  maxTearsPerTick: number;
  /**
   * A cloth of which no particle was faster for half a second sleeps [m/s]: it stays just as it is, at next to no
   * cost, until something changes or touches it; 0, never. At least 0. Gusts, swirls and the sine field keep a
   * cloth awake. See `asleep` of the stats.
   */
  sleepSpeed: number;
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
  /**
   * Bending rigidity per width [N·m]; 2.5e-5: what a strip that hangs from a clamp shows (BS 3356), however fine
   * the mesh, the tick and the sweeps are, whichever way it is cut: exactly on grids, within a twentieth of its
   * bending length on other meshes. 0 is limp; 1 or more is links over two cells instead, as rigid as the sweeps allow.
   */
  bendStiffness: number;
  /**
   * Damping of bending [s]; 0. Bending by some angle a second is resisted as that angle times this would be; a few
   * hundredths calm a flutter. At least 0.
   */
  bendDamping: number;
  /** Damping of stretching [s]; 0. In the same way, for links that give way. At least 0. */
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
  /**
   * Angle up to which a fold opens again [rad]; of one that was folded further, the rest stays. 0: all opens. At
   * least 0. Paper is near 0.8.
   */
  yieldAngle: number;
  /** Share of a fold beyond `yieldAngle` that stays; 1. From 0 to 1. */
  yieldCreep: number;
  /**
   * Length of the sheet over which folding counts as one fold [m]; 0.01. The same angle over more than that is only
   * bent, and stays bent beyond a curvature of `yieldAngle` over this. Three cells count at least. At least 0.
   */
  foldLength: number;
  /**
   * How much more a fold opens again, for each angle that it has given way by in all, to either side; 0. Of one that
   * is folded by φ for the first time (φ − `yieldAngle`) / (1 + this) stays, and to fold it on takes as much more. At
   * least 0. What gives way or is creased while this and `yieldWeakening` are 0 is not counted.
   */
  yieldHardening: number;
  /**
   * How much weaker a fold gets by giving way [1/rad]; 0. Where it has given way by A in all, to either side,
   * `foldLength` of the sheet bends as if `bendStiffness` were divided by 1 + this · A, by at most a thousand; pressed
   * flat, it stays as weak. It gives way under the same moment as before, so that it opens again by more:
   * `yieldAngle` · this counts as `yieldHardening` too. At least 0.
   */
  yieldWeakening: number;
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
  /** Distance between neighbours [m]; 0.05. From 1e-6 to 1e6. */
  spacing?: number;
  /** Where particle 0, the top left, is [m]; [0, 0, 0]. Within 2097152 `spacing` of zero along each axis. */
  origin?: Vec3Like;
  /** Unit direction of a row; [1, 0, 0]. */
  right?: Vec3Like;
  /** Unit direction of a column, square to `right`; [0, -1, 0]. */
  down?: Vec3Like;
  /** What is pinned from the start; "top-edge". */
  pinMode?: "none" | "top-edge" | "top-corners" | "corners";
}

/**
 * Any triangle mesh, as artists export them. What cannot be cloth in it is repaired, and `meshReport` tells what
 * was: doubled vertices are welded, triangles without an area and repeated ones dropped; where more than two
 * triangles share an edge the flattest two stay joined and the others get an edge of their own; sheets that meet at
 * a mere point are parted; the triangles of a piece are turned to face as most of them do. Vertices that no
 * triangle uses stay where they are.
 *
 * A mesh that is a regular grid, its vertices and triangles in the order that `Cloth.grid` has them, is woven as
 * that grid is: it moves in the same bits.
 */
export interface MeshDesc extends ClothDesc {
  /**
   * Where the vertices are at rest, x y z x y z … [m]. Each is the particle of its number if nothing is welded or
   * split, see `vertexParticles`.
   */
  positions: Float32Array | Float64Array | readonly number[];
  /** Three vertices a triangle, counter-clockwise seen from its front. */
  indices: Uint32Array | Uint16Array | readonly number[];
  /** Texture coordinates, u v u v …, one pair a vertex; or none at all. */
  uvs?: Float32Array | Float64Array | readonly number[];
  /** Vertices whose particles are pinned from the start; none. */
  pinned?: Uint32Array | Uint16Array | readonly number[];
  /**
   * Vertices at most this far apart share a particle [m]; 0 joins those at the very same place, −1 (or anything
   * below 0) leaves all apart. Vertices are taken in order, and each joins the nearest one before it that stayed
   * apart; but the corners of a triangle stay apart, however small it is. Keep it well below the shortest edge.
   */
  weldDistance?: number;
}

/**
 * What a collider is: a "plane", all that is below `position` along the turned y axis; a "sphere"; a
 * "capsule", balls at both ends of a stretch of the turned y axis and all between them; a "box"; a "convex"
 * body, the least that holds all of `positions`; a "mesh" of triangles, where cloth stays on the side where
 * it is, so that it need not be closed nor wound one way; a "heightfield", all below a surface over heights
 * along the turned x and z axes from `position` on.
 */
export type Shape = "plane" | "sphere" | "capsule" | "box" | "convex" | "mesh" | "heightfield";

/** A collider: its shape, where it is and how it feels. Fields that its shape does not use are ignored. */
export interface ColliderDesc {
  /** What it is; "plane". */
  shape?: Shape;
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
  /**
   * Gap kept from its surface [m]; −1 takes the material's thickness. Where a surface is round or bends little,
   * particles stay farther off by what is between them would sink in: at most a fifth of the mean edge from
   * balls and capsules, a tenth from others.
   */
  thickness?: number;
  /** Of a sphere or capsule [m]; 0.5. */
  radius?: number;
  /** Of the upper end of a capsule [m]; −1 is as `radius`. */
  topRadius?: number;
  /** Of a capsule: from its middle to the centres of its ends [m]; 0.5. */
  halfHeight?: number;
  /** Of a box: from its middle to its sides [m]; [0.5, 0.5, 0.5]. */
  halfExtents?: Vec3Like;
  /** Of a heightfield: from one height to the next [m]; 1. */
  spacing?: number;
  /** Of a heightfield: heights along x, 2 to 4096. */
  columns?: number;
  /** Of a heightfield: heights along z, 2 to 4096. */
  rows?: number;
  /** Of a convex body, at most 1024, or a mesh: its points [m], x y z x y z …. Copied. */
  positions?: Float32Array | Float64Array | readonly number[];
  /** Of a mesh: points of its triangles, three each. Copied. */
  indices?: Uint32Array | Uint16Array | readonly number[];
  /** Of a heightfield: `columns` × `rows` heights [m], row by row along x. Copied. */
  heights?: Float32Array | Float64Array | readonly number[];
}
