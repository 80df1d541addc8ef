//! Separation test: rejects candidate pairs that a box or a direction separates for the whole
//! substep.
//!
//! ```text
//!      A ●──────▶ ┊         1. AABBs: the boxes of both sides stay apart by more than the gap
//!                 ┊         2. direction n between the closest points at the start:
//!          ◀──● B ┊            separation(n) > 0 at the start, and > gap at the end for all
//!                 ┊            positions within the motion bounds
//! ```
//! A conservative continuous test: at the start and at the end the two sides lie on opposite sides
//! of a plane, so they did not cross (see `contact`). It rejects most pairs; the other pairs go to
//! the narrow phase or become speculative contacts.
//!
//! Reads [`SweptParticles`]; writes its own lists.
//!
//! Invariant: a rejected pair cannot come nearer than the gap while its particles stay within their
//! motion bounds. A pair with NaN is never rejected.

use crate::math::simd::{Float, Level, Scalar, Simd, gather_transpose, vectored};
use crate::math::wide4::Float4;
use crate::solver::self_collide::surface::closest_lanes::{
    Vec3Lanes, closest_edge_edge, closest_vertex_triangle, separation,
};
use crate::solver::self_collide::surface::contact::{
    CLEAR_SHARE, ContactKind, EDGE_EDGE, MIN_DISTANCE, VERTEX_TRIANGLE,
};
use crate::solver::self_collide::surface::speculative::SpeculativeContact;
use crate::solver::self_collide::surface::swept_particles::SweptParticles;
use glam::Vec3;

/// Lists are padded to a multiple of this many pairs.
const LANES: usize = 8;

/// Bits in a word of the bit set.
const WORD_BITS: usize = 64;

/// Candidate pairs of one kind, and the results of their separation test.
#[derive(Clone, Debug)]
pub(crate) struct CandidatePairs {
    ids: Vec<[u32; 4]>,
    /// Distance that each pair keeps [m].
    gaps: Vec<f32>,
    /// A bit for each pair: set if the test did not reject it.
    may_meet: Vec<u64>,
    results: SeparationLanes<Vec<f32>>,
}

/// Results of the test, in columns.
#[derive(Clone, Debug)]
struct SeparationLanes<T> {
    /// Direction from the second side to the first between the closest points at the start.
    n: [T; 3],
    /// See [`CandidatePair::distance`].
    distance: T,
}

/// A pair that the test did not reject.
pub(crate) struct CandidatePair {
    pub ids: [u32; 4],
    /// Distance that the pair keeps [m].
    pub gap: f32,
    /// Direction from the second side to the first between the closest points at the start.
    pub n: Vec3,
    /// The smaller of the distances at the start and now [m]. Infinite for nearly parallel edges,
    /// which the contact solver ignores.
    pub distance: f32,
}

impl CandidatePair {
    #[inline(always)]
    pub fn to_speculative(&self, kind: ContactKind) -> SpeculativeContact {
        let Self { ids, gap, n, .. } = *self;
        SpeculativeContact { ids, kind, gap, n }
    }
}

