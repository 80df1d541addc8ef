//! Corner table: an indexed triangle mesh with adjacency.
//!
//! ```text
//!           v2                     corner c = 3 · triangle + k, k = 0, 1, 2, at vertex k
//!          ╱  ╲                    next_corner(c), prev_corner(c): the others of the triangle
//!   edge 2╱    ╲edge 1             edge c: from corner c to next_corner(c)
//!        ╱      ╲                  across(c): triangle on the other side of edge c
//!      v0 ────── v1                fan(v): triangles around v, in order
//!          edge 0
//! ```
//! Rossignac, Safonova and Szymczak, "3D compression made simple: Edgebreaker on a corner table",
//! SMI 2001. That table stores the opposite corner; this one stores the neighbouring triangle of
//! each edge, because neighbours may have opposite windings (a Möbius strip cannot be oriented),
//! and finds the shared edge by its two vertices.
//!
//! Reads and writes: only itself. `intake` and `validate` create sound meshes; `split_vertex` and
//! `split_edge` change them.
//!
//! Invariant: an edge has at most two triangles, and the triangles of a vertex form one fan
//! (2-manifold with borders).

use crate::math::heap_bytes::heap_bytes;
use crate::math::sort::sort_groups;
use serde::{Deserialize, Serialize};

/// No triangle, corner, vertex or link.
pub(crate) const NONE: u32 = u32::MAX;

/// A corner of a triangle: `3 * triangle + k` with k = 0, 1 or 2. Also names the edge that starts
/// there.
pub(crate) type Corner = u32;

/// An indexed triangle mesh with adjacency. See the module documentation for its conventions.
///
/// Field order is part of the save format.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Mesh {
    /// Vertex of each corner.
    pub triangles: Vec<[u32; 3]>,
    /// Neighbouring triangle across each edge; `NONE` at a border.
    pub across: Vec<[u32; 3]>,
    /// The lowest corner of each vertex; `NONE` if no triangle uses the vertex.
    pub corner_of: Vec<Corner>,
    /// Site (rest vertex) of each vertex: the original vertex that it was split from, or a site
    /// that a cut created, see `split_edge::CutSite`.
    pub source: Vec<u32>,
    /// Edges that were borders of the rest mesh, or are parts of such: bit `e` for edge `e` of each
    /// triangle.
    pub rest_borders: Vec<u8>,
    /// Number of vertices before any tear or cut.
    pub original_count: u32,
}

heap_bytes!(Mesh { triangles, across, corner_of, source, rest_borders } plain { original_count });

/// The triangles around one vertex, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fan {
    /// The corner of the vertex in each triangle.
    pub corners: Vec<Corner>,
    /// One-ring: `ring[i]` is the far end of the edge between triangles `i - 1` and `i`. The ring
    /// of an open fan also contains the far ends of its two border edges: one entry more than
    /// `corners`.
    pub ring: Vec<u32>,
    /// Whether the last triangle is a neighbour of the first (an inner vertex).
    pub is_closed: bool,
}

heap_bytes!(Fan { corners, ring } plain { is_closed });

/// The triangle of a corner.
#[inline(always)]
pub(crate) fn triangle_of(corner: Corner) -> usize {
    corner as usize / 3
}

/// The next corner of the same triangle.
#[inline(always)]
pub(crate) fn next_corner(corner: Corner) -> Corner {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}

/// The previous corner of the same triangle.
#[inline(always)]
pub(crate) fn prev_corner(corner: Corner) -> Corner {
    if corner.is_multiple_of(3) { corner + 2 } else { corner - 1 }
}

impl Mesh {
    /// Builds the adjacency of triangles that are known to be sound, and allocates for `capacity`
    /// vertices. Marks all borders as rest borders.
    ///
    /// `intake` repairs other triangles; `validate` refuses them.
    pub fn new(triangles: Vec<[u32; 3]>, vertex_count: usize, capacity: usize) -> Self {
        let mut corner_of = Vec::with_capacity(capacity);
        corner_of.resize(vertex_count, NONE);
        let mut source = Vec::with_capacity(capacity);
        source.extend(0..vertex_count as u32);
        let across = vec![[NONE; 3]; triangles.len()];
        let original_count = vertex_count as u32;
        let rest_borders = vec![0; triangles.len()];
        let mut mesh = Self { triangles, across, corner_of, source, rest_borders, original_count };
        mesh.rebuild_adjacency();
        for (rest_borders, across) in mesh.rest_borders.iter_mut().zip(&mesh.across) {
            *rest_borders = (0..3).filter(|edge| across[*edge] == NONE).map(|edge| 1 << edge).sum();
        }
        mesh
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.source.len()
    }

    /// The vertex at a corner.
    #[inline(always)]
    pub fn vertex(&self, corner: Corner) -> u32 {
        self.triangles[triangle_of(corner)][corner as usize % 3]
    }

