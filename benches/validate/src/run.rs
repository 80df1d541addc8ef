//! One run of a trial: the quality, the number of nodes and the tick, and what it gives.
//!
//! Invariant: every run of every trial gets its settings from [`Run::settings`].

use crate::player::Player;
use muslin::Settings;
use muslin::glam::Vec3;

/// How accurate a run is asked to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quality {
    Fast,
    Default,
    Accurate,
}

pub const QUALITIES: [Quality; 3] = [Quality::Fast, Quality::Default, Quality::Accurate];

/// Nodes along a strip or a side of a sheet.
pub const NODES: [u32; 3] = [24, 40, 56];

/// Ticks per second.
pub const RATES: [u32; 2] = [60, 120];

impl Quality {
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Default => "default",
            Self::Accurate => "accurate",
        }
    }

    /// Substeps of a tick and iterations of a substep.
    pub const fn substeps_and_iterations(self) -> [u32; 2] {
        match self {
            Self::Fast => [2, 2],
            Self::Default => [4, 2],
            Self::Accurate => [16, 2],
        }
    }
}

/// How a trial is played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    pub quality: Quality,
    /// Nodes along a strip or a side of a sheet.
    pub nodes: u32,
    /// Ticks per second.
    pub rate: u32,
}

impl Run {
    /// Settings with this gravity [m/s²] and damping [1/s]; all else is the default.
    pub fn settings(&self, gravity: f64, damping: f32) -> Settings {
        let [substeps, iterations] = self.quality.substeps_and_iterations();
        Settings {
            tick: 1.0 / self.rate as f32,
            substeps,
            iterations,
            gravity: Vec3::NEG_Y * gravity as f32,
            damping,
            ..Settings::default()
        }
    }
}

/// What a run gave.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// One value per quantity of the trial.
    pub values: Vec<f64>,
    /// Whether the cloth came to rest, if the trial waits for that.
    pub settled: bool,
    /// Greatest RMS speed at the end of that wait [m/s].
    pub rest_speed: f64,
    /// Processor time of a tick [ms].
    pub ms: f64,
}

impl Outcome {
    /// What was measured after `player` ran.
    pub fn of(player: &Player, values: impl Into<Vec<f64>>) -> Self {
        Self {
            values: values.into(),
            settled: player.settled,
            rest_speed: player.rest_speed,
            ms: player.ms_of_a_tick(),
        }
    }
}
