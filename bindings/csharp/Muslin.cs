// The C library of Muslin for C#: every constant, struct and function of muslin.h by its own name.
//
// Generated from include/muslin.h. To write it again:
//   MUSLIN_BLESS=1 cargo xtask test csharp
//
// The code is unsafe, as the library takes pointers. Structs are passed as they are, so a call
// allocates and copies nothing. Initialise each struct with its muslin_..._init function.

using System;
using System.Runtime.InteropServices;

namespace Muslin
{
    /// <summary>Result of a call.</summary>
    public enum MuslinStatus
    {
        /// <summary>The call succeeded.</summary>
        OK = 0,
        /// <summary>
        /// An argument or field is NULL, out of range, not finite, or inconsistent with another
        /// one.
        /// </summary>
        BAD_VALUE = 1,
        /// <summary>An index is not below the number of particles, vertices or points.</summary>
        BAD_INDEX = 2,
        /// <summary>
        /// A handle of a cloth, grab, attachment or collider is stale, made up or from another
        /// cloth.
        /// </summary>
        BAD_HANDLE = 3,
        /// <summary>The mesh cannot be made into cloth, even after repair.</summary>
        BAD_MESH = 4,
        /// <summary>
        /// The bytes are not a saved cloth, come from another format version, or are damaged.
        /// </summary>
        BAD_SAVE = 5,
        /// <summary>
        /// A limit on the number of items is reached, or the reserve for tears and cuts
        /// (`extra_particles`) is used up.
        /// </summary>
        FULL = 6,
        /// <summary>This version does not support the requested value or struct version.</summary>
        UNSUPPORTED = 7,
        /// <summary>Another thread is using the cloth. The call did nothing; try again.</summary>
        BUSY = 8,
        /// <summary>The caller's buffer is too small.</summary>
        BUFFER_TOO_SMALL = 9,
        /// <summary>The ray hits nothing. Not an error, so it is not logged.</summary>
        NOTHING_HIT = 10,
        /// <summary>
        /// The edge did not tear: both ends are pinned or grabbed, or it is a border edge. Not an
        /// error, so it is not logged.
        /// </summary>
        NOT_TORN = 11,
        /// <summary>
        /// A bug in Muslin interrupted the call; please report it. The cloth is unusable: the only
        /// call that it still accepts is muslin_cloth_destroy.
        /// </summary>
        PANICKED = 12,
    }

    /// <summary>
    /// Function of the host that receives log messages.
    ///
    /// `level` is one of MUSLIN_LOG_...; `message` is valid during the call only; `user` is the
    /// pointer that was passed to muslin_set_log.
    ///
    /// Keep a reference to the delegate for as long as the library may call it.
    /// </summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void MuslinLogFn(uint level, byte* message, void* user);

    /// <summary>A point, direction or velocity.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinVec3
    {
        /// <summary>x component.</summary>
        public float x;
        /// <summary>y component.</summary>
        public float y;
        /// <summary>z component.</summary>
        public float z;
    }

    /// <summary>
    /// Material of a cloth, in SI units. Every field may be changed between ticks.
    ///
    /// Initialise it with muslin_material_init; muslin_material_preset then sets the values of a
    /// fabric.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinMaterial
    {
        /// <summary>Set by muslin_material_init.</summary>
        public uint struct_size;
        /// <summary>Mass per area [kg/m^2]. Default 0.18 (cotton). Above 0.</summary>
        public float density;
        /// <summary>
        /// Gap that the cloth keeps from anything it touches [m]. Default 0.00035. At least 0.
        /// Choose less than half of the shortest edge.
        /// </summary>
        public float thickness;
        /// <summary>
        /// Membrane stiffness along the warp (the columns of a grid) [N/m]. Default 0: as stiff as
        /// the solver reaches. At least 0.
        /// </summary>
        public float stretch_stiffness_warp;
        /// <summary>
        /// Membrane stiffness along the weft (the rows of a grid) [N/m]. Default 0: as stiff as the
        /// solver reaches. At least 0.
        /// </summary>
        public float stretch_stiffness_weft;
        /// <summary>Shear stiffness [N/m]. Default 0: the stretch stiffness. At least 0.</summary>
        public float shear_stiffness;
        /// <summary>
        /// Bending rigidity per width [N m]. Default 2.5e-5. At least 0.
        ///
        /// - It is the value that a strip hanging from a clamp shows (BS 3356), independent of mesh
        ///   resolution, tick, substeps and iterations, and of the direction in which the strip is
        ///   cut: exactly on grids, to 1/20 of the bending length on other meshes.
        /// - 0 is limp.
        /// - 1 or more uses links over two cells instead, as rigid as the solver reaches.
        /// </summary>
        public float bend_stiffness;
        /// <summary>
        /// Damping of bending [s]. Default 0. At least 0. Bending at some angle per second is
        /// resisted like this angle times `bend_damping`; a few hundredths stop a flutter.
        /// </summary>
        public float bend_damping;
        /// <summary>
        /// Damping of stretching [s], in the same way, for links that have a stiffness. Default 0.
        /// At least 0.
        /// </summary>
        public float stretch_damping;
        /// <summary>
        /// Coulomb friction coefficient against colliders and between layers. Default 0.4. At least
        /// 0.
        /// </summary>
        public float friction;
        /// <summary>
        /// Share of the normal velocity that a bounce returns. Default 0. From 0 to 1.
        /// </summary>
        public float restitution;
        /// <summary>
        /// Drag coefficient of a triangle perpendicular to the wind. Default 1.2. At least 0.
        /// </summary>
        public float drag;
        /// <summary>
        /// Lift coefficient of a triangle oblique to the wind. Default 0. At least 0.
        /// </summary>
        public float lift;
        /// <summary>
        /// Ratio of length to rest length at which an edge tears. Default 4. Above 1, or 0: never.
        ///
        /// At a crack tip a smaller strain suffices: sqrt(16 thickness / mean edge) of it, at least
        /// 1/5. On a finer mesh the load is more concentrated there; with this factor, a crack
        /// grows at the same load on any mesh.
        /// </summary>
        public float tear_stretch;
        /// <summary>
        /// Variation of the tear limit between edges. Default 0.2. From 0 (all edges alike) to 1
        /// (the limit varies by half).
        /// </summary>
        public float tear_variation;
        /// <summary>
        /// Angle up to which a fold opens again completely [rad]; of a sharper fold, the excess
        /// stays. Default 0: folds never stay. At least 0. Paper has about 0.8.
        /// </summary>
        public float yield_angle;
        /// <summary>
        /// Share of the excess over `yield_angle` that stays. Default 1. From 0 to 1.
        /// </summary>
        public float yield_creep;
        /// <summary>
        /// Length of cloth over which bending counts as one fold [m]. Default 0.01. At least 0; at
        /// least three cells are used.
        ///
        /// The same angle spread over a greater length is only a bend; a bend stays if its
        /// curvature exceeds `yield_angle` / `fold_length`.
        /// </summary>
        public float fold_length;
        /// <summary>
        /// Growth of the yield angle with accumulated yielding (in either direction). Default 0. At
        /// least 0.
        ///
        /// Of a first fold by some angle, (angle - `yield_angle`) / (1 + `yield_hardening`) stays,
        /// and folding it further needs as much more. Yielding and creases are not counted while
        /// this and `yield_weakening` are 0.
        /// </summary>
        public float yield_hardening;
        /// <summary>
        /// Loss of bending stiffness with accumulated yielding [1/rad]. Default 0. At least 0.
        ///
        /// After yielding by an angle in total (in either direction), `fold_length` of the cloth
        /// bends as if `bend_stiffness` were divided by 1 + `yield_weakening` * angle, at most by
        /// 1000; pressing the fold flat does not restore it. The moment at which it yields stays
        /// the same, so the fold opens further: `yield_angle` * `yield_weakening` adds to
        /// `yield_hardening`.
        /// </summary>
        public float yield_weakening;
    }

    /// <summary>
    /// Settings of the simulation: time steps, gravity, damping and solver options. Every field may
    /// be changed between ticks. Initialise it with muslin_settings_init.
    ///
    /// A tick is divided into `substeps`. Each substep predicts the positions and then solves all
    /// constraints `iterations` times. More of either makes the cloth stiffer; at the same cost,
    /// substeps stiffen it more than iterations.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinSettings
    {
        /// <summary>Set by muslin_settings_init.</summary>
        public uint struct_size;
        /// <summary>Length of a tick [s]. Default 1/60. Above 0, at most 1.</summary>
        public float tick;
        /// <summary>
        /// Least number of substeps per tick. Default 4. From 1 to 1000.
        ///
        /// Where cloth and colliders move fast relative to each other, a tick runs up to 8 times as
        /// many, but not more than 64 unless this is larger. See `substeps` of MuslinStats.
        /// </summary>
        public uint substeps;
        /// <summary>
        /// Solver iterations per substep, in alternating order. Default 2. From 1 to 1000.
        ///
        /// With 1, the time integration is of first order, which damps all motion. From 2 on it is
        /// of second order; then only `damping` and the air damp.
        /// </summary>
        public uint iterations;
        /// <summary>
        /// Largest number of ticks of one muslin_cloth_advance; the rest of the backlog is dropped.
        /// Default 5. At least 1.
        /// </summary>
        public uint max_ticks_per_advance;
        /// <summary>Gravitational acceleration [m/s^2]. Default 0, -9.81, 0.</summary>
        public MuslinVec3 gravity;
        /// <summary>
        /// Rate at which velocities decay [1/s], as exp(-`damping` t), independent of the step.
        /// Default 0.5. At least 0.
        /// </summary>
        public float damping;
        /// <summary>
        /// Largest displacement of a particle per substep, relative to the rigid motion of the
        /// cloth, in mean rest lengths. Default 0.5. Above 0. It also limits the speed of a grabbed
        /// particle.
        /// </summary>
        public float max_displacement;
        /// <summary>
        /// Strain limit: the largest strain of any stretch or shear link after a tick, unless pins,
        /// grabs or anchors hold it apart. Default 0: no limit. 0.02 is 2 %. At least 0.
        /// </summary>
        public float max_stretch;
        /// <summary>
        /// 1: tethers (long-range attachments) keep every particle within its rest distance of the
        /// pins; 0: no tethers. Default 1.
        ///
        /// Tethers carry the load that the iterations do not reach; they do not resist the stretch
        /// of links that have a stiffness. From 2 iterations on, whole chains of links are solved
        /// at once as well.
        /// </summary>
        public uint tethers;
        /// <summary>
        /// Self-collision: MUSLIN_SELF_COLLISION_NONE (default), MUSLIN_SELF_COLLISION_SURFACE or
        /// MUSLIN_SELF_COLLISION_PARTICLES.
        /// </summary>
        public uint self_collision;
        /// <summary>
        /// Gap of self-collision [m]. Default 0.
        ///
        /// - Surface: 0 means the material's thickness. At most half of the mean rest length.
        /// - Particles: 0 means 2/3 of the mean rest length. At most twice the mean rest length.
        /// </summary>
        public float self_distance;
        /// <summary>
        /// 1: links that are stretched past `tear_stretch` of MuslinMaterial tear; 0: they do not.
        /// Default 0.
        /// </summary>
        public uint tearing;
        /// <summary>
        /// Largest number of vertices that tearing splits per tick; the most stretched come first.
        /// Default 8. At least 1.
        /// </summary>
        public uint max_tears_per_tick;
        /// <summary>
        /// Speed below which the cloth falls asleep [m/s]. Default 0: never. At least 0.
        ///
        /// A cloth whose particles were all slower for half a second stops moving, at almost no
        /// cost, until something changes or touches it. Gusts, turbulence and
        /// MUSLIN_WIND_SINE_FIELD keep it awake. See `asleep` of MuslinStats.
        /// </summary>
        public float sleep_speed;
        /// <summary>
        /// Over-pressure inside closed pieces of the cloth [Pa]. Default 0. Finite.
        ///
        /// A piece is closed if each of its edges has two triangles, as in a ball or a cushion, or
        /// if all of its border is sewn to closed pieces (muslin_cloth_sew). The pressure is
        /// constant, whatever the volume; a negative one sucks the sides inwards, as a vacuum does.
        /// Outwards is where the volume of the rest shape is positive, whatever the winding. A
        /// piece that is torn or cut open loses its pressure at once. Open cloth, such as a grid,
        /// feels none.
        ///
        /// Links stretch under high pressure unless `max_stretch` limits them. Where the pressure
        /// alone would move a particle of a piece by more than `max_displacement` in a substep, all
        /// of that piece gets less.
        /// </summary>
        public float pressure;
    }

