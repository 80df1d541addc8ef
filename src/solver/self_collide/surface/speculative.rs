//! Speculative contacts: pairs that may meet in the substep but are too far apart for the contact
//! solver.
//!
//! ```text
//! distance < ACTIVE_DISTANCE · gap     contacts: the contact solver works on them
//! farther, but may meet                speculative contacts: the non-crossing pass tests only
//!                                      their separation along the normal of the start
//! farther than both can move           rejected
//! ```
//! A speculative contact becomes a contact when its start normal does not separate both sides any
//! more by the minimum separation. Eight pairs are tested at once.
//!
//! Reads current positions and the contact graph; writes bit masks and appends to the list of
//! contacts.
//!
//! Invariant: promotion keeps the order of the remaining pairs and appends contacts in list order.

use crate::math::simd::{Level, Scalar, Simd, gather_transpose, vectored};
use crate::math::wide4::Float4;
use crate::solver::self_collide::surface::closest_lanes::{Vec3Lanes, separation};
use crate::solver::self_collide::surface::contact::{
    Contact, ContactKind, EDGE_EDGE, SEPARATION_SHARE, VERTEX_TRIANGLE,
};
use crate::solver::self_collide::surface::contact_graph::ContactGraph;
use crate::solver::self_collide::surface::swept_particles::SweptParticles;
use glam::Vec3;

/// Pairs that are tested together.
const LANES: usize = 8;

/// A pair that only the non-crossing pass watches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpeculativeContact {
    pub ids: [u32; 4],
    pub kind: ContactKind,
    /// Distance that the pair keeps [m].
    pub gap: f32,
    /// Direction that separates both sides at the start of the substep, from the second side to the
    /// first.
    pub n: Vec3,
}

/// Fills `separated` with a bit for each pair: set if both sides are farther apart than the minimum
/// separation.
fn compute_separated(
    level: Level,
    pairs: &[SpeculativeContact],
    now: &[Float4],
    separated: &mut Vec<u8>,
) {
    separated.clear();
    separated.resize(pairs.len().div_ceil(LANES), 0);
    test_separated(level, pairs, now, separated);
}

/// Whether all pairs with a moved particle are still separated by more than the minimum separation.
/// Pairs without one were tested before.
pub(crate) fn are_separated(
    level: Level,
    pairs: &[SpeculativeContact],
    now: &[Float4],
    graph: &ContactGraph,
) -> bool {
    let Some(first) = pairs.first() else { return true };
    let (mut batch, mut count) = ([*first; LANES], 0);
    let are_separated = |batch: &[SpeculativeContact]| {
        let mut separated = [0];
        test_separated(level, batch, now, &mut separated);
        separated[0].count_ones() as usize == batch.len()
    };
    let has_moved = |pair: &&SpeculativeContact| graph.has_moved(pair.ids);
    for pair in pairs.iter().filter(has_moved) {
        batch[count] = *pair;
        count += 1;
        if count == LANES {
            if !are_separated(&batch) {
                return false;
            }
            count = 0;
        }
    }
    are_separated(&batch[..count])
}

fn count_bits(bytes: &[u8]) -> usize {
    bytes.iter().map(|bits| bits.count_ones() as usize).sum()
}

vectored! {
    /// Sets a bit for each pair that is separated along its normal by more than the minimum
    /// separation.
    pub(crate) fn test_separated(
        pairs: &[SpeculativeContact], now: &[Float4], separated: &mut [u8],
    ) = test_separated_lanes, test_separated_scalar
}

fn test_separated_scalar(pairs: &[SpeculativeContact], now: &[Float4], separated: &mut [u8]) {
    test_separated_lanes(Scalar, pairs, now, separated);
}

#[inline(always)]
fn test_separated_lanes<S: Simd>(
    s: S,
    pairs: &[SpeculativeContact],
    now: &[Float4],
    separated: &mut [u8],
) {
    for (pairs, bits) in pairs.chunks(LANES).zip(separated) {
        let mut ids = [[0; LANES]; 4];
        let mut n = [[0.0; LANES]; 3];
        let (mut least, mut is_edge) = ([f32::INFINITY; LANES], [0.0; LANES]);
        for (lane, pair) in pairs.iter().enumerate() {
            for k in 0..4 {
                ids[k][lane] = pair.ids[k];
            }
            [n[0][lane], n[1][lane], n[2][lane]] = pair.n.to_array();
            least[lane] = pair.gap * SEPARATION_SHARE;
            is_edge[lane] = if pair.kind == VERTEX_TRIANGLE { 0.0 } else { 1.0 };
        }
        for lane in (0..LANES).step_by(S::LANES) {
            let n = Vec3Lanes {
                x: s.load(&n[0], lane),
                y: s.load(&n[1], lane),
                z: s.load(&n[2], lane),
            };
            let mut along = [s.splat(0.0); 4];
            for k in 0..4 {
                along[k] = n.dot(Vec3Lanes::new(gather_transpose(s, now, &ids[k][lane..])));
            }
            let vertex_triangle = separation::<_, VERTEX_TRIANGLE>(along);
            let edge_edge = separation::<_, EDGE_EDGE>(along);
            let distance = s.select(s.load(&is_edge, lane), edge_edge, vertex_triangle);
            *bits |= (s.positive_mask(distance - s.load(&least, lane)) << lane) as u8;
        }
    }
}

/// Promotes speculative contacts to contacts: those whose sides are not separated any more, or all
/// with `all`.
///
/// `separated` is scratch. `max_gap` is the largest gap of any pair [m].
pub(crate) fn promote(
    level: Level,
    pairs: &mut Vec<SpeculativeContact>,
    separated: &mut Vec<u8>,
    all: bool,
    motion: &SweptParticles,
    max_gap: f32,
    contacts: &mut Vec<Contact>,
) {
    compute_separated(level, pairs, &motion.now, separated);
    if !all && count_bits(separated) == pairs.len() {
        return;
    }
    let mut i = 0;
    pairs.retain(|pair| {
        let stays = !all && separated[i / LANES] & (1 << (i % LANES)) != 0;
        i += 1;
        if !stays {
            let SpeculativeContact { ids, gap, .. } = *pair;
            contacts.extend(if pair.kind == VERTEX_TRIANGLE {
                Contact::detect::<VERTEX_TRIANGLE>(ids, motion, max_gap, gap)
            } else {
                Contact::detect::<EDGE_EDGE>(ids, motion, max_gap, gap)
            });
        }
        stays
    });
}
