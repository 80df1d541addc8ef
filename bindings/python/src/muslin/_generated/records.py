"""Settings and reports as dataclasses.

Generated from include/muslin.h. To write it again: MUSLIN_BLESS=1 cargo xtask python
"""

from dataclasses import dataclass
from typing import ClassVar

from .._convert import Vec3
from .._record import FLAG, NUMBER, STAGES, VECTOR, WHOLE, Kind, Record, choice
from .constants import SELF_COLLISIONS, WIND_MODELS, SelfCollision, WindModel
from .structs import (
    MuslinChanges, MuslinHit, MuslinMaterial, MuslinMeshReport, MuslinSettings, MuslinStats,
    MuslinWind,
)


@dataclass(frozen=True, kw_only=True)
class MaterialFields(Record):
    """Material of a cloth, in SI units. Every field may be changed between ticks."""

    _struct: ClassVar = MuslinMaterial
    _init: ClassVar = "muslin_material_init_sized"
    _kinds: ClassVar[dict[str, Kind]] = {
        "density": NUMBER, "thickness": NUMBER, "stretch_stiffness_warp": NUMBER,
        "stretch_stiffness_weft": NUMBER, "shear_stiffness": NUMBER, "bend_stiffness": NUMBER,
        "bend_damping": NUMBER, "stretch_damping": NUMBER, "friction": NUMBER,
        "restitution": NUMBER, "drag": NUMBER, "lift": NUMBER, "tear_stretch": NUMBER,
        "tear_variation": NUMBER, "yield_angle": NUMBER, "yield_creep": NUMBER,
        "fold_length": NUMBER, "yield_hardening": NUMBER, "yield_weakening": NUMBER,
    }

    density: float = 0.18
    """Mass per area [kg/m^2]. Default 0.18 (cotton). Above 0."""
    thickness: float = 0.00035
    """Gap that the cloth keeps from anything it touches [m]. Default 0.00035. At least 0. Choose
    less than half of the shortest edge.
    """
    stretch_stiffness_warp: float = 0.0
    """Membrane stiffness along the warp (the columns of a grid) [N/m]. Default 0: as stiff as the
    solver reaches. At least 0.
    """
    stretch_stiffness_weft: float = 0.0
    """Membrane stiffness along the weft (the rows of a grid) [N/m]. Default 0: as stiff as the
    solver reaches. At least 0.
    """
    shear_stiffness: float = 0.0
    """Shear stiffness [N/m]. Default 0: the stretch stiffness. At least 0."""
    bend_stiffness: float = 2.5e-05
    """Bending rigidity per width [N m]. Default 2.5e-5. At least 0.

    - It is the value that a strip hanging from a clamp shows (BS 3356), independent of mesh
      resolution, tick, substeps and iterations, and of the direction in which the strip is cut:
      exactly on grids, to 1/20 of the bending length on other meshes.
    - 0 is limp.
    - 1 or more uses links over two cells instead, as rigid as the solver reaches.
    """
    bend_damping: float = 0.0
    """Damping of bending [s]. Default 0. At least 0. Bending at some angle per second is resisted
    like this angle times `bend_damping`; a few hundredths stop a flutter.
    """
    stretch_damping: float = 0.0
    """Damping of stretching [s], in the same way, for links that have a stiffness. Default 0. At
    least 0.
    """
    friction: float = 0.4
    """Coulomb friction coefficient against colliders and between layers. Default 0.4. At least 0.
    """
    restitution: float = 0.0
    """Share of the normal velocity that a bounce returns. Default 0. From 0 to 1."""
    drag: float = 1.2
    """Drag coefficient of a triangle perpendicular to the wind. Default 1.2. At least 0."""
    lift: float = 0.0
    """Lift coefficient of a triangle oblique to the wind. Default 0. At least 0."""
    tear_stretch: float = 4.0
    """Ratio of length to rest length at which an edge tears. Default 4. Above 1, or 0: never.

    At a crack tip a smaller strain suffices: sqrt(16 thickness / mean edge) of it, at least 1/5. On
    a finer mesh the load is more concentrated there; with this factor, a crack grows at the same
    load on any mesh.
    """
    tear_variation: float = 0.2
    """Variation of the tear limit between edges. Default 0.2. From 0 (all edges alike) to 1 (the
    limit varies by half).
    """
    yield_angle: float = 0.0
    """Angle up to which a fold opens again completely [rad]; of a sharper fold, the excess stays.
    Default 0: folds never stay. At least 0. Paper has about 0.8.
    """
    yield_creep: float = 1.0
    """Share of the excess over `yield_angle` that stays. Default 1. From 0 to 1."""
    fold_length: float = 0.01
    """Length of cloth over which bending counts as one fold [m]. Default 0.01. At least 0; at least
    three cells are used.

    The same angle spread over a greater length is only a bend; a bend stays if its curvature
    exceeds `yield_angle` / `fold_length`.
    """
    yield_hardening: float = 0.0
    """Growth of the yield angle with accumulated yielding (in either direction). Default 0. At
    least 0.

    Of a first fold by some angle, (angle - `yield_angle`) / (1 + `yield_hardening`) stays, and
    folding it further needs as much more. Yielding and creases are not counted while this and
    `yield_weakening` are 0.
    """
    yield_weakening: float = 0.0
    """Loss of bending stiffness with accumulated yielding [1/rad]. Default 0. At least 0.

    After yielding by an angle in total (in either direction), `fold_length` of the cloth bends as
    if `bend_stiffness` were divided by 1 + `yield_weakening` * angle, at most by 1000; pressing the
    fold flat does not restore it. The moment at which it yields stays the same, so the fold opens
    further: `yield_angle` * `yield_weakening` adds to `yield_hardening`.
    """