    /// <summary>
    /// A regular grid of particles. The particle at `row` and `column` has the index `row * columns
    /// + column`. Initialise it with muslin_grid_desc_init.
    ///
    /// `material` and `settings` have sizes of their own: replace them only by structs that were
    /// initialised with muslin_material_init and muslin_settings_init in the same program.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinGridDesc
    {
        /// <summary>Set by muslin_grid_desc_init.</summary>
        public uint struct_size;
        /// <summary>Particles per row. Default 40. At least 2.</summary>
        public uint columns;
        /// <summary>
        /// Number of rows. Default 40. At least 2. A grid has at most 4194304 particles.
        /// </summary>
        public uint rows;
        /// <summary>Distance between neighbours [m]. Default 0.05. From 1e-6 to 1e6.</summary>
        public float spacing;
        /// <summary>
        /// Position of particle (0, 0), the top left corner [m]. Default 0, 0, 0. Within 2097152
        /// times `spacing` of zero along each axis.
        /// </summary>
        public MuslinVec3 origin;
        /// <summary>Unit direction along a row. Default 1, 0, 0.</summary>
        public MuslinVec3 right;
        /// <summary>
        /// Unit direction along a column, perpendicular to `right`. Default 0, -1, 0.
        /// </summary>
        public MuslinVec3 down;
        /// <summary>
        /// Particles that are pinned from the start: MUSLIN_PIN_NONE, MUSLIN_PIN_TOP_EDGE
        /// (default), MUSLIN_PIN_TOP_CORNERS or MUSLIN_PIN_CORNERS.
        /// </summary>
        public uint pin_mode;
        /// <summary>
        /// Particles to reserve for tears and cuts. Default MUSLIN_AS_MANY_AGAIN; 0 if the cloth
        /// never tears.
        /// </summary>
        public uint extra_particles;
        /// <summary>Material.</summary>
        public MuslinMaterial material;
        /// <summary>Settings.</summary>
        public MuslinSettings settings;
    }

    /// <summary>
    /// Handle of a cloth. { 0 } is none. A stale or made-up handle gives MUSLIN_STATUS_BAD_HANDLE.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinCloth
    {
        /// <summary>Identifies the cloth; opaque.</summary>
        public ulong id;
    }

    /// <summary>
    /// Any triangle mesh, as modelling tools export them. Initialise it with muslin_mesh_desc_init,
    /// then set positions and indices.
    ///
    /// Defects are repaired in this order; muslin_cloth_get_mesh_report counts the repairs:
    /// - duplicate vertices are welded (see `weld_distance`);
    /// - triangles without an area and repeated triangles are dropped;
    /// - where more than two triangles share an edge, the flattest pair stays joined and the others
    ///   get an edge of their own;
    /// - sheets that touch in a single vertex are separated there;
    /// - within each piece, triangles are turned to face as most of them do;
    /// - if `simplify_below` is above 0, short edges are collapsed.
    ///
    /// Vertices that no triangle uses stay where they are.
    ///
    /// A mesh that is a regular grid, with vertices and triangles in the order of
    /// muslin_cloth_create_grid, is simulated as that grid, with identical bits.
    ///
    /// All lists are copied during the call. `material` and `settings` have sizes of their own:
    /// replace them only by structs that were initialised with muslin_material_init and
    /// muslin_settings_init in the same program.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct MuslinMeshDesc
    {
        /// <summary>Set by muslin_mesh_desc_init.</summary>
        public uint struct_size;
        /// <summary>
        /// Rest positions of the vertices [m], 3 numbers per vertex. If nothing is welded, split or
        /// collapsed, vertex i is particle i; otherwise see `particles` of MuslinView.
        /// </summary>
        public float* positions;
        /// <summary>
        /// Distance between the starts of consecutive positions [bytes]; 0 means 12. Default 0. A
        /// multiple of 4.
        /// </summary>
        public uint position_stride;
        /// <summary>Number of vertices. Default 0. From 3 to 4194304.</summary>
        public uint vertex_count;
        /// <summary>
        /// Vertices of the triangles, 3 per triangle, counter-clockwise seen from the front.
        /// </summary>
        public uint* indices;
        /// <summary>Number of indices. Default 0. A multiple of 3, at most 50331648.</summary>
        public uint index_count;
        /// <summary>Texture coordinates, 2 numbers per vertex, or NULL for none.</summary>
        public float* uvs;
        /// <summary>
        /// Vertices whose particles are pinned from the start, or NULL for none.
        /// </summary>
        public uint* pinned;
        /// <summary>Number of entries of `pinned`. Default 0. At most `vertex_count`.</summary>
        public uint pinned_count;
        /// <summary>
        /// Vertices at most this far apart share one particle [m]. Default -1.
        ///
        /// 0 welds vertices at exactly the same position; a negative value welds nothing. Vertices
        /// are processed in order: each joins the nearest earlier vertex that was not welded
        /// itself. Corners of one triangle are never welded together. Choose a value well below the
        /// shortest edge.
        /// </summary>
        public float weld_distance;
        /// <summary>
        /// Particles to reserve for tears and cuts. Default MUSLIN_AS_MANY_AGAIN; 0 if the cloth
        /// never tears.
        /// </summary>
        public uint extra_particles;
        /// <summary>Material.</summary>
        public MuslinMaterial material;
        /// <summary>Settings.</summary>
        public MuslinSettings settings;
        /// <summary>Not used. Default 0.</summary>
        public uint reserved;
        /// <summary>
        /// Edges shorter than this are collapsed [m]. Default 0: none. At most the mean length of
        /// the edges.
        ///
        /// One end of such an edge moves to the other, with its vertices, and the triangles at the
        /// edge are removed. Triangles that are lower than this get another diagonal where that
        /// makes them higher. Borders, seams of texture coordinates and their corners stay, a
        /// pinned vertex moves to pinned ones only, and the topology stays; `short_edges` of
        /// MuslinMeshReport counts the edges that are short nevertheless. A tenth to a third of the
        /// mean edge removes the slivers of most meshes.
        /// </summary>
        public float simplify_below;
    }

    /// <summary>
    /// The air around a cloth: steady wind with gusts, changing direction and turbulence. Equal
    /// seeds give equal gusts. Initialise it with muslin_wind_init, which describes still air.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinWind
    {
        /// <summary>Set by muslin_wind_init.</summary>
        public uint struct_size;
        /// <summary>Model: MUSLIN_WIND_SURFACE (default) or MUSLIN_WIND_SINE_FIELD.</summary>
        public uint model;
        /// <summary>Mean velocity of the air [m/s]. Default 0, 0, 0.</summary>
        public MuslinVec3 velocity;
        /// <summary>
        /// Variation of the speed over time, as a share of it. Default 0. From 0 to 1.
        /// </summary>
        public float gust;
        /// <summary>Variation of the direction over time [rad]. Default 0. From 0 to pi.</summary>
        public float wander;
        /// <summary>
        /// Variation of the air velocity in space, as a share of the speed. Default 0. From 0 to 1.
        /// </summary>
        public float turbulence;
        /// <summary>Density of the air [kg/m^3]. Default 1.2. At least 0; 0 is a vacuum.</summary>
        public float air_density;
        /// <summary>Selects the sequence of gusts and turbulence. Default 0.</summary>
        public uint seed;
    }

    /// <summary>A rotation as a unit quaternion. { 0, 0, 0, 1 } is no rotation.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinQuat
    {
        /// <summary>Axis x times the sine of half the angle.</summary>
        public float x;
        /// <summary>Axis y times the sine of half the angle.</summary>
        public float y;
        /// <summary>Axis z times the sine of half the angle.</summary>
        public float z;
        /// <summary>Cosine of half the angle.</summary>
        public float w;
    }

    /// <summary>
    /// Handle of an attachment: a transform that carries particles. { 0 } is none. Valid for the
    /// cloth that returned it and for cloths restored from it.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinAttachment
    {
        /// <summary>Identifies the attachment; opaque.</summary>
        public uint id;
    }

    /// <summary>Where a ray hits a cloth. Initialise it with muslin_hit_init.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinHit
    {
        /// <summary>Set by muslin_hit_init.</summary>
        public uint struct_size;
        /// <summary>
        /// Triangle that was hit: its corners are the indices 3 * triangle and the two after it.
        /// </summary>
        public uint triangle;
        /// <summary>Corner particle nearest to the hit.</summary>
        public uint particle;
        /// <summary>Barycentric weight of the triangle's second corner.</summary>
        public float u;
        /// <summary>Barycentric weight of the triangle's third corner.</summary>
        public float v;
        /// <summary>Distance from the ray's origin [m].</summary>
        public float distance;
        /// <summary>Point of the hit [m].</summary>
        public MuslinVec3 position;
        /// <summary>Unit normal of the triangle, on the side that was hit.</summary>
        public MuslinVec3 normal;
    }

    /// <summary>
    /// Handle of a grab of one particle. { 0 } is none. Valid for the cloth that returned it and
    /// for cloths restored from it.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinGrab
    {
        /// <summary>Identifies the grab; opaque.</summary>
        public uint id;
    }

    /// <summary>
    /// An event. Fields that its kind does not mention are 0. Initialise it with muslin_event_init.
    ///
    /// `particle_a` and `particle_b` are particles, `vertex` and `source` are vertices; see
    /// `particles` of MuslinView.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinEvent
    {
        /// <summary>Set by muslin_event_init.</summary>
        public uint struct_size;
        /// <summary>Kind: one of MUSLIN_EVENT_....</summary>
        public uint kind;
        /// <summary>Tick of the event, counted from creation or reset.</summary>
        public uint tick;
        /// <summary>Position of the event [m].</summary>
        public MuslinVec3 position;
        /// <summary>First end of the edge, or the particle.</summary>
        public uint particle_a;
        /// <summary>Second end of the edge.</summary>
        public uint particle_b;
        /// <summary>The new vertex.</summary>
        public uint vertex;
        /// <summary>The vertex that the new one was split off from.</summary>
        public uint source;
        /// <summary>Number of triangles, particles, links or pairs.</summary>
        public uint count;
    }

    /// <summary>
    /// Descriptor of a collider: shape, pose and surface properties. Initialise it with
    /// muslin_collider_desc_init, which describes a floor at height 0.
    ///
    /// Fields that the shape does not use are ignored. All lists are copied when the collider is
    /// added.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct MuslinColliderDesc
    {
        /// <summary>Set by muslin_collider_desc_init.</summary>
        public uint struct_size;
        /// <summary>Shape: one of MUSLIN_SHAPE_.... Default MUSLIN_SHAPE_PLANE.</summary>
        public uint shape;
        /// <summary>Position [m]; for a plane, a point on its surface. Default 0, 0, 0.</summary>
        public MuslinVec3 position;
        /// <summary>
        /// Rotation, a unit quaternion; a plane's normal is the rotated y axis. Default: none.
        /// </summary>
        public MuslinQuat rotation;
        /// <summary>
        /// Coulomb friction coefficient. Default -1: that of the material. Otherwise at least 0.
        /// </summary>
        public float friction;
        /// <summary>
        /// Share of the normal velocity that a bounce returns. Default -1: that of the material.
        /// Otherwise from 0 to 1.
        /// </summary>
        public float restitution;
        /// <summary>
        /// Share of the tangential velocity that remains after each substep in contact, in addition
        /// to Coulomb friction. Default 1 (all of it). From 0 to 1.
        /// </summary>
        public float tangential_restitution;
        /// <summary>
        /// Gap between cloth and surface [m]. Default -1: the material's thickness. Otherwise at
        /// least 0.
        ///
        /// On surfaces that are round or slightly curved, particles keep a larger gap, so that the
        /// triangles between them do not sink in: up to 1/5 of the mean edge for spheres and
        /// capsules, 1/10 for other shapes.
        /// </summary>
        public float thickness;
        /// <summary>Radius of a sphere or capsule [m]. Default 0.5. Above 0.</summary>
        public float radius;
        /// <summary>
        /// Radius of the upper end of a capsule [m]. Default -1: `radius`. Otherwise above 0.
        /// </summary>
        public float top_radius;
        /// <summary>
        /// Capsule: distance from its centre to the centres of its ends [m]. Default 0.5. At least
        /// 0.
        /// </summary>
        public float half_height;
        /// <summary>
        /// Box: distance from its centre to its sides [m]. Default 0.5 each. Above 0.
        /// </summary>
        public MuslinVec3 half_extents;
        /// <summary>
        /// Heightfield: distance between neighbouring heights [m]. Default 1. Above 0.
        /// </summary>
        public float spacing;
        /// <summary>Heightfield: number of heights along x. Default 0. From 2 to 4096.</summary>
        public uint columns;
        /// <summary>Heightfield: number of heights along z. Default 0. From 2 to 4096.</summary>
        public uint rows;
        /// <summary>
        /// Distance between the starts of consecutive positions [bytes]; 0 means 12. Default 0. A
        /// multiple of 4.
        /// </summary>
        public uint position_stride;
        /// <summary>
        /// Number of positions. Default 0. From 4 to 1024 for a convex hull, at most 4194304 for a
        /// mesh.
        /// </summary>
        public uint vertex_count;
        /// <summary>Number of indices. Default 0. A multiple of 3, at most 50331648.</summary>
        public uint index_count;
        /// <summary>Convex hull or mesh: points [m], 3 numbers each.</summary>
        public float* positions;
        /// <summary>Mesh: 3 points per triangle. Triangles without an area are ignored.</summary>
        public uint* indices;
        /// <summary>Heightfield: `columns` * `rows` heights [m], row by row along x.</summary>
        public float* heights;
        /// <summary>
        /// Mesh: largest depth from which particles inside are pushed out [m]. Default 0: both
        /// sides of its triangles are outside. At least 0 and below 1e6.
        ///
        /// Above 0 the mesh must be closed and consistently wound: every edge in two triangles,
        /// once in each direction. Normals may point inward or outward. Particles move towards the
        /// closest point of the surface at 0.05 m/s. Each tick makes one closest-point query per
        /// particle in the bounds of the mesh.
        /// </summary>
        public float solid;
        /// <summary>Not used. Default 0.</summary>
        public uint reserved;
    }

