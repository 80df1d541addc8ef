//! Where a vertex and a triangle are closest, or two edges: a pair in each lane.

use crate::math::simd::{Float, Simd};
use crate::solver::self_collide::surface::contact::{Kind, VERTEX};

/// From the closest point of a triangle to a vertex (as `geom::closest::triangle_to_origin`), and what each particle counts
/// for.
#[inline(always)]
pub(crate) fn from_triangle<S: Simd>(s: S, x: [V<S::F>; 4]) -> (V<S::F>, [S::F; 4]) {
    let (zero, one) = (s.splat(0.0), s.splat(1.0));
    let [a, b, c] = [x[1].minus(x[0]), x[2].minus(x[0]), x[3].minus(x[0])];
    let (ab, ac) = (b.minus(a), c.minus(a));
    let [a1, b1, c1] = [zero - ab.dot(a), zero - ab.dot(b), zero - ab.dot(c)];
    let [a2, b2, c2] = [zero - ac.dot(a), zero - ac.dot(b), zero - ac.dot(c)];
    let (over_ab, over_ac, over_bc) = (a1 * b2 - b1 * a2, c1 * a2 - a1 * c2, b1 * c2 - c1 * b2);
    let (from_b, from_c) = (b2 - b1, c1 - c2);
    let scale = one / (over_bc + over_ac + over_ab);
    let mut weights = [over_ac * scale, over_ab * scale];
    // Each place in the order of the least to say: what is above 0 says that it is not there.
    let share = from_b / (from_b + from_c);
    let off = beyond(over_bc, zero - from_b, zero - from_c);
    weights = choose(s, off, weights, [one - share, share]);
    let off = beyond(over_ac, zero - a2, c2);
    weights = choose(s, off, weights, [zero, a2 / (a2 - c2)]);
    let off = beyond(over_ab, zero - a1, b1);
    weights = choose(s, off, weights, [a1 / (a1 - b1), zero]);
    let off = Float::max(zero - c2, c1 - c2);
    weights = choose(s, off, weights, [zero, one]);
    let off = Float::max(zero - b1, b2 - b1);
    weights = choose(s, off, weights, [one, zero]);
    let off = Float::max(a1, a2);
    let [v, w] = choose(s, off, weights, [zero; 2]);
    let to = a.plus(ab.times(v)).plus(ac.times(w));
    (to.times(zero - one), [one, v + w - one, zero - v, zero - w])
}

/// From the closest point of the second edge to that of the first (as `geom::closest::segment_to_segment`), and what each
/// particle counts for.
#[inline(always)]
pub(crate) fn from_edge<S: Simd>(s: S, x: [V<S::F>; 4]) -> (V<S::F>, [S::F; 4]) {
    let (u, v, r) = (x[1].minus(x[0]), x[3].minus(x[2]), x[0].minus(x[2]));
    let (uu, vv, uv) = (u.dot(u), v.dot(v), u.dot(v));
    let (ur, vr) = (u.dot(r), v.dot(r));
    let across = uu * vv - uv * uv;
    let amid = share(s, (uv * vr - ur * vv) / across);
    let amid = s.select(across - s.splat(1.0e-6) * uu * vv, amid, s.splat(0.5));
    let t = (uv * amid + vr) / vv;
    let (zero, one) = (s.splat(0.0), s.splat(1.0));
    let low = s.select(zero - t, share(s, (zero - ur) / uu), amid);
    let along = s.select(t - one, share(s, (uv - ur) / uu), low);
    let across = share(s, t);
    let way = r.plus(u.times(along)).minus(v.times(across));
    (way, [one - along, along, across - one, zero - across])
}

/// How far one side is from the other along a direction, at least; `x` is how far each particle is along it.
#[inline(always)]
pub(crate) fn between<F: Float, const FIRST: Kind>([a, b, c, d]: [F; 4]) -> F {
    if FIRST == VERTEX {
        a - Float::max(b, Float::max(c, d))
    } else {
        Float::min(a, b) - Float::max(c, d)
    }
}

#[inline(always)]
fn choose<S: Simd>(s: S, keep: S::F, old: [S::F; 2], new: [S::F; 2]) -> [S::F; 2] {
    [s.select(keep, old[0], new[0]), s.select(keep, old[1], new[1])]
}

#[inline(always)]
fn beyond<F: Float>(p: F, q: F, r: F) -> F {
    Float::max(Float::max(p, q), r)
}

/// Between 0 and 1.
#[inline(always)]
fn share<S: Simd>(s: S, t: S::F) -> S::F {
    Float::min(Float::max(t, s.splat(0.0)), s.splat(1.0))
}

/// A vector in each lane.
#[derive(Clone, Copy)]
pub(crate) struct V<F> {
    pub x: F,
    pub y: F,
    pub z: F,
}

impl<F: Float> V<F> {
    #[inline(always)]
    pub fn new([x, y, z, _]: [F; 4]) -> Self {
        Self { x, y, z }
    }

    #[inline(always)]
    pub fn along(&self, axis: usize) -> F {
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
    pub fn times(self, by: F) -> Self {
        Self { x: self.x * by, y: self.y * by, z: self.z * by }
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
