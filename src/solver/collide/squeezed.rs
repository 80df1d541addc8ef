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
//! Reads contacts, colliders and their frames; writes positions, the corrections of contacts and
//! `contacts.room`.
//! Invariant: only particles move that two colliders push towards each other.

use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::transform::Transform;
use crate::math::max;
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::collide::local_particles::LocalParticles;
use crate::solver::collide::mid_phase::Candidates;
use crate::solver::collide::particle_vs_shape;
use crate::solver::world::World;
use crate::state::colliders::ColliderBody;

/// The fraction of the gaps from which there is room enough; the rest covers rounding.
const ENOUGH: f32 = 0.999;

/// Pushes the particles of the first `count` contacts out of a shape if another collider pushed them
/// into it.
pub(super) fn push_out_again(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    candidates: &Candidates<'_>,
    count: usize,
) {
    for at in 0..count {
        let contact = &particles.contacts[at];
        let i = contact.particle as usize;
        let path = [particles.start_position(i), particles.end_position(i)];
        if contact.body != particles.body
            && particle_vs_shape::signed_distance(shape, candidates.faces(i), path, 0.0) < 0.0
        {
            particle_vs_shape::solve_particle(shape, particles, candidates, i);
        }
    }
}

/// Moves particles that two colliders push towards each other to where both leave them room.
/// `frames` gives the frames of a collider at the start and at the end.
#[inline(never)]
pub(super) fn separate(world: &mut World, frames: &dyn Fn(&ColliderBody) -> [Transform; 2]) {
    let (x, colliders) = (&mut world.particles.x, &world.colliders);
    let (predicted, displacement) = (&world.scratch.predicted, &world.scratch.displacement);
    let contacts = &mut world.scratch.contacts;
    let (all, slots) = (&mut contacts.collider_contacts, &contacts.contact_slots);
    let nearby = &contacts.nearby;
    for at in 0..all.len() {
        let i = all[at].particle as usize;
        let last = slots[i] as usize;
        let k = -all[at].normal.dot(all[last].normal);
        if last == at || k <= 0.0 {
            continue;
        }
        let (own, other) = (&all[at], &all[last]);
        let distance = |contact: &ColliderContact| {
            let body = colliders.iter().nth(contact.body as usize)?;
            let faces = nearby.of_collider(contact.body as usize).candidates.faces(i);
            let [from, to] = frames(body);
            let start = predicted.get(i) - displacement.get(i);
            let path = [from.point_to_local(start), to.point_to_local(x.get(i))];
            let most = 2.0 * (own.gap + other.gap);
            Some(particle_vs_shape::signed_distance(body.collision_shape()?, faces, path, most))
        };
        let (Some(to_own), Some(to_other)) = (distance(own), distance(other)) else { continue };
        let share = max(k * to_own + to_other, 0.0) / (k * own.gap + other.gap);
        if share < ENOUGH {
            let push = own.normal * (share * own.gap - to_own);
            x.add(i, push);
            all[at].correction += push;
            contacts.room.narrow(i, share);
        }
    }
}
