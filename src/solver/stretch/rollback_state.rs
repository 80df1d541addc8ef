//! The positions that the strain limit falls back to.
//!
//! Written by `rollback::compute`, read by `strain_limit`.
//! Invariant: has capacity for all particles that tears may still make, so that no tick allocates.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;

/// The rollback position of each particle [m].
#[derive(Clone, Debug, Default)]
pub(crate) struct RollbackState {
    pub positions: Columns,
    /// The positions before the rollback [m]; allocated with the first collider.
    pub before: Columns,
}

heap_bytes!(RollbackState { positions, before } plain {});
