/* Muslin: cloth that hangs, is grabbed, blows and tears, the same bits on every machine.
 *
 * Generated from bindings/c; MUSLIN_BLESS=1 cargo test -p muslin-c --test header writes it anew.
 *
 * Metres, kilograms, seconds, radians; right-handed, y up by default (gravity is a setting).
 *
 * Begin every struct that has a struct_size with its muslin_..._init, which knows how large your
 * compiler made it: so an old program runs with a newer library, and a new one with an older library
 * as long as it does not use what that lacks.
 *
 * What is not MUSLIN_STATUS_OK was refused, and changed nothing: neither the cloth nor what the
 * out_... parameters point to. muslin_last_error() says why in a sentence that names the field.
 *
 * A pointer is NULL only where that is said; else it is refused as MUSLIN_STATUS_BAD_VALUE. What it
 * points to must be there and as large as its type, its count or its struct_size says. No pointer is
 * kept after a call. What the library lends is valid as long as is said there.
 *
 * Different cloths may be used on different threads at once. A cloth in use on one thread is
 * MUSLIN_STATUS_BUSY on another. Do not copy a cloth's borrowed memory on one thread while another
 * changes that cloth.
 */

#pragma once

#include <stddef.h>
#include <stdint.h>

/** A defect of Muslin stopped a call. */
#define MUSLIN_LOG_ERROR 1

/** A call was refused; the message is what muslin_last_error says. */
#define MUSLIN_LOG_WARN 2

/** A cloth was made or destroyed. */
#define MUSLIN_LOG_INFO 3

/** Light and fluid, 100 g/m^2. */
#define MUSLIN_PRESET_SILK 0

/** Shirting, 180 g/m^2. */
#define MUSLIN_PRESET_COTTON 1

/** Heavy twill, 380 g/m^2. */
#define MUSLIN_PRESET_DENIM 2

/** Garment leather, 700 g/m^2. */
#define MUSLIN_PRESET_LEATHER 3

/** Office paper, 80 g/m^2. */
#define MUSLIN_PRESET_PAPER 4

/** Flag nylon 200 denier, 105 g/m^2. */
#define MUSLIN_PRESET_FLAG_NYLON 5

/** For `self_collision`: parts of the cloth go through each other. */
#define MUSLIN_SELF_COLLISION_NONE 0

/**
 * For `self_collision`: surface keeps from surface, a material's thickness apart, so that nothing crosses,
 * with the material's friction. A thickness counts up to half of the mean rest length. What is nearer than
 * two thicknesses in the weave keeps half of that distance. The two sides of a slit part by a
 * thousandth of the mean rest length as it opens, so that they keep from each other too. What pins or grabs
 * hold takes along what is in its way, and what is caught between two such may be forced through. What
 * crosses all the same, from the start, as this is switched on or where particles are placed, is drawn out
 * again unless it is held: the smaller part goes back to the side of the rest, mostly within a second. It
 * costs about as much as the rest of a tick while little touches, several times that where layers lie on
 * each other, and from twenty to hundreds of times where sheets of thousands of particles crumple.
 */
#define MUSLIN_SELF_COLLISION_SURFACE 1

/**
 * For `self_collision`: particles keep from particles, as if they were balls: cheap, without friction, and
 * a fold may slip through where particles are farther apart than `self_distance`. Those that are woven into
 * one piece nearer than that, or than one and a half mean rest lengths, do not count; what is held neither.
 */
#define MUSLIN_SELF_COLLISION_PARTICLES 2

/** Nothing is pinned: it falls. */
#define MUSLIN_PIN_NONE 0

/** The whole first row is pinned. */
#define MUSLIN_PIN_TOP_EDGE 1

/** The two ends of the first row are pinned. */
#define MUSLIN_PIN_TOP_CORNERS 2

/** All four corners are pinned. */
#define MUSLIN_PIN_CORNERS 3

/** For `extra_particles`: room for as many particles again as the cloth starts with. */
#define MUSLIN_AS_MANY_AGAIN UINT32_MAX

/**
 * The air pushes each triangle along its normal, by the square of the relative speed; still air
 * brakes.
 */
#define MUSLIN_WIND_SURFACE 0

/**
 * The air pushes each particle as a field of sine waves, whichever way the cloth faces. The length
 * of `velocity` is its strength as an acceleration [m/s^2].
 */
#define MUSLIN_WIND_SINE_FIELD 1

/** All that is below `position` along the turned y axis. */
#define MUSLIN_SHAPE_PLANE 0

/** A ball of `radius` around `position`. */
#define MUSLIN_SHAPE_SPHERE 1

/**
 * Balls of `radius` and `top_radius` at -`half_height` and +`half_height` along the turned y axis, and all
 * between them.
 */
#define MUSLIN_SHAPE_CAPSULE 2

/** A box that reaches `half_extents` to either side of `position` along each turned axis. */
#define MUSLIN_SHAPE_BOX 3

/** The least convex body that holds all of `positions`. */
#define MUSLIN_SHAPE_CONVEX 4

/**
 * The triangles that `indices` join of `positions`. Cloth stays on the side where it is: both are outside,
 * and nothing is inside, so that it need not be closed nor wound one way. It keeps a gap of 0.1 mm at
 * least.
 */
#define MUSLIN_SHAPE_MESH 5

/**
 * Ground: all below a surface over `columns` * `rows` heights, `spacing` apart along the turned x and z axes
 * from `position` on, as deep as it is wide. It has no sides.
 */
#define MUSLIN_SHAPE_HEIGHTFIELD 6

/** The edge between `particle_a` and `particle_b` tore. */
#define MUSLIN_EVENT_EDGE_TORN 0

/**
 * `vertex` was split off from `source`. Where a particle with several vertices was split between them, so that
 * none had to be: both are the lowest vertex that went to the new particle.
 */
#define MUSLIN_EVENT_VERTEX_SPLIT 1

/** A piece of `count` triangles, one of them at `vertex`, came off. */
#define MUSLIN_EVENT_PIECE_DETACHED 2

/** `count` particles had left the realm of numbers and were put back where they last were. */
#define MUSLIN_EVENT_RECOVERED 3

/** Tearing stopped: the room that `extra_particles` reserved for it is used up. Told once. */
#define MUSLIN_EVENT_RESERVE_USED_UP 4

/**
 * Pins or grabs hold the cloth apart: `count` links are past `max_stretch`, one of them between
 * `particle_a` and `particle_b`. Told once, until the bound holds again.
 */
#define MUSLIN_EVENT_HELD_APART 5

/**
 * A cut made `vertex` on the edge between `particle_a` and `particle_b`; and, if they are different vertices on
 * either side of that edge, the one after it for the other side.
 */
#define MUSLIN_EVENT_EDGE_DIVIDED 6

/** Where a vertex is [m]: x y z, and 1 in 16 bits. */
#define MUSLIN_ATTRIBUTE_POSITION 0

/** Its unit normal: x y z, and 0 in 16 bits. */
#define MUSLIN_ATTRIBUTE_NORMAL 1

/**
 * The unit direction square to the normal in which the texture coordinate u grows, x y z, and w, which
 * is 1 or -1: v grows along cross(normal, tangent) times w. It is the sum over the vertex's triangles of
 * (p dv2 - q dv1) sign(du1 dv2 - du2 dv1), p and q being edges and (du1, dv1), (du2, dv2) what they
 * are in the texture, made square to the normal; where a texture says nothing, any such direction.
 */
#define MUSLIN_ATTRIBUTE_TANGENT 2

/** Its texture coordinates: u v. */
#define MUSLIN_ATTRIBUTE_UV 3

/**
 * 1 at a border that a tear or a cut made, which a renderer may fringe, else 0; and another 0 in 16 bits.
 */
#define MUSLIN_ATTRIBUTE_FRAYED 4

/** 32-bit floats: 12 bytes of a position or normal, 16 of a tangent, 8 of a uv, 4 of frayed. */
#define MUSLIN_FORMAT_F32 0

/** 16-bit floats: 8 bytes, of a uv or frayed 4. What is beyond 65504 becomes that. */
#define MUSLIN_FORMAT_F16 1

/**
 * 16-bit whole numbers from -32767 to 32767, which stand for -1 to 1: 8 bytes of a normal or tangent, 4
 * of frayed; nothing else.
 */
