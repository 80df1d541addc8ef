//! Result of a ray cast.

use super::value::MuslinVec3;
use muslin_core::Hit;

/// Where a ray hits a cloth. Initialise it with muslin_hit_init.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct MuslinHit {
    /// Set by muslin_hit_init.
    pub struct_size: u32,
    /// Triangle that was hit: its corners are the indices 3 * triangle and the two after it.
    pub triangle: u32,
    /// Corner particle nearest to the hit.
    pub particle: u32,
    /// Barycentric weight of the triangle's second corner.
    pub u: f32,
    /// Barycentric weight of the triangle's third corner.
    pub v: f32,
    /// Distance from the ray's origin [m].
    pub distance: f32,
    /// Point of the hit [m].
    pub position: MuslinVec3,
    /// Unit normal of the triangle, on the side that was hit.
    pub normal: MuslinVec3,
}

impl From<Hit> for MuslinHit {
    fn from(hit: Hit) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            triangle: hit.triangle,
            particle: hit.particle,
            u: hit.u,
            v: hit.v,
            distance: hit.distance,
            position: hit.position.into(),
            normal: hit.normal.into(),
        }
    }
}
