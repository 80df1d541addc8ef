//! Frame timing: smoothed durations, and the resolution scale that follows from them.
//!
//! ```text
//! figure += (value − figure) · 0.06       exponential moving average, once per frame
//! ```
//! Reads durations [s]; writes smoothed figures, a [`Readout`] and the resolution scale.
//!
//! Invariant: nothing here feeds back into the simulation.

use muslin::{Cloth, Stage};
use serde::Serialize;

/// Weight of one frame in the moving average.
const SMOOTHING: f64 = 0.06;

/// Stages of the simulation, and two more for upload and draw calls.
const STAGES: usize = Stage::COUNT + 2;

/// Numbers that a panel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Readout {
    /// Particles, including those that tears have added.
    pub particles: u32,
    /// Constraints that are not torn.
    pub constraints: u32,
    /// Connected pieces of the cloth.
    pub pieces: u32,
    /// Frames per second, smoothed.
    pub fps: f32,
    /// Simulation time per frame [ms], smoothed.
    pub milliseconds: f32,
}

/// Duration of one stage in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StageTime {
    /// Name of the stage.
    pub name: &'static str,
    /// Duration [ms], smoothed.
    pub milliseconds: f32,
}

/// Smoothed frame time, simulation time and times of the stages.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meter {
    frame: f64,
    simulation: f64,
    stages: [f64; STAGES],
}

impl Meter {
    /// Adds the duration of a frame [s].
    pub fn record_frame(&mut self, seconds: f32) {
        if seconds > 0.0 {
            blend(&mut self.frame, f64::from(seconds));
        }
    }

    /// Adds the duration of the simulation in a frame [s].
    pub fn record_simulation(&mut self, seconds: f64) {
        blend(&mut self.simulation, seconds.max(0.0));
    }

    /// Adds the durations of the stages of the simulation in a frame [s].
    pub fn record_stages(&mut self, stages: &[f32; Stage::COUNT]) {
        for (figure, seconds) in self.stages.iter_mut().zip(stages) {
            blend(figure, f64::from(*seconds));
        }
    }

    /// Adds the durations of the upload to the GPU and of the draw calls in a frame [s].
    pub fn record_drawing(&mut self, upload: f64, draw: f64) {
        blend(&mut self.stages[Stage::COUNT], upload.max(0.0));
        blend(&mut self.stages[Stage::COUNT + 1], draw.max(0.0));
    }

    /// Returns name and duration of each stage.
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

    /// Returns these figures together with the counts of `cloths`.
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

    /// Returns the frames per second.
    pub fn fps(&self) -> f32 {
        if self.frame > 0.0 { (1.0 / self.frame) as f32 } else { 0.0 }
    }

    /// Returns the simulation time per frame [ms].
    pub fn milliseconds(&self) -> f32 {
        (1000.0 * self.simulation) as f32
    }
}

/// Lowers the render resolution while frames are too slow, and then the detail of the cloth.
#[derive(Clone, Copy, Debug)]
pub struct ResolutionScaler {
    scale: f32,
    slow: f32,
    /// Whether the density of the screen was not enough to lower.
    is_low: bool,
    /// Number of frames without a very slow one that end the low mode of the start.
    frames_to_end_start: u32,
}

/// Frame rate below which a frame counts as slow [1/s].
const SLOW_RATE: f32 = 40.0;
/// Time of slow frames before the scale changes [s].
const SLOW_SECONDS: f32 = 2.0;
/// Most time of one frame that counts as slow [s]: a longer one may be a pause of the window.
const LONGEST_SLOW: f32 = 0.5;
/// Frame rate below which the scale goes to its least at once [1/s].
const VERY_SLOW_RATE: f32 = 10.0;
/// Number of frames without a very slow one after which a page draws all pixels. Browsers accept a
/// few frames before the first of them is drawn, so fewer would tell nothing.
const START_FRAMES: u32 = 4;
/// Least number of drawn pixels per device pixel along each side.
const LEAST_SCALE: f32 = 0.5;

impl Default for ResolutionScaler {
    fn default() -> Self {
        Self { scale: 1.0, slow: 0.0, is_low: false, frames_to_end_start: 0 }
    }
}

impl ResolutionScaler {
    /// Creates one that is in the low mode until [`START_FRAMES`] frames were not very slow, so that
    /// a page without a graphics card shows its first frame soon.
    pub fn starting_low() -> Self {
        Self { frames_to_end_start: START_FRAMES, ..Self::default() }
    }

