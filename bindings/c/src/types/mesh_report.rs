//! What became of a mesh.

use muslin_core::MeshReport;

/// What had to be repaired of a mesh before it could be cloth, and what it is now. Begin with
/// muslin_mesh_report_init.
///
/// Repairs come in this order: vertices are welded, triangles without an area and repeated ones are dropped,
/// edges and vertices where more than one sheet meets are split, triangles that face the other way are turned.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct MuslinMeshReport {
    /// Set by muslin_mesh_report_init.
    pub struct_size: u32,
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
    /// Vertices that no triangle uses. They are particles without mass that stay where they are, unless they
    /// were welded.
    pub unused_vertices: u32,
    /// Pieces: sets of triangles joined by edges.
    pub pieces: u32,
    /// Pieces that have no two sides, such as a Moebius strip: a line across them is left where neighbours face
    /// opposite ways.
    pub one_sided_pieces: u32,
    /// 1 if it is woven as the regular grid that it was found to be; 0.
    pub is_grid: u32,
}

impl From<&MeshReport> for MuslinMeshReport {
    fn from(report: &MeshReport) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            vertices: report.vertices,
            triangles: report.triangles,
            particles: report.particles,
            kept_triangles: report.kept_triangles,
            welded_vertices: report.welded_vertices,
            dropped_degenerate: report.dropped_degenerate,
            dropped_duplicates: report.dropped_duplicates,
            turned_triangles: report.turned_triangles,
            split_edges: report.split_edges,
            split_vertices: report.split_vertices,
            unused_vertices: report.unused_vertices,
            pieces: report.pieces,
            one_sided_pieces: report.one_sided_pieces,
            is_grid: u32::from(report.is_grid),
        }
    }
}
