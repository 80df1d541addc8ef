//! Splitting of non-manifold edges and vertices: each sheet gets particles of its own.
//!
//! ```text
//!   \ │ /          \   │   /
//!    \│/     ─▶     \ ┌┘  /        a non-manifold edge, seen along the edge
//! ────●────      ────● ● ●────
//! ```
//! At such an edge triangles stay joined in pairs: first the two that are most nearly coplanar,
//! then the most nearly coplanar two of the others, and so on. Of equally flat pairs the first one
//! is joined. Corners joined through edges form fans (union-find); every fan but the first of a
//! particle gets a copy of the particle.
//!
//! Reads triangles without degenerates and duplicates; rewrites their particle indices.
//!
//! Invariant of the result: at most two triangles per edge, one fan per particle.

use crate::math::sort::{sort_groups, sort_measured};
use crate::mesh::{Corner, next_corner, prev_corner, triangle_of};
use glam::{DVec3, Vec3};

/// At an edge with more triangles than this, only the first ones are paired; the others stay
/// separate.
const MAX_PAIRED_SIDES: usize = 32;

/// Result of the split.
#[derive(Clone, Debug, Default)]
pub(super) struct ManifoldSplit {
    /// The added particles, in order.
    pub copies: Vec<SplitParticle>,
    /// Number of edges that had more than two triangles.
    pub split_edges: u32,
}

/// Splits non-manifold edges and vertices of `triangles`, which have an area and no duplicates,
/// over `count` particles. `position` returns the position of a particle [m].
pub(super) fn split_non_manifold(
    triangles: &mut Vec<[u32; 3]>,
    count: usize,
    position: impl Fn(u32) -> Vec3,
) -> ManifoldSplit {
    let edges = EdgeSides::new(triangles);
    let split_edges = edges.runs().filter(|run| run.len() > 2).count() as u32;
    let mut is_isolated = vec![false; triangles.len()];
    loop {
        let pairs = edges.pairs(triangles, &is_isolated, &position);
        let (corners, copies) = split_fans(triangles, &pairs, count);
        let excess = if split_edges > 0 { excess_triangles(&corners, &pairs) } else { Vec::new() };
        if excess.is_empty() {
            *triangles = corners;
            return ManifoldSplit { copies, split_edges };
        }
        // A sheet may fold back onto one of its own edges: the excess triangles there become
        // isolated.
        excess.into_iter().for_each(|triangle| is_isolated[triangle] = true);
    }
}

/// All sides of triangles, sorted by the ends of their edge (lower first), each with the corner
/// where it starts.
struct EdgeSides {
    sorted: Vec<([u32; 2], Corner)>,
}

impl EdgeSides {
    fn new(triangles: &[[u32; 3]]) -> Self {
        let vertex = |corner: Corner| triangles[triangle_of(corner)][corner as usize % 3];
        let mut sorted: Vec<([u32; 2], Corner)> = (0..3 * triangles.len() as u32)
            .map(|edge| {
                let (a, b) = (vertex(edge), vertex(next_corner(edge)));
                ([a.min(b), a.max(b)], edge)
            })
            .collect();
        sort_groups(&mut sorted, |([low, _], _)| *low);
        Self { sorted }
    }

    /// The sides of each edge.
    fn runs(&self) -> impl Iterator<Item = &[([u32; 2], Corner)]> {
        self.sorted.chunk_by(|one, other| one.0 == other.0)
    }

    /// The pairs of sides that stay joined.
    fn pairs(
        &self,
        triangles: &[[u32; 3]],
        is_isolated: &[bool],
        position: &impl Fn(u32) -> Vec3,
    ) -> Vec<[Corner; 2]> {
        let mut pairs = Vec::with_capacity(self.sorted.len() / 2);
        for run in self.runs() {
            if let [(_, one), (_, other)] = run {
                if !is_isolated[triangle_of(*one)] && !is_isolated[triangle_of(*other)] {
                    pairs.push([*one, *other]);
                }
            } else if run.len() > 2 {
                let free = run.iter().map(|(_, edge)| *edge);
                let free =
                    free.filter(|edge| !is_isolated[triangle_of(*edge)]).take(MAX_PAIRED_SIDES);
                pair_flattest(triangles, free.collect(), position, &mut pairs);
            }
        }
        pairs
    }
}

