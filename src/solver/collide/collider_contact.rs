//! A contact between a particle and a collider, as the velocity pass needs it.
//!
//! Reads and writes only its own fields. The position pass fills the list, one entry per pair of
//! particle and collider; `response` turns it into velocities and impulses.
//! Invariant: vectors are in world space.

use glam::Vec3;

/// A particle that touched a collider in a substep, by itself or as a corner of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ColliderContact {
    pub particle: u32,
    /// The index of the collider among the live ones.
    pub body: u32,
    /// The barycentric weight of the particle in the contact point, in 0..=1: 1 for the particle
    /// itself.
    pub weight: f32,
    /// The outward normal of the collider, of length one.
    pub normal: Vec3,
    /// The velocity of the collider at the contact [m/s].
    pub surface_velocity: Vec3,
    /// The velocity of the particle before the contact [m/s].
    pub approach_velocity: Vec3,
    /// The sum of all position corrections of the substep [m].
    pub correction: Vec3,
    /// The distance that the particle keeps from the collider [m].
    pub gap: f32,
    /// The distance from the collider, if another one pushes the particle towards it [m].
    pub distance: f32,
    /// Where the particle was along the normal after the position pass [m].
    pub height: f32,
    /// How far surface collision pushed it along the normal [m].
    pub pushed: f32,
    /// The coefficient of friction.
    pub friction: f32,
    pub restitution: f32,
    pub tangential_restitution: f32,
}

impl ColliderContact {
    /// Returns whether the contact is between this particle and this collider.
    pub fn is_between(&self, particle: usize, body: u32) -> bool {
        self.particle as usize == particle && self.body == body
    }
}
