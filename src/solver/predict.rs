//! Stage `Predict`: where each particle would go by itself.
//!
//! By the formula of `Scheme`, with a limit on what a violent yank may do.

use super::rigid::RigidMotion;
use super::{PARTICLES, World};
use crate::math::simd::leveled;
use crate::state::settings::Scheme;
use core::sync::atomic::{AtomicBool, Ordering};
use glam::Vec3;

/// Moves every free particle; `scratch` keeps the way it went and where it came to.
pub(crate) fn advance(world: &mut World) {
    let scheme = world.settings.scheme();
    let reach = world.reach();
    // A way longer than `reach` has a component longer than this.
    let limit = reach * 0.577;
    let (level, threads) = (world.level, world.threads);
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let is_long = AtomicBool::new(false);
    let write = scratch.way.all_mut();
    let read = (p.moved.all(), p.v_ahead.all(), scratch.acceleration.all(), &p.w[..]);
    threads.over((write, read), PARTICLES, |(write, (moved, v_ahead, a, w))| {
        let mut is_one_long = false;
        for (((way, moved), v_ahead), a) in write.into_iter().zip(moved).zip(v_ahead).zip(a) {
            plan(level, way, [moved, v_ahead, a, w], scheme, limit, &mut is_one_long);
        }
        if is_one_long {
            is_long.store(true, Ordering::Relaxed);
        }
    });
    if is_long.into_inner() {
        clamp_displacement(world, reach);
    }
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let columns = (p.x.all_mut(), scratch.way.all(), scratch.predicted.all_mut());
    threads.over(columns, PARTICLES, |(x, way, predicted)| {
        for ((x, way), predicted) in x.into_iter().zip(way).zip(predicted) {
            go(level, x, way, predicted);
        }
    });
}

leveled! {
    /// The way of each particle in one direction; `is_long` if one is longer than `limit`.
    fn plan(
        way: &mut [f32],
        from: [&[f32]; 4],
        scheme: Scheme,
        limit: f32,
        is_long: &mut bool,
    ) = plan_column
}

#[inline(always)]
fn plan_column(
    way: &mut [f32],
    [moved, v_ahead, a, w]: [&[f32]; 4],
    scheme: Scheme,
    limit: f32,
    is_long: &mut bool,
) {
    let Scheme { step, carry, .. } = scheme;
    // Counted rather than asked for, which a loop over lanes can do.
    let mut long = 0_u32;
    for ((((way, moved), v_ahead), a), w) in way.iter_mut().zip(moved).zip(v_ahead).zip(a).zip(w) {
        let free = moved * carry + (v_ahead + a * step) * step;
        *way = if *w > 0.0 { free } else { 0.0 };
        long |= u32::from(way.abs() > limit);
    }
    *is_long |= long != 0;
}

leveled! {
    /// Takes each particle along its way.
    fn go(x: &mut [f32], way: &[f32], predicted: &mut [f32]) = go_column
}

#[inline(always)]
fn go_column(x: &mut [f32], way: &[f32], predicted: &mut [f32]) {
    for ((x, way), predicted) in x.iter_mut().zip(way).zip(predicted) {
        *x += way;
        *predicted = *x;
    }
}

/// Keeps each way within `reach` of the cloth's own rigid motion, so that a violent yank is
/// absorbed and yet a cloth may fall, fly and spin as fast as it likes. One that nothing holds keeps
/// its momentum and its spin: what this takes from some particles goes to all.
fn clamp_displacement(world: &mut World, reach: f32) {
    let p = &world.particles;
    let way = &mut world.scratch.way;
    let free = || (0..p.len()).filter(|i| p.w[*i] > 0.0);
    let rigid = RigidMotion::fit(free, &p.x, |i| way.at(i), &p.mass);
    let particles = (way.all_mut(), p.x.all(), &p.w[..]);
    let is_clamped = AtomicBool::new(false);
    world.threads.over(particles, PARTICLES, |(way, x, w)| {
        if clamp(way, x, w, rigid, reach) {
            is_clamped.store(true, Ordering::Relaxed);
        }
    });
    if is_clamped.into_inner() && p.w.iter().all(|w| *w > 0.0) {
        let left = RigidMotion::fit(free, &p.x, |i| way.at(i), &p.mass);
        for i in 0..p.len() {
            let x = p.x.at(i);
            way.add(i, rigid.at(x) - left.at(x));
        }
    }
}

/// Whether any way was too long.
fn clamp(
    way: [&mut [f32]; 3],
    [x, y, z]: [&[f32]; 3],
    w: &[f32],
    rigid: RigidMotion,
    reach: f32,
) -> bool {
    let mut is_clamped = false;
    let [way_x, way_y, way_z] = way;
    let ways = way_x.iter_mut().zip(way_y).zip(way_z);
    let particles = x.iter().zip(y).zip(z).zip(w).zip(ways);
    for ((((x, y), z), w), ((way_x, way_y), way_z)) in particles {
        if *w <= 0.0 {
            continue;
        }
        let common = rigid.at(Vec3::new(*x, *y, *z));
        let own = Vec3::new(*way_x, *way_y, *way_z) - common;
        let length2 = own.length_squared();
        if length2 > reach * reach {
            [*way_x, *way_y, *way_z] = (common + own * (reach / length2.sqrt())).to_array();
            is_clamped = true;
        }
    }
    is_clamped
}
