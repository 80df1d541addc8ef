//! Pairs of one kind that may meet for as long as particles stay in their reach, each with how far apart its sides
//! were where particles were based: what has not gone that far since needs no look.

use crate::math::simd::{Float, Level, Scalar, Simd, gather_transpose, vectored};
use crate::math::wide4::Float4;
use crate::solver::self_collide::surface::closest_lanes::{V, between, from_edge, from_triangle};
use crate::solver::self_collide::surface::contact::{EDGES, Kind, VERTEX};
use crate::solver::self_collide::surface::separation_test::{Candidates, turned};

/// Lanes that lists are filled up to.
const LANES: usize = 8;

/// Pairs.
#[derive(Clone, Debug)]
pub(crate) struct Stock {
    ids: Vec<[u32; 4]>,
    /// How far each keeps apart [m].
    gaps: Vec<f32>,
    /// How far apart sides were along a direction, of those that were measured [m].
    apart: Vec<f32>,
}

impl Stock {
    pub fn new(capacity: usize) -> Self {
        let list = || Vec::with_capacity(capacity + LANES);
        Self { ids: Vec::with_capacity(capacity + LANES), gaps: list(), apart: list() }
    }

    pub fn bytes(&self) -> usize {
        size_of::<u32>() * 6 * self.apart.capacity()
    }

    pub fn len(&self) -> usize {
        self.gaps.len()
    }

    pub fn clear(&mut self) {
        self.ids.clear();
        self.gaps.clear();
        self.apart.clear();
    }

    #[inline(always)]
    pub fn push(&mut self, ids: [u32; 4], gap: f32) {
        self.ids.push(ids);
        self.gaps.push(gap);
    }

    /// Moves measured pairs to a place before theirs, and says which those are then.
    pub fn take_back(&mut self, [from, to]: [u32; 2], place: u32) -> [u32; 2] {
        let (own, place) = (from as usize..to as usize, place as usize);
        self.ids.copy_within(own.clone(), place);
        self.gaps.copy_within(own.clone(), place);
        self.apart.copy_within(own.clone(), place);
        [place as u32, (place + own.len()) as u32]
    }

    /// Leaves so many, all of them measured.
    pub fn truncate(&mut self, count: u32) {
        let count = count as usize;
        self.ids.truncate(count);
        self.gaps.truncate(count);
        self.apart.truncate(count);
    }

    /// Measures what was pushed since the last time, with particles at their base.
    pub fn measure<const FIRST: Kind>(&mut self, level: Level, base: &[Float4]) {
        let (from, count) = (self.apart.len(), self.len());
        if from == count {
            return;
        }
        let full = from + (count - from).next_multiple_of(LANES);
        self.ids.resize(full, [0; 4]);
        self.apart.resize(full, 0.0);
        let (ids, apart) = (&self.ids[from..], &mut self.apart[from..]);
        if FIRST == VERTEX {
            measure_vertices(level, ids, base, apart);
        } else {
            measure_edges(level, ids, base, apart);
        }
        self.ids.truncate(count);
        self.apart.truncate(count);
    }

    /// Adds those of some to candidates that may have come together by ways of so much [m], and are `wanted`.
    #[inline(always)]
    pub fn pick(
        &self,
        [from, to]: [u32; 2],
        ways: f32,
        candidates: &mut Candidates,
        is_wanted: impl Fn(&[u32; 4]) -> bool,
    ) {
        let (first, to) = (from as usize, to as usize);
        let (ids, gaps) = (&self.ids[first..to], &self.gaps[first..to]);
        for (at, apart) in self.apart[first..to].iter().enumerate() {
            if *apart < ways && is_wanted(&ids[at]) {
                candidates.push(ids[at], gaps[at]);
            }
        }
    }
}

vectored! {
    fn measure_vertices(ids: &[[u32; 4]], base: &[Float4], apart: &mut [f32])
        = measure::<_, VERTEX>, Avx2, measure_vertices_apart
}

vectored! {
    fn measure_edges(ids: &[[u32; 4]], base: &[Float4], apart: &mut [f32])
        = measure::<_, EDGES>, Avx2, measure_edges_apart
}

fn measure_vertices_apart(ids: &[[u32; 4]], base: &[Float4], apart: &mut [f32]) {
    measure::<_, VERTEX>(Scalar, ids, base, apart);
}

fn measure_edges_apart(ids: &[[u32; 4]], base: &[Float4], apart: &mut [f32]) {
    measure::<_, EDGES>(Scalar, ids, base, apart);
}

/// What leads from one side to the other where they are closest tells them apart by all of their distance; that is
/// asked of the direction that was found, so that it holds however exact that is. What is not a number is not apart.
#[inline(always)]
fn measure<S: Simd, const FIRST: Kind>(s: S, ids: &[[u32; 4]], base: &[Float4], apart: &mut [f32]) {
    for at in (0..apart.len()).step_by(S::LANES) {
        let ids = turned::<S>(&ids[at..]);
        let mut x = [V { x: s.splat(0.0), y: s.splat(0.0), z: s.splat(0.0) }; 4];
        for k in 0..4 {
            x[k] = V::new(gather_transpose(s, base, &ids[k]));
        }
        let (way, _) = if FIRST == VERTEX { from_triangle(s, x) } else { from_edge(s, x) };
        let n = way.times(s.splat(1.0) / way.dot(way).sqrt());
        let distance = between::<_, FIRST>([n.dot(x[0]), n.dot(x[1]), n.dot(x[2]), n.dot(x[3])]);
        s.store(apart, at, Float::max(distance, s.splat(f32::NEG_INFINITY)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sheets over each other, so far apart as their numbers say, and the pairs of a vertex and a triangle in them.
    fn sheets(level: Level) -> Stock {
        let mut base = Vec::new();
        let mut stock = Stock::new(20);
        for i in 0..20_u32 {
            let corners = [[0.2, i as f32, 0.2], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
            base.extend(corners.map(|[x, y, z]| [x, y, z, 1.0]));
        }
        base[4 * 7][0] = f32::NAN;
        // In two lots, neither of them whole blocks of lanes.
        for lot in [0..13, 13..20] {
            lot.for_each(|i| stock.push([4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3], 0.1));
            stock.measure::<VERTEX>(level, &base);
        }
        stock
    }

    #[test]
    fn what_is_too_far_away_is_not_picked_and_what_is_nowhere_is() {
        for level in Level::all() {
            let mut stock = sheets(level);
            assert_eq!(stock.take_back([2, 19], 0), [0, 17]);
            stock.truncate(17);
            for (ways, count) in [(0.5, 1), (2.5, 2), (4.5, 4), (f32::INFINITY, 17)] {
                let mut picked = Candidates::new(20);
                stock.pick([0, 17], ways, &mut picked, |_| true);
                assert_eq!(picked.len(), count, "{ways} at {level:?}");
            }
        }
    }
}
