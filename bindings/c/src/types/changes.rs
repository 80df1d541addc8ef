//! Ranges of the output lists that changed.

use muslin_core::Changes;

/// Ranges of a cloth's output lists that changed since a topology revision: what a renderer must
/// upload again. Initialise it with muslin_changes_init.
///
/// The vertex range concerns the attributes that stay constant between topology changes: texture
/// coordinates, source vertices, particles and frayed borders. Positions and normals change with
/// every tick.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct MuslinChanges {
    /// Set by muslin_changes_init.
    pub struct_size: u32,
    /// First changed vertex; 0 if there is none.
    pub first_vertex: u32,
    /// Number of vertices in the changed range.
    pub vertex_count: u32,
    /// First changed index; 0 if there is none.
    pub first_index: u32,
    /// Number of indices in the changed range.
    pub index_count: u32,
}

impl From<Changes> for MuslinChanges {
    fn from(changes: Changes) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            first_vertex: changes.first_vertex,
            vertex_count: changes.vertex_count,
            first_index: changes.first_index,
            index_count: changes.index_count,
        }
    }
}
