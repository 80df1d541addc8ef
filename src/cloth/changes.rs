//! Partial uploads: which parts of the output lists a renderer must upload again after tears and
//! cuts.
//!
//! Reads `ChangeHistory`; returns [`Changes`].
//! Invariant: the result covers every attribute that does not change with each tick.

use crate::cloth::Cloth;
use crate::cloth::change_history::ChangedRanges;
use core::ops::Range;

/// Ranges of a cloth's output lists that changed since a topology revision.
///
/// The vertex range concerns the attributes that stay constant between topology changes: texture
/// coordinates, source vertices, particles and frayed borders. Positions and normals change with
/// every tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// First changed vertex; 0 if there is none.
    pub first_vertex: u32,
    /// Number of vertices in the changed range.
    pub vertex_count: u32,
    /// First changed index; 0 if there is none.
    pub first_index: u32,
    /// Number of indices in the changed range.
    pub index_count: u32,
}

impl Cloth {
    /// Returns the vertex and index ranges that changed after [`Cloth::topology_revision`] was
    /// `since_topology_revision`: what a renderer must upload again, besides positions and normals.
    ///
    /// Returns everything if that revision is more than 64 changes old or never existed; pass 0 for
    /// the first upload.
    ///
    /// ```
    /// use muslin::{Cloth, GridDesc};
    ///
    /// let mut cloth = Cloth::grid(&GridDesc::default())?;
    /// let uploaded = cloth.topology_revision();
    /// cloth.tear_edge(820, 821)?;
    /// let changes = cloth.changes(uploaded);
    /// let first = changes.first_index as usize;
    /// let indices = &cloth.indices()[first..first + changes.index_count as usize];
    /// assert!(!indices.is_empty()); // upload these
    /// # Ok::<(), muslin::Error>(())
    /// ```
    pub fn changes(&self, since_topology_revision: u32) -> Changes {
        let age = self.topology_revision.wrapping_sub(since_topology_revision) as usize;
        let (vertices, indices) = (self.outputs.vertex_count(), self.indices().len() as u32);
        let last = &self.history.last;
        let change = match last.len().checked_sub(age) {
            None => ChangedRanges { vertices: 0..vertices, indices: 0..indices },
            Some(first) => {
                last[first..].iter().fold(ChangedRanges::default(), ChangedRanges::union)
            }
        };
        // After a reset the lists may be shorter than a recorded range.
        let clamped_length =
            |range: &Range<u32>, count: u32| range.end.min(count).saturating_sub(range.start);
        let (vertex_count, index_count) =
            (clamped_length(&change.vertices, vertices), clamped_length(&change.indices, indices));
        Changes {
            first_vertex: if vertex_count == 0 { 0 } else { change.vertices.start },
            vertex_count,
            first_index: if index_count == 0 { 0 } else { change.indices.start },
            index_count,
        }
    }
}
