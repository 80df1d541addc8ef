//! Material of a cloth, and presets.

use crate::status::{CallError, Result};
use muslin_core::{Map, Material, Preset};

/// Silk: light and fluid, 100 g/m^2.
pub const MUSLIN_PRESET_SILK: u32 = 0;
/// Cotton shirting, 180 g/m^2.
pub const MUSLIN_PRESET_COTTON: u32 = 1;
/// Denim: heavy twill, 380 g/m^2.
pub const MUSLIN_PRESET_DENIM: u32 = 2;
/// Garment leather, 700 g/m^2.
pub const MUSLIN_PRESET_LEATHER: u32 = 3;
/// Office paper, 80 g/m^2; keeps folds.
pub const MUSLIN_PRESET_PAPER: u32 = 4;
/// Flag nylon of 200 denier, 105 g/m^2.
pub const MUSLIN_PRESET_FLAG_NYLON: u32 = 5;

/// Painted stiffness against stretch and shear. Links without compliance (a stiffness of 0) stay
/// rigid; at scale 0 other links do not resist.
pub const MUSLIN_MAP_STRETCH: u32 = 0;
/// Painted bending rigidity; at scale 0 the cloth is limp. Does not act on a `bend_stiffness` from 1
/// on.
pub const MUSLIN_MAP_BEND: u32 = 1;
/// Painted strength: the strain at which an edge tears, `tear_stretch` - 1. At scale 0 an edge tears
/// as soon as it is stretched at all; a large scale keeps it from tearing.
pub const MUSLIN_MAP_TEAR: u32 = 2;
/// Painted coefficient of friction of contacts with colliders and of surface self-collision.
pub const MUSLIN_MAP_FRICTION: u32 = 3;
/// Painted distance from colliders and between layers in self-collision.
pub const MUSLIN_MAP_THICKNESS: u32 = 4;
/// Painted drag coefficient; lift stays as it is.
pub const MUSLIN_MAP_DRAG: u32 = 5;

/// Material of a cloth, in SI units. Every field may be changed between ticks.
///
/// Initialise it with muslin_material_init; muslin_material_preset then sets the values of a
/// fabric.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinMaterial {
    /// Set by muslin_material_init.
    pub struct_size: u32,
    /// Mass per area [kg/m^2]. Default 0.18 (cotton). Above 0.
    pub density: f32,
    /// Gap that the cloth keeps from anything it touches [m]. Default 0.00035. At least 0. Choose
    /// less than half of the shortest edge.
    pub thickness: f32,
    /// Membrane stiffness along the warp (the columns of a grid) [N/m]. Default 0: as stiff as the
    /// solver reaches. At least 0.
    pub stretch_stiffness_warp: f32,
    /// Membrane stiffness along the weft (the rows of a grid) [N/m]. Default 0: as stiff as the
    /// solver reaches. At least 0.
    pub stretch_stiffness_weft: f32,
    /// Shear stiffness [N/m]. Default 0: the stretch stiffness. At least 0.
    pub shear_stiffness: f32,
    /// Bending rigidity per width [N m]. Default 2.5e-5. At least 0.
    ///
    /// - It is the value that a strip hanging from a clamp shows (BS 3356), independent of mesh
    ///   resolution, tick, substeps and iterations, and of the direction in which the strip is cut:
    ///   exactly on grids, to 1/20 of the bending length on other meshes.
    /// - 0 is limp.
    /// - 1 or more uses links over two cells instead, as rigid as the solver reaches.
    pub bend_stiffness: f32,
    /// Damping of bending [s]. Default 0. At least 0. Bending at some angle per second is resisted
    /// like this angle times `bend_damping`; a few hundredths stop a flutter.
    pub bend_damping: f32,
    /// Damping of stretching [s], in the same way, for links that have a stiffness. Default 0. At
    /// least 0.
    pub stretch_damping: f32,
    /// Coulomb friction coefficient against colliders and between layers. Default 0.4. At least 0.
    pub friction: f32,
    /// Share of the normal velocity that a bounce returns. Default 0. From 0 to 1.
    pub restitution: f32,
    /// Drag coefficient of a triangle perpendicular to the wind. Default 1.2. At least 0.
    pub drag: f32,
    /// Lift coefficient of a triangle oblique to the wind. Default 0. At least 0.
    pub lift: f32,
    /// Ratio of length to rest length at which an edge tears. Default 4. Above 1, or 0: never.
    ///
    /// At a crack tip a smaller strain suffices: sqrt(16 thickness / mean edge) of it, at least
    /// 1/5. On a finer mesh the load is more concentrated there; with this factor, a crack grows at
    /// the same load on any mesh.
    pub tear_stretch: f32,
    /// Variation of the tear limit between edges. Default 0.2. From 0 (all edges alike) to 1 (the
    /// limit varies by half).
    pub tear_variation: f32,
    /// Angle up to which a fold opens again completely [rad]; of a sharper fold, the excess stays.
    /// Default 0: folds never stay. At least 0. Paper has about 0.8.
    pub yield_angle: f32,
    /// Share of the excess over `yield_angle` that stays. Default 1. From 0 to 1.
    pub yield_creep: f32,
    /// Length of cloth over which bending counts as one fold [m]. Default 0.01. At least 0; at
    /// least three cells are used.
    ///
    /// The same angle spread over a greater length is only a bend; a bend stays if its curvature
    /// exceeds `yield_angle` / `fold_length`.
    pub fold_length: f32,
    /// Growth of the yield angle with accumulated yielding (in either direction). Default 0. At
    /// least 0.
    ///
    /// Of a first fold by some angle, (angle - `yield_angle`) / (1 + `yield_hardening`) stays, and
    /// folding it further needs as much more. Yielding and creases are not counted while this and
    /// `yield_weakening` are 0.
    pub yield_hardening: f32,
    /// Loss of bending stiffness with accumulated yielding [1/rad]. Default 0. At least 0.
    ///
    /// After yielding by an angle in total (in either direction), `fold_length` of the cloth bends
    /// as if `bend_stiffness` were divided by 1 + `yield_weakening` * angle, at most by 1000;
    /// pressing the fold flat does not restore it. The moment at which it yields stays the same, so
    /// the fold opens further: `yield_angle` * `yield_weakening` adds to `yield_hardening`.
    pub yield_weakening: f32,
}