@dataclass(frozen=True, kw_only=True)
class Settings(Record):
    """Settings of the simulation: time steps, gravity, damping and solver options. Every field may
    be changed between ticks.

    A tick is divided into `substeps`. Each substep predicts the positions and then solves all
    constraints `iterations` times. More of either makes the cloth stiffer; at the same cost,
    substeps stiffen it more than iterations.
    """

    _struct: ClassVar = MuslinSettings
    _init: ClassVar = "muslin_settings_init_sized"
    _kinds: ClassVar[dict[str, Kind]] = {
        "tick": NUMBER, "substeps": WHOLE, "iterations": WHOLE, "max_ticks_per_advance": WHOLE,
        "gravity": VECTOR, "damping": NUMBER, "max_displacement": NUMBER, "max_stretch": NUMBER,
        "tethers": FLAG, "self_collision": choice(SELF_COLLISIONS), "self_distance": NUMBER,
        "tearing": FLAG, "max_tears_per_tick": WHOLE, "sleep_speed": NUMBER, "pressure": NUMBER,
    }

    tick: float = 0.016666668
    """Length of a tick [s]. Default 1/60. Above 0, at most 1."""
    substeps: int = 4
    """Least number of substeps per tick. Default 4. From 1 to 1000.

    Where cloth and colliders move fast relative to each other, a tick runs up to 8 times as many,
    but not more than 64 unless this is larger. See `substeps` of `Stats`.
    """
    iterations: int = 2
    """Solver iterations per substep, in alternating order. Default 2. From 1 to 1000.

    With 1, the time integration is of first order, which damps all motion. From 2 on it is of
    second order; then only `damping` and the air damp.
    """
    max_ticks_per_advance: int = 5
    """Largest number of ticks of one `Cloth.advance`; the rest of the backlog is dropped. Default
    5. At least 1.
    """
    gravity: Vec3 = (0.0, -9.81, 0.0)
    """Gravitational acceleration [m/s^2]. Default 0, -9.81, 0."""
    damping: float = 0.5
    """Rate at which velocities decay [1/s], as exp(-`damping` t), independent of the step. Default
    0.5. At least 0.
    """
    max_displacement: float = 0.5
    """Largest displacement of a particle per substep, relative to the rigid motion of the cloth, in
    mean rest lengths. Default 0.5. Above 0. It also limits the speed of a grabbed particle.
    """
    max_stretch: float = 0.0
    """Strain limit: the largest strain of any stretch or shear link after a tick, unless pins,
    grabs or anchors hold it apart. Default 0: no limit. 0.02 is 2 %. At least 0.
    """
    tethers: bool = True
    """Whether tethers (long-range attachments) keep every particle within its rest distance of the
    pins. Default True.

    Tethers carry the load that the iterations do not reach; they do not resist the stretch of links
    that have a stiffness. From 2 iterations on, whole chains of links are solved at once as well.
    """
    self_collision: SelfCollision = "none"
    """Self-collision: "none" (default), "surface" or "particles".

    - "none": Parts of the cloth pass through each other.
    - "surface": Triangles collide with triangles, so that no part of the surface passes through
      another. With the material's friction.
    - "particles": Particles collide with particles, as if they were balls.
    """
    self_distance: float = 0.0
    """Gap of self-collision [m]. Default 0.

    - Surface: 0 means the material's thickness. At most half of the mean rest length.
    - Particles: 0 means 2/3 of the mean rest length. At most twice the mean rest length.
    """
    tearing: bool = False
    """Whether links that are stretched past `tear_stretch` of `Material` tear. Default False."""
    max_tears_per_tick: int = 8
    """Largest number of vertices that tearing splits per tick; the most stretched come first.
    Default 8. At least 1.
    """
    sleep_speed: float = 0.0
    """Speed below which the cloth falls asleep [m/s]. Default 0: never. At least 0.

    A cloth whose particles were all slower for half a second stops moving, at almost no cost, until
    something changes or touches it. Gusts, turbulence and "sine-field" keep it awake. See `asleep`
    of `Stats`.
    """
    pressure: float = 0.0
    """Over-pressure inside closed pieces of the cloth [Pa]. Default 0. Finite.

    A piece is closed if each of its edges has two triangles, as in a ball or a cushion, or if all
    of its border is sewn to closed pieces (`Cloth.sew`). The pressure is constant, whatever the
    volume; a negative one sucks the sides inwards, as a vacuum does. Outwards is where the volume
    of the rest shape is positive, whatever the winding. A piece that is torn or cut open loses its
    pressure at once. Open cloth, such as a grid, feels none.

    Links stretch under high pressure unless `max_stretch` limits them. Where the pressure alone
    would move a particle of a piece by more than `max_displacement` in a substep, all of that piece
    gets less.
    """


