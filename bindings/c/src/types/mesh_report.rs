//! Report of a mesh repair and of mesh quality.

use muslin_core::MeshReport;

/// What was repaired in a mesh before it became cloth, and the quality of the result. Initialise it
/// with muslin_mesh_report_init.
///
/// Repairs are made in this order: vertices are welded; triangles without an area and repeated
/// triangles are dropped; edges and vertices where several sheets meet are split; triangles that
/// face the other way are turned; short edges are collapsed.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct MuslinMeshReport {
    /// Set by muslin_mesh_report_init.
    pub struct_size: u32,
    /// Number of given vertices.
    pub vertices: u32,
    /// Number of given triangles.
    pub triangles: u32,
    /// Number of resulting particles.
    pub particles: u32,
    /// Number of triangles that were kept.
    pub kept_triangles: u32,
    /// Number of vertices that share the particle of another vertex.
    pub welded_vertices: u32,
    /// Number of dropped triangles that had no area or used a vertex twice.
    pub dropped_degenerate: u32,
    /// Number of dropped triangles whose corners were those of an earlier one.
    pub dropped_duplicates: u32,
    /// Number of triangles that were turned to face as their neighbours do.
    pub turned_triangles: u32,
    /// Number of edges that had more than two triangles.
    pub split_edges: u32,
    /// Number of particles that were added where sheets met at such an edge or at a single vertex.
    pub split_vertices: u32,
    /// Number of vertices that no triangle uses. Unless they were welded, they are particles
    /// without mass that stay where they are.
    pub unused_vertices: u32,
    /// Number of pieces: sets of triangles connected by edges.
    pub pieces: u32,
    /// Number of pieces with only one side, such as a Moebius strip: along a line across them,
    /// neighbours face opposite ways.
    pub one_sided_pieces: u32,
    /// 1 if the mesh is simulated as a regular grid, else 0.
    pub is_grid: u32,
    /// Length of the shortest edge [m].
    pub shortest_edge: f32,
    /// Mean length of the edges [m].
    pub mean_edge: f32,
    /// Largest aspect ratio of a triangle: its longest edge divided by its least height. 1.15 with
    /// equal edges, 2 on a grid.
    pub worst_aspect: f32,
    /// Number of thin triangles: those with an aspect ratio above 100.
    pub thin_triangles: u32,
    /// The triangle with the largest aspect ratio, by its number among the given ones.
    pub thinnest_triangle: u32,
    /// Number of edges below `simplify_below` that were collapsed; each removed a particle.
    pub collapsed_edges: u32,
    /// Number of triangles that were removed with collapsed edges.
    pub collapsed_triangles: u32,
    /// Number of triangles that were removed at a border because they were lower than
    /// `simplify_below`.
    pub trimmed_triangles: u32,
    /// Number of edges that were flipped because a triangle was lower than `simplify_below`.
    pub flipped_edges: u32,
    /// Number of edges that are still shorter than `simplify_below`: to collapse them would change
    /// the topology, a border, a seam or a pin, or would turn a triangle over.
    pub short_edges: u32,
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
            shortest_edge: report.shortest_edge,
            mean_edge: report.mean_edge,
            worst_aspect: report.worst_aspect,
            thin_triangles: report.thin_triangles,
            thinnest_triangle: report.thinnest_triangle,
            collapsed_edges: report.collapsed_edges,
            collapsed_triangles: report.collapsed_triangles,
            trimmed_triangles: report.trimmed_triangles,
            flipped_edges: report.flipped_edges,
            short_edges: report.short_edges,
        }
    }
}
