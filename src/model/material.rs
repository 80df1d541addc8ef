//! Material of a cloth in SI units, and presets for common fabrics.

use crate::error::{Result, check};
use serde::{Deserialize, Serialize};

/// What a cloth is made of, in SI units. Start from a [`Preset`] and change what you need; all
/// values may change while the cloth moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Material {
    /// Mass per area [kg/m²], above 0. Default: 0.18, cotton.
    pub density: f32,
    /// Thickness [m]: gap to colliders, and between layers in surface self-collision. At least 0.
    /// Default: 0.00035. Keep it below half of the shortest edge.
    pub thickness: f32,
    /// Stretch stiffness along the warp (the columns of a grid) per width [N/m], at least 0; 0 = as
    /// stiff as the iterations allow. Default: 0.
    pub stretch_stiffness_warp: f32,
    /// Stretch stiffness along the weft (the rows of a grid) per width [N/m], at least 0; 0 = as
    /// stiff as the iterations allow. Default: 0.
    pub stretch_stiffness_weft: f32,
    /// Shear stiffness per width [N/m], at least 0; 0 = mean of the stretch stiffnesses. Default:
    /// 0.
    pub shear_stiffness: f32,
    /// Bending rigidity per width [N·m], at least 0; 0 = no resistance. Default: 2.5e-5.
    ///
    /// It is the rigidity that a cantilever test of a strip shows (BS 3356), independent of mesh
    /// size, tick, iterations and direction: exactly on grids, within 5 % of the bending length on
    /// other meshes. Values from 1 on use distance constraints over two cells instead, as stiff as
    /// the iterations allow.
    pub bend_stiffness: f32,
    /// Damping of bending, as a time τ [s], at least 0: a bending rate ω is resisted like a bend by
    /// τ·ω. A few hundredths calm flutter. Default: 0.
    pub bend_damping: f32,
    /// Damping of stretching, as a time τ [s], at least 0: an elongation rate is resisted like an
    /// elongation of τ times that rate. Acts only on links with finite stiffness. Default: 0.
    pub stretch_damping: f32,
    /// Coefficient of Coulomb friction, with colliders and with itself, at least 0. Default: 0.4.
    pub friction: f32,
    /// Share of the normal speed that remains after a bounce off a collider, 0 to 1. Default: 0.
    pub restitution: f32,
    /// Drag coefficient of a triangle perpendicular to the wind, at least 0. Default: 1.2.
    pub drag: f32,
    /// Lift coefficient of a triangle oblique to the wind, at least 0. Default: 0.
    pub lift: f32,
    /// Stretch ratio (length / rest length) at which an edge tears: above 1, or 0 = never. Default:
    /// 4. Acts while [`Settings::tearing`](crate::Settings) is on.
    ///
    /// At the tip of a tear or cut, the strain at which an edge tears is smaller by the factor √(16
    /// · `thickness` / mean edge length), at least 0.2 and at most 1, so that a notch grows under
    /// the same load whatever the mesh size.
    pub tear_stretch: f32,
    /// Variation of the tear limit between edges, 0 to 1: 0 = all equal, 1 = each between 0.5 and
    /// 1.5 times. Default: 0.2.
    pub tear_variation: f32,
    /// Yield angle of a fold [rad], at least 0; 0 = fully elastic. A fold up to this angle opens
    /// again; of a larger fold the part beyond it remains. Paper: about 0.8. Default: 0.
    pub yield_angle: f32,
    /// Share of a fold beyond `yield_angle` that remains, 0 to 1. Default: 1.
    pub yield_creep: f32,
    /// Length of sheet across a fold, within which its angle is measured [m], at least 0; at least
    /// three cells are used. Default: 0.01. An angle spread over a longer length is elastic up to a
    /// curvature of `yield_angle / fold_length`.
    pub fold_length: f32,
    /// Hardening: growth of the yield angle per radian of accumulated plastic angle (both
    /// directions add up), at least 0. Default: 0.
    ///
    /// A first fold by φ leaves (φ − `yield_angle`) / (1 + `yield_hardening`). Plastic angles
    /// accumulate only while this or `yield_weakening` is above 0.
    pub yield_hardening: f32,
    /// Weakening of folds [1/rad], at least 0. Default: 0.
    ///
    /// After an accumulated plastic angle A, `fold_length` of sheet bends as if `bend_stiffness`
    /// were divided by 1 + `yield_weakening` · A (at most 1000); pressing it flat does not restore
    /// it. The yield moment stays the same, so the weaker fold springs back further: `yield_angle`
    /// · `yield_weakening` adds to `yield_hardening`.
    pub yield_weakening: f32,
}

