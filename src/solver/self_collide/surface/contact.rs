//! The pairs that may meet in a substep, each with a direction that tells its sides apart.
//!
//! ```text
//!        A ●            ▲ n        Where a pair is closest, what leads from one side to the other
//! ──────────┼───────────┼───       is normal to a plane with the sides wholly on either side of it.
//!      B ───●────●      │          While they stay so along n they cannot have crossed, wherever
//!                                  the plane went meanwhile.
//! ```

use crate::geometry::closest_points;
use crate::math::wide4::Four;
use crate::math::wide4::{Float4, xyz};
use crate::math::{TINY, max, min};
use crate::solver::self_collide::surface::swept_particles::Motion;
use glam::Vec3;

/// A fence leaves a share of their gap between two sides; if there was less, what there was.
pub(crate) const SLIT: f32 = 0.25;

/// What is let be: so much of that, or of what there was.
pub(crate) const ENOUGH: f32 = 0.2;
const LEAST: f32 = 0.998;

/// Sides that are nearer than what is let be come apart by this much of how far they are in a substep.
const MORE: f32 = 1.1;

/// Another direction that would let sides come nearer than this share of what they may is not taken.
pub(crate) const WORSE: f32 = 0.5;

/// Nearer than this no direction tells sides apart [m].
pub(crate) const NOTHING: f32 = 1.0e-7;

/// The share of their distance that a direction tells two edges apart by, unless they are too nearly parallel.
pub(crate) const CLEAR: f32 = 0.9;

/// How well a way must lead along a normal that it is taken for it (the square of a cosine).
pub(crate) const SAME: f32 = 0.98;

/// What meets, by how many particles the first side has: a vertex and a triangle, or two edges.
pub(crate) type Kind = u32;
pub(crate) const VERTEX: Kind = 1;
pub(crate) const EDGES: Kind = 2;

/// Two sides that may meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    pub ids: [u32; 4],
    /// How many of them are the first side.
    pub first: u32,
    /// What each counts for in the closest points: above 0 on the first side, below 0 on the second.
    pub share: [f32; 4],
    /// From the second side to the first.
    pub n: Vec3,
    /// How far they keep apart [m].
    pub gap: f32,
    /// All particles of the first side stay so far from all of the second along `n`; negative if
    /// nothing keeps them [m].
    pub slit: f32,
    /// The least of it that is let be [m].
    pub least: f32,
}

/// A pair as it is closest: what each particle counts for, from where to where.
#[derive(Clone, Copy)]
struct Closest {
    share: [f32; 4],
    n: Vec3,
    distance: f32,
}

/// A vertex and a triangle.
#[inline(always)]
fn vertex_closest([v, a, b, c]: [Vec3; 4]) -> Closest {
    let corners = [a - v, b - v, c - v];
    let weights = closest_points::triangle_to_origin(corners);
    let way = -closest_points::interpolate(corners, weights);
    let distance = way.length();
    let [wa, wb, wc] = weights;
    let is_inside = wa > 0.0 && wb > 0.0 && wc > 0.0;
    let normal = if is_inside { (b - a).cross(c - a) } else { Vec3::ZERO };
    Closest { share: [1.0, -wa, -wb, -wc], n: direction(way, distance, normal), distance }
}

/// Two edges.
#[inline(always)]
fn edge_closest([p, q, r, s]: [Vec3; 4]) -> Closest {
    let (t, u) = closest_points::segment_to_segment([p, q], [r, s]);
    let (along, across) = (q - p, s - r);
    let way = p - r + along * t - across * u;
    let distance = way.length();
    let is_inside = t > 0.0 && t < 1.0 && u > 0.0 && u < 1.0;
    let normal = if is_inside { along.cross(across) } else { Vec3::ZERO };
    let share = [1.0 - t, t, u - 1.0, -u];
    Closest { share, n: direction(way, distance, normal), distance }
}

