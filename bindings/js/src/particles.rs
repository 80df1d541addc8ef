//! Position, velocity and mass of single particles.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing::Writer;
use glam::Vec3;
use muslin::Error;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Returns the position of a particle [m].
    pub fn position(&self, particle: u32) -> Result<Vec<f64>> {
        let position = self.cloth.position(particle);
        let mut list = Writer::default();
        list.vector(position.ok_or_else(|| to_js_error(self.bad_particle(particle)))?);
        Ok(list.0)
    }

    /// Returns the velocity of a particle [m/s].
    pub fn velocity(&self, particle: u32) -> Result<Vec<f64>> {
        let velocity = self.cloth.velocity(particle);
        let mut list = Writer::default();
        list.vector(velocity.ok_or_else(|| to_js_error(self.bad_particle(particle)))?);
        Ok(list.0)
    }

    /// Returns the mass of a particle [kg].
    pub fn mass(&self, particle: u32) -> Result<f32> {
        self.cloth.mass(particle).ok_or_else(|| to_js_error(self.bad_particle(particle)))
    }

    /// Sets the position of a particle [m].
    pub fn set_position(&mut self, particle: u32, x: f32, y: f32, z: f32) -> Result<()> {
        self.cloth.set_position(particle, Vec3::new(x, y, z)).map_err(to_js_error)
    }

    /// Sets the velocity of a particle [m/s].
    pub fn set_velocity(&mut self, particle: u32, x: f32, y: f32, z: f32) -> Result<()> {
        self.cloth.set_velocity(particle, Vec3::new(x, y, z)).map_err(to_js_error)
    }

    /// Sets factors on the masses of particles, one for each.
    pub fn set_mass_scales(&mut self, particles: &[u32], scales: &[f32]) -> Result<()> {
        self.cloth.set_mass_scales(particles, scales).map_err(to_js_error)
    }

    fn bad_particle(&self, particle: u32) -> Error {
        Error::BadIndex { field: "particle", index: particle, count: self.cloth.particle_count() }
    }
}
