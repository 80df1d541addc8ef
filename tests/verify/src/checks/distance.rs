//! Distances between points, segments, triangles and boxes, in f64.

use muslin::glam::DVec3;

/// The point of a triangle that is nearest to `p` (Ericson, "Real-Time Collision Detection", 5.1.5,
/// by the nearest of face and edges).
pub fn closest_on_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let n = (b - a).cross(c - a);
    let is_inside = |u: DVec3, v: DVec3| (v - u).cross(p - u).dot(n) >= 0.0;
    if n.length_squared() > 0.0 && is_inside(a, b) && is_inside(b, c) && is_inside(c, a) {
        return p - n * ((p - a).dot(n) / n.length_squared());
    }
    let edges = [(a, b), (b, c), (c, a)].map(|(u, v)| closest_on_segment(p, u, v));
    let nearer = |one: DVec3, other: DVec3| {
        if other.distance_squared(p) < one.distance_squared(p) { other } else { one }
    };
    nearer(nearer(edges[0], edges[1]), edges[2])
}

fn closest_on_segment(p: DVec3, a: DVec3, b: DVec3) -> DVec3 {
    let along = b - a;
    let length = along.length_squared();
    if length > 0.0 { a + along * ((p - a).dot(along) / length).clamp(0.0, 1.0) } else { a }
}

/// Distance between two segments [m] (Ericson, 5.1.9).
fn segment_distance([p, q]: [DVec3; 2], [a, b]: [DVec3; 2]) -> f64 {
    let (u, v, w) = (q - p, b - a, p - a);
    let (uu, uv, vv) = (u.dot(u), u.dot(v), v.dot(v));
    let determinant = uu * vv - uv * uv;
    let s = if determinant > 1.0e-18 * uu * vv {
        ((uv * v.dot(w) - vv * u.dot(w)) / determinant).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let on_other = closest_on_segment(p + u * s, a, b);
    closest_on_segment(on_other, p, q).distance(on_other)
}

/// Distance between a segment and a triangle [m]; 0 where the segment pierces it.
pub fn segment_to_triangle([p, q]: [DVec3; 2], triangle: [DVec3; 3]) -> f64 {
    let [a, b, c] = triangle;
    let n = (b - a).cross(c - a);
    let (over_p, over_q) = ((p - a).dot(n), (q - a).dot(n));
    if (over_p > 0.0) != (over_q > 0.0) {
        let at = p + (q - p) * (over_p / (over_p - over_q));
        if [(a, b), (b, c), (c, a)].into_iter().all(|(u, v)| (v - u).cross(at - u).dot(n) >= 0.0) {
            return 0.0;
        }
    }
    let ends = [p, q].map(|end| closest_on_triangle(end, triangle).distance(end));
    let edges = [[a, b], [b, c], [c, a]].map(|edge| segment_distance([p, q], edge));
    ends.into_iter().chain(edges).fold(f64::INFINITY, f64::min)
}

/// Shortest translation that separates a triangle from a box around the origin [m], 0 or less if
/// they are apart: the least overlap along the 13 separating axes.
pub fn triangle_in_box(triangle: [DVec3; 3], half: DVec3) -> f64 {
    let [a, b, c] = triangle;
    let edges = [b - a, c - b, a - c];
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let crossed = edges.into_iter().flat_map(|edge| axes.map(|axis| edge.cross(axis)));
    let all = axes.into_iter().chain([edges[0].cross(edges[1])]).chain(crossed);
    let mut least = f64::INFINITY;
    for axis in all {
        if axis.length_squared() < 1.0e-20 {
            continue;
        }
        let axis = axis.normalize();
        let reach = axis.abs().dot(half);
        let along = triangle.map(|p| p.dot(axis));
        let low = along.into_iter().fold(f64::INFINITY, f64::min);
        let high = along.into_iter().fold(f64::NEG_INFINITY, f64::max);
        least = least.min((reach - low).min(high + reach));
    }
    least
}

/// Whether a ray hits a triangle (Möller and Trumbore 1997).
pub fn ray_hits(from: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> bool {
    let (u, v) = (b - a, c - a);
    let p = direction.cross(v);
    let determinant = u.dot(p);
    if determinant == 0.0 {
        return false;
    }
    let t = from - a;
    let first = t.dot(p) / determinant;
    let q = t.cross(u);
    let second = direction.dot(q) / determinant;
    first >= 0.0 && second >= 0.0 && first + second <= 1.0 && v.dot(q) / determinant > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    #[test]
    fn segments_and_points_have_their_distances_from_a_triangle() {
        let p = DVec3::new(0.25, 0.25, 0.5);
        assert_eq!(closest_on_triangle(p, TRIANGLE), p.with_z(0.0));
        assert_eq!(closest_on_triangle(DVec3::new(2.0, 0.0, 0.0), TRIANGLE), DVec3::X);
        assert_eq!(segment_to_triangle([p, p - DVec3::Z], TRIANGLE), 0.0);
        assert_eq!(segment_to_triangle([p, p + DVec3::Z], TRIANGLE), 0.5);
        let beside = DVec3::new(0.5, -0.25, -1.0);
        assert_eq!(segment_to_triangle([beside, beside + DVec3::Z * 2.0], TRIANGLE), 0.25);
    }

    #[test]
    fn a_triangle_in_a_box_is_as_deep_as_its_way_out() {
        let half = DVec3::splat(1.0);
        let lowered = TRIANGLE.map(|p| p + DVec3::Z * 0.875);
        assert!((triangle_in_box(lowered, half) - 0.125).abs() < 1.0e-12);
        assert!(triangle_in_box(TRIANGLE.map(|p| p + DVec3::Z * 1.25), half) < 0.0);
    }
}
