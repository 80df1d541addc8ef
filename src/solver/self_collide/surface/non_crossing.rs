//! The last word: no side of a pair gets through the other.
//!
//! As a substep began, each pair was apart along its direction, all of them at once. Particles are moved, each
//! as little as it takes, until all are so again; and where that does not end, some go back to where
//! they were, but for how all moved, and with them whom that gets in the way of. What is held does not: it takes
//! along what it would cross.

use crate::math::simd::Level;
use crate::math::wide4::{Float4, xyz};
use crate::solver::particle_stage::interleaved::shift;
use crate::solver::self_collide::surface::contact::{Contact, SLIT, VERTEX, between, places};
use crate::solver::self_collide::surface::contact_graph::{Around, BITS};
use crate::solver::self_collide::surface::speculative::{Distant, look};
use crate::solver::self_collide::surface::swept_particles::Motion;

/// How often those that would cross are moved before some go back.
const ROUNDS: u32 = 48;

/// Rounds that come nearer to all that is to be left between sides than to what is let be.
const FULL: u32 = 8;

/// Every so many rounds sides that still would cross are told apart anew.
const TURN: u32 = 4;

/// A slit this much smaller than it should be is let be.
const HAIR: f32 = 0.99;

/// What goes nowhere by now, and what goes back; what else is along with that particle.
const FREE: u32 = u32::MAX;
const BACK: u32 = u32::MAX - 1;

/// Moves what would cross of those that are due, and what gets in the way of that; says whether nothing crosses
/// any more, or else leaves due what does. `open` is room to work in.
pub(crate) fn draw_apart(
    contacts: &mut [Contact],
    motion: &mut Motion,
    around: &mut Around,
    open: &mut Vec<u32>,
) -> bool {
    let Motion { start, now, .. } = motion;
    let least = |contact: &Contact, round| {
        if round < FULL { contact.slit * HAIR } else { contact.least }
    };
    let mut round = 0;
    loop {
        open.clear();
        around.call_moved(contacts);
        let mut next = 0;
        while let Some(at) = around.next_due(next) {
            next = at;
            let contact = &mut contacts[at];
            if is_apart(contact, now, least(contact, round)) {
                continue;
            }
            contact.turn_to(places(start, contact.ids), now);
            if !is_apart(contact, now, least(contact, round)) {
                open.push(at as u32);
            }
        }
        if open.is_empty() {
            return true;
        }
        let mut is_done = false;
        while !is_done {
            if round == ROUNDS {
                around.call_moved(contacts);
                open.iter().for_each(|at| around.call_one(*at));
                return false;
            }
            round += 1;
            is_done = true;
            for at in &*open {
                let contact = &mut contacts[*at as usize];
                if is_apart(contact, now, least(contact, round)) {
                    continue;
                }
                if round.is_multiple_of(TURN) {
                    contact.turn_to(places(start, contact.ids), now);
                }
                is_done = false;
                draw(contact, now, around);
            }
        }
    }
}

/// Those are due no more that surely are apart already.
pub(crate) fn let_go(
    level: Level,
    contacts: &[Contact],
    first: usize,
    now: &[Float4],
    around: &mut Around,
) {
    let pair = |contact: &Contact| {
        let Contact { ids, first, n, slit, .. } = *contact;
        // As if it were a pair with a slit so wide.
        let gap = if slit < 0.0 { f32::NEG_INFINITY } else { slit * HAIR / SLIT };
        Distant { ids, first, gap, n }
    };
    let mut pairs = [pair(&Contact::of([0; 4], VERTEX)); BITS];
    for (word, contacts) in contacts.chunks(BITS).enumerate().skip(first / BITS) {
        pairs.iter_mut().zip(contacts).for_each(|(own, contact)| *own = pair(contact));
        let mut apart = [0; BITS / 8];
        look(level, &pairs[..contacts.len()], now, &mut apart);
        around.let_go(word, u64::from_le_bytes(apart));
    }
}

#[inline(always)]
fn is_apart(contact: &Contact, x: &[Float4], least: f32) -> bool {
    least < 0.0 || between(places(x, contact.ids), contact.first, contact.n) >= least
}

/// Moves each particle of one side and each of the other apart.
fn draw(contact: &Contact, x: &mut [Float4], around: &mut Around) {
    let (one, other) = contact.ids.split_at(contact.first as usize);
    for a in one {
        for b in other {
            let (spot_a, spot_b) = (x[*a as usize], x[*b as usize]);
            let missing = contact.slit - contact.n.dot(xyz(&spot_a) - xyz(&spot_b));
            let sum = spot_a[3] + spot_b[3];
            if missing <= 0.0 || sum <= 0.0 {
                continue;
            }
            let by = contact.n * (missing / sum);
            shift(&mut x[*a as usize], by * spot_a[3]);
            shift(&mut x[*b as usize], by * -spot_b[3]);
            around.moves(*a);
            around.moves(*b);
        }
    }
}

/// What would cross of those that are due goes back, and what that gets in the way of; or along with what is held,
/// if that is in the way.
pub(crate) fn go_back(
    contacts: &[Contact],
    motion: &mut Motion,
    around: &mut Around,
    frozen: &mut Vec<u32>,
) {
    let Motion { start, now: x, drift, .. } = motion;
    frozen.clear();
    frozen.resize(x.len(), FREE);
    for (at, (frozen, x)) in frozen.iter_mut().zip(x.iter()).enumerate() {
        *frozen = if x[3] > 0.0 { FREE } else { at as u32 };
    }
    loop {
        around.call_moved(contacts);
        let mut next = 0;
        while let Some(at) = around.next_due(next) {
            next = at;
            let contact = &contacts[at];
            if is_apart(contact, x, contact.least) {
                continue;
            }
            let leads = contact.ids.map(|id| frozen[id as usize]);
            let leader = leads.into_iter().find(|lead| *lead < BACK).unwrap_or(BACK);
            for id in contact.ids {
                let at = id as usize;
                if frozen[at] <= leader || frozen[at] < BACK {
                    continue;
                }
                frozen[at] = leader;
                around.moves(id);
                let way = if leader == BACK {
                    *drift
                } else {
                    xyz(&x[leader as usize]) - xyz(&start[leader as usize])
                };
                [x[at][0], x[at][1], x[at][2]] = (xyz(&start[at]) + way).to_array();
            }
        }
        if !around.has_moved() {
            return;
        }
    }
}
