//! What a renderer must upload again.

use muslin_core::Changes;

/// The parts of a cloth's lists that changed with its triangles since some revision: of what does not
/// change with every tick, as texture coordinates, source vertices and frayed borders. Begin with
/// muslin_changes_init.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct MuslinChanges {
    /// Set by muslin_changes_init.
    pub struct_size: u32,
    /// The first vertex that is new or not as it was.
    pub first_vertex: u32,
    /// How many vertices from there on.
    pub vertex_count: u32,
    /// The first index that is new or not as it was.
    pub first_index: u32,
    /// How many indices from there on.
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
