//! A contact.

use glam::Vec3;

/// A particle that touched a collider in a substep, by itself or as a corner of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ColliderContact {
    pub particle: u32,
    /// The number of the collider among the live ones.
    pub body: u32,
    /// How much of what touched is the particle's: 1, if it is the particle itself.
    pub share: f32,
    /// Out of the collider.
    pub normal: Vec3,
    pub surface_velocity: Vec3,
    /// Its velocity before it touched [m/s].
    pub approach: Vec3,
    /// How it was pushed [m].
    pub push: Vec3,
    pub restitution: f32,
    pub tangential_restitution: f32,
}

impl ColliderContact {
    /// Whether it is between this particle and this collider.
    pub fn is_of(&self, particle: usize, body: u32) -> bool {
        self.particle as usize == particle && self.body == body
    }
}