#define MUSLIN_FORMAT_SNORM16 2

/**
 * A direction as two of those, x and y where it meets the octahedron |x| + |y| + |z| = 1, its lower
 * half (z < 0) folded outward, to (1 - |y|) sign(x) and (1 - |x|) sign(y): 4 bytes of a normal; 8 of a
 * tangent, those two, w and 0; nothing else.
 */
#define MUSLIN_FORMAT_OCTAHEDRAL16 3

/** How many streams one call takes. */
#define MUSLIN_MAX_STREAMS 16

/** For `vertex_count`: all from the first one on. */
#define MUSLIN_ALL_VERTICES UINT32_MAX

/** Room for the times of stages in MuslinStats; how many there are is in `stage_count`. */
#define MUSLIN_STAGE_SLOTS 31

/**
 * What became of a call. Whatever is not MUSLIN_STATUS_OK left the cloth and all `out_...` parameters
 * as they were, and muslin_last_error() says why in a sentence.
 */
typedef enum MuslinStatus {
  /** Done. */
  MUSLIN_STATUS_OK = 0,
  /**
   * An argument or a field is NULL, out of its range or not finite, or does not fit another one.
   */
  MUSLIN_STATUS_BAD_VALUE = 1,
  /** An index points past the last particle or vertex. */
  MUSLIN_STATUS_BAD_INDEX = 2,
  /** A handle of a cloth, grab, attachment or collider that is not there (any more). */
  MUSLIN_STATUS_BAD_HANDLE = 3,
  /** The triangles cannot be cloth. */
  MUSLIN_STATUS_BAD_MESH = 4,
  /** The bytes are not a saved cloth of this version, or were damaged. */
  MUSLIN_STATUS_BAD_SAVE = 5,
  /** The room that was reserved is used up. */
  MUSLIN_STATUS_FULL = 6,
  /** A wish that this version does not know or does not fulfil yet. */
  MUSLIN_STATUS_UNSUPPORTED = 7,
  /** The cloth is in use on another thread at this moment. */
  MUSLIN_STATUS_BUSY = 8,
  /** The caller's buffer is too small. */
  MUSLIN_STATUS_BUFFER_TOO_SMALL = 9,
  /** The ray meets nothing. Not a mistake, so it is not logged. */
  MUSLIN_STATUS_NOTHING_HIT = 10,
  /**
   * The edge did not give way: its ends are held, or it is a border. Not a mistake, so it is not
   * logged.
   */
  MUSLIN_STATUS_NOT_TORN = 11,
  /**
   * A defect of Muslin stopped the call half-way; please report it. The cloth is of no use any more:
   * all that it still takes is muslin_cloth_destroy.
   */
  MUSLIN_STATUS_PANICKED = 12,
} MuslinStatus;

/**
 * Gets a message of the library: its level (MUSLIN_LOG_...), a sentence that is valid for the time of
 * the call, and the `user` pointer of muslin_set_log.
 */
typedef void (*MuslinLogFn)(uint32_t level, const char *message, void *user);

/** A point, a direction or a velocity. */
typedef struct MuslinVec3 {
  /** Along x. */
  float x;
  /** Along y. */
  float y;
  /** Along z. */
  float z;
} MuslinVec3;

/**
 * What a cloth is made of, in SI units. All of it may change between ticks.
 *
 * Begin with muslin_material_init, or go on from there with muslin_material_preset, and change what
 * you need.
 */
typedef struct MuslinMaterial {
  /** Set by muslin_material_init. */
  uint32_t struct_size;
  /** Mass per area [kg/m^2]; 0.18, a cotton. Above 0. */
  float density;
  /** Gap kept from anything touched [m]; 0.00035. Keep it below half the shortest edge. */
  float thickness;
  /** Membrane stiffness along the warp (down a grid) [N/m]; 0 is as stiff as the sweeps allow. */
  float stretch_stiffness_warp;
  /**
   * Membrane stiffness along the weft (across a grid) [N/m]; 0 is as stiff as the sweeps allow.
   */
  float stretch_stiffness_weft;
  /** Stiffness against shear [N/m]; 0 is as the stretch stiffness. */
  float shear_stiffness;
  /**
   * Bending rigidity per width [N m]; 2.5e-5: what a strip that hangs from a clamp shows (BS 3356), however
   * fine the mesh, the tick and the sweeps are, whichever way it is cut: exactly on grids, within a twentieth
   * of its bending length on other meshes. 0 is limp; 1 or more is links over two cells instead, as rigid as the sweeps allow.
   */
  float bend_stiffness;
  /**
   * Damping of bending [s]; 0. Bending by some angle a second is resisted as that angle times this would be;
   * a few hundredths calm a flutter. At least 0.
   */
  float bend_damping;
  /** Damping of stretching [s]; 0. In the same way, for links that give way. At least 0. */
  float stretch_damping;
  /** Coulomb coefficient against colliders; 0.4. At least 0. */
  float friction;
  /** Share of the normal speed that a bounce gives back; 0. From 0 to 1. */
  float restitution;
  /** Pressure coefficient of a triangle square to the wind; 1.2. At least 0. */
  float drag;
  /** Lift coefficient of a triangle askew to the wind; 0. At least 0. */
  float lift;
  /**
   * Length over rest length at which an edge tears; 4. Above 1, or 0: never. At the end of a slit it takes
   * less, as the finer the mesh is the more of the load is there: sqrt(16 thickness / mean edge) of
   * the strain, at least a fifth of it; so a notch runs on at the same load whatever the mesh.
   */
  float tear_stretch;
  /** How uneven the weave is: 0 tears all edges alike, 1 varies the limit by half; 0.2. */
  float tear_variation;
  /**
   * Angle up to which a fold opens again [rad]; of one that was folded further, the rest stays. 0: all
   * opens. At least 0. Paper is near 0.8.
   */
  float yield_angle;
  /** Share of a fold beyond `yield_angle` that stays; 1. From 0 to 1. */
  float yield_creep;
  /**
   * Length of the sheet over which folding counts as one fold [m]; 0.01. The same angle over more than that is
   * only bent, and stays bent beyond a curvature of `yield_angle` over this. Three cells count at least.
   * At least 0.
   */
  float fold_length;
  /**
   * How much more a fold opens again, for each angle that it has given way by in all, to either side; 0. Of
   * one that is folded by an angle for the first time (angle - `yield_angle`) / (1 + this) stays, and to fold it
   * on takes as much more. At least 0. What gives way or is creased while this and `yield_weakening` are 0 is
   * not counted.
   */
  float yield_hardening;
  /**
   * How much weaker a fold gets by giving way [1/rad]; 0. Where it has given way by an angle in all, to either
   * side, `fold_length` of the sheet bends as if `bend_stiffness` were divided by 1 + this times angle, by at
   * most a thousand; pressed flat, it stays as weak. It gives way under the same moment as before, so that it
   * opens again by more: `yield_angle` times this counts as `yield_hardening` too. At least 0.
   */
  float yield_weakening;
} MuslinMaterial;

/**
 * How time runs: ticks, sweeps, gravity, damping and the switches of the solver. All of it may
 * change between ticks.
 *
 * One tick is `substeps` times (predict, then `iterations` sweeps over all links). More of either
 * makes the cloth stiffer; at the same cost substeps stiffen more than iterations do.
 * Begin with muslin_settings_init.
 */
