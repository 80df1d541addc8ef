/* Muslin: deterministic cloth simulation.
 *
 * Generated from bindings/c. To write it again:
 *   MUSLIN_BLESS=1 cargo test -p muslin-c --test header
 *
 * From nothing to a first frame:
 *
 *   MuslinGridDesc desc;
 *   MuslinCloth cloth = {0};
 *   MuslinView view;
 *   muslin_grid_desc_init(&desc);
 *   muslin_view_init(&view);
 *   muslin_cloth_create_grid(&desc, &cloth);
 *   muslin_cloth_advance(cloth, 1.0f / 60.0f, NULL);
 *   muslin_cloth_view(cloth, &view);
 *   draw(view.positions, view.normals, view.vertex_count, view.indices, view.index_count);
 *   muslin_cloth_destroy(cloth);
 *
 * Units: metres, kilograms, seconds, radians. Right-handed axes; y is up by default (gravity is a
 * setting).
 *
 * Errors: a function that can fail returns a MuslinStatus. With any status but MUSLIN_STATUS_OK
 * the call changed nothing: neither the cloth nor the memory behind its out_... parameters.
 * muslin_last_error() returns a message that names the argument and the rule. Every function that
 * takes a cloth may return MUSLIN_STATUS_BAD_HANDLE, MUSLIN_STATUS_BUSY or MUSLIN_STATUS_PANICKED;
 * the comments list the other statuses.
 *
 * Structs: initialise every struct that has a struct_size with its muslin_..._init function. It
 * stores the size that your compiler knows and the defaults. So an old program runs with a newer
 * library, and a new program runs with an older library as long as it does not use fields that
 * this lacks.
 *
 * Pointers: NULL is allowed only where the comment says so; otherwise it gives
 * MUSLIN_STATUS_BAD_VALUE. The memory must be as large as the type, the count or the struct_size
 * says. It need not be aligned, except for the buffers of MuslinStream. The library keeps no
 * pointer after a call, except for those of muslin_set_log. Memory that the library lends stays
 * valid as long as the comment says.
 *
 * Threads: different cloths may be used on different threads at once. A call on a cloth that
 * another thread is using returns MUSLIN_STATUS_BUSY. Do not read memory borrowed from a cloth on
 * one thread while another thread changes that cloth.
 *
 * Determinism: the same calls give the same bits on every platform.
 */

#pragma once

#include <stddef.h>
#include <stdint.h>

/** A bug in Muslin interrupted a call. */
#define MUSLIN_LOG_ERROR 1

/** A call was refused. The message is that of muslin_last_error. */
#define MUSLIN_LOG_WARN 2

/** A cloth was created or destroyed. */
#define MUSLIN_LOG_INFO 3

/** Silk: light and fluid, 100 g/m^2. */
#define MUSLIN_PRESET_SILK 0

/** Cotton shirting, 180 g/m^2. */
#define MUSLIN_PRESET_COTTON 1

/** Denim: heavy twill, 380 g/m^2. */
#define MUSLIN_PRESET_DENIM 2

/** Garment leather, 700 g/m^2. */
#define MUSLIN_PRESET_LEATHER 3

/** Office paper, 80 g/m^2; keeps folds. */
#define MUSLIN_PRESET_PAPER 4

/** Flag nylon of 200 denier, 105 g/m^2. */
#define MUSLIN_PRESET_FLAG_NYLON 5

/**
 * Painted stiffness against stretch and shear. Links without compliance (a stiffness of 0) stay
 * rigid; at scale 0 other links do not resist.
 */
#define MUSLIN_MAP_STRETCH 0

/**
 * Painted bending rigidity; at scale 0 the cloth is limp. Does not act on a `bend_stiffness` from 1
 * on.
 */
#define MUSLIN_MAP_BEND 1

/**
 * Painted strength: the strain at which an edge tears, `tear_stretch` - 1. At scale 0 an edge tears
 * as soon as it is stretched at all; a large scale keeps it from tearing.
 */
#define MUSLIN_MAP_TEAR 2

/** Painted coefficient of friction of contacts with colliders and of surface self-collision. */
#define MUSLIN_MAP_FRICTION 3

/** Painted distance from colliders and between layers in self-collision. */
#define MUSLIN_MAP_THICKNESS 4

/** Painted drag coefficient; lift stays as it is. */
#define MUSLIN_MAP_DRAG 5

/** Value of `self_collision`: parts of the cloth pass through each other. */
#define MUSLIN_SELF_COLLISION_NONE 0

/**
 * Value of `self_collision`: triangles collide with triangles, so that no part of the surface
 * passes through another. With the material's friction.
 *
 * - Gap: the material's thickness, or `self_distance`, at most half of the mean rest length. Parts
 *   that are nearer than two gaps in the rest shape keep half of their rest distance.
 * - Tears: the two sides of a fresh tear are moved apart by 1/1000 of the mean rest length, so
 *   that they collide too.
 * - Pins and grabs: what they hold pushes other parts out of its way. Cloth that is caught between
 *   two held parts may be forced through.
 * - Existing intersections (at the start, after this is switched on, or where particles were
 *   placed) are untangled, unless they are held: the smaller part moves back to the side of the
 *   rest, mostly within a second.
 * - Cost: about as much as the rest of a tick while little touches; several times that where
 *   layers lie on each other; 20 to several hundred times where sheets of thousands of particles
 *   crumple.
 */
#define MUSLIN_SELF_COLLISION_SURFACE 1

/**
 * Value of `self_collision`: particles collide with particles, as if they were balls.
 *
 * - Cheap and without friction. A fold may pass through where particles are farther apart than
 *   `self_distance`.
 * - Two particles of one piece do not collide if their distance in the rest shape is below
 *   `self_distance` or 1.5 mean rest lengths. Pinned and grabbed particles do not collide.
 */
#define MUSLIN_SELF_COLLISION_PARTICLES 2

/** No particle is pinned: the cloth falls. */
#define MUSLIN_PIN_NONE 0

/** All particles of the first row are pinned. */
#define MUSLIN_PIN_TOP_EDGE 1

/** The two ends of the first row are pinned. */
#define MUSLIN_PIN_TOP_CORNERS 2

/** All four corners are pinned. */
#define MUSLIN_PIN_CORNERS 3

/**
 * Value of `extra_particles` that reserves as many particles again as the cloth starts with.
 */
#define MUSLIN_AS_MANY_AGAIN UINT32_MAX

/**
 * Aerodynamic forces on each triangle, proportional to the square of the relative air speed. Still
 * air damps the motion.
 */
#define MUSLIN_WIND_SURFACE 0

/**
 * A field of sine waves that accelerates each particle, independent of the direction of the
 * surface. The length of `velocity` is the strength [m/s^2].
 */
#define MUSLIN_WIND_SINE_FIELD 1

/** Half-space below `position` along the rotated y axis; infinite in extent. */
#define MUSLIN_SHAPE_PLANE 0

/** Sphere of `radius` around `position`. */
#define MUSLIN_SHAPE_SPHERE 1

/**
 * Capsule along the rotated y axis: spheres of `radius` at -`half_height` and of `top_radius` at
 * +`half_height`, and all between them (a tapered capsule if the radii differ).
 */
#define MUSLIN_SHAPE_CAPSULE 2

/** Box that extends by `half_extents` to either side of `position` along each rotated axis. */
#define MUSLIN_SHAPE_BOX 3

/** Convex hull of `positions`. */
#define MUSLIN_SHAPE_CONVEX 4

/**
 * Triangle mesh: the triangles of `indices` over `positions`.
 *
 * The cloth stays on the side where it is: both sides are outside. So the mesh need not be closed
 * or consistently wound. With `solid` a closed mesh pushes out what is inside. The gap is at least
 * 0.1 mm.
 */
#define MUSLIN_SHAPE_MESH 5

/**
 * Terrain: all below a surface over a grid of `columns` * `rows` heights.
 *
 * The heights are `spacing` apart along the rotated x and z axes, starting at `position`. The
 * terrain is as deep as it is wide, and has no side walls.
 */
#define MUSLIN_SHAPE_HEIGHTFIELD 6

/** The edge between `particle_a` and `particle_b` tore. */
#define MUSLIN_EVENT_EDGE_TORN 0

/**
 * `vertex` was split off from `source`.
 *
 * If a particle with several vertices was split between these vertices, no vertex had to be split:
 * then both are the lowest vertex that moved to the new particle.
 */
#define MUSLIN_EVENT_VERTEX_SPLIT 1

/** A piece of `count` triangles came off; `vertex` belongs to one of them. */
#define MUSLIN_EVENT_PIECE_DETACHED 2

/**
 * `count` particles had positions or velocities that were not finite, and were put back to their
 * last valid positions.
 */
#define MUSLIN_EVENT_RECOVERED 3

/**
 * Tearing stopped: the particles that `extra_particles` reserved are used up. Reported once.
 */
#define MUSLIN_EVENT_RESERVE_USED_UP 4

/**
 * Pins, grabs or anchors stretch the cloth past `max_stretch`: `count` links exceed it, one of
 * them between `particle_a` and `particle_b`. Reported once, until the limit holds again. Also for
 * `count` sewn pairs whose particles are both held apart.
 */
#define MUSLIN_EVENT_HELD_APART 5

/**
 * A cut added `vertex` on the edge between `particle_a` and `particle_b`.
 *
 * If the two sides of that edge have different vertices there, the next vertex belongs to the
 * other side.
 */
#define MUSLIN_EVENT_EDGE_DIVIDED 6

/**
 * Pins, attachments or grabs hold `count` particles inside a collider; `particle_a` is the first
 * of them. Reported once, until none is inside.
 */
#define MUSLIN_EVENT_HELD_INSIDE 7

/**
 * `count` particles that nothing holds are inside a collider; `particle_a` is the first of them.
 * Reported once, until none is inside.
 *
 * Other colliders or held cloth leave them no room, or they were placed there.
 */
#define MUSLIN_EVENT_FREE_INSIDE 8

/**
 * With surface collision, edges of the cloth pass through triangles of it: `count` pairs of both.
 * One of the edges is between `particle_a` and `particle_b`. Reported once, until none does.
 */
#define MUSLIN_EVENT_LAYERS_CROSS 9

/** The stitch between `particle_a` and `particle_b` tore, see muslin_cloth_sew. */
#define MUSLIN_EVENT_STITCH_TORN 10

/** Position [m]: x y z; in 16-bit formats x y z 1. */
#define MUSLIN_ATTRIBUTE_POSITION 0

/** Unit normal: x y z; in 16-bit formats x y z 0. */
#define MUSLIN_ATTRIBUTE_NORMAL 1

/**
 * Tangent: x y z w. The unit vector perpendicular to the normal in which texture coordinate u
 * grows; w is 1 or -1, and v grows along cross(normal, tangent) times w.
 *
 * It is the sum over the vertex's triangles of (p dv2 - q dv1) sign(du1 dv2 - du2 dv1), made
 * perpendicular to the normal. p and q are edges of the triangle; (du1, dv1) and (du2, dv2) are
 * the same edges in texture space. Where texture coordinates are degenerate, it is any
 * perpendicular direction.
 */
#define MUSLIN_ATTRIBUTE_TANGENT 2

/** Texture coordinates: u v. */
#define MUSLIN_ATTRIBUTE_UV 3

/**
 * 1 on a border that a tear or cut made, e.g. to draw fringes, else 0; in 16-bit formats followed
 * by 0.
 */
#define MUSLIN_ATTRIBUTE_FRAYED 4

/** 32-bit floats. Bytes: position and normal 12, tangent 16, uv 8, frayed 4. */
#define MUSLIN_FORMAT_F32 0

/**
 * 16-bit floats. Values beyond 65504 are clamped. Bytes: position, normal and tangent 8, uv and
 * frayed 4.
 */
#define MUSLIN_FORMAT_F16 1

/**
 * Signed 16-bit integers; -32767 to 32767 stand for -1 to 1. Bytes: normal and tangent 8, frayed
 * 4. Not for other attributes.
 */
#define MUSLIN_FORMAT_SNORM16 2

/**
 * Unit vectors in octahedral encoding, as two 16-bit integers like MUSLIN_FORMAT_SNORM16. Bytes:
 * normal 4, tangent 8 (u, v, w and 0). Not for other attributes.
 *
 * The vector is projected onto the octahedron |x| + |y| + |z| = 1. The encoding is x and y, with
 * the lower half (z < 0) folded outward to (1 - |y|) sign(x) and (1 - |x|) sign(y).
 */
#define MUSLIN_FORMAT_OCTAHEDRAL16 3

/** Largest number of streams in one call. */
#define MUSLIN_MAX_STREAMS 16

/** Value of `vertex_count` that means all vertices from `first_vertex` on. */
#define MUSLIN_ALL_VERTICES UINT32_MAX

/** Length of `seconds` in MuslinStats. `stage_count` says how many entries are used. */
#define MUSLIN_STAGE_SLOTS 31

