//! What a cloth is made of, in SI units, and the presets.

use crate::error::{Result, check};
use serde::{Deserialize, Serialize};

/// What a cloth is made of. Start from a preset and change what you need; all of it may change live.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Material {
    /// Mass per area [kg/m²]; 0.18, a cotton. Above 0.
    pub density: f32,
    /// Gap kept from anything touched [m]; 0.00035. Keep it below half the shortest edge.
    pub thickness: f32,
    /// Membrane stiffness along the warp (down a grid) [N/m]; 0 is as stiff as the sweeps allow.
    pub stretch_stiffness_warp: f32,
    /// Membrane stiffness along the weft (across a grid) [N/m]; 0 is as stiff as the sweeps allow.
    pub stretch_stiffness_weft: f32,
    /// Stiffness against shear [N/m]; 0 is as the stretch stiffness.
    pub shear_stiffness: f32,
    /// Bending rigidity per width [N·m]; 2.5e-5: what a strip that hangs from a clamp shows (BS 3356), however
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
    /// less, as the finer the mesh is the more of the load is there: √(16 · `thickness` / mean edge) of
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
    /// one that is folded by φ for the first time (φ − `yield_angle`) / (1 + this) stays, and to fold it on takes
    /// as much more. At least 0. What gives way or is creased while this and `yield_weakening` are 0 is not
    /// counted.
    pub yield_hardening: f32,
    /// How much weaker a fold gets by giving way [1/rad]; 0. Where it has given way by A in all, to either side,
    /// `fold_length` of the sheet bends as if `bend_stiffness` were divided by 1 + this · A, by at most a
    /// thousand; pressed flat, it stays as weak. It gives way under the same moment as before, so that it opens
    /// again by more: `yield_angle` · this counts as `yield_hardening` too. At least 0.
    pub yield_weakening: f32,
}

/// The fabrics that come with Muslin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum Preset {
    /// Light and fluid, 100 g/m².
    Silk = 0,
    /// Shirting, 180 g/m².
    Cotton = 1,
    /// Heavy twill, 380 g/m².
    Denim = 2,
    /// Garment leather, 700 g/m².
    Leather = 3,
    /// Office paper, 80 g/m².
    Paper = 4,
    /// Flag nylon 200 denier, 105 g/m².
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
    /// The figures of a fabric.
    ///
    /// Densities and bending rigidities: silk and leather after the Chaos cloth tables and the KES
    /// ranges, silk at the soft end of its own, with which it drapes as silks do (20 to 40 %), cotton between Wang et al. 2011 and KES, denim after Wang et al. 2011 ("11oz black
    /// denim"), paper after ARCSim and srep06275, flag nylon estimated from vendors' weights. Only paper
    /// keeps folds: its 0.8 rad over 0.01 m are a curvature of 80 1/m, where ARCSim's paper has 200 over
    /// less than that.
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

    /// Whether it matters what folds have given way by.
    pub(crate) fn tracks_hardening(&self) -> bool {
        self.yield_hardening > 0.0 || self.yield_weakening > 0.0
    }

    /// How much more a fold opens again for each angle that it has given way by.
    pub(crate) fn effective_hardening(&self) -> f32 {
        self.yield_hardening + self.yield_weakening * self.yield_angle
    }

    /// Refuses figures that no fabric has.
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
