//! Clothes on bodies: attachments, soft pins, leashes, masses, and jumps.

use crate::RawCloth;
use crate::numbers::{self, Reader};
use crate::refusal::{Result, refusal};
use muslin::Attachment;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Attaches particles to a transform; `pose` is its position and rotation. Gives the attachment's number.
    pub fn attach(&mut self, particles: &[u32], pose: &[f64]) -> Result<u32> {
        let mut pose = Reader::new(pose);
        let (position, rotation) = (pose.vector(), pose.rotation());
        self.cloth.attach(particles, position, rotation).map(Attachment::to_bits).map_err(refusal)
    }

    /// Moves a transform that particles are attached to.
    pub fn move_attachment(&mut self, attachment: u32, pose: &[f64]) -> Result<()> {
        let mut pose = Reader::new(pose);
        let (position, rotation) = (pose.vector(), pose.rotation());
        let attachment = Attachment::from_bits(attachment);
        self.cloth.move_attachment(attachment, position, rotation).map_err(refusal)
    }

    /// Lets all go that an attachment carries.
    pub fn detach(&mut self, attachment: u32) -> Result<()> {
        self.cloth.detach(Attachment::from_bits(attachment)).map_err(refusal)
    }

    /// The particles that an attachment carries, lowest first.
    pub fn attached(&self, attachment: u32) -> Result<Vec<u32>> {
        let attached = self.cloth.attached(Attachment::from_bits(attachment));
        attached.map(Iterator::collect).map_err(refusal)
    }

    /// Says how hard pins pull.
    pub fn set_pin_stiffness(&mut self, particles: &[u32], stiffness: f32) -> Result<()> {
        self.cloth.set_pin_stiffness(particles, stiffness).map_err(refusal)
    }

    /// Makes particles heavier or lighter.
    pub fn set_mass_scales(&mut self, particles: &[u32], scales: &[f32]) -> Result<()> {
        self.cloth.set_mass_scales(particles, scales).map_err(refusal)
    }

    /// Says how far particles may be from their anchors.
    pub fn set_max_distances(&mut self, particles: &[u32], distances: &[f32]) -> Result<()> {
        self.cloth.set_max_distances(particles, distances).map_err(refusal)
    }

    /// Gives particles backstops.
    pub fn set_backstops(
        &mut self,
        particles: &[u32],
        distances: &[f32],
        radii: &[f32],
    ) -> Result<()> {
        self.cloth.set_backstops(particles, distances, radii).map_err(refusal)
    }

    /// Says where animation has particles.
    pub fn set_anchors(
        &mut self,
        particles: &[u32],
        positions: &[f32],
        normals: &[f32],
    ) -> Result<()> {
        let (positions, normals) = (numbers::vectors(positions), numbers::vectors(normals));
        self.cloth.set_anchors(particles, &positions, &normals).map_err(refusal)
    }

    /// Takes away all anchors, maximum distances and backstops.
    pub fn clear_leashes(&mut self) {
        self.cloth.clear_leashes();
    }

    /// Says where the body is that wears the cloth; `pose` is its position and rotation.
    pub fn set_frame(&mut self, pose: &[f64]) -> Result<()> {
        let mut pose = Reader::new(pose);
        self.cloth.set_frame(pose.vector(), pose.rotation()).map_err(refusal)
    }

    /// Takes the cloth along as that body jumps.
    pub fn teleport(&mut self, pose: &[f64]) -> Result<()> {
        let mut pose = Reader::new(pose);
        self.cloth.teleport(pose.vector(), pose.rotation()).map_err(refusal)
    }

    /// Takes the cloth along as that body runs on, with a share of its inertia.
    pub fn move_frame(&mut self, pose: &[f64], inertia: f64) -> Result<()> {
        let mut pose = Reader::new(pose);
        let (position, rotation) = (pose.vector(), pose.rotation());
        self.cloth.move_frame(position, rotation, inertia as f32).map_err(refusal)
    }
}
