//! Particles between two colliders: both keep less than their gap where there is not room for both.
//!
//! ```text
//!  A ▓▓│←── dA ──→●←── dB ──→│▓▓ B       k = -nA·nB, gA, gB: the gaps
//!
//! a step s along nA brings the distances to dA + s and dB - k s, so both are r times their gaps for
//!
//!     r = (k dA + dB) / (k gA + gB)       s = r gA - dA
//! ```
//! The collider that pushes last would otherwise take all of its gap and push the particle into the
//! other one. For r < 1 the particle keeps r times all gaps until the tick ends: pushes to and fro
//! would grip it by their friction, and triangles at it would be pushed like it.
//!
//! Reads contacts and shapes; writes positions, `contacts.room`, and of contacts the corrections and
//! distances.
//! Invariant: only particles move that two colliders push towards each other.

use crate::geometry::collision_shape::CollisionShape;
use crate::math::columns::Columns;
use crate::math::max;
use crate::solver::collide::contact_scratch::ContactScratch;
use crate::solver::collide::local_particles::LocalParticles;
use crate::solver::collide::mid_phase::Candidates;
use crate::solver::collide::particle_vs_shape::{signed_distance, solve_particle};
use glam::Vec3;

/// The fraction of the gaps from which there is room enough; the rest covers rounding.
const ENOUGH: f32 = 0.999;

/// The distance of a contact that [`visit`] will measure [m].
const UNKNOWN: f32 = f32::INFINITY;

/// Visits the first `count` contacts. If `is_again`, pushes particles out of a shape that another
/// collider pushed into it; otherwise measures the unknown distances from it.
#[inline(never)]
pub(super) fn visit(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    candidates: &Candidates<'_>,
    count: usize,
    is_again: bool,
) {
    for at in 0..count {
        let contact = &particles.contacts[at];
        let (i, is_own) = (contact.particle as usize, contact.body == particles.body);
        if is_own == is_again || !is_again && contact.distance != UNKNOWN {
            continue;
        }
        let path = [particles.start_position(i), particles.end_position(i)];
        // Farther away it only matters that there is room.
        let most = if is_again { 0.0 } else { 4.0 * contact.gap };
        let distance = signed_distance(shape, candidates.faces(i), path, most);
        if !is_again {
            particles.contacts[at].distance = distance;
        } else if distance < 0.0 {
            solve_particle(shape, particles, candidates, i);
        }
    }
}

/// Returns the last contact of the same particle, the normal of this one, and -1 times the cosine of
/// their angle, if another collider pushes the particle towards this one.
fn opposed(contacts: &ContactScratch, at: usize) -> Option<(usize, Vec3, f32)> {
    let own = &contacts.collider_contacts[at];
    let last = contacts.contact_slots[own.particle as usize] as usize;
    // The slot of a contact from before the last phase may have been reused.
    let other = contacts.collider_contacts.get(last).filter(|one| one.particle == own.particle)?;
    let k = -own.normal.dot(other.normal);
    (last != at && k > 0.0).then_some((last, own.normal, k))
}

/// Marks the contacts of particles that two colliders push towards each other, and returns whether
/// there are any.
pub(super) fn select(contacts: &mut ContactScratch) -> bool {
    let mut are_any = false;
    for at in 0..contacts.collider_contacts.len() {
        if let Some((last, ..)) = opposed(contacts, at) {
            contacts.collider_contacts[at].distance = UNKNOWN;
            contacts.collider_contacts[last].distance = UNKNOWN;
            are_any = true;
        }
    }
    are_any
}

/// Moves particles that two colliders push towards each other to where both leave them room.
pub(super) fn separate(x: &mut Columns, contacts: &mut ContactScratch) {
    for at in 0..contacts.collider_contacts.len() {
        let Some((last, normal, k)) = opposed(contacts, at) else { continue };
        let [own, other] = [at, last].map(|at| &contacts.collider_contacts[at]);
        let share = max(k * own.distance + other.distance, 0.0) / (k * own.gap + other.gap);
        if share < ENOUGH {
            let (i, step) = (own.particle as usize, share * own.gap - own.distance);
            x.add(i, normal * step);
            contacts.collider_contacts[at].correction += normal * step;
            contacts.collider_contacts[last].distance -= k * step;
            contacts.room.narrow(i, share);
        }
    }
}
