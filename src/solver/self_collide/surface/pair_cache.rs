//! Pair cache: vertex–triangle and edge–edge pairs of the cluster pairs, kept over substeps and
//! ticks.
//!
//! ```text
//! tick pair 0  ─▶ range { vertex–triangle 0..14, edge–edge 0..40, distances }
//! tick pair 1  ─▶ none yet                               │
//! tick pair 2  ─▶ range { … }                            ▼
//!                                     PairStore: ids, gaps, start separations
//! ```
//! All pairs of features nearer than `search_distance` are cached when a cluster pair is refreshed.
//! The range stays complete until the relative displacement of both clusters since then, plus that
//! of the coming substep, reaches `search_distance` (a Verlet list with a skin; Verlet, Phys. Rev.
//! 159, 1967).
//!
//! Reads start positions; writes its own lists. `surface_mid_phase` pushes the pairs.
//!
//! Invariant: the cache never changes which contacts are found. It may hold far pairs, but it never
//! lacks a near one.

use crate::math::simd::Level;
use crate::math::sort::sort_by;
use crate::math::wide4::Float4;
use crate::mesh::NONE;
use crate::solver::self_collide::surface::contact::{EDGE_EDGE, VERTEX_TRIANGLE};
use crate::solver::self_collide::surface::pair_store::PairStore;

/// The stores are compacted if their stale pairs exceed half of the live ones by this many.
const MAX_STALE_PAIRS: usize = 1024;

/// The cached pairs of a cluster pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairRange {
    /// Range of the vertex–triangle pairs, and of the edge–edge pairs: from, to.
    pub vertex_triangle: [u32; 2],
    pub edge_edge: [u32; 2],
    /// All pairs nearer than this were cached [m].
    pub search_distance: f32,
    /// Upper bound of the relative displacement since then [m].
    pub travelled: f32,
}

/// All cached pairs, by cluster pair.
#[derive(Clone, Debug)]
pub(crate) struct PairCache {
    pub vertex_triangle: PairStore,
    pub edge_edge: PairStore,
    /// The range of each tick pair, if it has one.
    pub ranges: Vec<Option<PairRange>>,
    /// Number of pairs in all ranges.
    pub live_count: usize,
    /// Whether any tick pair has a range.
    pub has_ranges: bool,
    /// Tick pairs and ranges before the tick pairs were rebuilt.
    old: OldPairs,
    /// Scratch to sort ranges.
    order: Vec<u32>,
}

/// Old tick pairs and their ranges, with a linked list for each cluster.
#[derive(Clone, Debug)]
struct OldPairs {
    pairs: Vec<[u32; 2]>,
    ranges: Vec<Option<PairRange>>,
    /// First pair of each cluster, and the next one after each pair; `NONE` at the end.
    first: Vec<u32>,
    next: Vec<u32>,
}

impl PairCache {
    /// Allocates for a cloth of `count` particles.
    pub fn new(count: usize) -> Self {
        let [vertex_triangle, edge_edge] = [32, 96].map(|each| PairStore::new(each * count));
        let old = OldPairs {
            pairs: Vec::with_capacity(8 * count),
            ranges: Vec::with_capacity(8 * count),
            first: Vec::with_capacity(count),
            next: Vec::with_capacity(8 * count),
        };
        let ranges = Vec::with_capacity(8 * count);
        Self {
            vertex_triangle,
            edge_edge,
            ranges,
            live_count: 0,
            has_ranges: false,
            old,
            order: Vec::with_capacity(8 * count),
        }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        let OldPairs { pairs, ranges, first, next } = &self.old;
        let ranges = size_of::<Option<PairRange>>() * (self.ranges.capacity() + ranges.capacity());
        let words =
            2 * pairs.capacity() + first.capacity() + next.capacity() + self.order.capacity();
        let stores = self.vertex_triangle.bytes() + self.edge_edge.bytes();
        stores + ranges + size_of::<u32>() * words
    }

    /// Drops all pairs; `tick_pairs` cluster pairs have no range then.
    pub fn clear(&mut self, tick_pairs: usize) {
        self.vertex_triangle.clear();
        self.edge_edge.clear();
        (self.live_count, self.has_ranges) = (0, false);
        self.ranges.clear();
        self.ranges.resize(tick_pairs, None);
    }

    /// Saves the tick pairs and their ranges before they are rebuilt; `tick_pairs` is empty
    /// afterwards.
    pub fn swap_tick_pairs(&mut self, tick_pairs: &mut Vec<[u32; 2]>) {
        core::mem::swap(tick_pairs, &mut self.old.pairs);
        core::mem::swap(&mut self.ranges, &mut self.old.ranges);
        tick_pairs.clear();
        self.ranges.clear();
    }

    /// Gives the new tick pairs the ranges that they had before. `clusters` is the number of
    /// clusters.
    pub fn restore_known_pairs(&mut self, tick_pairs: &[[u32; 2]], clusters: usize) {
        let OldPairs { pairs, ranges, first, next } = &mut self.old;
        first.clear();
        first.resize(clusters, NONE);
        next.clear();
        next.resize(pairs.len(), NONE);
        for (i, [one, _]) in pairs.iter().enumerate().rev() {
            next[i] = core::mem::replace(&mut first[*one as usize], i as u32);
        }
        (self.live_count, self.has_ranges) = (0, false);
        for [one, other] in tick_pairs {
            let mut i = first[*one as usize];
            while i != NONE && pairs[i as usize][1] != *other {
                i = next[i as usize];
            }
            let range = if i == NONE { None } else { ranges[i as usize] };
            self.live_count += range.as_ref().map_or(0, PairRange::len);
            self.has_ranges |= range.is_some();
            self.ranges.push(range);
        }
    }

    /// Removes stale pairs from the stores, if there are many.
    pub fn compact(&mut self) {
        let count = self.vertex_triangle.len() + self.edge_edge.len();
        if count <= self.live_count + self.live_count / 2 + MAX_STALE_PAIRS {
            return;
        }
        let Self { vertex_triangle, edge_edge, ranges, order, .. } = self;
        order.clear();
        order.extend((0..ranges.len() as u32).filter(|i| ranges[*i as usize].is_some()));
        // In the order of the stores. Empty ranges have no order of their own, so the index
        // decides.
        let key = |i: &u32| {
            let range = ranges[*i as usize].as_ref();
            (range.map(|range| (range.vertex_triangle[0], range.edge_edge[0])), *i)
        };
        sort_by(order, |a, b| key(a).cmp(&key(b)));
        let mut ends = [0; 2];
        for i in order {
            if let Some(range) = &mut ranges[*i as usize] {
                range.vertex_triangle = vertex_triangle.move_range(range.vertex_triangle, ends[0]);
                range.edge_edge = edge_edge.move_range(range.edge_edge, ends[1]);
                ends = [range.vertex_triangle[1], range.edge_edge[1]];
            }
        }
        vertex_triangle.truncate(ends[0]);
        edge_edge.truncate(ends[1]);
    }

    /// Measures the separations of the pairs that were pushed since the last time, at the start of
    /// the substep.
    pub fn measure(&mut self, level: Level, start: &[Float4]) {
        self.vertex_triangle.measure::<VERTEX_TRIANGLE>(level, start);
        self.edge_edge.measure::<EDGE_EDGE>(level, start);
    }
}

impl PairRange {
    /// Number of pairs.
    pub fn len(&self) -> usize {
        let [[a, b], [c, d]] = [self.vertex_triangle, self.edge_edge];
        (b - a + d - c) as usize
    }
}