/// Pairs the sides of one edge, the flattest pair first.
fn pair_flattest(
    triangles: &[[u32; 3]],
    sides: Vec<Corner>,
    position: &impl Fn(u32) -> Vec3,
    pairs: &mut Vec<[Corner; 2]>,
) {
    let at =
        |corner: Corner| position(triangles[triangle_of(corner)][corner as usize % 3]).as_dvec3();
    // Unit vector from the edge into each triangle, perpendicular to the edge.
    let inward_direction = |edge: &Corner| -> DVec3 {
        let (from, to) = (at(*edge), at(next_corner(*edge)));
        let along = (to - from).normalize_or_zero();
        let inward = at(prev_corner(*edge)) - from;
        (inward - along * inward.dot(along)).normalize_or_zero()
    };
    let directions: Vec<DVec3> = sides.iter().map(inward_direction).collect();
    let mut dihedral_cosines: Vec<(f64, u32, u32)> = Vec::new();
    for one in 0..sides.len() {
        dihedral_cosines.extend(
            (one + 1..sides.len())
                .map(|other| (directions[one].dot(directions[other]), one as u32, other as u32)),
        );
    }
    sort_measured(&mut dihedral_cosines);
    let mut is_free = vec![true; sides.len()];
    for (_, one, other) in dihedral_cosines {
        let (one, other) = (one as usize, other as usize);
        if is_free[one] && is_free[other] {
            (is_free[one], is_free[other]) = (false, false);
            pairs.push([sides[one], sides[other]]);
        }
    }
}

/// A particle that was copied for one of its fans, and the corners of that fan, ascending.
type SplitParticle = (u32, Vec<Corner>);

/// Gives every fan but the first of each particle a copy of the particle, numbered from `count` on.
fn split_fans(
    triangles: &[[u32; 3]],
    pairs: &[[Corner; 2]],
    count: usize,
) -> (Vec<[u32; 3]>, Vec<SplitParticle>) {
    let vertex = |corner: Corner| triangles[triangle_of(corner)][corner as usize % 3];
    let mut fan: Vec<Corner> = (0..3 * triangles.len() as u32).collect();
    for [one, other] in pairs {
        let ends = [*one, next_corner(*one)];
        let other_ends = [*other, next_corner(*other)];
        let is_reversed = usize::from(vertex(ends[0]) != vertex(other_ends[0]));
        join_fans(&mut fan, ends[0], other_ends[is_reversed]);
        join_fans(&mut fan, ends[1], other_ends[1 - is_reversed]);
    }
    let mut out = triangles.to_vec();
    let mut copies: Vec<SplitParticle> = Vec::new();
    // The first fan of each particle, and the copy of each later one, by the lowest corner of the
    // fan.
    let mut first_fan = vec![u32::MAX; count];
    let mut copy_of_fan = vec![u32::MAX; fan.len()];
    for corner in 0..fan.len() as u32 {
        let (root, old) = (find_root(&mut fan, corner), vertex(corner));
        let first = &mut first_fan[old as usize];
        if *first == u32::MAX {
            *first = root;
        }
        if *first == root {
            continue;
        }
        let at = &mut copy_of_fan[root as usize];
        if *at == u32::MAX {
            *at = copies.len() as u32;
            copies.push((old, Vec::new()));
        }
        copies[*at as usize].1.push(corner);
        out[triangle_of(corner)][corner as usize % 3] = count as u32 + *at;
    }
    (out, copies)
}

/// Root of the fan of a corner (union-find with path halving): its lowest corner.
fn find_root(fan: &mut [Corner], mut corner: Corner) -> Corner {
    while fan[corner as usize] != corner {
        fan[corner as usize] = fan[fan[corner as usize] as usize];
        corner = fan[corner as usize];
    }
    corner
}

/// Joins the fans of two corners.
fn join_fans(fan: &mut [Corner], one: Corner, other: Corner) {
    let (one, other) = (find_root(fan, one), find_root(fan, other));
    fan[one.max(other) as usize] = one.min(other);
}

