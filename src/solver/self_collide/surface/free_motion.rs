//! Layers that push and rub give a cloth of one piece that nothing holds no motion as a whole.
//!
//! What touches a collider moves less than what lies on it, as if the collider bore all that it is pushed by: along
//! a floor too, as no friction could, so that crumpled paper would turn on it for ever like a top. And a little is
//! left of pushes that act along directions of when the substep began. So what layers moved is made good for all of
//! it, but for what they push off the floor with: that it bears. What touches several ways is left as it is.

use crate::solver::particle_stage::interleaved;

use crate::math::wide4::Float4;
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::integrate::rigid_motion::{FreeParticles, RigidMotion};

use crate::solver::integrate::momentum;

use crate::solver::world::World;
use glam::Vec3;

/// Normals that have this cosine at least are those of one floor.
const FLAT: f32 = 0.999;

/// The floor that a cloth lies on which is kept still, zero if there is none; nothing if it is not.
pub(crate) fn floor(world: &World) -> Option<Vec3> {
    let is_free = world.pieces == 1 && !momentum::is_held(world);
    if is_free { normal(&world.scratch.contacts.collider_contacts) } else { None }
}

/// Moves all back as a whole by what they were moved by since they were at `before`, which is room to work in then.
pub(crate) fn keep(
    world: &mut World,
    floor: Vec3,
    before: &mut Vec<Float4>,
    now: &mut Vec<Float4>,
) {
    momentum::list_starts(world);
    let (p, scratch) = (&world.particles, &mut world.scratch);
    interleaved::list_ways(before, now, &mut scratch.tether_pins);
    let free = FreeParticles {
        x: scratch.relative_wind.all(),
        displacement: scratch.tether_pins.all(),
        mass: &p.mass,
        w: &p.w,
    };
    let whole = RigidMotion::of_free(world.level, free);
    let whole = if floor == Vec3::ZERO { whole } else { whole.project_on_floor(floor) };
    interleaved::take_back(now, &whole, before);
    core::mem::swap(now, before);
}

/// The normal of the floor that all touches are with, zero if there is none; nothing if they are with more.
fn normal(touches: &[ColliderContact]) -> Option<Vec3> {
    let Some(first) = touches.first() else { return Some(Vec3::ZERO) };
    touches.iter().all(|touch| touch.normal.dot(first.normal) > FLAT).then_some(first.normal)
}
