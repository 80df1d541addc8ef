//! Non-crossing pass: the last guarantee that no surface passes through another.
//!
//! ```text
//! pending contacts ─▶ separated along their normal?  yes ─▶ done
//!        ▲                      │ no
//!        │               new normal, else push the sides apart by inverse masses
//!        └── contacts of particles that moved
//! after MAX_ROUNDS rounds: roll back particles by degrees, until all are separated
//! ```
//! At the start of the substep all contacts are separated at the same time. So rolling back to the
//! start always succeeds, unless fixed particles move against each other and leave no space.
//! Particles lose half of their motion, three quarters, seven eighths, then all of it: separation
//! along a normal is linear in that share, so a small conflict costs little motion. Motion is counted
//! from the start plus the mean displacement, so that a falling cloth does not stop; where colliders
//! touch the cloth, from the start, which lies outside them.
//!
//! Particles that touch a collider have a plane there ([`SupportPlanes`]). Each push ends with a
//! projection onto these planes, and a plane counts as heavy against pushes towards it.
//!
//! A fixed particle does not roll back; the particles in its path move along with it. This
//! has the role of the rigid impact zones of Provot, "Collision and self-collision handling in
//! cloth model dedicated to design garments", 1997, and of Bridson, Fedkiw, Anderson, "Robust
//! Treatment of Collisions, Contact and Friction for Cloth Animation", SIGGRAPH 2002.
//!
//! Reads contacts; writes `SweptParticles::now`, contact normals and the contact graph.
//!
//! Invariant: only particles move, and each move is marked in the contact graph, so no contact
//! stays unchecked.

use core::cmp::max;

use crate::math::simd::Level;
use crate::math::wide4::{Float4, xyz};
use crate::solver::particle_stage::interleaved::translate;
use crate::solver::self_collide::surface::contact::{
    Contact, SEPARATION_SHARE, VERTEX_TRIANGLE, positions, separation,
};
use crate::solver::self_collide::surface::contact_graph::{ContactGraph, WORD_BITS};
use crate::solver::self_collide::surface::speculative::{SpeculativeContact, test_separated};
use crate::solver::self_collide::surface::support_planes::SupportPlanes;
use crate::solver::self_collide::surface::swept_particles::SweptParticles;

/// Rounds of pushing before particles roll back.
const MAX_ROUNDS: u32 = 96;

/// Rounds that demand the minimum separation; later rounds accept the tolerated one.
const STRICT_ROUNDS: u32 = 8;

/// Number of rounds after which a contact that is still open gets a new normal.
const NORMAL_ROUNDS: u32 = 4;

/// Share of its inverse mass with which a particle moves towards a plane that supports it.
const BLOCKED_SHARE: f32 = 0.01;

/// Share of the minimum separation that counts as reached.
const REACHED_SHARE: f32 = 0.99;

/// Leader of a particle that may move freely, and of one that rolled back. Other values are fixed
/// particles whose displacement the particle takes.
const FREE: u32 = u32::MAX;
const ROLLED_BACK: u32 = u32::MAX - 4;

/// The share of its motion that a particle keeps whose leader is `FREE`, one less, and so on down
/// to `ROLLED_BACK`.
const KEPT: [f32; 5] = [1.0, 0.5, 0.25, 0.125, 0.0];

/// Pushes the sides of pending contacts apart until all are separated. Returns true on success;
/// else the contacts that are not separated, or not checked, are pending. `open` is scratch.
pub(crate) fn separate(
    contacts: &mut [Contact],
    motion: &mut SweptParticles,
    graph: &mut ContactGraph,
    planes: &SupportPlanes,
    open: &mut Vec<u32>,
) -> bool {
    let SweptParticles { start, now, .. } = motion;
    let least = |contact: &Contact, round| {
        if round < STRICT_ROUNDS {
            contact.min_separation * REACHED_SHARE
        } else {
            contact.tolerated_separation
        }
    };
    let mut round = 0;
    loop {
        open.clear();
        graph.schedule_dirty(contacts);
        let mut next = 0;
        while let Some(i) = graph.pop_pending(next) {
            next = i;
            let contact = &mut contacts[i];
            if is_separated(contact, now, least(contact, round)) {
                continue;
            }
            contact.refresh_normal(positions(start, contact.ids), now);
            if !is_separated(contact, now, least(contact, round)) {
                open.push(i as u32);
            }
        }
        if open.is_empty() {
            return true;
        }
        let mut is_done = false;
        while !is_done {
            if round == MAX_ROUNDS {
                graph.schedule_dirty(contacts);
                open.iter().for_each(|i| graph.schedule(*i));
                return false;
            }
            round += 1;
            is_done = true;
            for i in &*open {
                let contact = &mut contacts[*i as usize];
                if is_separated(contact, now, least(contact, round)) {
                    continue;
                }
                if round.is_multiple_of(NORMAL_ROUNDS) {
                    contact.refresh_normal(positions(start, contact.ids), now);
                }
                is_done = false;
                push_sides(contact, now, planes, graph);
            }
        }
    }
}

