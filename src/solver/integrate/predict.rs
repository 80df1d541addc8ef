//! Stage `Predict`: each particle moves by its history and its acceleration, as if unconstrained.
//!
//! ```text
//! d = extrapolation · d₋ + velocity_step (v_extrapolated + velocity_step · a)        x ← x + d
//! ```
//! Method: the predictor of `state::settings::BdfScheme`, with d₋ the displacement of the last
//! substep. A displacement larger than `max_displacement` relative to the rigid motion of its piece
//! is clamped, so that a violent jerk is absorbed while the cloth may still fall, fly and spin at
//! any speed.
//!
//! Reads positions, history, acceleration and inverse masses; writes positions,
//! `scratch.displacement` and `scratch.predicted`.
//! Invariant: a particle with zero inverse mass does not move. The clamp conserves linear and
//! angular momentum of a cloth that nothing holds.

// Without SIMD only the scalar fallbacks run.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::columns::Columns;
use crate::math::simd::{Scalar, Simd, leveled, vectored};
use crate::solver::integrate::momentum_sums::FreeParticles;
use crate::solver::integrate::rigid_motion::RigidMotion;
use crate::solver::stretch::tethers::project_into_sphere;
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use crate::state::settings::BdfScheme;
use core::sync::atomic::{AtomicBool, Ordering};

/// Moves every free particle to its predicted position, and stores displacement and position.
pub(crate) fn predict_positions(world: &mut World) {
    let scheme = world.scheme();
    let max_length = world.max_displacement();
    // A vector longer than `max_length` has a component longer than this: 0.577 < 1 / √3.
    let limit = max_length * 0.577;
    let (level, threads) = (world.level, world.threads);
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let is_long = AtomicBool::new(false);
    let write = scratch.displacement.slices_mut();
    let read = (
        p.displacement.slices(),
        p.v_extrapolated.slices(),
        scratch.acceleration.slices(),
        &p.w[..],
    );
    threads.parallel_for(
        (write, read),
        MIN_PARTICLES_PER_THREAD,
        |(write, (previous, v_extrapolated, a, w))| {
            let mut is_one_long = false;
            for (((displacement, previous), v_extrapolated), a) in
                write.into_iter().zip(previous).zip(v_extrapolated).zip(a)
            {
                compute_displacement(
                    level,
                    displacement,
                    [previous, v_extrapolated, a, w],
                    scheme,
                    limit,
                    &mut is_one_long,
                );
            }
            if is_one_long {
                is_long.store(true, Ordering::Relaxed);
            }
        },
    );
    if is_long.into_inner() {
        if world.pieces == 1 {
            clamp_displacement(world, max_length);
        } else {
            clamp_displacement_of_pieces(world, max_length);
        }
    }
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let columns = (p.x.slices_mut(), scratch.displacement.slices(), scratch.predicted.slices_mut());
    threads.parallel_for(columns, MIN_PARTICLES_PER_THREAD, |(x, displacement, predicted)| {
        for ((x, displacement), predicted) in x.into_iter().zip(displacement).zip(predicted) {
            apply_displacement(level, x, displacement, predicted);
        }
    });
}

leveled! {
    /// Computes one component of each displacement [m]. Sets `is_long` if one exceeds `limit`.
    fn compute_displacement(
        displacement: &mut [f32],
        from: [&[f32]; 4],
        scheme: BdfScheme,
        limit: f32,
        is_long: &mut bool,
    ) = compute_displacement_column
}

#[inline(always)]
fn compute_displacement_column(
    displacement: &mut [f32],
    [previous, v_extrapolated, a, w]: [&[f32]; 4],
    scheme: BdfScheme,
    limit: f32,
    is_long: &mut bool,
) {
    let BdfScheme { velocity_step, extrapolation, .. } = scheme;
    // Accumulated without a branch, so that the compiler vectorises the loop.
    let mut long = 0_u32;
    for ((((displacement, previous), v_extrapolated), a), w) in
        displacement.iter_mut().zip(previous).zip(v_extrapolated).zip(a).zip(w)
    {
        let free = previous * extrapolation + (v_extrapolated + a * velocity_step) * velocity_step;
        *displacement = if *w > 0.0 { free } else { 0.0 };
        long |= u32::from(displacement.abs() > limit);
    }
    *is_long |= long != 0;
}

leveled! {
    /// Adds one component of each displacement, and stores the predicted positions.
    fn apply_displacement(x: &mut [f32], displacement: &[f32], predicted: &mut [f32])
        = apply_displacement_column
}

#[inline(always)]
fn apply_displacement_column(x: &mut [f32], displacement: &[f32], predicted: &mut [f32]) {
    for ((x, displacement), predicted) in x.iter_mut().zip(displacement).zip(predicted) {
        *x += displacement;
        *predicted = *x;
    }
}