    /// Adds the duration of a frame [s]; lowers the scale after [`SLOW_SECONDS`] of slow frames,
    /// and begins the low mode if the scale is at its least.
    pub fn record_frame(&mut self, seconds: f32) {
        let is_slow = seconds * SLOW_RATE > 1.0;
        if self.frames_to_end_start > 0 && seconds > 0.0 {
            let is_very_slow = seconds * VERY_SLOW_RATE > 1.0;
            let left = self.frames_to_end_start - 1;
            self.frames_to_end_start = if is_very_slow { START_FRAMES } else { left };
        }
        self.slow = if is_slow { self.slow + seconds.min(LONGEST_SLOW) } else { 0.0 };
        if self.slow > SLOW_SECONDS {
            self.slow = 0.0;
            self.is_low |= self.scale == LEAST_SCALE;
            let factor = if seconds * VERY_SLOW_RATE > 1.0 { LEAST_SCALE } else { 0.8 };
            self.scale = (self.scale * factor).max(LEAST_SCALE);
        }
    }

    /// Returns the fraction of the device pixels to draw along each side; `density` is the number
    /// of device pixels per logical pixel. The result is at least one pixel per logical pixel, and
    /// half of that in the low mode.
    pub fn scale(&self, density: f32) -> f32 {
        if self.frames_to_end_start > 0 {
            return LEAST_SCALE;
        }
        let least = if self.is_low { LEAST_SCALE } else { 1.0 };
        self.scale.max(least / density.max(1.0))
    }

    /// Returns whether frames are slow at the least resolution too, or may be.
    pub fn is_low(&self) -> bool {
        self.is_low || self.frames_to_end_start > 0
    }
}

fn blend(figure: &mut f64, value: f64) {
    *figure = if *figure == 0.0 { value } else { *figure + (value - *figure) * SMOOTHING };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_frames_lower_the_scale_first_on_dense_screens_and_then_everywhere() {
        let mut resolution_scaler = ResolutionScaler::default();
        for _ in 0..600 {
            resolution_scaler.record_frame(1.0 / 60.0);
        }
        assert_eq!(resolution_scaler.scale(2.0), 1.0);
        // Four times two seconds reach the least scale of a dense screen.
        for _ in 0..9 * 15 {
            resolution_scaler.record_frame(1.0 / 15.0);
        }
        assert_eq!((resolution_scaler.scale(1.0), resolution_scaler.scale(2.0)), (1.0, 0.5));
        assert!(!resolution_scaler.is_low());
        for _ in 0..6 {
            resolution_scaler.record_frame(1.0);
        }
        assert!(resolution_scaler.is_low());
        assert_eq!((resolution_scaler.scale(1.0), resolution_scaler.scale(3.0)), (0.5, 0.5));
    }

    #[test]
    fn very_slow_frames_reach_the_low_mode_in_four_seconds_and_a_pause_does_not() {
        let mut resolution_scaler = ResolutionScaler::default();
        for _ in 0..20 {
            resolution_scaler.record_frame(60.0);
            resolution_scaler.record_frame(1.0 / 60.0);
        }
        assert_eq!(resolution_scaler.scale(2.0), 1.0);
        let begins = (1..).find(|_| {
            resolution_scaler.record_frame(0.4);
            resolution_scaler.is_low()
        });
        assert_eq!(begins, Some(12), "twice more than two seconds");
    }

    #[test]
    fn the_low_mode_of_the_start_ends_after_a_few_frames_and_not_on_slow_machines() {
        let mut resolution_scaler = ResolutionScaler::starting_low();
        for seconds in [0.0, 0.3, 0.016, 0.016, 0.016] {
            resolution_scaler.record_frame(seconds);
            assert_eq!((resolution_scaler.scale(1.0), resolution_scaler.is_low()), (0.5, true));
        }
        resolution_scaler.record_frame(0.016);
        assert_eq!((resolution_scaler.scale(1.0), resolution_scaler.is_low()), (1.0, false));
        let mut resolution_scaler = ResolutionScaler::starting_low();
        for _ in 0..100 {
            resolution_scaler.record_frame(0.2);
            assert!(resolution_scaler.is_low());
        }
    }

    #[test]
    fn steady_frames_give_their_frame_rate() {
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
    fn every_stage_has_a_name_and_its_own_duration() {
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