/// Unschedules the contacts from index `first` on that are separated, 64 at a time.
pub(crate) fn unschedule_separated(
    level: Level,
    contacts: &[Contact],
    first: usize,
    now: &[Float4],
    graph: &mut ContactGraph,
) {
    let to_pair = |contact: &Contact| {
        let Contact { ids, kind, n, min_separation, .. } = *contact;
        // The gap for which the test demands this minimum separation.
        let gap = if min_separation < 0.0 {
            f32::NEG_INFINITY
        } else {
            min_separation * REACHED_SHARE / SEPARATION_SHARE
        };
        SpeculativeContact { ids, kind, gap, n }
    };
    let mut pairs = [to_pair(&Contact::inactive([0; 4], VERTEX_TRIANGLE)); WORD_BITS];
    for (word, contacts) in contacts.chunks(WORD_BITS).enumerate().skip(first / WORD_BITS) {
        pairs.iter_mut().zip(contacts).for_each(|(pair, contact)| *pair = to_pair(contact));
        let mut separated = [0; WORD_BITS / 8];
        test_separated(level, &pairs[..contacts.len()], now, &mut separated);
        graph.unschedule(word, u64::from_le_bytes(separated));
    }
}

#[inline(always)]
fn is_separated(contact: &Contact, x: &[Float4], least: f32) -> bool {
    least < 0.0 || separation(positions(x, contact.ids), contact.kind, contact.n) >= least
}

/// Separates each particle of the first side from each of the second by the minimum separation, in
/// proportion to inverse masses, and keeps them in front of their support planes.
fn push_sides(
    contact: &Contact,
    x: &mut [Float4],
    planes: &SupportPlanes,
    graph: &mut ContactGraph,
) {
    let (one, other) = contact.ids.split_at(contact.kind as usize);
    for a in one {
        for b in other {
            let (particle_a, particle_b) = (x[*a as usize], x[*b as usize]);
            let distance = contact.n.dot(xyz(&particle_a) - xyz(&particle_b));
            let missing = contact.min_separation - distance;
            let [mut w_a, mut w_b] = [particle_a[3], particle_b[3]];
            if planes.blocks(*a as usize, &particle_a, contact.n) {
                w_a *= BLOCKED_SHARE;
            }
            if planes.blocks(*b as usize, &particle_b, -contact.n) {
                w_b *= BLOCKED_SHARE;
            }
            let sum = w_a + w_b;
            if missing <= 0.0 || sum <= 0.0 {
                continue;
            }
            let impulse = contact.n * (missing / sum);
            translate(&mut x[*a as usize], impulse * w_a);
            translate(&mut x[*b as usize], impulse * -w_b);
            planes.project(*a as usize, &mut x[*a as usize]);
            planes.project(*b as usize, &mut x[*b as usize]);
            graph.mark_moved(*a);
            graph.mark_moved(*b);
        }
    }
}

/// Rolls back the particles of pending contacts that are not separated, and of the contacts that
/// this breaks, until all are separated.
///
/// A particle keeps a share of its motion relative to the rollback displacement ([`KEPT`]), or moves
/// with a fixed particle that is in the contact. `leaders` and `before` are scratch.
pub(crate) fn roll_back(
    contacts: &[Contact],
    motion: &mut SweptParticles,
    graph: &mut ContactGraph,
    leaders: &mut Vec<u32>,
    before: &mut Vec<Float4>,
) {
    let SweptParticles { start, now: x, rollback_displacement, .. } = motion;
    before.clone_from(x);
    leaders.clear();
    leaders.resize(x.len(), FREE);
    for (i, (leader, x)) in leaders.iter_mut().zip(x.iter()).enumerate() {
        *leader = if x[3] > 0.0 { FREE } else { i as u32 };
    }
    loop {
        graph.schedule_dirty(contacts);
        let mut next = 0;
        while let Some(i) = graph.pop_pending(next) {
            next = i;
            let contact = &contacts[i];
            if is_separated(contact, x, contact.tolerated_separation) {
                continue;
            }
            let of_contact = contact.ids.map(|id| leaders[id as usize]);
            let fixed = of_contact.into_iter().find(|leader| *leader < ROLLED_BACK);
            // Contacts are linear in the shares, so all corners of one keep the same share.
            let most = of_contact.into_iter().min().unwrap_or(FREE);
            let is_same = of_contact.into_iter().all(|leader| leader == most);
            let next = max(if is_same { most.saturating_sub(1) } else { most }, ROLLED_BACK);
            let leader = fixed.unwrap_or(next);
            for id in contact.ids {
                let i = id as usize;
                if leaders[i] <= leader || leaders[i] < ROLLED_BACK {
                    continue;
                }
                leaders[i] = leader;
                graph.mark_moved(id);
                let displacement = if leader >= ROLLED_BACK {
                    let own = xyz(&before[i]) - xyz(&start[i]) - *rollback_displacement;
                    *rollback_displacement + own * KEPT[(FREE - leader) as usize]
                } else {
                    xyz(&x[leader as usize]) - xyz(&start[leader as usize])
                };
                [x[i][0], x[i][1], x[i][2]] = (xyz(&start[i]) + displacement).to_array();
            }
        }
        if !graph.has_dirty() {
            return;
        }
    }
}
