//! The positions that the strain limit falls back to.
//!
//! Written by `rollback::compute`, read by `strain_limit`.
//! Invariant: has capacity for all particles that tears may still make, so that no tick allocates.

use crate::math::columns::Columns;

/// The rollback position of each particle [m].
#[derive(Clone, Debug, Default)]
pub(crate) struct RollbackState {
    pub positions: Columns,
    /// Where the particles were before the rollback [m].
    pub before: Columns,
}

impl RollbackState {
    /// Allocates a buffer for `particles` particles.
    pub fn with_capacity(particles: usize) -> Self {
        let [positions, before] = [0; 2].map(|_| Columns::with_capacity(particles));
        Self { positions, before }
    }
}
