// Descriptors: settings, material, wind, grids, meshes, sewing.

import type { QuatLike, Vec3Like } from "./check.js";

/**
 * How the solver runs: ticks, substeps, gravity, damping, and which features are on.
 *
 * One tick is `substeps` times (predict positions, then `iterations` sweeps over all links). More
 * of either makes the cloth stiffer and costs as much more; substeps stiffen more than iterations
 * do.
 */
export interface Settings {
  /** Length of a tick [s]. Above 0, at most 1. @defaultValue 1/60 */
  tick: number;
  /**
   * Least number of substeps per tick, 1 to 1000. Where cloth and colliders move fast relative to
   * each other, a tick runs up to 8 times as many, but not more than 64 unless this is larger; see
   * `substeps` of the stats. @defaultValue 4
   */
  substeps: number;
  /**
   * Solver sweeps per substep, 1 to 1000. With 1, integration is first order and damps all motion;
   * from 2 on it is second order, and only `damping` and the air take energy away.
   *
   * @defaultValue 2
   */
  iterations: number;
  /**
   * The most ticks that one `advance` runs; at least 1. If a frame is late by more, the rest is
   * dropped and the cloth moves in slow motion.
   *
   * @defaultValue 5
   */
  maxTicksPerAdvance: number;
  /** Acceleration of all particles [m/s²]. @defaultValue [0, -9.81, 0] */
  gravity: Vec3Like;
  /**
   * Decay rate of velocities [1/s]; at least 0. A velocity decays as exp(−damping · t), whatever
   * the tick and substeps are.
   *
   * @defaultValue 0.5
   */
  damping: number;
  /**
   * The farthest that a particle moves in one substep relative to the rigid motion of the cloth, in
   * mean rest lengths of the links; above 0. It also limits how fast a grabbed particle follows its
   * pointer.
   *
   * @defaultValue 0.5
   */
  maxDisplacement: number;
  /**
   * Strain limit: the largest strain of any stretch or shear link after a tick; 0.02 means 2 %. 0
   * turns the limit off. If pins, grabs or anchors hold particles farther apart than it allows, an
   * event `"held-apart"` and `stats.overStretched` say so.
   *
   * @defaultValue 0
   */
  maxStretch: number;
  /**
   * Long-range attachments (tethers): no particle moves farther from a pin than the cloth between
   * them allows. If `iterations` is 2 or more, whole lines of links are also solved at once, so
   * that a load reaches the pins within one sweep. If false, sweeps over single links do all the
   * work.
   *
   * @defaultValue true
   */
  tethers: boolean;
  /**
   * Collision of the cloth with itself.
   *
   * - `false`: none; layers pass through each other.
   * - `true`: surface against surface. Layers keep `selfDistance`, do not cross, and rub with the
   *   friction of the material.
   * - `"particles"`: particle against particle, as if each were a ball. This is cheap and has no
   *   friction. A fold can slip through where particles are farther apart than `selfDistance`.
   *   Pairs that are connected and closer at rest than `selfDistance`, or than 1.5 mean rest
   *   lengths, do not collide; pinned and grabbed particles do not collide either.
   *
   * Details of `true`: parts whose distance at rest is below two thicknesses keep half of that
   * distance. The two sides of a fresh tear move apart by a thousandth of the mean rest length, so
   * that they collide from then on. Pinned and grabbed particles push away what is in their path;
   * cloth that is caught between two of them may be forced through. Where layers intersect already
   * (in the initial shape, when you turn this on, or after you place particles), they are separated
   * unless they are held: the smaller part moves back to the side of the rest, usually within a
   * second.
   *
   * Cost of `true`: about as much as the rest of a tick while few parts touch; several times as
   * much while layers lie on each other; 20 to several hundred times as much while a sheet of
   * thousands of particles crumples.
   *
   * @defaultValue false
   */
  selfCollision: boolean | "particles";
  /**
   * Distance that self-collision keeps [m]; at least 0. With surfaces, 0 means the thickness of the
   * material, and the distance is at most half of the mean rest length. With particles, 0 means two
   * thirds of the mean rest length, and the distance is at most twice that length.
   *
   * @defaultValue 0
   */
  selfDistance: number;
  /** Whether overstretched edges tear, see `tearStretch` of the material. @defaultValue false */
  tearing: boolean;
  /**
   * The most vertices that tearing splits in one tick, those with the largest stretch first; at
   * least 1.
   *
   * @defaultValue 8
   */
  maxTearsPerTick: number;
  /**
   * Sleep threshold [m/s]: a cloth whose particles were all slower than this for half a second
   * falls asleep. It then costs almost nothing, and wakes when something changes or touches it. 0
   * turns sleeping off. Gusts, turbulence and the sine field keep a cloth awake. See `asleep` of
   * the stats.
   *
   * @defaultValue 0
   */
  sleepSpeed: number;
  /**
   * Over-pressure inside closed pieces of the cloth [Pa].
   *
   * A piece is closed if each of its edges has two triangles, as in a ball or a cushion, or if all
   * of its border is sewn to closed pieces (`sew`). The pressure is constant, whatever the volume; a
   * negative one sucks the sides inwards, as a vacuum does. Outwards is where the volume of the rest shape is positive, whatever the winding. A piece
   * that is torn or cut open loses its pressure at once. Open cloth, such as a grid, feels none.
   *
   * Links stretch under high pressure unless `maxStretch` limits them. Where the pressure alone
   * would move a particle of a piece by more than `maxDisplacement` in a substep, all of that piece
   * gets less.
   *
   * @defaultValue 0
   */
  pressure: number;
}