    /// <summary>
    /// Handle of a collider. { 0 } is none. Valid for the cloth that returned it and for cloths
    /// restored from it.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinCollider
    {
        /// <summary>Identifies the collider; opaque.</summary>
        public uint id;
    }

    /// <summary>
    /// Output lists of a cloth, borrowed from the library's own memory. Read only. Initialise it
    /// with muslin_view_init.
    ///
    /// The pointers and the data behind them stay valid until the next call that changes the cloth
    /// (advance, step, reset, pin, set_position, tear_edge, cut, destroy and others).
    ///
    /// Vertices are drawn; particles are simulated. See `particles` for their relation.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct MuslinView
    {
        /// <summary>Set by muslin_view_init.</summary>
        public uint struct_size;
        /// <summary>Positions [m], 3 numbers per vertex.</summary>
        public float* positions;
        /// <summary>
        /// Unit normals, weighted by triangle area, 3 numbers per vertex; zeros for a vertex that
        /// no triangle uses. Vertices of the same particle share its normal.
        /// </summary>
        public float* normals;
        /// <summary>Texture coordinates, 2 numbers per vertex.</summary>
        public float* uvs;
        /// <summary>
        /// Vertices of the triangles, 3 per triangle, counter-clockwise seen from the front.
        /// </summary>
        public uint* indices;
        /// <summary>
        /// Vertex of the descriptor that each vertex came from; for a vertex that a cut added on an
        /// edge, that of the nearer end.
        /// </summary>
        public uint* source_vertices;
        /// <summary>Number of vertices.</summary>
        public uint vertex_count;
        /// <summary>Number of indices, 3 per triangle.</summary>
        public uint index_count;
        /// <summary>Largest number of vertices that the cloth may ever have.</summary>
        public uint vertex_capacity;
        /// <summary>Largest number of indices that the cloth may ever have.</summary>
        public uint index_capacity;
        /// <summary>Changes whenever the indices change.</summary>
        public uint topology_revision;
        /// <summary>Changes whenever positions change.</summary>
        public uint state_revision;
        /// <summary>
        /// 1 byte per vertex: 1 on a border that a tear or cut made, e.g. to draw fringes; else 0,
        /// also on borders of the original cloth.
        /// </summary>
        public byte* frayed;
        /// <summary>
        /// Particle of each vertex. A mesh that was welded, or whose sheets were separated, has
        /// several vertices per particle; otherwise vertex i is particle i.
        ///
        /// Calls that act on the cloth (pins, grabs, tears, positions and velocities) take
        /// particles, and a ray hit returns one. In an event, `particle_a` and `particle_b` are
        /// particles, `vertex` and `source` are vertices. Triangles have the same numbers in both.
        /// </summary>
        public uint* particles;
    }

    /// <summary>
    /// Ranges of a cloth's output lists that changed since a topology revision: what a renderer
    /// must upload again. Initialise it with muslin_changes_init.
    ///
    /// The vertex range concerns the attributes that stay constant between topology changes:
    /// texture coordinates, source vertices, particles and frayed borders. Positions and normals
    /// change with every tick.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinChanges
    {
        /// <summary>Set by muslin_changes_init.</summary>
        public uint struct_size;
        /// <summary>First changed vertex; 0 if there is none.</summary>
        public uint first_vertex;
        /// <summary>Number of vertices in the changed range.</summary>
        public uint vertex_count;
        /// <summary>First changed index; 0 if there is none.</summary>
        public uint first_index;
        /// <summary>Number of indices in the changed range.</summary>
        public uint index_count;
    }

    /// <summary>
    /// What was repaired in a mesh before it became cloth, and the quality of the result.
    /// Initialise it with muslin_mesh_report_init.
    ///
    /// Repairs are made in this order: vertices are welded; triangles without an area and repeated
    /// triangles are dropped; edges and vertices where several sheets meet are split; triangles
    /// that face the other way are turned; short edges are collapsed.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinMeshReport
    {
        /// <summary>Set by muslin_mesh_report_init.</summary>
        public uint struct_size;
        /// <summary>Number of given vertices.</summary>
        public uint vertices;
        /// <summary>Number of given triangles.</summary>
        public uint triangles;
        /// <summary>Number of resulting particles.</summary>
        public uint particles;
        /// <summary>Number of triangles that were kept.</summary>
        public uint kept_triangles;
        /// <summary>Number of vertices that share the particle of another vertex.</summary>
        public uint welded_vertices;
        /// <summary>Number of dropped triangles that had no area or used a vertex twice.</summary>
        public uint dropped_degenerate;
        /// <summary>
        /// Number of dropped triangles whose corners were those of an earlier one.
        /// </summary>
        public uint dropped_duplicates;
        /// <summary>Number of triangles that were turned to face as their neighbours do.</summary>
        public uint turned_triangles;
        /// <summary>Number of edges that had more than two triangles.</summary>
        public uint split_edges;
        /// <summary>
        /// Number of particles that were added where sheets met at such an edge or at a single
        /// vertex.
        /// </summary>
        public uint split_vertices;
        /// <summary>
        /// Number of vertices that no triangle uses. Unless they were welded, they are particles
        /// without mass that stay where they are.
        /// </summary>
        public uint unused_vertices;
        /// <summary>Number of pieces: sets of triangles connected by edges.</summary>
        public uint pieces;
        /// <summary>
        /// Number of pieces with only one side, such as a Moebius strip: along a line across them,
        /// neighbours face opposite ways.
        /// </summary>
        public uint one_sided_pieces;
        /// <summary>1 if the mesh is simulated as a regular grid, else 0.</summary>
        public uint is_grid;
        /// <summary>Length of the shortest edge [m].</summary>
        public float shortest_edge;
        /// <summary>Mean length of the edges [m].</summary>
        public float mean_edge;
        /// <summary>
        /// Largest aspect ratio of a triangle: its longest edge divided by its least height. 1.15
        /// with equal edges, 2 on a grid.
        /// </summary>
        public float worst_aspect;
        /// <summary>Number of thin triangles: those with an aspect ratio above 100.</summary>
        public uint thin_triangles;
        /// <summary>
        /// The triangle with the largest aspect ratio, by its number among the given ones.
        /// </summary>
        public uint thinnest_triangle;
        /// <summary>
        /// Number of edges below `simplify_below` that were collapsed; each removed a particle.
        /// </summary>
        public uint collapsed_edges;
        /// <summary>Number of triangles that were removed with collapsed edges.</summary>
        public uint collapsed_triangles;
        /// <summary>
        /// Number of triangles that were removed at a border because they were lower than
        /// `simplify_below`.
        /// </summary>
        public uint trimmed_triangles;
        /// <summary>
        /// Number of edges that were flipped because a triangle was lower than `simplify_below`.
        /// </summary>
        public uint flipped_edges;
        /// <summary>
        /// Number of edges that are still shorter than `simplify_below`: to collapse them would
        /// change the topology, a border, a seam or a pin, or would turn a triangle over.
        /// </summary>
        public uint short_edges;
    }

    /// <summary>Statistics of a cloth. Initialise it with muslin_stats_init.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct MuslinStats
    {
        /// <summary>Set by muslin_stats_init.</summary>
        public uint struct_size;
        /// <summary>Number of particles.</summary>
        public uint particles;
        /// <summary>Number of triangles.</summary>
        public uint triangles;
        /// <summary>Number of links in the rest state.</summary>
        public uint constraints;
        /// <summary>Number of links that are intact now.</summary>
        public uint active_constraints;
        /// <summary>Number of pieces: sets of triangles connected by edges.</summary>
        public uint pieces;
        /// <summary>Ticks since the cloth was made or reset.</summary>
        public uint ticks;
        /// <summary>
        /// Part of a tick that muslin_cloth_advance has not simulated yet, from 0 to 1: the factor
        /// by which to blend from the positions of the last tick to the current ones when drawing.
        /// </summary>
        public float blend;
        /// <summary>Largest strain of a stretch link: 0.01 is 1 % above its rest length.</summary>
        public float max_stretch;
        /// <summary>Mean strain of the stretch links.</summary>
        public float mean_stretch;
        /// <summary>Kinetic energy [J].</summary>
        public float kinetic_energy;
        /// <summary>Number of used entries of `seconds`.</summary>
        public uint stage_count;
        /// <summary>Approximate memory use [bytes].</summary>
        public ulong bytes;
        /// <summary>
        /// Time of each stage in the last call that ran ticks [s]; muslin_stage_name returns their
        /// names.
        ///
        /// Timing starts with the first muslin_cloth_get_stats of a cloth; until then all entries
        /// are 0.
        /// </summary>
        public fixed float seconds[31];
        /// <summary>
        /// Number of links past `max_stretch` of MuslinSettings, which pins, grabs or anchors hold
        /// apart; 0 without that limit.
        /// </summary>
        public uint over_stretched;
        /// <summary>1 if the cloth sleeps, see `sleep_speed` of MuslinSettings; else 0.</summary>
        public uint asleep;
        /// <summary>Speed of the fastest particle [m/s].</summary>
        public float max_speed;
        /// <summary>
        /// Number of substeps of the last tick: `substeps` of MuslinSettings, or more where cloth
        /// and colliders moved fast relative to each other. A cloth that sleeps runs none and keeps
        /// the number.
        /// </summary>
        public uint substeps;
        /// <summary>
        /// Number of particles that pins, attachments or grabs hold more than 0.1 mm inside a
        /// collider. Nothing is inside a triangle mesh, which has two sides.
        /// </summary>
        public uint held_inside;
        /// <summary>Number of other particles more than 0.1 mm inside a collider.</summary>
        public uint free_inside;
        /// <summary>
        /// Number of crossings: pairs of an edge of the cloth and a triangle that it passes
        /// through, as found in the last tick; 0 without surface collision. A cloth without known
        /// crossings is tested in parts, all of it in 16 ticks.
        /// </summary>
        public uint crossings;
    }

    /// <summary>
    /// A destination for one vertex attribute. Initialise it with muslin_stream_init, or make it
    /// with muslin_stream.
    ///
    /// Streams may share a buffer: interleaved at equal strides, or one after the other.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct MuslinStream
    {
        /// <summary>Set by muslin_stream_init. Equal for all streams of a call.</summary>
        public uint struct_size;
        /// <summary>
        /// Attribute: one of MUSLIN_ATTRIBUTE_.... Default MUSLIN_ATTRIBUTE_POSITION.
        /// </summary>
        public uint attribute;
        /// <summary>Number format: one of MUSLIN_FORMAT_.... Default MUSLIN_FORMAT_F32.</summary>
        public uint format;
        /// <summary>
        /// Distance between the starts of consecutive vertices [bytes]. Default 0: tightly packed.
        /// Otherwise a multiple of the component size (4 for MUSLIN_FORMAT_F32, else 2), at least
        /// the size of the attribute.
        /// </summary>
        public uint stride;
        /// <summary>
        /// Address of the first vertex, aligned to the component size. Default NULL. Your own
        /// memory, not that of a view.
        /// </summary>
        public void* buffer;
        /// <summary>Bytes from `buffer` to the end of the memory. Default 0.</summary>
        public UIntPtr size;
    }

    /// <summary>
    /// Selects the vertices to write and how they are transformed. Initialise it with
    /// muslin_write_desc_init, which selects all vertices, untransformed.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct MuslinWriteDesc
    {
        /// <summary>Set by muslin_write_desc_init.</summary>
        public uint struct_size;
        /// <summary>
        /// First vertex to write; it goes to the start of each stream. Default 0.
        /// </summary>
        public uint first_vertex;
        /// <summary>Number of vertices to write. Default MUSLIN_ALL_VERTICES.</summary>
        public uint vertex_count;
        /// <summary>
        /// Time to draw, from 0 (last tick) to 1 (current tick). Default 1. Pass `blend` of
        /// MuslinStats for smooth motion. Normals and tangents belong to the interpolated surface.
        /// </summary>
        public float blend;
        /// <summary>
        /// Transform of the positions, applied after the offset: three rows of four numbers, so
        /// that x becomes t[0] x + t[1] y + t[2] z + t[3]. Default: identity. A transform that
        /// takes a cloth far from zero to a place near zero loses no digits. Normals stay
        /// perpendicular to the surface and on their side of it; tangents stay in the surface.
        /// </summary>
        public fixed float transform[12];
        /// <summary>
        /// 1 if normals point to the other side, e.g. for the back of the cloth. Default 0.
        /// </summary>
        public uint flip_normals;
        /// <summary>
        /// Distance by which positions are moved along the written normals [m]. Default 0. Half of
        /// the thickness on either side gives the cloth a visible thickness.
        /// </summary>
        public float offset;
        /// <summary>
        /// 1 if positions are relative to the origin of muslin_cloth_get_origin, also those that
        /// `transform` applies to. Default 0: they are absolute.
        /// </summary>
        public uint relative;
    }

