"""Structs of the C library, by their names in C.

Generated from include/muslin.h. To write it again: MUSLIN_BLESS=1 cargo xtask python
"""

from ctypes import Array, Structure, c_float, c_size_t, c_uint32, c_uint64, c_void_p

from .constants import STAGE_SLOTS


class MuslinVec3(Structure):
    x: float
    y: float
    z: float
    _fields_ = [("x", c_float), ("y", c_float), ("z", c_float)]


class MuslinMaterial(Structure):
    struct_size: int
    density: float
    thickness: float
    stretch_stiffness_warp: float
    stretch_stiffness_weft: float
    shear_stiffness: float
    bend_stiffness: float
    bend_damping: float
    stretch_damping: float
    friction: float
    restitution: float
    drag: float
    lift: float
    tear_stretch: float
    tear_variation: float
    yield_angle: float
    yield_creep: float
    fold_length: float
    yield_hardening: float
    yield_weakening: float
    _fields_ = [
        ("struct_size", c_uint32), ("density", c_float), ("thickness", c_float),
        ("stretch_stiffness_warp", c_float), ("stretch_stiffness_weft", c_float),
        ("shear_stiffness", c_float), ("bend_stiffness", c_float), ("bend_damping", c_float),
        ("stretch_damping", c_float), ("friction", c_float), ("restitution", c_float),
        ("drag", c_float), ("lift", c_float), ("tear_stretch", c_float),
        ("tear_variation", c_float), ("yield_angle", c_float), ("yield_creep", c_float),
        ("fold_length", c_float), ("yield_hardening", c_float), ("yield_weakening", c_float),
    ]


class MuslinSettings(Structure):
    struct_size: int
    tick: float
    substeps: int
    iterations: int
    max_ticks_per_advance: int
    gravity: MuslinVec3
    damping: float
    max_displacement: float
    max_stretch: float
    tethers: int
    self_collision: int
    self_distance: float
    tearing: int
    max_tears_per_tick: int
    sleep_speed: float
    pressure: float
    _fields_ = [
        ("struct_size", c_uint32), ("tick", c_float), ("substeps", c_uint32),
        ("iterations", c_uint32), ("max_ticks_per_advance", c_uint32), ("gravity", MuslinVec3),
        ("damping", c_float), ("max_displacement", c_float), ("max_stretch", c_float),
        ("tethers", c_uint32), ("self_collision", c_uint32), ("self_distance", c_float),
        ("tearing", c_uint32), ("max_tears_per_tick", c_uint32), ("sleep_speed", c_float),
        ("pressure", c_float),
    ]


class MuslinGridDesc(Structure):
    struct_size: int
    columns: int
    rows: int
    spacing: float
    origin: MuslinVec3
    right: MuslinVec3
    down: MuslinVec3
    pin_mode: int
    extra_particles: int
    material: MuslinMaterial
    settings: MuslinSettings
    _fields_ = [
        ("struct_size", c_uint32), ("columns", c_uint32), ("rows", c_uint32), ("spacing", c_float),
        ("origin", MuslinVec3), ("right", MuslinVec3), ("down", MuslinVec3), ("pin_mode", c_uint32),
        ("extra_particles", c_uint32), ("material", MuslinMaterial), ("settings", MuslinSettings),
    ]


class MuslinCloth(Structure):
    id: int
    _fields_ = [("id", c_uint64)]


class MuslinMeshDesc(Structure):
    struct_size: int
    positions: int | None
    position_stride: int
    vertex_count: int
    indices: int | None
    index_count: int
    uvs: int | None
    pinned: int | None
    pinned_count: int
    weld_distance: float
    extra_particles: int
    material: MuslinMaterial
    settings: MuslinSettings
    reserved: int
    simplify_below: float
    _fields_ = [
        ("struct_size", c_uint32), ("positions", c_void_p), ("position_stride", c_uint32),
        ("vertex_count", c_uint32), ("indices", c_void_p), ("index_count", c_uint32),
        ("uvs", c_void_p), ("pinned", c_void_p), ("pinned_count", c_uint32),
        ("weld_distance", c_float), ("extra_particles", c_uint32), ("material", MuslinMaterial),
        ("settings", MuslinSettings), ("reserved", c_uint32), ("simplify_below", c_float),
    ]


