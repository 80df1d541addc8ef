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
    /// Substeps in a tick; 4. From 1 to 1000.
    pub substeps: u32,
    /// Sweeps over the links in a substep, to and fro in turn; 2. From 1 to 1000. With a single sweep
    /// velocities are of first order, which brakes all motion; from two on they are of second order,
    /// and nothing brakes but `damping` and the air.
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
    /// The most that any thread or diagonal is stretched after a tick, unless pins or grabs hold it
    /// apart: 0.02 is 2 %; 0 is no bound. Then [`Stats::over_stretched`](crate::Stats) and an event say so.
    pub max_stretch: f32,
    /// Long-range attachments that keep every particle within reach of the pins; on. They bear what the
    /// sweeps do not get to, and nothing of what a load stretches soft links by. From two iterations on,
    /// whole lines of links are solved at once as well, so that a load reaches the pins in one go. Off,
    /// sweeps are all there is.
    pub tethers: bool,
    /// Whether and how parts of the cloth keep apart; not at all.
    pub self_collision: SelfCollision,
    /// Distance that they keep [m]; 0. Where surfaces keep apart 0 takes the material's thickness, and it is
    /// at most half of the mean rest length; where particles do, 0 takes two thirds of that length, and it
    /// is at most twice that length.
    pub self_distance: f32,
    /// Over-stretched links tear, see `Material::tear_stretch`; off.
    pub tearing: bool,
    /// Vertices that tearing may split in one tick, the worst first; 8. At least 1.
    pub max_tears_per_tick: u32,
    /// A cloth of which no particle was faster for half a second sleeps [m/s]: it stays just as it is, at
    /// next to no cost, until something changes or touches it; 0, never. At least 0. Gusts, swirls and the
    /// sine field keep a cloth awake. See [`Stats::asleep`](crate::Stats).
    pub sleep_speed: f32,
}

/// How parts of a cloth keep apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum SelfCollision {
    /// Not at all: they go through each other.
    #[default]
    None = 0,
    /// Surface from surface, a material's thickness apart, so that nothing crosses, with the material's
    /// friction. A thickness counts up to half of the mean rest length. What is nearer than two thicknesses in
    /// the weave keeps half of that distance. The two sides of a slit part by a thousandth of the mean rest
    /// length as it opens, so that they keep from each other too. What pins or grabs hold takes along what is in
    /// its way, and what is caught between two such may be forced through. What crosses all the same, from the
    /// start, as this is switched on or where particles are placed, is drawn out again unless it is held: the smaller
    /// part goes back to the side of the rest, mostly within a second. It costs about as much as the rest of a tick
    /// while little touches, several times that where layers lie on each other, and from twenty to hundreds of
    /// times where sheets of thousands of particles crumple.
    Surface = 1,
    /// Particles from particles, as if they were balls: cheap, without friction, and a fold may slip through
    /// where particles are farther apart than `self_distance`. Those that are woven into one piece nearer
    /// than that, or than one and a half mean rest lengths, do not count; what is held neither.
    Particles = 2,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tick: 1.0 / 60.0,
            substeps: 4,
            iterations: 2,
            max_ticks_per_advance: 5,
            gravity: Vec3::new(0.0, -9.81, 0.0),
            damping: 0.5,
            max_displacement: 0.5,
            max_stretch: 0.0,
            tethers: true,
            self_collision: SelfCollision::None,
            self_distance: 0.0,
            tearing: false,
            max_tears_per_tick: 8,
            sleep_speed: 0.0,
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
        check(not_negative(self.sleep_speed), "settings.sleep_speed", "be at least 0 and finite")?;
        Ok(())
    }

    /// How many links of so many triangles may tear in one tick: no more than there can ever be.
    pub(crate) fn max_tears(&self, triangles: usize) -> usize {
        (self.max_tears_per_tick as usize).min(4 * triangles)
    }

    /// How positions follow from velocities in these settings.
    pub(crate) fn scheme(&self) -> BdfScheme {
        let h = self.tick / self.substeps as f32;
        if self.iterations >= 2 { BdfScheme::second_order(h) } else { BdfScheme::first_order(h) }
    }
}

/// A backward difference formula: how a substep carries motion on.
///
/// ```text
/// way = carry moved + step (v_ahead + step a),   moved: the way of the substep before
/// v   = (lead way - trail moved) / h,            way: as the solver corrected it
/// v_ahead = v + carry (v - v_prev)
/// ```
/// Second order (BDF2) loses next to no energy where first order, the plain formula of position-based
/// dynamics, loses most of it (English and Bridson, "Animating developable surfaces using
/// nonconforming elements", 2008, sec. 3). It needs links that are solved symmetrically, to and fro:
/// the phase error of a one-way sweep would feed it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BdfScheme {
    /// Length of a substep [s].
    pub h: f32,
    /// The part of it that a new velocity acts for [s].
    pub velocity_step: f32,
    /// Share of the last change that goes on.
    pub extrapolation: f32,
    pub new_weight: f32,
    pub old_weight: f32,
}

impl BdfScheme {
    fn first_order(h: f32) -> Self {
        Self { h, velocity_step: h, extrapolation: 0.0, new_weight: 1.0, old_weight: 0.0 }
    }

    fn second_order(h: f32) -> Self {
        Self {
            h,
            velocity_step: h * (2.0 / 3.0),
            extrapolation: 1.0 / 3.0,
            new_weight: 1.5,
            old_weight: 0.5,
        }
    }
}
