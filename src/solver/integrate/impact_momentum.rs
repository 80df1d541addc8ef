//! Momentum of a free cloth that hits colliders: what a substep changes is what acceleration and the
//! impulses on colliders explain.
//!
//! ```text
//! P' = decay Σ m (v + h a) + J
//! S' = decay Σ m r × (v + h a) + N          r = x − c, c: centre of mass
//! ```
//! P': linear momentum; S': angular momentum about c; J and N: impulse and angular impulse, about c,
//! that arrived from colliders in this substep (see `collide::response`). The solvers break this a
//! little: at an impact links that have not converged move far, velocities are extrapolated along
//! straight lines, and the non-crossing pass rolls particles back. So the rigid motion with the
//! momenta of the error is subtracted from the velocities. Positions stay, because contacts hold
//! there.
//!
//! Position corrections move c without a velocity. That changes the angular momentum about a fixed
//! point by Δc × P, which the reported angular impulses count.
//!
//! `momentum` does nearly the same for the corrections of cloth that touches nothing. Cloth that
//! rests or slides is left alone: its errors are as small as those of rounding.
//!
//! Reads positions, masses, acceleration, contacts and the impulses that arrived; writes velocities
//! and history, and the scratch lists `relative_wind` and `correction`, which are free at that time.
//! Invariant: cloth that something holds, or in several pieces, stays as it is.

use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::integrate::expected_momentum::ExpectedMomentum;
use crate::solver::integrate::momentum::{combine, has_collider_impulse};
use crate::solver::integrate::momentum_sums::{FreeParticles, LinearSums, spin_and_inertia};
use crate::solver::integrate::rigid_motion::RigidMotion;
use crate::solver::world::World;
use glam::Vec3;

/// The least impulse of an impact, in units of the weight of the cloth times the length of the substep
/// or tick. Cloth that gets less rests: friction takes up the small errors of its solvers, and
/// removing them would keep it moving.
pub(super) const IMPACT: f32 = 4.0;

/// Before velocities are updated: stores the momentum that gravity and air give to the cloth, if it
/// is free and hits a collider. `decay`: the factor of velocities by damping.
pub(crate) fn begin(world: &mut World, decay: f32) {
    world.scratch.expected_momentum = None;
    if !may_lose_momentum(world)
        || world.pieces != 1
        || !world.anchors.is_empty()
        || world.is_held()
    {
        return;
    }
    let h = world.regular_scheme().h;
    let (p, scratch) = (&world.particles, &mut world.scratch);
    scratch.correction.resize(p.len());
    let path = [&scratch.predicted, &scratch.displacement, &scratch.predicted];
    combine(&mut scratch.relative_wind, path, [-1.0, 0.0]);
    combine(&mut scratch.correction, [&p.v, &scratch.acceleration, &p.v], [h, 0.0]);
    let free = FreeParticles {
        x: scratch.relative_wind.slices(),
        displacement: scratch.correction.slices(),
        mass: &p.mass,
        w: &p.w,
    };
    let LinearSums { mass, center, momentum } = LinearSums::of(world.level, free);
    if mass <= 0.0 {
        return;
    }
    let [center, velocity] = [center, momentum].map(|sum| sum * (1.0 / mass));
    let (spin, _) = spin_and_inertia(world.level, free, [center, velocity]);
    scratch.expected_momentum = Some(ExpectedMomentum {
        mass,
        center,
        linear: momentum * decay,
        spin: spin * decay,
        mean_momentum: momentum - world.settings.gravity * (mass * h * 0.5),
    });
}

/// At the end of a substep: gives the cloth the momentum that [`begin`] stored, plus the impulses
/// that arrived.
pub(crate) fn restore(world: &mut World) {
    let Some(expected) = world.scratch.expected_momentum.take() else {
        return;
    };
    let h = world.regular_scheme().h;
    let arrived = world.scratch.contacts.arrived;
    let resting_impulse = expected.mass * world.settings.gravity.length() * h;
    if rests(world) && arrived.linear.length() <= IMPACT * resting_impulse {
        return;
    }
    let p = &mut world.particles;
    let free =
        FreeParticles { x: p.x.slices(), displacement: p.v.slices(), mass: &p.mass, w: &p.w };
    let LinearSums { center, momentum, .. } = LinearSums::of(world.level, free);
    let inverse_mass = 1.0 / expected.mass;
    let (center, velocity) = (center * inverse_mass, momentum * inverse_mass);
    let (spin, inertia) = spin_and_inertia(world.level, free, [center, velocity]);
    let moved = center - expected.center;
    let linear = expected.linear + arrived.linear - momentum;
    let torque = arrived.angular - center.cross(arrived.linear);
    let motion = RigidMotion::with_momentum(
        center,
        linear * inverse_mass,
        expected.spin + torque - spin,
        inertia,
    );
    for i in 0..p.len() {
        p.add_velocity(i, motion.displacement_at(p.x.get(i)), h);
    }
    world.scratch.contacts.add_torque(moved.cross(expected.mean_momentum));
}

/// Whether the cloth touches colliders, none of which moves, and does not move fast.
#[inline(never)]
pub(super) fn rests(world: &World) -> bool {
    let contacts = &world.scratch.contacts.collider_contacts;
    if world.substeps > world.settings.substeps || contacts.is_empty() {
        return false;
    }
    world.colliders.iter().all(|body| body.last == body.next)
        || contacts.iter().all(|contact| contact.surface_velocity == Vec3::ZERO)
}

/// Whether this substep may break the momentum by more than `momentum` corrects: the cloth hits a
/// collider, moves with one, has just left one, or its layers touch in flight.
fn may_lose_momentum(world: &World) -> bool {
    let contacts = &world.scratch.contacts.collider_contacts;
    if contacts.is_empty() {
        let touches_itself =
            world.scratch.surface_collision.as_ref().is_some_and(|s| s.has_contacts());
        return touches_itself || has_collider_impulse(world);
    }
    let resting_speed = 2.0 * world.regular_scheme().h * world.settings.gravity.length();
    let is_fast = |contact: &ColliderContact| {
        let approach = contact.approach_velocity - contact.surface_velocity;
        -approach.dot(contact.normal) > resting_speed
    };
    !rests(world) || contacts.iter().any(is_fast)
}
