//! Momentum of a free cloth that hits colliders: what a substep changes is what acceleration and the
//! impulses on colliders explain.
//!
//! ```text
//! P' = decay (P + h Σ m a) + J
//! S' = decay (S + h Σ m r × a) + N          r = x − c, c: centre of mass
//! ```
//! P: linear momentum; S: angular momentum about c; J and N: what arrived from colliders in this
//! substep, N about c (see `collide::response`). The solvers of the substep break this by a little: at an impact the links
//! of an unconverged cloth move far, velocities are extrapolated along straight lines, and the
//! non-crossing pass rolls particles back. So the rigid motion with the momenta of the error is
//! subtracted from the velocities. Positions stay, where contacts hold.
//!
//! Colliders push c off the path that P and the acceleration explain, which changes the angular
//! momentum about a fixed point by Δc × P. The reported angular impulses count it.
//!
//! `momentum` does nearly the same for the corrections of cloth that touches nothing. Cloth that
//! rests or slides is left alone: its errors are as small as those of rounding.
//!
//! Reads positions, masses, acceleration, contacts and the impulses that arrived; writes velocities
//! and history.
//! Invariant: cloth that something holds, or in several pieces, stays as it is.

use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::integrate::expected_momentum::ExpectedMomentum;
use crate::solver::integrate::momentum::has_collider_impulse;
use crate::solver::integrate::momentum_sums::{
    FreeParticles, LinearSums, spin_and_inertia, total_mass,
};
use crate::solver::integrate::rigid_motion::RigidMotion;
use crate::solver::world::World;
use glam::Vec3;

/// Impulse of a substep from which on cloth that touches a collider hits it, in units of its weight
/// times the length of the substep. Below that the cloth rests: the rounding of its solvers, which
/// friction takes up, would push it around.
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
    let (level, scratch) = (world.level, &mut world.scratch);
    let starts = scratch.relative_wind.slices_mut();
    let from = scratch.predicted.slices().into_iter().zip(scratch.displacement.slices());
    for (start, (predicted, displacement)) in starts.into_iter().zip(from) {
        for ((start, predicted), displacement) in start.iter_mut().zip(predicted).zip(displacement)
        {
            *start = predicted - displacement;
        }
    }
    let p = &world.particles;
    let (x, v, a) = (scratch.relative_wind.slices(), p.v.slices(), scratch.acceleration.slices());
    let free = |displacement| FreeParticles { x, displacement, mass: &p.mass[..], w: &p.w[..] };
    let LinearSums { mass, center, momentum } = LinearSums::of(level, free(v));
    if mass <= 0.0 {
        return;
    }
    let pull = LinearSums::of(level, free(a)).momentum;
    let inverse_mass = 1.0 / mass;
    let center = center * inverse_mass;
    let spin =
        |vectors, sum: Vec3| spin_and_inertia(level, free(vectors), [center, sum * inverse_mass]).0;
    let (spin_at_start, torque) = (spin(v, momentum), spin(a, pull));
    scratch.expected_momentum = Some(ExpectedMomentum {
        mass,
        center,
        linear: (momentum + pull * h) * decay,
        spin: (spin_at_start + torque * h) * decay,
        mean_momentum: (momentum + pull * (h * 0.5)) * decay,
    });
}

/// At the end of a substep: gives the cloth the momentum that [`begin`] stored and the impulses that
/// arrived since.
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
        let change = motion.displacement_at(p.x.get(i));
        p.v.add(i, change);
        p.v_extrapolated.add(i, change);
        p.displacement.add(i, change * h);
    }
    world.scratch.contacts.add_torque(moved.cross(expected.mean_momentum));
}

/// Whether the cloth touches colliders, none of which moves, and does not move fast.
fn rests(world: &World) -> bool {
    let contacts = &world.scratch.contacts.collider_contacts;
    world.substeps <= world.settings.substeps
        && !contacts.is_empty()
        && contacts.iter().all(|contact| contact.surface_velocity == Vec3::ZERO)
}

/// Whether this substep may break the momentum by more than rounding and the correction of
/// `momentum`: the cloth hits a collider, leaves one at high speed, an impact of an earlier substep
/// still arrives, or its layers touch in flight. Cloth that rests or slides does none of this.
fn may_lose_momentum(world: &World) -> bool {
    let contacts = &world.scratch.contacts.collider_contacts;
    if contacts.is_empty() {
        let touches_itself = world.surface_collision.as_ref().is_some_and(|s| s.has_contacts());
        return touches_itself || has_collider_impulse(world);
    }
    let gravity = world.settings.gravity.length();
    let h = world.regular_scheme().h;
    let resting_speed = 2.0 * h * gravity;
    let is_fast = |contact: &ColliderContact| {
        let approach = contact.approach_velocity - contact.surface_velocity;
        -approach.dot(contact.normal) > resting_speed
    };
    if !rests(world) || contacts.iter().any(is_fast) {
        return true;
    }
    let arriving: f32 = world.colliders.iter().map(|body| body.pending.linear.length()).sum();
    arriving > 0.0 && arriving > total_mass(&world.particles.mass) * gravity * h
}
