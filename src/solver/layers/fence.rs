//! The last word: no side of a pair gets through the other.
//!
//! As a substep began, each pair was apart along its direction, all of them at once. Particles are moved, each
//! as little as it takes, until all are so again; and where that does not end, some go back to where
//! they were, but for how all moved, and with them whom that gets in the way of. What is held does not: it takes
//! along what it would cross.

use super::contacts::{Contact, between, places};
use super::spots::{Spot, farthest, place, shift};
use glam::Vec3;

/// How often all are moved before some go back.
const ROUNDS: u32 = 24;

/// What goes nowhere by now, and what goes back; what else is along with that particle.
const FREE: u32 = u32::MAX;
const BACK: u32 = u32::MAX - 1;

/// A slit this much smaller than it should be is let be.
const HAIR: f32 = 0.99;

/// Rounds that come nearer to all that is to be left between sides than to what is let be.
const FULL: u32 = 8;

/// Moves what would cross; `frozen` is room to work in. Says whether anything went back.
pub(super) fn hold(
    contacts: &mut [Contact],
    start: &[Spot],
    x: &mut [Spot],
    drift: Vec3,
    frozen: &mut Vec<u32>,
) -> bool {
    for round in 0..ROUNDS {
        let least =
            |contact: &Contact| if round < FULL { contact.slit * HAIR } else { contact.least };
        let way = 2.0 * farthest(start, x, drift);
        let mut is_done = true;
        for contact in contacts.iter_mut() {
            if contact.distance > contact.slit + way || is_apart(contact, x, least(contact)) {
                continue;
            }
            if round == 0 {
                contact.turn_to(places(start, contact.ids), x);
                if is_apart(contact, x, least(contact)) {
                    continue;
                }
            }
            is_done = false;
            draw_apart(contact, x);
        }
        if is_done {
            return false;
        }
    }
    go_back(contacts, start, x, drift, frozen);
    true
}

#[inline(always)]
fn is_apart(contact: &Contact, x: &[Spot], least: f32) -> bool {
    least < 0.0 || between(places(x, contact.ids), contact.first, contact.n) >= least
}

/// Moves each particle of one side and each of the other apart.
fn draw_apart(contact: &Contact, x: &mut [Spot]) {
    let (one, other) = contact.ids.split_at(contact.first as usize);
    for a in one {
        for b in other {
            let (spot_a, spot_b) = (x[*a as usize], x[*b as usize]);
            let missing = contact.slit - contact.n.dot(place(&spot_a) - place(&spot_b));
            let sum = spot_a[3] + spot_b[3];
            if missing <= 0.0 || sum <= 0.0 {
                continue;
            }
            let by = contact.n * (missing / sum);
            shift(&mut x[*a as usize], by * spot_a[3]);
            shift(&mut x[*b as usize], by * -spot_b[3]);
        }
    }
}

/// What would cross goes back, and what that gets in the way of; or along with what is held, if that is in the
/// way.
pub(super) fn go_back(
    contacts: &[Contact],
    start: &[Spot],
    x: &mut [Spot],
    drift: Vec3,
    frozen: &mut Vec<u32>,
) {
    frozen.clear();
    frozen.resize(x.len(), FREE);
    for (at, (frozen, x)) in frozen.iter_mut().zip(x.iter()).enumerate() {
        *frozen = if x[3] > 0.0 { FREE } else { at as u32 };
    }
    loop {
        let mut is_done = true;
        for contact in contacts {
            if is_apart(contact, x, contact.least) {
                continue;
            }
            let leads = contact.ids.map(|id| frozen[id as usize]);
            let leader = leads.into_iter().find(|lead| *lead < BACK).unwrap_or(BACK);
            for id in contact.ids.map(|id| id as usize) {
                if frozen[id] <= leader || frozen[id] < BACK {
                    continue;
                }
                frozen[id] = leader;
                is_done = false;
                let way = if leader == BACK {
                    drift
                } else {
                    place(&x[leader as usize]) - place(&start[leader as usize])
                };
                [x[id][0], x[id][1], x[id][2]] = (place(&start[id]) + way).to_array();
            }
        }
        if is_done {
            return;
        }
    }
}