impl CandidatePairs {
    pub fn new(capacity: usize) -> Self {
        let ids = Vec::with_capacity(capacity + LANES);
        let list = || Vec::with_capacity(capacity + LANES);
        Self {
            ids,
            gaps: list(),
            may_meet: Vec::with_capacity(capacity / WORD_BITS + 1),
            results: SeparationLanes { n: [list(), list(), list()], distance: list() },
        }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        size_of::<u32>() * 9 * self.results.distance.capacity() + 8 * self.may_meet.capacity()
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

    /// Tests all pairs. `gap` is the largest gap of any pair [m]. Pads the lists to whole blocks of
    /// lanes.
    pub fn test_separation<const KIND: ContactKind>(
        &mut self,
        level: Level,
        motion: &SweptParticles,
        gap: f32,
    ) {
        let count = self.len().next_multiple_of(LANES);
        self.ids.resize(count, [0; 4]);
        self.gaps.resize(count, gap);
        self.may_meet.clear();
        self.may_meet.resize(count.div_ceil(WORD_BITS), 0);
        let SeparationLanes { n: [x, y, z], distance } = &mut self.results;
        [&mut *x, y, z, distance].into_iter().for_each(|list| list.resize(count, 0.0));
        let lanes = SeparationLanes { n: [&mut x[..], y, z], distance: &mut distance[..] };
        let batch = SeparationBatch {
            ids: &self.ids[..],
            start_and_bounds: motion.start_and_bounds(),
            gap,
            may_meet: &mut self.may_meet[..],
            lanes,
        };
        if KIND == VERTEX_TRIANGLE {
            test_vertex_triangle(level, batch);
        } else {
            test_edge_edge(level, batch);
        }
    }

    /// The pairs of the range `from..to` that the test did not reject, in order.
    pub fn remaining(&self, from: u32, to: u32) -> impl Iterator<Item = CandidatePair> {
        let (from, to) = (from as usize, to as usize);
        let words = from / WORD_BITS..to.div_ceil(WORD_BITS);
        let indices = words.flat_map(move |word| {
            let first = word * WORD_BITS;
            let from_mask = u64::MAX << from.saturating_sub(first);
            let to_mask = u64::MAX >> (first + WORD_BITS).saturating_sub(to);
            let mut bits = self.may_meet[word] & from_mask & to_mask;
            core::iter::from_fn(move || {
                let bit = bits.trailing_zeros() as usize;
                (bits != 0).then(|| {
                    bits &= bits - 1;
                    first + bit
                })
            })
        });
        indices.map(|i| self.candidate(i))
    }

    #[inline(always)]
    fn candidate(&self, i: usize) -> CandidatePair {
        let SeparationLanes { n: [x, y, z], distance } = &self.results;
        let (ids, gap) = (self.ids[i], self.gaps[i]);
        CandidatePair { ids, gap, n: Vec3::new(x[i], y[i], z[i]), distance: distance[i] }
    }
}

/// Input and output of the kernels.
struct SeparationBatch<'a> {
    ids: &'a [[u32; 4]],
    /// Start positions, and lower and upper corners of the motion bounds.
    start_and_bounds: [&'a [Float4]; 3],
    gap: f32,
    may_meet: &'a mut [u64],
    lanes: SeparationLanes<&'a mut [f32]>,
}

vectored! {
    fn test_vertex_triangle(batch: SeparationBatch<'_>)
        = test_lanes::<_, VERTEX_TRIANGLE>, test_vertex_triangle_scalar
}

vectored! {
    fn test_edge_edge(batch: SeparationBatch<'_>)
        = test_lanes::<_, EDGE_EDGE>, test_edge_edge_scalar
}

fn test_vertex_triangle_scalar(batch: SeparationBatch<'_>) {
    test_lanes::<_, VERTEX_TRIANGLE>(Scalar, batch);
}

fn test_edge_edge_scalar(batch: SeparationBatch<'_>) {
    test_lanes::<_, EDGE_EDGE>(Scalar, batch);
}

#[inline(always)]
fn test_lanes<S: Simd, const KIND: ContactKind>(s: S, batch: SeparationBatch<'_>) {
    let SeparationBatch {
        ids,
        start_and_bounds: [start, bound_low, bound_high],
        gap,
        may_meet,
        mut lanes,
    } = batch;
    for i in (0..lanes.distance.len()).step_by(S::LANES) {
        let ids = transpose_ids::<S>(&ids[i..]);
        let mut x = [Vec3Lanes { x: s.splat(0.0), y: s.splat(0.0), z: s.splat(0.0) }; 4];
        let mut bounds = [[x[0]; 2]; 4];
        for k in 0..4 {
            x[k] = Vec3Lanes::new(gather_transpose(s, start, &ids[k]));
            bounds[k] = [
                Vec3Lanes::new(gather_transpose(s, bound_low, &ids[k])),
                Vec3Lanes::new(gather_transpose(s, bound_high, &ids[k])),
            ];
        }
        let beyond_gap = aabb_separation::<S, KIND>(s, x, bounds, gap);
        if s.positive_mask(beyond_gap) == (1 << S::LANES) - 1 {
            continue;
        }
        let (d, weights) = if KIND == VERTEX_TRIANGLE {
            closest_vertex_triangle(s, x)
        } else {
            closest_edge_edge(s, x)
        };
        let length = d.dot(d).sqrt();
        let n = d.times(s.splat(1.0) / length);
        let mut at_start = [s.splat(0.0); 4];
        let mut at_end = [[s.splat(0.0); 2]; 4];
        let mut moved = s.splat(0.0);
        for k in 0..4 {
            at_start[k] = n.dot(x[k]);
            let [least, most] = range_along(n, bounds[k]);
            moved = moved + weights[k] * (least + most);
            at_end[k] = [at_start[k] + least, at_start[k] + most];
        }
        let [a, b, c, d] = at_end;
        let after = if KIND == VERTEX_TRIANGLE {
            a[0] - Float::max(b[1], Float::max(c[1], d[1]))
        } else {
            Float::min(a[0], b[0]) - Float::max(c[1], d[1])
        };
        let before = separation::<_, KIND>(at_start);
        let is_separated = Float::min(before - s.splat(MIN_DISTANCE), after - s.splat(gap));
        let is_separated = s.positive_mask(Float::max(is_separated, beyond_gap));
        may_meet[i / WORD_BITS] |=
            u64::from(is_separated ^ ((1 << S::LANES) - 1)) << (i % WORD_BITS);
        for (list, n) in lanes.n.iter_mut().zip([n.x, n.y, n.z]) {
            s.store(list, i, n);
        }
        // A motion bound is symmetric around the current displacement, so half of `least + most` is
        // the current displacement along n. The distance at the start counts as well, because other
        // contacts may push a pair back to where it came from.
        let mut distance = Float::min(length, length + s.splat(0.5) * moved);
        if KIND == EDGE_EDGE {
            let is_clear = before - s.splat(CLEAR_SHARE) * length;
            distance = s.select(is_clear, distance, s.splat(f32::INFINITY));
        }
        s.store(lanes.distance, i, distance);
    }
}

/// Transposes the ids of `S::LANES` pairs: a list of lanes for each of the four particles.
#[inline(always)]
pub(crate) fn transpose_ids<S: Simd>(pairs: &[[u32; 4]]) -> [[u32; LANES]; 4] {
    let pairs = &pairs[..S::LANES];
    let mut columns = [[0; LANES]; 4];
    for (lane, ids) in pairs.iter().enumerate() {
        for k in 0..4 {
            columns[k][lane] = ids[k];
        }
    }
    columns
}

/// Separation of the swept AABBs of both sides minus `gap` [m], along the best axis: above 0 if the
/// sides cannot meet. −∞ for NaN.
#[inline(always)]
fn aabb_separation<S: Simd, const KIND: ContactKind>(
    s: S,
    x: [Vec3Lanes<S::F>; 4],
    bounds: [[Vec3Lanes<S::F>; 2]; 4],
    gap: f32,
) -> S::F {
    let (zero, gap) = (s.splat(0.0), s.splat(gap));
    let mut separation = s.splat(f32::NEG_INFINITY);
    for axis in 0..3 {
        // Particles 0 and 2 are the first of their sides; 3 is of the second side, 1 of either.
        let mut low = [x[0].axis(axis), x[2].axis(axis)];
        let mut high = low;
        let [mut least, mut most] =
            [0, 1].map(|end: usize| [bounds[0][end].axis(axis), bounds[2][end].axis(axis)]);
        for (side, k) in [(1, 3), (2 - KIND as usize, 1)] {
            let (position, [bound_low, bound_high]) = (x[k].axis(axis), bounds[k]);
            low[side] = Float::min(low[side], position);
            high[side] = Float::max(high[side], position);
            least[side] = Float::min(least[side], bound_low.axis(axis));
            most[side] = Float::max(most[side], bound_high.axis(axis));
        }
        let (back, ahead) = (most[1] - least[0], most[0] - least[1]);
        let above = (low[0] - gap) - high[1] - Float::max(zero, back);
        let below = low[1] - (high[0] + gap) - Float::max(zero, ahead);
        separation = Float::max(Float::max(above, below), separation);
    }
    separation
}

/// The least and the greatest displacement along `n` within a motion bound [m].
#[inline(always)]
fn range_along<F: Float>(n: Vec3Lanes<F>, [low, high]: [Vec3Lanes<F>; 2]) -> [F; 2] {
    let (ax, ay, az) = (n.x * low.x, n.y * low.y, n.z * low.z);
    let (bx, by, bz) = (n.x * high.x, n.y * high.y, n.z * high.z);
    let least = Float::min(ax, bx) + Float::min(ay, by) + Float::min(az, bz);
    [least, Float::max(ax, bx) + Float::max(ay, by) + Float::max(az, bz)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle at rest, and a vertex 0.1 m above it that moves down by `down` [m].
    fn vertex_above_triangle(down: f32) -> SweptParticles {
        let mut motion = SweptParticles::new(4);
        let start = [[0.2, 0.1, 0.2], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        motion.start.extend(start.map(|[x, y, z]: [f32; 3]| [x, y, z, 1.0]));
        motion.now.clone_from(&motion.start);
        motion.now[0][1] -= down;
        motion.reset_bounds(0.01, 0.01, false);
        motion
    }

    #[test]
    fn a_vertex_that_falls_through_a_triangle_is_not_rejected() {
        for level in Level::available() {
            for (down, may_meet) in [(0.0, false), (0.05, false), (0.15, true), (f32::NAN, true)] {
                let motion = vertex_above_triangle(down);
                let mut candidates = CandidatePairs::new(1);
                candidates.push([0, 1, 2, 3], 0.001);
                candidates.test_separation::<VERTEX_TRIANGLE>(level, &motion, 0.001);
                let found = candidates.remaining(0, 1).map(|candidate| candidate.ids).next();
                assert_eq!(found, may_meet.then_some([0, 1, 2, 3]), "{down} at {level:?}");
            }
        }
    }

    #[test]
    fn all_simd_levels_give_the_bits_of_the_scalar_test() {
        let mut motion = SweptParticles::new(64);
        let number = |i: usize| (i * 7919 % 97) as f32 / 97.0;
        let particle = |i: usize| [number(3 * i), number(3 * i + 1), number(3 * i + 2), 1.0];
        motion.start.extend((0..64).map(particle));
        motion.now.extend(motion.start.iter().map(|[x, y, z, w]| [*x, y - z, z + x, *w]));
        motion.reset_bounds(0.1, 0.01, false);
        let test = |level| {
            let mut kinds = [(); 2].map(|()| CandidatePairs::new(60));
            for (k, candidates) in kinds.iter_mut().enumerate() {
                (0..60).for_each(|i| candidates.push([i, i + 1, i + 2, i + 3], 0.01));
                if k == 0 {
                    candidates.test_separation::<VERTEX_TRIANGLE>(level, &motion, 0.01);
                } else {
                    candidates.test_separation::<EDGE_EDGE>(level, &motion, 0.01);
                }
            }
            kinds.map(|candidates| {
                let bits = |candidate: CandidatePair| {
                    let CandidatePair { ids, n, distance, .. } = candidate;
                    (ids, n.to_array().map(f32::to_bits), distance.to_bits())
                };
                candidates.remaining(0, 60).map(bits).collect::<Vec<_>>()
            })
        };
        let scalar = test(Level::Scalar);
        let counts = scalar.each_ref().map(Vec::len);
        assert!(counts.iter().all(|count| (1..60).contains(count)), "{counts:?} of 60 remain");
        Level::available()
            .into_iter()
            .for_each(|level| assert_eq!(test(level), scalar, "{level:?}"));
    }
}
