//! Closest points of triangles and segments.

use crate::math::TINY;
use glam::Vec3;

/// What each corner of a triangle weighs in its point closest to the origin.
///
/// The origin lies beyond a corner, beyond an edge, or over the inside; which one, the signs of
/// products tell (Ericson, "Real-Time Collision Detection", 2005, sec. 5.1.5).
pub(crate) fn of_triangle([a, b, c]: [Vec3; 3]) -> [f32; 3] {
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
    let over_ab = a1 * b2 - b1 * a2;
    if over_ab <= 0.0 && a1 >= 0.0 && b1 <= 0.0 {
        let t = a1 / (a1 - b1);
        return [1.0 - t, t, 0.0];
    }
    let over_ac = c1 * a2 - a1 * c2;
    if over_ac <= 0.0 && a2 >= 0.0 && c2 <= 0.0 {
        let t = a2 / (a2 - c2);
        return [1.0 - t, 0.0, t];
    }
    let over_bc = b1 * c2 - c1 * b2;
    let (from_b, from_c) = (b2 - b1, c1 - c2);
    if over_bc <= 0.0 && from_b >= 0.0 && from_c >= 0.0 {
        let t = from_b / (from_b + from_c);
        return [0.0, 1.0 - t, t];
    }
    let scale = 1.0 / (over_bc + over_ac + over_ab);
    let (v, w) = (over_ac * scale, over_ab * scale);
    [1.0 - v - w, v, w]
}

/// Where two segments are closest: the shares of the way along each.
pub(crate) fn of_segments([a, b]: [Vec3; 2], [p, q]: [Vec3; 2]) -> (f32, f32) {
    let (u, v, r) = (b - a, q - p, a - p);
    let (uu, vv, uv) = (u.dot(u), v.dot(v), u.dot(v));
    let (ur, vr) = (u.dot(r), v.dot(r));
    if uu <= TINY {
        return (0.0, if vv <= TINY { 0.0 } else { share(vr / vv) });
    }
    if vv <= TINY {
        return (share(-ur / uu), 0.0);
    }
    let across = uu * vv - uv * uv;
    // Parallel ones are as close in many places; any will do.
    let s = if across > 1.0e-6 * uu * vv { share((uv * vr - ur * vv) / across) } else { 0.5 };
    let t = (uv * s + vr) / vv;
    if t < 0.0 {
        (share(-ur / uu), 0.0)
    } else if t > 1.0 {
        (share((uv - ur) / uu), 1.0)
    } else {
        (s, t)
    }
}

/// Between 0 and 1.
#[inline(always)]
fn share(t: f32) -> f32 {
    if t > 0.0 { if t < 1.0 { t } else { 1.0 } } else { 0.0 }
}

/// What weights make of three points.
#[inline(always)]
pub(crate) fn blend([a, b, c]: [Vec3; 3], [u, v, w]: [f32; 3]) -> Vec3 {
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
                least = least.min(blend(triangle, [1.0 - v - w, v, w]).length());
            }
        }
        least
    }

    #[test]
    fn no_point_of_a_triangle_is_closer_than_the_closest() {
        let corners =
            [Vec3::new(0.0, 0.2, 0.1), Vec3::new(1.0, 0.0, 0.3), Vec3::new(0.3, 0.9, -0.2)];
        for i in 0..60 {
            let wave = |k: f32| (i as f32 * k).sin() * 1.5;
            let from = Vec3::new(wave(1.1), wave(2.3), wave(0.7));
            let triangle = corners.map(|corner| corner - from);
            let weights = of_triangle(triangle);
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1.0e-5);
            assert!(weights.iter().all(|w| *w >= -1.0e-6));
            let ours = blend(triangle, weights).length();
            let found = closest_by_search(triangle);
            assert!(ours <= found + 1.0e-5 && ours >= found - 0.02, "{ours} m, found {found} m");
        }
    }

    #[test]
    fn no_points_of_segments_are_closer_than_the_closest() {
        for i in 0..60 {
            let point = |k: f32| {
                let wave = |j: f32| (i as f32 * k + j).sin();
                Vec3::new(wave(0.0), wave(2.0), wave(4.0))
            };
            let (one, other) = ([point(1.1), point(2.3)], [point(0.7), point(3.1)]);
            let at = |ends: [Vec3; 2], t: f32| ends[0] + (ends[1] - ends[0]) * t;
            let (s, t) = of_segments(one, other);
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
    fn points_and_parallels_are_segments_too() {
        let dot = [Vec3::Y, Vec3::Y];
        assert_eq!(of_segments(dot, [Vec3::ZERO, Vec3::X]), (0.0, 0.0));
        assert_eq!(of_segments([Vec3::ZERO, Vec3::X], dot), (0.0, 0.0));
        let along = [Vec3::Y + Vec3::X, Vec3::Y + Vec3::X * 4.0];
        let (s, t) = of_segments([Vec3::ZERO, Vec3::X * 2.0], along);
        assert!((2.0 * s - (1.0 + 3.0 * t)).abs() < 1.0e-6, "{s} {t}");
    }
}