impl Default for MuslinMaterial {
    fn default() -> Self {
        Self::from(&Material::default())
    }
}

impl From<&Material> for MuslinMaterial {
    fn from(material: &Material) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            density: material.density,
            thickness: material.thickness,
            stretch_stiffness_warp: material.stretch_stiffness_warp,
            stretch_stiffness_weft: material.stretch_stiffness_weft,
            shear_stiffness: material.shear_stiffness,
            bend_stiffness: material.bend_stiffness,
            bend_damping: material.bend_damping,
            stretch_damping: material.stretch_damping,
            friction: material.friction,
            restitution: material.restitution,
            drag: material.drag,
            lift: material.lift,
            tear_stretch: material.tear_stretch,
            tear_variation: material.tear_variation,
            yield_angle: material.yield_angle,
            yield_creep: material.yield_creep,
            fold_length: material.fold_length,
            yield_hardening: material.yield_hardening,
            yield_weakening: material.yield_weakening,
        }
    }
}

impl From<MuslinMaterial> for Material {
    fn from(material: MuslinMaterial) -> Self {
        Self {
            density: material.density,
            thickness: material.thickness,
            stretch_stiffness_warp: material.stretch_stiffness_warp,
            stretch_stiffness_weft: material.stretch_stiffness_weft,
            shear_stiffness: material.shear_stiffness,
            bend_stiffness: material.bend_stiffness,
            bend_damping: material.bend_damping,
            stretch_damping: material.stretch_damping,
            friction: material.friction,
            restitution: material.restitution,
            drag: material.drag,
            lift: material.lift,
            tear_stretch: material.tear_stretch,
            tear_variation: material.tear_variation,
            yield_angle: material.yield_angle,
            yield_creep: material.yield_creep,
            fold_length: material.fold_length,
            yield_hardening: material.yield_hardening,
            yield_weakening: material.yield_weakening,
        }
    }
}

/// Returns the map that a MUSLIN_MAP_ number names.
pub fn map(number: u32) -> Result<Map> {
    match number {
        MUSLIN_MAP_STRETCH => Ok(Map::Stretch),
        MUSLIN_MAP_BEND => Ok(Map::Bend),
        MUSLIN_MAP_TEAR => Ok(Map::Tear),
        MUSLIN_MAP_FRICTION => Ok(Map::Friction),
        MUSLIN_MAP_THICKNESS => Ok(Map::Thickness),
        MUSLIN_MAP_DRAG => Ok(Map::Drag),
        _ => Err(CallError::bad_value("map", "be a MUSLIN_MAP_ value")),
    }
}

/// Returns the fabric that a MUSLIN_PRESET_ number names.
pub fn preset(number: u32) -> Result<Preset> {
    match number {
        MUSLIN_PRESET_SILK => Ok(Preset::Silk),
        MUSLIN_PRESET_COTTON => Ok(Preset::Cotton),
        MUSLIN_PRESET_DENIM => Ok(Preset::Denim),
        MUSLIN_PRESET_LEATHER => Ok(Preset::Leather),
        MUSLIN_PRESET_PAPER => Ok(Preset::Paper),
        MUSLIN_PRESET_FLAG_NYLON => Ok(Preset::FlagNylon),
        _ => Err(CallError::bad_value("preset", "be one of MUSLIN_PRESET_...")),
    }
}