/** Value of `kind`: as if woven in one piece. It never tears, and normals are smooth across. */
#define MUSLIN_SEW_WELD 0

/**
 * Value of `kind`: a thread. It tears under more than `tear_force`, and keeps the normals of both
 * sides apart.
 */
#define MUSLIN_SEW_STITCH 1

/**
 * Result of a call.
 *
 * With any status but MUSLIN_STATUS_OK, the call changed neither the cloth nor the memory behind
 * its `out_...` parameters, and muslin_last_error() returns a message that names the argument and
 * the rule.
 */
typedef enum MuslinStatus {
  /** The call succeeded. */
  MUSLIN_STATUS_OK = 0,
  /** An argument or field is NULL, out of range, not finite, or inconsistent with another one. */
  MUSLIN_STATUS_BAD_VALUE = 1,
  /** An index is not below the number of particles, vertices or points. */
  MUSLIN_STATUS_BAD_INDEX = 2,
  /**
   * A handle of a cloth, grab, attachment or collider is stale, made up or from another cloth.
   */
  MUSLIN_STATUS_BAD_HANDLE = 3,
  /** The mesh cannot be made into cloth, even after repair. */
  MUSLIN_STATUS_BAD_MESH = 4,
  /** The bytes are not a saved cloth, come from another format version, or are damaged. */
  MUSLIN_STATUS_BAD_SAVE = 5,
  /**
   * A limit on the number of items is reached, or the reserve for tears and cuts
   * (`extra_particles`) is used up.
   */
  MUSLIN_STATUS_FULL = 6,
  /** This version does not support the requested value or struct version. */
  MUSLIN_STATUS_UNSUPPORTED = 7,
  /** Another thread is using the cloth. The call did nothing; try again. */
  MUSLIN_STATUS_BUSY = 8,
  /** The caller's buffer is too small. */
  MUSLIN_STATUS_BUFFER_TOO_SMALL = 9,
  /** The ray hits nothing. Not an error, so it is not logged. */
  MUSLIN_STATUS_NOTHING_HIT = 10,
  /**
   * The edge did not tear: both ends are pinned or grabbed, or it is a border edge. Not an
   * error, so it is not logged.
   */
  MUSLIN_STATUS_NOT_TORN = 11,
  /**
   * A bug in Muslin interrupted the call; please report it. The cloth is unusable: the only call
   * that it still accepts is muslin_cloth_destroy.
   */
  MUSLIN_STATUS_PANICKED = 12,
} MuslinStatus;

/**
 * Function of the host that receives log messages.
 *
 * `level` is one of MUSLIN_LOG_...; `message` is valid during the call only; `user` is the pointer
 * that was passed to muslin_set_log.
 */
typedef void (*MuslinLogFn)(uint32_t level, const char *message, void *user);

/** A point, direction or velocity. */
typedef struct MuslinVec3 {
  /** x component. */
  float x;
  /** y component. */
  float y;
  /** z component. */
  float z;
} MuslinVec3;

/**
 * Material of a cloth, in SI units. Every field may be changed between ticks.
 *
 * Initialise it with muslin_material_init; muslin_material_preset then sets the values of a
 * fabric.
 */
typedef struct MuslinMaterial {
  /** Set by muslin_material_init. */
  uint32_t struct_size;
  /** Mass per area [kg/m^2]. Default 0.18 (cotton). Above 0. */
  float density;
  /**
   * Gap that the cloth keeps from anything it touches [m]. Default 0.00035. At least 0. Choose
   * less than half of the shortest edge.
   */
  float thickness;
  /**
   * Membrane stiffness along the warp (the columns of a grid) [N/m]. Default 0: as stiff as the
   * solver reaches. At least 0.
   */
  float stretch_stiffness_warp;
  /**
   * Membrane stiffness along the weft (the rows of a grid) [N/m]. Default 0: as stiff as the
   * solver reaches. At least 0.
   */
  float stretch_stiffness_weft;
  /** Shear stiffness [N/m]. Default 0: the stretch stiffness. At least 0. */
  float shear_stiffness;
  /**
   * Bending rigidity per width [N m]. Default 2.5e-5. At least 0.
   *
   * - It is the value that a strip hanging from a clamp shows (BS 3356), independent of mesh
   *   resolution, tick, substeps and iterations, and of the direction in which the strip is cut:
   *   exactly on grids, to 1/20 of the bending length on other meshes.
   * - 0 is limp.
   * - 1 or more uses links over two cells instead, as rigid as the solver reaches.
   */
  float bend_stiffness;
  /**
   * Damping of bending [s]. Default 0. At least 0. Bending at some angle per second is resisted
   * like this angle times `bend_damping`; a few hundredths stop a flutter.
   */
  float bend_damping;
  /**
   * Damping of stretching [s], in the same way, for links that have a stiffness. Default 0. At
   * least 0.
   */
  float stretch_damping;
  /**
   * Coulomb friction coefficient against colliders and between layers. Default 0.4. At least 0.
   */
  float friction;
  /** Share of the normal velocity that a bounce returns. Default 0. From 0 to 1. */
  float restitution;
  /** Drag coefficient of a triangle perpendicular to the wind. Default 1.2. At least 0. */
  float drag;
  /** Lift coefficient of a triangle oblique to the wind. Default 0. At least 0. */
  float lift;
  /**
   * Ratio of length to rest length at which an edge tears. Default 4. Above 1, or 0: never.
   *
   * At a crack tip a smaller strain suffices: sqrt(16 thickness / mean edge) of it, at least
   * 1/5. On a finer mesh the load is more concentrated there; with this factor, a crack grows at
   * the same load on any mesh.
   */
  float tear_stretch;
  /**
   * Variation of the tear limit between edges. Default 0.2. From 0 (all edges alike) to 1 (the
   * limit varies by half).
   */
  float tear_variation;
  /**
   * Angle up to which a fold opens again completely [rad]; of a sharper fold, the excess stays.
   * Default 0: folds never stay. At least 0. Paper has about 0.8.
   */
  float yield_angle;
  /** Share of the excess over `yield_angle` that stays. Default 1. From 0 to 1. */
  float yield_creep;
  /**
   * Length of cloth over which bending counts as one fold [m]. Default 0.01. At least 0; at
   * least three cells are used.
   *
   * The same angle spread over a greater length is only a bend; a bend stays if its curvature
   * exceeds `yield_angle` / `fold_length`.
   */
  float fold_length;
  /**
   * Growth of the yield angle with accumulated yielding (in either direction). Default 0. At
   * least 0.
   *
   * Of a first fold by some angle, (angle - `yield_angle`) / (1 + `yield_hardening`) stays, and
   * folding it further needs as much more. Yielding and creases are not counted while this and
   * `yield_weakening` are 0.
   */
  float yield_hardening;
  /**
   * Loss of bending stiffness with accumulated yielding [1/rad]. Default 0. At least 0.
   *
   * After yielding by an angle in total (in either direction), `fold_length` of the cloth bends
   * as if `bend_stiffness` were divided by 1 + `yield_weakening` * angle, at most by 1000;
   * pressing the fold flat does not restore it. The moment at which it yields stays the same, so
   * the fold opens further: `yield_angle` * `yield_weakening` adds to `yield_hardening`.
   */
  float yield_weakening;
} MuslinMaterial;

/**
 * Settings of the simulation: time steps, gravity, damping and solver options. Every field may be
 * changed between ticks. Initialise it with muslin_settings_init.
 *
 * A tick is divided into `substeps`. Each substep predicts the positions and then solves all
 * constraints `iterations` times. More of either makes the cloth stiffer; at the same cost,
 * substeps stiffen it more than iterations.
 */
typedef struct MuslinSettings {
  /** Set by muslin_settings_init. */
  uint32_t struct_size;
  /** Length of a tick [s]. Default 1/60. Above 0, at most 1. */
  float tick;
  /**
   * Least number of substeps per tick. Default 4. From 1 to 1000.
   *
   * Where cloth and colliders move fast relative to each other, a tick runs up to 8 times as
   * many, but not more than 64 unless this is larger. See `substeps` of MuslinStats.
   */
  uint32_t substeps;
  /**
   * Solver iterations per substep, in alternating order. Default 2. From 1 to 1000.
   *
   * With 1, the time integration is of first order, which damps all motion. From 2 on it is of
   * second order; then only `damping` and the air damp.
   */
  uint32_t iterations;
  /**
   * Largest number of ticks of one muslin_cloth_advance; the rest of the backlog is dropped.
   * Default 5. At least 1.
   */
  uint32_t max_ticks_per_advance;
  /** Gravitational acceleration [m/s^2]. Default 0, -9.81, 0. */
  MuslinVec3 gravity;
  /**
   * Rate at which velocities decay [1/s], as exp(-`damping` t), independent of the step. Default
   * 0.5. At least 0.
   */
  float damping;
  /**
   * Largest displacement of a particle per substep, relative to the rigid motion of the cloth,
   * in mean rest lengths. Default 0.5. Above 0. It also limits the speed of a grabbed particle.
   */
  float max_displacement;
  /**
   * Strain limit: the largest strain of any stretch or shear link after a tick, unless pins,
   * grabs or anchors hold it apart. Default 0: no limit. 0.02 is 2 %. At least 0.
   */
  float max_stretch;
  /**
   * 1: tethers (long-range attachments) keep every particle within its rest distance of the
   * pins; 0: no tethers. Default 1.
   *
   * Tethers carry the load that the iterations do not reach; they do not resist the stretch of
   * links that have a stiffness. From 2 iterations on, whole chains of links are solved at once
   * as well.
   */
  uint32_t tethers;
  /**
   * Self-collision: MUSLIN_SELF_COLLISION_NONE (default), MUSLIN_SELF_COLLISION_SURFACE or
   * MUSLIN_SELF_COLLISION_PARTICLES.
   */
  uint32_t self_collision;
  /**
   * Gap of self-collision [m]. Default 0.
   *
   * - Surface: 0 means the material's thickness. At most half of the mean rest length.
   * - Particles: 0 means 2/3 of the mean rest length. At most twice the mean rest length.
   */
  float self_distance;
  /**
   * 1: links that are stretched past `tear_stretch` of MuslinMaterial tear; 0: they do not.
   * Default 0.
   */
  uint32_t tearing;
  /**
   * Largest number of vertices that tearing splits per tick; the most stretched come first.
   * Default 8. At least 1.
   */
  uint32_t max_tears_per_tick;
  /**
   * Speed below which the cloth falls asleep [m/s]. Default 0: never. At least 0.
   *
   * A cloth whose particles were all slower for half a second stops moving, at almost no cost,
   * until something changes or touches it. Gusts, turbulence and MUSLIN_WIND_SINE_FIELD keep it
   * awake. See `asleep` of MuslinStats.
   */
  float sleep_speed;
  /**
   * Over-pressure inside closed pieces of the cloth [Pa]. Default 0. Finite.
   *
   * A piece is closed if each of its edges has two triangles, as in a ball or a cushion, or if all
   * of its border is sewn to closed pieces (muslin_cloth_sew). The pressure is constant, whatever
   * the volume; a negative one sucks the sides inwards, as a vacuum does. Outwards is where the volume of the rest shape is positive, whatever the winding. A
   * piece that is torn or cut open loses its pressure at once. Open cloth, such as a grid, feels
   * none.
   *
   * Links stretch under high pressure unless `max_stretch` limits them. Where the pressure alone
   * would move a particle of a piece by more than `max_displacement` in a substep, all of that
   * piece gets less.
   */
  float pressure;
} MuslinSettings;

/**
 * A regular grid of particles. The particle at `row` and `column` has the index `row * columns +
 * column`. Initialise it with muslin_grid_desc_init.
 *
 * `material` and `settings` have sizes of their own: replace them only by structs that were
 * initialised with muslin_material_init and muslin_settings_init in the same program.
 */
typedef struct MuslinGridDesc {
  /** Set by muslin_grid_desc_init. */
  uint32_t struct_size;
  /** Particles per row. Default 40. At least 2. */
  uint32_t columns;
  /** Number of rows. Default 40. At least 2. A grid has at most 4194304 particles. */
  uint32_t rows;
  /** Distance between neighbours [m]. Default 0.05. From 1e-6 to 1e6. */
  float spacing;
  /**
   * Position of particle (0, 0), the top left corner [m]. Default 0, 0, 0. Within 2097152 times
   * `spacing` of zero along each axis.
   */
  MuslinVec3 origin;
  /** Unit direction along a row. Default 1, 0, 0. */
  MuslinVec3 right;
  /** Unit direction along a column, perpendicular to `right`. Default 0, -1, 0. */
  MuslinVec3 down;
  /**
   * Particles that are pinned from the start: MUSLIN_PIN_NONE, MUSLIN_PIN_TOP_EDGE (default),
   * MUSLIN_PIN_TOP_CORNERS or MUSLIN_PIN_CORNERS.
   */
  uint32_t pin_mode;
  /**
   * Particles to reserve for tears and cuts. Default MUSLIN_AS_MANY_AGAIN; 0 if the cloth never
   * tears.
   */
  uint32_t extra_particles;
  /** Material. */
  MuslinMaterial material;
  /** Settings. */
  MuslinSettings settings;
} MuslinGridDesc;

