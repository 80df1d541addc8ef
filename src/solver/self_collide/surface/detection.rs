//! Contact detection of a substep: from cluster pairs to contacts and speculative contacts.
//!
//! ```text
//! refit clusters ─▶ substep pairs ─▶ refresh pair cache ─▶ candidate pairs ─▶ separation test
//!                                                                                  │
//!                       contacts ◀── narrow phase ◀── near ◀───────────────────────┤
//!                       speculative contacts ◀── far, but may meet ◀───────────────┘
//! ```
//! Runs once per substep for all pairs ([`Detector::detect`]), and again for the pairs of particles
//! that escaped from their motion bounds ([`Detector::detect_escaped`]).
//!
//! Reads [`SweptParticles`] and [`RestGap`]; writes the BVH and the lists of the caller.
//!
//! Invariant: contacts and speculative contacts depend on positions and mesh alone, in the order of
//! cluster pairs. The time at which a pair was cached makes no difference.

use crate::math::simd::Level;
use crate::solver::self_collide::surface::cluster_bvh::ClusterBvh;
use crate::solver::self_collide::surface::contact::{
    Contact, ContactKind, EDGE_EDGE, VERTEX_TRIANGLE,
};
use crate::solver::self_collide::surface::contact_solver::ACTIVE_DISTANCE;
use crate::solver::self_collide::surface::narrow_phase::NarrowPhase;
use crate::solver::self_collide::surface::rest_gap::RestGap;
use crate::solver::self_collide::surface::separation_test::{CandidatePair, CandidatePairs};
use crate::solver::self_collide::surface::speculative::SpeculativeContact;
use crate::solver::self_collide::surface::swept_aabb::LANES;
use crate::solver::self_collide::surface::swept_particles::SweptParticles;

/// Candidate pairs of escaped particles are tested in batches of more than this many. One cluster
/// pair adds at most `MAX_PER_CLUSTER_PAIR`.
const BATCH: usize = 1024;
const MAX_PER_CLUSTER_PAIR: usize = (3 * LANES) * (3 * LANES);

/// Part of the margin that covers rounding [mean rest lengths].
const ROUNDING: f32 = 1.0e-4;

/// Allocates the batch of [`Detector::detect_escaped`].
pub(crate) fn new_escaped_batch() -> CandidatePairs {
    CandidatePairs::new(BATCH + MAX_PER_CLUSTER_PAIR)
}

/// The data that detection works on, borrowed.
pub(crate) struct Detector<'a> {
    pub level: Level,
    pub rest_gap: RestGap<'a>,
    pub bvh: &'a mut ClusterBvh,
    pub motion: &'a SweptParticles,
}

/// Candidate pairs of a substep, vertex–triangle and edge–edge.
#[derive(Clone, Debug)]
pub(crate) struct CandidateLists {
    kinds: [CandidatePairs; 2],
    /// Length of both lists before the candidates of each cluster pair, and at the end.
    offsets: Vec<[u32; 2]>,
}

impl CandidateLists {
    /// Allocates for a cloth of `count` particles.
    pub fn new(count: usize) -> Self {
        let kinds = [8, 24].map(|each| CandidatePairs::new(each * count));
        Self { kinds, offsets: Vec::with_capacity(8 * count) }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        let kinds: usize = self.kinds.iter().map(CandidatePairs::bytes).sum();
        kinds + size_of::<[u32; 2]>() * self.offsets.capacity()
    }
}

/// Output of detection.
pub(crate) struct DetectedContacts<'a> {
    pub contacts: &'a mut Vec<Contact>,
    pub speculative: &'a mut Vec<SpeculativeContact>,
}

