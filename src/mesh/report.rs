//! Report of the mesh repair at creation, and of the quality of the mesh.

use serde::{Deserialize, Serialize};

/// Aspect ratio above which a triangle counts as thin.
pub(super) const THIN_ASPECT: f64 = 100.0;
/// What a thin triangle has.
const THIN: &str = "a height under a hundredth of the longest edge";
/// Share of the mean edge below which an edge counts as short.
const SHORT_EDGE: f32 = 0.01;

/// What the repair changed when a cloth was made from a mesh, and the quality of the result.
///
/// The repairs run in this order: weld vertices, remove degenerate and duplicate triangles, split
/// non-manifold edges and vertices, orient triangles consistently, collapse short edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
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
    /// Edges below [`MeshDesc::simplify_below`](crate::MeshDesc) that were collapsed; each removed a
    /// particle.
    pub collapsed_edges: u32,
    /// Triangles that were removed with collapsed edges.
    pub collapsed_triangles: u32,
    /// Triangles that were removed at a border because they were lower than
    /// [`MeshDesc::simplify_below`](crate::MeshDesc).
    pub trimmed_triangles: u32,
    /// Edges that were flipped because a triangle was lower than
    /// [`MeshDesc::simplify_below`](crate::MeshDesc).
    pub flipped_edges: u32,
    /// Edges that are still shorter than [`MeshDesc::simplify_below`](crate::MeshDesc): to collapse
    /// them would change the topology, a border, a seam or a pin, or would turn a triangle over.
    pub short_edges: u32,
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
            self.collapsed_edges,
            self.flipped_edges,
            self.trimmed_triangles,
        ];
        repairs.iter().all(|count| *count == 0)
    }

    /// Returns a sentence for each property of the mesh that its author should know of: what was
    /// removed or split, and what makes the cloth slow or uneven. Empty for a good mesh.
    ///
    /// ```
    /// use muslin::MeshReport;
    ///
    /// let report =
    ///     MeshReport { thin_triangles: 37, thinnest_triangle: 41, ..MeshReport::default() };
    /// assert_eq!(
    ///     report.warnings(),
    ///     ["37 triangles have a height under a hundredth of the longest edge; \
    ///       the thinnest is triangle 41"]
    /// );
    /// ```
    pub fn warnings(&self) -> Vec<String> {
        let counted = [
            (
                self.dropped_degenerate,
                "triangle was",
                "triangles were",
                "removed for lack of an area",
            ),
            (
                self.split_edges,
                "edge was",
                "edges were",
                "split: more than two triangles met there",
            ),
            (self.one_sided_pieces, "piece has", "pieces have", "one side only"),
            (self.unused_vertices, "vertex is", "vertices are", "in no triangle"),
            (self.short_edges, "edge is", "edges are", "shorter than `simplify_below`"),
            (self.thin_triangles, "triangle has", "triangles have", THIN),
        ];
        let mut warnings = Vec::new();
        for (count, one, many, rest) in counted {
            if count > 0 {
                warnings.push(format!("{count} {} {rest}", if count == 1 { one } else { many }));
            }
        }
        if let (1.., Some(last)) = (self.thin_triangles, warnings.last_mut()) {
            *last += &format!("; the thinnest is triangle {}", self.thinnest_triangle);
        }
        if self.shortest_edge < SHORT_EDGE * self.mean_edge {
            warnings.push("the shortest edge is under a hundredth of the mean edge".into());
        }
        warnings
    }
}
