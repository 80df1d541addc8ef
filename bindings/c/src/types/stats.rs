//! Statistics of a cloth.

use muslin_core::{Stage, Stats};

/// Length of `seconds` in MuslinStats. `stage_count` says how many entries are used.
pub const MUSLIN_STAGE_SLOTS: usize = 31;

/// Statistics of a cloth. Initialise it with muslin_stats_init.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct MuslinStats {
    /// Set by muslin_stats_init.
    pub struct_size: u32,
    /// Number of particles.
    pub particles: u32,
    /// Number of triangles.
    pub triangles: u32,
    /// Number of links in the rest state.
    pub constraints: u32,
    /// Number of links that are intact now.
    pub active_constraints: u32,
    /// Number of pieces: sets of triangles connected by edges.
    pub pieces: u32,
    /// Ticks since the cloth was made or reset.
    pub ticks: u32,
    /// Part of a tick that muslin_cloth_advance has not simulated yet, from 0 to 1: the factor by
    /// which to blend from the positions of the last tick to the current ones when drawing.
    pub blend: f32,
    /// Largest strain of a stretch link: 0.01 is 1 % above its rest length.
    pub max_stretch: f32,
    /// Mean strain of the stretch links.
    pub mean_stretch: f32,
    /// Kinetic energy [J].
    pub kinetic_energy: f32,
    /// Number of used entries of `seconds`.
    pub stage_count: u32,
    /// Approximate memory use [bytes].
    pub bytes: u64,
    /// Time of each stage in the last call that ran ticks [s]; muslin_stage_name returns their
    /// names.
    ///
    /// Timing starts with the first muslin_cloth_get_stats of a cloth; until then all entries are
    /// 0.
    pub seconds: [f32; MUSLIN_STAGE_SLOTS],
    /// Number of links past `max_stretch` of MuslinSettings, which pins, grabs or anchors hold
    /// apart; 0 without that limit.
    pub over_stretched: u32,
    /// 1 if the cloth sleeps, see `sleep_speed` of MuslinSettings; else 0.
    pub asleep: u32,
    /// Speed of the fastest particle [m/s].
    pub max_speed: f32,
    /// Number of substeps of the last tick: `substeps` of MuslinSettings, or more where cloth and
    /// colliders moved fast relative to each other. A cloth that sleeps runs none and keeps the
    /// number.
    pub substeps: u32,
    /// Number of particles that pins, attachments or grabs hold more than 0.1 mm inside a collider.
    /// Nothing is inside a triangle mesh, which has two sides.
    pub held_inside: u32,
    /// Number of other particles more than 0.1 mm inside a collider.
    pub free_inside: u32,
    /// Number of crossings: pairs of an edge of the cloth and a triangle that it passes through, as
    /// found in the last tick; 0 without surface collision. A cloth without known crossings is
    /// tested in parts, all of it in 16 ticks.
    pub crossings: u32,
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
            substeps: stats.substeps,
            held_inside: stats.held_inside,
            free_inside: stats.free_inside,
            crossings: stats.crossings,
        }
    }
}
