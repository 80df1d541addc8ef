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
//! Where solids overlap, r is 0: there is no room on the line between them, but beside it. The
//! particle is pushed out of each in turn, without friction, until it is in none of them
//! (alternating projections); it comes out along the crease between them.
//!
//! Reads contacts and shapes; writes positions, `contacts.room`, and of contacts the corrections and
//! distances.
//! Invariant: only particles move that two colliders push towards each other.

use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::polyhedron::CandidateFaces;
use crate::geometry::signed_distance::SignedDistance;
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

/// The depth up to which a particle in a crease counts as outside [m].
const CREASE_TOLERANCE: f32 = 1.0e-5;

/// The least sum of gaps that is divided by [m].
const MIN_GAPS: f32 = 1.0e-12;

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

/// Pushes particles that two colliders leave no room out of a shape, and returns whether it moved
/// one. Shapes that are no convex solids are left out.
#[inline(never)]
pub(super) fn push_along_creases(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    candidates: &Candidates<'_>,
    count: usize,
) -> bool {
    let mut has_moved = false;
    for at in 0..count {
        let contact = &particles.contacts[at];
        let i = contact.particle as usize;
        if contact.body != particles.body || !particles.contact_scales.has_no_room(i) {
            continue;
        }
        let end = particles.end_position(i);
        let (distance, normal) = match shape {
            CollisionShape::ConvexHull(_, _) if candidates.faces(i).is_empty() => continue,
            CollisionShape::ConvexHull(body, _) => {
                CandidateFaces { body, faces: candidates.faces(i) }.signed_distance(end)
            }
            _ => match shape.solid() {
                Some(solid) => solid.signed_distance(end),
                None => return false,
            },
        };
        if distance < -CREASE_TOLERANCE {
            let push = particles.frames[1].vector_to_world(normal * -distance);
            particles.x.add(i, push);
            particles.contacts[at].correction += push;
            has_moved = true;
        }
    }
    has_moved
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

/// Moves particles that two colliders push towards each other to where both leave them room, and
/// returns whether any has none.
pub(super) fn separate(x: &mut Columns, contacts: &mut ContactScratch) -> bool {
    let mut has_none = false;
    for at in 0..contacts.collider_contacts.len() {
        let Some((last, normal, k)) = opposed(contacts, at) else { continue };
        let [own, other] = [at, last].map(|at| &contacts.collider_contacts[at]);
        // The gaps are 0 where there was no room before.
        let gaps = max(k * own.gap + other.gap, MIN_GAPS);
        let share = max(k * own.distance + other.distance, 0.0) / gaps;
        if share < ENOUGH {
            let (i, step) = (own.particle as usize, share * own.gap - own.distance);
            x.add(i, normal * step);
            contacts.collider_contacts[at].correction += normal * step;
            contacts.collider_contacts[last].distance -= k * step;
            contacts.room.narrow(i, share);
            has_none |= share == 0.0;
        }
    }
    has_none
}