/**
 * Handle of a cloth. { 0 } is none. A stale or made-up handle gives MUSLIN_STATUS_BAD_HANDLE.
 */
typedef struct MuslinCloth {
  /** Identifies the cloth; opaque. */
  uint64_t id;
} MuslinCloth;

/**
 * Any triangle mesh, as modelling tools export them. Initialise it with muslin_mesh_desc_init,
 * then set positions and indices.
 *
 * Defects are repaired in this order; muslin_cloth_get_mesh_report counts the repairs:
 * - duplicate vertices are welded (see `weld_distance`);
 * - triangles without an area and repeated triangles are dropped;
 * - where more than two triangles share an edge, the flattest pair stays joined and the others get
 *   an edge of their own;
 * - sheets that touch in a single vertex are separated there;
 * - within each piece, triangles are turned to face as most of them do;
 * - if `simplify_below` is above 0, short edges are collapsed.
 *
 * Vertices that no triangle uses stay where they are.
 *
 * A mesh that is a regular grid, with vertices and triangles in the order of
 * muslin_cloth_create_grid, is simulated as that grid, with identical bits.
 *
 * All lists are copied during the call. `material` and `settings` have sizes of their own: replace
 * them only by structs that were initialised with muslin_material_init and muslin_settings_init in
 * the same program.
 */
typedef struct MuslinMeshDesc {
  /** Set by muslin_mesh_desc_init. */
  uint32_t struct_size;
  /**
   * Rest positions of the vertices [m], 3 numbers per vertex. If nothing is welded, split
   * or collapsed, vertex i is particle i; otherwise see `particles` of MuslinView.
   */
  const float *positions;
  /**
   * Distance between the starts of consecutive positions [bytes]; 0 means 12. Default 0. A
   * multiple of 4.
   */
  uint32_t position_stride;
  /** Number of vertices. Default 0. From 3 to 4194304. */
  uint32_t vertex_count;
  /** Vertices of the triangles, 3 per triangle, counter-clockwise seen from the front. */
  const uint32_t *indices;
  /** Number of indices. Default 0. A multiple of 3, at most 50331648. */
  uint32_t index_count;
  /** Texture coordinates, 2 numbers per vertex, or NULL for none. */
  const float *uvs;
  /** Vertices whose particles are pinned from the start, or NULL for none. */
  const uint32_t *pinned;
  /** Number of entries of `pinned`. Default 0. At most `vertex_count`. */
  uint32_t pinned_count;
  /**
   * Vertices at most this far apart share one particle [m]. Default -1.
   *
   * 0 welds vertices at exactly the same position; a negative value welds nothing. Vertices are
   * processed in order: each joins the nearest earlier vertex that was not welded itself.
   * Corners of one triangle are never welded together. Choose a value well below the shortest
   * edge.
   */
  float weld_distance;
  /**
   * Particles to reserve for tears and cuts. Default MUSLIN_AS_MANY_AGAIN; 0 if the cloth never
   * tears.
   */
  uint32_t extra_particles;
  /** Material. */
  MuslinMaterial material;
  /** Settings. */
  MuslinSettings settings;
  /** Not used. Default 0. */
  uint32_t reserved;
  /**
   * Edges shorter than this are collapsed [m]. Default 0: none. At most the mean length of the
   * edges.
   *
   * One end of such an edge moves to the other, with its vertices, and the triangles at the edge
   * are removed. Triangles that are lower than this get another diagonal where that makes them
   * higher. Borders, seams of texture coordinates and their corners stay, a pinned vertex moves
   * to pinned ones only, and the topology stays; `short_edges` of MuslinMeshReport counts the
   * edges that are short nevertheless. A tenth to a third of the mean edge removes the slivers
   * of most meshes.
   */
  float simplify_below;
} MuslinMeshDesc;

/**
 * The air around a cloth: steady wind with gusts, changing direction and turbulence. Equal seeds
 * give equal gusts. Initialise it with muslin_wind_init, which describes still air.
 */
typedef struct MuslinWind {
  /** Set by muslin_wind_init. */
  uint32_t struct_size;
  /** Model: MUSLIN_WIND_SURFACE (default) or MUSLIN_WIND_SINE_FIELD. */
  uint32_t model;
  /** Mean velocity of the air [m/s]. Default 0, 0, 0. */
  MuslinVec3 velocity;
  /** Variation of the speed over time, as a share of it. Default 0. From 0 to 1. */
  float gust;
  /** Variation of the direction over time [rad]. Default 0. From 0 to pi. */
  float wander;
  /** Variation of the air velocity in space, as a share of the speed. Default 0. From 0 to 1. */
  float turbulence;
  /** Density of the air [kg/m^3]. Default 1.2. At least 0; 0 is a vacuum. */
  float air_density;
  /** Selects the sequence of gusts and turbulence. Default 0. */
  uint32_t seed;
} MuslinWind;

/** A rotation as a unit quaternion. { 0, 0, 0, 1 } is no rotation. */
typedef struct MuslinQuat {
  /** Axis x times the sine of half the angle. */
  float x;
  /** Axis y times the sine of half the angle. */
  float y;
  /** Axis z times the sine of half the angle. */
  float z;
  /** Cosine of half the angle. */
  float w;
} MuslinQuat;

/**
 * Handle of an attachment: a transform that carries particles. { 0 } is none. Valid for the cloth
 * that returned it and for cloths restored from it.
 */
typedef struct MuslinAttachment {
  /** Identifies the attachment; opaque. */
  uint32_t id;
} MuslinAttachment;

/** Where a ray hits a cloth. Initialise it with muslin_hit_init. */
typedef struct MuslinHit {
  /** Set by muslin_hit_init. */
  uint32_t struct_size;
  /** Triangle that was hit: its corners are the indices 3 * triangle and the two after it. */
  uint32_t triangle;
  /** Corner particle nearest to the hit. */
  uint32_t particle;
  /** Barycentric weight of the triangle's second corner. */
  float u;
  /** Barycentric weight of the triangle's third corner. */
  float v;
  /** Distance from the ray's origin [m]. */
  float distance;
  /** Point of the hit [m]. */
  MuslinVec3 position;
  /** Unit normal of the triangle, on the side that was hit. */
  MuslinVec3 normal;
} MuslinHit;

/**
 * Handle of a grab of one particle. { 0 } is none. Valid for the cloth that returned it and for
 * cloths restored from it.
 */
typedef struct MuslinGrab {
  /** Identifies the grab; opaque. */
  uint32_t id;
} MuslinGrab;

/**
 * An event. Fields that its kind does not mention are 0. Initialise it with muslin_event_init.
 *
 * `particle_a` and `particle_b` are particles, `vertex` and `source` are vertices; see `particles`
 * of MuslinView.
 */
typedef struct MuslinEvent {
  /** Set by muslin_event_init. */
  uint32_t struct_size;
  /** Kind: one of MUSLIN_EVENT_.... */
  uint32_t kind;
  /** Tick of the event, counted from creation or reset. */
  uint32_t tick;
  /** Position of the event [m]. */
  MuslinVec3 position;
  /** First end of the edge, or the particle. */
  uint32_t particle_a;
  /** Second end of the edge. */
  uint32_t particle_b;
  /** The new vertex. */
  uint32_t vertex;
  /** The vertex that the new one was split off from. */
  uint32_t source;
  /** Number of triangles, particles, links or pairs. */
  uint32_t count;
} MuslinEvent;

/**
 * Descriptor of a collider: shape, pose and surface properties. Initialise it with
 * muslin_collider_desc_init, which describes a floor at height 0.
 *
 * Fields that the shape does not use are ignored. All lists are copied when the collider is added.
 */
typedef struct MuslinColliderDesc {
  /** Set by muslin_collider_desc_init. */
  uint32_t struct_size;
  /** Shape: one of MUSLIN_SHAPE_.... Default MUSLIN_SHAPE_PLANE. */
  uint32_t shape;
  /** Position [m]; for a plane, a point on its surface. Default 0, 0, 0. */
  MuslinVec3 position;
  /** Rotation, a unit quaternion; a plane's normal is the rotated y axis. Default: none. */
  MuslinQuat rotation;
  /** Coulomb friction coefficient. Default -1: that of the material. Otherwise at least 0. */
  float friction;
  /**
   * Share of the normal velocity that a bounce returns. Default -1: that of the material.
   * Otherwise from 0 to 1.
   */
  float restitution;
  /**
   * Share of the tangential velocity that remains after each substep in contact, in addition to
   * Coulomb friction. Default 1 (all of it). From 0 to 1.
   */
  float tangential_restitution;
  /**
   * Gap between cloth and surface [m]. Default -1: the material's thickness. Otherwise at least
   * 0.
   *
   * On surfaces that are round or slightly curved, particles keep a larger gap, so that the
   * triangles between them do not sink in: up to 1/5 of the mean edge for spheres and capsules,
   * 1/10 for other shapes.
   */
  float thickness;
  /** Radius of a sphere or capsule [m]. Default 0.5. Above 0. */
  float radius;
  /** Radius of the upper end of a capsule [m]. Default -1: `radius`. Otherwise above 0. */
  float top_radius;
  /**
   * Capsule: distance from its centre to the centres of its ends [m]. Default 0.5. At least 0.
   */
  float half_height;
  /** Box: distance from its centre to its sides [m]. Default 0.5 each. Above 0. */
  MuslinVec3 half_extents;
  /** Heightfield: distance between neighbouring heights [m]. Default 1. Above 0. */
  float spacing;
  /** Heightfield: number of heights along x. Default 0. From 2 to 4096. */
  uint32_t columns;
  /** Heightfield: number of heights along z. Default 0. From 2 to 4096. */
  uint32_t rows;
  /**
   * Distance between the starts of consecutive positions [bytes]; 0 means 12. Default 0. A
   * multiple of 4.
   */
  uint32_t position_stride;
  /**
   * Number of positions. Default 0. From 4 to 1024 for a convex hull, at most 4194304 for a
   * mesh.
   */
  uint32_t vertex_count;
  /** Number of indices. Default 0. A multiple of 3, at most 50331648. */
  uint32_t index_count;
  /** Convex hull or mesh: points [m], 3 numbers each. */
  const float *positions;
  /** Mesh: 3 points per triangle. Triangles without an area are ignored. */
  const uint32_t *indices;
  /** Heightfield: `columns` * `rows` heights [m], row by row along x. */
  const float *heights;
  /**
   * Mesh: largest depth from which particles inside are pushed out [m]. Default 0: both sides of its
   * triangles are outside. At least 0 and below 1e6.
   *
   * Above 0 the mesh must be closed and consistently wound: every edge in two triangles, once in
   * each direction. Normals may point inward or outward. Particles move towards the closest point of
   * the surface at 0.05 m/s. Each tick makes one closest-point query per particle in the bounds of
   * the mesh.
   */
  float solid;
  /** Not used. Default 0. */
  uint32_t reserved;
} MuslinColliderDesc;

/**
 * Handle of a collider. { 0 } is none. Valid for the cloth that returned it and for cloths
 * restored from it.
 */
typedef struct MuslinCollider {
  /** Identifies the collider; opaque. */
  uint32_t id;
} MuslinCollider;

/**
 * Output lists of a cloth, borrowed from the library's own memory. Read only. Initialise it with
 * muslin_view_init.
 *
 * The pointers and the data behind them stay valid until the next call that changes the cloth
 * (advance, step, reset, pin, set_position, tear_edge, cut, destroy and others).
 *
 * Vertices are drawn; particles are simulated. See `particles` for their relation.
 */
typedef struct MuslinView {
  /** Set by muslin_view_init. */
  uint32_t struct_size;
  /** Positions [m], 3 numbers per vertex. */
  const float *positions;
  /**
   * Unit normals, weighted by triangle area, 3 numbers per vertex; zeros for a vertex that no
   * triangle uses. Vertices of the same particle share its normal.
   */
  const float *normals;
  /** Texture coordinates, 2 numbers per vertex. */
  const float *uvs;
  /** Vertices of the triangles, 3 per triangle, counter-clockwise seen from the front. */
  const uint32_t *indices;
  /**
   * Vertex of the descriptor that each vertex came from; for a vertex that a cut added on an
   * edge, that of the nearer end.
   */
  const uint32_t *source_vertices;
  /** Number of vertices. */
  uint32_t vertex_count;
  /** Number of indices, 3 per triangle. */
  uint32_t index_count;
  /** Largest number of vertices that the cloth may ever have. */
  uint32_t vertex_capacity;
  /** Largest number of indices that the cloth may ever have. */
  uint32_t index_capacity;
  /** Changes whenever the indices change. */
  uint32_t topology_revision;
  /** Changes whenever positions change. */
  uint32_t state_revision;
  /**
   * 1 byte per vertex: 1 on a border that a tear or cut made, e.g. to draw fringes; else 0, also
   * on borders of the original cloth.
   */
  const uint8_t *frayed;
  /**
   * Particle of each vertex. A mesh that was welded, or whose sheets were separated, has several
   * vertices per particle; otherwise vertex i is particle i.
   *
   * Calls that act on the cloth (pins, grabs, tears, positions and velocities) take particles,
   * and a ray hit returns one. In an event, `particle_a` and `particle_b` are particles,
   * `vertex` and `source` are vertices. Triangles have the same numbers in both.
   */
  const uint32_t *particles;
} MuslinView;

