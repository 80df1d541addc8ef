//! Clock of a cloth: simulated time, tick count, and the frame time that is not simulated yet.
//!
//! Reads the settings; the pipeline counts ticks, `cloth` adds frame time.
//! Invariant: all that an idle cloth reads and writes per frame is here, in one cache line: a crowd
//! of sleeping cloths costs one cache miss per cloth.

use crate::state::settings::Settings;

/// Clock of one cloth.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(64))]
pub(crate) struct FrameClock {
    /// Time since creation or reset [s].
    pub time: f64,
    /// Frame time that has not been simulated yet [s].
    pub backlog: f64,
    /// Ticks since creation or reset.
    pub tick: u32,
    /// Whether a tick would change nothing but this clock; see `cloth::tracked_world`.
    pub is_idle: bool,
    /// `tick` of the settings [s], while idle.
    idle_tick: f32,
    /// `max_ticks_per_advance` of the settings, while idle.
    idle_max_ticks: u32,
}

impl FrameClock {
    /// Adds `seconds` [s] to the backlog, and returns the number of ticks of `tick` seconds that
    /// are due. Ticks beyond `max_ticks` are dropped, and less than one tick stays in the backlog.
    pub fn take_due_ticks(&mut self, seconds: f32, tick: f32, max_ticks: u32) -> u32 {
        let tick = f64::from(tick);
        let backlog = self.backlog + f64::from(seconds);
        let whole = (backlog / tick).floor();
        let backlog = backlog - whole * tick;
        self.backlog = if backlog > 0.0 { backlog } else { 0.0 };
        if whole < f64::from(max_ticks) { whole as u32 } else { max_ticks }
    }

    /// Counts one tick of `tick` seconds.
    pub fn count_tick(&mut self, tick: f32) {
        self.time += f64::from(tick);
        self.tick = self.tick.wrapping_add(1);
    }

    /// Makes the clock idle, with a copy of the settings that it needs.
    pub fn begin_idle(&mut self, settings: &Settings) {
        self.is_idle = true;
        (self.idle_tick, self.idle_max_ticks) = (settings.tick, settings.max_ticks_per_advance);
    }

    /// Advances by `seconds` [s] of frame time, and returns the number of ticks.
    pub fn advance_idle(&mut self, seconds: f32) -> u32 {
        let ticks = self.take_due_ticks(seconds, self.idle_tick, self.idle_max_ticks);
        self.step_idle(ticks);
        ticks
    }

    /// Advances by `ticks` ticks.
    pub fn step_idle(&mut self, ticks: u32) {
        for _ in 0..ticks {
            self.count_tick(self.idle_tick);
        }
    }
}