/// Presets for common fabrics.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum Preset {
    /// Silk: light and fluid, 100 g/m².
    Silk = 0,
    /// Cotton shirting, 180 g/m².
    Cotton = 1,
    /// Denim: heavy twill, 380 g/m².
    Denim = 2,
    /// Garment leather, 700 g/m².
    Leather = 3,
    /// Office paper, 80 g/m²; keeps folds.
    Paper = 4,
    /// Flag nylon, 200 denier, 105 g/m².
    FlagNylon = 5,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            density: 0.18,
            thickness: 0.00035,
            stretch_stiffness_warp: 0.0,
            stretch_stiffness_weft: 0.0,
            shear_stiffness: 0.0,
            bend_stiffness: 2.5e-5,
            bend_damping: 0.0,
            stretch_damping: 0.0,
            friction: 0.4,
            restitution: 0.0,
            drag: 1.2,
            lift: 0.0,
            tear_stretch: 4.0,
            tear_variation: 0.2,
            yield_angle: 0.0,
            yield_creep: 1.0,
            fold_length: 0.01,
            yield_hardening: 0.0,
            yield_weakening: 0.0,
        }
    }
}

impl Material {
    /// Returns the material of a preset.
    ///
    /// Sources of densities and bending rigidities. Silk and leather: Chaos cloth tables and KES
    /// ranges; silk at the soft end of its range, where it drapes like measured silks (20 to 40 %).
    /// Cotton: between Wang et al. 2011 and KES. Denim: Wang et al. 2011 ("11oz black denim").
    /// Paper: ARCSim and srep06275. Flag nylon: estimated from vendors' weights. Only paper keeps
    /// folds: 0.8 rad over 0.01 m is a curvature of 80 1/m; ARCSim's paper yields at 200 1/m over a
    /// shorter length.
    pub fn preset(preset: Preset) -> Self {
        let yield_angle = if preset == Preset::Paper { 0.8 } else { 0.0 };
        let (density, thickness, stretch, shear, bend, friction) = match preset {
            Preset::Silk => (0.10, 0.15e-3, 2.0e3, 30.0, 3.0e-6, 0.25),
            Preset::Cotton => (0.18, 0.35e-3, 2.0e3, 50.0, 2.5e-5, 0.4),
            Preset::Denim => (0.38, 0.8e-3, 2.0e3, 100.0, 1.0e-4, 0.5),
            Preset::Leather => (0.70, 1.0e-3, 3.0e4, 1.0e4, 2.5e-3, 0.6),
            Preset::Paper => (0.08, 0.10e-3, 4.0e5, 1.5e5, 4.0e-4, 0.35),
            Preset::FlagNylon => (0.105, 0.2e-3, 5.0e3, 50.0, 2.0e-5, 0.3),
        };
        Self {
            density,
            thickness,
            stretch_stiffness_warp: stretch,
            stretch_stiffness_weft: stretch,
            shear_stiffness: shear,
            bend_stiffness: bend,
            friction,
            yield_angle,
            ..Self::default()
        }
    }

    /// Returns whether accumulated plastic angles have an effect.
    pub(crate) fn tracks_hardening(&self) -> bool {
        self.yield_hardening > 0.0 || self.yield_weakening > 0.0
    }

    /// Growth of the yield angle per radian of accumulated plastic angle, including that from
    /// weakening.
    pub(crate) fn effective_hardening(&self) -> f32 {
        self.yield_hardening + self.yield_weakening * self.yield_angle
    }

    /// Refuses values that are out of range.
    pub(crate) fn check(&self) -> Result<()> {
        let not_negative = |v: f32| v.is_finite() && v >= 0.0;
        let share = |v: f32| (0.0..=1.0).contains(&v);
        check(
            self.density.is_finite() && self.density > 0.0,
            "material.density",
            "be above 0 and finite",
        )?;
        for (value, field) in [
            (self.thickness, "material.thickness"),
            (self.stretch_stiffness_warp, "material.stretch_stiffness_warp"),
            (self.stretch_stiffness_weft, "material.stretch_stiffness_weft"),
            (self.shear_stiffness, "material.shear_stiffness"),
            (self.bend_stiffness, "material.bend_stiffness"),
            (self.friction, "material.friction"),
            (self.drag, "material.drag"),
            (self.lift, "material.lift"),
            (self.bend_damping, "material.bend_damping"),
            (self.stretch_damping, "material.stretch_damping"),
            (self.yield_angle, "material.yield_angle"),
            (self.fold_length, "material.fold_length"),
            (self.yield_hardening, "material.yield_hardening"),
            (self.yield_weakening, "material.yield_weakening"),
        ] {
            check(not_negative(value), field, "be at least 0 and finite")?;
        }
        check(share(self.restitution), "material.restitution", "be from 0 to 1")?;
        check(share(self.tear_variation), "material.tear_variation", "be from 0 to 1")?;
        check(
            self.tear_stretch == 0.0 || (self.tear_stretch.is_finite() && self.tear_stretch > 1.0),
            "material.tear_stretch",
            "be 0 (never) or above 1 and finite",
        )?;
        check(share(self.yield_creep), "material.yield_creep", "be from 0 to 1")
    }
}