/**
 * Ranges of a cloth's output lists that changed since a topology revision: what a renderer must
 * upload again. Initialise it with muslin_changes_init.
 *
 * The vertex range concerns the attributes that stay constant between topology changes: texture
 * coordinates, source vertices, particles and frayed borders. Positions and normals change with
 * every tick.
 */
typedef struct MuslinChanges {
  /** Set by muslin_changes_init. */
  uint32_t struct_size;
  /** First changed vertex; 0 if there is none. */
  uint32_t first_vertex;
  /** Number of vertices in the changed range. */
  uint32_t vertex_count;
  /** First changed index; 0 if there is none. */
  uint32_t first_index;
  /** Number of indices in the changed range. */
  uint32_t index_count;
} MuslinChanges;

/**
 * What was repaired in a mesh before it became cloth, and the quality of the result. Initialise it
 * with muslin_mesh_report_init.
 *
 * Repairs are made in this order: vertices are welded; triangles without an area and repeated
 * triangles are dropped; edges and vertices where several sheets meet are split; triangles that
 * face the other way are turned; short edges are collapsed.
 */
typedef struct MuslinMeshReport {
  /** Set by muslin_mesh_report_init. */
  uint32_t struct_size;
  /** Number of given vertices. */
  uint32_t vertices;
  /** Number of given triangles. */
  uint32_t triangles;
  /** Number of resulting particles. */
  uint32_t particles;
  /** Number of triangles that were kept. */
  uint32_t kept_triangles;
  /** Number of vertices that share the particle of another vertex. */
  uint32_t welded_vertices;
  /** Number of dropped triangles that had no area or used a vertex twice. */
  uint32_t dropped_degenerate;
  /** Number of dropped triangles whose corners were those of an earlier one. */
  uint32_t dropped_duplicates;
  /** Number of triangles that were turned to face as their neighbours do. */
  uint32_t turned_triangles;
  /** Number of edges that had more than two triangles. */
  uint32_t split_edges;
  /**
   * Number of particles that were added where sheets met at such an edge or at a single vertex.
   */
  uint32_t split_vertices;
  /**
   * Number of vertices that no triangle uses. Unless they were welded, they are particles
   * without mass that stay where they are.
   */
  uint32_t unused_vertices;
  /** Number of pieces: sets of triangles connected by edges. */
  uint32_t pieces;
  /**
   * Number of pieces with only one side, such as a Moebius strip: along a line across them,
   * neighbours face opposite ways.
   */
  uint32_t one_sided_pieces;
  /** 1 if the mesh is simulated as a regular grid, else 0. */
  uint32_t is_grid;
  /** Length of the shortest edge [m]. */
  float shortest_edge;
  /** Mean length of the edges [m]. */
  float mean_edge;
  /**
   * Largest aspect ratio of a triangle: its longest edge divided by its least height. 1.15 with
   * equal edges, 2 on a grid.
   */
  float worst_aspect;
  /** Number of thin triangles: those with an aspect ratio above 100. */
  uint32_t thin_triangles;
  /** The triangle with the largest aspect ratio, by its number among the given ones. */
  uint32_t thinnest_triangle;
  /** Number of edges below `simplify_below` that were collapsed; each removed a particle. */
  uint32_t collapsed_edges;
  /** Number of triangles that were removed with collapsed edges. */
  uint32_t collapsed_triangles;
  /**
   * Number of triangles that were removed at a border because they were lower than
   * `simplify_below`.
   */
  uint32_t trimmed_triangles;
  /** Number of edges that were flipped because a triangle was lower than `simplify_below`. */
  uint32_t flipped_edges;
  /**
   * Number of edges that are still shorter than `simplify_below`: to collapse them would change
   * the topology, a border, a seam or a pin, or would turn a triangle over.
   */
  uint32_t short_edges;
} MuslinMeshReport;

/** Statistics of a cloth. Initialise it with muslin_stats_init. */
typedef struct MuslinStats {
  /** Set by muslin_stats_init. */
  uint32_t struct_size;
  /** Number of particles. */
  uint32_t particles;
  /** Number of triangles. */
  uint32_t triangles;
  /** Number of links in the rest state. */
  uint32_t constraints;
  /** Number of links that are intact now. */
  uint32_t active_constraints;
  /** Number of pieces: sets of triangles connected by edges. */
  uint32_t pieces;
  /** Ticks since the cloth was made or reset. */
  uint32_t ticks;
  /**
   * Part of a tick that muslin_cloth_advance has not simulated yet, from 0 to 1: the factor by
   * which to blend from the positions of the last tick to the current ones when drawing.
   */
  float blend;
  /** Largest strain of a stretch link: 0.01 is 1 % above its rest length. */
  float max_stretch;
  /** Mean strain of the stretch links. */
  float mean_stretch;
  /** Kinetic energy [J]. */
  float kinetic_energy;
  /** Number of used entries of `seconds`. */
  uint32_t stage_count;
  /** Approximate memory use [bytes]. */
  uint64_t bytes;
  /**
   * Time of each stage in the last call that ran ticks [s]; muslin_stage_name returns their
   * names.
   *
   * Timing starts with the first muslin_cloth_get_stats of a cloth; until then all entries are
   * 0.
   */
  float seconds[MUSLIN_STAGE_SLOTS];
  /**
   * Number of links past `max_stretch` of MuslinSettings, which pins, grabs or anchors hold
   * apart; 0 without that limit.
   */
  uint32_t over_stretched;
  /** 1 if the cloth sleeps, see `sleep_speed` of MuslinSettings; else 0. */
  uint32_t asleep;
  /** Speed of the fastest particle [m/s]. */
  float max_speed;
  /**
   * Number of substeps of the last tick: `substeps` of MuslinSettings, or more where cloth and
   * colliders moved fast relative to each other. A cloth that sleeps runs none and keeps the
   * number.
   */
  uint32_t substeps;
  /**
   * Number of particles that pins, attachments or grabs hold more than 0.1 mm inside a collider.
   * Nothing is inside a triangle mesh, which has two sides.
   */
  uint32_t held_inside;
  /** Number of other particles more than 0.1 mm inside a collider. */
  uint32_t free_inside;
  /**
   * Number of crossings: pairs of an edge of the cloth and a triangle that it passes through, as
   * found in the last tick; 0 without surface collision. A cloth without known crossings is
   * tested in parts, all of it in 16 ticks.
   */
  uint32_t crossings;
} MuslinStats;

/**
 * A destination for one vertex attribute. Initialise it with muslin_stream_init, or make it with
 * muslin_stream.
 *
 * Streams may share a buffer: interleaved at equal strides, or one after the other.
 */
typedef struct MuslinStream {
  /** Set by muslin_stream_init. Equal for all streams of a call. */
  uint32_t struct_size;
  /** Attribute: one of MUSLIN_ATTRIBUTE_.... Default MUSLIN_ATTRIBUTE_POSITION. */
  uint32_t attribute;
  /** Number format: one of MUSLIN_FORMAT_.... Default MUSLIN_FORMAT_F32. */
  uint32_t format;
  /**
   * Distance between the starts of consecutive vertices [bytes]. Default 0: tightly packed.
   * Otherwise a multiple of the component size (4 for MUSLIN_FORMAT_F32, else 2), at least the
   * size of the attribute.
   */
  uint32_t stride;
  /**
   * Address of the first vertex, aligned to the component size. Default NULL. Your own memory,
   * not that of a view.
   */
  void *buffer;
  /** Bytes from `buffer` to the end of the memory. Default 0. */
  size_t size;
} MuslinStream;

/**
 * Selects the vertices to write and how they are transformed. Initialise it with
 * muslin_write_desc_init, which selects all vertices, untransformed.
 */
typedef struct MuslinWriteDesc {
  /** Set by muslin_write_desc_init. */
  uint32_t struct_size;
  /** First vertex to write; it goes to the start of each stream. Default 0. */
  uint32_t first_vertex;
  /** Number of vertices to write. Default MUSLIN_ALL_VERTICES. */
  uint32_t vertex_count;
  /**
   * Time to draw, from 0 (last tick) to 1 (current tick). Default 1. Pass `blend` of MuslinStats
   * for smooth motion. Normals and tangents belong to the interpolated surface.
   */
  float blend;
  /**
   * Transform of the positions, applied after the offset: three rows of four numbers, so that x
   * becomes t[0] x + t[1] y + t[2] z + t[3]. Default: identity. A transform that takes a cloth
   * far from zero to a place near zero loses no digits. Normals stay perpendicular to the
   * surface and on their side of it; tangents stay in the surface.
   */
  float transform[12];
  /** 1 if normals point to the other side, e.g. for the back of the cloth. Default 0. */
  uint32_t flip_normals;
  /**
   * Distance by which positions are moved along the written normals [m]. Default 0. Half of the
   * thickness on either side gives the cloth a visible thickness.
   */
  float offset;
  /**
   * 1 if positions are relative to the origin of muslin_cloth_get_origin, also those that
   * `transform` applies to. Default 0: they are absolute.
   */
  uint32_t relative;
} MuslinWriteDesc;

/** How muslin_cloth_sew joins pairs of particles. Initialise it with muslin_sew_desc_init. */
typedef struct MuslinSewDesc {
  /** Set by muslin_sew_desc_init. */
  uint32_t struct_size;
  /** Speed at which the distance of each pair falls to zero [m/s]. Default 0.5. Above 0. */
  float speed;
  /** What joins the particles: MUSLIN_SEW_WELD (default) or MUSLIN_SEW_STITCH. */
  uint32_t kind;
  /**
   * Force on one pair above which a stitch tears [N], as the mean over a tick; 0 = never.
   * Default 0. At least 0. A weld ignores it.
   */
  float tear_force;
} MuslinSewDesc;

/**
 * A render mesh that follows a cloth. Initialise it with muslin_skin_desc_init, then set positions
 * and indices. All lists are copied during the call.
 */
typedef struct MuslinSkinDesc {
  /** Set by muslin_skin_desc_init. */
  uint32_t struct_size;
  /**
   * Positions of the vertices [m], 3 numbers per vertex, where the cloth is now. None may be
   * farther from the cloth than half the diagonal of the cloth's bounding box.
   */
  const float *positions;
  /**
   * Distance between the starts of consecutive positions [bytes]; 0 means 12. Default 0. A
   * multiple of 4.
   */
  uint32_t stride;
  /** Number of vertices. Default 0. From 3 to 4194304. */
  uint32_t vertex_count;
  /** Vertices of the triangles, 3 per triangle, counter-clockwise seen from the front. */
  const uint32_t *indices;
  /** Number of indices. Default 0. A multiple of 3, at most 50331648. */
  uint32_t index_count;
  /** Texture coordinates, 2 numbers per vertex, or NULL for none. */
  const float *uvs;
  /**
   * Curvature over each triangle of the cloth, from 0 (flat triangles) to 1. Default 1.
   *
   * Above 0, a fine skin has a smooth outline on a coarse cloth (Phong tessellation). At 1 a
   * skin lies on a circle between particles that lie on one. Particles are on the surface for
   * any value.
   */
  float smoothness;
  /** Not used; 0. */
  uint32_t reserved;
} MuslinSkinDesc;

/** Handle of a skin. { 0 } is none. Stale once the skin or its cloth is destroyed. */
typedef struct MuslinSkin {
  /** Identifies the skin; opaque. */
  uint64_t id;
} MuslinSkin;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/** Returns the version of the running library as 0x00MMmmpp: major, minor, patch. */
uint32_t muslin_version(void);

/**
 * Returns the version of the running library as "major.minor.patch". The pointer is always valid.
 */
const char *muslin_version_string(void);

/**
 * Returns the general meaning of a MuslinStatus. Accepts any number; the pointer is always valid.
 */
const char *muslin_status_string(uint32_t status);

/**
 * Returns the message of this thread's last call that was refused; it names the argument and the
 * rule. "" if no call was refused yet. Successful calls do not change it.
 *
 * The pointer is never NULL, and valid until the next call of this thread that is refused.
 */