typedef struct MuslinSettings {
  /** Set by muslin_settings_init. */
  uint32_t struct_size;
  /** Length of a tick [s]; 1/60. Above 0, at most 1. */
  float tick;
  /** Substeps in a tick; 4. From 1 to 1000. */
  uint32_t substeps;
  /**
   * Sweeps over the links in a substep, to and fro in turn; 2. From 1 to 1000. With a single sweep
   * velocities are of first order, which brakes all motion; from two on they are of second order,
   * and nothing brakes but `damping` and the air.
   */
  uint32_t iterations;
  /**
   * Ticks that one advance may run; 5. What a late frame owes beyond it is dropped. At least 1.
   */
  uint32_t max_ticks_per_advance;
  /** Acceleration of everything [m/s^2]; 0, -9.81, 0. */
  MuslinVec3 gravity;
  /**
   * Rate at which velocity decays [1/s]: as exp(-damping t), whatever the step; 0.5. At least 0.
   */
  float damping;
  /**
   * The farthest that a particle moves in a substep against the cloth's own rigid motion, in mean
   * rest lengths; 0.5. Above 0. A grabbed particle follows its pointer no faster than this either.
   */
  float max_displacement;
  /**
   * The most that any thread or diagonal is stretched after a tick, unless pins or grabs hold it
   * apart: 0.02 is 2 %; 0, no bound. At least 0.
   */
  float max_stretch;
  /**
   * 1: long-range attachments keep every particle within reach of the pins; 0: they do not. 1.
   * They bear what the sweeps do not get to, and nothing of what a load stretches soft links by.
   * From two iterations on, whole lines of links are solved at once as well.
   */
  uint32_t tethers;
  /**
   * Whether and how parts of the cloth keep apart: MUSLIN_SELF_COLLISION_NONE (this at first),
   * MUSLIN_SELF_COLLISION_SURFACE or MUSLIN_SELF_COLLISION_PARTICLES.
   */
  uint32_t self_collision;
  /**
   * Distance that they keep [m]; 0. Where surfaces keep apart 0 takes the material's thickness, and it is
   * at most half of the mean rest length; where particles do, 0 takes two thirds of that length, and it
   * is at most twice that length.
   */
  float self_distance;
  /** 1: over-stretched links tear, see `tear_stretch` of MuslinMaterial; 0: they do not. 0. */
  uint32_t tearing;
  /** Vertices that tearing may split in one tick, the worst first; 8. At least 1. */
  uint32_t max_tears_per_tick;
  /**
   * A cloth of which no particle was faster for half a second sleeps [m/s]: it stays just as it is, at
   * next to no cost, until something changes or touches it; 0, never. At least 0. Gusts, swirls and the
   * sine field keep a cloth awake. See `asleep` of MuslinStats.
   */
  float sleep_speed;
} MuslinSettings;

/**
 * A regular grid of particles; particle = row * columns + column. Begin with muslin_grid_desc_init.
 *
 * `material` and `settings` carry sizes of their own: replace them by structs that began with
 * muslin_material_init and muslin_settings_init in the same program.
 */
typedef struct MuslinGridDesc {
  /** Set by muslin_grid_desc_init. */
  uint32_t struct_size;
  /** Particles across; 40. At least 2. */
  uint32_t columns;
  /** Particles down; 40. At least 2. */
  uint32_t rows;
  /** Distance between neighbours [m]; 0.05. From 1e-6 to 1e6. */
  float spacing;
  /**
   * Where particle (0, 0), the top left, is [m]; 0, 0, 0. Within 2097152 `spacing` of zero along each axis.
   */
  MuslinVec3 origin;
  /** Unit direction of a row; 1, 0, 0. */
  MuslinVec3 right;
  /** Unit direction of a column, square to `right`; 0, -1, 0. */
  MuslinVec3 down;
  /**
   * What is pinned from the start: MUSLIN_PIN_NONE, MUSLIN_PIN_TOP_EDGE (this at first),
   * MUSLIN_PIN_TOP_CORNERS or MUSLIN_PIN_CORNERS.
   */
  uint32_t pin_mode;
  /** Particles that tears may add; MUSLIN_AS_MANY_AGAIN. */
  uint32_t extra_particles;
  /** What it is made of. */
  MuslinMaterial material;
  /** How its time runs. */
  MuslinSettings settings;
} MuslinGridDesc;

/**
 * A cloth; { 0 } is none. A destroyed or made-up one is refused as MUSLIN_STATUS_BAD_HANDLE.
 */
typedef struct MuslinCloth {
  /** Says which; it means nothing to you. */
  uint64_t id;
} MuslinCloth;

/**
 * Any triangle mesh, as artists export them. Begin with muslin_mesh_desc_init, then give it positions and
 * indices.
 *
 * What cannot be cloth in it is repaired, and muslin_cloth_get_mesh_report tells what was: doubled vertices are
 * welded, triangles without an area and repeated ones dropped; where more than two triangles share an edge the
 * flattest two stay joined and the others get an edge of their own; sheets that meet at a mere point are parted;
 * the triangles of a piece are turned to face as most of them do. Vertices that no triangle uses stay where they
 * are.
 *
 * A mesh that is a regular grid, its vertices and triangles in the order that muslin_cloth_create_grid has them,
 * is woven as that grid is: it moves in the same bits.
 *
 * All lists are copied while the cloth is made. `material` and `settings` carry sizes of their own:
 * replace them by structs that began with muslin_material_init and muslin_settings_init in the same
 * program.
 */
typedef struct MuslinMeshDesc {
  /** Set by muslin_mesh_desc_init. */
  uint32_t struct_size;
  /**
   * Where the vertices are at rest [m], 3 numbers a vertex. Each is the particle of its number if nothing is
   * welded or split, see MuslinView's `particles`.
   */
  const float *positions;
  /** Bytes from one position to the next; 0, which is 12. A multiple of 4. */
  uint32_t position_stride;
  /** How many vertices there are; 0. From 3 to 4194304. */
  uint32_t vertex_count;
  /** Vertices of the triangles, 3 a triangle, counter-clockwise seen from its front. */
  const uint32_t *indices;
  /** How many indices there are; 0. A multiple of 3, at most 50331648. */
  uint32_t index_count;
  /** Texture coordinates, 2 numbers a vertex; or NULL: none. */
  const float *uvs;
  /** Vertices whose particles are pinned from the start; or NULL: none. */
  const uint32_t *pinned;
  /** How many `pinned` there are; 0. At most `vertex_count`. */
  uint32_t pinned_count;
  /**
   * Vertices at most this far apart share a particle [m]; 0 joins those at the very same place, -1 (or
   * anything below 0) leaves all apart. Vertices are taken in order, and each joins the nearest one before
   * it that stayed apart; but the corners of a triangle stay apart, however small it is. Keep it well below
   * the shortest edge.
   */
  float weld_distance;
  /** Particles that tears may add; MUSLIN_AS_MANY_AGAIN. */
  uint32_t extra_particles;
  /** What it is made of. */
  MuslinMaterial material;
  /** How its time runs. */
  MuslinSettings settings;
} MuslinMeshDesc;

/**
 * The air around a cloth. It gusts, wanders and swirls, always the same way for the same seed.
 * Begin with muslin_wind_init: still air.
 */
typedef struct MuslinWind {
  /** Set by muslin_wind_init. */
  uint32_t struct_size;
  /** How the air pushes: MUSLIN_WIND_SURFACE (this at first) or MUSLIN_WIND_SINE_FIELD. */
  uint32_t model;
  /** Mean velocity of the air [m/s]; 0, 0, 0. */
  MuslinVec3 velocity;
  /** How much the speed swells and falls, as a share of it; 0. From 0 to 1. */
  float gust;
  /** How far the direction strays [rad]; 0. From 0 to pi. */
  float wander;
  /** Swirls in space, as a share of the speed; 0. From 0 to 1. */
  float turbulence;
  /** Density of the air [kg/m^3]; 1.2. At least 0; 0 is a vacuum. */
  float air_density;
  /** Which gusts and swirls; 0. */
  uint32_t seed;
} MuslinWind;

/** A rotation: a unit quaternion; { 0, 0, 0, 1 } turns nothing. */
typedef struct MuslinQuat {
  /** Axis along x times the sine of half the angle. */
  float x;
  /** Axis along y times the sine of half the angle. */
  float y;
  /** Axis along z times the sine of half the angle. */
  float z;
  /** Cosine of half the angle. */
  float w;
} MuslinQuat;

/**
 * A transform that particles of one cloth are attached to; { 0 } is none. It is of use with the cloth that
 * gave it, and with those restored from it.
 */
typedef struct MuslinAttachment {
  /** Says which; it means nothing to you. */
  uint32_t id;
} MuslinAttachment;

/** Where a ray hits a cloth. Begin with muslin_hit_init. */
typedef struct MuslinHit {
  /** Set by muslin_hit_init. */
  uint32_t struct_size;
  /** The triangle that was hit: index 3 * triangle and the two after it. */
  uint32_t triangle;
  /** Its particle nearest to the hit. */
  uint32_t particle;
  /** Weight of the triangle's second corner. */
  float u;
  /** Weight of the triangle's third corner. */
  float v;
  /** Distance from the ray's origin [m]. */
  float distance;
  /** Where [m]. */
  MuslinVec3 position;
  /** Unit normal of the triangle, on the side that was hit. */
  MuslinVec3 normal;
} MuslinHit;

