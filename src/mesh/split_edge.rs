//! Dividing an edge: a new vertex on it parts the triangle on either side in two.
//!
//! ```text
//!        opposite                     opposite
//!        ╱      ╲                     ╱   |   ╲
//!       ╱  kept  ╲         ─▶        ╱    |    ╲
//!      ╱          ╲                 ╱kept | added╲
//!   near ───────── far           near ── new ──── far
//! ```
//! Cuts divide every edge that the blade crosses, one after the other; where it crosses two edges of a
//! triangle, the second division leaves an edge along the blade. Then those edges open.

use crate::math::sort::sort;
use crate::mesh::split_vertex::OpenedEdge;
use crate::mesh::{Corner, Fan, Mesh, NONE, next_corner, prev_corner, triangle_of};
use core::ops::{Add, Mul, Sub};
use serde::{Deserialize, Serialize};

/// Where a cut made a vertex: on the way between two sites, at this share of it from the first.
///
/// A site is a place in the rest shape: the original vertices are the first of them, the crossings of
/// all cuts follow in their order. Every vertex has one, and vertices that were split share theirs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct CutSite {
    pub ends: [u32; 2],
    pub fraction: f32,
}

impl CutSite {
    /// The end that is nearer; of equals the first.
    pub fn nearest_end(&self) -> u32 {
        self.ends[usize::from(self.fraction > 0.5)]
    }

    /// What the ends have, at that share between them.
    pub fn interpolate<V>(&self, of: impl Fn(u32) -> V) -> V
    where
        V: Copy + Sub<Output = V> + Add<Output = V> + Mul<f32, Output = V>,
    {
        let [a, b] = self.ends.map(of);
        a + (b - a) * self.fraction
    }
}

/// A triangle that was divided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SplitTriangle {
    /// Where the edge starts in the triangle that stays: corners near end, new vertex, opposite.
    pub edge: Corner,
    /// The triangle that came to be: corners new vertex, far end, opposite.
    pub added: u32,
}

impl SplitTriangle {
    /// The triangle that stays.
    pub fn kept(&self) -> u32 {
        self.edge / 3
    }

    /// Where the edge from the far end to the opposite vertex started, which is the added triangle's now.
    pub fn moved_edge(&self) -> Corner {
        next_corner(self.edge)
    }

    /// The same edge where it is now.
    pub fn new_edge(&self) -> Corner {
        3 * self.added + 1
    }
}

/// What dividing an edge did.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeSplit {
    /// The vertex that came to be.
    pub vertex: u32,
    /// The triangle that was asked for, then the one beyond, if there is one.
    pub sides: [Option<SplitTriangle>; 2],
}

impl EdgeSplit {
    /// The triangles that were divided.
    pub fn sides(&self) -> impl Iterator<Item = SplitTriangle> {
        self.sides.into_iter().flatten()
    }
}

impl Mesh {
    /// Puts a new vertex on the edge that starts at `edge`. The caller has seen to room for it.
    ///
    /// `corner_of` is out of date then, until `find_corners`.
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

    fn split_triangle(&mut self, edge: Corner, vertex: u32) -> SplitTriangle {
        let (far, opposite) = (self.vertex(next_corner(edge)), self.vertex(prev_corner(edge)));
        let added = self.triangles.len() as u32;
        let beyond = self.across(next_corner(edge));
        let moved = self.ends(next_corner(edge));
        self.triangles.push([vertex, far, opposite]);
        self.across.push([NONE; 3]);
        // Both halves of a hem are hems, the moved edge stays what it was, and the new one is inside.
        let is_hem = |edge: Corner| u8::from(self.is_rest_border(edge));
        let (divided, kept) = (is_hem(edge), is_hem(prev_corner(edge)));
        self.rest_borders.push(divided | is_hem(next_corner(edge)) << 1);
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

    /// Joins two triangles at an edge of each.
    fn join_edges(&mut self, a: Corner, b: Corner) {
        self.across[triangle_of(a)][a as usize % 3] = b / 3;
        self.across[triangle_of(b)][b as usize % 3] = a / 3;
    }

    /// Opens inner edges, and gives every fan that falls off a vertex a new one.
    ///
    /// An edge of which neither end comes apart cannot open and stays as it was. `opened` gets the
    /// others in the order they were named, `copies` each new vertex and the one that it was. The
    /// fan with the lowest corner keeps its vertex.
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

    /// The same edge in the triangle across. There is one.
    fn twin(&self, edge: Corner) -> Corner {
        let beyond = self.across(edge);
        let found = (3 * beyond..3 * beyond + 3).find(|other| self.ends(*other) == self.ends(edge));
        debug_assert!(found.is_some(), "edge {edge} is an inner one");
        found.unwrap_or(edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::grid;

    #[test]
    fn dividing_keeps_up_to_date_what_connecting_finds() {
        // Some triangles wound the other way.
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
