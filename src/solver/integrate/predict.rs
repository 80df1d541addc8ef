//! Stage `Predict`: where each particle would go by itself.
//!
//! By the formula of `Scheme`, with a limit on what a violent yank may do.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::simd::{Scalar, Simd, leveled, vectored};
use crate::solver::integrate::rigid_motion::{Free, RigidMotion};
use crate::solver::stretch::tethers::within;
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use crate::state::settings::Scheme;
use core::sync::atomic::{AtomicBool, Ordering};

/// Moves every free particle; `scratch` keeps the way it went and where it came to.
pub(crate) fn advance(world: &mut World) {
    let scheme = world.settings.scheme();
    let reach = world.max_displacement();
    // A way longer than `reach` has a component longer than this.
    let limit = reach * 0.577;
    let (level, threads) = (world.level, world.threads);
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let is_long = AtomicBool::new(false);
    let write = scratch.displacement.all_mut();
    let read = (p.moved.all(), p.v_ahead.all(), scratch.acceleration.all(), &p.w[..]);
    threads.parallel_for(
        (write, read),
        MIN_PARTICLES_PER_THREAD,
        |(write, (moved, v_ahead, a, w))| {
            let mut is_one_long = false;
            for (((way, moved), v_ahead), a) in write.into_iter().zip(moved).zip(v_ahead).zip(a) {
                plan(level, way, [moved, v_ahead, a, w], scheme, limit, &mut is_one_long);
            }
            if is_one_long {
                is_long.store(true, Ordering::Relaxed);
            }
        },
    );
    if is_long.into_inner() {
        clamp_displacement(world, reach);
    }
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let columns = (p.x.all_mut(), scratch.displacement.all(), scratch.predicted.all_mut());
    threads.parallel_for(columns, MIN_PARTICLES_PER_THREAD, |(x, way, predicted)| {
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
    let (level, p) = (world.level, &world.particles);
    let way = &mut world.scratch.displacement;
    let (x, mass, w) = (p.x.all(), &p.mass[..], &p.w[..]);
    let rigid = RigidMotion::of_free(level, Free { x, way: way.all(), mass, w });
    let is_clamped = AtomicBool::new(false);
    world.threads.parallel_for((way.all_mut(), x, w), MIN_PARTICLES_PER_THREAD, |(way, x, w)| {
        let mut is_one_clamped = false;
        clamp(level, way, [x[0], x[1], x[2], w], rigid, reach, &mut is_one_clamped);
        if is_one_clamped {
            is_clamped.store(true, Ordering::Relaxed);
        }
    });
    if is_clamped.into_inner() && p.w.iter().all(|w| *w > 0.0) {
        let left = RigidMotion::of_free(level, Free { x, way: way.all(), mass, w });
        for i in 0..p.len() {
            let x = p.x.at(i);
            way.add(i, rigid.at(x) - left.at(x));
        }
    }
}

vectored! {
    /// Whether any way was too long, or one before.
    fn clamp(
        way: [&mut [f32]; 3],
        from: [&[f32]; 4],
        rigid: RigidMotion,
        reach: f32,
        is_clamped: &mut bool,
    ) = clamp_lanes, Avx2, clamp_apart
}

#[inline(always)]
fn clamp_lanes<S: Simd>(
    s: S,
    [way_x, way_y, way_z]: [&mut [f32]; 3],
    [x, y, z, w]: [&[f32]; 4],
    rigid: RigidMotion,
    reach: f32,
    is_clamped: &mut bool,
) {
    // One length for all, so that one check does.
    let count = w.len();
    let (x, y, z) = (&x[..count], &y[..count], &z[..count]);
    let (way_x, way_y, way_z) = (&mut way_x[..count], &mut way_y[..count], &mut way_z[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let from = [s.load(x, at), s.load(y, at), s.load(z, at)];
        let way = [s.load(way_x, at), s.load(way_y, at), s.load(way_z, at)];
        if let Some(clamped) = within(s, way, rigid.ways(s, from), s.splat(reach), s.load(w, at)) {
            s.store(way_x, at, clamped[0]);
            s.store(way_y, at, clamped[1]);
            s.store(way_z, at, clamped[2]);
            *is_clamped = true;
        }
        at += S::LANES;
    }
    let way = [&mut way_x[at..], &mut way_y[at..], &mut way_z[at..]];
    clamp_apart(way, [&x[at..], &y[at..], &z[at..], &w[at..]], rigid, reach, is_clamped);
}

fn clamp_apart(
    [way_x, way_y, way_z]: [&mut [f32]; 3],
    [x, y, z, w]: [&[f32]; 4],
    rigid: RigidMotion,
    reach: f32,
    is_clamped: &mut bool,
) {
    let ways = way_x.iter_mut().zip(way_y).zip(way_z);
    for ((((x, y), z), w), ((way_x, way_y), way_z)) in x.iter().zip(y).zip(z).zip(w).zip(ways) {
        let (way, common) = ([*way_x, *way_y, *way_z], rigid.ways(Scalar, [*x, *y, *z]));
        if let Some(clamped) = within(Scalar, way, common, reach, *w) {
            [*way_x, *way_y, *way_z] = clamped;
            *is_clamped = true;
        }
    }
}
