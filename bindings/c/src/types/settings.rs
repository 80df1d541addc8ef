//! Settings of the simulation.

use super::value::MuslinVec3;
use crate::status::{CallError, Result};
use muslin_core::{SelfCollision, Settings};

/// Value of `self_collision`: parts of the cloth pass through each other.
pub const MUSLIN_SELF_COLLISION_NONE: u32 = 0;
/// Value of `self_collision`: triangles collide with triangles, so that no part of the surface
/// passes through another. With the material's friction.
///
/// - Gap: the material's thickness, or `self_distance`, at most half of the mean rest length. Parts
///   that are nearer than two gaps in the rest shape keep half of their rest distance.
/// - Tears: the two sides of a fresh tear are moved apart by 1/1000 of the mean rest length, so
///   that they collide too.
/// - Pins and grabs: what they hold pushes other parts out of its way. Cloth that is caught between
///   two held parts may be forced through.
/// - Existing intersections (at the start, after this is switched on, or where particles were
///   placed) are untangled, unless they are held: the smaller part moves back to the side of the
///   rest, mostly within a second.
/// - Cost: about as much as the rest of a tick while little touches; several times that where
///   layers lie on each other; 20 to several hundred times where sheets of thousands of particles
///   crumple.
pub const MUSLIN_SELF_COLLISION_SURFACE: u32 = 1;
/// Value of `self_collision`: particles collide with particles, as if they were balls.
///
/// - Cheap and without friction. A fold may pass through where particles are farther apart than
///   `self_distance`.
/// - Two particles of one piece do not collide if their distance in the rest shape is below
///   `self_distance` or 1.5 mean rest lengths. Pinned and grabbed particles do not collide.
pub const MUSLIN_SELF_COLLISION_PARTICLES: u32 = 2;

/// Settings of the simulation: time steps, gravity, damping and solver options. Every field may be
/// changed between ticks. Initialise it with muslin_settings_init.
///
/// A tick is divided into `substeps`. Each substep predicts the positions and then solves all
/// constraints `iterations` times. More of either makes the cloth stiffer; at the same cost,
/// substeps stiffen it more than iterations.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinSettings {
    /// Set by muslin_settings_init.
    pub struct_size: u32,
    /// Length of a tick [s]. Default 1/60. Above 0, at most 1.
    pub tick: f32,
    /// Least number of substeps per tick. Default 4. From 1 to 1000.
    ///
    /// Where cloth and colliders move fast relative to each other, a tick runs up to 8 times as
    /// many, but not more than 64 unless this is larger. See `substeps` of MuslinStats.
    pub substeps: u32,
    /// Solver iterations per substep, in alternating order. Default 2. From 1 to 1000.
    ///
    /// With 1, the time integration is of first order, which damps all motion. From 2 on it is of
    /// second order; then only `damping` and the air damp.
    pub iterations: u32,
    /// Largest number of ticks of one muslin_cloth_advance; the rest of the backlog is dropped.
    /// Default 5. At least 1.
    pub max_ticks_per_advance: u32,
    /// Gravitational acceleration [m/s^2]. Default 0, -9.81, 0.
    pub gravity: MuslinVec3,
    /// Rate at which velocities decay [1/s], as exp(-`damping` t), independent of the step. Default
    /// 0.5. At least 0.
    pub damping: f32,
    /// Largest displacement of a particle per substep, relative to the rigid motion of the cloth,
    /// in mean rest lengths. Default 0.5. Above 0. It also limits the speed of a grabbed particle.
    pub max_displacement: f32,
    /// Strain limit: the largest strain of any stretch or shear link after a tick, unless pins,
    /// grabs or anchors hold it apart. Default 0: no limit. 0.02 is 2 %. At least 0.
    pub max_stretch: f32,
    /// 1: tethers (long-range attachments) keep every particle within its rest distance of the
    /// pins; 0: no tethers. Default 1.
    ///
    /// Tethers carry the load that the iterations do not reach; they do not resist the stretch of
    /// links that have a stiffness. From 2 iterations on, whole chains of links are solved at once
    /// as well.
    pub tethers: u32,
    /// Self-collision: MUSLIN_SELF_COLLISION_NONE (default), MUSLIN_SELF_COLLISION_SURFACE or
    /// MUSLIN_SELF_COLLISION_PARTICLES.
    pub self_collision: u32,
    /// Gap of self-collision [m]. Default 0.
    ///
    /// - Surface: 0 means the material's thickness. At most half of the mean rest length.
    /// - Particles: 0 means 2/3 of the mean rest length. At most twice the mean rest length.
    pub self_distance: f32,
    /// 1: links that are stretched past `tear_stretch` of MuslinMaterial tear; 0: they do not.
    /// Default 0.
    pub tearing: u32,
    /// Largest number of vertices that tearing splits per tick; the most stretched come first.
    /// Default 8. At least 1.
    pub max_tears_per_tick: u32,
    /// Speed below which the cloth falls asleep [m/s]. Default 0: never. At least 0.
    ///
    /// A cloth whose particles were all slower for half a second stops moving, at almost no cost,
    /// until something changes or touches it. Gusts, turbulence and MUSLIN_WIND_SINE_FIELD keep it
    /// awake. See `asleep` of MuslinStats.
    pub sleep_speed: f32,
    /// Over-pressure inside closed pieces of the cloth [Pa]. Default 0. Finite.
    ///
    /// A piece is closed if each of its edges has two triangles, as in a ball or a cushion, or if all
    /// of its border is sewn to closed pieces (muslin_cloth_sew). The pressure is constant, whatever
    /// the volume; a negative one sucks the sides inwards, as a vacuum does. Outwards is where the volume of the rest shape is positive, whatever the winding. A
    /// piece that is torn or cut open loses its pressure at once. Open cloth, such as a grid, feels
    /// none.
    ///
    /// Links stretch under high pressure unless `max_stretch` limits them. Where the pressure alone
    /// would move a particle of a piece by more than `max_displacement` in a substep, all of that
    /// piece gets less.
    pub pressure: f32,
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
            pressure: settings.pressure,
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
            pressure: settings.pressure,
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
