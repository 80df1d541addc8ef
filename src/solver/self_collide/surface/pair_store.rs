//! Pair lists of the pair cache: ids, gap and start separation of each pair, in columns.
//!
//! ```text
//! ids         [a b c d] [a b c d] …      1 + 3 or 2 + 2 particles
//! gaps            0.01      0.01  …      [m]
//! separations     0.13      0.02  …      when the pair was added [m]
//! ```
//! A pair that was `separation` apart cannot touch before both sides have moved that far relative
//! to each other, as in conservative advancement (Mirtich, "Impulse-based dynamic simulation of
//! rigid body systems", 1996). So most pairs of a substep are rejected with one comparison.
//!
//! Reads positions; writes its own lists and the caller's candidate pairs.
//!
//! Invariant: the separation of a pair is at most the distance of its sides at that time; −∞ for
//! NaN. All pairs but those pushed since the last [`PairStore::measure`] have one.

use crate::math::simd::{Float, Level, Scalar, Simd, gather_transpose, vectored};
use crate::math::wide4::Float4;
use crate::solver::self_collide::surface::closest_lanes::{
    Vec3Lanes, closest_edge_edge, closest_vertex_triangle, separation,
};
use crate::solver::self_collide::surface::contact::{ContactKind, EDGE_EDGE, VERTEX_TRIANGLE};
use crate::solver::self_collide::surface::separation_test::{CandidatePairs, transpose_ids};

/// Lists are padded to a multiple of this many pairs.
const LANES: usize = 8;

/// Pairs of one kind.
#[derive(Clone, Debug)]
pub(crate) struct PairStore {
    ids: Vec<[u32; 4]>,
    /// Distance that each pair keeps [m].
    gaps: Vec<f32>,
    /// Separation of each measured pair when it was added [m].
    separations: Vec<f32>,
}

impl PairStore {
    pub fn new(capacity: usize) -> Self {
        let list = || Vec::with_capacity(capacity + LANES);
        Self { ids: Vec::with_capacity(capacity + LANES), gaps: list(), separations: list() }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        size_of::<u32>() * 6 * self.separations.capacity()
    }

    pub fn len(&self) -> usize {
        self.gaps.len()
    }

    pub fn clear(&mut self) {
        self.ids.clear();
        self.gaps.clear();
        self.separations.clear();
    }

    #[inline(always)]
    pub fn push(&mut self, ids: [u32; 4], gap: f32) {
        self.ids.push(ids);
        self.gaps.push(gap);
    }

    /// Moves a range of measured pairs forward to index `to_index`, and returns its new range.
    pub fn move_range(&mut self, [from, to]: [u32; 2], to_index: u32) -> [u32; 2] {
        let (own, to_index) = (from as usize..to as usize, to_index as usize);
        self.ids.copy_within(own.clone(), to_index);
        self.gaps.copy_within(own.clone(), to_index);
        self.separations.copy_within(own.clone(), to_index);
        [to_index as u32, (to_index + own.len()) as u32]
    }

    /// Drops all pairs from index `count` on. All pairs must be measured.
    pub fn truncate(&mut self, count: u32) {
        let count = count as usize;
        self.ids.truncate(count);
        self.gaps.truncate(count);
        self.separations.truncate(count);
    }

    /// Measures the separations of the pairs that were pushed since the last time, at positions
    /// `x`.
    pub fn measure<const KIND: ContactKind>(&mut self, level: Level, x: &[Float4]) {
        let (from, count) = (self.separations.len(), self.len());
        if from == count {
            return;
        }
        let padded = from + (count - from).next_multiple_of(LANES);
        self.ids.resize(padded, [0; 4]);
        self.separations.resize(padded, 0.0);
        let (ids, separations) = (&self.ids[from..], &mut self.separations[from..]);
        if KIND == VERTEX_TRIANGLE {
            measure_vertex_triangle(level, ids, x, separations);
        } else {
            measure_edge_edge(level, ids, x, separations);
        }
        self.ids.truncate(count);
        self.separations.truncate(count);
    }

