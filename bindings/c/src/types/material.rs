//! What a cloth is made of.

use crate::status::{CallError, Result};
use muslin_core::{Material, Preset};

/// Light and fluid, 100 g/m^2.
pub const MUSLIN_PRESET_SILK: u32 = 0;
/// Shirting, 180 g/m^2.
pub const MUSLIN_PRESET_COTTON: u32 = 1;
/// Heavy twill, 380 g/m^2.
pub const MUSLIN_PRESET_DENIM: u32 = 2;
/// Garment leather, 700 g/m^2.
pub const MUSLIN_PRESET_LEATHER: u32 = 3;
/// Office paper, 80 g/m^2.
pub const MUSLIN_PRESET_PAPER: u32 = 4;
/// Flag nylon 200 denier, 105 g/m^2.
pub const MUSLIN_PRESET_FLAG_NYLON: u32 = 5;

/// What a cloth is made of, in SI units. All of it may change between ticks.
///
/// Begin with muslin_material_init, or go on from there with muslin_material_preset, and change what
/// you need.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinMaterial {
    /// Set by muslin_material_init.
    pub struct_size: u32,
    /// Mass per area [kg/m^2]; 0.18, a cotton. Above 0.
    pub density: f32,
    /// Gap kept from anything touched [m]; 0.00035. Keep it below half the shortest edge.
    pub thickness: f32,
    /// Membrane stiffness along the warp (down a grid) [N/m]; 0 is as stiff as the sweeps allow.
    pub stretch_stiffness_warp: f32,
    /// Membrane stiffness along the weft (across a grid) [N/m]; 0 is as stiff as the sweeps allow.
    pub stretch_stiffness_weft: f32,
    /// Stiffness against shear [N/m]; 0 is as the stretch stiffness.
    pub shear_stiffness: f32,
    /// Bending rigidity per width [N m]; 2.5e-5: what a strip that hangs from a clamp shows (BS 3356), however
    /// fine the mesh, the tick and the sweeps are, whichever way it is cut: exactly on grids, within a twentieth
    /// of its bending length on other meshes. 0 is limp; 1 or more is links over two cells instead, as rigid as the sweeps allow.
    pub bend_stiffness: f32,
    /// Damping of bending [s]; 0. Bending by some angle a second is resisted as that angle times this would be;
    /// a few hundredths calm a flutter. At least 0.
    pub bend_damping: f32,
    /// Damping of stretching [s]; 0. In the same way, for links that give way. At least 0.
    pub stretch_damping: f32,
    /// Coulomb coefficient against colliders; 0.4. At least 0.
    pub friction: f32,
    /// Share of the normal speed that a bounce gives back; 0. From 0 to 1.
    pub restitution: f32,
    /// Pressure coefficient of a triangle square to the wind; 1.2. At least 0.
    pub drag: f32,
    /// Lift coefficient of a triangle askew to the wind; 0. At least 0.
    pub lift: f32,
    /// Length over rest length at which an edge tears; 4. Above 1, or 0: never. At the end of a slit it takes
    /// less, as the finer the mesh is the more of the load is there: sqrt(16 thickness / mean edge) of
    /// the strain, at least a fifth of it; so a notch runs on at the same load whatever the mesh.
    pub tear_stretch: f32,
    /// How uneven the weave is: 0 tears all edges alike, 1 varies the limit by half; 0.2.
    pub tear_variation: f32,
    /// Angle up to which a fold opens again [rad]; of one that was folded further, the rest stays. 0: all
    /// opens. At least 0. Paper is near 0.8.
    pub yield_angle: f32,
    /// Share of a fold beyond `yield_angle` that stays; 1. From 0 to 1.
    pub yield_creep: f32,
    /// Length of the sheet over which folding counts as one fold [m]; 0.01. The same angle over more than that is
    /// only bent, and stays bent beyond a curvature of `yield_angle` over this. Three cells count at least.
    /// At least 0.
    pub fold_length: f32,
    /// How much more a fold opens again, for each angle that it has given way by in all, to either side; 0. Of
    /// one that is folded by an angle for the first time (angle - `yield_angle`) / (1 + this) stays, and to fold it
    /// on takes as much more. At least 0. What gives way or is creased while this and `yield_weakening` are 0 is
    /// not counted.
    pub yield_hardening: f32,
    /// How much weaker a fold gets by giving way [1/rad]; 0. Where it has given way by an angle in all, to either
    /// side, `fold_length` of the sheet bends as if `bend_stiffness` were divided by 1 + this times angle, by at
    /// most a thousand; pressed flat, it stays as weak. It gives way under the same moment as before, so that it
    /// opens again by more: `yield_angle` times this counts as `yield_hardening` too. At least 0.
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

/// The fabric that a MUSLIN_PRESET_ number names.
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
