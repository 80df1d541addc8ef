//! The node and its properties. Their comments are its documentation in the editor.
//!
//! Reads nothing; `lifecycle` makes and advances the cloth, `methods` has what scripts call.

use crate::choices::{FabricPreset, OF_PRESET, PinMode, SelfCollisionMode, WindMode};
use crate::colliders::Colliders;
use crate::parameters::Parameters;
use crate::preview::Preview;
use crate::surface::Surface;
use godot::builtin::{
    Aabb, Array, GString, NodePath, PackedInt32Array, PackedStringArray, StringName, Vector3,
};
use godot::classes::notify::Node3DNotification;
use godot::classes::{GeometryInstance3D, IGeometryInstance3D, Mesh, MeshInstance3D};
use godot::obj::{Base, Gd};
use godot::register::{GodotClass, godot_api};
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, Grab};

/// A cloth: it hangs, collides, blows in the wind, is grabbed and tears.
///
/// It is made from [member mesh], or without one from a grid that hangs from the node: its top edge
/// is centred along the local x axis. It moves in physics ticks and is drawn as one surface; set
/// [member GeometryInstance3D.material_override] to choose the material. Pinned vertices follow the
/// node. Lengths are in metres of the world: the scale of the node acts when the cloth is made.
///
/// The properties of the groups Shape and Pins act when the cloth is made: when the node becomes
/// ready, and in [method rebuild]. All others act in the next physics tick. A value that breaks a
/// rule is refused with an error that names the property, and the cloth keeps the values it has;
/// see [method get_last_error].
#[derive(GodotClass)]
#[class(init, tool, base = GeometryInstance3D)]
pub struct MuslinCloth3D {
    /// The mesh of the cloth at rest: one surface of triangles, with any texture coordinates. If
    /// it and [member mesh_source] are empty, the cloth is a grid.
    #[export_group(name = "Shape")]
    #[export]
    pub(crate) mesh: Option<Gd<Mesh>>,
    /// The node whose mesh is the cloth at rest, if [member mesh] is empty. The cloth takes its
    /// material and its place, and hides it.
    #[export]
    pub(crate) mesh_source: Option<Gd<MeshInstance3D>>,
    /// Vertices at most this far apart are one particle. 0 joins the vertices that a mesh doubles
    /// along its seams; -1 joins nothing.
    #[export(range = (-1.0, 0.1, 0.0001, or_greater, suffix = "m"))]
    pub(crate) weld_distance: f32,
    /// Edges of a mesh that are shorter than this are collapsed, which removes its slivers. 0
    /// collapses none; at most the mean length of the edges.
    #[export(range = (0.0, 0.1, 0.0001, or_greater, suffix = "m"))]
    pub(crate) simplify_below: f32,
    /// Particles per row of a grid, at least 2.
    #[export(range = (2.0, 200.0, 1.0, or_greater))]
    #[init(val = 40)]
    pub(crate) columns: i64,
    /// Rows of a grid, at least 2.
    #[export(range = (2.0, 200.0, 1.0, or_greater))]
    #[init(val = 40)]
    pub(crate) rows: i64,
    /// Width of a grid, along the local x axis.
    #[export(range = (0.01, 20.0, 0.001, or_greater, suffix = "m"))]
    #[init(val = 2.0)]
    pub(crate) width: f32,
    /// Height of a grid, down from the node.
    #[export(range = (0.01, 20.0, 0.001, or_greater, suffix = "m"))]
    #[init(val = 2.0)]
    pub(crate) height: f32,
    /// Particles to reserve for tears and cuts. -1 reserves as many again as the cloth starts with.
    #[export(range = (-1.0, 10000.0, 1.0, or_greater))]
    #[init(val = -1)]
    pub(crate) extra_particles: i64,