const char *muslin_last_error(void);

/**
 * Returns the name of a stage of the tick, for `seconds` of MuslinStats. Stages are numbered from
 * 0; NULL beyond the last one. The pointer is always valid.
 */
const char *muslin_stage_name(uint32_t stage);

/**
 * Sends log messages up to `max_level` (MUSLIN_LOG_ERROR, MUSLIN_LOG_WARN or MUSLIN_LOG_INFO) to
 * `log`. NULL, the initial value, switches the log off.
 *
 * `log` is called on the thread of the call that it reports, perhaps on several threads at once,
 * and may call the library. `user` is passed to it unchanged. Both must stay valid until they are
 * replaced and calls that are running on other threads have returned.
 */
MuslinStatus muslin_set_log(MuslinLogFn log, uint32_t max_level, void *user);

/**
 * Makes a cloth from a regular grid. Destroy it with muslin_cloth_destroy.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for an invalid field of `desc`; MUSLIN_STATUS_UNSUPPORTED if
 * `desc` is of a newer version and uses fields that this library does not have
 */
MuslinStatus muslin_cloth_create_grid(const MuslinGridDesc *desc,
                                      MuslinCloth *out_cloth);

/**
 * Makes a cloth from any triangle mesh; its lists are copied. Defects of the mesh are repaired,
 * see muslin_cloth_get_mesh_report. Destroy the cloth with muslin_cloth_destroy.
 *
 * @return MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX for an invalid field of `desc`;
 * MUSLIN_STATUS_BAD_MESH if the mesh cannot be repaired: a triangle has an area that is not
 * finite, or no triangle has an area; MUSLIN_STATUS_UNSUPPORTED if `desc` is of a newer version
 * and uses fields that this library does not have
 */
MuslinStatus muslin_cloth_create_mesh(const MuslinMeshDesc *desc,
                                      MuslinCloth *out_cloth);

/**
 * Makes an independent copy of a cloth, in the same state. Destroy it with muslin_cloth_destroy.
 *
 * Both continue with the same bits as long as they get the same calls. Handles of grabs,
 * attachments and colliders are valid for both; skins stay with `cloth`.
 */
MuslinStatus muslin_cloth_duplicate(MuslinCloth cloth, MuslinCloth *out_cloth);

/**
 * Destroys a cloth. Its handle becomes stale; memory borrowed from it must no longer be read.
 */
MuslinStatus muslin_cloth_destroy(MuslinCloth cloth);

/**
 * Restores the initial state: rest shape, no tears or cuts, zero velocities, the pins of the
 * descriptor, time zero, all mass scales 1. Removes all grabs, attachments, anchors, creases and
 * events.
 *
 * Settings, material, wind and colliders stay as they are now. Handles of grabs and attachments
 * become stale; handles of colliders stay valid.
 */
MuslinStatus muslin_cloth_reset(MuslinCloth cloth);

/**
 * Sets the values of a fabric: MUSLIN_PRESET_SILK, MUSLIN_PRESET_COTTON, MUSLIN_PRESET_DENIM,
 * MUSLIN_PRESET_LEATHER, MUSLIN_PRESET_PAPER or MUSLIN_PRESET_FLAG_NYLON.
 *
 * `material` must be initialised with muslin_material_init, or be part of an initialised
 * descriptor.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for any other `preset`
 */
MuslinStatus muslin_material_preset(MuslinMaterial *material, uint32_t preset);

/** Reads the current settings. Initialise `out_settings` with muslin_settings_init. */
MuslinStatus muslin_cloth_get_settings(MuslinCloth cloth,
                                       MuslinSettings *out_settings);

/**
 * Replaces the settings; they take effect with the next tick. Velocities stay as they are.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for an invalid field; MUSLIN_STATUS_UNSUPPORTED if `settings` is
 * of a newer version and uses fields that this library does not have
 */
MuslinStatus muslin_cloth_set_settings(MuslinCloth cloth,
                                       const MuslinSettings *settings);

/** Reads the current material. Initialise `out_material` with muslin_material_init. */
MuslinStatus muslin_cloth_get_material(MuslinCloth cloth,
                                       MuslinMaterial *out_material);

/**
 * Replaces the material; it takes effect with the next tick. Velocities stay as they are.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for an invalid field; MUSLIN_STATUS_UNSUPPORTED if `material` is
 * of a newer version and uses fields that this library does not have
 */
MuslinStatus muslin_cloth_set_material(MuslinCloth cloth,
                                       const MuslinMaterial *material);

/**
 * Replaces the wind; it takes effect with the next tick.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for an invalid field; MUSLIN_STATUS_UNSUPPORTED if `wind` is of
 * a newer version and uses fields that this library does not have
 */
MuslinStatus muslin_cloth_set_wind(MuslinCloth cloth, const MuslinWind *wind);

/**
 * Runs the ticks that are due after `seconds` [s] of frame time. `out_ticks` (may be NULL)
 * receives how many ran.
 *
 * The remainder, less than one tick, is kept for the next call; `blend` of MuslinStats returns it
 * as a share of a tick. At most `max_ticks_per_advance` ticks run; the rest of the backlog is
 * dropped, so a slow machine shows slow motion instead of falling further behind. Zero seconds
 * change nothing.
 *
 * Poses that were given since the last tick (targets of pins and grabs, attachments, anchors,
 * colliders, the frame of muslin_cloth_move_frame) are reached evenly over the ticks of this call,
 * and exactly at the end of the last one. If no tick runs, they wait for the next call.
 *
 * @return MUSLIN_STATUS_BAD_VALUE if `seconds` is negative or not finite
 */
MuslinStatus muslin_cloth_advance(MuslinCloth cloth,
                                  float seconds,
                                  uint32_t *out_ticks);

/**
 * Advances `count` cloths by `seconds` [s] of frame time, each as muslin_cloth_advance does, with
 * the same bits. `out_ticks` (may be NULL) receives how many ticks each of them ran.
 *
 * A cloth that sleeps costs next to nothing. `cloths` may be NULL if `count` is 0.
 *
 * If one of the cloths is refused, none of them advances; the message names its index.
 *
 * @return MUSLIN_STATUS_BAD_VALUE if `seconds` is negative or not finite, or if a cloth occurs
 * twice
 */
MuslinStatus muslin_cloths_advance(const MuslinCloth *cloths,
                                   uint32_t count,
                                   float seconds,
                                   uint32_t *out_ticks);

/**
 * Runs exactly `ticks` ticks. The time that muslin_cloth_advance keeps for the next frame does not
 * change. Poses that were given before the call are reached in the first of these ticks.
 */
MuslinStatus muslin_cloth_step(MuslinCloth cloth, uint32_t ticks);

/**
 * Reads the share of a tick that muslin_cloth_advance has not simulated yet, from 0 to 1: the
 * `blend` of MuslinWriteDesc for smooth motion at any frame rate.
 */
MuslinStatus muslin_cloth_get_blend(MuslinCloth cloth, float *out_blend);

/**
 * Reads whether the cloth sleeps, 1 or 0, see `sleep_speed` of MuslinSettings: ticks then move
 * nothing until something wakes it.
 */
MuslinStatus muslin_cloth_is_asleep(MuslinCloth cloth, uint32_t *out_asleep);

/** Reads the current wind. Initialise `out_wind` with muslin_wind_init. */
MuslinStatus muslin_cloth_get_wind(MuslinCloth cloth, MuslinWind *out_wind);

/**
 * Reads the simulated time since the cloth was made or reset.
 *
 * `out_seconds` (may be NULL) receives it in seconds, `out_ticks` (may be NULL) in ticks.
 */
MuslinStatus muslin_cloth_get_time(MuslinCloth cloth,
                                   double *out_seconds,
                                   uint64_t *out_ticks);

/**
 * Reads mass, center of mass and momentum of the whole cloth, pinned particles included. Computed
 * on each call, in one pass over the particles.
 *
 * `out_total` (may be NULL) receives the mass [kg], `out_center` (may be NULL) the center of mass
 * [m], `out_momentum` (may be NULL) the sum of mass times velocity [kg m/s].
 */
MuslinStatus muslin_cloth_get_mass(MuslinCloth cloth,
                                   float *out_total,
                                   MuslinVec3 *out_center,
                                   MuslinVec3 *out_momentum);

/**
 * Pins a particle at `target` [m], or at its current position if `target` is NULL.
 *
 * The particle reaches the target evenly over the ticks of the next muslin_cloth_advance, or in
 * the next tick of muslin_cloth_step. If it is already pinned, the target changes and the
 * stiffness stays; an attached particle leaves its attachment.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_BAD_VALUE if the
 * target is not finite
 */
MuslinStatus muslin_cloth_pin(MuslinCloth cloth,
                              uint32_t particle,
                              const MuslinVec3 *target);

/**
 * Releases a pinned particle, which keeps its velocity. Has no effect on a particle that is not
 * pinned.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if the particle does not exist
 */
MuslinStatus muslin_cloth_unpin(MuslinCloth cloth, uint32_t particle);

/** Releases all pinned particles. */
MuslinStatus muslin_cloth_unpin_all(MuslinCloth cloth);

/**
 * Sets the targets [m] of `count` pins at once, e.g. every frame for an animated edge. Particles
 * that are not pinned yet become pinned. They reach their targets as those of muslin_cloth_pin.
 *
 * Targets are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a multiple
 * of 4). With `count` 0 both pointers may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
 * target is not finite, `stride` is invalid, or `count` exceeds the number of particles
 */
MuslinStatus muslin_cloth_set_pin_targets(MuslinCloth cloth,
                                          const uint32_t *particles,
                                          const void *positions,
                                          uint32_t stride,
                                          uint32_t count);

/**
 * Sets the stiffness [N/m] with which `count` pins pull particles towards their targets. 0, the
 * initial value, holds them exactly; above 0 the pin is a spring.
 *
 * - A load of 1 N moves a soft pin's particle 1/`stiffness` metres from its target: 1e3 N/m feels
 *   firm, 10 N/m lets a sheet of cotton sag by a few centimetres.
 * - For tears and `max_stretch` the cloth counts as free at a soft pin, and it is not tethered to
 *   it.
 * - A tear through a soft pin divides its stiffness in proportion to mass.
 *
 * With `count` 0 the pointer may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
 * particle is not pinned, `stiffness` is negative or not finite, or `count` exceeds the number of
 * particles
 */
MuslinStatus muslin_cloth_set_pin_stiffness(MuslinCloth cloth,
                                            const uint32_t *particles,
                                            uint32_t count,
                                            float stiffness);

/**
 * Returns the pinned particles, in ascending order. `out_count` receives their number.
 *
 * If `capacity` is 0, only the number is returned, and `out_particles` may be NULL.
 *
 * @return MUSLIN_STATUS_BUFFER_TOO_SMALL if `capacity` is neither 0 nor at least that number:
 * nothing is written, and muslin_last_error() states the number
 */
MuslinStatus muslin_cloth_get_pins(MuslinCloth cloth,
                                   uint32_t *out_particles,
                                   uint32_t capacity,
                                   uint32_t *out_count);

/**
 * Reads the targets of `count` pins [m], which their particles reach with the next ticks. Those of
 * attached particles follow from the pose of their attachment.
 *
 * Targets are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a multiple
 * of 4), and the bytes between them do not change. With `count` 0 both pointers may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
 * particle is not pinned, `stride` is invalid, or `count` exceeds the number of particles
 */
MuslinStatus muslin_cloth_get_pin_targets(MuslinCloth cloth,
                                          const uint32_t *particles,
                                          float *out_positions,
                                          uint32_t stride,
                                          uint32_t count);

/**
 * Multiplies the masses of `count` particles by factors: 1, the initial value, keeps the mass that
 * density and surrounding area give. A hem hangs straight at about 5; a coin that is sewn in may
 * be 100.
 *
 * Factors stay when the density changes. Neighbours may differ by a factor of 100; at factors in
 * the thousands, light particles that carry heavy ones stretch unless `substeps` is raised. With
 * `count` 0 both pointers may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
 * factor is not from 0.001 to 1000, or `count` exceeds the number of particles
 */
MuslinStatus muslin_cloth_set_mass_scales(MuslinCloth cloth,
                                          const uint32_t *particles,
                                          const float *scales,
                                          uint32_t count);

/**
 * Paints a property (MUSLIN_MAP_STRETCH, MUSLIN_MAP_BEND, MUSLIN_MAP_TEAR, MUSLIN_MAP_FRICTION,
 * MUSLIN_MAP_THICKNESS or MUSLIN_MAP_DRAG): multiplies what the material says by one scale per
 * particle, from 0 to 1000; 1 is as the material says. NULL takes the map away, whatever `count`.
 *
 * A link, a hinge or a triangle takes the mean of the scales at its corners; a contact interpolates
 * them at its point, and two layers take the mean of both sides. Own values of a collider are
 * scaled too.
 *
 * Maps stay when the material changes and when the cloth is reset. A particle that a tear splits
 * off takes the scale of its source; one that a cut adds to an edge takes the scale between those of
 * its ends. Scales take effect with the next tick. A map takes memory only while it is set.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for any other `map`, if `count` is not the number of particles, or
 * if a scale is not from 0 to 1000 (the message names its index)
 */
