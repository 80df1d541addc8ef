//! Edge splits: insert a vertex on an edge and divide the triangle on either side.
//!
//! ```text
//!        opposite                     opposite
//!        ╱      ╲                     ╱   |   ╲
//!       ╱  kept  ╲         ─▶        ╱    |    ╲
//!      ╱          ╲                 ╱kept | added╲
//!   near ───────── far           near ── new ──── far
//! ```
//! A cut splits every edge that the blade crosses, one after the other. Where the blade crosses two
//! edges of a triangle, the second split creates an edge along the blade. `open_edges` then opens
//! the edges along the blade.
//!
//! Reads and writes the `Mesh` only; `seams` and `model::cut_links` apply the returned `EdgeSplit`
//! to render vertices and links.
//!
//! Invariant: adjacency stays valid after each split; `corner_of` is valid again after
//! `rebuild_vertex_corners`.

use crate::math::sort::sort;
use crate::mesh::split_vertex::OpenedEdge;
use crate::mesh::{Corner, Fan, Mesh, NONE, next_corner, prev_corner, triangle_of};
use core::ops::{Add, Mul, Sub};
use serde::{Deserialize, Serialize};

/// A site that a cut created, between two older sites.
///
/// A site is a point of the rest shape. The original vertices are the first sites, the sites
/// created by cuts follow in order. Every vertex belongs to one site; vertices that were split from
/// each other share it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct CutSite {
    /// The two sites.
    pub ends: [u32; 2],
    /// Position between them: 0 is the first, 1 the second; 0 < `fraction` < 1.
    pub fraction: f32,
}

impl CutSite {
    /// The nearer of the two ends; the first if both are equally near.
    pub fn nearest_end(&self) -> u32 {
        self.ends[usize::from(self.fraction > 0.5)]
    }

    /// Interpolates linearly between the values of the two ends.
    pub fn interpolate<V>(&self, of: impl Fn(u32) -> V) -> V
    where
        V: Copy + Sub<Output = V> + Add<Output = V> + Mul<f32, Output = V>,
    {
        let [a, b] = self.ends.map(of);
        a + (b - a) * self.fraction
    }
}

/// A triangle that an edge split divided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SplitTriangle {
    /// The corner where the edge starts in the kept triangle, whose corners are now: near end, new
    /// vertex, opposite vertex.
    pub edge: Corner,
    /// The added triangle, with corners: new vertex, far end, opposite vertex.
    pub added: u32,
}

impl SplitTriangle {
    /// The triangle that keeps its number.
    pub fn kept(&self) -> u32 {
        self.edge / 3
    }

    /// Former place of the edge from the far end to the opposite vertex, which now belongs to the
    /// added triangle.
    pub fn moved_edge(&self) -> Corner {
        next_corner(self.edge)
    }

    /// Present place of the edge that [`Self::moved_edge`] names.
    pub fn new_edge(&self) -> Corner {
        3 * self.added + 1
    }
}

/// Result of an edge split.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeSplit {
    /// The new vertex.
    pub vertex: u32,
    /// The triangle of the given edge, then its neighbour if there is one.
    pub sides: [Option<SplitTriangle>; 2],
}

impl EdgeSplit {
    /// The divided triangles.
    pub fn sides(&self) -> impl Iterator<Item = SplitTriangle> {
        self.sides.into_iter().flatten()
    }
}

impl Mesh {
    /// Inserts a new vertex of `site` on the edge that starts at `edge`. The caller has reserved
    /// capacity.
    ///
    /// `corner_of` is out of date until `rebuild_vertex_corners` runs.
    pub fn split_edge(&mut self, edge: Corner, site: u32) -> EdgeSplit {
        let beyond = self.across(edge);
        let ends = self.ends(edge);
        let near = self.vertex(edge);
        let vertex = self.source.len() as u32;
        let same =
            |beyond: u32| (3 * beyond..3 * beyond + 3).find(|other| self.ends(*other) == ends);
        let twin = if beyond == NONE { None } else { same(beyond) };
        self.source.push(site);
        self.corner_of.push(edge);
        let first = self.split_triangle(edge, vertex);
        let second =
            twin.map(|twin| (self.vertex(twin) == near, self.split_triangle(twin, vertex)));
        if let Some((starts_alike, second)) = second {
            let (mut at_near, mut at_far) = (second.edge, 3 * second.added);
            if !starts_alike {
                (at_near, at_far) = (at_far, at_near);
            }
            self.join_edges(first.edge, at_near);
            self.join_edges(3 * first.added, at_far);
        }
        EdgeSplit { vertex, sides: [Some(first), second.map(|(_, side)| side)] }
    }