@dataclass(frozen=True, kw_only=True)
class Wind(Record):
    """The air around a cloth: steady wind with gusts, changing direction and turbulence. Equal
    seeds give equal gusts.
    """

    _struct: ClassVar = MuslinWind
    _init: ClassVar = "muslin_wind_init_sized"
    _kinds: ClassVar[dict[str, Kind]] = {
        "model": choice(WIND_MODELS), "velocity": VECTOR, "gust": NUMBER, "wander": NUMBER,
        "turbulence": NUMBER, "air_density": NUMBER, "seed": WHOLE,
    }

    model: WindModel = "surface"
    """Model: "surface" (default) or "sine-field".

    - "surface": Aerodynamic forces on each triangle, proportional to the square of the relative air
      speed. Still air damps the motion.
    - "sine-field": A field of sine waves that accelerates each particle, independent of the
      direction of the surface. The length of `velocity` is the strength [m/s^2].
    """
    velocity: Vec3 = (0.0, 0.0, 0.0)
    """Mean velocity of the air [m/s]. Default 0, 0, 0."""
    gust: float = 0.0
    """Variation of the speed over time, as a share of it. Default 0. From 0 to 1."""
    wander: float = 0.0
    """Variation of the direction over time [rad]. Default 0. From 0 to pi."""
    turbulence: float = 0.0
    """Variation of the air velocity in space, as a share of the speed. Default 0. From 0 to 1."""
    air_density: float = 1.2
    """Density of the air [kg/m^3]. Default 1.2. At least 0; 0 is a vacuum."""
    seed: int = 0
    """Selects the sequence of gusts and turbulence. Default 0."""