MuslinStatus muslin_cloth_set_map(MuslinCloth cloth,
                                  uint32_t map,
                                  const float *scales,
                                  uint32_t count);

/**
 * Reads a painted map: one scale per particle, also of those that tears and cuts added; 1 for all if
 * the map is not set.
 *
 * `map` is a MUSLIN_MAP_ value. `out_scales` (may be NULL) receives `count` scales, `out_is_set` (may
 * be NULL) 1 if the map is set, else 0.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for any other `map`, or if `count` is not the number of particles;
 * without `out_scales`, `count` is ignored
 */
MuslinStatus muslin_cloth_get_map(MuslinCloth cloth,
                                  uint32_t map,
                                  float *out_scales,
                                  uint32_t count,
                                  uint32_t *out_is_set);

/**
 * Places a particle at `position` [m] at once. Its velocity stays as it is. A pinned particle
 * stays pinned, at the new position.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_BAD_VALUE if the
 * position is not finite
 */
MuslinStatus muslin_cloth_set_position(MuslinCloth cloth,
                                       uint32_t particle,
                                       MuslinVec3 position);

/**
 * Sets the velocity of a particle [m/s].
 *
 * @return MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_BAD_VALUE if the
 * velocity is not finite
 */
MuslinStatus muslin_cloth_set_velocity(MuslinCloth cloth,
                                       uint32_t particle,
                                       MuslinVec3 velocity);

/**
 * Places `count` particles, from `first` on, at once [m]: a whole pose, if `first` is 0 and `count`
 * the number of particles.
 *
 * Velocities stay as they are; call muslin_cloth_set_velocities too to continue from a recorded
 * state. Pinned particles stay pinned, at the new positions. Positions are 3 floats each;
 * consecutive ones start `stride` bytes apart (0 means 12; a multiple of 4). With `count` 0 the
 * pointer may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if a
 * position is not finite (the message names its index), `stride` is invalid, or `count` exceeds
 * the number of particles from `first` on
 */
MuslinStatus muslin_cloth_set_positions(MuslinCloth cloth,
                                        uint32_t first,
                                        uint32_t count,
                                        const float *positions,
                                        uint32_t stride);

/**
 * Sets the velocities of `count` particles, from `first` on [m/s].
 *
 * Velocities are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a
 * multiple of 4). With `count` 0 the pointer may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if a
 * velocity is not finite (the message names its index), `stride` is invalid, or `count` exceeds
 * the number of particles from `first` on
 */
MuslinStatus muslin_cloth_set_velocities(MuslinCloth cloth,
                                         uint32_t first,
                                         uint32_t count,
                                         const float *velocities,
                                         uint32_t stride);

/**
 * Reads the velocities of `count` particles, from `first` on [m/s].
 *
 * Velocities are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a
 * multiple of 4), and the bytes between them do not change. With `count` 0 the pointer may be
 * NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if
 * `stride` is invalid, or `count` exceeds the number of particles from `first` on
 */
MuslinStatus muslin_cloth_get_velocities(MuslinCloth cloth,
                                         uint32_t first,
                                         uint32_t count,
                                         float *out_velocities,
                                         uint32_t stride);

/**
 * Reads the positions that `count` particles, from `first` on, have in the rest shape [m]: where
 * the descriptor placed them, whatever moved them since.
 *
 * A particle that a tear split off has the position of its source; one that a cut added has the
 * point of the rest edge that was cut. Strides are as in muslin_cloth_get_velocities. With `count`
 * 0 the pointer may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if
 * `stride` is invalid, or `count` exceeds the number of particles from `first` on
 */
MuslinStatus muslin_cloth_get_rest_positions(MuslinCloth cloth,
                                             uint32_t first,
                                             uint32_t count,
                                             float *out_positions,
                                             uint32_t stride);

/**
 * Attaches `count` particles to a transform at `position` [m] with `rotation`, e.g. a bone, a pole
 * or a car body. The particles are pinned at their current positions; muslin_cloth_move_attachment
 * moves them.
 *
 * - A particle that is already pinned, or attached to another transform, keeps its stiffness and
 *   moves to this attachment.
 * - A particle leaves the attachment when it gets a pin target of its own or is unpinned.
 * - A tear or cut through attached particles attaches the new particles too.
 * - muslin_cloth_reset removes all attachments.
 *
 * With `count` 0 the pointer may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if
 * `position` is not finite, `rotation` is not a unit quaternion, or `count` exceeds the number of
 * particles; MUSLIN_STATUS_FULL if there are 64 attachments already
 */
MuslinStatus muslin_cloth_attach(MuslinCloth cloth,
                                 const uint32_t *particles,
                                 uint32_t count,
                                 MuslinVec3 position,
                                 MuslinQuat rotation,
                                 MuslinAttachment *out_attachment);

/**
 * Moves an attachment: its particles reach the new pose evenly over the ticks of the next
 * muslin_cloth_advance, or in the next tick of muslin_cloth_step. They rotate with the transform
 * on the way, and are exactly there at the end.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was detached; MUSLIN_STATUS_BAD_VALUE if `position` is
 * not finite or `rotation` is not a unit quaternion
 */
MuslinStatus muslin_cloth_move_attachment(MuslinCloth cloth,
                                          MuslinAttachment attachment,
                                          MuslinVec3 position,
                                          MuslinQuat rotation);

/**
 * Removes an attachment and unpins the particles that it still carries; they keep their
 * velocities.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was detached before
 */
MuslinStatus muslin_cloth_detach(MuslinCloth cloth, MuslinAttachment attachment);

/**
 * Limits how far `count` particles may be from their anchors [m]. The limit holds after every
 * tick, whatever pulls at the particle.
 *
 * - Infinity, the initial value, means no limit; 0 fixes the particle to its anchor.
 * - The anchor of a particle is the position of the last muslin_cloth_set_anchors; before the
 *   first one, it is the particle's current position.
 * - Pins and grabs take precedence over the limit.
 * - A limit may stretch the cloth past `max_stretch`; this is reported as for pins, in MuslinStats
 *   and by MUSLIN_EVENT_HELD_APART.
 * - muslin_cloth_reset removes all limits.
 *
 * With `count` 0 both pointers may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
 * distance is negative or NaN, or `count` exceeds the number of particles
 */
MuslinStatus muslin_cloth_set_max_distances(MuslinCloth cloth,
                                            const uint32_t *particles,
                                            const float *distances,
                                            uint32_t count);

/**
 * Gives `count` particles backstops: spheres behind their anchors that the particles cannot enter,
 * so that a garment does not sink into the body that wears it.
 *
 * Each sphere has a radius [m], 0 for none. Its surface is the given distance [m] behind the
 * anchor, opposite to the normal of muslin_cloth_set_anchors; a particle without a normal has no
 * backstop. With `count` 0 the pointers may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
 * distance or radius is negative or not finite, or `count` exceeds the number of particles
 */
MuslinStatus muslin_cloth_set_backstops(MuslinCloth cloth,
                                        const uint32_t *particles,
                                        const float *distances,
                                        const float *radii,
                                        uint32_t count);

/**
 * Sets the animated positions [m] and outward normals of `count` particles, for
 * muslin_cloth_set_max_distances and muslin_cloth_set_backstops. Call it once per frame.
 *
 * Anchors move to the new positions evenly over the ticks of the next muslin_cloth_advance, or in
 * the next tick of muslin_cloth_step; a particle's first anchor is in place at once. Positions and
 * normals are 3 floats each; consecutive ones start `stride` bytes apart in both lists (0 means
 * 12; a multiple of 4). Normals need not have length 1; NULL keeps the previous normals. With
 * `count` 0 all pointers may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
 * number is not finite, a normal has length 0, `stride` is invalid, or `count` exceeds the number
 * of particles
 */
MuslinStatus muslin_cloth_set_anchors(MuslinCloth cloth,
                                      const uint32_t *particles,
                                      const void *positions,
                                      const void *normals,
                                      uint32_t stride,
                                      uint32_t count);

/** Removes all anchors, maximum distances and backstops. */
MuslinStatus muslin_cloth_clear_leashes(MuslinCloth cloth);

/**
 * Finds the first triangle that a ray hits within `max_distance` [m], from either side.
 *
 * `direction` need not have length 1; `max_distance` may be infinite. Initialise `out_hit` with
 * muslin_hit_init.
 *
 * @return MUSLIN_STATUS_NOTHING_HIT if the ray hits nothing; MUSLIN_STATUS_BAD_VALUE if `origin`
 * or `direction` is not finite, `direction` is zero, or `max_distance` is negative or NaN
 */
MuslinStatus muslin_cloth_raycast(MuslinCloth cloth,
                                  MuslinVec3 origin,
                                  MuslinVec3 direction,
                                  float max_distance,
                                  MuslinHit *out_hit);

/**
 * Grabs the particle that a ray points at: the nearest corner of the first triangle that the ray
 * hits; if it hits none, the particle nearest to the ray within `radius` [m].
 *
 * `out_at` (may be NULL) receives the position of the particle [m]. See
 * muslin_cloth_grab_particle.
 *
 * @return MUSLIN_STATUS_NOTHING_HIT if there is no such particle; MUSLIN_STATUS_BAD_VALUE if
 * `origin` or `direction` is not finite, `direction` is zero, or `radius` is negative or not
 * finite; MUSLIN_STATUS_FULL if there are 64 grabs already
 */
MuslinStatus muslin_cloth_grab_ray(MuslinCloth cloth,
                                   MuslinVec3 origin,
                                   MuslinVec3 direction,
                                   float radius,
                                   MuslinGrab *out_grab,
                                   MuslinVec3 *out_at);

/**
 * Grabs a particle at its current position.
 *
 * The particle then follows the target of muslin_cloth_move_grab exactly, at most
 * `max_displacement` per substep, and pulls the cloth along.
 *
 * @return MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_FULL if there are
 * 64 grabs already
 */
MuslinStatus muslin_cloth_grab_particle(MuslinCloth cloth,
                                        uint32_t particle,
                                        MuslinGrab *out_grab);

/**
 * Sets the target of a grab [m]. Within the speed limit the particle reaches it evenly over the
 * ticks of the next muslin_cloth_advance, or in the next tick of muslin_cloth_step.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if the grab was released; MUSLIN_STATUS_BAD_VALUE if the target
 * is not finite
 */
MuslinStatus muslin_cloth_move_grab(MuslinCloth cloth,
                                    MuslinGrab grab,
                                    MuslinVec3 target);

/**
 * Releases a grabbed particle, which keeps its velocity. A pinned particle stays pinned and
 * returns to its pin evenly over the ticks of the next muslin_cloth_advance, or in the next tick of
 * muslin_cloth_step.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if the grab was released before
 */
MuslinStatus muslin_cloth_release(MuslinCloth cloth, MuslinGrab grab);

/**
 * Tears the cloth between two neighbouring particles, as over-stretching does.
 *
 * The particle under the higher load is split by the plane that is perpendicular to the edge. If
 * neither particle has triangles on its other side, the edge itself opens, provided that it starts
 * at a border.
 *
 * @return MUSLIN_STATUS_NOT_TORN if both ends are pinned or grabbed, or the edge is already a
 * border; MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE unless the
 * two are the ends of an edge; MUSLIN_STATUS_FULL if the reserve for tears is used up
 */
MuslinStatus muslin_cloth_tear_edge(MuslinCloth cloth,
                                    uint32_t particle_a,
                                    uint32_t particle_b);

/**
 * Adds a fold of `angle` [rad] to the rest shape, along the line from `from` to `to` [m]. Both
 * points are given on the cloth as it was made.
 *
 * - A positive angle folds towards the front of the cloth (the side from which triangles are
 *   counter-clockwise), a negative one away from it.
 * - The line need not follow the mesh: the fold is distributed over the cells beside it. A line
 *   that misses the cloth has no effect.
 * - The cloth bends only as far as `bend_stiffness` can turn it.
 * - The fold lasts until muslin_cloth_reset; a second crease of -`angle` along the same line
 *   removes it.
 *
 * @return MUSLIN_STATUS_BAD_VALUE if a number is not finite, `to` equals `from`, or `angle` is not
 * from -3 to 3; the cloth is unchanged then
 */
MuslinStatus muslin_cloth_crease(MuslinCloth cloth,
                                 MuslinVec3 from,
                                 MuslinVec3 to,
                                 float angle);

