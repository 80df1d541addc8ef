//! Creases and tears that the caller asks for.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing::Reader;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Adds a fold of `angle` [rad] along a line. `line` holds both ends of the line.
    pub fn crease(&mut self, line: &[f64], angle: f32) -> Result<()> {
        let mut line = Reader::new(line);
        self.cloth.crease(line.vector(), line.vector(), angle).map_err(to_js_error)
    }

    /// Tears the edge between two particles, and returns whether it tore.
    pub fn tear_edge(&mut self, particle_a: u32, particle_b: u32) -> Result<bool> {
        self.cloth.tear_edge(particle_a, particle_b).map_err(to_js_error)
    }
}
