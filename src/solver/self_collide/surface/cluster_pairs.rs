//! Broad phase: cluster pairs that may meet in the tick, and those of them that may meet in a
//! substep.
//!
//! ```text
//! once per tick        BVH against itself, swept AABBs from tick bounds     → tick pairs
//! in each substep      tick pairs: normal cones, swept AABBs from motion    → substep pairs
//! ```
//! The traversal descends both nodes of a pair, the one with more clusters first. Substeps of a
//! tick filter the list of tick pairs; the tree is traversed again only if a particle leaves its
//! tick bound.
//!
//! Reads [`TickBounds`] and the boxes that [`ClusterBvh::refit`] computed; writes `tick_pairs`,
//! `tick_pair_neighbours` and the caller's list.
//!
//! Invariant: pairs come out in the same order for the same mesh, the lower cluster first.

use crate::math::max;
use crate::mesh::NONE;
use crate::solver::self_collide::surface::cluster_bvh::ClusterBvh;
use crate::solver::self_collide::surface::swept_aabb::SweptAabb;
use crate::solver::self_collide::surface::tick_bounds::TickBounds;

/// Factor that covers the rounding of relative displacements.
const ROUNDING: f32 = 1.001;

impl ClusterBvh {
    /// Rebuilds `tick_pairs`: pairs of clusters that may come nearer than `gap` [m] in the rest of
    /// the tick. Each cluster is paired with itself as well.
    pub fn rebuild_tick_pairs(&mut self, bounds: &TickBounds, gap: f32) {
        for i in (0..self.nodes.len()).rev() {
            let node = self.nodes[i];
            let mut all;
            if node.cluster == NONE {
                all = self.tick_aabbs[i + 1];
                all.merge(&self.tick_aabbs[node.second as usize]);
            } else {
                let cluster = &self.clusters[node.cluster as usize];
                let own = cluster.vertices[0] as usize..cluster.vertices[2] as usize;
                all = SweptAabb::of_particles(&self.vertices[own], bounds.base_and_bounds());
            }
            self.tick_aabbs[i] = all;
        }
        let mut pairs = core::mem::take(&mut self.tick_pairs);
        let mut neighbours = core::mem::take(&mut self.tick_pair_neighbours);
        neighbours.clear();
        self.pair_cache.swap_tick_pairs(&mut pairs);
        let mut stack = core::mem::take(&mut self.stack);
        stack.clear();
        stack.push([0, 0]);
        while let Some([a, b]) = stack.pop() {
            let (one, other) = (self.nodes[a as usize], self.nodes[b as usize]);
            if a == b {
                if one.cluster == NONE {
                    stack.push([one.second, one.second]);
                    stack.push([a + 1, one.second]);
                    stack.push([a + 1, a + 1]);
                } else {
                    pairs.push([one.cluster; 2]);
                    neighbours.push(NONE);
                }
            } else if self.tick_aabbs[a as usize].overlaps(&self.tick_aabbs[b as usize], gap) {
                if one.cluster != NONE && other.cluster != NONE {
                    pairs.push([one.cluster, other.cluster]);
                    neighbours.push(self.neighbour_index([one.cluster, other.cluster]));
                } else if one.cluster == NONE && one.count >= other.count {
                    stack.push([one.second, b]);
                    stack.push([a + 1, b]);
                } else {
                    stack.push([a, other.second]);
                    stack.push([a, b + 1]);
                }
            }
        }
        self.pair_cache.restore_known_pairs(&pairs, self.clusters.len());
        (self.stack, self.tick_pairs, self.tick_pair_neighbours) = (stack, pairs, neighbours);
    }

    /// Fills `substep_pairs` with the indices of tick pairs that may come nearer than `gap` [m] in
    /// this substep; with `only_escaped`, those with an escaped vertex and those that folded since the
    /// last update of the normal cones. Pairs that the normal cones cull are left out.
    pub fn collect_substep_pairs(
        &self,
        gap: f32,
        only_escaped: bool,
        substep_pairs: &mut Vec<u32>,
    ) {
        substep_pairs.clear();
        let pairs = self.tick_pairs.iter().zip(&self.tick_pair_neighbours);
        for (i, ([one, other], neighbour)) in pairs.enumerate() {
            let is_culled = if one == other {
                self.normal_cones.is_flat(*one)
            } else {
                *neighbour != NONE && self.normal_cones.is_culled(*neighbour)
            };
            if is_culled {
                continue;
            }
            let [a, b] = [*one as usize, *other as usize];
            let has_escaped = || self.clusters[a].has_escaped || self.clusters[b].has_escaped;
            if only_escaped && !has_escaped() && !self.has_folded(i as u32) {
                continue;
            }
            if a == b || self.swept_aabbs[a].overlaps(&self.swept_aabbs[b], gap) {
                substep_pairs.push(i as u32);
            }
        }
    }

    /// Whether the normal cones culled a tick pair before they were last updated, and do not now.
    pub fn has_folded(&self, tick_pair: u32) -> bool {
        let ([one, other], neighbour) =
            (self.tick_pairs[tick_pair as usize], self.tick_pair_neighbours[tick_pair as usize]);
        if one == other {
            self.normal_cones.has_folded(one)
        } else {
            neighbour != NONE && self.normal_cones.has_folded_pair(neighbour)
        }
    }

    /// An upper bound of the relative displacement in a tick pair in this substep, plus `margin`
    /// [m].
    #[inline(always)]
    pub fn max_relative_displacement(&self, tick_pair: u32, margin: f32) -> f32 {
        let [one, other] = self.tick_pair(tick_pair).map(|cluster| cluster as usize);
        let relative = self.swept_aabbs[one].max_relative_displacement(&self.swept_aabbs[other]);
        let bound = relative * ROUNDING + margin;
        if bound < f32::INFINITY { bound } else { f32::INFINITY }
    }

    /// An upper bound of the relative displacement in a tick pair since the last refit [m].
    #[inline(always)]
    pub fn relative_step(&self, tick_pair: u32) -> f32 {
        let [one, other] = self.tick_pair(tick_pair).map(|cluster| cluster as usize);
        let (first, second) = (&self.step_displacements[one], &self.step_displacements[other]);
        let ([low, high], [other_low, other_high]) = (first, second);
        let mut sum = 0.0;
        for k in 0..3 {
            let relative = max(high[k] - other_low[k], other_high[k] - low[k]);
            sum += relative * relative;
        }
        sum.sqrt() * ROUNDING
    }

    /// The clusters of a tick pair.
    #[inline(always)]
    pub fn tick_pair(&self, tick_pair: u32) -> [u32; 2] {
        self.tick_pairs[tick_pair as usize]
    }

    /// The index of a pair in the normal cones if both clusters are neighbours, else `NONE`.
    fn neighbour_index(&self, [one, other]: [u32; 2]) -> u32 {
        let [from, to] = self.clusters[one as usize].neighbours;
        let neighbours = &self.neighbours[from as usize..to as usize];
        let found = neighbours.iter().find(|[cluster, _]| *cluster == other);
        found.map_or(NONE, |[_, index]| *index)
    }
}
