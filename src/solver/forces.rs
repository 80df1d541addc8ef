//! Stage `Forces`: gravity and the air, as an acceleration of each particle.
//!
//! The air pushes each triangle along its normal by the square of the relative speed,
//! p = ½ ρ C |u·n| (u·n), and across the wind by ½ ρ C_L sin α cos α |u|². Gathered once a tick.

use super::World;
use crate::math::{max, min};
use crate::state::wind::{Breeze, WindModel};
use glam::Vec3;

/// The largest share of a triangle's relative speed that the air may take in one tick: explicit
/// drag is stable up to one, and without ringing up to this.
const MAX_BRAKE: f32 = 0.5;

/// Fills `scratch.acceleration`.
pub(crate) fn gather(world: &mut World) {
    let gravity = world.settings.gravity;
    world.scratch.acceleration.fill(gravity);
    match world.wind.model {
        WindModel::Surface => push_surfaces(world),
        WindModel::SineField => push_particles(world),
    }
}

fn push_particles(world: &mut World) {
    if world.wind.velocity == Vec3::ZERO {
        return;
    }
    for i in 0..world.particles.len() {
        let push = world.wind.sine_field(world.time, world.particles.x.at(i));
        world.scratch.acceleration.add(i, push);
    }
}

fn push_surfaces(world: &mut World) {
    let (drag, lift) = (world.material.drag, world.material.lift);
    if world.wind.air_density == 0.0 || (drag == 0.0 && lift == 0.0) {
        return;
    }
    let breeze = world.wind.at(world.time);
    let half_density = 0.5 * world.wind.air_density;
    let p = &world.particles;
    let most = MAX_BRAKE * world.material.density / world.settings.tick;
    for (triangle, areas) in world.mesh.triangles.iter().zip(&world.corner_area) {
        let [a, b, c] = triangle.map(|v| v as usize);
        let (xa, xb, xc) = (p.x.at(a), p.x.at(b), p.x.at(c));
        let moving = (p.v.at(a) + p.v.at(b) + p.v.at(c)) * (1.0 / 3.0);
        let u = air(&breeze, (xa + xb + xc) * (1.0 / 3.0)) - moving;
        let normal = (xb - xa).cross(xc - xa);
        let double_area = normal.length();
        let rest_area = areas[0] + areas[1] + areas[2];
        if double_area <= 0.0 || rest_area <= 0.0 {
            continue;
        }
        let n = normal * (1.0 / double_area);
        let facing = u.dot(n);
        let speed2 = u.length_squared();
        let rate = min(half_density * drag * facing.abs(), most);
        let mut pressure = n * (rate * facing);
        if lift > 0.0 && speed2 > 0.0 {
            let rate = min(half_density * lift * facing.abs(), most);
            let across = n * speed2 - u * facing;
            pressure += across * (rate * sign(facing) / speed2.sqrt());
        }
        // The pressure acts on the triangle as it is now, shared out as its mass is.
        let stretch = min(0.5 * double_area / rest_area, 4.0);
        for (vertex, area) in [a, b, c].into_iter().zip(areas) {
            let share = area * stretch / max(p.mass[vertex], 1.0e-12);
            world.scratch.acceleration.add(vertex, pressure * share);
        }
    }
}

fn air(breeze: &Breeze, at: Vec3) -> Vec3 {
    if breeze.is_still() { Vec3::ZERO } else { breeze.velocity(at) }
}

fn sign(value: f32) -> f32 {
    if value < 0.0 { -1.0 } else { 1.0 }
}