/**
 * Cuts the cloth with a blade: the segment from `from` to `to` [m], swept along `sweep` [m].
 *
 * `out_edges` (may be NULL) receives the number of opened edges; 0 means that the blade missed and
 * nothing changed.
 *
 * - Triangles that the blade crosses are divided along it: new vertices lie on the crossed edges,
 *   with attributes interpolated between the edge's ends, and the mesh opens along them.
 * - The cut goes through an existing vertex instead if it would pass closer than an eighth of an
 *   edge, or would leave a triangle with an angle below 5 degrees or with less than 1/200 of the
 *   area of a square of the mean edge. It does not snap to a pinned vertex; it passes it at an
 *   eighth of the edge.
 * - Where the blade ends inside a triangle, the cut ends at the edge before it.
 * - New vertices are free; a pinned vertex that the cut goes through is pinned on both sides.
 * - Mass and rest area are conserved.
 * - Each crossed edge uses one particle of the reserve (`extra_particles`), and one more if it
 *   opens.
 *
 * @return MUSLIN_STATUS_BAD_VALUE if a number is not finite, `to` equals `from`, or `sweep` is
 * zero or parallel to the segment; MUSLIN_STATUS_FULL if the reserve cannot hold the whole cut;
 * the cloth is unchanged then
 */
MuslinStatus muslin_cloth_cut(MuslinCloth cloth,
                              MuslinVec3 from,
                              MuslinVec3 to,
                              MuslinVec3 sweep,
                              uint32_t *out_edges);

/**
 * Removes the oldest unread event and writes it to `out_event`. The newest 1024 are kept.
 *
 * `out_some` becomes 1, or 0 if there is no event; then `out_event` is not written. Initialise
 * `out_event` with muslin_event_init.
 *
 * Events are ordered by tick, and within a tick:
 * - recoveries;
 * - tears, the most stretched edge first: for each, its split vertices, then the torn edge;
 * - the exhausted reserve, if it cannot hold another tear;
 * - detached pieces, ordered by their first triangle;
 * - links that pins or grabs hold past `max_stretch`.
 *
 * A cut adds the edges that it divided, in its order, then the edges that it opened, the vertices
 * that it split, and the detached pieces.
 */
MuslinStatus muslin_cloth_next_event(MuslinCloth cloth,
                                     MuslinEvent *out_event,
                                     uint32_t *out_some);

/**
 * Adds a collider to a cloth. It acts from the next tick on.
 *
 * @return MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX for an invalid field of `desc`;
 * MUSLIN_STATUS_UNSUPPORTED for a shape that this version does not have; MUSLIN_STATUS_FULL if
 * there are 1024 colliders already
 */
MuslinStatus muslin_cloth_add_collider(MuslinCloth cloth,
                                       const MuslinColliderDesc *desc,
                                       MuslinCollider *out_collider);

/**
 * Moves a collider to a new pose, which it reaches evenly over the ticks of the next
 * muslin_cloth_advance, or in the next tick of muslin_cloth_step. The motion is swept, so a fast
 * collider does not jump through the cloth.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was removed; MUSLIN_STATUS_BAD_VALUE if `position` is not
 * finite or `rotation` is not a unit quaternion
 */
MuslinStatus muslin_cloth_move_collider(MuslinCloth cloth,
                                        MuslinCollider collider,
                                        MuslinVec3 position,
                                        MuslinQuat rotation);

/**
 * Gives a mesh collider new vertices, of the same number and with the same triangles: the body of a
 * character in its next pose.
 *
 * Its surface reaches them evenly over the ticks of the next muslin_cloth_advance, or in the next
 * tick of muslin_cloth_step, and is swept on its way: it carries cloth along. Positions are 3 floats
 * each, in the frame of the collider [m]; consecutive ones start `stride` bytes apart (0 means 12; a
 * multiple of 4). muslin_cloth_move_collider moves that frame as before. The first call prepares the
 * mesh for that, which takes as long as adding it.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if the collider was removed; MUSLIN_STATUS_BAD_VALUE if it is no
 * mesh, `count` is not the number of its vertices, a position is not between -1e6 and 1e6 (the
 * message names its index) or `stride` is invalid
 */
MuslinStatus muslin_cloth_update_collider(MuslinCloth cloth,
                                          MuslinCollider collider,
                                          const float *positions,
                                          uint32_t stride,
                                          uint32_t count);

/**
 * Makes the surface of another cloth a collider of this one, or updates it: clothes in layers, the
 * inner one first.
 *
 * Call it in each frame between the muslin_cloth_advance of the inner cloth, `other`, and that of the
 * outer one. `inout_collider` starts as {0}: then the collider is added, where `other` is now, and its
 * handle written. With the handle of an earlier call, the collider reaches the present positions of
 * `other` evenly over the ticks of the next muslin_cloth_advance, or in the next tick of
 * muslin_cloth_step, and is swept on its way. It has two sides: this cloth stays on the side where it
 * is. It keeps the mean of both thicknesses away, half of each, and has the mean of both coefficients
 * of friction, as in the call; maps of `other` do not count. Where `other` has torn or been cut
 * since, the collider takes its new triangles, which takes as long as adding it; the handle stays.
 *
 * The effect is one-way: `other` does not feel this cloth. Several pieces in one mesh, with
 * MUSLIN_SELF_COLLISION_SURFACE, bear on each other, and nothing passes through; a layer gives no
 * such guarantee where both cloths crumple or are squeezed. The motion since the last call is swept:
 * after a reset or teleport of both cloths, remove the collider and start with {0} again. A save
 * contains the collider, and the handle is valid for the restored cloth too.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if a cloth is not live, or the collider was removed;
 * MUSLIN_STATUS_BAD_VALUE if `other` is the cloth itself, this call did not return the collider, no triangle of
 * `other` has an area, or a particle of it is 1e6 m or more from its origin; MUSLIN_STATUS_FULL if
 * there are 1024 colliders already; MUSLIN_STATUS_BUSY if either cloth is in use on another thread
 */
MuslinStatus muslin_cloth_collide_with(MuslinCloth cloth,
                                       MuslinCloth other,
                                       MuslinCollider *inout_collider);

/**
 * Removes a collider. Its handle becomes stale.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was removed before
 */
MuslinStatus muslin_cloth_remove_collider(MuslinCloth cloth,
                                          MuslinCollider collider);

/**
 * Reads where a collider is now: after the last tick, or where it was added or teleported to since.
 * A pose of muslin_cloth_move_collider counts once a tick has reached it.
 *
 * `out_position` (may be NULL) receives the position [m], `out_rotation` (may be NULL) the
 * rotation.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was removed
 */
MuslinStatus muslin_cloth_get_collider_pose(MuslinCloth cloth,
                                            MuslinCollider collider,
                                            MuslinVec3 *out_position,
                                            MuslinQuat *out_rotation);

/**
 * Reads the impulse that the cloth applied to a collider in the last tick.
 *
 * `out_linear` (may be NULL) receives the linear impulse [kg m/s], `out_angular` (may be NULL) the
 * angular impulse about the collider's position [kg m^2/s]. Divided by the length of a tick they
 * are force and torque, for an engine that simulates the collider as a rigid body.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was removed
 */
MuslinStatus muslin_cloth_get_collider_impulse(MuslinCloth cloth,
                                               MuslinCollider collider,
                                               MuslinVec3 *out_linear,
                                               MuslinVec3 *out_angular);

/**
 * Sets the pose of the body that wears the cloth, the start for muslin_cloth_teleport and
 * muslin_cloth_move_frame. Moves nothing.
 *
 * The initial pose, also after muslin_cloth_reset, is the origin without rotation.
 *
 * @return MUSLIN_STATUS_BAD_VALUE if `position` is not finite or `rotation` is not a unit
 * quaternion
 */
MuslinStatus muslin_cloth_set_frame(MuslinCloth cloth,
                                    MuslinVec3 position,
                                    MuslinQuat rotation);

/**
 * Moves the cloth with the body that wears it to a new pose at once, as a rigid body and without
 * inertia. Velocities rotate with it.
 *
 * The motion starts at the pose of the last muslin_cloth_set_frame, muslin_cloth_move_frame or
 * muslin_cloth_teleport. Pins, attachments, grabs and anchors move too; colliders do not, see
 * muslin_cloth_teleport_collider. In a frame, call this before muslin_cloth_move_attachment and
 * muslin_cloth_set_anchors.
 *
 * @return MUSLIN_STATUS_BAD_VALUE if `position` is not finite, `rotation` is not a unit
 * quaternion, or a moved value would not be finite; the cloth is unchanged then
 */
MuslinStatus muslin_cloth_teleport(MuslinCloth cloth,
                                   MuslinVec3 position,
                                   MuslinQuat rotation);

/**
 * Moves the cloth with the body that wears it to a new pose over the ticks of the next
 * muslin_cloth_advance, or in the next tick of muslin_cloth_step; the cloth feels only the share
 * `inertia` of the motion.
 *
 * - 1: the cloth feels the whole motion, as without this call.
 * - 0: the cloth feels nothing, as if the body stood still and the world moved.
 * - Between: it feels this share of the translation and of the rotation.
 *
 * The motion starts at the pose of the last muslin_cloth_set_frame, muslin_cloth_teleport or
 * muslin_cloth_move_frame. The part that is not felt moves particles at once, as a rigid body.
 * Pins, attachments and anchors reach the body's new pose evenly over these ticks. Colliders and
 * grabs stay at the poses that you give; the cloth meets them with the velocity that they have
 * relative to the body. The air moves with the body by the share that is not felt.
 *
 * In a frame, call this before muslin_cloth_move_attachment, muslin_cloth_move_collider and
 * muslin_cloth_set_anchors.
 *
 * @return MUSLIN_STATUS_BAD_VALUE if `position` is not finite, `rotation` is not a unit
 * quaternion, `inertia` is not from 0 to 1, or a moved value would not be finite; the cloth is
 * unchanged then
 */
MuslinStatus muslin_cloth_move_frame(MuslinCloth cloth,
                                     MuslinVec3 position,
                                     MuslinQuat rotation,
                                     float inertia);

/**
 * Places a collider at a new pose at once, without a sweep and without dragging the cloth along.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was removed; MUSLIN_STATUS_BAD_VALUE if `position` is not
 * finite or `rotation` is not a unit quaternion
 */
MuslinStatus muslin_cloth_teleport_collider(MuslinCloth cloth,
                                            MuslinCollider collider,
                                            MuslinVec3 position,
                                            MuslinQuat rotation);

/**
 * Returns all lists that a renderer needs, without a copy; MuslinView says how long they stay
 * valid.
 *
 * Normals are computed if positions changed since they were last read. Initialise `out_view` with
 * muslin_view_init.
 */
MuslinStatus muslin_cloth_view(MuslinCloth cloth, MuslinView *out_view);

/**
 * Returns the origin of the cloth [m]: the point that it is simulated relative to, a whole number
 * of metres along each axis.
 *
 * It is zero while most of the cloth stays within 16 m of zero along each axis. Beyond, it follows
 * the cloth, so that positions far from zero are as exact as near it. All positions that you pass
 * or read are absolute, except for those that muslin_cloth_write_vertices writes with `relative`.
 * Only ticks and calls that place particles move the origin.
 */
MuslinStatus muslin_cloth_get_origin(MuslinCloth cloth, MuslinVec3 *out_origin);

/**
 * Returns the vertex and index ranges that changed after the view's `topology_revision` was
 * `since_topology_revision`: what a renderer must upload again, besides positions and normals.
 *
 * Returns everything if that revision is more than 64 changes old or never existed; pass 0 for the
 * first upload. Initialise `out_changes` with muslin_changes_init.
 */
MuslinStatus muslin_cloth_changes(MuslinCloth cloth,
                                  uint32_t since_topology_revision,
                                  MuslinChanges *out_changes);

/**
 * Returns what was repaired in the mesh that the cloth was made from. A grid needs no repair.
 * Initialise `out_report` with muslin_mesh_report_init.
 */
MuslinStatus muslin_cloth_get_mesh_report(MuslinCloth cloth,
                                          MuslinMeshReport *out_report);

/**
 * Writes a sentence for each property of the mesh that its author should know of: what was removed
 * or split, and what makes the cloth slow or uneven. The text has one sentence per line and ends
 * with a zero byte; it is empty for a good mesh. It is written to `size` bytes at `buffer`;
 * `out_needed` receives the number of bytes, with the zero byte.
 *
 * If `buffer` is NULL, only that number is returned; otherwise `out_needed` may be NULL.
 *
 * @return MUSLIN_STATUS_BUFFER_TOO_SMALL if the text does not fit: nothing is written, and
 * muslin_last_error() states the required size
 */
MuslinStatus muslin_cloth_get_mesh_warnings(MuslinCloth cloth,
                                            char *buffer,
                                            size_t size,
                                            size_t *out_needed);

/**
 * Returns statistics of the current state, computed in time proportional to the size of the cloth.
 * Initialise `out_stats` with muslin_stats_init.
 */