/**
 * A hold on one particle of one cloth; { 0 } is none. It is of use with the cloth that gave it, and
 * with those restored from it.
 */
typedef struct MuslinGrab {
  /** Says which; it means nothing to you. */
  uint32_t id;
} MuslinGrab;

/**
 * Something that happened in a tick. Fields that its kind does not mention are 0. `particle_a` and `particle_b`
 * are particles, `vertex` and `source` are vertices, see MuslinView's `particles`. Begin with
 * muslin_event_init.
 */
typedef struct MuslinEvent {
  /** Set by muslin_event_init. */
  uint32_t struct_size;
  /** What happened: one of MUSLIN_EVENT_... */
  uint32_t kind;
  /** In which tick, counted from creation or reset. */
  uint32_t tick;
  /** Where [m]. */
  MuslinVec3 position;
  /** An end of the edge. */
  uint32_t particle_a;
  /** The other end. */
  uint32_t particle_b;
  /** The vertex that came to be. */
  uint32_t vertex;
  /** The vertex that it was split off from. */
  uint32_t source;
  /** How many. */
  uint32_t count;
} MuslinEvent;

/**
 * A collider: its shape, where it is and how it feels. Begin with muslin_collider_desc_init: a floor
 * at height 0. Fields that its shape does not use are ignored; all lists are copied while it is added.
 */
typedef struct MuslinColliderDesc {
  /** Set by muslin_collider_desc_init. */
  uint32_t struct_size;
  /** What it is, one of MUSLIN_SHAPE_...; MUSLIN_SHAPE_PLANE. */
  uint32_t shape;
  /** Where it is [m]; 0, 0, 0. A point of the surface of a plane. */
  MuslinVec3 position;
  /** How it is turned; not at all. A plane's normal is the turned y axis. */
  MuslinQuat rotation;
  /** Coulomb coefficient; -1, which takes the material's. Else at least 0. */
  float friction;
  /**
   * Share of the normal speed that a bounce gives back; -1, which takes the material's. Else from
   * 0 to 1.
   */
  float restitution;
  /**
   * Share of the sliding speed that every substep of touching leaves, beside Coulomb friction; 1,
   * all of it. From 0 to 1.
   */
  float tangential_restitution;
  /**
   * Gap kept from its surface [m]; -1, which takes the material's thickness. Else at least 0. Where a surface is
   * round or bends little, particles stay farther off by what is between them would sink in: at most a fifth
   * of the mean edge from balls and capsules, a tenth from others.
   */
  float thickness;
  /** Of a sphere or capsule [m]; 0.5. Above 0. */
  float radius;
  /** Of the upper end of a capsule [m]; -1, which is as `radius`. Else above 0. */
  float top_radius;
  /** Of a capsule: from its middle to the centres of its ends [m]; 0.5. At least 0. */
  float half_height;
  /** Of a box: from its middle to its sides [m]; 0.5 each. Above 0. */
  MuslinVec3 half_extents;
  /** Of a heightfield: from one height to the next [m]; 1. Above 0. */
  float spacing;
  /** Of a heightfield: heights along x; 0. From 2 to 4096. */
  uint32_t columns;
  /** Of a heightfield: heights along z; 0. From 2 to 4096. */
  uint32_t rows;
  /** Bytes from one position to the next; 0, which is 12. A multiple of 4. */
  uint32_t position_stride;
  /**
   * How many positions there are; 0. Of a convex body from 4 to 1024, of a mesh at most 4194304.
   */
  uint32_t vertex_count;
  /** How many indices there are; 0. A multiple of 3, at most 50331648. */
  uint32_t index_count;
  /** Of a convex body or a mesh: its points [m], 3 numbers each. */
  const float *positions;
  /** Of a mesh: points of its triangles, 3 each. Triangles without an area do not count. */
  const uint32_t *indices;
  /** Of a heightfield: `columns` * `rows` heights [m], row by row along x. */
  const float *heights;
} MuslinColliderDesc;

/**
 * A collider of one cloth; { 0 } is none. It is of use with the cloth that gave it, and with those
 * restored from it.
 */
typedef struct MuslinCollider {
  /** Says which; it means nothing to you. */
  uint32_t id;
} MuslinCollider;

/**
 * A cloth as its renderer sees it: the library's own memory, borrowed. Begin with muslin_view_init.
 *
 * The pointers stay valid, and what they point to stays as it is, until the next call that changes
 * the cloth (advance, step, reset, pin, set_position, tear_edge, cut, destroy, ...). Read, do not write.
 */
typedef struct MuslinView {
  /** Set by muslin_view_init. */
  uint32_t struct_size;
  /** Positions [m], 3 numbers a vertex. */
  const float *positions;
  /**
   * Unit normals, area-weighted, 3 numbers a vertex; zeros for a vertex that no triangle uses. Vertices that
   * share a particle share its normal.
   */
  const float *normals;
  /** Texture coordinates, 2 numbers a vertex. */
  const float *uvs;
  /** Vertices of the triangles, 3 a triangle. */
  const uint32_t *indices;
  /**
   * Which original vertex each vertex came from, 1 a vertex; for one that a cut made on an edge, the
   * nearer end's.
   */
  const uint32_t *source_vertices;
  /** How many vertices there are. */
  uint32_t vertex_count;
  /** How many indices there are: 3 a triangle. */
  uint32_t index_count;
  /** How many vertices there may ever be. */
  uint32_t vertex_capacity;
  /** How many indices there may ever be. */
  uint32_t index_capacity;
  /** Changes when indices do. */
  uint32_t topology_revision;
  /** Changes when positions do. */
  uint32_t state_revision;
  /**
   * 1 for a vertex at a border that a tear or a cut made, which a renderer may fringe; 0 for others,
   * those at the borders that the cloth was made with among them. 1 byte a vertex.
   */
  const uint8_t *frayed;
  /**
   * The particle of each vertex, 1 a vertex. A mesh that was welded or had sheets to be parted has several
   * vertices to a particle; else each vertex is the particle of its number.
   *
   * Calls that touch the cloth (pins, grabs, tears by hand, positions and velocities) take particles, and
   * what a ray hits tells one. Of an event, `particle_a` and `particle_b` are particles, `vertex` and `source`
   * are vertices. Triangles have the same numbers in both.
   */
  const uint32_t *particles;
} MuslinView;

/**
 * The parts of a cloth's lists that changed with its triangles since some revision: of what does not
 * change with every tick, as texture coordinates, source vertices and frayed borders. Begin with
 * muslin_changes_init.
 */
typedef struct MuslinChanges {
  /** Set by muslin_changes_init. */
  uint32_t struct_size;
  /** The first vertex that is new or not as it was. */
  uint32_t first_vertex;
  /** How many vertices from there on. */
  uint32_t vertex_count;
  /** The first index that is new or not as it was. */
  uint32_t first_index;
  /** How many indices from there on. */
  uint32_t index_count;
} MuslinChanges;

/**
 * What had to be repaired of a mesh before it could be cloth, and what it is now. Begin with
 * muslin_mesh_report_init.
 *
 * Repairs come in this order: vertices are welded, triangles without an area and repeated ones are dropped,
 * edges and vertices where more than one sheet meets are split, triangles that face the other way are turned.
 */
typedef struct MuslinMeshReport {
  /** Set by muslin_mesh_report_init. */
  uint32_t struct_size;
  /** Vertices that were given. */
  uint32_t vertices;
  /** Triangles that were given. */
  uint32_t triangles;
  /** Particles that came of it. */
  uint32_t particles;
  /** Triangles that were kept. */
  uint32_t kept_triangles;
  /** Vertices that joined another one's particle. */
  uint32_t welded_vertices;
  /** Triangles that were dropped: they had no area, or named a vertex twice. */
  uint32_t dropped_degenerate;
  /** Triangles that were dropped: an earlier one has the same corners. */
  uint32_t dropped_duplicates;
  /** Triangles that were turned round, so that they face as their neighbours do. */
  uint32_t turned_triangles;
  /** Edges that had more than two triangles. */
  uint32_t split_edges;
  /**
   * Particles that came to be where sheets were parted that met at such an edge or at a mere point.
   */
  uint32_t split_vertices;
  /**
   * Vertices that no triangle uses. They are particles without mass that stay where they are, unless they
   * were welded.
   */
  uint32_t unused_vertices;
  /** Pieces: sets of triangles joined by edges. */
  uint32_t pieces;
  /**
   * Pieces that have no two sides, such as a Moebius strip: a line across them is left where neighbours face
   * opposite ways.
   */
  uint32_t one_sided_pieces;
  /** 1 if it is woven as the regular grid that it was found to be; 0. */
  uint32_t is_grid;
} MuslinMeshReport;

