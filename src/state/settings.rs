//! How time runs for one cloth. Every field may change between ticks.

use crate::error::{Result, check, check_finite};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// How time runs: ticks, sweeps, gravity, damping and the switches of the solver.
///
/// One tick is `substeps` times (predict, then `iterations` sweeps over all links). More of either
/// makes the cloth stiffer; at the same cost substeps stiffen more than iterations do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Length of a tick [s]; 1/60. Above 0, at most 1.
    pub tick: f32,
    /// Substeps in a tick; 8. From 1 to 1000.
    pub substeps: u32,
    /// Sweeps over the links in a substep; 1. From 1 to 1000.
    pub iterations: u32,
    /// Ticks that one `advance` may run; 5. What a late frame owes beyond it is dropped. At least 1.
    pub max_ticks_per_advance: u32,
    /// Acceleration of everything [m/s²]; (0, −9.81, 0).
    pub gravity: Vec3,
    /// Rate at which velocity decays [1/s]: as exp(−damping · t), whatever the step; 0.5. At least 0.
    pub damping: f32,
    /// The farthest that a particle moves in a substep against the cloth's own rigid motion, in mean
    /// rest lengths; 0.5. Above 0. A grabbed particle follows its pointer no faster than this either.
    pub max_displacement: f32,
    /// The most that a link may be stretched after a tick: 0.02 is 2 %; 0 is no bound.
    pub max_stretch: f32,
    /// Long-range attachments that keep every particle within reach of the pins; on. They hold
    /// where links are rigid (`stretch_stiffness` 0), or at `max_stretch` where they are not.
    pub tethers: bool,
    /// Layers of the cloth keep apart; off.
    pub self_collision: bool,
    /// Distance between layers [m]; 0 takes the material's thickness.
    pub self_distance: f32,
    /// Over-stretched links tear, see `Material::tear_stretch`; off.
    pub tearing: bool,
    /// Vertices that tearing may split in one tick, the worst first; 8. At least 1.
    pub max_tears_per_tick: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tick: 1.0 / 60.0,
            substeps: 8,
            iterations: 1,
            max_ticks_per_advance: 5,
            gravity: Vec3::new(0.0, -9.81, 0.0),
            damping: 0.5,
            max_displacement: 0.5,
            max_stretch: 0.0,
            tethers: true,
            self_collision: false,
            self_distance: 0.0,
            tearing: false,
            max_tears_per_tick: 8,
        }
    }
}

impl Settings {
    /// Refuses settings that cannot run.
    pub(crate) fn check(&self) -> Result<()> {
        check(self.tick > 0.0 && self.tick <= 1.0, "settings.tick", "be above 0 and at most 1")?;
        let few = |n: u32| (1..=1000).contains(&n);
        check(few(self.substeps), "settings.substeps", "be from 1 to 1000")?;
        check(few(self.iterations), "settings.iterations", "be from 1 to 1000")?;
        check(self.max_ticks_per_advance >= 1, "settings.max_ticks_per_advance", "be at least 1")?;
        check_finite(self.gravity, "settings.gravity")?;
        let positive = |v: f32| v.is_finite() && v > 0.0;
        let not_negative = |v: f32| v.is_finite() && v >= 0.0;
        check(not_negative(self.damping), "settings.damping", "be at least 0 and finite")?;
        check(
            positive(self.max_displacement),
            "settings.max_displacement",
            "be above 0 and finite",
        )?;
        check(not_negative(self.max_stretch), "settings.max_stretch", "be at least 0 and finite")?;
        check(
            not_negative(self.self_distance),
            "settings.self_distance",
            "be at least 0 and finite",
        )?;
        check(self.max_tears_per_tick >= 1, "settings.max_tears_per_tick", "be at least 1")?;
        check(!self.self_collision, "settings.self_collision", "be off: it is not supported yet")
    }

    /// Length of a substep [s].
    pub(crate) fn substep(&self) -> f32 {
        self.tick / self.substeps as f32
    }
}
