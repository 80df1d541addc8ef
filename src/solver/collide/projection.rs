//! How stages that moved particles themselves push the cloth out of colliders again, and how fast it
//! comes out.
//!
//! Reads and writes nothing.

/// The largest speed at which cloth that started inside a shape comes out [m/s]. A larger speed
/// would overstretch the cloth around it and fling it away.
pub(super) const MAX_DEPENETRATION_SPEED: f32 = 0.05;

/// The fraction of the contact gap that the last projections restore.
pub(crate) const PROJECTION_GAP: f32 = 0.5;

/// What a projection pushes out of colliders, without friction and restitution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Projection {
    /// Particles, as far as the whole contact gap.
    Particles,
    /// Particles and triangles, as far as a part of the gap. The next substep restores the whole;
    /// demanding it at once would let constraints alternate more often.
    Surface,
}

impl Projection {
    /// Returns the fraction of the contact gap that is restored.
    pub fn gap_share(self) -> f32 {
        if self == Self::Particles { 1.0 } else { PROJECTION_GAP }
    }
}