    /// Pushes the pairs of a range whose separation is below `max_relative` [m], so that they may
    /// touch after that much relative displacement, and for which `filter` returns true.
    #[inline(always)]
    pub fn push_candidates(
        &self,
        [from, to]: [u32; 2],
        max_relative: f32,
        candidates: &mut CandidatePairs,
        filter: impl Fn(&[u32; 4]) -> bool,
    ) {
        let (from, to) = (from as usize, to as usize);
        let (ids, gaps) = (&self.ids[from..to], &self.gaps[from..to]);
        for (i, separation) in self.separations[from..to].iter().enumerate() {
            if *separation < max_relative && filter(&ids[i]) {
                candidates.push(ids[i], gaps[i]);
            }
        }
    }
}

vectored! {
    fn measure_vertex_triangle(ids: &[[u32; 4]], x: &[Float4], separations: &mut [f32])
        = measure_lanes::<_, VERTEX_TRIANGLE>, measure_vertex_triangle_scalar
}

vectored! {
    fn measure_edge_edge(ids: &[[u32; 4]], x: &[Float4], separations: &mut [f32])
        = measure_lanes::<_, EDGE_EDGE>, measure_edge_edge_scalar
}

fn measure_vertex_triangle_scalar(ids: &[[u32; 4]], x: &[Float4], separations: &mut [f32]) {
    measure_lanes::<_, VERTEX_TRIANGLE>(Scalar, ids, x, separations);
}

fn measure_edge_edge_scalar(ids: &[[u32; 4]], x: &[Float4], separations: &mut [f32]) {
    measure_lanes::<_, EDGE_EDGE>(Scalar, ids, x, separations);
}

/// Measures separations along the direction between the closest points. The separation along any
/// direction is a lower bound of the distance, so rounding in the closest points does no harm.
#[inline(always)]
fn measure_lanes<S: Simd, const KIND: ContactKind>(
    s: S,
    ids: &[[u32; 4]],
    positions: &[Float4],
    separations: &mut [f32],
) {
    for i in (0..separations.len()).step_by(S::LANES) {
        let ids = transpose_ids::<S>(&ids[i..]);
        let mut x = [Vec3Lanes { x: s.splat(0.0), y: s.splat(0.0), z: s.splat(0.0) }; 4];
        for k in 0..4 {
            x[k] = Vec3Lanes::new(gather_transpose(s, positions, &ids[k]));
        }
        let (d, _) = if KIND == VERTEX_TRIANGLE {
            closest_vertex_triangle(s, x)
        } else {
            closest_edge_edge(s, x)
        };
        let n = d.times(s.splat(1.0) / d.dot(d).sqrt());
        let along = [n.dot(x[0]), n.dot(x[1]), n.dot(x[2]), n.dot(x[3])];
        let separation = separation::<_, KIND>(along);
        // This turns NaN into −∞.
        s.store(separations, i, Float::max(separation, s.splat(f32::NEG_INFINITY)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twenty pairs of a vertex and a triangle; in pair i the vertex is i [m] above the triangle.
    /// Pair 7 has a NaN.
    fn stacked_pairs(level: Level) -> PairStore {
        let mut x = Vec::new();
        let mut store = PairStore::new(20);
        for i in 0..20_u32 {
            let corners = [[0.2, i as f32, 0.2], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
            x.extend(corners.map(|[x, y, z]| [x, y, z, 1.0]));
        }
        x[4 * 7][0] = f32::NAN;
        // Two batches, neither a multiple of the lanes.
        for batch in [0..13, 13..20] {
            batch.for_each(|i| store.push([4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3], 0.1));
            store.measure::<VERTEX_TRIANGLE>(level, &x);
        }
        store
    }

    #[test]
    fn only_pairs_within_the_displacement_and_nan_become_candidates() {
        for level in Level::available() {
            let mut store = stacked_pairs(level);
            assert_eq!(store.move_range([2, 19], 0), [0, 17]);
            store.truncate(17);
            for (moved, count) in [(0.5, 1), (2.5, 2), (4.5, 4), (f32::INFINITY, 17)] {
                let mut candidates = CandidatePairs::new(20);
                store.push_candidates([0, 17], moved, &mut candidates, |_| true);
                assert_eq!(candidates.len(), count, "{moved} at {level:?}");
            }
        }
    }
}
