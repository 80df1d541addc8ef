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
//! Where solids overlap, r is 0: there is no room on the line between them, but beside it, in the
//! crease between them. With both surfaces as planes, c = nA·nB, the step that ends on both is
//!
//! ```text
//! a nA + b nB      a = (c dB - dA) / (1 - c²)      b = (c dA - dB) / (1 - c²)
//! ```
//! and a particle that is outside of one already only leaves the other (Newton's method). Along the
//! line between two centres c is nearly -1, and the crease is far away compared to the depth: so
//! steps begin short and grow.
//!
//! Reads contacts and shapes; writes positions, `contacts.room`, and of contacts the corrections and
//! distances.
//! Invariant: only particles move that two colliders push towards each other.

use crate::geometry::collision_shape::CollisionShape;
use crate::math::columns::Columns;
use crate::math::{max, min};
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::collide::contact_scratch::ContactScratch;
use crate::solver::collide::local_particles::LocalParticles;
use crate::solver::collide::mid_phase::Candidates;
use crate::solver::collide::particle_vs_shape::{signed_distance, solve_particle};
use glam::Vec3;

/// The fraction of the gaps from which there is room enough; the rest covers rounding.
const ENOUGH: f32 = 0.999;

/// The distance of a contact that [`measure`] will measure [m].
const UNKNOWN: f32 = f32::INFINITY;

/// The depth up to which a particle in a crease counts as outside [m].
const CREASE_TOLERANCE: f32 = 1.0e-5;

/// A particle that is deeper than this after all steps goes back [m].
const REMAINING_DEPTH: f32 = 5.0e-5;

/// The least squared sine of the angle between two normals that is divided by.
const MIN_SINE2: f32 = 1.0e-10;

/// The least sum of gaps that is divided by [m].
const MIN_GAPS: f32 = 1.0e-12;

/// Pushes the particles of the first `count` contacts out of a shape if another collider pushed
/// them into it. Returns the largest depth [m].
#[inline(never)]
pub(super) fn push_again(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    candidates: &Candidates<'_>,
    count: usize,
) -> f32 {
    let mut deepest = 0.0;
    for at in 0..count {
        let contact = &particles.contacts[at];
        let i = contact.particle as usize;
        if contact.body == particles.body {
            continue;
        }
        let path = [particles.start_position(i), particles.end_position(i)];
        let (distance, _) = signed_distance(shape, candidates.faces(i), path, 0.0);
        if distance < 0.0 {
            solve_particle(shape, particles, candidates, i);
            deepest = max(-distance, deepest);
        }
    }
    deepest
}

/// Measures the first `count` contacts of particles between two colliders: the distances that are
/// unknown, or in a crease, distances and normals. At shapes that are no convex solids, particles in a
/// crease count as outside.
#[inline(never)]
pub(super) fn measure(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    candidates: &Candidates<'_>,
    count: usize,
    is_in_crease: bool,
) {
    for at in 0..count {
        let contact = &particles.contacts[at];
        let (i, is_own) = (contact.particle as usize, contact.body == particles.body);
        let is_wanted = if is_in_crease {
            particles.contact_scales.has_less_room(i)
        } else {
            contact.distance == UNKNOWN
        };
        if !(is_own && is_wanted) {
            continue;
        }
        let path = [particles.start_position(i), particles.end_position(i)];
        // Farther away it only matters that there is room.
        let most = 4.0 * contact.gap;
        let (distance, normal) = signed_distance(shape, candidates.faces(i), path, most);
        let contact = &mut particles.contacts[at];
        contact.distance = distance;
        if is_in_crease {
            match normal {
                Some(normal) => contact.normal = particles.frames[1].vector_to_world(normal),
                None => contact.distance = UNKNOWN,
            }
        }
    }
}

