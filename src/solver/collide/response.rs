//! Velocity pass of collider contacts: restitution, sliding, and the impulses on colliders.
//!
//! ```text
//! impact (approach faster than gravity alone explains):   vₙ⁺ = −e vₙ⁻
//! resting or sliding:                                     vₙ⁺ = 0
//! tangential, both:                                       vₜ⁺ = tangential_restitution · vₜ
//! ```
//! Newton's law of restitution along the normal n, relative to the surface. Coulomb friction has
//! already acted on positions. An impact resets the history of the second-order scheme (BDF2),
//! which must not look back across it; resting and sliding particles keep their history along the
//! surface.
//!
//! The impulse on the collider is what the particle will have gained, see [`final_velocity`]:
//!
//! ```text
//! impulse = m (v_final − v_final before the response + correction · velocity_per_correction)
//! velocity_per_correction = new_weight / (h (1 − extrapolation))
//! ```
//! Reads the contacts of the substep, positions, predicted positions and displacements; writes
//! velocities, history and `scratch.contacts.impulses`.
//! Invariant: positions stay as they are.

use crate::math::min;
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::world::World;
use crate::state::particles::Particles;
use glam::Vec3;

/// The parameters that all contacts of a substep share.
#[derive(Clone, Copy)]
struct ResponseParameters {
    /// The length of the substep [s].
    h: f32,
    /// The acceleration that a new history contains [m/s²].
    gravity: Vec3,
    /// The factor of a velocity change that is still to come, 1 / (1 − extrapolation); see
    /// [`final_velocity`].
    remaining: f32,
    /// Slower approaches are resting or sliding contacts [m/s].
    resting_speed: f32,
    /// The factor that damping applies to velocities and history in this substep.
    decay: f32,
    /// The final velocity that a particle got per metre of correction [1/s].
    velocity_per_correction: f32,
}

/// Resolves the velocities of all contacts, after the velocity update. `decay` is the factor that
/// damping applied to velocities in this substep.
pub(crate) fn resolve_velocities(world: &mut World, decay: f32) {
    let (scheme, gravity) = (world.scheme(), world.settings.gravity);
    let remaining = 1.0 / (1.0 - scheme.extrapolation);
    let parameters = ResponseParameters {
        h: scheme.h,
        // BDF1 extrapolates nothing.
        gravity: if scheme.extrapolation > 0.0 { gravity } else { Vec3::ZERO },
        remaining,
        resting_speed: 2.0 * scheme.h * gravity.length(),
        decay,
        velocity_per_correction: scheme.new_weight / scheme.h * remaining,
    };
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    for contact in &scratch.contacts.collider_contacts {
        let i = contact.particle as usize;
        let step = scratch.displacement.get(i) + (p.x.get(i) - scratch.predicted.get(i));
        let momentum = resolve_contact(p, contact, i, step, parameters);
        let impulse = &mut scratch.contacts.impulses[contact.body as usize];
        impulse.linear -= momentum;
        // About the world origin; `finish_tick` moves it to the position of the collider.
        impulse.angular -= p.x.get(i).cross(momentum);
    }
}

/// Returns the velocity that a particle with this velocity and extrapolated velocity reaches by its
/// history alone: each substep leaves it the fraction `extrapolation` of its last change of
/// velocity.
#[inline(always)]
fn final_velocity([v, v_extrapolated]: [Vec3; 2], remaining: f32) -> Vec3 {
    v + (v_extrapolated - v) * remaining
}

/// Resolves the velocity of one contact and returns the momentum that the particle got [kg m/s].
/// `step` is the displacement of the particle in this substep [m].
fn resolve_contact(
    p: &mut Particles,
    contact: &ColliderContact,
    i: usize,
    step: Vec3,
    parameters: ResponseParameters,
) -> Vec3 {
    let (n, surface, h) = (contact.normal, contact.surface_velocity, parameters.h);
    let tangential = |v: Vec3| (v - n * v.dot(n)) * contact.tangential_restitution;
    let step = step - surface * h;
    let approach = min((contact.approach_velocity - surface).dot(n), 0.0);
    let weighted = |old: Vec3, new: Vec3| {
        if contact.weight < 1.0 { old + (new - old) * contact.weight } else { new }
    };
    let before = [p.v.get(i), p.v_extrapolated.get(i)];
    let after = if -approach > parameters.resting_speed {
        let v = surface + tangential(step * (1.0 / h)) - n * (approach * contact.restitution);
        p.set_motion(i, p.x.get(i), weighted(before[0], v), parameters.gravity, h);
        [p.v.get(i), p.v_extrapolated.get(i)]
    } else {
        let after = before.map(|v| weighted(v, surface + tangential(v - surface)));
        p.v.set(i, after[0]);
        p.v_extrapolated.set(i, after[1]);
        let displacement = surface * h + tangential(step * parameters.decay);
        p.displacement.set(i, weighted(p.displacement.get(i), displacement));
        after
    };
    let change =
        final_velocity(after, parameters.remaining) - final_velocity(before, parameters.remaining);
    (change + contact.correction * parameters.velocity_per_correction) * p.mass[i]
}
