//! Vertex splits (tearing): give an arc of triangles around a vertex a new vertex, which opens two
//! edges.
//!
//! ```text
//!    1 ╲  │  ╱ 2            1 ╲  │  ╱ 2
//!       ╲ │ ╱                  ╲ │ ╱
//!   ────  v  ────    ─▶    ────  v  ────     two edges open: each side has
//!       ╱ │ ╲              ────  v′ ────     its own vertex and border
//!    4 ╱  │  ╲ 3                ╱ │ ╲
//! ```
//! Reads and writes the `Mesh` only.
//!
//! Invariant: no triangle is lost, `across` and `corner_of` stay valid, and after
//! `split_non_manifold_vertex` on the far ends of the opened edges every vertex has one fan again.

use crate::mesh::{Corner, Fan, Mesh, NONE, triangle_of};

/// An edge that was opened: its corner in the triangle on either side. Both are borders now.
pub(crate) type OpenedEdge = [Corner; 2];

/// `count` consecutive triangles of a fan from `first` on; wraps around in a closed fan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FanArc {
    pub first: usize,
    pub count: usize,
}

impl FanArc {
    fn contains(self, at: usize, fan: &Fan) -> bool {
        (at + fan.corners.len() - self.first) % fan.corners.len() < self.count
    }
}

/// The arc that matches `moves` best: it contains the most marked triangles and the fewest others,
/// at least one triangle and not all; the first of equals. An arc of an open fan starts or ends at
/// a border. `None` if the fan has only one triangle.
pub(crate) fn best_arc(fan: &Fan, moves: &[bool]) -> Option<FanArc> {
    let n = fan.corners.len();
    let mut best: Option<(usize, FanArc)> = None;
    for first in 0..n {
        for count in 1..n {
            let touches_border = first == 0 || first + count == n;
            if !fan.is_closed && (first + count > n || !touches_border) {
                continue;
            }
            let arc = FanArc { first, count };
            let right = (0..n).filter(|at| arc.contains(*at, fan) == moves[*at]).count();
            if best.is_none_or(|(most, _)| right > most) {
                best = Some((right, arc));
            }
        }
    }
    best.map(|(_, arc)| arc)
}

impl Mesh {
    /// Gives the triangles of `arc` a new vertex, appends the opened edges to `opened`, and returns
    /// the vertex.
    ///
    /// `fan` is the fan of the old vertex. The caller has reserved capacity for one more vertex.
    pub fn split_vertex(&mut self, fan: &Fan, arc: FanArc, opened: &mut Vec<OpenedEdge>) -> u32 {
        let n = fan.corners.len();
        let old = self.vertex(fan.corners[0]);
        let new = self.source.len() as u32;
        for (at, far_end) in fan.ring.iter().enumerate().take(n) {
            let has_neighbour = at > 0 || fan.is_closed;
            let before = (at + n - 1) % n;
            if has_neighbour && arc.contains(at, fan) != arc.contains(before, fan) {
                opened.push(self.open_edge(old, *far_end, fan.corners[before], fan.corners[at]));
            }
        }
        let moved = |at: &usize| arc.contains(*at, fan);
        for at in (0..n).filter(moved) {
            let corner = fan.corners[at];
            self.triangles[triangle_of(corner)][corner as usize % 3] = new;
        }
        self.source.push(self.source[old as usize]);
        // `corner_of` is the lowest corner, so that a restored mesh walks its fans in the same
        // order.
        let lowest = |of_moved: bool| {
            let corners = (0..n).filter(|at| moved(at) == of_moved).map(|at| fan.corners[at]);
            corners.min().unwrap_or(NONE)
        };
        self.corner_of[old as usize] = lowest(false);
        self.corner_of.push(lowest(true));
        new
    }

    /// Removes the adjacency of two triangles at their shared edge from `vertex` to `far_end`.
    fn open_edge(&mut self, vertex: u32, far_end: u32, left: Corner, right: Corner) -> OpenedEdge {
        let ends = (vertex.min(far_end), vertex.max(far_end));
        [left, right].map(|corner| {
            let first = corner - corner % 3;
            let edge = (first..first + 3).find(|edge| self.ends(*edge) == ends).unwrap_or(corner);
            debug_assert_eq!(self.ends(edge), ends);
            self.across[triangle_of(edge)][edge as usize % 3] = NONE;
            edge
        })
    }

