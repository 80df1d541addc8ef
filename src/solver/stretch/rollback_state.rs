//! The positions that the strain limit falls back to.
//!
//! Written by `rollback::compute`, read by `strain_limit`.
//! Invariant: has capacity for all particles that tears may still make, so that no tick allocates.

use crate::math::columns::Columns;

/// The rollback position of each particle [m].
#[derive(Clone, Debug, Default)]
pub(crate) struct RollbackState {
    pub positions: Columns,
    /// The positions before the rollback [m]; allocated with the first collider.
    pub before: Columns,
}
