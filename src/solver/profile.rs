//! Profile: seconds per stage, measured only while the host provides a clock.
//!
//! The library reads no clock by itself, so that ticks stay deterministic and run on platforms
//! without one. Reads the clock of the host; writes `seconds`.
//! Invariant: the profile never changes the result of a tick.

use crate::solver::stage::Stage;

/// A clock: returns seconds since an arbitrary fixed moment.
pub type Clock = fn() -> f64;

/// Seconds spent in each stage since the start of the last call that ran ticks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Profile {
    clock: Option<Clock>,
    seconds: [f32; Stage::COUNT],
}

impl Profile {
    /// Sets the clock, or stops timing with `None`, and clears all times.
    pub fn set_clock(&mut self, clock: Option<Clock>) {
        *self = Self { clock, seconds: [0.0; Stage::COUNT] };
    }

    pub fn clock(&self) -> Option<Clock> {
        self.clock
    }

    pub fn seconds(&self) -> [f32; Stage::COUNT] {
        self.seconds
    }

    /// Sets all times to zero.
    pub fn reset(&mut self) {
        self.seconds = [0.0; Stage::COUNT];
    }

    /// Returns the time now [s], or 0 without a clock.
    #[inline]
    pub fn start(&self) -> f64 {
        self.clock.map_or(0.0, |clock| clock())
    }

    /// Adds the time since `start` to a stage.
    #[inline]
    pub fn add(&mut self, stage: Stage, start: f64) {
        if let Some(clock) = self.clock {
            self.seconds[stage as usize] += (clock() - start) as f32;
        }
    }
}
