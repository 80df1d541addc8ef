//! Numbers about a cloth.

use muslin_core::{Stage, Stats};

/// Room for the times of stages in MuslinStats; how many there are is in `stage_count`.
pub const MUSLIN_STAGE_SLOTS: usize = 31;

/// Numbers about a cloth. Begin with muslin_stats_init.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct MuslinStats {
    /// Set by muslin_stats_init.
    pub struct_size: u32,
    /// How many particles there are.
    pub particles: u32,
    /// How many triangles there are.
    pub triangles: u32,
    /// How many links it was woven with.
    pub constraints: u32,
    /// How many links hold now.
    pub active_constraints: u32,
    /// How many pieces hang together by edges.
    pub pieces: u32,
    /// Ticks since it was made or reset.
    pub ticks: u32,
    /// The share of a tick that advance still owes, 0 to 1: how far to blend from the last tick's
    /// positions to this one's when drawing.
    pub blend: f32,
    /// The greatest stretch of a stretch link: 0.01 is 1 % over its rest length.
    pub max_stretch: f32,
    /// The mean stretch of the stretch links.
    pub mean_stretch: f32,
    /// Energy of motion [J].
    pub kinetic_energy: f32,
    /// How many of `seconds` tell of a stage.
    pub stage_count: u32,
    /// Memory that it holds [B], about.
    pub bytes: u64,
    /// Time that each stage took in the last call that ran ticks [s]; muslin_stage_name names them.
    /// Timing begins with the first muslin_cloth_get_stats of a cloth: until then zeros.
    pub seconds: [f32; MUSLIN_STAGE_SLOTS],
    /// How many links are past `max_stretch`, if there is such a bound: pins or grabs hold them apart.
    pub over_stretched: u32,
    /// 1 if it sleeps, see `sleep_speed` of MuslinSettings.
    pub asleep: u32,
    /// The speed of its fastest particle [m/s].
    pub max_speed: f32,
}

const _: () = assert!(Stage::COUNT <= MUSLIN_STAGE_SLOTS);

impl From<Stats> for MuslinStats {
    fn from(stats: Stats) -> Self {
        let mut seconds = [0.0; MUSLIN_STAGE_SLOTS];
        seconds[..Stage::COUNT].copy_from_slice(&stats.seconds);
        Self {
            struct_size: size_of::<Self>() as u32,
            particles: stats.particles,
            triangles: stats.triangles,
            constraints: stats.constraints,
            active_constraints: stats.active_constraints,
            pieces: stats.pieces,
            ticks: stats.ticks,
            blend: stats.blend,
            max_stretch: stats.max_stretch,
            mean_stretch: stats.mean_stretch,
            kinetic_energy: stats.kinetic_energy,
            stage_count: Stage::COUNT as u32,
            bytes: stats.bytes,
            seconds,
            over_stretched: stats.over_stretched,
            asleep: stats.asleep.into(),
            max_speed: stats.max_speed,
        }
    }
}