    /// Which vertices follow the node. The edges and corners are those of a grid. Vertex Color pins
    /// vertices of [member mesh] with a red of 0.5 or more, Vertices those of [member
    /// pin_vertices].
    #[export_group(name = "Pins")]
    #[export]
    pub(crate) pin_mode: PinMode,
    /// The vertices that [member pin_mode] pins if it is Vertices. In a grid, a vertex is [code]row
    /// * columns + column[/code], from the top left.
    #[export]
    pub(crate) pin_vertices: PackedInt32Array,
    /// Share of the motion of the node that the cloth feels: 1 all of it, 0 none, as if the world
    /// moved instead.
    #[export(range = (0.0, 1.0, 0.01))]
    #[init(val = 1.0)]
    pub(crate) inertia: f32,

    /// The fabric whose values a property of this group has while it is -1.
    #[export_group(name = "Material")]
    #[export]
    pub(crate) preset: FabricPreset,
    /// Mass per area, above 0. -1: that of the preset.
    #[export(range = (-1.0, 2.0, 0.001, or_greater, suffix = "kg/m²"))]
    #[init(val = OF_PRESET)]
    pub(crate) density: f32,
    /// Gap to colliders, and between layers in surface self-collision. -1: that of the preset.
    #[export(range = (-1.0, 0.02, 0.00001, or_greater, suffix = "m"))]
    #[init(val = OF_PRESET)]
    pub(crate) thickness: f32,
    /// Stretch stiffness along the columns of a grid, per width; 0: as stiff as the iterations
    /// allow. -1: that of the preset.
    #[export(range = (-1.0, 100000.0, 0.1, or_greater, suffix = "N/m"))]
    #[init(val = OF_PRESET)]
    pub(crate) stretch_stiffness_warp: f32,
    /// Stretch stiffness along the rows of a grid, per width; 0: as stiff as the iterations allow.
    /// -1: that of the preset.
    #[export(range = (-1.0, 100000.0, 0.1, or_greater, suffix = "N/m"))]
    #[init(val = OF_PRESET)]
    pub(crate) stretch_stiffness_weft: f32,
    /// Shear stiffness per width; 0: the mean of the stretch stiffnesses. -1: that of the preset.
    #[export(range = (-1.0, 100000.0, 0.1, or_greater, suffix = "N/m"))]
    #[init(val = OF_PRESET)]
    pub(crate) shear_stiffness: f32,
    /// Bending rigidity per width, as a cantilever test of a strip shows it; 0: no resistance. -1:
    /// that of the preset.
    #[export(range = (-1.0, 0.1, 0.0000001, or_greater, suffix = "N·m"))]
    #[init(val = OF_PRESET)]
    pub(crate) bend_stiffness: f32,
    /// Damping of bending, as a time. A few hundredths calm flutter. -1: that of the preset.
    #[export(range = (-1.0, 1.0, 0.001, or_greater, suffix = "s"))]
    #[init(val = OF_PRESET)]
    pub(crate) bend_damping: f32,
    /// Damping of stretching, as a time. -1: that of the preset.
    #[export(range = (-1.0, 1.0, 0.001, or_greater, suffix = "s"))]
    #[init(val = OF_PRESET)]
    pub(crate) stretch_damping: f32,
    /// Coefficient of Coulomb friction, with colliders and with itself. -1: that of the preset.
    #[export(range = (-1.0, 2.0, 0.01, or_greater))]
    #[init(val = OF_PRESET)]
    pub(crate) friction: f32,
    /// Share of the normal speed that remains after a bounce off a collider, 0 to 1. -1: that of
    /// the preset.
    #[export(range = (-1.0, 1.0, 0.01))]
    #[init(val = OF_PRESET)]
    pub(crate) restitution: f32,
    /// Drag coefficient of a triangle perpendicular to the wind. -1: that of the preset.
    #[export(range = (-1.0, 5.0, 0.01, or_greater))]
    #[init(val = OF_PRESET)]
    pub(crate) drag: f32,
    /// Lift coefficient of a triangle oblique to the wind. -1: that of the preset.
    #[export(range = (-1.0, 5.0, 0.01, or_greater))]
    #[init(val = OF_PRESET)]
    pub(crate) lift: f32,
    /// Ratio of length to rest length at which an edge tears, above 1, or 0: never. Acts while
    /// [member tearing] is on. -1: that of the preset.
    #[export(range = (-1.0, 10.0, 0.01, or_greater))]
    #[init(val = OF_PRESET)]
    pub(crate) tear_stretch: f32,
    /// Variation of the tear limit between edges, 0 to 1. -1: that of the preset.
    #[export(range = (-1.0, 1.0, 0.01))]
    #[init(val = OF_PRESET)]
    pub(crate) tear_variation: f32,
    /// Angle beyond which a fold stays; 0: fully elastic. -1: that of the preset.
    #[export(range = (-1.0, 3.2, 0.01, or_greater, suffix = "rad"))]
    #[init(val = OF_PRESET)]
    pub(crate) yield_angle: f32,
    /// Share of a fold beyond [member yield_angle] that stays, 0 to 1. -1: that of the preset.
    #[export(range = (-1.0, 1.0, 0.01))]
    #[init(val = OF_PRESET)]
    pub(crate) yield_creep: f32,
    /// Length of sheet across a fold within which its angle is measured. -1: that of the preset.
    #[export(range = (-1.0, 0.1, 0.001, or_greater, suffix = "m"))]
    #[init(val = OF_PRESET)]
    pub(crate) fold_length: f32,
    /// Growth of the yield angle per radian of accumulated plastic angle. -1: that of the preset.
    #[export(range = (-1.0, 10.0, 0.01, or_greater))]
    #[init(val = OF_PRESET)]
    pub(crate) yield_hardening: f32,
    /// Weakening of folds. -1: that of the preset.
    #[export(range = (-1.0, 10.0, 0.01, or_greater, suffix = "1/rad"))]
    #[init(val = OF_PRESET)]
    pub(crate) yield_weakening: f32,

