//! Pairs that boxes do not tell apart, and which of them a direction does, many at once.
//!
//! What leads from one side to the other where they are closest as the substep begins tells most pairs apart then
//! and, wherever they may get, in the end. What it does not is looked at one by one (`contacts`).

use crate::math::simd::{Float, Level, Scalar, Simd, gather_transpose, vectored};
use crate::math::wide4::Float4;
use crate::solver::self_collide::surface::closest_lanes::{V, between, from_edge, from_triangle};
use crate::solver::self_collide::surface::contact::{CLEAR, EDGES, Kind, NOTHING, VERTEX};
use crate::solver::self_collide::surface::speculative::Distant;
use crate::solver::self_collide::surface::swept_particles::Motion;
use glam::Vec3;

/// Lanes that lists are filled up to.
const LANES: usize = 8;

/// Bits in a word.
const BITS: usize = 64;

/// Pairs of one kind.
#[derive(Clone, Debug)]
pub(crate) struct Candidates {
    ids: Vec<[u32; 4]>,
    /// How far each keeps apart [m].
    gaps: Vec<f32>,
    /// Which of them may meet: a bit for each.
    may_meet: Vec<u64>,
    judged: Lanes<Vec<f32>>,
}

/// What was found of each pair.
#[derive(Clone, Debug)]
struct Lanes<T> {
    /// The direction from the second side to the first where they were closest, and how far they are apart along it.
    n: [T; 3],
    distance: T,
}

/// A pair that may meet: how far it keeps apart, the direction that it was apart along, and how near it is
/// then or now, whichever is less.
pub(crate) struct Candidate {
    pub ids: [u32; 4],
    pub gap: f32,
    pub n: Vec3,
    pub distance: f32,
}

impl Candidate {
    #[inline(always)]
    pub fn as_distant(&self, first: Kind) -> Distant {
        let Self { ids, gap, n, .. } = *self;
        Distant { ids, first, gap, n }
    }
}

impl Candidates {
    pub fn new(capacity: usize) -> Self {
        let ids = Vec::with_capacity(capacity + LANES);
        let list = || Vec::with_capacity(capacity + LANES);
        Self {
            ids,
            gaps: list(),
            may_meet: Vec::with_capacity(capacity / BITS + 1),
            judged: Lanes { n: [list(), list(), list()], distance: list() },
        }
    }

    pub fn bytes(&self) -> usize {
        size_of::<u32>() * 9 * self.judged.distance.capacity() + 8 * self.may_meet.capacity()
    }

    pub fn clear(&mut self) {
        self.ids.clear();
        self.gaps.clear();
    }

    pub fn len(&self) -> usize {
        self.ids.len()
    }

    #[inline(always)]
    pub fn push(&mut self, ids: [u32; 4], gap: f32) {
        self.ids.push(ids);
        self.gaps.push(gap);
    }

    /// Finds which are told apart by more than `gap` in the end; lists are filled up for that.
    pub fn judge<const FIRST: Kind>(&mut self, level: Level, motion: &Motion, gap: f32) {
        let count = self.len().next_multiple_of(LANES);
        self.ids.resize(count, [0; 4]);
        self.gaps.resize(count, gap);
        self.may_meet.clear();
        self.may_meet.resize(count.div_ceil(BITS), 0);
        let Lanes { n: [x, y, z], distance } = &mut self.judged;
        [&mut *x, y, z, distance].into_iter().for_each(|list| list.resize(count, 0.0));
        let (ids, rooms, may_meet) = (&self.ids[..], motion.rooms(), &mut self.may_meet[..]);
        let lanes = Lanes { n: [&mut x[..], y, z], distance: &mut distance[..] };
        let judged = Judged { ids, rooms, gap, may_meet, lanes };
        if FIRST == VERTEX { judge_vertices(level, judged) } else { judge_edges(level, judged) }
    }

    /// Those of some that may meet, in order.
    pub fn meeting(&self, from: u32, to: u32) -> impl Iterator<Item = Candidate> {
        let (from, to) = (from as usize, to as usize);
        let words = from / BITS..to.div_ceil(BITS);
        let meeting = words.flat_map(move |word| {
            let first = word * BITS;
            let after = u64::MAX << from.saturating_sub(first);
            let before = u64::MAX >> (first + BITS).saturating_sub(to);
            let mut bits = self.may_meet[word] & after & before;
            core::iter::from_fn(move || {
                let place = bits.trailing_zeros() as usize;
                (bits != 0).then(|| {
                    bits &= bits - 1;
                    first + place
                })
            })
        });
        meeting.map(|at| self.candidate(at))
    }

