//! SIMD kernels for closest points: vertex–triangle and edge–edge, one pair in each lane.
//!
//! ```text
//! vertex–triangle                              edge–edge
//!      v ●                                          p ●──────●──── q
//!        │ d                                                 │ d
//!   ─────●───── a b c                               r ●──────●──── s
//! weights (1, −wa, −wb, −wc)                   weights (1−t, t, u−1, −u)
//!
//! d = Σ weightₖ xₖ
//! ```
//! Both return the vector d from the closest point of the second side to the closest point of the
//! first, and the weights of the four particles. Vertex–triangle follows Ericson, "Real-Time
//! Collision Detection", 5.1.5 (Voronoi regions), edge–edge 5.1.9, both without branches. The
//! scalar versions are `closest_points::triangle_to_origin` and
//! `closest_points::segment_to_segment`.
//!
//! Reads positions; writes nothing.
//!
//! Invariant: a lane never reads another lane, so the result has the same bits for any vector
//! width.

use crate::math::simd::{Float, Simd};
use crate::solver::self_collide::surface::contact::{ContactKind, VERTEX_TRIANGLE};

/// The vector from the closest point of triangle `x[1..4]` to vertex `x[0]`, and the weight of each
/// particle.
#[inline(always)]
pub(crate) fn closest_vertex_triangle<S: Simd>(
    s: S,
    x: [Vec3Lanes<S::F>; 4],
) -> (Vec3Lanes<S::F>, [S::F; 4]) {
    let (zero, one) = (s.splat(0.0), s.splat(1.0));
    let [a, b, c] = [x[1].minus(x[0]), x[2].minus(x[0]), x[3].minus(x[0])];
    let (ab, ac) = (b.minus(a), c.minus(a));
    let [a1, b1, c1] = [zero - ab.dot(a), zero - ab.dot(b), zero - ab.dot(c)];
    let [a2, b2, c2] = [zero - ac.dot(a), zero - ac.dot(b), zero - ac.dot(c)];
    let (over_ab, over_ac, over_bc) = (a1 * b2 - b1 * a2, c1 * a2 - a1 * c2, b1 * c2 - c1 * b2);
    let (from_b, from_c) = (b2 - b1, c1 - c2);
    let scale = one / (over_bc + over_ac + over_ab);
    let mut weights = [over_ac * scale, over_ab * scale];
    // From the face to edges to corners; each region replaces the weights before it. `outside`
    // above 0 says that the closest point is not in that region.
    let t = from_b / (from_b + from_c);
    let outside = max3(over_bc, zero - from_b, zero - from_c);
    weights = select2(s, outside, weights, [one - t, t]);
    let outside = max3(over_ac, zero - a2, c2);
    weights = select2(s, outside, weights, [zero, a2 / (a2 - c2)]);
    let outside = max3(over_ab, zero - a1, b1);
    weights = select2(s, outside, weights, [a1 / (a1 - b1), zero]);
    let outside = Float::max(zero - c2, c1 - c2);
    weights = select2(s, outside, weights, [zero, one]);
    let outside = Float::max(zero - b1, b2 - b1);
    weights = select2(s, outside, weights, [one, zero]);
    let outside = Float::max(a1, a2);
    let [v, w] = select2(s, outside, weights, [zero; 2]);
    let to = a.plus(ab.times(v)).plus(ac.times(w));
    (to.times(zero - one), [one, v + w - one, zero - v, zero - w])
}

/// The vector from the closest point of edge `x[2..4]` to the closest point of edge `x[0..2]`, and
/// the weight of each particle.
#[inline(always)]
pub(crate) fn closest_edge_edge<S: Simd>(
    s: S,
    x: [Vec3Lanes<S::F>; 4],
) -> (Vec3Lanes<S::F>, [S::F; 4]) {
    let (u, v, r) = (x[1].minus(x[0]), x[3].minus(x[2]), x[0].minus(x[2]));
    let (uu, vv, uv) = (u.dot(u), v.dot(v), u.dot(v));
    let (ur, vr) = (u.dot(r), v.dot(r));
    let determinant = uu * vv - uv * uv;
    let inner = clamp01(s, (uv * vr - ur * vv) / determinant);
    let inner = s.select(determinant - s.splat(1.0e-6) * uu * vv, inner, s.splat(0.5));
    let t = (uv * inner + vr) / vv;
    let (zero, one) = (s.splat(0.0), s.splat(1.0));
    let low = s.select(zero - t, clamp01(s, (zero - ur) / uu), inner);
    let along_first = s.select(t - one, clamp01(s, (uv - ur) / uu), low);
    let along_second = clamp01(s, t);
    let d = r.plus(u.times(along_first)).minus(v.times(along_second));
    (d, [one - along_first, along_first, along_second - one, zero - along_second])
}

/// The separation of both sides along a direction, from the coordinates of the four particles along
/// it: the lowest of the first side minus the highest of the second.
#[inline(always)]
pub(crate) fn separation<F: Float, const KIND: ContactKind>([a, b, c, d]: [F; 4]) -> F {
    if KIND == VERTEX_TRIANGLE {
        a - Float::max(b, Float::max(c, d))
    } else {
        Float::min(a, b) - Float::max(c, d)
    }
}

/// `old` where `keeps_old` is above 0, else `new`.
#[inline(always)]
fn select2<S: Simd>(s: S, keeps_old: S::F, old: [S::F; 2], new: [S::F; 2]) -> [S::F; 2] {
    [s.select(keeps_old, old[0], new[0]), s.select(keeps_old, old[1], new[1])]
}

#[inline(always)]
fn max3<F: Float>(p: F, q: F, r: F) -> F {
    Float::max(Float::max(p, q), r)
}

#[inline(always)]
fn clamp01<S: Simd>(s: S, t: S::F) -> S::F {
    Float::min(Float::max(t, s.splat(0.0)), s.splat(1.0))
}

/// A 3D vector in each lane.
#[derive(Clone, Copy)]
pub(crate) struct Vec3Lanes<F> {
    pub x: F,
    pub y: F,
    pub z: F,
}

impl<F: Float> Vec3Lanes<F> {
    #[inline(always)]
    pub fn new([x, y, z, _]: [F; 4]) -> Self {
        Self { x, y, z }
    }

    #[inline(always)]
    pub fn axis(&self, axis: usize) -> F {
        [self.x, self.y, self.z][axis]
    }

    #[inline(always)]
    pub fn plus(self, v: Self) -> Self {
        Self { x: self.x + v.x, y: self.y + v.y, z: self.z + v.z }
    }

    #[inline(always)]
    pub fn minus(self, v: Self) -> Self {
        Self { x: self.x - v.x, y: self.y - v.y, z: self.z - v.z }
    }

    #[inline(always)]
    pub fn times(self, factor: F) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }

    #[inline(always)]
    pub fn cross(self, v: Self) -> Self {
        Self {
            x: self.y * v.z - v.y * self.z,
            y: self.z * v.x - v.z * self.x,
            z: self.x * v.y - v.x * self.y,
        }
    }

    #[inline(always)]
    pub fn dot(self, v: Self) -> F {
        self.x * v.x + self.y * v.y + self.z * v.z
    }
}