class MuslinWind(Structure):
    struct_size: int
    model: int
    velocity: MuslinVec3
    gust: float
    wander: float
    turbulence: float
    air_density: float
    seed: int
    _fields_ = [
        ("struct_size", c_uint32), ("model", c_uint32), ("velocity", MuslinVec3), ("gust", c_float),
        ("wander", c_float), ("turbulence", c_float), ("air_density", c_float), ("seed", c_uint32),
    ]


class MuslinQuat(Structure):
    x: float
    y: float
    z: float
    w: float
    _fields_ = [("x", c_float), ("y", c_float), ("z", c_float), ("w", c_float)]


class MuslinAttachment(Structure):
    id: int
    _fields_ = [("id", c_uint32)]


class MuslinHit(Structure):
    struct_size: int
    triangle: int
    particle: int
    u: float
    v: float
    distance: float
    position: MuslinVec3
    normal: MuslinVec3
    _fields_ = [
        ("struct_size", c_uint32), ("triangle", c_uint32), ("particle", c_uint32), ("u", c_float),
        ("v", c_float), ("distance", c_float), ("position", MuslinVec3), ("normal", MuslinVec3),
    ]


class MuslinGrab(Structure):
    id: int
    _fields_ = [("id", c_uint32)]


class MuslinEvent(Structure):
    struct_size: int
    kind: int
    tick: int
    position: MuslinVec3
    particle_a: int
    particle_b: int
    vertex: int
    source: int
    count: int
    _fields_ = [
        ("struct_size", c_uint32), ("kind", c_uint32), ("tick", c_uint32), ("position", MuslinVec3),
        ("particle_a", c_uint32), ("particle_b", c_uint32), ("vertex", c_uint32),
        ("source", c_uint32), ("count", c_uint32),
    ]


class MuslinColliderDesc(Structure):
    struct_size: int
    shape: int
    position: MuslinVec3
    rotation: MuslinQuat
    friction: float
    restitution: float
    tangential_restitution: float
    thickness: float
    radius: float
    top_radius: float
    half_height: float
    half_extents: MuslinVec3
    spacing: float
    columns: int
    rows: int
    position_stride: int
    vertex_count: int
    index_count: int
    positions: int | None
    indices: int | None
    heights: int | None
    solid: float
    reserved: int
    _fields_ = [
        ("struct_size", c_uint32), ("shape", c_uint32), ("position", MuslinVec3),
        ("rotation", MuslinQuat), ("friction", c_float), ("restitution", c_float),
        ("tangential_restitution", c_float), ("thickness", c_float), ("radius", c_float),
        ("top_radius", c_float), ("half_height", c_float), ("half_extents", MuslinVec3),
        ("spacing", c_float), ("columns", c_uint32), ("rows", c_uint32),
        ("position_stride", c_uint32), ("vertex_count", c_uint32), ("index_count", c_uint32),
        ("positions", c_void_p), ("indices", c_void_p), ("heights", c_void_p), ("solid", c_float),
        ("reserved", c_uint32),
    ]


class MuslinCollider(Structure):
    id: int
    _fields_ = [("id", c_uint32)]


class MuslinView(Structure):
    struct_size: int
    positions: int | None
    normals: int | None
    uvs: int | None
    indices: int | None
    source_vertices: int | None
    vertex_count: int
    index_count: int
    vertex_capacity: int
    index_capacity: int
    topology_revision: int
    state_revision: int
    frayed: int | None
    particles: int | None
    _fields_ = [
        ("struct_size", c_uint32), ("positions", c_void_p), ("normals", c_void_p),
        ("uvs", c_void_p), ("indices", c_void_p), ("source_vertices", c_void_p),
        ("vertex_count", c_uint32), ("index_count", c_uint32), ("vertex_capacity", c_uint32),
        ("index_capacity", c_uint32), ("topology_revision", c_uint32), ("state_revision", c_uint32),
        ("frayed", c_void_p), ("particles", c_void_p),
    ]


class MuslinChanges(Structure):
    struct_size: int
    first_vertex: int
    vertex_count: int
    first_index: int
    index_count: int
    _fields_ = [
        ("struct_size", c_uint32), ("first_vertex", c_uint32), ("vertex_count", c_uint32),
        ("first_index", c_uint32), ("index_count", c_uint32),
    ]