    /// Least number of substeps per physics tick, 1 to 1000. More make the cloth stiffer.
    #[export_group(name = "Settings")]
    #[export(range = (1.0, 32.0, 1.0, or_greater))]
    #[init(val = 4)]
    pub(crate) substeps: i64,
    /// Sweeps over the links per substep, 1 to 1000. One sweep damps all motion.
    #[export(range = (1.0, 32.0, 1.0, or_greater))]
    #[init(val = 2)]
    pub(crate) iterations: i64,
    /// Acceleration of gravity.
    #[export(range = (-20.0, 20.0, 0.01, or_less, or_greater, suffix = "m/s²"))]
    #[init(val = Vector3::new(0.0, -9.81, 0.0))]
    pub(crate) gravity: Vector3,
    /// Decay rate of the velocity.
    #[export(range = (0.0, 10.0, 0.01, or_greater, suffix = "1/s"))]
    #[init(val = 0.5)]
    pub(crate) damping: f32,
    /// Maximum displacement of a particle per substep, in mean rest lengths. It also limits the
    /// speed of a grabbed particle.
    #[export(range = (0.01, 2.0, 0.01, or_greater))]
    #[init(val = 0.5)]
    pub(crate) max_displacement: f32,
    /// Maximum relative elongation of a link after a tick: 0.02 is 2 %. 0: no limit.
    #[export(range = (0.0, 1.0, 0.001, or_greater))]
    pub(crate) max_stretch: f32,
    /// Limits the distance of each particle to the pins.
    #[export]
    #[init(val = true)]
    pub(crate) tethers: bool,
    /// How the cloth collides with itself: not at all, by its surface, or by particles, which is
    /// cheap and lets folds slip through.
    #[export]
    pub(crate) self_collision: SelfCollisionMode,
    /// Gap of self-collision. 0: automatic.
    #[export(range = (0.0, 0.1, 0.0001, or_greater, suffix = "m"))]
    pub(crate) self_distance: f32,
    /// Whether overstretched edges tear, see [member tear_stretch].
    #[export]
    pub(crate) tearing: bool,
    /// Maximum number of vertices that tearing splits in one tick, at least 1.
    #[export(range = (1.0, 64.0, 1.0, or_greater))]
    #[init(val = 8)]
    pub(crate) max_tears_per_tick: i64,
    /// Speed below which the cloth may sleep. 0: it never sleeps.
    #[export(range = (0.0, 1.0, 0.001, or_greater, suffix = "m/s"))]
    pub(crate) sleep_speed: f32,
    /// Over-pressure inside closed pieces of the cloth, such as a ball.
    #[export(range = (-1000.0, 1000.0, 0.1, or_less, or_greater, suffix = "Pa"))]
    pub(crate) pressure: f32,

