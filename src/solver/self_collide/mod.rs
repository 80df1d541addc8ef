//! Self-collision, by particles or by the surface.

pub(crate) mod particle_pairs;
pub(crate) mod surface;