    /// <summary>
    /// How muslin_cloth_sew joins pairs of particles. Initialise it with muslin_sew_desc_init.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinSewDesc
    {
        /// <summary>Set by muslin_sew_desc_init.</summary>
        public uint struct_size;
        /// <summary>
        /// Speed at which the distance of each pair falls to zero [m/s]. Default 0.5. Above 0.
        /// </summary>
        public float speed;
        /// <summary>
        /// What joins the particles: MUSLIN_SEW_WELD (default) or MUSLIN_SEW_STITCH.
        /// </summary>
        public uint kind;
        /// <summary>
        /// Force on one pair above which a stitch tears [N], as the mean over a tick; 0 = never.
        /// Default 0. At least 0. A weld ignores it.
        /// </summary>
        public float tear_force;
    }

    /// <summary>
    /// A render mesh that follows a cloth. Initialise it with muslin_skin_desc_init, then set
    /// positions and indices. All lists are copied during the call.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct MuslinSkinDesc
    {
        /// <summary>Set by muslin_skin_desc_init.</summary>
        public uint struct_size;
        /// <summary>
        /// Positions of the vertices [m], 3 numbers per vertex, where the cloth is now. None may be
        /// farther from the cloth than half the diagonal of the cloth's bounding box.
        /// </summary>
        public float* positions;
        /// <summary>
        /// Distance between the starts of consecutive positions [bytes]; 0 means 12. Default 0. A
        /// multiple of 4.
        /// </summary>
        public uint stride;
        /// <summary>Number of vertices. Default 0. From 3 to 4194304.</summary>
        public uint vertex_count;
        /// <summary>
        /// Vertices of the triangles, 3 per triangle, counter-clockwise seen from the front.
        /// </summary>
        public uint* indices;
        /// <summary>Number of indices. Default 0. A multiple of 3, at most 50331648.</summary>
        public uint index_count;
        /// <summary>Texture coordinates, 2 numbers per vertex, or NULL for none.</summary>
        public float* uvs;
        /// <summary>
        /// Curvature over each triangle of the cloth, from 0 (flat triangles) to 1. Default 1.
        ///
        /// Above 0, a fine skin has a smooth outline on a coarse cloth (Phong tessellation). At 1 a
        /// skin lies on a circle between particles that lie on one. Particles are on the surface
        /// for any value.
        /// </summary>
        public float smoothness;
        /// <summary>Not used; 0.</summary>
        public uint reserved;
    }

    /// <summary>
    /// Handle of a skin. { 0 } is none. Stale once the skin or its cloth is destroyed.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MuslinSkin
    {
        /// <summary>Identifies the skin; opaque.</summary>
        public ulong id;
    }

    /// <summary>The functions and constants of the C library.</summary>
    public static unsafe class Native
    {
#if (UNITY_IOS || UNITY_TVOS || UNITY_VISIONOS) && !UNITY_EDITOR
        /// <summary>The program itself, which the static library is linked into.</summary>
        public const string LIBRARY = "__Internal";
#else
        /// <summary>The name of the shared library, without prefix and suffix.</summary>
        public const string LIBRARY = "muslin";
#endif

        /// <summary>Returns a text of the library, such as that of muslin_last_error.</summary>
        public static string Text(byte* text)
        {
            int length = 0;
            while (text[length] != 0) length++;
            return System.Text.Encoding.UTF8.GetString(text, length);
        }

        /// <summary>A bug in Muslin interrupted a call.</summary>
        public const uint MUSLIN_LOG_ERROR = 1;

        /// <summary>A call was refused. The message is that of muslin_last_error.</summary>
        public const uint MUSLIN_LOG_WARN = 2;

        /// <summary>A cloth was created or destroyed.</summary>
        public const uint MUSLIN_LOG_INFO = 3;

        /// <summary>Silk: light and fluid, 100 g/m^2.</summary>
        public const uint MUSLIN_PRESET_SILK = 0;

        /// <summary>Cotton shirting, 180 g/m^2.</summary>
        public const uint MUSLIN_PRESET_COTTON = 1;

        /// <summary>Denim: heavy twill, 380 g/m^2.</summary>
        public const uint MUSLIN_PRESET_DENIM = 2;

        /// <summary>Garment leather, 700 g/m^2.</summary>
        public const uint MUSLIN_PRESET_LEATHER = 3;

        /// <summary>Office paper, 80 g/m^2; keeps folds.</summary>
        public const uint MUSLIN_PRESET_PAPER = 4;

        /// <summary>Flag nylon of 200 denier, 105 g/m^2.</summary>
        public const uint MUSLIN_PRESET_FLAG_NYLON = 5;

        /// <summary>
        /// Painted stiffness against stretch and shear. Links without compliance (a stiffness of 0)
        /// stay rigid; at scale 0 other links do not resist.
        /// </summary>
        public const uint MUSLIN_MAP_STRETCH = 0;

        /// <summary>
        /// Painted bending rigidity; at scale 0 the cloth is limp. Does not act on a
        /// `bend_stiffness` from 1 on.
        /// </summary>
        public const uint MUSLIN_MAP_BEND = 1;

        /// <summary>
        /// Painted strength: the strain at which an edge tears, `tear_stretch` - 1. At scale 0 an
        /// edge tears as soon as it is stretched at all; a large scale keeps it from tearing.
        /// </summary>
        public const uint MUSLIN_MAP_TEAR = 2;

        /// <summary>
        /// Painted coefficient of friction of contacts with colliders and of surface self-
        /// collision.
        /// </summary>
        public const uint MUSLIN_MAP_FRICTION = 3;

        /// <summary>
        /// Painted distance from colliders and between layers in self-collision.
        /// </summary>
        public const uint MUSLIN_MAP_THICKNESS = 4;

        /// <summary>Painted drag coefficient; lift stays as it is.</summary>
        public const uint MUSLIN_MAP_DRAG = 5;

        /// <summary>
        /// Value of `self_collision`: parts of the cloth pass through each other.
        /// </summary>
        public const uint MUSLIN_SELF_COLLISION_NONE = 0;

        /// <summary>
        /// Value of `self_collision`: triangles collide with triangles, so that no part of the
        /// surface passes through another. With the material's friction.
        ///
        /// - Gap: the material's thickness, or `self_distance`, at most half of the mean rest
        ///   length. Parts that are nearer than two gaps in the rest shape keep half of their rest
        ///   distance.
        /// - Tears: the two sides of a fresh tear are moved apart by 1/1000 of the mean rest
        ///   length, so that they collide too.
        /// - Pins and grabs: what they hold pushes other parts out of its way. Cloth that is caught
        ///   between two held parts may be forced through.
        /// - Existing intersections (at the start, after this is switched on, or where particles
        ///   were placed) are untangled, unless they are held: the smaller part moves back to the
        ///   side of the rest, mostly within a second.
        /// - Cost: about as much as the rest of a tick while little touches; several times that
        ///   where layers lie on each other; 20 to several hundred times where sheets of thousands
        ///   of particles crumple.
        /// </summary>
        public const uint MUSLIN_SELF_COLLISION_SURFACE = 1;

        /// <summary>
        /// Value of `self_collision`: particles collide with particles, as if they were balls.
        ///
        /// - Cheap and without friction. A fold may pass through where particles are farther apart
        ///   than `self_distance`.
        /// - Two particles of one piece do not collide if their distance in the rest shape is below
        ///   `self_distance` or 1.5 mean rest lengths. Pinned and grabbed particles do not collide.
        /// </summary>
        public const uint MUSLIN_SELF_COLLISION_PARTICLES = 2;

        /// <summary>No particle is pinned: the cloth falls.</summary>
        public const uint MUSLIN_PIN_NONE = 0;

        /// <summary>All particles of the first row are pinned.</summary>
        public const uint MUSLIN_PIN_TOP_EDGE = 1;

        /// <summary>The two ends of the first row are pinned.</summary>
        public const uint MUSLIN_PIN_TOP_CORNERS = 2;

        /// <summary>All four corners are pinned.</summary>
        public const uint MUSLIN_PIN_CORNERS = 3;

        /// <summary>
        /// Value of `extra_particles` that reserves as many particles again as the cloth starts
        /// with.
        /// </summary>
        public const uint MUSLIN_AS_MANY_AGAIN = 0xFFFFFFFF;

        /// <summary>
        /// Aerodynamic forces on each triangle, proportional to the square of the relative air
        /// speed. Still air damps the motion.
        /// </summary>
        public const uint MUSLIN_WIND_SURFACE = 0;

        /// <summary>
        /// A field of sine waves that accelerates each particle, independent of the direction of
        /// the surface. The length of `velocity` is the strength [m/s^2].
        /// </summary>
        public const uint MUSLIN_WIND_SINE_FIELD = 1;

        /// <summary>
        /// Half-space below `position` along the rotated y axis; infinite in extent.
        /// </summary>
        public const uint MUSLIN_SHAPE_PLANE = 0;

        /// <summary>Sphere of `radius` around `position`.</summary>
        public const uint MUSLIN_SHAPE_SPHERE = 1;

        /// <summary>
        /// Capsule along the rotated y axis: spheres of `radius` at -`half_height` and of
        /// `top_radius` at +`half_height`, and all between them (a tapered capsule if the radii
        /// differ).
        /// </summary>
        public const uint MUSLIN_SHAPE_CAPSULE = 2;

        /// <summary>
        /// Box that extends by `half_extents` to either side of `position` along each rotated axis.
        /// </summary>
        public const uint MUSLIN_SHAPE_BOX = 3;

        /// <summary>Convex hull of `positions`.</summary>
        public const uint MUSLIN_SHAPE_CONVEX = 4;

        /// <summary>
        /// Triangle mesh: the triangles of `indices` over `positions`.
        ///
        /// The cloth stays on the side where it is: both sides are outside. So the mesh need not be
        /// closed or consistently wound. With `solid` a closed mesh pushes out what is inside. The
        /// gap is at least 0.1 mm.
        /// </summary>
        public const uint MUSLIN_SHAPE_MESH = 5;

        /// <summary>
        /// Terrain: all below a surface over a grid of `columns` * `rows` heights.
        ///
        /// The heights are `spacing` apart along the rotated x and z axes, starting at `position`.
        /// The terrain is as deep as it is wide, and has no side walls.
        /// </summary>
        public const uint MUSLIN_SHAPE_HEIGHTFIELD = 6;

        /// <summary>The edge between `particle_a` and `particle_b` tore.</summary>
        public const uint MUSLIN_EVENT_EDGE_TORN = 0;

        /// <summary>
        /// `vertex` was split off from `source`.
        ///
        /// If a particle with several vertices was split between these vertices, no vertex had to
        /// be split: then both are the lowest vertex that moved to the new particle.
        /// </summary>
        public const uint MUSLIN_EVENT_VERTEX_SPLIT = 1;

        /// <summary>
        /// A piece of `count` triangles came off; `vertex` belongs to one of them.
        /// </summary>
        public const uint MUSLIN_EVENT_PIECE_DETACHED = 2;

        /// <summary>
        /// `count` particles had positions or velocities that were not finite, and were put back to
        /// their last valid positions.
        /// </summary>
        public const uint MUSLIN_EVENT_RECOVERED = 3;

        /// <summary>
        /// Tearing stopped: the particles that `extra_particles` reserved are used up. Reported
        /// once.
        /// </summary>
        public const uint MUSLIN_EVENT_RESERVE_USED_UP = 4;

        /// <summary>
        /// Pins, grabs or anchors stretch the cloth past `max_stretch`: `count` links exceed it,
        /// one of them between `particle_a` and `particle_b`. Reported once, until the limit holds
        /// again. Also for `count` sewn pairs whose particles are both held apart.
        /// </summary>
        public const uint MUSLIN_EVENT_HELD_APART = 5;

        /// <summary>
        /// A cut added `vertex` on the edge between `particle_a` and `particle_b`.
        ///
        /// If the two sides of that edge have different vertices there, the next vertex belongs to
        /// the other side.
        /// </summary>
        public const uint MUSLIN_EVENT_EDGE_DIVIDED = 6;

        /// <summary>
        /// Pins, attachments or grabs hold `count` particles inside a collider; `particle_a` is the
        /// first of them. Reported once, until none is inside.
        /// </summary>
        public const uint MUSLIN_EVENT_HELD_INSIDE = 7;

        /// <summary>
        /// `count` particles that nothing holds are inside a collider; `particle_a` is the first of
        /// them. Reported once, until none is inside.
        ///
        /// Other colliders or held cloth leave them no room, or they were placed there.
        /// </summary>
        public const uint MUSLIN_EVENT_FREE_INSIDE = 8;

        /// <summary>
        /// With surface collision, edges of the cloth pass through triangles of it: `count` pairs
        /// of both. One of the edges is between `particle_a` and `particle_b`. Reported once, until
        /// none does.
        /// </summary>
        public const uint MUSLIN_EVENT_LAYERS_CROSS = 9;

        /// <summary>
        /// The stitch between `particle_a` and `particle_b` tore, see muslin_cloth_sew.
        /// </summary>
        public const uint MUSLIN_EVENT_STITCH_TORN = 10;

        /// <summary>Position [m]: x y z; in 16-bit formats x y z 1.</summary>
        public const uint MUSLIN_ATTRIBUTE_POSITION = 0;

        /// <summary>Unit normal: x y z; in 16-bit formats x y z 0.</summary>
        public const uint MUSLIN_ATTRIBUTE_NORMAL = 1;