MuslinStatus muslin_cloth_get_stats(MuslinCloth cloth, MuslinStats *out_stats);

/**
 * Returns a hash of all state that the next tick depends on. Equal calls give equal hashes on
 * every platform.
 */
MuslinStatus muslin_cloth_state_hash(MuslinCloth cloth, uint64_t *out_hash);

/**
 * Writes vertices into your own buffers, each attribute with the format, address and stride of its
 * stream: separate, interleaved or one after the other. Other bytes are untouched.
 *
 * Buffers for the view's `vertex_capacity` vertices are always large enough. With `desc` NULL all
 * vertices are written, untransformed.
 *
 * @return MUSLIN_STATUS_BUFFER_TOO_SMALL if the vertices do not fit the `size` of a stream;
 * MUSLIN_STATUS_BAD_VALUE if `stream_count` is not from 1 to MUSLIN_MAX_STREAMS, a field of a
 * stream or of `desc` is invalid, a format cannot write its attribute, two streams overlap, a
 * buffer is memory of a view, or normals or tangents are written with a transform that cannot be
 * inverted; the buffers are untouched then
 */
MuslinStatus muslin_cloth_write_vertices(MuslinCloth cloth,
                                         const MuslinStream *streams,
                                         uint32_t stream_count,
                                         const MuslinWriteDesc *desc);

/**
 * Writes the indices of all triangles to the start of `buffer`, which has `size` bytes.
 *
 * `index_format` is the width of an index in bits, 16 or 32. `base_vertex` is added to each index.
 * With `flip` 1 the winding of every triangle is reversed. A buffer for the view's
 * `index_capacity` indices is always large enough.
 *
 * @return MUSLIN_STATUS_BUFFER_TOO_SMALL if `size` is less than the view's `index_count` indices
 * need; MUSLIN_STATUS_BAD_VALUE if `index_format` or `flip` has another value, or an index would
 * be above 65534 in 16 bits or 4294967294 in 32 bits; `buffer` is untouched then
 */
MuslinStatus muslin_cloth_write_indices(MuslinCloth cloth,
                                        void *buffer,
                                        size_t size,
                                        uint32_t index_format,
                                        uint32_t flip,
                                        uint32_t base_vertex);

/**
 * Sews `pair_count` pairs of particles together: draws each pair together at `speed` of `desc`, and
 * joins it when its distance is zero. `pairs` has two particles per pair.
 *
 * Joined particles have one position and one velocity after every tick, and move as one particle
 * with the mass of both.
 *
 * - Particles may be in several pairs, as where three panels meet.
 * - Pairs do not collide with each other. A held particle draws the other one to it.
 * - Two held particles stay where they are; `over_stretched` of MuslinStats counts the pair and
 *   MUSLIN_EVENT_HELD_APART reports it.
 * - Particles, vertices and triangles stay as they are. A weld is invisible, since normals are
 *   smooth across it.
 * - A stitch that tears gives MUSLIN_EVENT_STITCH_TORN.
 * - muslin_cloth_reset keeps the pairs and draws them together again from the rest shape.
 *
 * With `pair_count` 0, `pairs` may be NULL. With `desc` NULL the defaults apply.
 *
 * @return MUSLIN_STATUS_BAD_VALUE if two particles of a pair are equal, do not exist or have no
 * triangle, if `pair_count` exceeds the number of particles, or for an invalid field of `desc`
 */
MuslinStatus muslin_cloth_sew(MuslinCloth cloth,
                              const uint32_t *pairs,
                              uint32_t pair_count,
                              const MuslinSewDesc *desc);

/**
 * Binds a render mesh, usually finer than the cloth, to the cloth as it is now; its lists are
 * copied. Destroy it with muslin_skin_destroy; it also ends with its cloth.
 *
 * Each vertex is bound to the nearest point of the cloth, at its distance from it, and moves along
 * with the cloth on a surface that is curved over each triangle (`smoothness`). Make the skin while
 * the cloth has the shape that the mesh was modelled in, usually before the first tick: on a folded
 * cloth the nearest layer may be another one.
 *
 * A triangle of the skin that a tear or cut would stretch goes with one side, that of its center.
 * Its corners on the other side are copied, so the number of vertices may grow; the number of
 * indices never changes. muslin_cloth_reset restores the given mesh. muslin_cloth_save contains no
 * skins.
 *
 * @return MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX for an invalid field of `desc`, also
 * if a vertex is too far from the cloth; MUSLIN_STATUS_UNSUPPORTED if `desc` is of a newer version
 * and uses fields that this library does not have
 */
MuslinStatus muslin_skin_create(MuslinCloth cloth,
                                const MuslinSkinDesc *desc,
                                MuslinSkin *out_skin);

/**
 * Writes vertices of a skin into your own buffers, as muslin_cloth_write_vertices does.
 *
 * Follows tears and cuts first, so call muslin_skin_view for the number of vertices and
 * `topology_revision` before. Buffers for the view's `vertex_capacity` vertices are always large
 * enough. With `desc` NULL all vertices are written, untransformed.
 *
 * @return the statuses of muslin_cloth_write_vertices; the buffers are untouched then
 */
MuslinStatus muslin_skin_write_vertices(MuslinSkin skin,
                                        const MuslinStream *streams,
                                        uint32_t stream_count,
                                        const MuslinWriteDesc *desc);

/**
 * Returns the lists of a skin where its cloth is now, without a copy.
 *
 * The pointers and the data behind them stay valid until the next call that takes the skin or that
 * changes or destroys its cloth. `source_vertices` are those of the descriptor: its vertices keep
 * their numbers, copies that tears and cuts need follow. `frayed` is 1 on edges of the skin that a
 * tear or cut opened. `topology_revision` is that of the skin: it changes whenever its indices or
 * the number of its vertices do. `particles` is NULL. Initialise `out_view` with muslin_view_init.
 */
MuslinStatus muslin_skin_view(MuslinSkin skin, MuslinView *out_view);

/**
 * Destroys a skin. Its handle becomes stale; memory borrowed from it must no longer be read.
 */
MuslinStatus muslin_skin_destroy(MuslinSkin skin);

/**
 * Writes the complete state of a cloth to `size` bytes at `buffer`. `out_needed` receives the
 * number of bytes of the save.
 *
 * If `buffer` is NULL, only that number is returned; otherwise `out_needed` may be NULL. The bytes
 * are the same on every platform. The number is valid until the cloth changes.
 *
 * @return MUSLIN_STATUS_BUFFER_TOO_SMALL if the save does not fit: nothing is written, and
 * muslin_last_error() states the required size
 */
MuslinStatus muslin_cloth_save(MuslinCloth cloth,
                               void *buffer,
                               size_t size,
                               size_t *out_needed);

/**
 * Makes a cloth from `size` bytes at `buffer` that muslin_cloth_save wrote, perhaps on another
 * platform. It continues with the same bits.
 *
 * Handles of grabs, attachments and colliders are valid for the new cloth too. Untrusted bytes are
 * safe: they give a valid cloth or an error.
 *
 * @return MUSLIN_STATUS_BAD_SAVE if the bytes are not a save, come from another format version, or
 * are damaged
 */
MuslinStatus muslin_cloth_restore(const void *buffer,
                                  size_t size,
                                  MuslinCloth *out_cloth);

/** Called by muslin_settings_init with the sizeof of MuslinSettings. */
MuslinStatus muslin_settings_init_sized(MuslinSettings *settings, uint32_t struct_size);

/** Called by muslin_material_init with the sizeof of MuslinMaterial. */
MuslinStatus muslin_material_init_sized(MuslinMaterial *material, uint32_t struct_size);

/** Called by muslin_wind_init with the sizeof of MuslinWind. */
MuslinStatus muslin_wind_init_sized(MuslinWind *wind, uint32_t struct_size);

/** Called by muslin_collider_desc_init with the sizeof of MuslinColliderDesc. */
MuslinStatus muslin_collider_desc_init_sized(MuslinColliderDesc *desc,
                                             uint32_t struct_size);

/** Called by muslin_stream_init with the sizeof of MuslinStream. */
MuslinStatus muslin_stream_init_sized(MuslinStream *stream, uint32_t struct_size);

/** Called by muslin_write_desc_init with the sizeof of MuslinWriteDesc. */
MuslinStatus muslin_write_desc_init_sized(MuslinWriteDesc *desc, uint32_t struct_size);

/** Called by muslin_sew_desc_init with the sizeof of MuslinSewDesc. */
MuslinStatus muslin_sew_desc_init_sized(MuslinSewDesc *desc, uint32_t struct_size);

/** Called by muslin_skin_desc_init with the sizeof of MuslinSkinDesc. */
MuslinStatus muslin_skin_desc_init_sized(MuslinSkinDesc *desc, uint32_t struct_size);

/**
 * Called by muslin_grid_desc_init with the sizeof of MuslinGridDesc, MuslinMaterial and
 * MuslinSettings, all of the same header.
 */
MuslinStatus muslin_grid_desc_init_sized(MuslinGridDesc *desc,
                                         uint32_t struct_size,
                                         uint32_t material_size,
                                         uint32_t settings_size);

/**
 * Called by muslin_mesh_desc_init with the sizeof of MuslinMeshDesc, MuslinMaterial and
 * MuslinSettings, all of the same header.
 */
MuslinStatus muslin_mesh_desc_init_sized(MuslinMeshDesc *desc,
                                         uint32_t struct_size,
                                         uint32_t material_size,
                                         uint32_t settings_size);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

/* Initialise a struct: its size, as the compiler of this program knows it, and the defaults. */

static inline void muslin_settings_init(MuslinSettings *settings) {
  (void)muslin_settings_init_sized(settings, (uint32_t)sizeof(MuslinSettings));
}

static inline void muslin_material_init(MuslinMaterial *material) {
  (void)muslin_material_init_sized(material, (uint32_t)sizeof(MuslinMaterial));
}

static inline void muslin_grid_desc_init(MuslinGridDesc *desc) {
  (void)muslin_grid_desc_init_sized(desc, (uint32_t)sizeof(MuslinGridDesc),
                                    (uint32_t)sizeof(MuslinMaterial),
                                    (uint32_t)sizeof(MuslinSettings));
}

static inline void muslin_mesh_desc_init(MuslinMeshDesc *desc) {
  (void)muslin_mesh_desc_init_sized(desc, (uint32_t)sizeof(MuslinMeshDesc),
                                    (uint32_t)sizeof(MuslinMaterial),
                                    (uint32_t)sizeof(MuslinSettings));
}

static inline void muslin_sew_desc_init(MuslinSewDesc *desc) {
  (void)muslin_sew_desc_init_sized(desc, (uint32_t)sizeof(MuslinSewDesc));
}

static inline void muslin_skin_desc_init(MuslinSkinDesc *desc) {
  (void)muslin_skin_desc_init_sized(desc, (uint32_t)sizeof(MuslinSkinDesc));
}

static inline void muslin_wind_init(MuslinWind *wind) {
  (void)muslin_wind_init_sized(wind, (uint32_t)sizeof(MuslinWind));
}

static inline void muslin_collider_desc_init(MuslinColliderDesc *desc) {
  (void)muslin_collider_desc_init_sized(desc, (uint32_t)sizeof(MuslinColliderDesc));
}

static inline void muslin_stream_init(MuslinStream *stream) {
  (void)muslin_stream_init_sized(stream, (uint32_t)sizeof(MuslinStream));
}

static inline void muslin_write_desc_init(MuslinWriteDesc *desc) {
  (void)muslin_write_desc_init_sized(desc, (uint32_t)sizeof(MuslinWriteDesc));
}

/* Returns a stream with all of its fields set; see MuslinStream. */
static inline MuslinStream muslin_stream(uint32_t attribute, uint32_t format, void *buffer,
                                         uint32_t stride, size_t size) {
  MuslinStream stream;
  muslin_stream_init(&stream);
  stream.attribute = attribute;
  stream.format = format;
  stream.stride = stride;
  stream.buffer = buffer;
  stream.size = size;
  return stream;
}

/* Initialise an output struct: its size, as the compiler of this program knows it. */

static inline void muslin_view_init(MuslinView *view) {
  view->struct_size = (uint32_t)sizeof(MuslinView);
}

static inline void muslin_mesh_report_init(MuslinMeshReport *report) {
  report->struct_size = (uint32_t)sizeof(MuslinMeshReport);
}

static inline void muslin_changes_init(MuslinChanges *changes) {
  changes->struct_size = (uint32_t)sizeof(MuslinChanges);
}

static inline void muslin_hit_init(MuslinHit *hit) {
  hit->struct_size = (uint32_t)sizeof(MuslinHit);
}

static inline void muslin_event_init(MuslinEvent *event) {
  event->struct_size = (uint32_t)sizeof(MuslinEvent);
}

static inline void muslin_stats_init(MuslinStats *stats) {
  stats->struct_size = (uint32_t)sizeof(MuslinStats);
}