    /// The neighbouring triangle across the edge that starts at `corner`; `NONE` at a border.
    #[inline(always)]
    pub fn across(&self, corner: Corner) -> u32 {
        self.across[triangle_of(corner)][corner as usize % 3]
    }

    /// Whether the edge that starts at `corner` was a border of the rest mesh, or is part of one.
    pub fn is_rest_border(&self, corner: Corner) -> bool {
        self.rest_borders[triangle_of(corner)] >> (corner % 3) & 1 == 1
    }

    /// Resizes `marks` to the vertex count and sets it for each vertex on a border that a tear or
    /// cut made.
    pub fn mark_torn_borders(&self, marks: &mut Vec<bool>) {
        marks.clear();
        marks.resize(self.vertex_count(), false);
        for edge in 0..3 * self.triangles.len() as u32 {
            if self.across(edge) == NONE && !self.is_rest_border(edge) {
                for end in [edge, next_corner(edge)] {
                    marks[self.vertex(end) as usize] = true;
                }
            }
        }
    }

    /// Iterates over all edges once, each by its corner in the triangle with the lower number.
    pub fn edges(&self) -> impl Iterator<Item = Corner> + '_ {
        (0..3 * self.triangles.len() as u32)
            .filter(|corner| self.across(*corner) == NONE || self.across(*corner) > corner / 3)
    }

    /// Largest number of edges that tears can open until there are `capacity` vertices: each new
    /// vertex opens up to two, and only inner edges can open.
    pub fn max_opened_edges(&self, capacity: usize) -> usize {
        let inner_edges = self.edges().filter(|edge| self.across(*edge) != NONE).count();
        inner_edges.min(2 * (capacity - self.vertex_count()))
    }

    /// The corner of `vertex` in `triangle`, or `None` if it has none there.
    pub fn corner_in(&self, triangle: u32, vertex: u32) -> Option<Corner> {
        let at = self.triangles[triangle as usize].iter().position(|v| *v == vertex)?;
        Some(3 * triangle + at as u32)
    }

    /// Writes the fan around the vertex of `start` into `fan`, from its border onwards if it has
    /// one.
    ///
    /// Works for any winding: the walk leaves each triangle by the edge at the vertex that it did
    /// not enter by.
    pub fn gather_fan(&self, start: Corner, fan: &mut Fan) {
        let vertex = self.vertex(start);
        fan.corners.clear();
        fan.ring.clear();
        // Walk backwards to the border, or once around.
        let (mut at, mut entry) = (start, prev_corner(start));
        loop {
            match self.cross_edge(vertex, entry) {
                None => break,
                Some((next, _)) if next == start => break,
                Some((next, exit)) => (at, entry) = (next, exit),
            }
        }
        let (first, first_entry) = (at, entry);
        fan.is_closed = self.cross_edge(vertex, first_entry).is_some();
        fan.ring.push(self.other_end(vertex, first_entry));
        // Walk forwards, leaving by the other edge.
        let mut exit = self.other_edge(vertex, first, first_entry);
        loop {
            fan.corners.push(at);
            match self.cross_edge(vertex, exit) {
                Some((next, _)) if next == first => break,
                Some((next, next_exit)) => {
                    fan.ring.push(self.other_end(vertex, exit));
                    (at, exit) = (next, next_exit);
                }
                None => {
                    fan.ring.push(self.other_end(vertex, exit));
                    break;
                }
            }
        }
    }

    /// Crosses the edge that starts at corner `edge`. Returns the corner of `vertex` in the next
    /// triangle and the other edge at `vertex` there; `None` at a border.
    fn cross_edge(&self, vertex: u32, edge: Corner) -> Option<(Corner, Corner)> {
        let next = self.across(edge);
        if next == NONE {
            return None;
        }
        let came_from = edge / 3;
        let corner = self.corner_in(next, vertex)?;
        let (out, back) = (corner, prev_corner(corner));
        let entry = if self.across(out) == came_from && self.ends(out) == self.ends(edge) {
            out
        } else {
            back
        };
        Some((corner, if entry == out { back } else { out }))
    }

    /// The edge at `vertex` in the triangle of `corner` that is not `edge`.
    fn other_edge(&self, vertex: u32, corner: Corner, edge: Corner) -> Corner {
        debug_assert_eq!(self.vertex(corner), vertex);
        if edge == corner { prev_corner(corner) } else { corner }
    }

    fn other_end(&self, vertex: u32, edge: Corner) -> u32 {
        let (a, b) = (self.vertex(edge), self.vertex(next_corner(edge)));
        if a == vertex { b } else { a }
    }

    /// The two vertices of the edge that starts at `edge`, the lower first.
    pub fn ends(&self, edge: Corner) -> (u32, u32) {
        let (a, b) = (self.vertex(edge), self.vertex(next_corner(edge)));
        (a.min(b), a.max(b))
    }

    /// Recomputes `across` and `corner_of` from `triangles`.
    pub fn rebuild_adjacency(&mut self) {
        let mut edges: Vec<([u32; 2], Corner)> = (0..3 * self.triangles.len() as u32)
            .map(|corner| (self.ends(corner).into(), corner))
            .collect();
        sort_groups(&mut edges, |([low, _], _)| *low);
        self.across.fill([NONE; 3]);
        for pair in edges.windows(2) {
            if let [(ends, a), (same, b)] = pair
                && ends == same
            {
                self.across[triangle_of(*a)][*a as usize % 3] = b / 3;
                self.across[triangle_of(*b)][*b as usize % 3] = a / 3;
            }
        }
        self.rebuild_vertex_corners();
    }

    /// Recomputes `corner_of` from `triangles`.
    pub fn rebuild_vertex_corners(&mut self) {
        self.corner_of.fill(NONE);
        for corner in (0..3 * self.triangles.len() as u32).rev() {
            let vertex = self.vertex(corner) as usize;
            self.corner_of[vertex] = corner;
        }
    }

    /// Reverses the winding of the triangles marked in `flipped`: their second and third corners
    /// swap.
    pub fn flip_triangles(&mut self, flipped: &[bool]) {
        for at in (0..self.triangles.len()).filter(|at| flipped[*at]) {
            self.triangles[at].swap(1, 2);
            // Edge 1 keeps its ends; edges 0 and 2 swap with the corners that they start at.
            self.across[at].swap(0, 2);
            let rest_borders = self.rest_borders[at];
            self.rest_borders[at] = rest_borders & 2 | rest_borders << 2 & 4 | rest_borders >> 2;
        }
        self.rebuild_vertex_corners();
    }

    /// Writes the number of its connected component into `label` for each triangle (`label` has one
    /// entry per triangle), and returns the number of components. Triangles are connected through
    /// edges.
    pub fn label_pieces(&self, label: &mut [u32], stack: &mut Vec<u32>) -> u32 {
        label.fill(NONE);
        let mut count = 0;
        for seed in 0..self.triangles.len() {
            if label[seed] != NONE {
                continue;
            }
            label[seed] = count;
            stack.clear();
            stack.push(seed as u32);
            while let Some(triangle) = stack.pop() {
                for next in self.across[triangle as usize] {
                    if next != NONE && label[next as usize] == NONE {
                        label[next as usize] = count;
                        stack.push(next);
                    }
                }
            }
            count += 1;
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six triangles around vertex 0; every second one has the opposite winding.
    fn hexagon() -> Mesh {
        let ring = |i: u32| i % 6 + 1;
        let triangles = (0..6).map(|i| {
            if i % 2 == 0 { [0, ring(i), ring(i + 1)] } else { [ring(i + 1), ring(i), 0] }
        });
        Mesh::new(triangles.collect(), 7, 7)
    }

    #[test]
    fn the_fan_of_an_inner_vertex_is_closed_for_any_winding() {
        let (mesh, mut fan) = (hexagon(), Fan::default());
        mesh.gather_fan(mesh.corner_of[0], &mut fan);
        assert!(fan.is_closed);
        assert_eq!(fan.corners.len(), 6);
        let mut ring = fan.ring.clone();
        ring.sort_unstable();
        assert_eq!(ring, [1, 2, 3, 4, 5, 6]);
        for (i, corner) in fan.corners.iter().enumerate() {
            let [a, b] = [fan.ring[i], fan.ring[(i + 1) % 6]];
            let triangle = mesh.triangles[triangle_of(*corner)];
            assert!(triangle.contains(&a) && triangle.contains(&b), "{triangle:?} {a} {b}");
        }
    }

    #[test]
    fn flipping_triangles_updates_the_adjacency_as_a_rebuild_does() {
        let mut mesh = hexagon();
        mesh.flip_triangles(&[false, true, true, false, false, true]);
        let (triangles, flipped) = (mesh.triangles.clone(), mesh.clone());
        assert_eq!(triangles[1], [3, 0, 2], "it was 3, 2, 0 before");
        assert_eq!(flipped, Mesh::new(triangles, 7, 7));
    }

    #[test]
    fn the_fan_of_a_border_vertex_is_open() {
        let (mesh, mut fan) = (hexagon(), Fan::default());
        mesh.gather_fan(mesh.corner_of[1], &mut fan);
        assert!(!fan.is_closed);
        assert_eq!(fan.corners.len(), 2);
        assert_eq!(fan.ring.len(), 3);
        assert_eq!(fan.ring[1], 0);
    }
}
