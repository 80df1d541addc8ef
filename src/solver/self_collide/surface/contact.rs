//! Contacts: vertex–triangle and edge–edge pairs with a contact normal and a minimum separation.
//!
//! ```text
//!        A ●            ▲ n        The closest points of a pair span the normal n of a plane that
//! ──────────┼───────────┼───       separates both sides at the start of the substep. While the
//!      B ───●────●      │          separation along n stays positive, the sides have not crossed,
//!                                  however the plane moved meanwhile.
//!
//! separation(n) = min over A of n·x − max over B of n·x
//! distance(n)   = n · Σ weightₖ xₖ              (closest points; weights as in `closest_lanes`)
//! ```
//! The non-crossing pass uses two separations of a contact: it restores `min_separation`, and it
//! accepts `tolerated_separation` if it cannot.
//!
//! Reads [`SweptParticles`]; writes [`Contact`] values.
//!
//! Invariant: a contact with `min_separation >= 0` was separated along some direction at the start
//! of the substep, so an exact solution of all contacts exists: the start positions.

use crate::geometry::closest_points;
use crate::math::wide4::{Float4, Wide4, xyz};
use crate::math::{TINY, max, min};
use crate::solver::self_collide::surface::swept_particles::SweptParticles;
use glam::Vec3;

/// Minimum separation that the non-crossing pass restores, as a share of the gap; less if the sides
/// were nearer at the start.
pub(crate) const SEPARATION_SHARE: f32 = 0.25;

/// Separation that the non-crossing pass tolerates: a share of the former, or of the separation at
/// the start if that was less.
pub(crate) const TOLERATED_SHARE: f32 = 0.2;
const TOLERATED_SHARE_OF_START: f32 = 0.998;

/// Sides that start nearer than the tolerated separation are moved apart by this factor in a
/// substep.
const GROWTH: f32 = 1.1;

/// A new normal is rejected if it lowers the separation at the start below this share of the old
/// one.
pub(crate) const MIN_KEPT_SHARE: f32 = 0.5;

/// Sides nearer than this have no separating direction [m].
pub(crate) const MIN_DISTANCE: f32 = 1.0e-7;

/// A direction is clear if the separation of two edges along it is at least this share of their
/// distance. For nearly parallel edges it is not.
pub(crate) const CLEAR_SHARE: f32 = 0.9;

/// The vector between the closest points is replaced by the face normal if the square of the cosine
/// between both is at least this.
pub(crate) const ALIGNED_COS2: f32 = 0.98;

/// The kind of a pair, and the number of particles on its first side: 1 vertex against a triangle,
/// or 2 vertices (an edge) against an edge.
pub(crate) type ContactKind = u32;
pub(crate) const VERTEX_TRIANGLE: ContactKind = 1;
pub(crate) const EDGE_EDGE: ContactKind = 2;

/// A pair of sides that may touch in a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    /// The particles: first the `kind` ones of the first side, then those of the second.
    pub ids: [u32; 4],
    pub kind: ContactKind,
    /// Weights of the particles in the closest points: they sum to 1 on the first side, to −1 on
    /// the second.
    pub weights: [f32; 4],
    /// The contact normal, from the second side to the first.
    pub n: Vec3,
    /// Distance that the contact solver keeps between both sides [m].
    pub gap: f32,
    /// Separation along `n` that the non-crossing pass restores [m]; negative: the pass ignores the
    /// contact.
    pub min_separation: f32,
    /// Separation along `n` that the non-crossing pass accepts [m].
    pub tolerated_separation: f32,
}

/// Closest points of a pair: the weights of the particles, the unit direction between the points,
/// and their distance [m].
#[derive(Clone, Copy)]
struct ClosestPoints {
    weights: [f32; 4],
    n: Vec3,
    distance: f32,
}

#[inline(always)]
fn closest_vertex_triangle([v, a, b, c]: [Vec3; 4]) -> ClosestPoints {
    let corners = [a - v, b - v, c - v];
    let weights = closest_points::triangle_to_origin(corners);
    let d = -closest_points::interpolate(corners, weights);
    let distance = d.length();
    let [wa, wb, wc] = weights;
    let is_inside = wa > 0.0 && wb > 0.0 && wc > 0.0;
    let normal = if is_inside { (b - a).cross(c - a) } else { Vec3::ZERO };
    let n = contact_normal(d, distance, normal);
    ClosestPoints { weights: [1.0, -wa, -wb, -wc], n, distance }
}

#[inline(always)]
fn closest_edge_edge([p, q, r, s]: [Vec3; 4]) -> ClosestPoints {
    let (t, u) = closest_points::segment_to_segment([p, q], [r, s]);
    let (first, second) = (q - p, s - r);
    let d = p - r + first * t - second * u;
    let distance = d.length();
    let is_inside = t > 0.0 && t < 1.0 && u > 0.0 && u < 1.0;
    let normal = if is_inside { first.cross(second) } else { Vec3::ZERO };
    let weights = [1.0 - t, t, u - 1.0, -u];
    ClosestPoints { weights, n: contact_normal(d, distance, normal), distance }
}