@dataclass(frozen=True, kw_only=True)
class Hit(Record):
    """Where a ray hits a cloth."""

    _struct: ClassVar = MuslinHit
    _kinds: ClassVar[dict[str, Kind]] = {
        "triangle": WHOLE, "particle": WHOLE, "u": NUMBER, "v": NUMBER, "distance": NUMBER,
        "position": VECTOR, "normal": VECTOR,
    }

    triangle: int
    """Triangle that was hit: a row of `Cloth.indices`."""
    particle: int
    """Corner particle nearest to the hit."""
    u: float
    """Barycentric weight of the triangle's second corner."""
    v: float
    """Barycentric weight of the triangle's third corner."""
    distance: float
    """Distance from the ray's origin [m]."""
    position: Vec3
    """Point of the hit [m]."""
    normal: Vec3
    """Unit normal of the triangle, on the side that was hit."""


@dataclass(frozen=True, kw_only=True)
class Changes(Record):
    """Ranges of a cloth's output lists that changed since a topology revision: what a renderer must
    upload again.

    The vertex range concerns the attributes that stay constant between topology changes: texture
    coordinates, source vertices, particles and frayed borders. Positions and normals change with
    every tick.
    """

    _struct: ClassVar = MuslinChanges
    _kinds: ClassVar[dict[str, Kind]] = {
        "first_vertex": WHOLE, "vertex_count": WHOLE, "first_index": WHOLE, "index_count": WHOLE,
    }

    first_vertex: int
    """First changed vertex; 0 if there is none."""
    vertex_count: int
    """Number of vertices in the changed range."""
    first_index: int
    """First changed index; 0 if there is none."""
    index_count: int
    """Number of indices in the changed range."""


@dataclass(frozen=True, kw_only=True)
class MeshReport(Record):
    """What was repaired in a mesh before it became cloth, and the quality of the result.

    Repairs are made in this order: vertices are welded; triangles without an area and repeated
    triangles are dropped; edges and vertices where several sheets meet are split; triangles that
    face the other way are turned; short edges are collapsed.
    """

    _struct: ClassVar = MuslinMeshReport
    _kinds: ClassVar[dict[str, Kind]] = {
        "vertices": WHOLE, "triangles": WHOLE, "particles": WHOLE, "kept_triangles": WHOLE,
        "welded_vertices": WHOLE, "dropped_degenerate": WHOLE, "dropped_duplicates": WHOLE,
        "turned_triangles": WHOLE, "split_edges": WHOLE, "split_vertices": WHOLE,
        "unused_vertices": WHOLE, "pieces": WHOLE, "one_sided_pieces": WHOLE, "is_grid": FLAG,
        "shortest_edge": NUMBER, "mean_edge": NUMBER, "worst_aspect": NUMBER,
        "thin_triangles": WHOLE, "thinnest_triangle": WHOLE, "collapsed_edges": WHOLE,
        "collapsed_triangles": WHOLE, "trimmed_triangles": WHOLE, "flipped_edges": WHOLE,
        "short_edges": WHOLE,
    }

    vertices: int
    """Number of given vertices."""
    triangles: int
    """Number of given triangles."""
    particles: int
    """Number of resulting particles."""
    kept_triangles: int
    """Number of triangles that were kept."""
    welded_vertices: int
    """Number of vertices that share the particle of another vertex."""
    dropped_degenerate: int
    """Number of dropped triangles that had no area or used a vertex twice."""
    dropped_duplicates: int
    """Number of dropped triangles whose corners were those of an earlier one."""
    turned_triangles: int
    """Number of triangles that were turned to face as their neighbours do."""
    split_edges: int
    """Number of edges that had more than two triangles."""
    split_vertices: int
    """Number of particles that were added where sheets met at such an edge or at a single vertex.
    """
    unused_vertices: int
    """Number of vertices that no triangle uses. Unless they were welded, they are particles without
    mass that stay where they are.
    """
    pieces: int
    """Number of pieces: sets of triangles connected by edges."""
    one_sided_pieces: int
    """Number of pieces with only one side, such as a Moebius strip: along a line across them,
    neighbours face opposite ways.
    """
    is_grid: bool
    """Whether the mesh is simulated as a regular grid."""
    shortest_edge: float
    """Length of the shortest edge [m]."""
    mean_edge: float
    """Mean length of the edges [m]."""
    worst_aspect: float
    """Largest aspect ratio of a triangle: its longest edge divided by its least height. 1.15 with
    equal edges, 2 on a grid.
    """
    thin_triangles: int
    """Number of thin triangles: those with an aspect ratio above 100."""
    thinnest_triangle: int
    """The triangle with the largest aspect ratio, by its number among the given ones."""
    collapsed_edges: int
    """Number of edges below `simplify_below` that were collapsed; each removed a particle."""
    collapsed_triangles: int
    """Number of triangles that were removed with collapsed edges."""
    trimmed_triangles: int
    """Number of triangles that were removed at a border because they were lower than
    `simplify_below`.
    """
    flipped_edges: int
    """Number of edges that were flipped because a triangle was lower than `simplify_below`."""
    short_edges: int
    """Number of edges that are still shorter than `simplify_below`: to collapse them would change
    the topology, a border, a seam or a pin, or would turn a triangle over.
    """


