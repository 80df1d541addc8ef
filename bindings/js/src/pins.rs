//! Pins: particles that are held at a target.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing;
use glam::Vec3;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Pins a particle at its current position.
    pub fn pin_here(&mut self, particle: u32) -> Result<()> {
        self.cloth.pin(particle, None).map_err(to_js_error)
    }

    /// Pins a particle at the target x, y, z [m].
    pub fn pin_at(&mut self, particle: u32, x: f32, y: f32, z: f32) -> Result<()> {
        self.cloth.pin(particle, Some(Vec3::new(x, y, z))).map_err(to_js_error)
    }

    /// Removes the pin of a particle.
    pub fn unpin(&mut self, particle: u32) -> Result<()> {
        self.cloth.unpin(particle).map_err(to_js_error)
    }

    /// Removes all pins.
    pub fn unpin_all(&mut self) {
        self.cloth.unpin_all();
    }

    /// Sets the targets of many pins, x y z x y z … [m]; pins particles that are not pinned yet.
    pub fn set_pin_targets(&mut self, particles: &[u32], targets: &[f32]) -> Result<()> {
        let targets = packing::to_vectors(targets);
        self.cloth.set_pin_targets(particles, &targets).map_err(to_js_error)
    }

    /// Sets the stiffness of pins [N/m]; 0 holds their particles exactly at the targets.
    pub fn set_pin_stiffness(&mut self, particles: &[u32], stiffness: f32) -> Result<()> {
        self.cloth.set_pin_stiffness(particles, stiffness).map_err(to_js_error)
    }

    /// Returns the targets of the pinned particles, in their order, x y z x y z … [m].
    pub fn pin_targets(&self) -> Vec<f32> {
        let target = |particle| self.cloth.pin_target(particle).ok().flatten();
        packing::to_numbers(&mut self.cloth.pinned().filter_map(target))
    }

    /// Returns the pinned particles in ascending order.
    pub fn pinned(&self) -> Vec<u32> {
        self.cloth.pinned().collect()
    }
}
