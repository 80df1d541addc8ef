//! What a renderer must upload again: the parts of its lists that tears and cuts changed.

use crate::cloth::Cloth;
use core::ops::Range;

/// The parts of a cloth's lists that changed with its triangles since some revision.
///
/// What is told per vertex is that which stays from tick to tick: texture coordinates, source vertices and
/// frayed borders. Positions and normals change with every tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// The first vertex that is new or not as it was.
    pub first_vertex: u32,
    /// How many vertices from there on.
    pub vertex_count: u32,
    /// The first index that is new or not as it was.
    pub first_index: u32,
    /// How many indices from there on.
    pub index_count: u32,
}

/// How many changes of the triangles are remembered.
const REMEMBERED: usize = 64;

/// What one change of the triangles changed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Change {
    pub vertices: Range<u32>,
    pub indices: Range<u32>,
}

/// The last changes, the newest at the end; older ones fall out.
#[derive(Debug)]
pub(crate) struct History {
    last: Vec<Change>,
}

impl History {
    pub fn new() -> Self {
        Self { last: Vec::with_capacity(REMEMBERED) }
    }

    pub fn push(&mut self, change: Change) {
        if self.last.len() == REMEMBERED {
            self.last.remove(0);
        }
        self.last.push(change);
    }
}

impl Clone for History {
    /// With room for as many.
    fn clone(&self) -> Self {
        let mut copy = Self::new();
        copy.last.extend_from_slice(&self.last);
        copy
    }
}

impl Change {
    /// This, and a change of more vertices.
    pub fn and_vertices(self, vertices: Range<u32>) -> Self {
        self.with(&Self { vertices, ..Self::default() })
    }

    /// This and another change.
    fn with(self, other: &Self) -> Self {
        let both = |a: Range<u32>, b: &Range<u32>| match (a.is_empty(), b.is_empty()) {
            (true, _) => b.clone(),
            (_, true) => a,
            _ => a.start.min(b.start)..a.end.max(b.end),
        };
        Self {
            vertices: both(self.vertices, &other.vertices),
            indices: both(self.indices, &other.indices),
        }
    }
}

/// From the first to the last entry that is not as it was.
pub(crate) fn differing<T: PartialEq>(old: &[T], new: &[T]) -> Range<u32> {
    let same = old.iter().zip(new).take_while(|(old, new)| old == new).count();
    let common = old.len().min(new.len());
    let end = if new.len() > old.len() {
        new.len()
    } else {
        (same..common).rev().find(|at| old[*at] != new[*at]).map_or(same, |at| at + 1)
    };
    same as u32..end as u32
}

impl Cloth {
    /// Which vertices and indices are new or not as they were when [`Cloth::topology_revision`] was
    /// `since_topology_revision`: all that a renderer must upload again of what does not change with
    /// every tick. Everything, if that is more than 64 changes ago, or was never (0 is never).
    pub fn changes(&self, since_topology_revision: u32) -> Changes {
        let age = self.topology_revision.wrapping_sub(since_topology_revision) as usize;
        let (vertices, indices) = (self.outputs.vertex_count(), self.indices().len() as u32);
        let last = &self.history.last;
        let change = match last.len().checked_sub(age) {
            None => Change { vertices: 0..vertices, indices: 0..indices },
            Some(first) => last[first..].iter().fold(Change::default(), Change::with),
        };
        // A cloth that was reset has fewer than it once had.
        let length =
            |range: &Range<u32>, most: u32| range.end.min(most).saturating_sub(range.start);
        let (vertex_count, index_count) =
            (length(&change.vertices, vertices), length(&change.indices, indices));
        Changes {
            first_vertex: if vertex_count == 0 { 0 } else { change.vertices.start },
            vertex_count,
            first_index: if index_count == 0 { 0 } else { change.indices.start },
            index_count,
        }
    }
}
