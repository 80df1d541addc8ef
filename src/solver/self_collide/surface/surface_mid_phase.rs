//! Mid phase: vertex–triangle and edge–edge pairs of cluster pairs, found with AABBs and kept in
//! the pair cache.
//!
//! ```text
//! clusters A, B ─▶ features of A near the box of B, and of B near the box of A (bit masks)
//!               ─▶ each such feature of A against those of B: AABBs, 8 lanes per test
//!               ─▶ pairs nearer than `search_distance` ─▶ pair cache
//! ```
//! A cached range is complete while the relative displacement since its refresh, plus that of the
//! coming substep, stays below `search_distance` (see `pair_cache`). The search distance is the
//! relative displacement of the coming substep plus a skin, so a range lasts for several substeps.
//!
//! Reads [`SweptParticles`] and [`RestGap`]; writes the pair cache and AABBs of features.
//!
//! Invariant: a refresh uses start positions only, so it finds the same pairs in the same order
//! whenever it runs in a substep.

use crate::math::max;
use crate::mesh::Mesh;
use crate::solver::self_collide::surface::cluster_bvh::ClusterBvh;
use crate::solver::self_collide::surface::contact::{ContactKind, EDGE_EDGE, VERTEX_TRIANGLE};
use crate::solver::self_collide::surface::pair_cache::PairRange;
use crate::solver::self_collide::surface::rest_gap::RestGap;
use crate::solver::self_collide::surface::separation_test::CandidatePairs;
use crate::solver::self_collide::surface::swept_aabb::{
    LANES, SweptAabb, SweptAabbBlock, overlap_mask, set_bits,
};
use crate::solver::self_collide::surface::swept_particles::SweptParticles;

/// The bits of one block of lanes.
const LANE_BITS: u32 = (1 << LANES) - 1;

/// Skin of a refresh: the larger of a share of the mean rest length and a share of the relative
/// displacement in the coming substep. Above a number of tick pairs per cluster both shares are
/// small: there, testing many cached pairs takes longer than searching for a few again.
const SKIN: f32 = 0.4;
const SKIN_OF_DISPLACEMENT: f32 = 0.25;
const CROWD: usize = 12;
const SKIN_IN_CROWD: f32 = 0.1;

/// Features of a cluster near another one: a bit for each, in the order of the lists.
#[derive(Clone, Copy, Debug)]
struct FeatureMasks {
    vertices: u32,
    triangles: u32,
    edges: u32,
}

/// Parameters of a refresh.
struct PairQuery<'a> {
    rest_gap: &'a RestGap<'a>,
    motion: &'a SweptParticles,
    /// Pairs nearer than this are cached [m].
    search_distance: f32,
    /// Whether pairs may have a smaller gap because they are near each other at rest.
    may_be_near_at_rest: bool,
}

impl PairQuery<'_> {
    #[inline(always)]
    fn gap_of<const KIND: ContactKind>(&self, ids: [u32; 4]) -> f32 {
        if self.may_be_near_at_rest {
            self.rest_gap.gap_of::<KIND>(ids)
        } else {
            self.rest_gap.full_gap_of::<KIND>(ids)
        }
    }
}

impl ClusterBvh {
    /// Drops all cached pairs.
    pub fn clear_pair_cache(&mut self) {
        self.pair_cache.clear(self.tick_pairs.len());
    }

    /// Adds the relative displacements since the last refit to all ranges, and compacts the cache.
    pub fn age_pair_cache(&mut self) {
        if !self.pair_cache.has_ranges {
            return;
        }
        for i in 0..self.tick_pairs.len() {
            if self.pair_cache.ranges[i].is_some() {
                let step = self.relative_step(i as u32);
                if let Some(range) = &mut self.pair_cache.ranges[i] {
                    range.travelled += step;
                }
            }
        }
        self.pair_cache.compact();
    }