        /// <summary>
        /// Tangent: x y z w. The unit vector perpendicular to the normal in which texture
        /// coordinate u grows; w is 1 or -1, and v grows along cross(normal, tangent) times w.
        ///
        /// It is the sum over the vertex's triangles of (p dv2 - q dv1) sign(du1 dv2 - du2 dv1),
        /// made perpendicular to the normal. p and q are edges of the triangle; (du1, dv1) and
        /// (du2, dv2) are the same edges in texture space. Where texture coordinates are
        /// degenerate, it is any perpendicular direction.
        /// </summary>
        public const uint MUSLIN_ATTRIBUTE_TANGENT = 2;

        /// <summary>Texture coordinates: u v.</summary>
        public const uint MUSLIN_ATTRIBUTE_UV = 3;

        /// <summary>
        /// 1 on a border that a tear or cut made, e.g. to draw fringes, else 0; in 16-bit formats
        /// followed by 0.
        /// </summary>
        public const uint MUSLIN_ATTRIBUTE_FRAYED = 4;

        /// <summary>
        /// 32-bit floats. Bytes: position and normal 12, tangent 16, uv 8, frayed 4.
        /// </summary>
        public const uint MUSLIN_FORMAT_F32 = 0;

        /// <summary>
        /// 16-bit floats. Values beyond 65504 are clamped. Bytes: position, normal and tangent 8,
        /// uv and frayed 4.
        /// </summary>
        public const uint MUSLIN_FORMAT_F16 = 1;

        /// <summary>
        /// Signed 16-bit integers; -32767 to 32767 stand for -1 to 1. Bytes: normal and tangent 8,
        /// frayed 4. Not for other attributes.
        /// </summary>
        public const uint MUSLIN_FORMAT_SNORM16 = 2;

        /// <summary>
        /// Unit vectors in octahedral encoding, as two 16-bit integers like MUSLIN_FORMAT_SNORM16.
        /// Bytes: normal 4, tangent 8 (u, v, w and 0). Not for other attributes.
        ///
        /// The vector is projected onto the octahedron |x| + |y| + |z| = 1. The encoding is x and
        /// y, with the lower half (z &lt; 0) folded outward to (1 - |y|) sign(x) and (1 - |x|)
        /// sign(y).
        /// </summary>
        public const uint MUSLIN_FORMAT_OCTAHEDRAL16 = 3;

        /// <summary>Largest number of streams in one call.</summary>
        public const uint MUSLIN_MAX_STREAMS = 16;

        /// <summary>
        /// Value of `vertex_count` that means all vertices from `first_vertex` on.
        /// </summary>
        public const uint MUSLIN_ALL_VERTICES = 0xFFFFFFFF;

        /// <summary>
        /// Length of `seconds` in MuslinStats. `stage_count` says how many entries are used.
        /// </summary>
        public const uint MUSLIN_STAGE_SLOTS = 31;

        /// <summary>
        /// Value of `kind`: as if woven in one piece. It never tears, and normals are smooth
        /// across.
        /// </summary>
        public const uint MUSLIN_SEW_WELD = 0;

        /// <summary>
        /// Value of `kind`: a thread. It tears under more than `tear_force`, and keeps the normals
        /// of both sides apart.
        /// </summary>
        public const uint MUSLIN_SEW_STITCH = 1;

        /// <summary>
        /// Returns the version of the running library as 0x00MMmmpp: major, minor, patch.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern uint muslin_version();

        /// <summary>
        /// Returns the version of the running library as "major.minor.patch". The pointer is always
        /// valid.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern byte* muslin_version_string();

        /// <summary>
        /// Returns the general meaning of a MuslinStatus. Accepts any number; the pointer is always
        /// valid.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern byte* muslin_status_string(uint status);

        /// <summary>
        /// Returns the message of this thread's last call that was refused; it names the argument
        /// and the rule. "" if no call was refused yet. Successful calls do not change it.
        ///
        /// The pointer is never NULL, and valid until the next call of this thread that is refused.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern byte* muslin_last_error();

        /// <summary>
        /// Returns the name of a stage of the tick, for `seconds` of MuslinStats. Stages are
        /// numbered from 0; NULL beyond the last one. The pointer is always valid.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern byte* muslin_stage_name(uint stage);

        /// <summary>
        /// Sends log messages up to `max_level` (MUSLIN_LOG_ERROR, MUSLIN_LOG_WARN or
        /// MUSLIN_LOG_INFO) to `log`. NULL, the initial value, switches the log off.
        ///
        /// `log` is called on the thread of the call that it reports, perhaps on several threads at
        /// once, and may call the library. `user` is passed to it unchanged. Both must stay valid
        /// until they are replaced and calls that are running on other threads have returned.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_set_log(
            MuslinLogFn log,
            uint max_level,
            void* user);

        /// <summary>
        /// Makes a cloth from a regular grid. Destroy it with muslin_cloth_destroy.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE for an invalid field of `desc`; MUSLIN_STATUS_UNSUPPORTED if
        /// `desc` is of a newer version and uses fields that this library does not have
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_create_grid(
            MuslinGridDesc* desc,
            MuslinCloth* out_cloth);

        /// <summary>
        /// Makes a cloth from any triangle mesh; its lists are copied. Defects of the mesh are
        /// repaired, see muslin_cloth_get_mesh_report. Destroy the cloth with muslin_cloth_destroy.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX for an invalid field of `desc`;
        /// MUSLIN_STATUS_BAD_MESH if the mesh cannot be repaired: a triangle has an area that is
        /// not finite, or no triangle has an area; MUSLIN_STATUS_UNSUPPORTED if `desc` is of a
        /// newer version and uses fields that this library does not have
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_create_mesh(
            MuslinMeshDesc* desc,
            MuslinCloth* out_cloth);

