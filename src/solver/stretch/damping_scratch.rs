//! Copies of the links' rest lengths and compliances while stretch damping replaces them.
//!
//! Written by `damping::apply` at the start of a substep, read by `damping::remove` at its end.
//! Invariant: has capacity for all links that tears may still add, so that no tick allocates.

use crate::math::column::Column;
use crate::math::heap_bytes::heap_bytes;

/// Rest lengths and compliances without damping: of the links, then of the dynamic links.
#[derive(Clone, Debug, Default)]
pub(crate) struct DampingScratch {
    pub undamped: [[Column; 2]; 2],
}

heap_bytes!(DampingScratch { undamped } plain {});

impl DampingScratch {
    /// Allocates columns for `links` links and `dynamic` dynamic links.
    pub fn new(links: usize, dynamic: usize) -> Self {
        let columns = |count: usize| [Column::with_capacity(count), Column::with_capacity(count)];
        Self { undamped: [columns(links), columns(dynamic)] }
    }
}