impl Detector<'_> {
    /// Detects all contacts and speculative contacts of the substep. `pairs`, `candidates` and
    /// `narrow` are scratch; `pairs` holds the substep pairs afterwards.
    pub fn detect(
        &mut self,
        pairs: &mut Vec<u32>,
        candidates: &mut CandidateLists,
        narrow: &mut [NarrowPhase; 2],
        detected: &mut DetectedContacts<'_>,
    ) {
        detected.contacts.clear();
        detected.speculative.clear();
        let (level, RestGap { mean_edge, gap, .. }) = (self.level, self.rest_gap);
        self.bvh.refit(level, self.motion, mean_edge);
        self.bvh.age_pair_cache();
        self.bvh.collect_substep_pairs(gap, false, pairs);
        self.refresh_pairs(pairs);
        let (CandidateLists { kinds: [vertices, edges], offsets }, margin) =
            (candidates, self.margin());
        [&mut *vertices, edges].into_iter().for_each(CandidatePairs::clear);
        offsets.clear();
        for pair in &*pairs {
            offsets.push([vertices.len() as u32, edges.len() as u32]);
            self.bvh.push_candidates::<VERTEX_TRIANGLE>(*pair, margin, vertices, |_| true);
            self.bvh.push_candidates::<EDGE_EDGE>(*pair, margin, edges, |_| true);
        }
        offsets.push([vertices.len() as u32, edges.len() as u32]);
        vertices.test_separation::<VERTEX_TRIANGLE>(level, self.motion, gap);
        edges.test_separation::<EDGE_EDGE>(level, self.motion, gap);
        for range in offsets.windows(2) {
            let ([from, first], [to, end]) = (range[0], range[1]);
            let remaining = vertices.remaining(from, to);
            classify::<VERTEX_TRIANGLE>(remaining, &mut narrow[0], detected);
            classify::<EDGE_EDGE>(edges.remaining(first, end), &mut narrow[1], detected);
        }
        narrow[0].fill_contacts::<VERTEX_TRIANGLE>(level, self.motion, detected.contacts);
        narrow[1].fill_contacts::<EDGE_EDGE>(level, self.motion, detected.contacts);
    }

    /// Appends the pairs of escaped particles that may meet to `speculative`. `pairs` and
    /// `candidates` are scratch.
    pub fn detect_escaped(
        &mut self,
        pairs: &mut Vec<u32>,
        candidates: &mut CandidatePairs,
        speculative: &mut Vec<SpeculativeContact>,
    ) {
        self.bvh.refit_escaped(self.level, self.motion);
        self.bvh.collect_substep_pairs(self.rest_gap.gap, true, pairs);
        self.refresh_pairs(pairs);
        // One kind after the other, so that the batch size makes no difference to the order.
        self.test_escaped::<VERTEX_TRIANGLE>(pairs, candidates, speculative);
        self.test_escaped::<EDGE_EDGE>(pairs, candidates, speculative);
    }

    fn test_escaped<const KIND: ContactKind>(
        &mut self,
        pairs: &[u32],
        candidates: &mut CandidatePairs,
        speculative: &mut Vec<SpeculativeContact>,
    ) {
        let (level, gap) = (self.level, self.rest_gap.gap);
        for (number, pair) in pairs.iter().enumerate() {
            let has_folded = self.bvh.has_folded(*pair);
            let has_escaped =
                |ids: &[u32; 4]| has_folded || ids.iter().any(|id| self.motion.has_escaped(*id));
            self.bvh.push_candidates::<KIND>(*pair, self.margin(), candidates, has_escaped);
            if candidates.len() > BATCH || number + 1 == pairs.len() {
                let count = candidates.len() as u32;
                candidates.test_separation::<KIND>(level, self.motion, gap);
                let remaining = candidates.remaining(0, count);
                speculative.extend(remaining.map(|pair| pair.to_speculative(KIND)));
                candidates.clear();
            }
        }
    }

    /// Refreshes the cached pairs of tick pairs where needed.
    fn refresh_pairs(&mut self, tick_pairs: &[u32]) {
        let margin = self.margin();
        for pair in tick_pairs {
            self.bvh.refresh_pairs(*pair, &self.rest_gap, self.motion, margin);
        }
        self.bvh.pair_cache.measure(self.level, &self.motion.start);
    }

    /// Margin of all distance tests [m]: a pair counts as near if its sides may come within this
    /// distance.
    fn margin(&self) -> f32 {
        let RestGap { mean_edge, gap, .. } = self.rest_gap;
        ACTIVE_DISTANCE[0] * gap + mean_edge * ROUNDING
    }
}

/// Pushes near pairs to the narrow phase, and far ones to the speculative contacts.
#[inline(always)]
fn classify<const KIND: ContactKind>(
    candidates: impl Iterator<Item = CandidatePair>,
    narrow: &mut NarrowPhase,
    detected: &mut DetectedContacts<'_>,
) {
    for candidate in candidates {
        if candidate.distance >= candidate.gap * ACTIVE_DISTANCE[KIND as usize - 1] {
            detected.speculative.push(candidate.to_speculative(KIND));
        } else {
            narrow.push(candidate.ids, KIND, candidate.gap, detected.contacts);
        }
    }
}