/// For two nearly parallel edges, whose closest points are ill-conditioned: the direction with the
/// largest separation among `closest`, both common normals, and the vectors from each end to the
/// other edge.
fn best_separating_direction(x: [Vec3; 4], closest: ClosestPoints) -> ClosestPoints {
    let [p, q, r, s] = x;
    let mut best = (separation(x, EDGE_EDGE, closest.n), closest);
    let mut test = |weights: [f32; 4], d: Vec3| {
        let length = d.length();
        if length > TINY {
            let n = d * (1.0 / length);
            let distance = separation(x, EDGE_EDGE, n);
            if distance > best.0 {
                best = (distance, ClosestPoints { weights, n, distance });
            }
        }
    };
    let normal = (q - p).cross(s - r);
    test(closest.weights, normal);
    test(closest.weights, -normal);
    let ends = [
        ([p; 2], [r, s], Some(0.0), None),
        ([q; 2], [r, s], Some(1.0), None),
        ([p, q], [r; 2], None, Some(0.0)),
        ([p, q], [s; 2], None, Some(1.0)),
    ];
    for (one, other, fixed_t, fixed_u) in ends {
        let (t, u) = closest_points::segment_to_segment(one, other);
        let (t, u) = (fixed_t.unwrap_or(t), fixed_u.unwrap_or(u));
        test([1.0 - t, t, u - 1.0, -u], p - r + (q - p) * t - (s - r) * u);
    }
    best.1
}

/// The unit direction of `d`, a vector of length `distance` between closest points. If `d` is
/// nearly parallel to `normal`, the result is the unit normal, which is more exact for a short `d`.
#[inline(always)]
fn contact_normal(d: Vec3, distance: f32, normal: Vec3) -> Vec3 {
    let along = d.dot(normal);
    let length = normal.length();
    if along * along > ALIGNED_COS2 * distance * distance * length * length {
        normal * (if along > 0.0 { 1.0 } else { -1.0 } / length)
    } else {
        d * (1.0 / distance)
    }
}

/// The separation of both sides along `n` [m]: negative if they overlap along it.
#[inline(always)]
pub(crate) fn separation(x: [Vec3; 4], kind: ContactKind, n: Vec3) -> f32 {
    let [a, b, c, d] = [n.dot(x[0]), n.dot(x[1]), n.dot(x[2]), n.dot(x[3])];
    if kind == VERTEX_TRIANGLE { a - max(b, max(c, d)) } else { min(a, b) - max(c, d) }
}

/// The positions of the four particles of a pair.
#[inline(always)]
pub(crate) fn positions(x: &[Float4], ids: [u32; 4]) -> [Vec3; 4] {
    let [a, b, c, d] = ids;
    [xyz(&x[a as usize]), xyz(&x[b as usize]), xyz(&x[c as usize]), xyz(&x[d as usize])]
}

/// The distance of the closest points along the contact normal [m].
#[inline(always)]
pub(crate) fn distance_along_normal(x: &[Float4], contact: &Contact) -> f32 {
    let [a, b, c, d] = contact.ids.map(|id| Wide4::load(&x[id as usize]));
    let [p, q, r, s] = contact.weights;
    Wide4::from_vec3(contact.n).dot3(a.scale(p) + b.scale(q) + c.scale(r) + d.scale(s))
}

#[inline(always)]
fn closest<const KIND: ContactKind>(x: [Vec3; 4]) -> ClosestPoints {
    if KIND == VERTEX_TRIANGLE { closest_vertex_triangle(x) } else { closest_edge_edge(x) }
}

/// As [`closest`], not inlined: few pairs need it, and each inlined copy would cost code size.
#[inline(never)]
fn closest_outlined<const KIND: ContactKind>(x: [Vec3; 4]) -> ClosestPoints {
    closest::<KIND>(x)
}

/// The least separation along `n` that both sides may have at the end of the substep, by their
/// motion bounds [m].
#[inline(always)]
fn end_separation<const KIND: ContactKind>(motion: &SweptParticles, ids: [u32; 4], n: Vec3) -> f32 {
    let [a, b] = [motion.end_range_along(ids[0], n), motion.end_range_along(ids[1], n)];
    let [c, d] = [motion.end_range_along(ids[2], n), motion.end_range_along(ids[3], n)];
    if KIND == VERTEX_TRIANGLE {
        a[0] - max(b[1], max(c[1], d[1]))
    } else {
        min(a[0], b[0]) - max(c[1], d[1])
    }
}

impl Contact {
    /// A contact that the contact solver and the non-crossing pass ignore until it is filled in.
    pub fn inactive(ids: [u32; 4], kind: ContactKind) -> Self {
        Self {
            ids,
            kind,
            weights: [0.0; 4],
            n: Vec3::ZERO,
            gap: 0.0,
            min_separation: -1.0,
            tolerated_separation: -1.0,
        }
    }

