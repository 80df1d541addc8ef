//! Running time, and all that changes how it runs.

use crate::RawCloth;
use crate::numbers;
use crate::refusal::{Result, refusal};
use muslin::Clock;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = performance)]
    fn now() -> f64;
}

/// The page's clock [s].
fn clock() -> f64 {
    now() * 1.0e-3
}

#[wasm_bindgen]
impl RawCloth {
    /// Runs the ticks that a frame of `seconds` owes, and says how many ran.
    pub fn advance(&mut self, seconds: f64) -> Result<u32> {
        self.cloth.advance(seconds as f32).map_err(refusal)
    }

    /// Runs exactly `ticks` ticks.
    pub fn step(&mut self, ticks: u32) {
        self.cloth.step(ticks);
    }

    /// Back to the start.
    pub fn reset(&mut self) {
        self.cloth.reset();
    }

    /// How time runs.
    pub fn settings(&self) -> Vec<f64> {
        numbers::write_settings(self.cloth.settings())
    }

    /// Changes how time runs.
    pub fn set_settings(&mut self, settings: &[f64]) -> Result<()> {
        self.cloth.set_settings(numbers::read_settings(settings)).map_err(refusal)
    }

    /// What it is made of.
    pub fn material(&self) -> Vec<f64> {
        numbers::write_material(self.cloth.material())
    }

    /// Changes what it is made of.
    pub fn set_material(&mut self, material: &[f64]) -> Result<()> {
        self.cloth.set_material(numbers::read_material(material)).map_err(refusal)
    }

    /// The air around it.
    pub fn wind(&self) -> Vec<f64> {
        numbers::write_wind(self.cloth.wind())
    }

    /// Changes the air around it.
    pub fn set_wind(&mut self, wind: &[f64]) -> Result<()> {
        self.cloth.set_wind(numbers::read_wind(wind)).map_err(refusal)
    }

    /// Whether the stages of a tick are timed.
    pub fn is_timed(&self) -> bool {
        self.is_timed
    }

    /// Starts or stops timing the stages of a tick.
    pub fn set_timed(&mut self, is_timed: bool) {
        self.is_timed = is_timed;
        self.cloth.set_clock(is_timed.then_some(clock as Clock));
    }
}
