//! Exact intersection test between the triangles of a cloth, in double precision.

use muslin::Cloth;
use muslin::glam::{DVec3, Vec3};

/// Number of triangle pairs that intersect and share no vertex.
pub fn crossing_count(cloth: &Cloth) -> usize {
    crossing_pairs(cloth).len()
}

/// Indices of the triangles of each intersecting pair, lower index first; pairs that share a vertex
/// do not count.
///
/// Sorts the bounding boxes by their lower x and tests only pairs whose boxes overlap.
pub fn crossing_pairs(cloth: &Cloth) -> Vec<[u32; 2]> {
    crossing_pairs_at(cloth, cloth.positions())
}

/// The same with the vertices at `positions`.
pub fn crossing_pairs_at(cloth: &Cloth, positions: &[Vec3]) -> Vec<[u32; 2]> {
    let triangles = super::triangles(cloth);
    let shares =
        |[one, other]: [usize; 2]| triangles[one].iter().any(|v| triangles[other].contains(v));
    intersecting_pairs(&corners_at(cloth, positions), &|pair| !shares(pair))
}

/// Number of pairs of a triangle of one cloth and a triangle of the other that intersect.
pub fn crossings_between(one: &Cloth, other: &Cloth) -> usize {
    let mut all = corners_at(one, one.positions());
    let count = all.len();
    all.extend(corners_at(other, other.positions()));
    intersecting_pairs(&all, &|[a, b]| (a < count) != (b < count)).len()
}

/// The corners of all triangles with the vertices at `positions`.
fn corners_at(cloth: &Cloth, positions: &[Vec3]) -> Vec<[DVec3; 3]> {
    let corner = |v: u32| positions[v as usize].as_dvec3();
    super::triangles(cloth).into_iter().map(|triangle| triangle.map(corner)).collect()
}

/// Indices of the triangles of each intersecting pair that `may_cross` accepts, lower index first.
fn intersecting_pairs(
    triangles: &[[DVec3; 3]],
    may_cross: &dyn Fn([usize; 2]) -> bool,
) -> Vec<[u32; 2]> {
    let bounds = |[a, b, c]: &[DVec3; 3]| (a.min(*b).min(*c), a.max(*b).max(*c));
    let boxes: Vec<(DVec3, DVec3)> = triangles.iter().map(bounds).collect();
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    order.sort_by(|a, b| boxes[*a].0.x.total_cmp(&boxes[*b].0.x));
    let mut pairs = Vec::new();
    for (at, one) in order.iter().enumerate() {
        for other in &order[at + 1..] {
            let ((low, high), (other_low, other_high)) = (boxes[*one], boxes[*other]);
            if other_low.x > high.x {
                break;
            }
            let is_near = low.cmple(other_high).all() && other_low.cmple(high).all();
            if is_near
                && may_cross([*one, *other])
                && triangles_intersect(triangles[*one], triangles[*other])
            {
                pairs.push([*one.min(other) as u32, *one.max(other) as u32]);
            }
        }
    }
    pairs
}

/// Whether an edge of either triangle pierces the other triangle.
fn triangles_intersect(one: [DVec3; 3], other: [DVec3; 3]) -> bool {
    (0..3).any(|k| {
        let next = (k + 1) % 3;
        edge_pierces([one[k], one[next]], other) || edge_pierces([other[k], other[next]], one)
    })
}

/// Whether the segment from `p` to `q` passes through the inside of the triangle `a`, `b`, `c`.
fn edge_pierces([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
    let n = (b - a).cross(c - a);
    let (over_p, over_q) = ((p - a).dot(n), (q - a).dot(n));
    // An end point within about a nanometre of the plane is contact, not an intersection.
    let least = 1.0e-9 * n.length();
    if over_p.abs() <= least || over_q.abs() <= least || (over_p > 0.0) == (over_q > 0.0) {
        return false;
    }
    let at = p + (q - p) * (over_p / (over_p - over_q));
    [(a, b), (b, c), (c, a)].into_iter().all(|(u, v)| (v - u).cross(at - u).dot(n) > 0.0)
}
