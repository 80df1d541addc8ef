//! Report of the mesh repair at creation.

use serde::{Deserialize, Serialize};

/// What the repair changed when a cloth was made from a mesh.
///
/// The repairs run in this order: weld vertices, remove degenerate and duplicate triangles, split
/// non-manifold edges and vertices, orient triangles consistently.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MeshReport {
    /// Number of given vertices.
    pub vertices: u32,
    /// Number of given triangles.
    pub triangles: u32,
    /// Number of particles after the repair.
    pub particles: u32,
    /// Number of triangles after the repair.
    pub kept_triangles: u32,
    /// Vertices that were welded to another vertex and share its particle.
    pub welded_vertices: u32,
    /// Removed triangles that have no area or name a vertex twice.
    pub dropped_degenerate: u32,
    /// Removed triangles that have the same three corners as an earlier one.
    pub dropped_duplicates: u32,
    /// Triangles whose winding was reversed to match their neighbours.
    pub turned_triangles: u32,
    /// Non-manifold edges (more than two triangles) that were split.
    pub split_edges: u32,
    /// Particles added by splitting non-manifold edges and vertices.
    pub split_vertices: u32,
    /// Vertices that no kept triangle uses. Each is a particle without mass that does not move,
    /// unless it was welded.
    pub unused_vertices: u32,
    /// Number of pieces: sets of triangles connected through edges.
    pub pieces: u32,
    /// Number of non-orientable pieces, such as a Möbius strip. Each keeps a line of edges across
    /// which the windings differ.
    pub one_sided_pieces: u32,
    /// Whether the mesh is a regular grid, so that the cloth uses the faster grid solver.
    pub is_grid: bool,
}

impl MeshReport {
    /// Returns whether the mesh needed no repair.
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