        /// <summary>
        /// Makes an independent copy of a cloth, in the same state. Destroy it with
        /// muslin_cloth_destroy.
        ///
        /// Both continue with the same bits as long as they get the same calls. Handles of grabs,
        /// attachments and colliders are valid for both; skins stay with `cloth`.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_duplicate(
            MuslinCloth cloth,
            MuslinCloth* out_cloth);

        /// <summary>
        /// Destroys a cloth. Its handle becomes stale; memory borrowed from it must no longer be
        /// read.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_destroy(MuslinCloth cloth);

        /// <summary>
        /// Restores the initial state: rest shape, no tears or cuts, zero velocities, the pins of
        /// the descriptor, time zero, all mass scales 1. Removes all grabs, attachments, anchors,
        /// creases and events.
        ///
        /// Settings, material, wind and colliders stay as they are now. Handles of grabs and
        /// attachments become stale; handles of colliders stay valid.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_reset(MuslinCloth cloth);

        /// <summary>
        /// Sets the values of a fabric: MUSLIN_PRESET_SILK, MUSLIN_PRESET_COTTON,
        /// MUSLIN_PRESET_DENIM, MUSLIN_PRESET_LEATHER, MUSLIN_PRESET_PAPER or
        /// MUSLIN_PRESET_FLAG_NYLON.
        ///
        /// `material` must be initialised with muslin_material_init, or be part of an initialised
        /// descriptor.
        /// </summary>
        /// <returns>MUSLIN_STATUS_BAD_VALUE for any other `preset`</returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_material_preset(
            MuslinMaterial* material,
            uint preset);

        /// <summary>
        /// Reads the current settings. Initialise `out_settings` with muslin_settings_init.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_settings(
            MuslinCloth cloth,
            MuslinSettings* out_settings);

        /// <summary>
        /// Replaces the settings; they take effect with the next tick. Velocities stay as they are.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE for an invalid field; MUSLIN_STATUS_UNSUPPORTED if `settings` is
        /// of a newer version and uses fields that this library does not have
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_settings(
            MuslinCloth cloth,
            MuslinSettings* settings);

        /// <summary>
        /// Reads the current material. Initialise `out_material` with muslin_material_init.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_material(
            MuslinCloth cloth,
            MuslinMaterial* out_material);

        /// <summary>
        /// Replaces the material; it takes effect with the next tick. Velocities stay as they are.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE for an invalid field; MUSLIN_STATUS_UNSUPPORTED if `material` is
        /// of a newer version and uses fields that this library does not have
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_material(
            MuslinCloth cloth,
            MuslinMaterial* material);

        /// <summary>Replaces the wind; it takes effect with the next tick.</summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE for an invalid field; MUSLIN_STATUS_UNSUPPORTED if `wind` is of
        /// a newer version and uses fields that this library does not have
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_wind(
            MuslinCloth cloth,
            MuslinWind* wind);

        /// <summary>
        /// Runs the ticks that are due after `seconds` [s] of frame time. `out_ticks` (may be NULL)
        /// receives how many ran.
        ///
        /// The remainder, less than one tick, is kept for the next call; `blend` of MuslinStats
        /// returns it as a share of a tick. At most `max_ticks_per_advance` ticks run; the rest of
        /// the backlog is dropped, so a slow machine shows slow motion instead of falling further
        /// behind. Zero seconds change nothing.
        ///
        /// Poses that were given since the last tick (targets of pins and grabs, attachments,
        /// anchors, colliders, the frame of muslin_cloth_move_frame) are reached evenly over the
        /// ticks of this call, and exactly at the end of the last one. If no tick runs, they wait
        /// for the next call.
        /// </summary>
        /// <returns>MUSLIN_STATUS_BAD_VALUE if `seconds` is negative or not finite</returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_advance(
            MuslinCloth cloth,
            float seconds,
            uint* out_ticks);

        /// <summary>
        /// Advances `count` cloths by `seconds` [s] of frame time, each as muslin_cloth_advance
        /// does, with the same bits. `out_ticks` (may be NULL) receives how many ticks each of them
        /// ran.
        ///
        /// A cloth that sleeps costs next to nothing. `cloths` may be NULL if `count` is 0.
        ///
        /// If one of the cloths is refused, none of them advances; the message names its index.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE if `seconds` is negative or not finite, or if a cloth occurs
        /// twice
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloths_advance(
            MuslinCloth* cloths,
            uint count,
            float seconds,
            uint* out_ticks);

        /// <summary>
        /// Runs exactly `ticks` ticks. The time that muslin_cloth_advance keeps for the next frame
        /// does not change. Poses that were given before the call are reached in the first of these
        /// ticks.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_step(MuslinCloth cloth, uint ticks);

        /// <summary>
        /// Reads the share of a tick that muslin_cloth_advance has not simulated yet, from 0 to 1:
        /// the `blend` of MuslinWriteDesc for smooth motion at any frame rate.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_blend(
            MuslinCloth cloth,
            float* out_blend);

        /// <summary>
        /// Reads whether the cloth sleeps, 1 or 0, see `sleep_speed` of MuslinSettings: ticks then
        /// move nothing until something wakes it.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_is_asleep(
            MuslinCloth cloth,
            uint* out_asleep);

        /// <summary>Reads the current wind. Initialise `out_wind` with muslin_wind_init.</summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_wind(
            MuslinCloth cloth,
            MuslinWind* out_wind);

        /// <summary>
        /// Reads the simulated time since the cloth was made or reset.
        ///
        /// `out_seconds` (may be NULL) receives it in seconds, `out_ticks` (may be NULL) in ticks.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_time(
            MuslinCloth cloth,
            double* out_seconds,
            ulong* out_ticks);

        /// <summary>
        /// Reads mass, center of mass and momentum of the whole cloth, pinned particles included.
        /// Computed on each call, in one pass over the particles.
        ///
        /// `out_total` (may be NULL) receives the mass [kg], `out_center` (may be NULL) the center
        /// of mass [m], `out_momentum` (may be NULL) the sum of mass times velocity [kg m/s].
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_mass(
            MuslinCloth cloth,
            float* out_total,
            MuslinVec3* out_center,
            MuslinVec3* out_momentum);

        /// <summary>
        /// Pins a particle at `target` [m], or at its current position if `target` is NULL.
        ///
        /// The particle reaches the target evenly over the ticks of the next muslin_cloth_advance,
        /// or in the next tick of muslin_cloth_step. If it is already pinned, the target changes
        /// and the stiffness stays; an attached particle leaves its attachment.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_BAD_VALUE if the
        /// target is not finite
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_pin(
            MuslinCloth cloth,
            uint particle,
            MuslinVec3* target);

        /// <summary>
        /// Releases a pinned particle, which keeps its velocity. Has no effect on a particle that
        /// is not pinned.
        /// </summary>
        /// <returns>MUSLIN_STATUS_BAD_INDEX if the particle does not exist</returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_unpin(MuslinCloth cloth, uint particle);

        /// <summary>Releases all pinned particles.</summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_unpin_all(MuslinCloth cloth);

        /// <summary>
        /// Sets the targets [m] of `count` pins at once, e.g. every frame for an animated edge.
        /// Particles that are not pinned yet become pinned. They reach their targets as those of
        /// muslin_cloth_pin.
        ///
        /// Targets are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a
        /// multiple of 4). With `count` 0 both pointers may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
        /// target is not finite, `stride` is invalid, or `count` exceeds the number of particles
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_pin_targets(
            MuslinCloth cloth,
            uint* particles,
            void* positions,
            uint stride,
            uint count);

        /// <summary>
        /// Sets the stiffness [N/m] with which `count` pins pull particles towards their targets.
        /// 0, the initial value, holds them exactly; above 0 the pin is a spring.
        ///
        /// - A load of 1 N moves a soft pin's particle 1/`stiffness` metres from its target: 1e3
        ///   N/m feels firm, 10 N/m lets a sheet of cotton sag by a few centimetres.
        /// - For tears and `max_stretch` the cloth counts as free at a soft pin, and it is not
        ///   tethered to it.
        /// - A tear through a soft pin divides its stiffness in proportion to mass.
        ///
        /// With `count` 0 the pointer may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
        /// particle is not pinned, `stiffness` is negative or not finite, or `count` exceeds the
        /// number of particles
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_pin_stiffness(
            MuslinCloth cloth,
            uint* particles,
            uint count,
            float stiffness);

        /// <summary>
        /// Returns the pinned particles, in ascending order. `out_count` receives their number.
        ///
        /// If `capacity` is 0, only the number is returned, and `out_particles` may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BUFFER_TOO_SMALL if `capacity` is neither 0 nor at least that number:
        /// nothing is written, and muslin_last_error() states the number
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_pins(
            MuslinCloth cloth,
            uint* out_particles,
            uint capacity,
            uint* out_count);

        /// <summary>
        /// Reads the targets of `count` pins [m], which their particles reach with the next ticks.
        /// Those of attached particles follow from the pose of their attachment.
        ///
        /// Targets are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a
        /// multiple of 4), and the bytes between them do not change. With `count` 0 both pointers
        /// may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
        /// particle is not pinned, `stride` is invalid, or `count` exceeds the number of particles
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_pin_targets(
            MuslinCloth cloth,
            uint* particles,
            float* out_positions,
            uint stride,
            uint count);

        /// <summary>
        /// Multiplies the masses of `count` particles by factors: 1, the initial value, keeps the
        /// mass that density and surrounding area give. A hem hangs straight at about 5; a coin
        /// that is sewn in may be 100.
        ///
        /// Factors stay when the density changes. Neighbours may differ by a factor of 100; at
        /// factors in the thousands, light particles that carry heavy ones stretch unless
        /// `substeps` is raised. With `count` 0 both pointers may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
        /// factor is not from 0.001 to 1000, or `count` exceeds the number of particles
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_mass_scales(
            MuslinCloth cloth,
            uint* particles,
            float* scales,
            uint count);

        /// <summary>
        /// Paints a property (MUSLIN_MAP_STRETCH, MUSLIN_MAP_BEND, MUSLIN_MAP_TEAR,
        /// MUSLIN_MAP_FRICTION, MUSLIN_MAP_THICKNESS or MUSLIN_MAP_DRAG): multiplies what the
        /// material says by one scale per particle, from 0 to 1000; 1 is as the material says. NULL
        /// takes the map away, whatever `count`.
        ///
        /// A link, a hinge or a triangle takes the mean of the scales at its corners; a contact
        /// interpolates them at its point, and two layers take the mean of both sides. Own values
        /// of a collider are scaled too.
        ///
        /// Maps stay when the material changes and when the cloth is reset. A particle that a tear
        /// splits off takes the scale of its source; one that a cut adds to an edge takes the scale
        /// between those of its ends. Scales take effect with the next tick. A map takes memory
        /// only while it is set.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE for any other `map`, if `count` is not the number of particles,
        /// or if a scale is not from 0 to 1000 (the message names its index)
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_map(
            MuslinCloth cloth,
            uint map,
            float* scales,
            uint count);

        /// <summary>
        /// Reads a painted map: one scale per particle, also of those that tears and cuts added; 1
        /// for all if the map is not set.
        ///
        /// `map` is a MUSLIN_MAP_ value. `out_scales` (may be NULL) receives `count` scales,
        /// `out_is_set` (may be NULL) 1 if the map is set, else 0.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE for any other `map`, or if `count` is not the number of
        /// particles; without `out_scales`, `count` is ignored
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_map(
            MuslinCloth cloth,
            uint map,
            float* out_scales,
            uint count,
            uint* out_is_set);

        /// <summary>
        /// Places a particle at `position` [m] at once. Its velocity stays as it is. A pinned
        /// particle stays pinned, at the new position.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_BAD_VALUE if the
        /// position is not finite
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_position(
            MuslinCloth cloth,
            uint particle,
            MuslinVec3 position);

        /// <summary>Sets the velocity of a particle [m/s].</summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_BAD_VALUE if the
        /// velocity is not finite
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_velocity(
            MuslinCloth cloth,
            uint particle,
            MuslinVec3 velocity);

        /// <summary>
        /// Places `count` particles, from `first` on, at once [m]: a whole pose, if `first` is 0
        /// and `count` the number of particles.
        ///
        /// Velocities stay as they are; call muslin_cloth_set_velocities too to continue from a
        /// recorded state. Pinned particles stay pinned, at the new positions. Positions are 3
        /// floats each; consecutive ones start `stride` bytes apart (0 means 12; a multiple of 4).
        /// With `count` 0 the pointer may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if a
        /// position is not finite (the message names its index), `stride` is invalid, or `count`
        /// exceeds the number of particles from `first` on
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_positions(
            MuslinCloth cloth,
            uint first,
            uint count,
            float* positions,
            uint stride);

        /// <summary>
        /// Sets the velocities of `count` particles, from `first` on [m/s].
        ///
        /// Velocities are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a
        /// multiple of 4). With `count` 0 the pointer may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if a
        /// velocity is not finite (the message names its index), `stride` is invalid, or `count`
        /// exceeds the number of particles from `first` on
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_velocities(
            MuslinCloth cloth,
            uint first,
            uint count,
            float* velocities,
            uint stride);

        /// <summary>
        /// Reads the velocities of `count` particles, from `first` on [m/s].
        ///
        /// Velocities are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a
        /// multiple of 4), and the bytes between them do not change. With `count` 0 the pointer may
        /// be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if
        /// `stride` is invalid, or `count` exceeds the number of particles from `first` on
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_velocities(
            MuslinCloth cloth,
            uint first,
            uint count,
            float* out_velocities,
            uint stride);

        /// <summary>
        /// Reads the positions that `count` particles, from `first` on, have in the rest shape [m]:
        /// where the descriptor placed them, whatever moved them since.
        ///
        /// A particle that a tear split off has the position of its source; one that a cut added
        /// has the point of the rest edge that was cut. Strides are as in
        /// muslin_cloth_get_velocities. With `count` 0 the pointer may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if
        /// `stride` is invalid, or `count` exceeds the number of particles from `first` on
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_rest_positions(
            MuslinCloth cloth,
            uint first,
            uint count,
            float* out_positions,
            uint stride);

        /// <summary>
        /// Attaches `count` particles to a transform at `position` [m] with `rotation`, e.g. a
        /// bone, a pole or a car body. The particles are pinned at their current positions;
        /// muslin_cloth_move_attachment moves them.
        ///
        /// - A particle that is already pinned, or attached to another transform, keeps its
        ///   stiffness and moves to this attachment.
        /// - A particle leaves the attachment when it gets a pin target of its own or is unpinned.
        /// - A tear or cut through attached particles attaches the new particles too.
        /// - muslin_cloth_reset removes all attachments.
        ///
        /// With `count` 0 the pointer may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if
        /// `position` is not finite, `rotation` is not a unit quaternion, or `count` exceeds the
        /// number of particles; MUSLIN_STATUS_FULL if there are 64 attachments already
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_attach(
            MuslinCloth cloth,
            uint* particles,
            uint count,
            MuslinVec3 position,
            MuslinQuat rotation,
            MuslinAttachment* out_attachment);

        /// <summary>
        /// Moves an attachment: its particles reach the new pose evenly over the ticks of the next
        /// muslin_cloth_advance, or in the next tick of muslin_cloth_step. They rotate with the
        /// transform on the way, and are exactly there at the end.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_HANDLE if it was detached; MUSLIN_STATUS_BAD_VALUE if `position` is
        /// not finite or `rotation` is not a unit quaternion
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_move_attachment(
            MuslinCloth cloth,
            MuslinAttachment attachment,
            MuslinVec3 position,
            MuslinQuat rotation);

        /// <summary>
        /// Removes an attachment and unpins the particles that it still carries; they keep their
        /// velocities.
        /// </summary>
        /// <returns>MUSLIN_STATUS_BAD_HANDLE if it was detached before</returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_detach(
            MuslinCloth cloth,
            MuslinAttachment attachment);

        /// <summary>
        /// Limits how far `count` particles may be from their anchors [m]. The limit holds after
        /// every tick, whatever pulls at the particle.
        ///
        /// - Infinity, the initial value, means no limit; 0 fixes the particle to its anchor.
        /// - The anchor of a particle is the position of the last muslin_cloth_set_anchors; before
        ///   the first one, it is the particle's current position.
        /// - Pins and grabs take precedence over the limit.
        /// - A limit may stretch the cloth past `max_stretch`; this is reported as for pins, in
        ///   MuslinStats and by MUSLIN_EVENT_HELD_APART.
        /// - muslin_cloth_reset removes all limits.
        ///
        /// With `count` 0 both pointers may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
        /// distance is negative or NaN, or `count` exceeds the number of particles
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_max_distances(
            MuslinCloth cloth,
            uint* particles,
            float* distances,
            uint count);

        /// <summary>
        /// Gives `count` particles backstops: spheres behind their anchors that the particles
        /// cannot enter, so that a garment does not sink into the body that wears it.
        ///
        /// Each sphere has a radius [m], 0 for none. Its surface is the given distance [m] behind
        /// the anchor, opposite to the normal of muslin_cloth_set_anchors; a particle without a
        /// normal has no backstop. With `count` 0 the pointers may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
        /// distance or radius is negative or not finite, or `count` exceeds the number of particles
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_backstops(
            MuslinCloth cloth,
            uint* particles,
            float* distances,
            float* radii,
            uint count);

        /// <summary>
        /// Sets the animated positions [m] and outward normals of `count` particles, for
        /// muslin_cloth_set_max_distances and muslin_cloth_set_backstops. Call it once per frame.
        ///
        /// Anchors move to the new positions evenly over the ticks of the next
        /// muslin_cloth_advance, or in the next tick of muslin_cloth_step; a particle's first
        /// anchor is in place at once. Positions and normals are 3 floats each; consecutive ones
        /// start `stride` bytes apart in both lists (0 means 12; a multiple of 4). Normals need not
        /// have length 1; NULL keeps the previous normals. With `count` 0 all pointers may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
        /// number is not finite, a normal has length 0, `stride` is invalid, or `count` exceeds the
        /// number of particles
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_anchors(
            MuslinCloth cloth,
            uint* particles,
            void* positions,
            void* normals,
            uint stride,
            uint count);

        /// <summary>Removes all anchors, maximum distances and backstops.</summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_clear_leashes(MuslinCloth cloth);

        /// <summary>
        /// Finds the first triangle that a ray hits within `max_distance` [m], from either side.
        ///
        /// `direction` need not have length 1; `max_distance` may be infinite. Initialise `out_hit`
        /// with muslin_hit_init.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_NOTHING_HIT if the ray hits nothing; MUSLIN_STATUS_BAD_VALUE if `origin`
        /// or `direction` is not finite, `direction` is zero, or `max_distance` is negative or NaN
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_raycast(
            MuslinCloth cloth,
            MuslinVec3 origin,
            MuslinVec3 direction,
            float max_distance,
            MuslinHit* out_hit);

        /// <summary>
        /// Grabs the particle that a ray points at: the nearest corner of the first triangle that
        /// the ray hits; if it hits none, the particle nearest to the ray within `radius` [m].
        ///
        /// `out_at` (may be NULL) receives the position of the particle [m]. See
        /// muslin_cloth_grab_particle.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_NOTHING_HIT if there is no such particle; MUSLIN_STATUS_BAD_VALUE if
        /// `origin` or `direction` is not finite, `direction` is zero, or `radius` is negative or
        /// not finite; MUSLIN_STATUS_FULL if there are 64 grabs already
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_grab_ray(
            MuslinCloth cloth,
            MuslinVec3 origin,
            MuslinVec3 direction,
            float radius,
            MuslinGrab* out_grab,
            MuslinVec3* out_at);

        /// <summary>
        /// Grabs a particle at its current position.
        ///
        /// The particle then follows the target of muslin_cloth_move_grab exactly, at most
        /// `max_displacement` per substep, and pulls the cloth along.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_FULL if there are
        /// 64 grabs already
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_grab_particle(
            MuslinCloth cloth,
            uint particle,
            MuslinGrab* out_grab);

        /// <summary>
        /// Sets the target of a grab [m]. Within the speed limit the particle reaches it evenly
        /// over the ticks of the next muslin_cloth_advance, or in the next tick of
        /// muslin_cloth_step.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_HANDLE if the grab was released; MUSLIN_STATUS_BAD_VALUE if the target
        /// is not finite
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_move_grab(
            MuslinCloth cloth,
            MuslinGrab grab,
            MuslinVec3 target);

        /// <summary>
        /// Releases a grabbed particle, which keeps its velocity. A pinned particle stays pinned
        /// and returns to its pin evenly over the ticks of the next muslin_cloth_advance, or in the
        /// next tick of muslin_cloth_step.
        /// </summary>
        /// <returns>MUSLIN_STATUS_BAD_HANDLE if the grab was released before</returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_release(MuslinCloth cloth, MuslinGrab grab);

        /// <summary>
        /// Tears the cloth between two neighbouring particles, as over-stretching does.
        ///
        /// The particle under the higher load is split by the plane that is perpendicular to the
        /// edge. If neither particle has triangles on its other side, the edge itself opens,
        /// provided that it starts at a border.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_NOT_TORN if both ends are pinned or grabbed, or the edge is already a
        /// border; MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE
        /// unless the two are the ends of an edge; MUSLIN_STATUS_FULL if the reserve for tears is
        /// used up
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_tear_edge(
            MuslinCloth cloth,
            uint particle_a,
            uint particle_b);

        /// <summary>
        /// Adds a fold of `angle` [rad] to the rest shape, along the line from `from` to `to` [m].
        /// Both points are given on the cloth as it was made.
        ///
        /// - A positive angle folds towards the front of the cloth (the side from which triangles
        ///   are counter-clockwise), a negative one away from it.
        /// - The line need not follow the mesh: the fold is distributed over the cells beside it. A
        ///   line that misses the cloth has no effect.
        /// - The cloth bends only as far as `bend_stiffness` can turn it.
        /// - The fold lasts until muslin_cloth_reset; a second crease of -`angle` along the same
        ///   line removes it.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE if a number is not finite, `to` equals `from`, or `angle` is not
        /// from -3 to 3; the cloth is unchanged then
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_crease(
            MuslinCloth cloth,
            MuslinVec3 from,
            MuslinVec3 to,
            float angle);

        /// <summary>
        /// Cuts the cloth with a blade: the segment from `from` to `to` [m], swept along `sweep`
        /// [m].
        ///
        /// `out_edges` (may be NULL) receives the number of opened edges; 0 means that the blade
        /// missed and nothing changed.
        ///
        /// - Triangles that the blade crosses are divided along it: new vertices lie on the crossed
        ///   edges, with attributes interpolated between the edge's ends, and the mesh opens along
        ///   them.
        /// - The cut goes through an existing vertex instead if it would pass closer than an eighth
        ///   of an edge, or would leave a triangle with an angle below 5 degrees or with less than
        ///   1/200 of the area of a square of the mean edge. It does not snap to a pinned vertex;
        ///   it passes it at an eighth of the edge.
        /// - Where the blade ends inside a triangle, the cut ends at the edge before it.
        /// - New vertices are free; a pinned vertex that the cut goes through is pinned on both
        ///   sides.
        /// - Mass and rest area are conserved.
        /// - Each crossed edge uses one particle of the reserve (`extra_particles`), and one more
        ///   if it opens.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE if a number is not finite, `to` equals `from`, or `sweep` is
        /// zero or parallel to the segment; MUSLIN_STATUS_FULL if the reserve cannot hold the whole
        /// cut; the cloth is unchanged then
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_cut(
            MuslinCloth cloth,
            MuslinVec3 from,
            MuslinVec3 to,
            MuslinVec3 sweep,
            uint* out_edges);

        /// <summary>
        /// Removes the oldest unread event and writes it to `out_event`. The newest 1024 are kept.
        ///
        /// `out_some` becomes 1, or 0 if there is no event; then `out_event` is not written.
        /// Initialise `out_event` with muslin_event_init.
        ///
        /// Events are ordered by tick, and within a tick:
        /// - recoveries;
        /// - tears, the most stretched edge first: for each, its split vertices, then the torn
        ///   edge;
        /// - the exhausted reserve, if it cannot hold another tear;
        /// - detached pieces, ordered by their first triangle;
        /// - links that pins or grabs hold past `max_stretch`.
        ///
        /// A cut adds the edges that it divided, in its order, then the edges that it opened, the
        /// vertices that it split, and the detached pieces.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_next_event(
            MuslinCloth cloth,
            MuslinEvent* out_event,
            uint* out_some);

        /// <summary>Adds a collider to a cloth. It acts from the next tick on.</summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX for an invalid field of `desc`;
        /// MUSLIN_STATUS_UNSUPPORTED for a shape that this version does not have;
        /// MUSLIN_STATUS_FULL if there are 1024 colliders already
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_add_collider(
            MuslinCloth cloth,
            MuslinColliderDesc* desc,
            MuslinCollider* out_collider);

        /// <summary>
        /// Moves a collider to a new pose, which it reaches evenly over the ticks of the next
        /// muslin_cloth_advance, or in the next tick of muslin_cloth_step. The motion is swept, so
        /// a fast collider does not jump through the cloth.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_HANDLE if it was removed; MUSLIN_STATUS_BAD_VALUE if `position` is not
        /// finite or `rotation` is not a unit quaternion
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_move_collider(
            MuslinCloth cloth,
            MuslinCollider collider,
            MuslinVec3 position,
            MuslinQuat rotation);

        /// <summary>
        /// Gives a mesh collider new vertices, of the same number and with the same triangles: the
        /// body of a character in its next pose.
        ///
        /// Its surface reaches them evenly over the ticks of the next muslin_cloth_advance, or in
        /// the next tick of muslin_cloth_step, and is swept on its way: it carries cloth along.
        /// Positions are 3 floats each, in the frame of the collider [m]; consecutive ones start
        /// `stride` bytes apart (0 means 12; a multiple of 4). muslin_cloth_move_collider moves
        /// that frame as before. The first call prepares the mesh for that, which takes as long as
        /// adding it.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_HANDLE if the collider was removed; MUSLIN_STATUS_BAD_VALUE if it is
        /// no mesh, `count` is not the number of its vertices, a position is not between -1e6 and
        /// 1e6 (the message names its index) or `stride` is invalid
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_update_collider(
            MuslinCloth cloth,
            MuslinCollider collider,
            float* positions,
            uint stride,
            uint count);

        /// <summary>
        /// Makes the surface of another cloth a collider of this one, or updates it: clothes in
        /// layers, the inner one first.
        ///
        /// Call it in each frame between the muslin_cloth_advance of the inner cloth, `other`, and
        /// that of the outer one. `inout_collider` starts as {0}: then the collider is added, where
        /// `other` is now, and its handle written. With the handle of an earlier call, the collider
        /// reaches the present positions of `other` evenly over the ticks of the next
        /// muslin_cloth_advance, or in the next tick of muslin_cloth_step, and is swept on its way.
        /// It has two sides: this cloth stays on the side where it is. It keeps the mean of both
        /// thicknesses away, half of each, and has the mean of both coefficients of friction, as in
        /// the call; maps of `other` do not count. Where `other` has torn or been cut since, the
        /// collider takes its new triangles, which takes as long as adding it; the handle stays.
        ///
        /// The effect is one-way: `other` does not feel this cloth. Several pieces in one mesh,
        /// with MUSLIN_SELF_COLLISION_SURFACE, bear on each other, and nothing passes through; a
        /// layer gives no such guarantee where both cloths crumple or are squeezed. The motion
        /// since the last call is swept: after a reset or teleport of both cloths, remove the
        /// collider and start with {0} again. A save contains the collider, and the handle is valid
        /// for the restored cloth too.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_HANDLE if a cloth is not live, or the collider was removed;
        /// MUSLIN_STATUS_BAD_VALUE if `other` is the cloth itself, this call did not return the
        /// collider, no triangle of `other` has an area, or a particle of it is 1e6 m or more from
        /// its origin; MUSLIN_STATUS_FULL if there are 1024 colliders already; MUSLIN_STATUS_BUSY
        /// if either cloth is in use on another thread
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_collide_with(
            MuslinCloth cloth,
            MuslinCloth other,
            MuslinCollider* inout_collider);

        /// <summary>Removes a collider. Its handle becomes stale.</summary>
        /// <returns>MUSLIN_STATUS_BAD_HANDLE if it was removed before</returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_remove_collider(
            MuslinCloth cloth,
            MuslinCollider collider);

        /// <summary>
        /// Reads where a collider is now: after the last tick, or where it was added or teleported
        /// to since. A pose of muslin_cloth_move_collider counts once a tick has reached it.
        ///
        /// `out_position` (may be NULL) receives the position [m], `out_rotation` (may be NULL) the
        /// rotation.
        /// </summary>
        /// <returns>MUSLIN_STATUS_BAD_HANDLE if it was removed</returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_collider_pose(
            MuslinCloth cloth,
            MuslinCollider collider,
            MuslinVec3* out_position,
            MuslinQuat* out_rotation);

        /// <summary>
        /// Reads the impulse that the cloth applied to a collider in the last tick.
        ///
        /// `out_linear` (may be NULL) receives the linear impulse [kg m/s], `out_angular` (may be
        /// NULL) the angular impulse about the collider's position [kg m^2/s]. Divided by the
        /// length of a tick they are force and torque, for an engine that simulates the collider as
        /// a rigid body.
        /// </summary>
        /// <returns>MUSLIN_STATUS_BAD_HANDLE if it was removed</returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_collider_impulse(
            MuslinCloth cloth,
            MuslinCollider collider,
            MuslinVec3* out_linear,
            MuslinVec3* out_angular);

        /// <summary>
        /// Sets the pose of the body that wears the cloth, the start for muslin_cloth_teleport and
        /// muslin_cloth_move_frame. Moves nothing.
        ///
        /// The initial pose, also after muslin_cloth_reset, is the origin without rotation.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE if `position` is not finite or `rotation` is not a unit
        /// quaternion
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_set_frame(
            MuslinCloth cloth,
            MuslinVec3 position,
            MuslinQuat rotation);

        /// <summary>
        /// Moves the cloth with the body that wears it to a new pose at once, as a rigid body and
        /// without inertia. Velocities rotate with it.
        ///
        /// The motion starts at the pose of the last muslin_cloth_set_frame,
        /// muslin_cloth_move_frame or muslin_cloth_teleport. Pins, attachments, grabs and anchors
        /// move too; colliders do not, see muslin_cloth_teleport_collider. In a frame, call this
        /// before muslin_cloth_move_attachment and muslin_cloth_set_anchors.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE if `position` is not finite, `rotation` is not a unit
        /// quaternion, or a moved value would not be finite; the cloth is unchanged then
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_teleport(
            MuslinCloth cloth,
            MuslinVec3 position,
            MuslinQuat rotation);

        /// <summary>
        /// Moves the cloth with the body that wears it to a new pose over the ticks of the next
        /// muslin_cloth_advance, or in the next tick of muslin_cloth_step; the cloth feels only the
        /// share `inertia` of the motion.
        ///
        /// - 1: the cloth feels the whole motion, as without this call.
        /// - 0: the cloth feels nothing, as if the body stood still and the world moved.
        /// - Between: it feels this share of the translation and of the rotation.
        ///
        /// The motion starts at the pose of the last muslin_cloth_set_frame, muslin_cloth_teleport
        /// or muslin_cloth_move_frame. The part that is not felt moves particles at once, as a
        /// rigid body. Pins, attachments and anchors reach the body's new pose evenly over these
        /// ticks. Colliders and grabs stay at the poses that you give; the cloth meets them with
        /// the velocity that they have relative to the body. The air moves with the body by the
        /// share that is not felt.
        ///
        /// In a frame, call this before muslin_cloth_move_attachment, muslin_cloth_move_collider
        /// and muslin_cloth_set_anchors.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE if `position` is not finite, `rotation` is not a unit
        /// quaternion, `inertia` is not from 0 to 1, or a moved value would not be finite; the
        /// cloth is unchanged then
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_move_frame(
            MuslinCloth cloth,
            MuslinVec3 position,
            MuslinQuat rotation,
            float inertia);

        /// <summary>
        /// Places a collider at a new pose at once, without a sweep and without dragging the cloth
        /// along.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_HANDLE if it was removed; MUSLIN_STATUS_BAD_VALUE if `position` is not
        /// finite or `rotation` is not a unit quaternion
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_teleport_collider(
            MuslinCloth cloth,
            MuslinCollider collider,
            MuslinVec3 position,
            MuslinQuat rotation);

        /// <summary>
        /// Returns all lists that a renderer needs, without a copy; MuslinView says how long they
        /// stay valid.
        ///
        /// Normals are computed if positions changed since they were last read. Initialise
        /// `out_view` with muslin_view_init.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_view(
            MuslinCloth cloth,
            MuslinView* out_view);

        /// <summary>
        /// Returns the origin of the cloth [m]: the point that it is simulated relative to, a whole
        /// number of metres along each axis.
        ///
        /// It is zero while most of the cloth stays within 16 m of zero along each axis. Beyond, it
        /// follows the cloth, so that positions far from zero are as exact as near it. All
        /// positions that you pass or read are absolute, except for those that
        /// muslin_cloth_write_vertices writes with `relative`. Only ticks and calls that place
        /// particles move the origin.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_origin(
            MuslinCloth cloth,
            MuslinVec3* out_origin);

        /// <summary>
        /// Returns the vertex and index ranges that changed after the view's `topology_revision`
        /// was `since_topology_revision`: what a renderer must upload again, besides positions and
        /// normals.
        ///
        /// Returns everything if that revision is more than 64 changes old or never existed; pass 0
        /// for the first upload. Initialise `out_changes` with muslin_changes_init.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_changes(
            MuslinCloth cloth,
            uint since_topology_revision,
            MuslinChanges* out_changes);

        /// <summary>
        /// Returns what was repaired in the mesh that the cloth was made from. A grid needs no
        /// repair. Initialise `out_report` with muslin_mesh_report_init.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_mesh_report(
            MuslinCloth cloth,
            MuslinMeshReport* out_report);

        /// <summary>
        /// Writes a sentence for each property of the mesh that its author should know of: what was
        /// removed or split, and what makes the cloth slow or uneven. The text has one sentence per
        /// line and ends with a zero byte; it is empty for a good mesh. It is written to `size`
        /// bytes at `buffer`; `out_needed` receives the number of bytes, with the zero byte.
        ///
        /// If `buffer` is NULL, only that number is returned; otherwise `out_needed` may be NULL.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BUFFER_TOO_SMALL if the text does not fit: nothing is written, and
        /// muslin_last_error() states the required size
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_mesh_warnings(
            MuslinCloth cloth,
            byte* buffer,
            UIntPtr size,
            UIntPtr* out_needed);

        /// <summary>
        /// Returns statistics of the current state, computed in time proportional to the size of
        /// the cloth. Initialise `out_stats` with muslin_stats_init.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_get_stats(
            MuslinCloth cloth,
            MuslinStats* out_stats);

        /// <summary>
        /// Returns a hash of all state that the next tick depends on. Equal calls give equal hashes
        /// on every platform.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_state_hash(
            MuslinCloth cloth,
            ulong* out_hash);

        /// <summary>
        /// Writes vertices into your own buffers, each attribute with the format, address and
        /// stride of its stream: separate, interleaved or one after the other. Other bytes are
        /// untouched.
        ///
        /// Buffers for the view's `vertex_capacity` vertices are always large enough. With `desc`
        /// NULL all vertices are written, untransformed.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BUFFER_TOO_SMALL if the vertices do not fit the `size` of a stream;
        /// MUSLIN_STATUS_BAD_VALUE if `stream_count` is not from 1 to MUSLIN_MAX_STREAMS, a field
        /// of a stream or of `desc` is invalid, a format cannot write its attribute, two streams
        /// overlap, a buffer is memory of a view, or normals or tangents are written with a
        /// transform that cannot be inverted; the buffers are untouched then
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_write_vertices(
            MuslinCloth cloth,
            MuslinStream* streams,
            uint stream_count,
            MuslinWriteDesc* desc);

        /// <summary>
        /// Writes the indices of all triangles to the start of `buffer`, which has `size` bytes.
        ///
        /// `index_format` is the width of an index in bits, 16 or 32. `base_vertex` is added to
        /// each index. With `flip` 1 the winding of every triangle is reversed. A buffer for the
        /// view's `index_capacity` indices is always large enough.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BUFFER_TOO_SMALL if `size` is less than the view's `index_count` indices
        /// need; MUSLIN_STATUS_BAD_VALUE if `index_format` or `flip` has another value, or an index
        /// would be above 65534 in 16 bits or 4294967294 in 32 bits; `buffer` is untouched then
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_write_indices(
            MuslinCloth cloth,
            void* buffer,
            UIntPtr size,
            uint index_format,
            uint flip,
            uint base_vertex);

        /// <summary>
        /// Sews `pair_count` pairs of particles together: draws each pair together at `speed` of
        /// `desc`, and joins it when its distance is zero. `pairs` has two particles per pair.
        ///
        /// Joined particles have one position and one velocity after every tick, and move as one
        /// particle with the mass of both.
        ///
        /// - Particles may be in several pairs, as where three panels meet.
        /// - Pairs do not collide with each other. A held particle draws the other one to it.
        /// - Two held particles stay where they are; `over_stretched` of MuslinStats counts the
        ///   pair and MUSLIN_EVENT_HELD_APART reports it.
        /// - Particles, vertices and triangles stay as they are. A weld is invisible, since normals
        ///   are smooth across it.
        /// - A stitch that tears gives MUSLIN_EVENT_STITCH_TORN.
        /// - muslin_cloth_reset keeps the pairs and draws them together again from the rest shape.
        ///
        /// With `pair_count` 0, `pairs` may be NULL. With `desc` NULL the defaults apply.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE if two particles of a pair are equal, do not exist or have no
        /// triangle, if `pair_count` exceeds the number of particles, or for an invalid field of
        /// `desc`
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_sew(
            MuslinCloth cloth,
            uint* pairs,
            uint pair_count,
            MuslinSewDesc* desc);

        /// <summary>
        /// Binds a render mesh, usually finer than the cloth, to the cloth as it is now; its lists
        /// are copied. Destroy it with muslin_skin_destroy; it also ends with its cloth.
        ///
        /// Each vertex is bound to the nearest point of the cloth, at its distance from it, and
        /// moves along with the cloth on a surface that is curved over each triangle
        /// (`smoothness`). Make the skin while the cloth has the shape that the mesh was modelled
        /// in, usually before the first tick: on a folded cloth the nearest layer may be another
        /// one.
        ///
        /// A triangle of the skin that a tear or cut would stretch goes with one side, that of its
        /// center. Its corners on the other side are copied, so the number of vertices may grow;
        /// the number of indices never changes. muslin_cloth_reset restores the given mesh.
        /// muslin_cloth_save contains no skins.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX for an invalid field of `desc`, also
        /// if a vertex is too far from the cloth; MUSLIN_STATUS_UNSUPPORTED if `desc` is of a newer
        /// version and uses fields that this library does not have
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_skin_create(
            MuslinCloth cloth,
            MuslinSkinDesc* desc,
            MuslinSkin* out_skin);

        /// <summary>
        /// Writes vertices of a skin into your own buffers, as muslin_cloth_write_vertices does.
        ///
        /// Follows tears and cuts first, so call muslin_skin_view for the number of vertices and
        /// `topology_revision` before. Buffers for the view's `vertex_capacity` vertices are always
        /// large enough. With `desc` NULL all vertices are written, untransformed.
        /// </summary>
        /// <returns>
        /// the statuses of muslin_cloth_write_vertices; the buffers are untouched then
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_skin_write_vertices(
            MuslinSkin skin,
            MuslinStream* streams,
            uint stream_count,
            MuslinWriteDesc* desc);

        /// <summary>
        /// Returns the lists of a skin where its cloth is now, without a copy.
        ///
        /// The pointers and the data behind them stay valid until the next call that takes the skin
        /// or that changes or destroys its cloth. `source_vertices` are those of the descriptor:
        /// its vertices keep their numbers, copies that tears and cuts need follow. `frayed` is 1
        /// on edges of the skin that a tear or cut opened. `topology_revision` is that of the skin:
        /// it changes whenever its indices or the number of its vertices do. `particles` is NULL.
        /// Initialise `out_view` with muslin_view_init.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_skin_view(MuslinSkin skin, MuslinView* out_view);

        /// <summary>
        /// Destroys a skin. Its handle becomes stale; memory borrowed from it must no longer be
        /// read.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_skin_destroy(MuslinSkin skin);

        /// <summary>
        /// Writes the complete state of a cloth to `size` bytes at `buffer`. `out_needed` receives
        /// the number of bytes of the save.
        ///
        /// If `buffer` is NULL, only that number is returned; otherwise `out_needed` may be NULL.
        /// The bytes are the same on every platform. The number is valid until the cloth changes.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BUFFER_TOO_SMALL if the save does not fit: nothing is written, and
        /// muslin_last_error() states the required size
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_save(
            MuslinCloth cloth,
            void* buffer,
            UIntPtr size,
            UIntPtr* out_needed);

        /// <summary>
        /// Makes a cloth from `size` bytes at `buffer` that muslin_cloth_save wrote, perhaps on
        /// another platform. It continues with the same bits.
        ///
        /// Handles of grabs, attachments and colliders are valid for the new cloth too. Untrusted
        /// bytes are safe: they give a valid cloth or an error.
        /// </summary>
        /// <returns>
        /// MUSLIN_STATUS_BAD_SAVE if the bytes are not a save, come from another format version, or
        /// are damaged
        /// </returns>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_cloth_restore(
            void* buffer,
            UIntPtr size,
            MuslinCloth* out_cloth);

        /// <summary>Called by muslin_settings_init with the sizeof of MuslinSettings.</summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_settings_init_sized(
            MuslinSettings* settings,
            uint struct_size);

        /// <summary>Called by muslin_material_init with the sizeof of MuslinMaterial.</summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_material_init_sized(
            MuslinMaterial* material,
            uint struct_size);

        /// <summary>Called by muslin_wind_init with the sizeof of MuslinWind.</summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_wind_init_sized(
            MuslinWind* wind,
            uint struct_size);

        /// <summary>
        /// Called by muslin_collider_desc_init with the sizeof of MuslinColliderDesc.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_collider_desc_init_sized(
            MuslinColliderDesc* desc,
            uint struct_size);

        /// <summary>Called by muslin_stream_init with the sizeof of MuslinStream.</summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_stream_init_sized(
            MuslinStream* stream,
            uint struct_size);

        /// <summary>Called by muslin_write_desc_init with the sizeof of MuslinWriteDesc.</summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_write_desc_init_sized(
            MuslinWriteDesc* desc,
            uint struct_size);

        /// <summary>Called by muslin_sew_desc_init with the sizeof of MuslinSewDesc.</summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_sew_desc_init_sized(
            MuslinSewDesc* desc,
            uint struct_size);

        /// <summary>Called by muslin_skin_desc_init with the sizeof of MuslinSkinDesc.</summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_skin_desc_init_sized(
            MuslinSkinDesc* desc,
            uint struct_size);

        /// <summary>
        /// Called by muslin_grid_desc_init with the sizeof of MuslinGridDesc, MuslinMaterial and
        /// MuslinSettings, all of the same header.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_grid_desc_init_sized(
            MuslinGridDesc* desc,
            uint struct_size,
            uint material_size,
            uint settings_size);

        /// <summary>
        /// Called by muslin_mesh_desc_init with the sizeof of MuslinMeshDesc, MuslinMaterial and
        /// MuslinSettings, all of the same header.
        /// </summary>
        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]
        public static extern MuslinStatus muslin_mesh_desc_init_sized(
            MuslinMeshDesc* desc,
            uint struct_size,
            uint material_size,
            uint settings_size);

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_settings_init(MuslinSettings* settings)
        {
            muslin_settings_init_sized(settings, (uint)sizeof(MuslinSettings));
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_material_init(MuslinMaterial* material)
        {
            muslin_material_init_sized(material, (uint)sizeof(MuslinMaterial));
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_grid_desc_init(MuslinGridDesc* desc)
        {
            muslin_grid_desc_init_sized(
                desc,
                (uint)sizeof(MuslinGridDesc),
                (uint)sizeof(MuslinMaterial),
                (uint)sizeof(MuslinSettings));
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_mesh_desc_init(MuslinMeshDesc* desc)
        {
            muslin_mesh_desc_init_sized(
                desc,
                (uint)sizeof(MuslinMeshDesc),
                (uint)sizeof(MuslinMaterial),
                (uint)sizeof(MuslinSettings));
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_sew_desc_init(MuslinSewDesc* desc)
        {
            muslin_sew_desc_init_sized(desc, (uint)sizeof(MuslinSewDesc));
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_skin_desc_init(MuslinSkinDesc* desc)
        {
            muslin_skin_desc_init_sized(desc, (uint)sizeof(MuslinSkinDesc));
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_wind_init(MuslinWind* wind)
        {
            muslin_wind_init_sized(wind, (uint)sizeof(MuslinWind));
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_collider_desc_init(MuslinColliderDesc* desc)
        {
            muslin_collider_desc_init_sized(desc, (uint)sizeof(MuslinColliderDesc));
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_stream_init(MuslinStream* stream)
        {
            muslin_stream_init_sized(stream, (uint)sizeof(MuslinStream));
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_write_desc_init(MuslinWriteDesc* desc)
        {
            muslin_write_desc_init_sized(desc, (uint)sizeof(MuslinWriteDesc));
        }

        /// <summary>Returns a stream with all of its fields set.</summary>
        public static MuslinStream muslin_stream(
            uint attribute,
            uint format,
            void* buffer,
            uint stride,
            UIntPtr size)
        {
            MuslinStream stream;
            muslin_stream_init(&stream);
            stream.attribute = attribute;
            stream.format = format;
            stream.stride = stride;
            stream.buffer = buffer;
            stream.size = size;
            return stream;
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_view_init(MuslinView* view)
        {
            view->struct_size = (uint)sizeof(MuslinView);
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_mesh_report_init(MuslinMeshReport* report)
        {
            report->struct_size = (uint)sizeof(MuslinMeshReport);
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_changes_init(MuslinChanges* changes)
        {
            changes->struct_size = (uint)sizeof(MuslinChanges);
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_hit_init(MuslinHit* hit)
        {
            hit->struct_size = (uint)sizeof(MuslinHit);
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_event_init(MuslinEvent* @event)
        {
            @event->struct_size = (uint)sizeof(MuslinEvent);
        }

        /// <summary>Initialises a struct: its size and, if it has any, its defaults.</summary>
        public static void muslin_stats_init(MuslinStats* stats)
        {
            stats->struct_size = (uint)sizeof(MuslinStats);
        }
    }
}