/// Two edges that are nearly parallel, so that where they are closest is not well known: what else tells them
/// apart better, which is what both are square to, or leads from an end to the other edge.
fn told_apart(x: [Vec3; 4], closest: Closest) -> Closest {
    let [p, q, r, s] = x;
    let mut best = (between(x, 2, closest.n), closest);
    let mut look = |share: [f32; 4], way: Vec3| {
        let length = way.length();
        if length > TINY {
            let n = way * (1.0 / length);
            let distance = between(x, 2, n);
            if distance > best.0 {
                best = (distance, Closest { share, n, distance });
            }
        }
    };
    let normal = (q - p).cross(s - r);
    look(closest.share, normal);
    look(closest.share, -normal);
    let ends = [
        ([p; 2], [r, s], Some(0.0), None),
        ([q; 2], [r, s], Some(1.0), None),
        ([p, q], [r; 2], None, Some(0.0)),
        ([p, q], [s; 2], None, Some(1.0)),
    ];
    for (one, other, at_one, at_other) in ends {
        let (t, u) = closest_points::segment_to_segment(one, other);
        let (t, u) = (at_one.unwrap_or(t), at_other.unwrap_or(u));
        look([1.0 - t, t, u - 1.0, -u], p - r + (q - p) * t - (s - r) * u);
    }
    best.1
}

/// The direction of a way, by the normal that it is along if there is one: of a short way that is more exact.
#[inline(always)]
fn direction(way: Vec3, distance: f32, normal: Vec3) -> Vec3 {
    let along = way.dot(normal);
    let length = normal.length();
    if along * along > SAME * distance * distance * length * length {
        normal * (if along > 0.0 { 1.0 } else { -1.0 } / length)
    } else {
        way * (1.0 / distance)
    }
}

/// How far one side is from the other along a direction, at least.
#[inline(always)]
pub(crate) fn between(x: [Vec3; 4], first: u32, n: Vec3) -> f32 {
    let [a, b, c, d] = [n.dot(x[0]), n.dot(x[1]), n.dot(x[2]), n.dot(x[3])];
    if first == 1 { a - max(b, max(c, d)) } else { min(a, b) - max(c, d) }
}

/// Where the particles of a pair are.
#[inline(always)]
pub(crate) fn places(x: &[Float4], ids: [u32; 4]) -> [Vec3; 4] {
    let [a, b, c, d] = ids;
    [xyz(&x[a as usize]), xyz(&x[b as usize]), xyz(&x[c as usize]), xyz(&x[d as usize])]
}

/// How far the closest points are from each other along `n`.
#[inline(always)]
pub(crate) fn along(x: &[Float4], contact: &Contact) -> f32 {
    let [a, b, c, d] = contact.ids.map(|id| Four::of(&x[id as usize]));
    let [p, q, r, s] = contact.share;
    Four::way(contact.n).dot(a.times(p) + b.times(q) + c.times(r) + d.times(s))
}

/// Where a pair is closest.
#[inline(always)]
fn closest<const FIRST: Kind>(x: [Vec3; 4]) -> Closest {
    if FIRST == VERTEX { vertex_closest(x) } else { edge_closest(x) }
}

/// The same for the few pairs that were looked at before, so that it is not woven in for each of them.
#[inline(never)]
fn closest_again<const FIRST: Kind>(x: [Vec3; 4]) -> Closest {
    closest::<FIRST>(x)
}

/// How far one side is from the other along a direction in the end, at least.
#[inline(always)]
fn between_at_end<const FIRST: Kind>(motion: &Motion, ids: [u32; 4], n: Vec3) -> f32 {
    let [a, b] = [motion.ends_along(ids[0], n), motion.ends_along(ids[1], n)];
    let [c, d] = [motion.ends_along(ids[2], n), motion.ends_along(ids[3], n)];
    if FIRST == VERTEX {
        a[0] - max(b[1], max(c[1], d[1]))
    } else {
        min(a[0], b[0]) - max(c[1], d[1])
    }
}

