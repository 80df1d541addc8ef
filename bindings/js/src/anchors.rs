//! Anchors: animated targets of particles, with a maximum distance and a backstop.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Sets how far particles may be from their anchors [m].
    pub fn set_max_distances(&mut self, particles: &[u32], distances: &[f32]) -> Result<()> {
        self.cloth.set_max_distances(particles, distances).map_err(to_js_error)
    }

    /// Sets the backstop spheres of particles: distance behind the anchor and radius [m].
    pub fn set_backstops(
        &mut self,
        particles: &[u32],
        distances: &[f32],
        radii: &[f32],
    ) -> Result<()> {
        self.cloth.set_backstops(particles, distances, radii).map_err(to_js_error)
    }

    /// Sets the positions [m] and the outward normals of anchors. An empty list of normals keeps
    /// the previous ones.
    pub fn set_anchors(
        &mut self,
        particles: &[u32],
        positions: &[f32],
        normals: &[f32],
    ) -> Result<()> {
        let (positions, normals) = (packing::to_vectors(positions), packing::to_vectors(normals));
        self.cloth.set_anchors(particles, &positions, &normals).map_err(to_js_error)
    }

    /// Removes all anchors, maximum distances and backstops.
    pub fn clear_leashes(&mut self) {
        self.cloth.clear_leashes();
    }
}