    /// Divides the triangle of `edge` at the new `vertex` and connects the added triangle.
    fn split_triangle(&mut self, edge: Corner, vertex: u32) -> SplitTriangle {
        let (far, opposite) = (self.vertex(next_corner(edge)), self.vertex(prev_corner(edge)));
        let added = self.triangles.len() as u32;
        let beyond = self.across(next_corner(edge));
        let moved = self.ends(next_corner(edge));
        self.triangles.push([vertex, far, opposite]);
        self.across.push([NONE; 3]);
        // Both halves of a rest border are rest borders, the moved edge keeps its mark, the new
        // edge has none.
        let border_bit = |edge: Corner| u8::from(self.is_rest_border(edge));
        let (divided, kept) = (border_bit(edge), border_bit(prev_corner(edge)));
        self.rest_borders.push(divided | border_bit(next_corner(edge)) << 1);
        self.rest_borders[triangle_of(edge)] =
            divided << (edge % 3) | kept << (prev_corner(edge) % 3);
        self.triangles[triangle_of(edge)][next_corner(edge) as usize % 3] = vertex;
        if beyond != NONE {
            let kept = edge / 3;
            let other = (3 * beyond..3 * beyond + 3)
                .find(|other| self.across(*other) == kept && self.ends(*other) == moved);
            self.join_edges(3 * added + 1, other.unwrap_or(3 * beyond));
        }
        self.join_edges(next_corner(edge), 3 * added + 2);
        SplitTriangle { edge, added }
    }

    /// Makes two triangles neighbours across an edge of each.
    fn join_edges(&mut self, a: Corner, b: Corner) {
        self.across[triangle_of(a)][a as usize % 3] = b / 3;
        self.across[triangle_of(b)][b as usize % 3] = a / 3;
    }

    /// Opens inner edges, and gives every fan that is disconnected from a vertex a new vertex.
    ///
    /// An edge stays closed if neither of its ends is split. `opened` receives the opened edges in
    /// the given order, `copies` each new vertex and the one that it was copied from. The fan with
    /// the lowest corner keeps its vertex.
    pub fn open_edges(
        &mut self,
        edges: &[Corner],
        opened: &mut Vec<OpenedEdge>,
        copies: &mut Vec<[u32; 2]>,
    ) {
        let mut vertices: Vec<u32> = edges
            .iter()
            .flat_map(|edge| [self.vertex(*edge), self.vertex(next_corner(*edge))])
            .collect();
        sort(&mut vertices);
        vertices.dedup();
        let mut fan = Fan::default();
        let fans: Vec<Vec<Corner>> = vertices
            .iter()
            .map(|vertex| {
                self.gather_fan(self.corner_of[*vertex as usize], &mut fan);
                let mut corners = fan.corners.clone();
                sort(&mut corners);
                corners
            })
            .collect();
        let twins: Vec<OpenedEdge> = edges.iter().map(|edge| [*edge, self.twin(*edge)]).collect();
        for corner in twins.iter().flatten() {
            self.across[triangle_of(*corner)][*corner as usize % 3] = NONE;
        }
        for (vertex, mut remaining) in vertices.into_iter().zip(fans) {
            let mut is_first = true;
            while let Some(lowest) = remaining.first().copied() {
                self.gather_fan(lowest, &mut fan);
                remaining.retain(|corner| !fan.corners.contains(corner));
                if core::mem::take(&mut is_first) {
                    self.corner_of[vertex as usize] = lowest;
                    continue;
                }
                let new = self.source.len() as u32;
                for corner in &fan.corners {
                    self.triangles[triangle_of(*corner)][*corner as usize % 3] = new;
                }
                self.source.push(self.source[vertex as usize]);
                self.corner_of.push(lowest);
                copies.push([new, vertex]);
            }
        }
        for [edge, twin] in twins {
            if self.ends(edge) == self.ends(twin) {
                self.join_edges(edge, twin);
            } else {
                opened.push([edge, twin]);
            }
        }
    }

    /// The same edge in the neighbouring triangle, which must exist.
    fn twin(&self, edge: Corner) -> Corner {
        let beyond = self.across(edge);
        let found = (3 * beyond..3 * beyond + 3).find(|other| self.ends(*other) == self.ends(edge));
        debug_assert!(found.is_some(), "edge {edge} is an inner edge");
        found.unwrap_or(edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::grid;

    #[test]
    fn edge_splits_update_the_adjacency_as_a_rebuild_does() {
        // Some triangles have the opposite winding.
        let mut triangles = grid::triangles(4, 4);
        triangles.iter_mut().step_by(3).for_each(|triangle| triangle.swap(0, 1));
        let mut mesh = Mesh::new(triangles, 16, 200);
        for round in 0..60 {
            let edges: Vec<Corner> = mesh.edges().collect();
            let division = mesh.split_edge(edges[round * 7 % edges.len()], 16);
            assert_eq!(division.vertex as usize, mesh.vertex_count() - 1);
            mesh.rebuild_vertex_corners();
            let kept = mesh.clone();
            mesh.rebuild_adjacency();
            assert_eq!(mesh, kept);
        }
        let (mut opened, mut copies) = (Vec::new(), Vec::new());
        let inner: Vec<Corner> =
            mesh.edges().filter(|edge| mesh.across(*edge) != NONE).step_by(3).collect();
        mesh.open_edges(&inner, &mut opened, &mut copies);
        assert!(!opened.is_empty() && !copies.is_empty());
        let kept = mesh.clone();
        mesh.rebuild_adjacency();
        assert_eq!(mesh, kept);
        let mut uses = vec![0; mesh.vertex_count()];
        mesh.triangles.iter().flatten().for_each(|v| uses[*v as usize] += 1);
        let mut fan = Fan::default();
        for (vertex, uses) in uses.iter().enumerate() {
            mesh.gather_fan(mesh.corner_of[vertex], &mut fan);
            assert_eq!(fan.corners.len(), *uses, "vertex {vertex}");
        }
    }
}
