//! What became of a mesh when a cloth was made of it.

use serde::{Deserialize, Serialize};

/// What had to be repaired of a mesh before it could be cloth, and what it is now.
///
/// Repairs come in this order: vertices are welded, triangles without an area and repeated ones are
/// dropped, edges and vertices where more than one sheet meets are split, triangles that face the other
/// way are turned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MeshReport {
    /// Vertices that were given.
    pub vertices: u32,
    /// Triangles that were given.
    pub triangles: u32,
    /// Particles that came of it.
    pub particles: u32,
    /// Triangles that were kept.
    pub kept_triangles: u32,
    /// Vertices that joined another one's particle.
    pub welded_vertices: u32,
    /// Triangles that were dropped: they had no area, or named a vertex twice.
    pub dropped_degenerate: u32,
    /// Triangles that were dropped: an earlier one has the same corners.
    pub dropped_duplicates: u32,
    /// Triangles that were turned round, so that they face as their neighbours do.
    pub turned_triangles: u32,
    /// Edges that had more than two triangles.
    pub split_edges: u32,
    /// Particles that came to be where sheets were parted that met at such an edge or at a mere point.
    pub split_vertices: u32,
    /// Vertices that no triangle uses. They are particles without mass that stay where they are, unless
    /// they were welded.
    pub unused_vertices: u32,
    /// Pieces: sets of triangles joined by edges.
    pub pieces: u32,
    /// Pieces that have no two sides, such as a Möbius strip: a line across them is left where neighbours
    /// face opposite ways.
    pub one_sided_pieces: u32,
    /// Whether it is woven as the regular grid that it was found to be.
    pub is_grid: bool,
}

impl MeshReport {
    /// Whether nothing had to be repaired.
    pub fn is_clean(&self) -> bool {
        let repairs = [
            self.welded_vertices,
            self.dropped_degenerate,
            self.dropped_duplicates,
            self.turned_triangles,
            self.split_edges,
            self.split_vertices,
        ];
        repairs.iter().all(|count| *count == 0)
    }
}