/** Numbers about a cloth. Begin with muslin_stats_init. */
typedef struct MuslinStats {
  /** Set by muslin_stats_init. */
  uint32_t struct_size;
  /** How many particles there are. */
  uint32_t particles;
  /** How many triangles there are. */
  uint32_t triangles;
  /** How many links it was woven with. */
  uint32_t constraints;
  /** How many links hold now. */
  uint32_t active_constraints;
  /** How many pieces hang together by edges. */
  uint32_t pieces;
  /** Ticks since it was made or reset. */
  uint32_t ticks;
  /**
   * The share of a tick that advance still owes, 0 to 1: how far to blend from the last tick's
   * positions to this one's when drawing.
   */
  float blend;
  /** The greatest stretch of a stretch link: 0.01 is 1 % over its rest length. */
  float max_stretch;
  /** The mean stretch of the stretch links. */
  float mean_stretch;
  /** Energy of motion [J]. */
  float kinetic_energy;
  /** How many of `seconds` tell of a stage. */
  uint32_t stage_count;
  /** Memory that it holds [B], about. */
  uint64_t bytes;
  /**
   * Time that each stage took in the last call that ran ticks [s]; muslin_stage_name names them.
   * Timing begins with the first muslin_cloth_get_stats of a cloth: until then zeros.
   */
  float seconds[MUSLIN_STAGE_SLOTS];
  /**
   * How many links are past `max_stretch`, if there is such a bound: pins or grabs hold them apart.
   */
  uint32_t over_stretched;
  /** 1 if it sleeps, see `sleep_speed` of MuslinSettings. */
  uint32_t asleep;
  /** The speed of its fastest particle [m/s]. */
  float max_speed;
} MuslinStats;

/**
 * A place that one attribute of vertices is written to. Streams may share a buffer: interleaved, at
 * equal strides, or one behind the other. Begin with muslin_stream_init, or take muslin_stream.
 */
typedef struct MuslinStream {
  /** Set by muslin_stream_init; equal for all streams of a call. */
  uint32_t struct_size;
  /** What is written: MUSLIN_ATTRIBUTE_...; MUSLIN_ATTRIBUTE_POSITION. */
  uint32_t attribute;
  /** How: MUSLIN_FORMAT_...; MUSLIN_FORMAT_F32. */
  uint32_t format;
  /**
   * Bytes from one vertex to the next: a multiple of the 4 (MUSLIN_FORMAT_F32) or 2 bytes of a number,
   * and at least what the attribute takes; 0, which leaves no gaps.
   */
  uint32_t stride;
  /** Where the first vertex goes, aligned to a number; NULL. It is yours, not a view's. */
  void *buffer;
  /** Bytes from there to the end of the buffer; 0. */
  size_t size;
} MuslinStream;

/**
 * Which vertices are written, and how they are placed. Begin with muslin_write_desc_init: all, as they
 * are.
 */
typedef struct MuslinWriteDesc {
  /** Set by muslin_write_desc_init. */
  uint32_t struct_size;
  /** The first vertex; 0. It goes to the beginning of each stream. */
  uint32_t first_vertex;
  /** How many; MUSLIN_ALL_VERTICES. */
  uint32_t vertex_count;
  /**
   * How far from the last tick to this one, from 0 to 1; 1. The stats' `blend` is how far the time is
   * that was asked for. Normals and tangents are those of the surface there.
   */
  float blend;
  /**
   * What is done to positions, after the offset: three rows of four, so that x becomes
   * t[0] x + t[1] y + t[2] z + t[3]; nothing. Normals stay square to the surface and on their side of
   * it, tangents along it.
   */
  float transform[12];
  /** 1 if normals point to the other side, for the back of a cloth; 0. */
  uint32_t flip_normals;
  /**
   * How far positions are moved along the normals that are written [m]; 0. Half of the thickness on
   * either side gives a cloth a body.
   */
  float offset;
} MuslinWriteDesc;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/** The version of the library that runs: 0x00MMmmpp, major, minor, patch. */
uint32_t muslin_version(void);

/** The version of the library that runs: "major.minor.patch". Always valid. */
const char *muslin_version_string(void);

/** What a MuslinStatus says in general, any number: never NULL, always valid. */
const char *muslin_status_string(uint32_t status);

/**
 * Why the last call of this thread that was refused was refused: a sentence that names the field and
 * the rule. "" if none was yet. Calls that are not refused leave it as it is.
 *
 * Never NULL; valid until the next call of this thread that is refused.
 */
const char *muslin_last_error(void);

/**
 * The name of a stage of a tick, 0 and up, for `seconds` of MuslinStats: always valid; NULL for a stage
 * that is not.
 */
const char *muslin_stage_name(uint32_t stage);

/**
 * Sends what the library has to say, up to `max_level` (MUSLIN_LOG_ERROR, MUSLIN_LOG_WARN,
 * MUSLIN_LOG_INFO), to `log`. At first, and with NULL, it is silent.
 *
 * `log` is called on whichever thread made the library speak, maybe on several at once, and may call
 * the library. `user` is handed to it and nothing else. Both must be good until they are replaced and
 * until calls that are under way on other threads have returned.
 */
MuslinStatus muslin_set_log(MuslinLogFn log,
                            uint32_t max_level,
                            void *user);

/**
 * Makes a cloth from a regular grid. Destroy it with muslin_cloth_destroy.
 *
 * @return MUSLIN_STATUS_BAD_VALUE names the field of `desc` that cannot be, and the rule;
 * MUSLIN_STATUS_UNSUPPORTED what this version does not do yet
 */
MuslinStatus muslin_cloth_create_grid(const MuslinGridDesc *desc,
                                      MuslinCloth *out_cloth);

/**
 * Makes a cloth from any triangle mesh; its lists are copied. What cannot be cloth in it is repaired, see
 * muslin_cloth_get_mesh_report. Destroy it with muslin_cloth_destroy.
 *
 * @return MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX names the field of `desc` that cannot be,
 * and the rule; MUSLIN_STATUS_BAD_MESH what is beyond repair: a triangle whose area is not finite, or that none
 * has an area; MUSLIN_STATUS_UNSUPPORTED what this version does not do yet
 */
MuslinStatus muslin_cloth_create_mesh(const MuslinMeshDesc *desc,
                                      MuslinCloth *out_cloth);

/**
 * Destroys a cloth: its handle is stale from then on, and what was borrowed from it is gone.
 */
MuslinStatus muslin_cloth_destroy(MuslinCloth cloth);

/**
 * Back to the start: rest shape, untorn, at rest, pinned as it was made, at time zero, no grabs and no
 * events. Settings, material, wind and colliders stay as they are.
 */
MuslinStatus muslin_cloth_reset(MuslinCloth cloth);

/**
 * Fills in the figures of a fabric: MUSLIN_PRESET_SILK, MUSLIN_PRESET_COTTON, MUSLIN_PRESET_DENIM,
 * MUSLIN_PRESET_LEATHER, MUSLIN_PRESET_PAPER or MUSLIN_PRESET_FLAG_NYLON. `material` has begun with
 * muslin_material_init, or is part of a descriptor that has begun.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for any other `preset`
 */
MuslinStatus muslin_material_preset(MuslinMaterial *material, uint32_t preset);

/** How time runs. `out_settings` has begun with muslin_settings_init. */
MuslinStatus muslin_cloth_get_settings(MuslinCloth cloth,
                                       MuslinSettings *out_settings);

/**
 * Changes how time runs, from the next tick on. Velocities stay as they are.
 *
 * @return MUSLIN_STATUS_BAD_VALUE names the field and the rule; MUSLIN_STATUS_UNSUPPORTED what this
 * version does not do yet
 */