/**
 * What the cloth is made of, in SI units. Start from a preset and change what you need.
 *
 * @example
 * ```js
 * cloth.material = "denim";                                // a preset
 * cloth.material = { bendStiffness: 1e-4 };                // one field of the current material
 * cloth.material = { preset: "silk", tearStretch: 1.5 };   // a preset with one change
 * ```
 */
export interface Material {
  /** Mass per area [kg/m²]; above 0. @defaultValue 0.18, as cotton */
  density: number;
  /**
   * Gap that the cloth keeps from colliders, and from itself [m]; at least 0. Keep it below half of
   * the shortest edge.
   *
   * @defaultValue 0.00035
   */
  thickness: number;
  /**
   * Membrane stiffness along the warp, down the columns of a grid [N/m]; at least 0. 0 means as
   * stiff as the number of sweeps allows.
   *
   * @defaultValue 0
   */
  stretchStiffnessWarp: number;
  /**
   * Membrane stiffness along the weft, across a grid [N/m]; otherwise as for the warp.
   *
   * @defaultValue 0
   */
  stretchStiffnessWeft: number;
  /**
   * Shear stiffness [N/m]; at least 0. 0 means the same as the stretch stiffness.
   *
   * @defaultValue 0
   */
  shearStiffness: number;
  /**
   * Bending rigidity per width [N·m]; at least 0. It is the value that the cantilever test (BS
   * 3356) measures, and does not depend on the mesh, the tick, the iterations or the direction of
   * the strip: exact on grids, within 5 % of the bending length on other meshes. 0 means limp. From
   * 1 on, links over two cells replace the bending model, as rigid as the number of sweeps allows.
   *
   * @defaultValue 2.5e-5
   */
  bendStiffness: number;
  /**
   * Damping of bending [s]; at least 0. Bending at a rate of ω [rad/s] is resisted as a static bend
   * by ω · bendDamping is. A few hundredths calm a flutter.
   *
   * @defaultValue 0
   */
  bendDamping: number;
  /**
   * Damping of stretching [s], in the same sense; at least 0. It acts on links that are not rigid.
   *
   * @defaultValue 0
   */
  stretchDamping: number;
  /** Coulomb friction coefficient, against colliders and itself; at least 0. @defaultValue 0.4 */
  friction: number;
  /** Restitution: share of the normal velocity that a bounce returns, 0 to 1. @defaultValue 0 */
  restitution: number;
  /** Drag coefficient of a triangle that faces the wind; at least 0. @defaultValue 1.2 */
  drag: number;
  /** Lift coefficient of a triangle at an angle to the wind; at least 0. @defaultValue 0 */
  lift: number;
  /**
   * Length over rest length at which an edge tears if `tearing` is on; above 1, or 0 for never.
   *
   * At the tip of a tear the limit is lower, because the load concentrates there, the more so the
   * finer the mesh is: the strain limit is multiplied by √(16 · thickness / mean edge), by a fifth
   * at least. So a tear grows under the same load on any mesh.
   *
   * @defaultValue 4
   */
  tearStretch: number;
  /**
   * Variation of the tear limit, 0 to 1: with 0 all edges tear at the same stretch, with 1 their
   * limits vary by half.
   *
   * @defaultValue 0.2
   */
  tearVariation: number;
  /**
   * Yield angle of folds [rad]; at least 0. A fold springs back by this angle, and what exceeds it
   * stays. 0 means that all folds spring back. Paper has about 0.8.
   *
   * @defaultValue 0
   */
  yieldAngle: number;
  /** Share of the fold beyond `yieldAngle` that stays, 0 to 1. @defaultValue 1 */
  yieldCreep: number;
  /**
   * Length of cloth over which bending counts as one fold [m]; at least 0. The same angle over a
   * greater length is an elastic bend, unless its curvature exceeds yieldAngle / foldLength. A fold
   * is never counted over less than three cells.
   *
   * @defaultValue 0.01
   */
  foldLength: number;
  /**
   * Hardening of folds by plastic folding; at least 0. A fold springs back by this much more per
   * angle that has yielded in all, in both directions. A flat sheet that is folded by φ keeps
   * (φ − yieldAngle) / (1 + yieldHardening), and folding it further needs more by the same factor.
   *
   * Folding and creasing are recorded only while this or `yieldWeakening` is above 0.
   *
   * @defaultValue 0
   */
  yieldHardening: number;
  /**
   * Weakening of folds by plastic folding [1/rad]; at least 0. Where an angle of A has yielded in
   * all, in both directions, a length of `foldLength` bends as if `bendStiffness` were divided by
   * 1 + yieldWeakening · A, by 1000 at most. Pressing the fold flat does not restore it.
   *
   * The yield moment stays the same, so a weak fold springs back more:
   * yieldAngle · yieldWeakening is added to `yieldHardening`.
   *
   * @defaultValue 0
   */
  yieldWeakening: number;
}

