//! The momentum that a free cloth should have at the end of a substep, as `impact_momentum` stores it
//! in the scratch of a tick.
//!
//! Reads and writes only its own fields.
//! Invariant: vectors are in world space, relative to the origin of the cloth.

use glam::Vec3;

/// Momenta that a cloth should have at the end of a substep, before the impulses of colliders.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExpectedMomentum {
    pub mass: f32,
    /// The centre of mass at the start [m].
    pub center: Vec3,
    pub linear: Vec3,
    /// The angular momentum about the centre of mass.
    pub spin: Vec3,
    /// The linear momentum in the middle of the substep, with gravity alone.
    pub mean_momentum: Vec3,
}
