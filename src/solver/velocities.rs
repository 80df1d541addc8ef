//! Stage `Velocities`: what the substep made of each particle's motion.
//!
//! ```text
//! v = (3 x - 4 x_start + x_prev) / 2h
//! ```
//! the other half of the second-order scheme of `predict`. Damping scales the velocity and the
//! history alike, which makes a free particle slow down by exactly exp(-damping h).

use super::World;
use super::contacts::Touch;
use crate::math::min;
use crate::math::trig::exp_decay;
use glam::Vec3;

/// Derives velocities and moves the history on.
pub(crate) fn derive(world: &mut World) {
    let h = world.settings.substep();
    let keep = exp_decay(f64::from(-world.settings.damping) * f64::from(h));
    let p = &mut world.particles;
    let start = &world.scratch.start;
    // Bounces need the velocity from before; they replace what the update makes of it.
    if world.colliders.iter().next().is_some() {
        for i in 0..p.mass.len() {
            let touch = &mut world.scratch.touch[i];
            if touch.is_some() {
                touch.approach = p.v.at(i);
            }
        }
    }
    for (x, x_prev, v, start) in [
        (&p.x.x, &mut p.x_prev.x, &mut p.v.x, &start.x),
        (&p.x.y, &mut p.x_prev.y, &mut p.v.y, &start.y),
        (&p.x.z, &mut p.x_prev.z, &mut p.v.z, &start.z),
    ] {
        derive_column(x, x_prev, v, start, h, keep);
    }
    if world.colliders.iter().next().is_some() {
        bounce(world, h, keep);
    }
}

fn derive_column(x: &[f32], x_prev: &mut [f32], v: &mut [f32], start: &[f32], h: f32, keep: f32) {
    let half_rate = 0.5 / h;
    for (((x, x_prev), v), start) in x.iter().zip(x_prev).zip(v).zip(start) {
        let (step, last_step) = (x - start, start - *x_prev);
        *v = (3.0 * step - last_step) * half_rate * keep;
        *x_prev = x - step * keep;
    }
}

/// What touching does to motion: Newton's law of restitution along the normal, what friction left
/// along the surface.
///
/// A hit begins a new history, for the second-order scheme must not look back across it; resting
/// and sliding keep theirs along the surface.
fn bounce(world: &mut World, h: f32, keep: f32) {
    let p = &mut world.particles;
    let rest_speed = 2.0 * h * world.settings.gravity.length();
    for i in 0..p.mass.len() {
        let touch: Touch = world.scratch.touch[i];
        if !touch.is_some() || p.w[i] <= 0.0 {
            continue;
        }
        let (n, surface) = (touch.normal, touch.surface_velocity);
        let along = |v: Vec3| (v - n * v.dot(n)) * touch.tangential_restitution;
        let x = p.x.at(i);
        let step = x - world.scratch.start.at(i) - surface * h;
        let approach = min((touch.approach - surface).dot(n), 0.0);
        if -approach > rest_speed {
            let v = along(step * (1.0 / h)) - n * (approach * touch.restitution);
            p.place(i, x, surface + v, h);
        } else {
            p.v.set(i, surface + along(p.v.at(i) - surface));
            p.x_prev.set(i, x - surface * h - along(step * keep));
        }
    }
}
