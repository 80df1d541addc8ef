//! Time: ticks, reset, and the timing of stages.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use muslin::{Clock, Cloth};
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

    /// Returns the address of the core's cloth, for `advance_many`. It is valid until `free`.
    pub fn address(&mut self) -> *mut Cloth {
        &raw mut self.cloth
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

/// Advances the cloths at `addresses`, which `RawCloth::address` returned, by `seconds` [s] of frame
/// time, and returns how many ticks each of them ran. `package/cloth.js` passes cloths that live,
/// each once.
#[wasm_bindgen]
pub fn advance_many(addresses: &[u32], seconds: f64) -> Result<Vec<u32>> {
    let cloth = |address: &u32| {
        // SAFETY: by the contract above, the cloth lives and no other reference to it exists.
        unsafe { &mut *(*address as usize as *mut Cloth) }
    };
    let mut cloths: Vec<&mut Cloth> = addresses.iter().map(cloth).collect();
    Cloth::advance_many(&mut cloths, seconds as f32).map_err(to_js_error)
}
