//! Attachments: particles that a moving transform carries.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing;
use muslin::Attachment;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Attaches particles to a transform, and returns the number of the attachment. `pose` holds
    /// the position and rotation of the transform.
    pub fn attach(&mut self, particles: &[u32], pose: &[f64]) -> Result<u32> {
        let (position, rotation) = packing::to_pose(pose);
        self.cloth
            .attach(particles, position, rotation)
            .map(Attachment::to_bits)
            .map_err(to_js_error)
    }

    /// Moves the transform of an attachment over the ticks of the next `advance`. `pose` holds
    /// its position and rotation.
    pub fn move_attachment(&mut self, attachment: u32, pose: &[f64]) -> Result<()> {
        let (position, rotation) = packing::to_pose(pose);
        let attachment = Attachment::from_bits(attachment);
        self.cloth.move_attachment(attachment, position, rotation).map_err(to_js_error)
    }

    /// Removes an attachment and the pins of its particles.
    pub fn detach(&mut self, attachment: u32) -> Result<()> {
        self.cloth.detach(Attachment::from_bits(attachment)).map_err(to_js_error)
    }

    /// Returns the particles of an attachment in ascending order.
    pub fn attached(&self, attachment: u32) -> Result<Vec<u32>> {
        let attached = self.cloth.attached(Attachment::from_bits(attachment));
        attached.map(Iterator::collect).map_err(to_js_error)
    }
}