/// Moves particles in creases by a step towards where they are outside of both solids, of at most
/// `reach` times their depth, and `longest_way` [m] in all. Returns whether it moved any. With a reach
/// of 0, those that are still inside go back: there is no crease nearby.
pub(super) fn leave_creases(
    x: &mut Columns,
    contacts: &mut ContactScratch,
    reach: f32,
    longest_way: f32,
) -> bool {
    let Some(room) = contacts.room.shares() else { return false };
    let (list, mut has_moved) = (&mut contacts.collider_contacts, false);
    for at in 0..list.len() {
        let i = list[at].particle as usize;
        let last = ColliderContact::last_of(list, i, contacts.contact_slots[i]);
        let Some(last) = last.filter(|last| room[i] < 1.0 && *last != at) else { continue };
        let distances = [at, last].map(|at| list[at].distance);
        let depth = -min(distances[0], distances[1]);
        if depth <= CREASE_TOLERANCE {
            continue;
        }
        let way = list[at].way_in_crease + list[last].way_in_crease;
        if reach > 0.0 && way.length_squared() > longest_way * longest_way {
            continue;
        }
        if reach == 0.0 && depth > REMAINING_DEPTH {
            for at in [at, last] {
                let way = core::mem::take(&mut list[at].way_in_crease);
                x.add(i, -way);
                list[at].correction -= way;
            }
        }
        if reach == 0.0 {
            continue;
        }
        let normals = [at, last].map(|at| list[at].normal);
        let lengths = lengths_out(distances, normals[0].dot(normals[1]));
        let mut pushes = [0, 1].map(|k| normals[k] * lengths[k]);
        let (wanted, most) = ((pushes[0] + pushes[1]).length(), depth * reach);
        if wanted < depth * 0.5 {
            // On the line between two centres all directions are equal.
            pushes = [normals[0].any_orthonormal_vector() * most, Vec3::ZERO];
        } else if wanted > most {
            pushes = pushes.map(|push| push * (most / wanted));
        }
        for (at, push) in [at, last].into_iter().zip(pushes) {
            x.add(i, push);
            list[at].correction += push;
            list[at].way_in_crease += push;
        }
        has_moved = true;
    }
    has_moved
}

/// Returns how far a point moves along two normals to get out of two half spaces on the shortest way.
/// `distances` [m] are its signed distances, and `cosine` is that of the angle between the normals.
fn lengths_out([a, b]: [f32; 2], cosine: f32) -> [f32; 2] {
    let sine2 = max(1.0 - cosine * cosine, MIN_SINE2);
    if b - cosine * a >= 0.0 {
        [max(-a, 0.0), 0.0]
    } else if a - cosine * b >= 0.0 {
        [0.0, max(-b, 0.0)]
    } else {
        [(cosine * b - a) / sine2, (cosine * a - b) / sine2]
    }
}

/// Returns the last contact of the same particle, the normal of this one, and -1 times the cosine of
/// their angle, if another collider pushes the particle towards this one.
fn opposed(contacts: &ContactScratch, at: usize) -> Option<(usize, Vec3, f32)> {
    let own = &contacts.collider_contacts[at];
    let i = own.particle as usize;
    let last = ColliderContact::last_of(&contacts.collider_contacts, i, contacts.contact_slots[i])?;
    let k = -own.normal.dot(contacts.collider_contacts[last].normal);
    (last != at && k > 0.0).then_some((last, own.normal, k))
}

/// Marks the contacts of particles that two colliders push towards each other, and returns whether
/// there are any.
pub(super) fn select(contacts: &mut ContactScratch) -> bool {
    let mut are_any = false;
    for at in 0..contacts.collider_contacts.len() {
        if let Some((last, ..)) = opposed(contacts, at) {
            for at in [at, last] {
                contacts.collider_contacts[at].distance = UNKNOWN;
                contacts.collider_contacts[at].way_in_crease = Vec3::ZERO;
            }
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
        let share = min(max(k * own.distance + other.distance, 0.0) / gaps, 1.0);
        // Pushes to and fro may have left it in one of them where there is room enough.
        let is_inside = min(own.distance, other.distance) < -CREASE_TOLERANCE;
        if share < ENOUGH || is_inside {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_way_out_of_two_half_spaces_ends_outside_both() {
        for degrees in [10.0_f32, 60.0, 90.0, 120.0, 170.0] {
            let cosine = degrees.to_radians().cos();
            for distances in [[-1.0, -1.0], [-1.0, -0.1], [-0.3, 0.2], [0.1, -2.0]] {
                let [a, b] = lengths_out(distances, cosine);
                let ends = [distances[0] + a + cosine * b, distances[1] + b + cosine * a];
                assert!(a >= 0.0 && b >= 0.0, "{degrees}: {a}, {b}");
                assert!(min(ends[0], ends[1]) > -1.0e-5, "{degrees}: {distances:?} to {ends:?}");
            }
        }
    }
}
