//! Allocation of lists for a total number of entries.
//!
//! The standard library reserves for additional entries. Here lists are allocated once for all that
//! they will ever hold, in one function per type of entry, which keeps the WebAssembly module small.
//!
//! Reads and writes only the list.
//! Invariant: the entries stay as they are.

/// Lists that are allocated once.
pub(crate) trait ReserveTotal {
    /// Allocates for `count` entries in all, and not for more.
    fn reserve_total(&mut self, count: usize);
}

impl<T> ReserveTotal for Vec<T> {
    #[inline(never)]
    fn reserve_total(&mut self, count: usize) {
        self.reserve_exact(count.saturating_sub(self.len()));
    }
}

/// Returns a list of `count` zeros. One function for all callers keeps the WebAssembly module small.
#[inline(never)]
pub(crate) fn zeros(count: usize) -> Vec<f32> {
    vec![0.0; count]
}