MuslinStatus muslin_cloth_set_settings(MuslinCloth cloth,
                                       const MuslinSettings *settings);

/** What it is made of. `out_material` has begun with muslin_material_init. */
MuslinStatus muslin_cloth_get_material(MuslinCloth cloth,
                                       MuslinMaterial *out_material);

/**
 * Changes what it is made of, from the next tick on. Velocities stay as they are.
 *
 * @return MUSLIN_STATUS_BAD_VALUE names the field and the rule
 */
MuslinStatus muslin_cloth_set_material(MuslinCloth cloth,
                                       const MuslinMaterial *material);

/**
 * Changes the air around it, from the next tick on.
 *
 * @return MUSLIN_STATUS_BAD_VALUE names the field and the rule
 */
MuslinStatus muslin_cloth_set_wind(MuslinCloth cloth, const MuslinWind *wind);

/**
 * Runs the ticks that a frame of `seconds` [s] owes; `out_ticks` (may be NULL) gets their number.
 *
 * What is left over waits for the next frame, see `blend` of MuslinStats. A late frame owes at most
 * `max_ticks_per_advance`; the rest is dropped. Zero changes nothing.
 *
 * @return MUSLIN_STATUS_BAD_VALUE if `seconds` is negative or not finite
 */
MuslinStatus muslin_cloth_advance(MuslinCloth cloth,
                                  float seconds,
                                  uint32_t *out_ticks);

/** Runs exactly `ticks` ticks. */
MuslinStatus muslin_cloth_step(MuslinCloth cloth, uint32_t ticks);

/**
 * Holds a particle at `target` [m], or where it is if that is NULL. The target is reached over the
 * next tick; a particle that is pinned already gets a new target, which nothing carries, and keeps its
 * stiffness.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a target that
 * is not finite
 */
MuslinStatus muslin_cloth_pin(MuslinCloth cloth,
                              uint32_t particle,
                              const MuslinVec3 *target);

/**
 * Lets a particle go. One that is not pinned stays as it is.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not
 */
MuslinStatus muslin_cloth_unpin(MuslinCloth cloth, uint32_t particle);

/** Lets every particle go. */
MuslinStatus muslin_cloth_unpin_all(MuslinCloth cloth);

/**
 * Gives `count` pins their targets at once; particles that are not pinned yet are from now on. The
 * targets [m] are 3 floats each at `positions`, and begin `stride` bytes apart: 0 is 12, else a multiple
 * of 4. No more than there are particles; with 0 both pointers may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a target that
 * is not finite, or a rule above
 */
MuslinStatus muslin_cloth_set_pin_targets(MuslinCloth cloth,
                                          const uint32_t *particles,
                                          const void *positions,
                                          uint32_t stride,
                                          uint32_t count);

/**
 * Says how hard `count` pins pull towards their targets [N/m]: as springs, or exactly if `stiffness` is 0,
 * as they do at first. A soft pin holds a load of 1 N 1/`stiffness` from its target; the cloth counts as free
 * there, for tears and for max_stretch, and is not tethered to it. 1e3 N/m feels firm, 10 N/m lets a sheet of
 * cotton sag by a few centimetres. A tear through a soft pin shares its stiffness out by mass. With 0
 * particles the pointer may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for one that is
 * not pinned, a stiffness that is below 0 or not finite, or more than there are particles
 */
MuslinStatus muslin_cloth_set_pin_stiffness(MuslinCloth cloth,
                                            const uint32_t *particles,
                                            uint32_t count,
                                            float stiffness);

/**
 * Makes `count` particles heavier or lighter than their material, by a factor each: 1, as at first, is what
 * its density and the area about them give. A hem of 5 hangs straight; a coin sewn in may be 100. Factors
 * stay when the density changes. Neighbours may well be a hundredfold apart; where it is thousands, what
 * hangs by the light ones stretches them until there are more substeps. With 0 particles both pointers may
 * be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a factor that is
 * not from 0.001 to 1000, or more than there are particles
 */
MuslinStatus muslin_cloth_set_mass_scales(MuslinCloth cloth,
                                          const uint32_t *particles,
                                          const float *scales,
                                          uint32_t count);

/**
 * Puts a particle somewhere [m], at once; it keeps its velocity. A pin goes with it.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a position
 * that is not finite
 */
MuslinStatus muslin_cloth_set_position(MuslinCloth cloth,
                                       uint32_t particle,
                                       MuslinVec3 position);

/**
 * Gives a particle a velocity [m/s].
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a velocity
 * that is not finite
 */
MuslinStatus muslin_cloth_set_velocity(MuslinCloth cloth,
                                       uint32_t particle,
                                       MuslinVec3 velocity);

/**
 * Attaches `count` particles to a transform at `position` [m], turned by `rotation`: a bone, a pole, the body
 * of a car. They are pinned where they are now, and from then on muslin_cloth_move_attachment carries them.
 * Those that are pinned already, or attached to something else, keep their stiffness. One that gets a target
 * of its own later, or is unpinned, leaves the attachment. Vertices that a tear or a cut makes of attached
 * ones are attached too. With 0 particles the pointer may be NULL. No attachment outlives a reset.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a position that is
 * not finite, a rotation that is no unit quaternion, or more than there are particles; MUSLIN_STATUS_FULL if
 * there are 64 attachments already
 */
MuslinStatus muslin_cloth_attach(MuslinCloth cloth,
                                 const uint32_t *particles,
                                 uint32_t count,
                                 MuslinVec3 position,
                                 MuslinQuat rotation,
                                 MuslinAttachment *out_attachment);

/**
 * Moves a transform that particles are attached to: they get there over the next tick, turning on the way
 * as it turns, and are exactly there when it ends.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was detached; MUSLIN_STATUS_BAD_VALUE for a position that is not
 * finite or a rotation that is no unit quaternion
 */
MuslinStatus muslin_cloth_move_attachment(MuslinCloth cloth,
                                          MuslinAttachment attachment,
                                          MuslinVec3 position,
                                          MuslinQuat rotation);

/**
 * Lets all go that an attachment still carries, with the velocity that they have.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was detached before
 */
MuslinStatus muslin_cloth_detach(MuslinCloth cloth, MuslinAttachment attachment);

/**
 * Says how far `count` particles may be from their anchors [m]: after every tick none is farther, whatever
 * pulls at it. Infinity, as at first, is as far as they like; 0 holds them there. The anchor of a particle is
 * where muslin_cloth_set_anchors has it, and until that was called where the particle is now. A pinned or
 * grabbed particle goes by that alone. What keeps a cloth apart so may stretch it past max_stretch, which is
 * told as if pins did. With 0 particles both pointers may be NULL. None outlives a reset.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a distance that is
 * not at least 0, or more than there are particles
 */
MuslinStatus muslin_cloth_set_max_distances(MuslinCloth cloth,
                                            const uint32_t *particles,
                                            const float *distances,
                                            uint32_t count);

/**
 * Gives `count` particles backstops: spheres behind their anchors that they stay out of, so that a garment
 * does not sink into the body that wears it. Each has a radius [m], 0 for none, and begins a distance [m]
 * behind its anchor, against the normal that muslin_cloth_set_anchors gave: without one there is no
 * backstop. With 0 particles the pointers may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a distance or
 * radius that is below 0 or not finite, or more than there are particles
 */
MuslinStatus muslin_cloth_set_backstops(MuslinCloth cloth,
                                        const uint32_t *particles,
                                        const float *distances,
                                        const float *radii,
                                        uint32_t count);

/**
 * Says where animation has `count` particles [m], and which way is out of the body there, for
 * muslin_cloth_set_max_distances and muslin_cloth_set_backstops. Call it each frame: anchors get there over
 * the next tick, and those of particles that had none are there at once. Positions and normals are 3 floats
 * each, and begin `stride` bytes apart in both: 0 is 12, else a multiple of 4. Normals need not be of length
 * 1; with NULL those of before stay. With 0 particles all pointers may be NULL.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a number that is not
 * finite, a normal of no length, more than there are particles, or a rule above
 */
MuslinStatus muslin_cloth_set_anchors(MuslinCloth cloth,
                                      const uint32_t *particles,
                                      const void *positions,
                                      const void *normals,
                                      uint32_t stride,
                                      uint32_t count);

/** Takes away all anchors, maximum distances and backstops. */
MuslinStatus muslin_cloth_clear_leashes(MuslinCloth cloth);