    #[inline(always)]
    fn candidate(&self, at: usize) -> Candidate {
        let Lanes { n: [x, y, z], distance } = &self.judged;
        let (ids, gap) = (self.ids[at], self.gaps[at]);
        Candidate { ids, gap, n: Vec3::new(x[at], y[at], z[at]), distance: distance[at] }
    }
}

/// Pairs with where their particles are at the start, and from where to where they get.
struct Judged<'a> {
    ids: &'a [[u32; 4]],
    rooms: [&'a [Float4]; 3],
    gap: f32,
    may_meet: &'a mut [u64],
    lanes: Lanes<&'a mut [f32]>,
}

vectored! {
    fn judge_vertices(judged: Judged<'_>) = judge::<_, VERTEX>, Avx2, judge_vertices_apart
}

vectored! {
    fn judge_edges(judged: Judged<'_>) = judge::<_, EDGES>, Avx2, judge_edges_apart
}

fn judge_vertices_apart(judged: Judged<'_>) {
    judge::<_, VERTEX>(Scalar, judged);
}

fn judge_edges_apart(judged: Judged<'_>) {
    judge::<_, EDGES>(Scalar, judged);
}

#[inline(always)]
fn judge<S: Simd, const FIRST: Kind>(s: S, judged: Judged<'_>) {
    let Judged { ids, rooms: [start, from, to], gap, may_meet, mut lanes } = judged;
    for at in (0..lanes.distance.len()).step_by(S::LANES) {
        let ids = turned::<S>(&ids[at..]);
        let mut x = [V { x: s.splat(0.0), y: s.splat(0.0), z: s.splat(0.0) }; 4];
        let mut rooms = [[x[0]; 2]; 4];
        for k in 0..4 {
            x[k] = V::new(gather_transpose(s, start, &ids[k]));
            rooms[k] = [
                V::new(gather_transpose(s, from, &ids[k])),
                V::new(gather_transpose(s, to, &ids[k])),
            ];
        }
        let boxed = between_boxes::<S, FIRST>(s, x, rooms, gap);
        if s.positive_mask(boxed) == (1 << S::LANES) - 1 {
            continue;
        }
        let (way, share) = if FIRST == VERTEX { from_triangle(s, x) } else { from_edge(s, x) };
        let length = way.dot(way).sqrt();
        let n = way.times(s.splat(1.0) / length);
        let mut before = [s.splat(0.0); 4];
        let mut ends = [[s.splat(0.0); 2]; 4];
        let mut now = s.splat(0.0);
        for k in 0..4 {
            before[k] = n.dot(x[k]);
            let [least, most] = ends_along(n, rooms[k]);
            now = now + share[k] * (least + most);
            ends[k] = [before[k] + least, before[k] + most];
        }
        let [p, q, r, t] = ends;
        let after = if FIRST == VERTEX {
            p[0] - Float::max(q[1], Float::max(r[1], t[1]))
        } else {
            Float::min(p[0], q[0]) - Float::max(r[1], t[1])
        };
        let then = between::<_, FIRST>(before);
        let is_clear = Float::min(then - s.splat(NOTHING), after - s.splat(gap));
        let is_clear = s.positive_mask(Float::max(is_clear, boxed));
        may_meet[at / BITS] |= u64::from(is_clear ^ ((1 << S::LANES) - 1)) << (at % BITS);
        for (list, n) in lanes.n.iter_mut().zip([n.x, n.y, n.z]) {
            s.store(list, at, n);
        }
        // Rooms are as large on all sides, so that particles are in the middle. What others push back to where it came
        // from is as near as it was.
        let mut distance = Float::min(length, length + s.splat(0.5) * now);
        if FIRST == EDGES {
            let is_clear = then - s.splat(CLEAR) * length;
            distance = s.select(is_clear, distance, s.splat(f32::INFINITY));
        }
        s.store(lanes.distance, at, distance);
    }
}

/// The particles of the first pairs, a list for each of the four.
#[inline(always)]
pub(crate) fn turned<S: Simd>(pairs: &[[u32; 4]]) -> [[u32; LANES]; 4] {
    let pairs = &pairs[..S::LANES];
    let mut all = [[0; LANES]; 4];
    for (lane, ids) in pairs.iter().enumerate() {
        for k in 0..4 {
            all[k][lane] = ids[k];
        }
    }
    all
}

/// How much farther apart than `gap` boxes around two sides stay, which go on together: above 0, so they cannot meet.
/// What is not a number is everywhere.
#[inline(always)]
fn between_boxes<S: Simd, const FIRST: Kind>(
    s: S,
    x: [V<S::F>; 4],
    rooms: [[V<S::F>; 2]; 4],
    gap: f32,
) -> S::F {
    let (zero, gap) = (s.splat(0.0), s.splat(gap));
    let mut clear = s.splat(f32::NEG_INFINITY);
    for axis in 0..3 {
        let mut low = [x[0].along(axis), x[2].along(axis)];
        let mut high = low;
        let [mut least, mut most] =
            [0, 1].map(|end: usize| [rooms[0][end].along(axis), rooms[2][end].along(axis)]);
        for (side, k) in [(1, 3), (2 - FIRST as usize, 1)] {
            let (place, [from, to]) = (x[k].along(axis), rooms[k]);
            low[side] = Float::min(low[side], place);
            high[side] = Float::max(high[side], place);
            least[side] = Float::min(least[side], from.along(axis));
            most[side] = Float::max(most[side], to.along(axis));
        }
        let (back, ahead) = (most[1] - least[0], most[0] - least[1]);
        let above = (low[0] - gap) - high[1] - Float::max(zero, back);
        let below = low[1] - (high[0] + gap) - Float::max(zero, ahead);
        clear = Float::max(Float::max(above, below), clear);
    }
    clear
}

/// The least and the most that something gets along `n`.
#[inline(always)]
fn ends_along<F: Float>(n: V<F>, [from, to]: [V<F>; 2]) -> [F; 2] {
    let (ax, ay, az) = (n.x * from.x, n.y * from.y, n.z * from.z);
    let (bx, by, bz) = (n.x * to.x, n.y * to.y, n.z * to.z);
    let least = Float::min(ax, bx) + Float::min(ay, by) + Float::min(az, bz);
    [least, Float::max(ax, bx) + Float::max(ay, by) + Float::max(az, bz)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle that lies still, and a vertex a tenth over it that goes down by so much.
    fn above(down: f32) -> Motion {
        let mut motion = Motion::new(4);
        let start = [[0.2, 0.1, 0.2], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        motion.start.extend(start.map(|[x, y, z]: [f32; 3]| [x, y, z, 1.0]));
        motion.now.clone_from(&motion.start);
        motion.now[0][1] -= down;
        motion.look_ahead(0.01, 0.01);
        motion
    }

    #[test]
    fn what_stays_above_is_told_apart_and_what_falls_through_is_not() {
        for level in Level::all() {
            for (down, may_meet) in [(0.0, false), (0.05, false), (0.15, true), (f32::NAN, true)] {
                let motion = above(down);
                let mut candidates = Candidates::new(1);
                candidates.push([0, 1, 2, 3], 0.001);
                candidates.judge::<VERTEX>(level, &motion, 0.001);
                let found = candidates.meeting(0, 1).map(|candidate| candidate.ids).next();
                assert_eq!(found, may_meet.then_some([0, 1, 2, 3]), "{down} at {level:?}");
            }
        }
    }

    #[test]
    fn lanes_judge_as_each_alone() {
        let mut motion = Motion::new(64);
        let number = |i: usize| (i * 7919 % 97) as f32 / 97.0;
        let spot = |i: usize| [number(3 * i), number(3 * i + 1), number(3 * i + 2), 1.0];
        motion.start.extend((0..64).map(spot));
        motion.now.extend(motion.start.iter().map(|[x, y, z, w]| [*x, y - z, z + x, *w]));
        motion.look_ahead(0.1, 0.01);
        let judged = |level| {
            let mut all = [(); 2].map(|()| Candidates::new(60));
            for (k, candidates) in all.iter_mut().enumerate() {
                (0..60).for_each(|i| candidates.push([i, i + 1, i + 2, i + 3], 0.01));
                if k == 0 {
                    candidates.judge::<VERTEX>(level, &motion, 0.01);
                } else {
                    candidates.judge::<EDGES>(level, &motion, 0.01);
                }
            }
            all.map(|all| {
                let bits = |candidate: Candidate| {
                    let Candidate { ids, n, distance, .. } = candidate;
                    (ids, n.to_array().map(f32::to_bits), distance.to_bits())
                };
                all.meeting(0, 60).map(bits).collect::<Vec<_>>()
            })
        };
        let alone = judged(Level::Scalar);
        let found = alone.each_ref().map(Vec::len);
        assert!(found.iter().all(|count| (1..60).contains(count)), "{found:?} of 60 may meet");
        Level::all().into_iter().for_each(|level| assert_eq!(judged(level), alone, "{level:?}"));
    }
}
