//! Time: ticks, reset, and the timing of stages.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use muslin::Clock;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = performance)]
    fn now() -> f64;
}

/// Returns the time of `performance.now()` [s].
fn page_clock() -> f64 {
    now() * 1.0e-3
}

#[wasm_bindgen]
impl RawCloth {
    /// Runs the ticks that `seconds` [s] of frame time are due, and returns how many ran.
    pub fn advance(&mut self, seconds: f64) -> Result<u32> {
        self.cloth.advance(seconds as f32).map_err(to_js_error)
    }

    /// Runs exactly `ticks` ticks.
    pub fn step(&mut self, ticks: u32) {
        self.cloth.step(ticks);
    }

    /// Puts the cloth back into the state in which it was created.
    pub fn reset(&mut self) {
        self.cloth.reset();
    }

    /// Returns the simulated time since creation or the last reset [s].
    pub fn time(&self) -> f64 {
        self.cloth.time()
    }

    /// Returns the number of ticks since creation or the last reset.
    pub fn ticks(&self) -> u32 {
        self.cloth.ticks()
    }

    /// Returns whether the cloth sleeps.
    pub fn asleep(&self) -> bool {
        self.cloth.is_asleep()
    }

    /// Returns the share of a tick that `advance` has not run yet, 0 to 1.
    pub fn blend(&self) -> f32 {
        self.cloth.blend()
    }

    /// Returns whether the stages of a tick are timed.
    pub fn is_timed(&self) -> bool {
        self.is_timed
    }

    /// Turns the timing of stages on or off. The clock is `performance.now()`.
    pub fn set_timed(&mut self, is_timed: bool) {
        self.is_timed = is_timed;
        self.cloth.set_clock(is_timed.then_some(page_clock as Clock));
    }
}