/**
 * The first triangle along a ray, within `max_distance` [m] (which may be infinite), hit from either
 * side. `direction` need not have length one. `out_hit` has begun with muslin_hit_init.
 *
 * @return MUSLIN_STATUS_NOTHING_HIT if there is none; MUSLIN_STATUS_BAD_VALUE unless `origin` and
 * `direction` are finite, `direction` is not zero, and `max_distance` is at least 0
 */
MuslinStatus muslin_cloth_raycast(MuslinCloth cloth,
                                  MuslinVec3 origin,
                                  MuslinVec3 direction,
                                  float max_distance,
                                  MuslinHit *out_hit);

/**
 * Takes hold of the particle that a ray points at: the nearest one of the triangle that it hits, or
 * else the nearest one within `radius` [m] of it. `out_at` (may be NULL) gets where that particle is
 * [m].
 *
 * @return MUSLIN_STATUS_NOTHING_HIT if there is none; MUSLIN_STATUS_BAD_VALUE unless `origin` and
 * `direction` are finite, `direction` is not zero, and `radius` is at least 0 and finite;
 * MUSLIN_STATUS_FULL if 64 grabs are held already
 */
MuslinStatus muslin_cloth_grab_ray(MuslinCloth cloth,
                                   MuslinVec3 origin,
                                   MuslinVec3 direction,
                                   float radius,
                                   MuslinGrab *out_grab,
                                   MuslinVec3 *out_at);

/**
 * Takes hold of a particle where it is. It follows muslin_cloth_move_grab exactly, but for a limit of
 * `max_displacement` a substep, and carries the cloth along.
 *
 * @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_FULL if 64 grabs are held
 * already
 */
MuslinStatus muslin_cloth_grab_particle(MuslinCloth cloth,
                                        uint32_t particle,
                                        MuslinGrab *out_grab);

/**
 * Gives a grab a new target [m].
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if the grab was released; MUSLIN_STATUS_BAD_VALUE for a target that
 * is not finite
 */
MuslinStatus muslin_cloth_move_grab(MuslinCloth cloth,
                                    MuslinGrab grab,
                                    MuslinVec3 target);

/**
 * Lets a grabbed particle go, with the velocity it has. One that is pinned stays pinned, and returns to
 * its pin over the next tick.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if the grab was released before
 */
MuslinStatus muslin_cloth_release(MuslinCloth cloth,
                                  MuslinGrab grab);

/**
 * Tears the cloth between two neighbouring particles, as over-stretching would: the more loaded of the
 * two is split by the plane across the way between them. Where neither has anything on its other
 * side, the edge itself opens, if it starts at a border.
 *
 * @return MUSLIN_STATUS_NOT_TORN if it did not give way: both ends are pinned or grabbed, or the edge is
 * a border already; MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE unless
 * the two are the ends of an edge; MUSLIN_STATUS_FULL if the reserve for tears is used up
 */
MuslinStatus muslin_cloth_tear_edge(MuslinCloth cloth,
                                    uint32_t particle_a,
                                    uint32_t particle_b);

/**
 * Gives the cloth a fold of `angle` [rad] along a line, from `from` to `to` [m], both where they are in the
 * cloth as it was made. From then on the cloth rests folded by so much more along it: towards its front,
 * where the triangles are counter-clockwise, if `angle` is above 0, and else away from it.
 *
 * The line need not follow the mesh: the fold is shared out over the cells beside it. It bends no more than
 * `bend_stiffness` can make it, and stays until muslin_cloth_reset; folding by -`angle` along the same line
 * takes it away. Where the line is not on the cloth nothing is folded.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for a number that is not finite, for `to` equal to `from`, and unless
 * `angle` is from -3 to 3; the cloth is untouched then
 */
MuslinStatus muslin_cloth_crease(MuslinCloth cloth,
                                 MuslinVec3 from,
                                 MuslinVec3 to,
                                 float angle);

/**
 * Cuts the cloth with a blade: the segment from `from` to `to` [m], swept along `sweep` [m]. `out_edges`
 * (may be NULL) gets how many edges opened; 0 leaves the cloth as it was.
 *
 * Triangles that the blade goes through are divided along it: vertices come to be on the edges that it
 * crosses, between their ends in all that they have, and the mesh opens along them. Where it would come
 * nearer to a vertex than an eighth of an edge, or leave a triangle with an angle below 5 degrees or
 * less area than one in 200 of a square of the mean edge, the cut goes through the nearer vertex
 * instead; past a pinned one it goes at an eighth of the edge. Where the blade ends inside a triangle,
 * the cut ends at the edge before. Vertices that a cut makes are free; a pinned one that it goes through
 * is pinned on both sides. Mass and area at rest stay. Each edge that is crossed takes one particle of
 * the reserve (`extra_particles`), and one more where it opens.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for a number that is not finite, or unless `to` is apart from `from` and
 * `sweep` leads away from the line through both; MUSLIN_STATUS_FULL if the reserve cannot take the whole
 * cut; the cloth is untouched then
 */
MuslinStatus muslin_cloth_cut(MuslinCloth cloth,
                              MuslinVec3 from,
                              MuslinVec3 to,
                              MuslinVec3 sweep,
                              uint32_t *out_edges);

/**
 * Takes the oldest event that was not read yet; the 1024 newest are kept. `out_some` becomes 1, or 0 if
 * there is none, which leaves `out_event` as it is. `out_event` has begun with muslin_event_init.
 *
 * They come by tick; in a tick recoveries first, then tears, the worst first, and of each the vertices that
 * it split before the torn edge; then, if there was no room for another, that; then the pieces that
 * came off, in the order of their first triangles; then what is held apart. A cut tells the edges that it
 * divided, in its order; those that it opened; the vertices that it split; and the pieces.
 */
MuslinStatus muslin_cloth_next_event(MuslinCloth cloth,
                                     MuslinEvent *out_event,
                                     uint32_t *out_some);

/**
 * Adds a collider to a cloth.
 *
 * @return MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX names the field and the rule;
 * MUSLIN_STATUS_UNSUPPORTED for a shape that this version does not know; MUSLIN_STATUS_FULL if there are
 * 1024 colliders already
 */
MuslinStatus muslin_cloth_add_collider(MuslinCloth cloth,
                                       const MuslinColliderDesc *desc,
                                       MuslinCollider *out_collider);

/**
 * Moves a collider; it gets there over the next tick, so that it sweeps.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was removed; MUSLIN_STATUS_BAD_VALUE for a position that is not
 * finite or a rotation that is no unit quaternion
 */
MuslinStatus muslin_cloth_move_collider(MuslinCloth cloth,
                                        MuslinCollider collider,
                                        MuslinVec3 position,
                                        MuslinQuat rotation);

/**
 * Removes a collider.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was removed before
 */
MuslinStatus muslin_cloth_remove_collider(MuslinCloth cloth,
                                          MuslinCollider collider);

/**
 * Tells what the cloth did to a collider in the last tick: `out_linear` (may be NULL) gets the momentum
 * [kg m/s], `out_angular` (may be NULL) the angular momentum about the collider's position [kg m2/s].
 * Divided by the length of a tick they are the force and the torque, for an engine that moves what the
 * cloth lies on.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was removed
 */
MuslinStatus muslin_cloth_get_collider_impulse(MuslinCloth cloth,
                                               MuslinCollider collider,
                                               MuslinVec3 *out_linear,
                                               MuslinVec3 *out_angular);

/**
 * Says where the body is that wears the cloth, and how it is turned: muslin_cloth_teleport and
 * muslin_cloth_move_frame go from there. At first, and after a reset, that is the origin. It moves nothing.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for a position that is not finite or a rotation that is no unit quaternion
 */
MuslinStatus muslin_cloth_set_frame(MuslinCloth cloth,
                                    MuslinVec3 position,
                                    MuslinQuat rotation);

/**
 * Takes the cloth along as the body that wears it jumps from where muslin_cloth_set_frame, muslin_cloth_move_frame
 * or the last teleport had it: at once, as a solid body, and without feeling it. Velocities turn with it. Pins, attachments, grabs
 * and anchors go along; colliders do not, see muslin_cloth_teleport_collider. In a frame it comes before
 * muslin_cloth_move_attachment and muslin_cloth_set_anchors.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for a position that is not finite or a rotation that is no unit quaternion, or if
 * something would get farther off than a number can say
 */