@dataclass(frozen=True, kw_only=True)
class Stats(Record):
    """Statistics of a cloth."""

    _struct: ClassVar = MuslinStats
    _kinds: ClassVar[dict[str, Kind]] = {
        "particles": WHOLE, "triangles": WHOLE, "constraints": WHOLE, "active_constraints": WHOLE,
        "pieces": WHOLE, "ticks": WHOLE, "blend": NUMBER, "max_stretch": NUMBER,
        "mean_stretch": NUMBER, "kinetic_energy": NUMBER, "bytes": WHOLE, "seconds": STAGES,
        "over_stretched": WHOLE, "asleep": FLAG, "max_speed": NUMBER, "substeps": WHOLE,
        "held_inside": WHOLE, "free_inside": WHOLE, "crossings": WHOLE,
    }

    particles: int
    """Number of particles."""
    triangles: int
    """Number of triangles."""
    constraints: int
    """Number of links in the rest state."""
    active_constraints: int
    """Number of links that are intact now."""
    pieces: int
    """Number of pieces: sets of triangles connected by edges."""
    ticks: int
    """Ticks since the cloth was made or reset."""
    blend: float
    """Part of a tick that `Cloth.advance` has not simulated yet, from 0 to 1: the factor by which
    to blend from the positions of the last tick to the current ones when drawing.
    """
    max_stretch: float
    """Largest strain of a stretch link: 0.01 is 1 % above its rest length."""
    mean_stretch: float
    """Mean strain of the stretch links."""
    kinetic_energy: float
    """Kinetic energy [J]."""
    bytes: int
    """Approximate memory use [bytes]."""
    seconds: dict[str, float]
    """Time of each stage in the last call that ran ticks [s], by its name.

    Timing starts with the first `Cloth.stats` of a cloth; until then all entries are 0.
    """
    over_stretched: int
    """Number of links past `max_stretch` of `Settings`, which pins, grabs or anchors hold apart; 0
    without that limit.
    """
    asleep: bool
    """Whether the cloth sleeps, see `sleep_speed` of `Settings`."""
    max_speed: float
    """Speed of the fastest particle [m/s]."""
    substeps: int
    """Number of substeps of the last tick: `substeps` of `Settings`, or more where cloth and
    colliders moved fast relative to each other. A cloth that sleeps runs none and keeps the
    number.
    """
    held_inside: int
    """Number of particles that pins, attachments or grabs hold more than 0.1 mm inside a collider.
    Nothing is inside a triangle mesh, which has two sides.
    """
    free_inside: int
    """Number of other particles more than 0.1 mm inside a collider."""
    crossings: int
    """Number of crossings: pairs of an edge of the cloth and a triangle that it passes through, as
    found in the last tick; 0 without surface collision. A cloth without known crossings is
    tested in parts, all of it in 16 ticks.
    """
