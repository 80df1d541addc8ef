//! Pairs that may meet in a substep but are too far from each other to push: a direction told them apart as it
//! began, and the fence asks whether it still does.

use crate::math::simd::{Level, Scalar, Simd, gather_transpose, vectored};
use crate::math::wide4::Float4;
use crate::solver::self_collide::surface::closest_lanes::{V, between};
use crate::solver::self_collide::surface::contact::{Contact, EDGES, Kind, SLIT, VERTEX};
use crate::solver::self_collide::surface::contact_graph::Around;
use crate::solver::self_collide::surface::swept_particles::Motion;
use glam::Vec3;

/// Pairs that are looked at together.
const LANES: usize = 8;

/// A pair that is left to the fence.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Distant {
    pub ids: [u32; 4],
    /// How many of them are the first side.
    pub first: Kind,
    /// How far they keep apart [m].
    pub gap: f32,
    /// From the second side to the first.
    pub n: Vec3,
}

/// Finds which pairs are apart by more than a fence leaves between them: a bit for each.
fn find_apart(level: Level, distant: &[Distant], now: &[Float4], apart: &mut Vec<u8>) {
    apart.clear();
    apart.resize(distant.len().div_ceil(LANES), 0);
    look(level, distant, now, apart);
}

/// Whether all pairs are apart by more than a fence leaves between them, as they were before some particles were
/// stirred.
pub(crate) fn are_apart(
    level: Level,
    distant: &[Distant],
    now: &[Float4],
    around: &Around,
) -> bool {
    let Some(first) = distant.first() else { return true };
    let (mut some, mut count) = ([*first; LANES], 0);
    let are_apart = |some: &[Distant]| {
        let mut apart = [0];
        look(level, some, now, &mut apart);
        apart[0].count_ones() as usize == some.len()
    };
    let is_stirred = |pair: &&Distant| around.are_stirred(pair.ids);
    for pair in distant.iter().filter(is_stirred) {
        some[count] = *pair;
        count += 1;
        if count == LANES {
            if !are_apart(&some) {
                return false;
            }
            count = 0;
        }
    }
    are_apart(&some[..count])
}

fn count(apart: &[u8]) -> usize {
    apart.iter().map(|bits| bits.count_ones() as usize).sum()
}

vectored! {
    /// Sets a bit for each pair that is apart.
    pub(crate) fn look(distant: &[Distant], now: &[Float4], apart: &mut [u8]) = look_at, Avx2, look_alone
}

fn look_alone(distant: &[Distant], now: &[Float4], apart: &mut [u8]) {
    look_at(Scalar, distant, now, apart);
}

#[inline(always)]
fn look_at<S: Simd>(s: S, distant: &[Distant], now: &[Float4], apart: &mut [u8]) {
    for (pairs, bits) in distant.chunks(LANES).zip(apart) {
        let mut ids = [[0; LANES]; 4];
        let mut n = [[0.0; LANES]; 3];
        let (mut slits, mut edges) = ([f32::INFINITY; LANES], [0.0; LANES]);
        for (lane, pair) in pairs.iter().enumerate() {
            for k in 0..4 {
                ids[k][lane] = pair.ids[k];
            }
            [n[0][lane], n[1][lane], n[2][lane]] = pair.n.to_array();
            slits[lane] = pair.gap * SLIT;
            edges[lane] = if pair.first == VERTEX { 0.0 } else { 1.0 };
        }
        for at in (0..LANES).step_by(S::LANES) {
            let n = V { x: s.load(&n[0], at), y: s.load(&n[1], at), z: s.load(&n[2], at) };
            let mut along = [s.splat(0.0); 4];
            for k in 0..4 {
                along[k] = n.dot(V::new(gather_transpose(s, now, &ids[k][at..])));
            }
            let vertices = between::<_, VERTEX>(along);
            let distance = s.select(s.load(&edges, at), between::<_, EDGES>(along), vertices);
            *bits |= (s.positive_mask(distance - s.load(&slits, at)) << at) as u8;
        }
    }
}

/// Makes contacts of what is apart no more, or of all. `apart` is room to work in. None keep more than `most` [m].
pub(crate) fn call(
    level: Level,
    distant: &mut Vec<Distant>,
    apart: &mut Vec<u8>,
    all: bool,
    motion: &Motion,
    most: f32,
    contacts: &mut Vec<Contact>,
) {
    find_apart(level, distant, &motion.now, apart);
    if !all && count(apart) == distant.len() {
        return;
    }
    let mut at = 0;
    distant.retain(|pair| {
        let stays = !all && apart[at / LANES] & (1 << (at % LANES)) != 0;
        at += 1;
        if !stays {
            let Distant { ids, gap, .. } = *pair;
            contacts.extend(if pair.first == VERTEX {
                Contact::find::<VERTEX>(ids, motion, most, gap)
            } else {
                Contact::find::<EDGES>(ids, motion, most, gap)
            });
        }
        stays
    });
}
