//! Stage `Tethers`: long-range attachments of every particle to the pins.
//!
//! ```text
//! pin ●~~~~~~~~~~~~~~● particle       |x − pin| ≤ slack · d
//!      d: geodesic distance along the cloth at rest [m]
//! ```
//! Kim, Chentanez, Müller, "Long range attachments", SCA 2012. A particle beyond its bound is
//! projected onto the sphere around the pin; a particle within it is not touched, so a tether never
//! pushes:
//!
//! ```text
//! x ← pin + (x − pin) slack d / |x − pin|      if |x − pin| > slack d and w > 0
//! ```
//! With few pins each particle has a tether to every pin, with many only to the nearest (see
//! `model::tethers`). The slack is one factor for all tethers; `tether_slack` computes it.
//!
//! Reads `tethers`, `tether_slack`, inverse masses; writes positions.
//! Invariant: tethers move a particle towards its pin only.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::columns::Columns;
use crate::math::simd::{Float, Level, Scalar, Simd, vectored};
use crate::math::threads::Threads;
use crate::model::tethers::TetherSet;
use crate::solver::particle_stage::interleaved_particles::InterleavedParticles;
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};

/// Copies the positions of the pins to `scratch.tether_pins`, one per particle, if there are many
/// pins.
pub(crate) fn refresh_pin_positions(world: &mut World) {
    let [x, y, z] = world.particles.x.slices();
    let (y, z) = (&y[..x.len()], &z[..x.len()]);
    for set in world.tethers.sets().iter().filter(|set| set.single_pin.is_none()) {
        let positions = &mut world.scratch.tether_pins;
        positions.resize(set.pin.len());
        let [to_x, to_y, to_z] = positions.slices_mut();
        for (((pin, to_x), to_y), to_z) in set.pin.iter().zip(to_x).zip(to_y).zip(to_z) {
            let at = *pin as usize;
            (*to_x, *to_y, *to_z) = (x[at], y[at], z[at]);
        }
    }
}

/// Projects every particle to within its tethers, with the slack of this tick.
pub(crate) fn solve(world: &mut World) {
    project(world, world.tether_slack);
}

/// Projects every particle to within `slack` times its geodesic distance from its pins.
pub(crate) fn project(world: &mut World, slack: f32) {
    let (level, threads, p) = (world.level, world.threads, &mut world.particles);
    let (pins, interleaved) = (&world.scratch.tether_pins, &mut world.scratch.interleaved);
    for set in world.tethers.sets() {
        if interleaved.is_current {
            project_interleaved(threads, set, slack, pins, interleaved);
        } else {
            project_columns(level, threads, set, slack, pins, &mut p.x, &p.w);
        }
    }
}

fn project_interleaved(
    threads: Threads,
    set: &TetherSet,
    slack: f32,
    pins: &Columns,
    interleaved: &mut InterleavedParticles,
) {
    let InterleavedParticles { points, w, .. } = interleaved;
    let only = set.single_pin.map(|pin| points[pin as usize]);
    let particles = (&mut points[..], &w[..], &set.length[..]);
    match only {
        Some(pin) => {
            threads.parallel_for(particles, MIN_PARTICLES_PER_THREAD, |(points, w, length)| {
                interleaved_to_single(points, pin, length, slack, w);
            });
        }
        None => {
            threads.parallel_for(
                (particles, pins.slices()),
                MIN_PARTICLES_PER_THREAD,
                |((points, w, length), pins)| {
                    interleaved_to_each(points, pins, length, slack, w);
                },
            );
        }
    }
}

fn interleaved_to_single(
    points: &mut [[f32; 4]],
    [px, py, pz, _]: [f32; 4],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    for ((point, length), w) in points.iter_mut().zip(length).zip(w) {
        let [x, y, z, _] = *point;
        if let Some([x, y, z]) =
            project_into_sphere(Scalar, [x, y, z], [px, py, pz], length * slack, *w)
        {
            *point = [x, y, z, 0.0];
        }
    }
}

fn interleaved_to_each(
    points: &mut [[f32; 4]],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    let pins = px.iter().zip(py).zip(pz);
    for (((point, length), w), ((px, py), pz)) in points.iter_mut().zip(length).zip(w).zip(pins) {
        let [x, y, z, _] = *point;
        if let Some([x, y, z]) =
            project_into_sphere(Scalar, [x, y, z], [*px, *py, *pz], length * slack, *w)
        {
            *point = [x, y, z, 0.0];
        }
    }
}

fn project_columns(
    level: Level,
    threads: Threads,
    set: &TetherSet,
    slack: f32,
    pins: &Columns,
    x: &mut Columns,
    w: &[f32],
) {
    let length = &set.length[..];
    match set.single_pin {
        Some(pin) => {
            let pin = x.get(pin as usize).to_array();
            threads.parallel_for(
                (x.slices_mut(), length, w),
                MIN_PARTICLES_PER_THREAD,
                |(x, length, w)| {
                    columns_to_single(level, x, pin, length, slack, w);
                },
            );
        }
        None => {
            let particles = (x.slices_mut(), pins.slices(), length, w);
            threads.parallel_for(particles, MIN_PARTICLES_PER_THREAD, |(x, pins, length, w)| {
                columns_to_each(level, x, pins, length, slack, w);
            });
        }
    }
}