/** The name of a material that comes with Muslin. */
export type Preset = "silk" | "cotton" | "denim" | "leather" | "paper" | "flag-nylon";

/**
 * A property that `setMap` paints:
 *
 * - "stretch": stiffness against stretch and shear. Links without compliance (a stiffness of 0) stay
 *   rigid; at scale 0 other links do not resist.
 * - "bend": bending rigidity; at scale 0 the cloth is limp. Does not act on a `bendStiffness` from 1
 *   on.
 * - "tear": strength, the strain at which an edge tears (`tearStretch` - 1). At scale 0 an edge tears
 *   as soon as it is stretched at all; a large scale keeps it from tearing.
 * - "friction": coefficient of friction of contacts with colliders and of surface self-collision.
 * - "thickness": distance from colliders and between layers in self-collision.
 * - "drag": drag coefficient; lift stays as it is.
 */
export type MapName = "stretch" | "bend" | "tear" | "friction" | "thickness" | "drag";

/**
 * A material as an argument: the name of a preset, or the fields that change. The other fields come
 * from `preset` if it is given, otherwise from the current (or default) material.
 */
export type MaterialLike = Preset | (Partial<Material> & { preset?: Preset });

/** The air around the cloth. */
export interface Wind {
  /**
   * How the air acts.
   *
   * - `"surface"`: on each triangle, with the square of the relative speed; still air brakes.
   * - `"sine-field"`: on each particle, as a field of sine waves that ignores the orientation of
   *   the cloth. The length of `velocity` is its strength as an acceleration [m/s²].
   *
   * @defaultValue "surface"
   */
  model: "surface" | "sine-field";
  /** Mean velocity of the air [m/s]. @defaultValue [0, 0, 0], still air */
  velocity: Vec3Like;
  /** Amplitude of gusts, as a share of the mean speed, 0 to 1. @defaultValue 0 */
  gust: number;
  /** Largest deviation of the wind's direction over time [rad], 0 to π. @defaultValue 0 */
  wander: number;
  /** Amplitude of turbulence in space, as a share of the speed, 0 to 1. @defaultValue 0 */
  turbulence: number;
  /** Density of the air [kg/m³]; at least 0. 0 is a vacuum. @defaultValue 1.2 */
  airDensity: number;
  /** Seed of the random gusts and turbulence, an integer from 0 to 4294967295. @defaultValue 0 */
  seed: number;
}

/** The fields that grids and meshes have in common. */
export interface ClothDesc {
  /**
   * Reserve of particles for tears and cuts: how many they may add. Memory for them is allocated
   * with `tearing`, or by the first tear or cut.
   *
   * @defaultValue as many as the cloth starts with
   */
  extraParticles?: number;
  /** What the cloth is made of. @defaultValue the default of each field */
  material?: MaterialLike;
  /** How the solver runs. @defaultValue the default of each field */
  settings?: Partial<Settings>;
}

/**
 * A regular grid of particles. The particle at `row` and `column` has the index
 * row · columns + column.
 *
 * ```text
 * origin ●── right ─▶ ●     0 1 2
 *        │            │     3 4 5
 *       down          │
 *        ▼            │
 *        ●────────────●
 * ```
 */
