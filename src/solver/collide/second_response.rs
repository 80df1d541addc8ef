//! Second response of colliders to surface collision, which moves particles that touch them.
//!
//! ```text
//! normal      λ ← λ + max(height − n·x, 0)             height: n·x after the first response
//! friction    t ← t − slip, no longer than friction · λ
//! ```
//! Method: projected Gauss–Seidel. λ n + t is the correction of a contact so far, slip its motion
//! along the surface since the start of the substep. The normal part runs before each sweep of the
//! contact solver, so that the lowest layer of a heap carries the others ([`ColliderContact::hold`]);
//! both parts run once after it. So contacts between layers keep their momentum, and what supports a
//! heap is what colliders count as impulse. Without the second friction, which knows where layers
//! pushed each other, crumpled cloth would turn and walk on a floor for ever.
//!
//! Reads predicted positions, displacements and contacts; writes positions and the corrections of
//! contacts.
//! Invariant: a contact pushes no less than before.

use crate::math::max;
use crate::math::wide4::{Float4, xyz};
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::particle_stage::interleaved::translate;
use crate::solver::world::World;

/// Keeps the places of particles that touch colliders, to which [`apply`] brings them back.
pub(crate) fn store_heights(world: &mut World) {
    let x = &world.particles.x;
    for contact in &mut world.scratch.contacts.collider_contacts {
        contact.height = contact.normal.dot(x.get(contact.particle as usize));
    }
}

/// Pushes particles that touch colliders back to their places along the normal, and renews friction.
/// Points of triangles are left to the projections that follow.
pub(crate) fn apply(world: &mut World) {
    let h = world.regular_scheme().h;
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    for contact in &mut scratch.contacts.collider_contacts {
        if contact.weight < 1.0 {
            continue;
        }
        let (i, n) = (contact.particle as usize, contact.normal);
        let depth = contact.correction.dot(n);
        let tangent = contact.correction - n * depth;
        let pushed = max(contact.height - n.dot(p.x.get(i)), 0.0);
        let step = scratch.displacement.get(i) + (p.x.get(i) - scratch.predicted.get(i));
        let step = step - contact.surface_velocity * h;
        let wanted = tangent - (step - n * step.dot(n));
        let (length, most) = (wanted.length(), contact.friction * max(depth + pushed, 0.0));
        let tangent_now = if length <= most { wanted } else { wanted * (most / length) };
        let change = n * pushed + (tangent_now - tangent);
        p.x.add(i, change);
        contact.correction += change;
    }
}

impl ColliderContact {
    /// Pushes the particle back to its place along the normal, if surface collision pushed it
    /// lower.
    #[inline(always)]
    pub fn hold(&mut self, x: &mut [Float4]) {
        let x = &mut x[self.particle as usize];
        let missing = self.height - self.normal.dot(xyz(x));
        if missing > 0.0 && self.weight == 1.0 {
            let push = self.normal * missing;
            translate(x, push);
            self.correction += push;
            self.pushed += missing;
        }
    }
}
