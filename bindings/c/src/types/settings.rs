//! How time runs.

use super::value::MuslinVec3;
use crate::status::{CallError, Result};
use muslin_core::{SelfCollision, Settings};

/// For `self_collision`: parts of the cloth go through each other.
pub const MUSLIN_SELF_COLLISION_NONE: u32 = 0;
/// For `self_collision`: surface keeps from surface, a material's thickness apart, so that nothing crosses,
/// with the material's friction. A thickness counts up to half of the mean rest length. What is nearer than
/// two thicknesses in the weave keeps half of that distance. The two sides of a slit part by a
/// thousandth of the mean rest length as it opens, so that they keep from each other too. What pins or grabs
/// hold takes along what is in its way, and what is caught between two such may be forced through. What
/// crosses all the same, from the start, as this is switched on or where particles are placed, is drawn out
/// again unless it is held: the smaller part goes back to the side of the rest, mostly within a second. It
/// costs about as much as the rest of a tick while little touches, several times that where layers lie on
/// each other, and from twenty to hundreds of times where sheets of thousands of particles crumple.
pub const MUSLIN_SELF_COLLISION_SURFACE: u32 = 1;
/// For `self_collision`: particles keep from particles, as if they were balls: cheap, without friction, and
/// a fold may slip through where particles are farther apart than `self_distance`. Those that are woven into
/// one piece nearer than that, or than one and a half mean rest lengths, do not count; what is held neither.
pub const MUSLIN_SELF_COLLISION_PARTICLES: u32 = 2;

/// How time runs: ticks, sweeps, gravity, damping and the switches of the solver. All of it may
/// change between ticks.
///
/// One tick is `substeps` times (predict, then `iterations` sweeps over all links). More of either
/// makes the cloth stiffer; at the same cost substeps stiffen more than iterations do.
/// Begin with muslin_settings_init.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinSettings {
    /// Set by muslin_settings_init.
    pub struct_size: u32,
    /// Length of a tick [s]; 1/60. Above 0, at most 1.
    pub tick: f32,
    /// Substeps in a tick; 4. From 1 to 1000.
    pub substeps: u32,
    /// Sweeps over the links in a substep, to and fro in turn; 2. From 1 to 1000. With a single sweep
    /// velocities are of first order, which brakes all motion; from two on they are of second order,
    /// and nothing brakes but `damping` and the air.
    pub iterations: u32,
    /// Ticks that one advance may run; 5. What a late frame owes beyond it is dropped. At least 1.
    pub max_ticks_per_advance: u32,
    /// Acceleration of everything [m/s^2]; 0, -9.81, 0.
    pub gravity: MuslinVec3,
    /// Rate at which velocity decays [1/s]: as exp(-damping t), whatever the step; 0.5. At least 0.
    pub damping: f32,
    /// The farthest that a particle moves in a substep against the cloth's own rigid motion, in mean
    /// rest lengths; 0.5. Above 0. A grabbed particle follows its pointer no faster than this either.
    pub max_displacement: f32,
    /// The most that any thread or diagonal is stretched after a tick, unless pins or grabs hold it
    /// apart: 0.02 is 2 %; 0, no bound. At least 0.
    pub max_stretch: f32,
    /// 1: long-range attachments keep every particle within reach of the pins; 0: they do not. 1.
    /// They bear what the sweeps do not get to, and nothing of what a load stretches soft links by.
    /// From two iterations on, whole lines of links are solved at once as well.
    pub tethers: u32,
    /// Whether and how parts of the cloth keep apart: MUSLIN_SELF_COLLISION_NONE (this at first),
    /// MUSLIN_SELF_COLLISION_SURFACE or MUSLIN_SELF_COLLISION_PARTICLES.
    pub self_collision: u32,
    /// Distance that they keep [m]; 0. Where surfaces keep apart 0 takes the material's thickness, and it is
    /// at most half of the mean rest length; where particles do, 0 takes two thirds of that length, and it
    /// is at most twice that length.
    pub self_distance: f32,
    /// 1: over-stretched links tear, see `tear_stretch` of MuslinMaterial; 0: they do not. 0.
    pub tearing: u32,
    /// Vertices that tearing may split in one tick, the worst first; 8. At least 1.
    pub max_tears_per_tick: u32,
    /// A cloth of which no particle was faster for half a second sleeps [m/s]: it stays just as it is, at
    /// next to no cost, until something changes or touches it; 0, never. At least 0. Gusts, swirls and the
    /// sine field keep a cloth awake. See `asleep` of MuslinStats.
    pub sleep_speed: f32,
}

impl Default for MuslinSettings {
    fn default() -> Self {
        Self::from(&Settings::default())
    }
}

impl From<&Settings> for MuslinSettings {
    fn from(settings: &Settings) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            tick: settings.tick,
            substeps: settings.substeps,
            iterations: settings.iterations,
            max_ticks_per_advance: settings.max_ticks_per_advance,
            gravity: settings.gravity.into(),
            damping: settings.damping,
            max_displacement: settings.max_displacement,
            max_stretch: settings.max_stretch,
            tethers: settings.tethers.into(),
            self_collision: settings.self_collision as u32,
            self_distance: settings.self_distance,
            tearing: settings.tearing.into(),
            max_tears_per_tick: settings.max_tears_per_tick,
            sleep_speed: settings.sleep_speed,
        }
    }
}

impl TryFrom<MuslinSettings> for Settings {
    type Error = CallError;

    fn try_from(settings: MuslinSettings) -> Result<Self> {
        Ok(Self {
            tick: settings.tick,
            substeps: settings.substeps,
            iterations: settings.iterations,
            max_ticks_per_advance: settings.max_ticks_per_advance,
            gravity: settings.gravity.into(),
            damping: settings.damping,
            max_displacement: settings.max_displacement,
            max_stretch: settings.max_stretch,
            tethers: switch(settings.tethers, "settings.tethers")?,
            self_collision: self_collision(settings.self_collision)?,
            self_distance: settings.self_distance,
            tearing: switch(settings.tearing, "settings.tearing")?,
            max_tears_per_tick: settings.max_tears_per_tick,
            sleep_speed: settings.sleep_speed,
        })
    }
}

fn self_collision(number: u32) -> Result<SelfCollision> {
    match number {
        MUSLIN_SELF_COLLISION_NONE => Ok(SelfCollision::None),
        MUSLIN_SELF_COLLISION_SURFACE => Ok(SelfCollision::Surface),
        MUSLIN_SELF_COLLISION_PARTICLES => Ok(SelfCollision::Particles),
        _ => Err(CallError::bad_value("settings.self_collision", "be 0, 1 or 2")),
    }
}

fn switch(number: u32, field: &str) -> Result<bool> {
    match number {
        0 => Ok(false),
        1 => Ok(true),
        _ => Err(CallError::bad_value(field, "be 0 or 1")),
    }
}
