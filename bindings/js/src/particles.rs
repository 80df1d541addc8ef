//! Position, velocity, mass and painted maps of particles, one by one or in bulk.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing::{self, Writer};
use glam::Vec3;
use muslin::{Error, Map};
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

    /// Sets the positions of the particles from `first` on, x y z x y z … [m].
    pub fn set_positions(&mut self, first: u32, positions: &[f32]) -> Result<()> {
        let positions = packing::to_vectors(positions);
        self.cloth.set_positions(first, &positions).map_err(to_js_error)
    }

    /// Sets the velocities of the particles from `first` on, x y z x y z … [m/s].
    pub fn set_velocities(&mut self, first: u32, velocities: &[f32]) -> Result<()> {
        let velocities = packing::to_vectors(velocities);
        self.cloth.set_velocities(first, &velocities).map_err(to_js_error)
    }

    /// Returns the velocities of all particles, x y z x y z … [m/s].
    pub fn velocities(&self) -> Vec<f32> {
        packing::to_numbers(&mut self.cloth.velocities())
    }

    /// Returns the positions of all particles in the rest shape, x y z x y z … [m].
    pub fn rest_positions(&self) -> Vec<f32> {
        packing::to_numbers(&mut self.cloth.rest_positions())
    }

    /// Returns mass [kg], center of mass [m] and momentum [kg m/s] of the whole cloth.
    pub fn mass_properties(&self) -> Vec<f64> {
        let mass = self.cloth.mass_properties();
        let mut list = Writer::default();
        list.number(mass.total);
        list.vector(mass.center);
        list.vector(mass.momentum);
        list.0
    }

    /// Sets factors on the masses of particles, one for each.
    pub fn set_mass_scales(&mut self, particles: &[u32], scales: &[f32]) -> Result<()> {
        self.cloth.set_mass_scales(particles, scales).map_err(to_js_error)
    }

    /// Sets a painted map by its number, or takes it away.
    pub fn set_map(&mut self, map: usize, scales: Option<Box<[f32]>>) -> Result<()> {
        self.cloth.set_map(Map::ALL[map], scales.as_deref()).map_err(to_js_error)
    }

    /// Returns a painted map by its number; undefined if it is not set.
    pub fn map(&self, map: usize) -> Option<Vec<f32>> {
        self.cloth.map(Map::ALL[map]).map(<[f32]>::to_vec)
    }

    fn bad_particle(&self, particle: u32) -> Error {
        Error::BadIndex { field: "particle", index: particle, count: self.cloth.particle_count() }
    }
}