class MuslinMeshReport(Structure):
    struct_size: int
    vertices: int
    triangles: int
    particles: int
    kept_triangles: int
    welded_vertices: int
    dropped_degenerate: int
    dropped_duplicates: int
    turned_triangles: int
    split_edges: int
    split_vertices: int
    unused_vertices: int
    pieces: int
    one_sided_pieces: int
    is_grid: int
    shortest_edge: float
    mean_edge: float
    worst_aspect: float
    thin_triangles: int
    thinnest_triangle: int
    collapsed_edges: int
    collapsed_triangles: int
    trimmed_triangles: int
    flipped_edges: int
    short_edges: int
    _fields_ = [
        ("struct_size", c_uint32), ("vertices", c_uint32), ("triangles", c_uint32),
        ("particles", c_uint32), ("kept_triangles", c_uint32), ("welded_vertices", c_uint32),
        ("dropped_degenerate", c_uint32), ("dropped_duplicates", c_uint32),
        ("turned_triangles", c_uint32), ("split_edges", c_uint32), ("split_vertices", c_uint32),
        ("unused_vertices", c_uint32), ("pieces", c_uint32), ("one_sided_pieces", c_uint32),
        ("is_grid", c_uint32), ("shortest_edge", c_float), ("mean_edge", c_float),
        ("worst_aspect", c_float), ("thin_triangles", c_uint32), ("thinnest_triangle", c_uint32),
        ("collapsed_edges", c_uint32), ("collapsed_triangles", c_uint32),
        ("trimmed_triangles", c_uint32), ("flipped_edges", c_uint32), ("short_edges", c_uint32),
    ]


class MuslinStats(Structure):
    struct_size: int
    particles: int
    triangles: int
    constraints: int
    active_constraints: int
    pieces: int
    ticks: int
    blend: float
    max_stretch: float
    mean_stretch: float
    kinetic_energy: float
    stage_count: int
    bytes: int
    seconds: Array[c_float]
    over_stretched: int
    asleep: int
    max_speed: float
    substeps: int
    held_inside: int
    free_inside: int
    crossings: int
    _fields_ = [
        ("struct_size", c_uint32), ("particles", c_uint32), ("triangles", c_uint32),
        ("constraints", c_uint32), ("active_constraints", c_uint32), ("pieces", c_uint32),
        ("ticks", c_uint32), ("blend", c_float), ("max_stretch", c_float),
        ("mean_stretch", c_float), ("kinetic_energy", c_float), ("stage_count", c_uint32),
        ("bytes", c_uint64), ("seconds", c_float * STAGE_SLOTS), ("over_stretched", c_uint32),
        ("asleep", c_uint32), ("max_speed", c_float), ("substeps", c_uint32),
        ("held_inside", c_uint32), ("free_inside", c_uint32), ("crossings", c_uint32),
    ]


class MuslinStream(Structure):
    struct_size: int
    attribute: int
    format: int
    stride: int
    buffer: int | None
    size: int
    _fields_ = [
        ("struct_size", c_uint32), ("attribute", c_uint32), ("format", c_uint32),
        ("stride", c_uint32), ("buffer", c_void_p), ("size", c_size_t),
    ]


class MuslinWriteDesc(Structure):
    struct_size: int
    first_vertex: int
    vertex_count: int
    blend: float
    transform: Array[c_float]
    flip_normals: int
    offset: float
    relative: int
    _fields_ = [
        ("struct_size", c_uint32), ("first_vertex", c_uint32), ("vertex_count", c_uint32),
        ("blend", c_float), ("transform", c_float * 12), ("flip_normals", c_uint32),
        ("offset", c_float), ("relative", c_uint32),
    ]


class MuslinSewDesc(Structure):
    struct_size: int
    speed: float
    kind: int
    tear_force: float
    _fields_ = [
        ("struct_size", c_uint32), ("speed", c_float), ("kind", c_uint32), ("tear_force", c_float),
    ]


class MuslinSkinDesc(Structure):
    struct_size: int
    positions: int | None
    stride: int
    vertex_count: int
    indices: int | None
    index_count: int
    uvs: int | None
    smoothness: float
    reserved: int
    _fields_ = [
        ("struct_size", c_uint32), ("positions", c_void_p), ("stride", c_uint32),
        ("vertex_count", c_uint32), ("indices", c_void_p), ("index_count", c_uint32),
        ("uvs", c_void_p), ("smoothness", c_float), ("reserved", c_uint32),
    ]


class MuslinSkin(Structure):
    id: int
    _fields_ = [("id", c_uint64)]
