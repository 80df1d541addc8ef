//! The frame of the body that wears the cloth, and its inertia.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Sets the pose of the frame and moves nothing. `pose` holds its position and rotation.
    pub fn set_frame(&mut self, pose: &[f64]) -> Result<()> {
        let (position, rotation) = packing::to_pose(pose);
        self.cloth.set_frame(position, rotation).map_err(to_js_error)
    }

    /// Moves the cloth with the frame at once, as a rigid body.
    pub fn teleport(&mut self, pose: &[f64]) -> Result<()> {
        let (position, rotation) = packing::to_pose(pose);
        self.cloth.teleport(position, rotation).map_err(to_js_error)
    }

    /// Moves the frame over the ticks of the next `advance`; the cloth feels the share
    /// `inertia` of the motion.
    pub fn move_frame(&mut self, pose: &[f64], inertia: f64) -> Result<()> {
        let (position, rotation) = packing::to_pose(pose);
        self.cloth.move_frame(position, rotation, inertia as f32).map_err(to_js_error)
    }
}
