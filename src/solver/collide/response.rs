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
//! The impulse on the collider is what the velocities of the cloth took up in the substep. The
//! second-order scheme spreads the velocity of a correction over the next substeps, with weights that
//! fall by `extrapolation` = e, so the rest of it is pending:
//!
//! ```text
//! now     = m (correction · new_weight / h + Δv)               Δ: by the response
//! later   = m (e correction · new_weight / h + Δ(v_extrapolated − v)) / (1 − e)
//! impulse = now + (1 − e) pending                              pending ← e · pending + later
//! ```
//! Reads the contacts of the substep, positions, predicted positions and displacements; writes
//! velocities, history and `scratch.contacts.impulses`.
//! Invariant: positions stay as they are.

use crate::math::min;
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::world::World;
use crate::state::colliders::Impulse;
use crate::state::particles::Particles;
use glam::Vec3;

/// The parameters that all contacts of a substep share.
#[derive(Clone, Copy)]
struct ResponseParameters {
    /// The length of the substep [s].
    h: f32,
    /// The acceleration that a new history contains [m/s²].
    gravity: Vec3,
    /// 1 / (1 − extrapolation): each substep leaves a particle the fraction `extrapolation` of its last
    /// change of velocity, so by its history alone it reaches v + remaining (v_extrapolated − v).
    remaining: f32,
    /// Slower approaches are resting or sliding contacts [m/s].
    resting_speed: f32,
    /// The factor that damping applies to velocities and history in this substep.
    decay: f32,
    /// The velocity that a particle got at once per metre of correction [1/s].
    velocity_per_correction: f32,
}

/// What colliders give to the cloth in a substep, about the world origin: at once, and in later
/// substeps.
#[derive(Clone, Copy, Default)]
struct Gained {
    now: Impulse,
    later: Impulse,
}

impl Gained {
    /// Adds momentum that a particle at `x` gets at once and later.
    fn add_at(&mut self, x: Vec3, [now, later]: [Vec3; 2]) {
        self.now.add_at(x, now);
        self.later.add_at(x, later);
    }
}

/// Resolves the velocities of all contacts, after the velocity update. `decay` is the factor that
/// damping applied to velocities in this substep.
pub(crate) fn resolve_velocities(world: &mut World, decay: f32) {
    let (scheme, gravity) = (world.scheme(), world.settings.gravity);
    let parameters = ResponseParameters {
        h: scheme.h,
        // BDF1 extrapolates nothing.
        gravity: if scheme.extrapolation > 0.0 { gravity } else { Vec3::ZERO },
        remaining: 1.0 / (1.0 - scheme.extrapolation),
        resting_speed: 2.0 * scheme.h * gravity.length(),
        decay,
        velocity_per_correction: scheme.new_weight / scheme.h * world.correction_share() * decay,
    };
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let contacts = &mut scratch.contacts;
    contacts.arrived = Impulse::default();
    let mut strongest = 0.0;
    let mut all = contacts.collider_contacts.iter().peekable();
    let bodies = world.colliders.iter_mut().zip(&mut contacts.impulses).enumerate();
    for (at, (body, impulse)) in bodies {
        let pushed = contacts.late_pushes[at];
        if pushed == Impulse::default()
            && body.pending == Impulse::default()
            && all.peek().is_none_or(|contact| contact.body as usize != at)
        {
            continue;
        }
        let mut gained = Gained::default();
        gained.now.add_scaled(pushed, parameters.velocity_per_correction);
        gained.later.add_scaled(gained.now, parameters.remaining - 1.0);
        while let Some(contact) = all.next_if(|contact| contact.body as usize == at) {
            let i = contact.particle as usize;
            let step = scratch.displacement.get(i) + (p.x.get(i) - scratch.predicted.get(i));
            let momentum = resolve_contact(p, contact, i, step, parameters);
            gained.add_at(p.x.get(i), momentum);
        }
        let position = body.position();
        let mut arrived = gained.now;
        arrived.add_scaled(body.pending.about(-position), decay * (scheme.extrapolation - 1.0));
        impulse.add_scaled(arrived, -1.0);
        contacts.arrived.add_scaled(arrived, 1.0);
        let strength = arrived.linear.length_squared();
        if strength > strongest {
            (strongest, contacts.first_pusher) = (strength, at);
        }
        let mut pending = Impulse::default();
        pending.add_scaled(body.pending, decay * scheme.extrapolation);
        pending.add_scaled(gained.later.about(position), -1.0);
        body.pending = pending;
    }
}

/// Resolves the velocity of one contact and returns the momentum that the particle got [kg m/s], at
/// once and later.
/// `step` is the displacement of the particle in this substep [m].
fn resolve_contact(
    p: &mut Particles,
    contact: &ColliderContact,
    i: usize,
    step: Vec3,
    parameters: ResponseParameters,
) -> [Vec3; 2] {
    let (n, surface, h) = (contact.normal, contact.surface_velocity, parameters.h);
    let tangential = |v: Vec3| (v - n * v.dot(n)) * contact.tangential_restitution;
    let step = step - surface * h;
    let approach = min((contact.approach_velocity - surface).dot(n), 0.0);
    let weighted = |old: Vec3, new: Vec3| {
        if contact.weight < 1.0 { old + (new - old) * contact.weight } else { new }
    };
    let (v, v_extrapolated) = (p.v.get(i), p.v_extrapolated.get(i));
    if -approach > parameters.resting_speed {
        let new = surface + tangential(step * (1.0 / h)) - n * (approach * contact.restitution);
        p.set_motion(i, p.x.get(i), weighted(v, new), parameters.gravity, h);
    } else {
        p.v.set(i, weighted(v, surface + tangential(v - surface)));
        let new = surface + tangential(v_extrapolated - surface);
        p.v_extrapolated.set(i, weighted(v_extrapolated, new));
        let displacement = surface * h + tangential(step * parameters.decay);
        p.displacement.set(i, weighted(p.displacement.get(i), displacement));
    }
    let of_correction = contact.correction * parameters.velocity_per_correction;
    let (v, v_extrapolated) = (p.v.get(i) - v, p.v_extrapolated.get(i) - v_extrapolated);
    let later =
        of_correction * (parameters.remaining - 1.0) + (v_extrapolated - v) * parameters.remaining;
    [(v + of_correction) * p.mass[i], later * p.mass[i]]
}
