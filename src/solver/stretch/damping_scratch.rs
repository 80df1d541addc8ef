//! Copies of the links' rest lengths and compliances while stretch damping replaces them.
//!
//! Written by `damping::apply` at the start of a substep, read by `damping::remove` at its end.
//! Invariant: has capacity for all links that tears may still add, so that no tick allocates.

use crate::math::column::Column;
use crate::math::heap_bytes::heap_bytes;

/// Rest lengths and compliances without damping: of the links, then of the dynamic links. Empty
/// without damping.
#[derive(Clone, Debug, Default)]
pub(crate) struct DampingScratch {
    pub undamped: [[Column; 2]; 2],
}

heap_bytes!(DampingScratch { undamped } plain {});

impl DampingScratch {
    /// Allocates for `links` links and `dynamic` dynamic links in all.
    pub fn reserve(&mut self, links: usize, dynamic: usize) {
        for (columns, count) in self.undamped.iter_mut().zip([links, dynamic]) {
            columns.iter_mut().for_each(|column| column.reserve(count));
        }
    }
}