    /// How the wind acts: by aerodynamic pressure on each triangle, or as an acceleration by a
    /// field of sine waves.
    #[export_group(name = "Wind", prefix = "wind_")]
    #[export]
    pub(crate) wind_model: WindMode,
    /// Mean velocity of the air.
    #[export(range = (-30.0, 30.0, 0.01, or_less, or_greater, suffix = "m/s"))]
    pub(crate) wind_velocity: Vector3,
    /// Amplitude of gusts, as a share of the speed, 0 to 1.
    #[export(range = (0.0, 1.0, 0.01))]
    pub(crate) wind_gust: f32,
    /// Amplitude of changes of direction, 0 to pi.
    #[export(range = (0.0, std::f64::consts::PI, 0.01, suffix = "rad"))]
    pub(crate) wind_wander: f32,
    /// Amplitude of turbulence in space, as a share of the speed, 0 to 1.
    #[export(range = (0.0, 1.0, 0.01))]
    pub(crate) wind_turbulence: f32,
    /// Density of the air; 0: vacuum.
    #[export(range = (0.0, 5.0, 0.01, or_greater, suffix = "kg/m³"))]
    #[init(val = 1.2)]
    pub(crate) wind_air_density: f32,
    /// Selects the sequence of gusts and turbulence.
    #[export]
    pub(crate) wind_seed: i64,

    /// Nodes of this group are colliders: a [CollisionShape3D], or a node with some below it, such
    /// as a [StaticBody3D]. Collision shapes below the cloth are colliders too. All of them are
    /// followed in each physics tick. After a node joined or left the group, call [method
    /// refresh_colliders].
    #[export_group(name = "Colliders", prefix = "collider_")]
    #[export]
    #[init(val = StringName::from("muslin_colliders"))]
    pub(crate) collider_group: StringName,
    /// More colliders, by their paths from this node.
    #[export]
    pub(crate) collider_nodes: Array<NodePath>,
    /// Friction of colliders whose body has no physics material. -1: that of the cloth.
    #[export(range = (-1.0, 2.0, 0.01, or_greater))]
    #[init(val = -1.0)]
    pub(crate) collider_friction: f32,
    /// Gap between colliders and the cloth. -1: the thickness of the cloth.
    #[export(range = (-1.0, 0.1, 0.0001, or_greater, suffix = "m"))]
    #[init(val = -1.0)]
    pub(crate) collider_gap: f32,

    /// Whether the drawn surface has tangents, which a material with a normal map needs.
    #[export_group(name = "Drawing")]
    #[export]
    pub(crate) tangents: bool,

    /// The cloth; none before the node is ready, and if the properties give none.
    pub(crate) cloth: Option<Cloth>,
    /// The parameters that the cloth was given last, also if it refused them.
    pub(crate) applied: Option<Parameters>,
    pub(crate) colliders: Colliders,
    pub(crate) surface: Surface,
    /// Pose of the node when the cloth was made.
    pub(crate) made_at: (Vec3, Quat),
    pub(crate) grabs: Vec<Grab>,
    /// The last refusal.
    pub(crate) last_error: String,
    /// The refusal of the last tick, which is not reported again.
    pub(crate) tick_error: String,
    /// What the picture in the editor was made from.
    pub(crate) preview: Option<Preview>,
    pub(crate) base: Base<GeometryInstance3D>,
}

