//! Where the time of a tick goes, when somebody asks.

use crate::solver::stage::Stage;

/// A clock: seconds since any moment.
pub type Clock = fn() -> f64;

/// Seconds spent in each stage since the last call that ran ticks began.
#[derive(Clone, Debug, Default)]
pub(crate) struct Profile {
    clock: Option<Clock>,
    seconds: [f32; Stage::COUNT],
}

impl Profile {
    /// Starts (or stops, with `None`) timing by a clock.
    pub fn set_clock(&mut self, clock: Option<Clock>) {
        *self = Self { clock, seconds: [0.0; Stage::COUNT] };
    }

    pub fn clock(&self) -> Option<Clock> {
        self.clock
    }

    pub fn seconds(&self) -> [f32; Stage::COUNT] {
        self.seconds
    }

    /// Forgets the times so far.
    pub fn restart(&mut self) {
        self.seconds = [0.0; Stage::COUNT];
    }

    /// The time now, if anybody asks.
    #[inline]
    pub fn start(&self) -> f64 {
        self.clock.map_or(0.0, |clock| clock())
    }

    /// Books the time since `start` under a stage.
    #[inline]
    pub fn book(&mut self, stage: Stage, start: f64) {
        if let Some(clock) = self.clock {
            self.seconds[stage as usize] += (clock() - start) as f32;
        }
    }
}