/// Clamps each displacement to `max_length` [m] relative to the rigid motion of its piece.
///
/// A free piece keeps its momentum and angular momentum, as in [`clamp_displacement`].
fn clamp_displacement_of_pieces(world: &mut World, max_length: f32) {
    let (p, scratch) = (&world.particles, &mut world.scratch);
    let displacement = &mut scratch.displacement;
    for piece in scratch.pieces.members.iter() {
        let free = || piece.iter().map(|i| *i as usize).filter(|i| p.w[*i] > 0.0);
        let fit =
            |displacement: &Columns| RigidMotion::fit(free, &p.x, |i| displacement.get(i), &p.mass);
        let rigid = fit(displacement);
        let mut is_clamped = false;
        for i in free() {
            let common = rigid.displacement_at(p.x.get(i));
            let relative = displacement.get(i) - common;
            let length2 = relative.length_squared();
            if length2 > max_length * max_length {
                displacement.set(i, common + relative * (max_length / length2.sqrt()));
                is_clamped = true;
            }
        }
        if is_clamped && piece.iter().all(|i| p.w[*i as usize] > 0.0) {
            let clamped = fit(displacement);
            for i in free() {
                let x = p.x.get(i);
                displacement.add(i, rigid.displacement_at(x) - clamped.displacement_at(x));
            }
        }
    }
}

/// Clamps each displacement to `max_length` [m] relative to the rigid motion of the cloth.
///
/// If nothing holds the cloth, the rigid motion that the clamp removed is added back to all
/// particles, so momentum and angular momentum stay.
fn clamp_displacement(world: &mut World, max_length: f32) {
    let (level, p) = (world.level, &world.particles);
    let displacement = &mut world.scratch.displacement;
    let (x, mass, w) = (p.x.slices(), &p.mass[..], &p.w[..]);
    let rigid = RigidMotion::of_free(
        level,
        FreeParticles { x, displacement: displacement.slices(), mass, w },
    );
    let is_clamped = AtomicBool::new(false);
    world.threads.parallel_for(
        (displacement.slices_mut(), x, w),
        MIN_PARTICLES_PER_THREAD,
        |(displacement, x, w)| {
            let mut is_one_clamped = false;
            clamp(
                level,
                displacement,
                [x[0], x[1], x[2], w],
                rigid,
                max_length,
                &mut is_one_clamped,
            );
            if is_one_clamped {
                is_clamped.store(true, Ordering::Relaxed);
            }
        },
    );
    if is_clamped.into_inner() && p.w.iter().all(|w| *w > 0.0) {
        let clamped = RigidMotion::of_free(
            level,
            FreeParticles { x, displacement: displacement.slices(), mass, w },
        );
        for i in 0..p.len() {
            let x = p.x.get(i);
            displacement.add(i, rigid.displacement_at(x) - clamped.displacement_at(x));
        }
    }
}

vectored! {
    /// Clamps displacements in SIMD lanes. Sets `is_clamped` if one was too long.
    fn clamp(
        displacement: [&mut [f32]; 3],
        from: [&[f32]; 4],
        rigid: RigidMotion,
        max_length: f32,
        is_clamped: &mut bool,
    ) = clamp_lanes, clamp_scalar
}

#[inline(always)]
fn clamp_lanes<S: Simd>(
    s: S,
    [dx, dy, dz]: [&mut [f32]; 3],
    [x, y, z, w]: [&[f32]; 4],
    rigid: RigidMotion,
    max_length: f32,
    is_clamped: &mut bool,
) {
    // Equal slice lengths let the compiler remove the bounds checks.
    let count = w.len();
    let (x, y, z) = (&x[..count], &y[..count], &z[..count]);
    let (dx, dy, dz) = (&mut dx[..count], &mut dy[..count], &mut dz[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let from = [s.load(x, at), s.load(y, at), s.load(z, at)];
        let displacement = [s.load(dx, at), s.load(dy, at), s.load(dz, at)];
        if let Some(clamped) = project_into_sphere(
            s,
            displacement,
            rigid.displacement_lanes(s, from),
            s.splat(max_length),
            s.load(w, at),
        ) {
            s.store(dx, at, clamped[0]);
            s.store(dy, at, clamped[1]);
            s.store(dz, at, clamped[2]);
            *is_clamped = true;
        }
        at += S::LANES;
    }
    let displacement = [&mut dx[at..], &mut dy[at..], &mut dz[at..]];
    clamp_scalar(
        displacement,
        [&x[at..], &y[at..], &z[at..], &w[at..]],
        rigid,
        max_length,
        is_clamped,
    );
}

fn clamp_scalar(
    [dx, dy, dz]: [&mut [f32]; 3],
    [x, y, z, w]: [&[f32]; 4],
    rigid: RigidMotion,
    max_length: f32,
    is_clamped: &mut bool,
) {
    let displacements = dx.iter_mut().zip(dy).zip(dz);
    for ((((x, y), z), w), ((dx, dy), dz)) in x.iter().zip(y).zip(z).zip(w).zip(displacements) {
        let (displacement, common) =
            ([*dx, *dy, *dz], rigid.displacement_lanes(Scalar, [*x, *y, *z]));
        if let Some(clamped) = project_into_sphere(Scalar, displacement, common, max_length, *w) {
            [*dx, *dy, *dz] = clamped;
            *is_clamped = true;
        }
    }
}
