//! Closest points on triangles and segments.
//!
//! Point and triangle: Ericson, "Real-Time Collision Detection", 2005, sec. 5.1.5: the signs of dot
//! products tell in which Voronoi region (corner, edge, or face) the point lies. Segment and
//! segment: the same book, sec. 5.1.9.
//!
//! Reads positions and writes nothing.
//! Invariant: results are barycentric weights or segment parameters in 0..=1, up to rounding.

use crate::math::TINY;
use glam::Vec3;

/// Returns the barycentric weights of the point of a triangle that is closest to the origin.
///
/// For another point p, subtract p from the corners first.
pub(crate) fn triangle_to_origin([a, b, c]: [Vec3; 3]) -> [f32; 3] {
    let (ab, ac) = (b - a, c - a);
    let (a1, a2) = (-ab.dot(a), -ac.dot(a));
    if a1 <= 0.0 && a2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let (b1, b2) = (-ab.dot(b), -ac.dot(b));
    if b1 >= 0.0 && b2 <= b1 {
        return [0.0, 1.0, 0.0];
    }
    let (c1, c2) = (-ab.dot(c), -ac.dot(c));
    if c2 >= 0.0 && c1 <= c2 {
        return [0.0, 0.0, 1.0];
    }
    let area_ab = a1 * b2 - b1 * a2;
    if area_ab <= 0.0 && a1 >= 0.0 && b1 <= 0.0 {
        let t = a1 / (a1 - b1);
        return [1.0 - t, t, 0.0];
    }
    let area_ac = c1 * a2 - a1 * c2;
    if area_ac <= 0.0 && a2 >= 0.0 && c2 <= 0.0 {
        let t = a2 / (a2 - c2);
        return [1.0 - t, 0.0, t];
    }
    let area_bc = b1 * c2 - c1 * b2;
    let (from_b, from_c) = (b2 - b1, c1 - c2);
    if area_bc <= 0.0 && from_b >= 0.0 && from_c >= 0.0 {
        let t = from_b / (from_b + from_c);
        return [0.0, 1.0 - t, t];
    }
    let scale = 1.0 / (area_bc + area_ac + area_ab);
    let (v, w) = (area_ac * scale, area_ab * scale);
    [1.0 - v - w, v, w]
}

/// Returns the parameters (s, t), each in 0..=1, of the closest points a + s (b − a) and
/// p + t (q − p) of two segments. Segments without a length are points.
pub(crate) fn segment_to_segment([a, b]: [Vec3; 2], [p, q]: [Vec3; 2]) -> (f32, f32) {
    let (u, v, r) = (b - a, q - p, a - p);
    let (uu, vv, uv) = (u.dot(u), v.dot(v), u.dot(v));
    let (ur, vr) = (u.dot(r), v.dot(r));
    if uu <= TINY {
        return (0.0, if vv <= TINY { 0.0 } else { clamp_unit(vr / vv) });
    }
    if vv <= TINY {
        return (clamp_unit(-ur / uu), 0.0);
    }
    let determinant = uu * vv - uv * uv;
    // Parallel segments have many closest pairs; the middle of the first is taken.
    let s = if determinant > 1.0e-6 * uu * vv {
        clamp_unit((uv * vr - ur * vv) / determinant)
    } else {
        0.5
    };
    let t = (uv * s + vr) / vv;
    if t < 0.0 {
        (clamp_unit(-ur / uu), 0.0)
    } else if t > 1.0 {
        (clamp_unit((uv - ur) / uu), 1.0)
    } else {
        (s, t)
    }
}

/// Clamps to 0..=1.
#[inline(always)]
fn clamp_unit(t: f32) -> f32 {
    if t > 0.0 { if t < 1.0 { t } else { 1.0 } } else { 0.0 }
}

/// Returns the weighted sum of three points: the point with these barycentric coordinates.
#[inline(always)]
pub(crate) fn interpolate([a, b, c]: [Vec3; 3], [u, v, w]: [f32; 3]) -> Vec3 {
    a * u + b * v + c * w
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closest_by_search(triangle: [Vec3; 3]) -> f32 {
        let mut least = f32::INFINITY;
        for i in 0..=200 {
            for j in 0..=200 - i {
                let (v, w) = (i as f32 / 200.0, j as f32 / 200.0);
                least = least.min(interpolate(triangle, [1.0 - v - w, v, w]).length());
            }
        }
        least
    }

    #[test]
    fn sampled_points_of_a_triangle_are_not_closer() {
        let corners =
            [Vec3::new(0.0, 0.2, 0.1), Vec3::new(1.0, 0.0, 0.3), Vec3::new(0.3, 0.9, -0.2)];
        for i in 0..60 {
            let wave = |k: f32| (i as f32 * k).sin() * 1.5;
            let from = Vec3::new(wave(1.1), wave(2.3), wave(0.7));
            let triangle = corners.map(|corner| corner - from);
            let weights = triangle_to_origin(triangle);
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1.0e-5);
            assert!(weights.iter().all(|w| *w >= -1.0e-6));
            let ours = interpolate(triangle, weights).length();
            let found = closest_by_search(triangle);
            assert!(ours <= found + 1.0e-5 && ours >= found - 0.02, "{ours} m, found {found} m");
        }
    }

    #[test]
    fn sampled_points_of_segments_are_not_closer() {
        for i in 0..60 {
            let point = |k: f32| {
                let wave = |j: f32| (i as f32 * k + j).sin();
                Vec3::new(wave(0.0), wave(2.0), wave(4.0))
            };
            let (one, other) = ([point(1.1), point(2.3)], [point(0.7), point(3.1)]);
            let at = |ends: [Vec3; 2], t: f32| ends[0] + (ends[1] - ends[0]) * t;
            let (s, t) = segment_to_segment(one, other);
            assert!((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t));
            let ours = (at(one, s) - at(other, t)).length();
            let shares = || (0..=100).map(|k| k as f32 / 100.0);
            let found = shares()
                .flat_map(|s| shares().map(move |t| (at(one, s) - at(other, t)).length()))
                .fold(f32::INFINITY, f32::min);
            assert!(ours <= found + 1.0e-5 && ours >= found - 0.03, "{ours} m, found {found} m");
        }
    }

    #[test]
    fn degenerate_and_parallel_segments_have_closest_points() {
        let dot = [Vec3::Y, Vec3::Y];
        assert_eq!(segment_to_segment(dot, [Vec3::ZERO, Vec3::X]), (0.0, 0.0));
        assert_eq!(segment_to_segment([Vec3::ZERO, Vec3::X], dot), (0.0, 0.0));
        let along = [Vec3::Y + Vec3::X, Vec3::Y + Vec3::X * 4.0];
        let (s, t) = segment_to_segment([Vec3::ZERO, Vec3::X * 2.0], along);
        assert!((2.0 * s - (1.0 + 3.0 * t)).abs() < 1.0e-6, "{s} {t}");
    }
}
