//! Ray casts, and grabs: particles that a pointer holds.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing::{Reader, Writer};
use glam::Vec3;
use muslin::Grab;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Returns the first hit of a ray as triangle, particle, u, v, distance, position and normal;
    /// an empty list if it misses. `ray` holds the origin and the direction.
    pub fn raycast(&self, ray: &[f64], max_distance: f32) -> Result<Vec<f64>> {
        let mut ray = Reader::new(ray);
        let hit =
            self.cloth.raycast(ray.vector(), ray.vector(), max_distance).map_err(to_js_error)?;
        let mut list = Writer::default();
        if let Some(hit) = hit {
            list.counts(&[hit.triangle, hit.particle]);
            list.numbers(&[hit.u, hit.v, hit.distance]);
            list.vector(hit.position);
            list.vector(hit.normal);
        }
        Ok(list.0)
    }

    /// Grabs a particle, and returns the number of the grab.
    pub fn grab_particle(&mut self, particle: u32) -> Result<u32> {
        self.cloth.grab_particle(particle).map(Grab::to_bits).map_err(to_js_error)
    }

    /// Grabs the particle that a ray points at. Returns the number of the grab and the position of
    /// the particle; an empty list if there is none. `ray` holds the origin and the direction.
    pub fn grab_ray(&mut self, ray: &[f64], radius: f32) -> Result<Vec<f64>> {
        let mut ray = Reader::new(ray);
        let grabbed =
            self.cloth.grab_ray(ray.vector(), ray.vector(), radius).map_err(to_js_error)?;
        let mut list = Writer::default();
        if let Some((grab, position)) = grabbed {
            list.count(grab.to_bits());
            list.vector(position);
        }
        Ok(list.0)
    }

    /// Sets the target of a grab [m].
    pub fn move_grab(&mut self, grab: u32, x: f32, y: f32, z: f32) -> Result<()> {
        self.cloth.move_grab(Grab::from_bits(grab), Vec3::new(x, y, z)).map_err(to_js_error)
    }

    /// Ends a grab.
    pub fn release(&mut self, grab: u32) -> Result<()> {
        self.cloth.release(Grab::from_bits(grab)).map_err(to_js_error)
    }
}