impl Contact {
    /// Sides of which nothing is known.
    pub fn of(ids: [u32; 4], first: Kind) -> Self {
        Self { ids, first, share: [0.0; 4], n: Vec3::ZERO, gap: 0.0, slit: -1.0, least: -1.0 }
    }

    /// The distance of two sides.
    pub fn distance<const FIRST: Kind>(x: [Vec3; 4]) -> f32 {
        closest_again::<FIRST>(x).distance
    }

    /// The contact of two sides, if they may come nearer than `gap`; `own_gap` is what they keep, and no larger.
    #[inline(never)]
    pub fn find<const FIRST: Kind>(
        ids: [u32; 4],
        motion: &Motion,
        gap: f32,
        own_gap: f32,
    ) -> Option<Self> {
        let start = places(&motion.start, ids);
        let mut then = closest_again::<FIRST>(start);
        let [a, b, c, d] = ids;
        let way = if FIRST == VERTEX {
            motion.one(a).way_against(&motion.of([b, c, d]))
        } else {
            motion.of([a, b]).way_against(&motion.of([c, d]))
        };
        if then.distance > gap + way || then.distance <= NOTHING {
            return None;
        }
        if FIRST == EDGES && between(start, 2, then.n) < CLEAR * then.distance {
            then = told_apart(start, then);
        }
        // What a direction tells apart before and after did not cross, whatever went on.
        let gap = own_gap;
        let is_told_apart = |n: Vec3| between_at_end::<FIRST>(motion, ids, n) > gap;
        if is_told_apart(then.n) && between(start, FIRST, then.n) > NOTHING {
            return None;
        }
        let mut contact = Self { share: then.share, n: then.n, gap, ..Self::of(ids, FIRST) };
        let now = places(&motion.now, ids);
        if along(&motion.now, &contact) < gap {
            contact.turn(closest_again::<FIRST>(now), start);
            if is_told_apart(contact.n) && between(start, FIRST, contact.n) > NOTHING {
                return None;
            }
        }
        contact.prepare(start);
        Some(contact)
    }

    /// Takes the direction of where sides are closest now, if it told them apart before, and not much less.
    #[inline(always)]
    fn turn(&mut self, now: Closest, start: [Vec3; 4]) {
        let enough = self.gap * (SLIT * ENOUGH);
        let before = min(between(start, self.first, self.n), enough);
        let then = between(start, self.first, now.n);
        if now.distance > NOTHING && then > NOTHING && min(then, enough) > WORSE * before {
            (self.share, self.n) = (now.share, now.n);
        }
    }

    /// Finds another direction that tells sides apart, at the start and now.
    #[inline(never)]
    pub(crate) fn turn_to(&mut self, start: [Vec3; 4], x: &[Float4]) {
        let now = places(x, self.ids);
        let is_vertex = self.first == VERTEX;
        let now =
            if is_vertex { closest_again::<VERTEX>(now) } else { closest_again::<EDGES>(now) };
        let before = *self;
        self.turn(now, start);
        self.prepare(start);
        if self.least < before.least * WORSE {
            *self = before;
        }
    }

    #[inline(always)]
    fn prepare(&mut self, start: [Vec3; 4]) {
        self.leave(between(start, self.first, self.n));
    }

    /// Finds what the fence leaves between sides that were so far apart along the direction.
    #[inline(always)]
    pub(crate) fn leave(&mut self, apart: f32) {
        let most = self.gap * SLIT;
        (self.slit, self.least) = if apart > NOTHING {
            // What is hardly apart gets a little more, or rounding would take it all.
            let more = if apart < most * ENOUGH { MORE } else { 1.0 };
            (min(apart * more, most), min(apart * LEAST, most * ENOUGH))
        } else {
            (-1.0, -1.0)
        };
    }

    /// Neither pushes nor holds anything back.
    pub(crate) fn let_be(&mut self) {
        (self.gap, self.slit, self.least) = (f32::NEG_INFINITY, -1.0, -1.0);
    }
}