MuslinStatus muslin_cloth_teleport(MuslinCloth cloth,
                                   MuslinVec3 position,
                                   MuslinQuat rotation);

/**
 * Takes the cloth along as the body that wears it runs and turns on from where muslin_cloth_set_frame,
 * muslin_cloth_teleport or the last muslin_cloth_move_frame had it: over the next tick, and with only a share
 * of its inertia. At 1 it feels all of the body's motion, as if nothing were said; at 0 none, as if the body stood
 * still and the rest of the world moved past; between, so much of it, both of the way and of the turn.
 *
 * What is not felt takes particles along at once, as a solid body; over the tick they, pins, attachments and
 * anchors get to where the body has them then. Colliders and grabs stay where they are told to be, and the
 * cloth meets them as one who goes with the body sees them move. Air goes along as far as the motion is not
 * felt. In a frame it comes before muslin_cloth_move_attachment, muslin_cloth_move_collider and
 * muslin_cloth_set_anchors.
 *
 * @return MUSLIN_STATUS_BAD_VALUE for a position that is not finite, a rotation that is no unit quaternion, an
 * inertia that is not from 0 to 1, or if something would get farther off than a number can say
 */
MuslinStatus muslin_cloth_move_frame(MuslinCloth cloth,
                                     MuslinVec3 position,
                                     MuslinQuat rotation,
                                     float inertia);

/**
 * Puts a collider somewhere at once: it does not sweep, and what lay on it does not feel it go.
 *
 * @return MUSLIN_STATUS_BAD_HANDLE if it was removed; MUSLIN_STATUS_BAD_VALUE for a position that is not
 * finite or a rotation that is no unit quaternion
 */
MuslinStatus muslin_cloth_teleport_collider(MuslinCloth cloth,
                                            MuslinCollider collider,
                                            MuslinVec3 position,
                                            MuslinQuat rotation);

/**
 * All that a renderer reads, without a copy; see MuslinView for how long it is valid. Normals are
 * computed when first asked for after a change. `out_view` has begun with muslin_view_init.
 */
MuslinStatus muslin_cloth_view(MuslinCloth cloth, MuslinView *out_view);

/**
 * Which vertices and indices are new or not as they were when the view's `topology_revision` was
 * `since_topology_revision`: all that a renderer must upload again of what does not change with every
 * tick. Everything, if that is more than 64 changes ago, or was never (0 is never). `out_changes` has
 * begun with muslin_changes_init.
 */
MuslinStatus muslin_cloth_changes(MuslinCloth cloth,
                                  uint32_t since_topology_revision,
                                  MuslinChanges *out_changes);

/**
 * What had to be repaired of the mesh that the cloth was made of; nothing of a grid. `out_report` has begun with
 * muslin_mesh_report_init.
 */
MuslinStatus muslin_cloth_get_mesh_report(MuslinCloth cloth,
                                          MuslinMeshReport *out_report);

/** Numbers about the cloth as it is now. `out_stats` has begun with muslin_stats_init. */
MuslinStatus muslin_cloth_get_stats(MuslinCloth cloth, MuslinStats *out_stats);

/**
 * A hash over all that the next tick depends on: equal on every machine that was told the same.
 */
MuslinStatus muslin_cloth_state_hash(MuslinCloth cloth, uint64_t *out_hash);

/**
 * Writes vertices into buffers of yours: each attribute in the format, at the place and at the distances
 * that one of the `stream_count` streams says. Nothing else in the buffers is touched. With room for the
 * view's `vertex_capacity` vertices they fit for ever. `desc` may be NULL: all vertices, as they are.
 *
 * @return MUSLIN_STATUS_BUFFER_TOO_SMALL if the vertices do not fit the `size` of a stream;
 * MUSLIN_STATUS_BAD_VALUE for a field of a stream or of `desc` that cannot be, a format that an attribute
 * is not written in, bytes that two streams write or that a view is of, unless `stream_count` is from 1 to
 * MUSLIN_MAX_STREAMS, or if a stream takes normals or tangents and the transform cannot be inverted; the
 * buffers are untouched then
 */
MuslinStatus muslin_cloth_write_vertices(MuslinCloth cloth,
                                         const MuslinStream *streams,
                                         uint32_t stream_count,
                                         const MuslinWriteDesc *desc);

/**
 * Writes the indices of all triangles to the beginning of `buffer`, which has room for `size` bytes:
 * `index_format` is how many bits each takes, 16 or 32; each has `base_vertex` added, and every triangle
 * is turned round if `flip` is 1. With room for the view's `index_capacity` it fits for ever.
 *
 * @return MUSLIN_STATUS_BUFFER_TOO_SMALL if `size` is less than the view's `index_count` takes;
 * MUSLIN_STATUS_BAD_VALUE unless `index_format` and `flip` are one of these, or for 16 bits if an index is
 * above 65534; `buffer` is untouched then
 */
MuslinStatus muslin_cloth_write_indices(MuslinCloth cloth,
                                        void *buffer,
                                        size_t size,
                                        uint32_t index_format,
                                        uint32_t flip,
                                        uint32_t base_vertex);

/**
 * Writes all of a cloth into `size` bytes at `buffer`; `out_needed` gets the number of bytes that it
 * takes. With `buffer` NULL it gets only that number. With a buffer `out_needed` may be NULL.
 *
 * The bytes are the same on every machine, and hold until the cloth changes.
 *
 * @return MUSLIN_STATUS_BUFFER_TOO_SMALL if it does not fit: nothing is written, muslin_last_error names
 * the size that it takes
 */
MuslinStatus muslin_cloth_save(MuslinCloth cloth,
                               void *buffer,
                               size_t size,
                               size_t *out_needed);

/**
 * Makes the cloth that muslin_cloth_save turned into the `size` bytes at `buffer`, on this machine or
 * any other: it goes on in the same bits. Handles of grabs, attachments and colliders hold for it too.
 *
 * @return MUSLIN_STATUS_BAD_SAVE if the bytes are not that, or not whole
 */
MuslinStatus muslin_cloth_restore(const void *buffer,
                                  size_t size,
                                  MuslinCloth *out_cloth);

/** What muslin_settings_init calls: pass the sizeof of MuslinSettings. */
MuslinStatus muslin_settings_init_sized(MuslinSettings *settings, uint32_t struct_size);

/** What muslin_material_init calls: pass the sizeof of MuslinMaterial. */
MuslinStatus muslin_material_init_sized(MuslinMaterial *material, uint32_t struct_size);

/** What muslin_wind_init calls: pass the sizeof of MuslinWind. */
MuslinStatus muslin_wind_init_sized(MuslinWind *wind, uint32_t struct_size);

/** What muslin_collider_desc_init calls: pass the sizeof of MuslinColliderDesc. */
MuslinStatus muslin_collider_desc_init_sized(MuslinColliderDesc *desc,
                                             uint32_t struct_size);

/** What muslin_stream_init calls: pass the sizeof of MuslinStream. */
MuslinStatus muslin_stream_init_sized(MuslinStream *stream, uint32_t struct_size);

/** What muslin_write_desc_init calls: pass the sizeof of MuslinWriteDesc. */
MuslinStatus muslin_write_desc_init_sized(MuslinWriteDesc *desc, uint32_t struct_size);

/**
 * What muslin_grid_desc_init calls: pass the sizeof of MuslinGridDesc, MuslinMaterial and
 * MuslinSettings, all of the same header.
 */
MuslinStatus muslin_grid_desc_init_sized(MuslinGridDesc *desc,
                                         uint32_t struct_size,
                                         uint32_t material_size,
                                         uint32_t settings_size);

/**
 * What muslin_mesh_desc_init calls: pass the sizeof of MuslinMeshDesc, MuslinMaterial and
 * MuslinSettings, all of the same header.
 */
MuslinStatus muslin_mesh_desc_init_sized(MuslinMeshDesc *desc,
                                         uint32_t struct_size,
                                         uint32_t material_size,
                                         uint32_t settings_size);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

/* Begin a struct: set its size, as the compiler of this very program knows it, and defaults. */

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

/* A whole stream at once; see MuslinStream for what each is. */
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

/* Begin a report: set its size, as the compiler of this very program knows it. */

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