/// Triangles in excess at edges that still have more than two: all but the first joined pair.
fn excess_triangles(triangles: &[[u32; 3]], pairs: &[[Corner; 2]]) -> Vec<usize> {
    let edges = EdgeSides::new(triangles);
    let mut excess = Vec::new();
    for run in edges.runs().filter(|run| run.len() > 2) {
        let sides: Vec<Corner> = run.iter().map(|(_, edge)| *edge).collect();
        let joined = pairs.iter().find(|pair| pair.iter().all(|edge| sides.contains(edge)));
        let joined_pair = joined.map_or([sides[0], sides[1]], |pair| *pair);
        excess.extend(
            sides.iter().filter(|edge| !joined_pair.contains(edge)).map(|edge| triangle_of(*edge)),
        );
    }
    excess
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Fan, Mesh};

    /// Splits triangles at these positions, and checks that the result is manifold.
    fn split_and_check(
        positions: &[Vec3],
        triangles: &[[u32; 3]],
    ) -> (Vec<[u32; 3]>, ManifoldSplit) {
        let mut out = triangles.to_vec();
        let split_result =
            split_non_manifold(&mut out, positions.len(), |particle| positions[particle as usize]);
        let count = positions.len() + split_result.copies.len();
        let mesh = Mesh::new(out.clone(), count, count);
        let mut uses = vec![0; count];
        out.iter().flatten().for_each(|v| uses[*v as usize] += 1);
        let mut fan = Fan::default();
        for (particle, uses) in uses.iter().enumerate().filter(|(_, uses)| **uses > 0) {
            mesh.gather_fan(mesh.corner_of[particle], &mut fan);
            assert_eq!(fan.corners.len(), *uses, "particle {particle} of {out:?}");
        }
        let edges = EdgeSides::new(&out);
        assert!(edges.runs().all(|run| run.len() < 3), "{out:?}");
        (out, split_result)
    }

    const HINGE: [Vec3; 2] = [Vec3::ZERO, Vec3::Y];

    /// A point beside the hinge, at the given angle in sixteenths of a turn.
    fn ring_point(sixteenths: f32) -> Vec3 {
        let (sine, cosine) = (sixteenths * core::f32::consts::TAU / 16.0).sin_cos();
        Vec3::new(cosine, 0.5, sine)
    }

    #[test]
    fn the_flattest_two_of_three_triangles_at_an_edge_stay_joined() {
        let positions = [HINGE[0], HINGE[1], ring_point(0.0), ring_point(3.0), ring_point(7.0)];
        let (out, split_result) = split_and_check(&positions, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]);
        assert_eq!(out, [[0, 1, 2], [5, 6, 3], [0, 1, 4]]);
        assert_eq!(split_result.split_edges, 1);
        assert_eq!(split_result.copies, [(0, vec![3]), (1, vec![4])]);
    }

    #[test]
    fn two_sheets_that_cross_at_an_edge_stay_whole() {
        let positions = [
            HINGE[0],
            HINGE[1],
            ring_point(0.0),
            ring_point(4.0),
            ring_point(8.0),
            ring_point(12.0),
        ];
        let (out, _) = split_and_check(&positions, &[[0, 1, 2], [1, 0, 3], [1, 0, 4], [0, 1, 5]]);
        assert_eq!(out, [[0, 1, 2], [6, 7, 3], [1, 0, 4], [7, 6, 5]]);
    }

    #[test]
    fn a_vertex_shared_by_two_fans_is_split() {
        let positions = [0.0, 1.0, 2.0, 3.0, 4.0].map(|x: f32| Vec3::new(x, x * x, 0.0));
        let (out, split_result) = split_and_check(&positions, &[[0, 1, 2], [2, 3, 4]]);
        assert_eq!(out, [[0, 1, 2], [5, 3, 4]]);
        assert_eq!((split_result.split_edges, split_result.copies), (0, vec![(2, vec![3])]));
    }

    #[test]
    fn a_sheet_that_returns_to_its_own_edge_is_split_there() {
        // Around the hinge and back to it: the last point lies on the first edge and is joined to
        // it all around.
        let mut positions = HINGE.to_vec();
        positions.extend((0..5).map(|at| ring_point(3.0 * at as f32)));
        let mut triangles = vec![[0, 1, 2], [0, 1, 4], [0, 1, 6]];
        for at in 2..6 {
            triangles.extend([[0, at, at + 1], [1, at, at + 1]]);
        }
        split_and_check(&positions, &triangles);
    }

    #[test]
    fn all_triangles_between_seven_points_become_manifold() {
        let positions: Vec<Vec3> =
            (0..7).map(|at| ring_point(2.3 * at as f32) * (1.0 + at as f32)).collect();
        let mut triangles = Vec::new();
        for a in 0..7 {
            for b in a + 1..7 {
                triangles.extend((b + 1..7).map(|c| [a, b, c]));
            }
        }
        let (_, split_result) = split_and_check(&positions, &triangles);
        assert_eq!(split_result.split_edges, 21);
    }
}