vectored! {
    fn columns_to_single(x: [&mut [f32]; 3], pin: [f32; 3], length: &[f32], slack: f32, w: &[f32])
        = single_lanes, single_scalar
}

vectored! {
    fn columns_to_each(
        x: [&mut [f32]; 3],
        pins: [&[f32]; 3],
        length: &[f32],
        slack: f32,
        w: &[f32],
    ) = each_lanes, each_scalar
}

#[inline(always)]
fn single_lanes<S: Simd>(
    s: S,
    [x, y, z]: [&mut [f32]; 3],
    pin: [f32; 3],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    let pins = [s.splat(pin[0]), s.splat(pin[1]), s.splat(pin[2])];
    // Equal lengths let the compiler drop all bounds checks but one.
    let count = length.len();
    let (x, y, z, w) = (&mut x[..count], &mut y[..count], &mut z[..count], &w[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let radius = s.load(length, at) * s.splat(slack);
        let from = [s.load(x, at), s.load(y, at), s.load(z, at)];
        if let Some(projected) = project_into_sphere(s, from, pins, radius, s.load(w, at)) {
            s.store(x, at, projected[0]);
            s.store(y, at, projected[1]);
            s.store(z, at, projected[2]);
        }
        at += S::LANES;
    }
    let x = [&mut x[at..], &mut y[at..], &mut z[at..]];
    single_scalar(x, pin, &length[at..], slack, &w[at..]);
}

fn single_scalar([x, y, z]: [&mut [f32]; 3], pin: [f32; 3], length: &[f32], slack: f32, w: &[f32]) {
    let particles = x.iter_mut().zip(y).zip(z);
    for ((((x, y), z), length), w) in particles.zip(length).zip(w) {
        if let Some(projected) = project_into_sphere(Scalar, [*x, *y, *z], pin, length * slack, *w)
        {
            [*x, *y, *z] = projected;
        }
    }
}

#[inline(always)]
fn each_lanes<S: Simd>(
    s: S,
    [x, y, z]: [&mut [f32]; 3],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    // As in `single_lanes`.
    let count = length.len();
    let (x, y, z, w) = (&mut x[..count], &mut y[..count], &mut z[..count], &w[..count]);
    let (px, py, pz) = (&px[..count], &py[..count], &pz[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let pins = [s.load(px, at), s.load(py, at), s.load(pz, at)];
        let radius = s.load(length, at) * s.splat(slack);
        let from = [s.load(x, at), s.load(y, at), s.load(z, at)];
        if let Some(projected) = project_into_sphere(s, from, pins, radius, s.load(w, at)) {
            s.store(x, at, projected[0]);
            s.store(y, at, projected[1]);
            s.store(z, at, projected[2]);
        }
        at += S::LANES;
    }
    let (x, pins) = ([&mut x[at..], &mut y[at..], &mut z[at..]], [&px[at..], &py[at..], &pz[at..]]);
    each_scalar(x, pins, &length[at..], slack, &w[at..]);
}

fn each_scalar(
    [x, y, z]: [&mut [f32]; 3],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    let particles = x.iter_mut().zip(y).zip(z);
    let pins = px.iter().zip(py).zip(pz);
    for (((((x, y), z), ((px, py), pz)), length), w) in particles.zip(pins).zip(length).zip(w) {
        if let Some(projected) =
            project_into_sphere(Scalar, [*x, *y, *z], [*px, *py, *pz], length * slack, *w)
        {
            [*x, *y, *z] = projected;
        }
    }
}

/// Projects points outside a sphere onto it: returns `x` where it is inside or held (w = 0), else
/// the nearest point of the sphere; `None` if no lane moves. `radius` is in [m].
#[inline(always)]
pub(crate) fn project_into_sphere<S: Simd>(
    s: S,
    x: [S::F; 3],
    pin: [S::F; 3],
    radius: S::F,
    w: S::F,
) -> Option<[S::F; 3]> {
    let [dx, dy, dz] = [x[0] - pin[0], x[1] - pin[1], x[2] - pin[2]];
    let length2 = dx * dx + dy * dy + dz * dz;
    let is_outside = (length2 - radius * radius).min(w);
    if !s.any_positive(is_outside) {
        return None;
    }
    let share = radius / length2.sqrt();
    Some([
        s.select(is_outside, pin[0] + dx * share, x[0]),
        s.select(is_outside, pin[1] + dy * share, x[1]),
        s.select(is_outside, pin[2] + dz * share, x[2]),
    ])
}