    /// Refreshes the cached pairs of a tick pair, unless its range is still complete for this
    /// substep. `margin` [m] is added to the relative displacement.
    pub fn refresh_pairs(
        &mut self,
        tick_pair: u32,
        rest_gap: &RestGap<'_>,
        motion: &SweptParticles,
        margin: f32,
    ) {
        let relative = self.max_relative_displacement(tick_pair, margin);
        if let Some(range) = &self.pair_cache.ranges[tick_pair as usize] {
            // An infinite displacement fails this test for every finite search_distance.
            if range.travelled + relative < range.search_distance {
                return;
            }
            self.pair_cache.live_count -= range.len();
        }
        let (pair, mesh) = (self.tick_pair(tick_pair), rest_gap.mesh);
        pair.into_iter().for_each(|cluster| self.fit_features(cluster, mesh, motion));
        let cache = &self.pair_cache;
        let from = [cache.vertex_triangle.len() as u32, cache.edge_edge.len() as u32];
        let [one, other] = pair;
        let is_crowded = self.tick_pairs.len() > CROWD * self.clusters.len();
        let [share, of_displacement] =
            if is_crowded { [SKIN_IN_CROWD; 2] } else { [SKIN, SKIN_OF_DISPLACEMENT] };
        let search_distance =
            relative + max(rest_gap.mean_edge * share, relative * of_displacement);
        let ours = self.features_near(one, other, search_distance);
        let theirs =
            if one == other { ours } else { self.features_near(other, one, search_distance) };
        let may_be_near_at_rest = self.are_near_at_rest(pair, rest_gap.full_gap_distance());
        let query = PairQuery { rest_gap, motion, search_distance, may_be_near_at_rest };
        self.push_vertex_triangle_pairs(pair, [ours.vertices, theirs.triangles], &query);
        if one != other {
            let masks = [theirs.vertices, ours.triangles];
            self.push_vertex_triangle_pairs([other, one], masks, &query);
        }
        self.push_edge_edge_pairs(pair, [ours.edges, theirs.edges], &query);
        let cache = &mut self.pair_cache;
        let range = PairRange {
            vertex_triangle: [from[0], cache.vertex_triangle.len() as u32],
            edge_edge: [from[1], cache.edge_edge.len() as u32],
            search_distance,
            travelled: 0.0,
        };
        cache.live_count += range.len();
        cache.ranges[tick_pair as usize] = Some(range);
        cache.has_ranges = true;
    }

    /// Pushes the cached pairs of one kind in a tick pair that may touch in this substep and for
    /// which `filter` returns true. `margin` as in [`Self::refresh_pairs`] [m].
    #[inline(always)]
    pub fn push_candidates<const KIND: ContactKind>(
        &self,
        tick_pair: u32,
        margin: f32,
        candidates: &mut CandidatePairs,
        filter: impl Fn(&[u32; 4]) -> bool,
    ) {
        if let Some(range) = &self.pair_cache.ranges[tick_pair as usize] {
            let relative = range.travelled + self.max_relative_displacement(tick_pair, margin);
            let cache = &self.pair_cache;
            if KIND == VERTEX_TRIANGLE {
                let pairs = range.vertex_triangle;
                cache.vertex_triangle.push_candidates(pairs, relative, candidates, filter);
            } else {
                cache.edge_edge.push_candidates(range.edge_edge, relative, candidates, filter);
            }
        }
    }

    /// Fits the AABBs of a cluster's triangles, vertices and edges at the start of the substep,
    /// unless that was done.
    fn fit_features(&mut self, cluster: u32, mesh: &Mesh, motion: &SweptParticles) {
        let i = cluster as usize;
        let cluster = &mut self.clusters[i];
        if cluster.has_feature_aabbs {
            return;
        }
        cluster.has_feature_aabbs = true;
        let [from, to] = cluster.triangles;
        let (block, whole) = (&mut self.triangle_aabbs[i], &mut self.start_aabbs[i]);
        (*block, *whole) = (SweptAabbBlock::EMPTY, SweptAabb::EMPTY);
        for (lane, triangle) in self.triangles[from as usize..to as usize].iter().enumerate() {
            let own = motion.start_aabb(mesh.triangles[*triangle as usize]);
            whole.merge(&own);
            block.set_lane(lane, &own);
        }
        let [from, to, _] = cluster.vertices;
        let chunks = self.vertices[from as usize..to as usize].chunks(LANES);
        for (block, chunk) in self.vertex_aabbs[i].iter_mut().zip(chunks) {
            *block = SweptAabbBlock::EMPTY;
            for (lane, vertex) in chunk.iter().enumerate() {
                block.set_lane(lane, &motion.start_aabb([*vertex]));
            }
        }
        let [from, to] = cluster.edges;
        let chunks = self.edges[from as usize..to as usize].chunks(LANES);
        for (block, chunk) in self.edge_aabbs[i].iter_mut().zip(chunks) {
            *block = SweptAabbBlock::EMPTY;
            for (lane, ends) in chunk.iter().enumerate() {
                block.set_lane(lane, &motion.start_aabb(*ends));
            }
        }
    }

