//! What touching does to motion: Newton's law of restitution along the normal, what friction left along
//! the surface; and what the collider gets of it.
//!
//! A hit begins a new history, for the second-order scheme must not look back across it; resting
//! and sliding keep theirs along the surface.

use crate::math::min;
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::world::World;
use crate::state::particles::Particles;
use glam::Vec3;

/// What all touches of a substep have in common.
#[derive(Clone, Copy)]
struct Law {
    h: f32,
    gravity: Vec3,
    /// What is slower rests or slides [m/s].
    rest_speed: f32,
    keep: f32,
    /// What a push of a kilogram by a metre gives in a substep: the momentum that it takes to stay where it
    /// was pushed to, and the velocity that it got.
    force: f32,
    gain: f32,
}

/// Goes over all touches, after velocities were derived.
pub(crate) fn resolve_velocities(world: &mut World, keep: f32) {
    let (scheme, gravity) = (world.settings.scheme(), world.settings.gravity);
    let law = Law {
        h: scheme.h,
        gravity,
        rest_speed: 2.0 * scheme.h * gravity.length(),
        keep,
        force: scheme.h / (scheme.velocity_step * scheme.velocity_step),
        gain: scheme.new_weight / scheme.h,
    };
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    for touch in &scratch.contacts.collider_contacts {
        let i = touch.particle as usize;
        let step = scratch.displacement.at(i) + (p.x.at(i) - scratch.predicted.at(i));
        let given = bounce(p, touch, i, step, law);
        let impulse = &mut scratch.contacts.impulses[touch.body as usize];
        impulse.linear -= given;
        // About the world's origin; `arrive` knows where the collider's is.
        impulse.angular -= p.x.at(i).cross(given);
    }
}

/// Says how much momentum the particle got.
fn bounce(p: &mut Particles, touch: &ColliderContact, i: usize, step: Vec3, law: Law) -> Vec3 {
    let (n, surface, h) = (touch.normal, touch.surface_velocity, law.h);
    let along = |v: Vec3| (v - n * v.dot(n)) * touch.tangential_restitution;
    let step = step - surface * h;
    let approach = min((touch.approach - surface).dot(n), 0.0);
    let shared = |old: Vec3, new: Vec3| {
        if touch.share < 1.0 { old + (new - old) * touch.share } else { new }
    };
    if -approach > law.rest_speed {
        let v = surface + along(step * (1.0 / h)) - n * (approach * touch.restitution);
        let v = shared(p.v.at(i), v);
        let change = v - p.v.at(i);
        p.set_motion(i, p.x.at(i), v, law.gravity, h);
        return (change + touch.push * law.gain) * p.mass[i];
    }
    let kept = |v: Vec3| shared(v, surface + along(v - surface));
    p.v.set(i, kept(p.v.at(i)));
    p.v_extrapolated.set(i, kept(p.v_extrapolated.at(i)));
    p.displacement.set(i, shared(p.displacement.at(i), surface * h + along(step * law.keep)));
    touch.push * (law.force * p.mass[i])
}
