//! History of topology changes: which vertex and index ranges each tear or cut changed.
//!
//! Reads the output lists before and after a change; [`Cloth::changes`](crate::Cloth::changes)
//! merges the ranges since a given revision.
//! Invariant: the history ends with the change that led to the current topology revision.

use crate::math::heap_bytes::HeapBytes;
use crate::math::reserve::ReserveTotal;
use core::ops::Range;

/// Number of changes that are kept.
const CAPACITY: usize = 64;

/// The ranges of vertices and indices that one topology change changed.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChangedRanges {
    pub vertices: Range<u32>,
    pub indices: Range<u32>,
}

/// The latest changes, oldest first. A full history drops its oldest change.
#[derive(Debug)]
pub(crate) struct ChangeHistory {
    pub last: Vec<ChangedRanges>,
}

impl HeapBytes for ChangeHistory {
    fn heap_bytes(&self) -> usize {
        size_of::<ChangedRanges>() * self.last.capacity()
    }
}

impl ChangeHistory {
    /// Makes an empty history, allocated for a cloth that can tear.
    pub fn new(can_tear: bool) -> Self {
        Self { last: Vec::with_capacity(if can_tear { CAPACITY } else { 0 }) }
    }

    /// Allocates the full capacity.
    pub fn reserve(&mut self) {
        self.last.reserve_total(CAPACITY);
    }

    /// Appends a change; drops the oldest one if the history is full.
    pub fn push(&mut self, change: ChangedRanges) {
        if self.last.len() == CAPACITY {
            self.last.remove(0);
        }
        self.last.push(change);
    }
}

impl Clone for ChangeHistory {
    /// Clones the content and allocates the full capacity again, if this history has it.
    fn clone(&self) -> Self {
        let mut copy = Self::new(self.last.capacity() >= CAPACITY);
        copy.last.extend_from_slice(&self.last);
        copy
    }
}

impl ChangedRanges {
    /// Extends the vertex range so that it includes `vertices`.
    pub fn include_vertices(self, vertices: Range<u32>) -> Self {
        self.union(&Self { vertices, ..Self::default() })
    }

    /// Returns the smallest ranges that include both changes.
    pub fn union(self, other: &Self) -> Self {
        let union = |a: Range<u32>, b: &Range<u32>| match (a.is_empty(), b.is_empty()) {
            (true, _) => b.clone(),
            (_, true) => a,
            _ => a.start.min(b.start)..a.end.max(b.end),
        };
        Self {
            vertices: union(self.vertices, &other.vertices),
            indices: union(self.indices, &other.indices),
        }
    }
}

/// Returns the range of `new` from the first to the last entry that differs from `old`.
pub(crate) fn changed_range<T: PartialEq>(old: &[T], new: &[T]) -> Range<u32> {
    let same = old.iter().zip(new).take_while(|(old, new)| old == new).count();
    let common = old.len().min(new.len());
    let end = if new.len() > old.len() {
        new.len()
    } else {
        (same..common).rev().find(|at| old[*at] != new[*at]).map_or(same, |at| at + 1)
    };
    same as u32..end as u32
}
