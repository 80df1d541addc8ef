//! Colliders: bodies that the cloth collides with.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing::{self, Reader, Writer};
use muslin::{Collider, ColliderDesc, Shape};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Adds a collider, and returns its number. `desc` is in the order of `default_collider`.
    pub fn add_collider(
        &mut self,
        desc: &[f64],
        positions: &[f32],
        indices: &[u32],
        heights: &[f32],
    ) -> Result<u32> {
        let mut list = Reader::new(desc);
        let desc = ColliderDesc {
            shape: Shape::from_number(list.count()).map_err(to_js_error)?,
            position: list.vector(),
            rotation: list.rotation(),
            friction: list.number(),
            restitution: list.number(),
            tangential_restitution: list.number(),
            thickness: list.number(),
            radius: list.number(),
            top_radius: list.number(),
            half_height: list.number(),
            half_extents: list.vector(),
            spacing: list.number(),
            columns: list.count(),
            rows: list.count(),
            solid: list.number(),
            positions: packing::to_vectors(positions),
            indices: indices.to_vec(),
            heights: heights.to_vec(),
        };
        self.cloth.add_collider(&desc).map(Collider::to_bits).map_err(to_js_error)
    }

    /// Moves a collider over the ticks of the next `advance`. `pose` holds its position and
    /// rotation.
    pub fn move_collider(&mut self, collider: u32, pose: &[f64]) -> Result<()> {
        let (position, rotation) = packing::to_pose(pose);
        let collider = Collider::from_bits(collider);
        self.cloth.move_collider(collider, position, rotation).map_err(to_js_error)
    }

    /// Moves a collider at once, without a sweep. `pose` holds its position and rotation.
    pub fn teleport_collider(&mut self, collider: u32, pose: &[f64]) -> Result<()> {
        let (position, rotation) = packing::to_pose(pose);
        let collider = Collider::from_bits(collider);
        self.cloth.teleport_collider(collider, position, rotation).map_err(to_js_error)
    }

    /// Returns where a collider is after the last tick: position and rotation.
    pub fn collider_pose(&self, collider: u32) -> Result<Vec<f64>> {
        let collider = Collider::from_bits(collider);
        let (position, rotation) = self.cloth.collider_pose(collider).map_err(to_js_error)?;
        let mut list = Writer::default();
        list.vector(position);
        list.numbers(&rotation.to_array());
        Ok(list.0)
    }

    /// Removes a collider.
    pub fn remove_collider(&mut self, collider: u32) -> Result<()> {
        self.cloth.remove_collider(Collider::from_bits(collider)).map_err(to_js_error)
    }

    /// Returns the impulse on a collider in the last tick: momentum [kg m/s], then angular
    /// momentum about its position [kg m²/s].
    pub fn collider_impulse(&self, collider: u32) -> Result<Vec<f64>> {
        let collider = Collider::from_bits(collider);
        let impulse = self.cloth.collider_impulse(collider).map_err(to_js_error)?;
        let mut list = Writer::default();
        list.vector(impulse.linear);
        list.vector(impulse.angular);
        Ok(list.0)
    }
}