#[godot_api]
impl IGeometryInstance3D for MuslinCloth3D {
    fn on_notification(&mut self, what: Node3DNotification) {
        match what {
            Node3DNotification::READY => self.start(),
            Node3DNotification::INTERNAL_PHYSICS_PROCESS => self.tick(),
            Node3DNotification::INTERNAL_PROCESS => self.frame(),
            _ => {}
        }
    }

    fn get_configuration_warnings(&self) -> PackedStringArray {
        let warnings = Some(&self.last_error).filter(|error| !error.is_empty());
        warnings.into_iter().map(GString::from).collect()
    }

    fn get_aabb(&self) -> Aabb {
        self.surface.bounds()
    }
}

#[godot_api]
impl MuslinCloth3D {
    /// No vertex is pinned.
    #[constant]
    pub const PIN_NONE: i64 = 0;
    /// The first row of a grid is pinned.
    #[constant]
    pub const PIN_TOP_EDGE: i64 = 1;
    /// The two ends of the first row of a grid are pinned.
    #[constant]
    pub const PIN_TOP_CORNERS: i64 = 2;
    /// The four corners of a grid are pinned.
    #[constant]
    pub const PIN_CORNERS: i64 = 3;
    /// The first column of a grid is pinned.
    #[constant]
    pub const PIN_LEFT_EDGE: i64 = 4;
    /// Vertices of [member mesh] with a red of 0.5 or more are pinned.
    #[constant]
    pub const PIN_VERTEX_COLOR: i64 = 5;
    /// The vertices of [member pin_vertices] are pinned.
    #[constant]
    pub const PIN_VERTICES: i64 = 6;
    /// Silk: light and fluid, 0.1 kg/m².
    #[constant]
    pub const PRESET_SILK: i64 = 0;
    /// Cotton shirting, 0.18 kg/m².
    #[constant]
    pub const PRESET_COTTON: i64 = 1;
    /// Denim: heavy twill, 0.38 kg/m².
    #[constant]
    pub const PRESET_DENIM: i64 = 2;
    /// Garment leather, 0.7 kg/m².
    #[constant]
    pub const PRESET_LEATHER: i64 = 3;
    /// Office paper, 0.08 kg/m²; keeps folds.
    #[constant]
    pub const PRESET_PAPER: i64 = 4;
    /// Flag nylon, 0.105 kg/m².
    #[constant]
    pub const PRESET_FLAG_NYLON: i64 = 5;
    /// Layers pass through each other.
    #[constant]
    pub const SELF_COLLISION_NONE: i64 = 0;
    /// Triangles keep a gap and never cross, with friction.
    #[constant]
    pub const SELF_COLLISION_SURFACE: i64 = 1;
    /// Particles collide as spheres: cheap, without friction; folds may slip through.
    #[constant]
    pub const SELF_COLLISION_PARTICLES: i64 = 2;
    /// Aerodynamic pressure on each triangle.
    #[constant]
    pub const WIND_SURFACE: i64 = 0;
    /// An acceleration by a field of sine waves, whose strength in m/s² is the length of [member
    /// wind_velocity].
    #[constant]
    pub const WIND_SINE_FIELD: i64 = 1;

    /// An edge between two particles tore at a position of the world. At most [member
    /// max_tears_per_tick] in a tick.
    #[signal]
    pub fn torn(position: Vector3, particle_a: i64, particle_b: i64);

    /// A piece of the cloth came off: a position on it in the world, and its number of triangles.
    #[signal]
    pub fn piece_detached(position: Vector3, triangles: i64);
}
