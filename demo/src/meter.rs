//! Smoothed figures of how fast it runs, and how finely it can be drawn at that speed.

use muslin::{Cloth, Stage};
use serde::Serialize;

/// How quickly a figure follows: the share that one frame has in it.
const FOLLOW: f64 = 0.06;

/// Stages of the simulation, and after them those of the picture.
const STAGES: usize = Stage::COUNT + 2;

/// The numbers that a panel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Readout {
    /// Particles, those that tears have added included.
    pub particles: u32,
    /// Constraints that still hold.
    pub constraints: u32,
    /// Pieces that the cloth is in.
    pub pieces: u32,
    /// Frames a second, smoothed.
    pub fps: f32,
    /// Simulation in a frame [ms], smoothed.
    pub milliseconds: f32,
}

/// How long a stage takes in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StageTime {
    /// What it is called.
    pub name: &'static str,
    /// How long it takes [ms], smoothed.
    pub milliseconds: f32,
}

/// Frame time, simulation time and what it is made of, smoothed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meter {
    frame: f64,
    simulation: f64,
    stages: [f64; STAGES],
}

impl Meter {
    /// A frame took so long [s].
    pub fn record_frame(&mut self, seconds: f32) {
        if seconds > 0.0 {
            blend(&mut self.frame, f64::from(seconds));
        }
    }

    /// The simulation of a frame took so long [s].
    pub fn record_simulation(&mut self, seconds: f64) {
        blend(&mut self.simulation, seconds.max(0.0));
    }

    /// The stages of the simulation took so long in a frame [s].
    pub fn record_stages(&mut self, stages: &[f32; Stage::COUNT]) {
        for (figure, seconds) in self.stages.iter_mut().zip(stages) {
            blend(figure, f64::from(*seconds));
        }
    }

    /// Handing the cloth to the graphics card took so long in a frame, and asking for the picture [s].
    pub fn record_drawing(&mut self, upload: f64, draw: f64) {
        blend(&mut self.stages[Stage::COUNT], upload.max(0.0));
        blend(&mut self.stages[Stage::COUNT + 1], draw.max(0.0));
    }

    /// What each stage is called and how long it takes in a frame.
    pub fn stages(&self) -> Vec<StageTime> {
        let names = Stage::ALL.iter().map(|stage| match stage {
            Stage::Outputs => "normals",
            stage => stage.name(),
        });
        let names = names.chain(["upload", "draw calls"]);
        let milliseconds = self.stages.iter().map(|seconds| (1000.0 * seconds) as f32);
        let times = names.zip(milliseconds);
        times.map(|(name, milliseconds)| StageTime { name, milliseconds }).collect()
    }

    /// These figures beside those of the cloths that they are about.
    pub fn readout(&self, cloths: &[Cloth]) -> Readout {
        let mut readout =
            Readout { fps: self.fps(), milliseconds: self.milliseconds(), ..Readout::default() };
        for stats in cloths.iter().map(Cloth::stats) {
            readout.particles += stats.particles;
            readout.constraints += stats.active_constraints;
            readout.pieces += stats.pieces;
        }
        readout
    }

    /// Frames a second.
    pub fn fps(&self) -> f32 {
        if self.frame > 0.0 { (1.0 / self.frame) as f32 } else { 0.0 }
    }

    /// Simulation in a frame [ms].
    pub fn milliseconds(&self) -> f32 {
        (1000.0 * self.simulation) as f32
    }
}

/// Draws dense screens less finely where full density is too slow.
#[derive(Clone, Copy, Debug)]
pub struct ResolutionScaler {
    scale: f32,
    slow: f32,
}

/// Below this rate it is too slow [1/s].
const SLOW: f32 = 40.0;
/// For so long [s] before anything changes.
const PATIENCE: f32 = 2.0;
/// Frames longer than this are not drawing but waiting [s].
const PAUSE: f32 = 0.5;

impl Default for ResolutionScaler {
    fn default() -> Self {
        Self { scale: 1.0, slow: 0.0 }
    }
}

impl ResolutionScaler {
    /// A frame took so long [s].
    pub fn record_frame(&mut self, seconds: f32) {
        if seconds > PAUSE {
            return;
        }
        self.slow = if seconds * SLOW > 1.0 { self.slow + seconds } else { 0.0 };
        if self.slow > PATIENCE {
            self.slow = 0.0;
            self.scale = (self.scale * 0.8).max(0.5);
        }
    }

    /// What share of a screen's pixels to draw along each side, if it has `density` device pixels
    /// to one that the eye counts: never fewer than one.
    pub fn scale(&self, density: f32) -> f32 {
        self.scale.max(1.0 / density.max(1.0))
    }
}

fn blend(figure: &mut f64, value: f64) {
    *figure = if *figure == 0.0 { value } else { *figure + (value - *figure) * FOLLOW };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dense_screen_is_drawn_less_finely_when_slow_and_a_plain_one_never() {
        let mut resolution_scaler = ResolutionScaler::default();
        for _ in 0..600 {
            resolution_scaler.record_frame(1.0 / 60.0);
        }
        assert_eq!(resolution_scaler.scale(2.0), 1.0);
        for _ in 0..600 {
            resolution_scaler.record_frame(1.0 / 15.0);
        }
        assert_eq!((resolution_scaler.scale(1.0), resolution_scaler.scale(2.0)), (1.0, 0.5));
    }

    #[test]
    fn steady_frames_read_as_their_rate() {
        let mut meter = Meter::default();
        assert_eq!(meter.fps(), 0.0);
        meter.record_frame(0.5);
        for _ in 0..200 {
            meter.record_frame(1.0 / 60.0);
            meter.record_simulation(0.0015);
        }
        assert!((meter.fps() - 60.0).abs() < 0.5, "{} fps", meter.fps());
        assert!((meter.milliseconds() - 1.5).abs() < 0.01);
    }

    #[test]
    fn every_stage_has_a_name_and_its_own_figure() {
        let mut meter = Meter::default();
        let seconds = std::array::from_fn(|i| 0.001 * i as f32);
        meter.record_stages(&seconds);
        meter.record_drawing(0.020, 0.021);
        let told = meter.stages();
        assert_eq!(told.len(), STAGES);
        for (i, StageTime { name, milliseconds }) in told[..Stage::COUNT].iter().enumerate() {
            assert!((milliseconds - i as f32).abs() < 1.0e-3, "{name}: {milliseconds} ms");
        }
        let [.., upload, draw] = told[..] else { panic!("{told:?}") };
        assert_eq!((upload.name, upload.milliseconds.round()), ("upload", 20.0));
        assert_eq!((draw.name, draw.milliseconds.round()), ("draw calls", 21.0));
    }
}