    /// The owned vertices, the triangles and the owned edges of cluster `one` nearer than
    /// `search_distance` [m] to the AABB of cluster `other`.
    fn features_near(&self, one: u32, other: u32, search_distance: f32) -> FeatureMasks {
        let whole = &self.start_aabbs[other as usize];
        let i = one as usize;
        let cluster = &self.clusters[i];
        let (vertices, triangles, edges) = (cluster.vertices, cluster.triangles, cluster.edges);
        let block = core::slice::from_ref(&self.triangle_aabbs[i]);
        FeatureMasks {
            vertices: overlap_mask(
                &self.vertex_aabbs[i],
                vertices[1] - vertices[0],
                whole,
                search_distance,
            ),
            triangles: overlap_mask(block, triangles[1] - triangles[0], whole, search_distance),
            edges: overlap_mask(&self.edge_aabbs[i], edges[1] - edges[0], whole, search_distance),
        }
    }

    /// Caches the near pairs of a vertex of cluster `one` and a triangle of cluster `other`, from
    /// their masks.
    fn push_vertex_triangle_pairs(
        &mut self,
        [one, other]: [u32; 2],
        [vertices, triangles]: [u32; 2],
        query: &PairQuery<'_>,
    ) {
        if triangles == 0 {
            return;
        }
        let PairQuery { rest_gap, motion, search_distance, .. } = query;
        let from = self.clusters[one as usize].vertices[0];
        let first = self.clusters[other as usize].triangles[0];
        let block = &self.triangle_aabbs[other as usize];
        for i in set_bits(vertices) {
            let vertex = self.vertices[(from + i) as usize];
            let near = block.overlap_mask(&motion.start_aabb([vertex]), *search_distance);
            for j in set_bits(triangles & near) {
                let triangle = self.triangles[(first + j) as usize];
                let [a, b, c] = rest_gap.mesh.triangles[triangle as usize];
                if !rest_gap.are_joined(&[vertex], &[a, b, c]) {
                    let ids = [vertex, a, b, c];
                    let gap = query.gap_of::<VERTEX_TRIANGLE>(ids);
                    self.pair_cache.vertex_triangle.push(ids, gap);
                }
            }
        }
    }

    /// Caches the near pairs of an edge of cluster `one` and an edge of cluster `other`, from their
    /// masks.
    fn push_edge_edge_pairs(
        &mut self,
        [one, other]: [u32; 2],
        [ours, theirs]: [u32; 2],
        query: &PairQuery<'_>,
    ) {
        if theirs == 0 {
            return;
        }
        let PairQuery { rest_gap, motion, search_distance, .. } = query;
        let from = self.clusters[one as usize].edges[0];
        let first = self.clusters[other as usize].edges[0];
        let blocks = &self.edge_aabbs[other as usize];
        for i in set_bits(ours) {
            let [p, q] = self.edges[(from + i) as usize];
            let own = motion.start_aabb([p, q]);
            for (number, block) in blocks.iter().enumerate() {
                let theirs = theirs >> (number * LANES) & LANE_BITS;
                if theirs == 0 {
                    continue;
                }
                for j in set_bits(theirs & block.overlap_mask(&own, *search_distance)) {
                    let j = j + (number * LANES) as u32;
                    let [r, s] = self.edges[(first + j) as usize];
                    let is_disjoint = !rest_gap.are_joined(&[p, q], &[r, s]);
                    if is_disjoint && (one != other || i < j) {
                        let ids = [p, q, r, s];
                        self.pair_cache.edge_edge.push(ids, query.gap_of::<EDGE_EDGE>(ids));
                    }
                }
            }
        }
    }

    /// Whether both clusters are of one piece and nearer than `distance` [m] at rest.
    fn are_near_at_rest(&self, pair: [u32; 2], distance: f32) -> bool {
        let (a, b) = (&self.clusters[pair[0] as usize], &self.clusters[pair[1] as usize]);
        a.piece == b.piece && a.rest.expanded(distance).overlaps(&b.rest)
    }
}