    /// If opening an edge left `vertex` shared by two separate fans, gives one of them a new
    /// vertex.
    ///
    /// `before` is the fan from before the edge was opened; `scratch` receives the fan that keeps
    /// the vertex. Returns the new vertex, if any.
    pub fn split_non_manifold_vertex(
        &mut self,
        vertex: u32,
        before: &Fan,
        scratch: &mut Fan,
    ) -> Option<u32> {
        self.gather_fan(self.corner_of[vertex as usize], scratch);
        if scratch.corners.len() == before.corners.len() {
            return None;
        }
        let new = self.source.len() as u32;
        let mut lowest = NONE;
        for corner in before.corners.iter().filter(|corner| !scratch.corners.contains(corner)) {
            self.triangles[triangle_of(*corner)][*corner as usize % 3] = new;
            lowest = lowest.min(*corner);
        }
        self.source.push(self.source[vertex as usize]);
        self.corner_of.push(lowest);
        Some(new)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{grid, next_corner};

    /// A grid of 3 × 3 vertices; the middle one, 4, has eight triangles.
    fn three_by_three() -> Mesh {
        Mesh::new(grid::triangles(3, 3), 9, 32)
    }

    fn fan_of(mesh: &Mesh, vertex: u32) -> Fan {
        let mut fan = Fan::default();
        mesh.gather_fan(mesh.corner_of[vertex as usize], &mut fan);
        fan
    }

    #[test]
    fn splitting_an_inner_vertex_opens_two_edges_and_keeps_every_triangle() {
        let mut mesh = three_by_three();
        let fan = fan_of(&mesh, 4);
        assert!(fan.is_closed && fan.corners.len() == 8, "{fan:?}");
        let lower = |corner: &Corner| mesh.triangles[triangle_of(*corner)].iter().any(|v| *v > 5);
        let moves: Vec<bool> = fan.corners.iter().map(lower).collect();
        let arc = best_arc(&fan, &moves).unwrap();
        assert_eq!(arc.count, 4);
        let mut opened = Vec::new();
        assert_eq!(mesh.split_vertex(&fan, arc, &mut opened), 9);
        assert_eq!(opened.len(), 2);
        let mut far: Vec<u32> = opened
            .iter()
            .map(|[edge, _]| [mesh.vertex(*edge), mesh.vertex(next_corner(*edge))])
            .map(|[a, b]| if a == 4 || a == 9 { b } else { a })
            .collect();
        far.sort_unstable();
        assert_eq!(far, [3, 5]);
        assert_eq!(mesh.source[9], 4);
        assert_eq!((fan_of(&mesh, 4).corners.len(), fan_of(&mesh, 9).corners.len()), (4, 4));
        let whole = mesh.clone();
        mesh.rebuild_adjacency();
        assert_eq!(mesh, whole, "the adjacency equals that of a rebuild");
    }

    #[test]
    fn a_border_vertex_shared_by_two_fans_is_split() {
        let mut mesh = three_by_three();
        let before = [3u32, 5].map(|v| fan_of(&mesh, v));
        let fan = fan_of(&mesh, 4);
        let lower = |corner: &Corner| mesh.triangles[triangle_of(*corner)].iter().any(|v| *v > 5);
        let moves: Vec<bool> = fan.corners.iter().map(lower).collect();
        let mut opened = Vec::new();
        mesh.split_vertex(&fan, best_arc(&fan, &moves).unwrap(), &mut opened);
        let mut scratch = Fan::default();
        assert_eq!(mesh.split_non_manifold_vertex(3, &before[0], &mut scratch), Some(10));
        assert_eq!(mesh.split_non_manifold_vertex(5, &before[1], &mut scratch), Some(11));
        let mut label = vec![0; mesh.triangles.len()];
        assert_eq!(mesh.label_pieces(&mut label, &mut Vec::new()), 2, "torn in two");
        let mut uses = vec![0; mesh.vertex_count()];
        mesh.triangles.iter().flatten().for_each(|v| uses[*v as usize] += 1);
        for vertex in 0..mesh.vertex_count() as u32 {
            assert_eq!(
                fan_of(&mesh, vertex).corners.len(),
                uses[vertex as usize],
                "vertex {vertex}"
            );
        }
    }

    #[test]
    fn a_lone_triangle_cannot_be_split() {
        let mesh = Mesh::new(vec![[0, 1, 2]], 3, 3);
        assert_eq!(best_arc(&fan_of(&mesh, 0), &[true]), None);
    }
}