    /// The distance of both sides [m].
    pub fn distance<const KIND: ContactKind>(x: [Vec3; 4]) -> f32 {
        closest_outlined::<KIND>(x).distance
    }

    /// Narrow phase of one pair: the contact of both sides, or `None` if they cannot come nearer
    /// than `gap` [m] in this substep or touch already at its start. `own_gap` is the gap of this
    /// pair, at most `gap`.
    #[inline(never)]
    pub fn detect<const KIND: ContactKind>(
        ids: [u32; 4],
        motion: &SweptParticles,
        gap: f32,
        own_gap: f32,
    ) -> Option<Self> {
        let start = positions(&motion.start, ids);
        let mut then = closest_outlined::<KIND>(start);
        let [a, b, c, d] = ids;
        let relative = if KIND == VERTEX_TRIANGLE {
            motion.swept_point(a).max_relative_displacement(&motion.swept_aabb([b, c, d]))
        } else {
            motion.swept_aabb([a, b]).max_relative_displacement(&motion.swept_aabb([c, d]))
        };
        if then.distance > gap + relative || then.distance <= MIN_DISTANCE {
            return None;
        }
        if KIND == EDGE_EDGE && separation(start, EDGE_EDGE, then.n) < CLEAR_SHARE * then.distance {
            then = best_separating_direction(start, then);
        }
        // Sides that one direction separates at the start and at the end have not crossed.
        let gap = own_gap;
        let ends_separated = |n: Vec3| end_separation::<KIND>(motion, ids, n) > gap;
        if ends_separated(then.n) && separation(start, KIND, then.n) > MIN_DISTANCE {
            return None;
        }
        let mut contact =
            Self { weights: then.weights, n: then.n, gap, ..Self::inactive(ids, KIND) };
        let now = positions(&motion.now, ids);
        if distance_along_normal(&motion.now, &contact) < gap {
            contact.update_normal(closest_outlined::<KIND>(now), start);
            if ends_separated(contact.n) && separation(start, KIND, contact.n) > MIN_DISTANCE {
                return None;
            }
        }
        contact.set_separation_from(start);
        Some(contact)
    }

    /// Replaces normal and weights by the current closest points `now`, if their direction
    /// separated both sides at the start, and not by much less than the old normal.
    #[inline(always)]
    fn update_normal(&mut self, now: ClosestPoints, start: [Vec3; 4]) {
        let enough = self.gap * (SEPARATION_SHARE * TOLERATED_SHARE);
        let before = min(separation(start, self.kind, self.n), enough);
        let then = separation(start, self.kind, now.n);
        if now.distance > MIN_DISTANCE
            && then > MIN_DISTANCE
            && min(then, enough) > MIN_KEPT_SHARE * before
        {
            (self.weights, self.n) = (now.weights, now.n);
        }
    }

    /// Computes the normal anew from the current positions `x`. The contact is unchanged if that
    /// would lower the tolerated separation by much.
    #[inline(never)]
    pub(crate) fn refresh_normal(&mut self, start: [Vec3; 4], x: &[Float4]) {
        let now = positions(x, self.ids);
        let now = if self.kind == VERTEX_TRIANGLE {
            closest_outlined::<VERTEX_TRIANGLE>(now)
        } else {
            closest_outlined::<EDGE_EDGE>(now)
        };
        let before = *self;
        self.update_normal(now, start);
        self.set_separation_from(start);
        if self.tolerated_separation < before.tolerated_separation * MIN_KEPT_SHARE {
            *self = before;
        }
    }

    #[inline(always)]
    fn set_separation_from(&mut self, start: [Vec3; 4]) {
        self.set_separation(separation(start, self.kind, self.n));
    }

    /// Sets both separations for the non-crossing pass from the separation at the start of the
    /// substep [m].
    #[inline(always)]
    pub(crate) fn set_separation(&mut self, at_start: f32) {
        let most = self.gap * SEPARATION_SHARE;
        (self.min_separation, self.tolerated_separation) = if at_start > MIN_DISTANCE {
            // A small separation must grow, or rounding would use it up.
            let factor = if at_start < most * TOLERATED_SHARE { GROWTH } else { 1.0 };
            let tolerated = min(at_start * TOLERATED_SHARE_OF_START, most * TOLERATED_SHARE);
            (min(at_start * factor, most), tolerated)
        } else {
            (-1.0, -1.0)
        };
    }

    /// Whether both sides are edges, and a closest point is an end of its edge.
    #[inline(always)]
    pub(crate) fn is_at_end_of_edge(&self) -> bool {
        self.kind == EDGE_EDGE && self.weights.contains(&0.0)
    }

    /// Makes the contact solver and the non-crossing pass ignore the contact.
    pub(crate) fn disable(&mut self) {
        self.gap = f32::NEG_INFINITY;
        (self.min_separation, self.tolerated_separation) = (-1.0, -1.0);
    }
}