export interface GridDesc extends ClothDesc {
  /** Number of particles across; at least 2. @defaultValue 40 */
  columns?: number;
  /** Number of particles down; at least 2. @defaultValue 40 */
  rows?: number;
  /** Distance between neighbours [m], 1e-6 to 1e6. @defaultValue 0.05 */
  spacing?: number;
  /**
   * Position of particle 0, the top left corner [m]. Each coordinate is within 2097152 spacings of
   * zero.
   *
   * @defaultValue [0, 0, 0]
   */
  origin?: Vec3Like;
  /** Unit direction of the rows. @defaultValue [1, 0, 0] */
  right?: Vec3Like;
  /** Unit direction of the columns, at a right angle to `right`. @defaultValue [0, -1, 0] */
  down?: Vec3Like;
  /** Which particles are pinned at first. @defaultValue "top-edge" */
  pinMode?: "none" | "top-edge" | "top-corners" | "corners";
}

/**
 * A triangle mesh, as artists export it.
 *
 * The mesh is repaired first, and `cloth.meshReport` counts the repairs: vertices are welded;
 * triangles without an area and duplicates are dropped; where more than two triangles share an
 * edge, the two that lie flattest stay joined and each other one gets an edge of its own; sheets
 * that touch only at a point are separated; triangles are turned so that the piece has a consistent
 * orientation, that of its majority; short edges are collapsed if `simplifyBelow` is above 0.
 * Vertices that no triangle uses become particles without mass
 * that do not move.
 *
 * A mesh that is a regular grid, with vertices and triangles in the order of `Cloth.grid`, is
 * recognised and moves with the same bits as that grid.
 */
export interface MeshDesc extends ClothDesc {
  /**
   * Rest positions of the vertices, x y z x y z … [m]. At least 3 vertices. Vertex i is particle i,
   * unless vertices are welded, split or collapsed; `cloth.vertexParticles` maps them then.
   */
  positions: Float32Array | Float64Array | readonly number[];
  /** Three vertices per triangle, counter-clockwise when seen from the front. */
  indices: Uint32Array | Uint16Array | readonly number[];
  /** Texture coordinates, u v u v …, one pair per vertex. @defaultValue none */
  uvs?: Float32Array | Float64Array | readonly number[];
  /** Vertices whose particles are pinned at first. @defaultValue none */
  pinned?: Uint32Array | Uint16Array | readonly number[];
  /**
   * Vertices within this distance share a particle [m]. 0 welds vertices at identical positions; a
   * negative number welds none.
   *
   * Vertices are processed in order: each joins the nearest earlier vertex that did not itself join
   * another. The corners of one triangle are never welded to each other. Keep the distance well
   * below the shortest edge.
   *
   * @defaultValue -1
   */
  weldDistance?: number;
  /**
   * Edges shorter than this are collapsed [m]; 0 collapses none. At most the mean length of the
   * edges.
   *
   * One end of such an edge moves to the other, with its vertices, and the triangles at the edge are
   * removed. Triangles that are lower than this get another diagonal where that makes them higher.
   * Borders, seams of texture coordinates and their corners stay, a pinned vertex moves to pinned
   * ones only, and the topology stays; `shortEdges` of `cloth.meshReport` counts the edges that are
   * short nevertheless. A tenth to a third of the mean edge removes the slivers of most meshes.
   *
   * @defaultValue 0
   */
  simplifyBelow?: number;
}

/**
 * Shape of a collider, in its local frame.
 *
 * - `"plane"`: the half-space below y = 0.
 * - `"sphere"`: a ball of `radius`.
 * - `"capsule"`: the hull of two balls at y = −`halfHeight` (`radius`) and y = +`halfHeight`
 *   (`topRadius`).
 * - `"box"`: extends by `halfExtents` along each axis, in both directions.
 * - `"convex"`: the convex hull of `positions`.
 * - `"mesh"`: the triangles of `positions` and `indices`. Each part of the cloth stays on the side
 *   where it is, so the mesh need not be closed or consistently oriented. Its gap is at least 0.1
 *   mm.
 * - `"heightfield"`: everything below the surface over `columns` × `rows` heights, `spacing` apart
 *   along x and z from the local origin on. It is as deep as it is wide and has no sides.
 */
export type Shape = "plane" | "sphere" | "capsule" | "box" | "convex" | "mesh" | "heightfield";

/** How `sew` joins pairs of particles. */
export interface SewOptions {
  /** Speed at which the distance of each pair falls to zero [m/s]; above 0. @defaultValue 0.5 */
  speed?: number;
  /**
   * What joins the particles. A weld is as if woven in one piece: it never tears, and normals are
   * smooth across it. A stitch is a thread that tears under more than `tearForce`, and keeps the
   * normals of both sides apart.
   *
   * @defaultValue "weld"
   */
  kind?: "weld" | "stitch";
  /**
   * Force on one pair above which a stitch tears [N], as the mean over a tick; at least 0, 0 means
   * never. A weld ignores it.
   *
   * @defaultValue 0
   */
  tearForce?: number;
}
