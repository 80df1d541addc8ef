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
//! `model::tethers`). The slack is one factor for all tethers. It is computed once a tick,
//!
//! ```text
//! slack = max( min(slack, max |x − pin| / d) − 2 s⁻¹ tick,   hold stretch,   1 + ε )
//! hold stretch   max distance / d between two held particles, at least 1
//! ε              0 for rigid links; else 0.005 + 4 σ g L / K, at most max_stretch / 2
//!                σ: largest mass per area, L: longest d, K: least stretch stiffness; σ g L / K is the
//!                strain at the top of a strip of length L that hangs under its own weight
//! ```
//! so that tethers carry the load which the sweeps have not carried yet, and none of what the cloth
//! really stretches by. A cloth that was held apart contracts at the rate of the first term,
//! because contracting in one tick would fling it.
//!
//! Reads `tethers`, pins, grabs, inverse masses; writes positions, `tether_slack`, `pin_stretch`.
//! Invariant: tethers move a particle towards its pin only.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::columns::Columns;
use crate::math::simd::{Float, Level, MAX_LANES, Scalar, Simd, vectored};
use crate::math::threads::Threads;
use crate::math::{max, min};
use crate::model::tethers::TetherSet;
use crate::solver::particle_stage::interleaved_particles::InterleavedParticles;
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use crate::state::pins::Pin;

/// The least slack of tethers if links are compliant, beyond 1.
const MIN_SOFT_SLACK: f32 = 0.005;

/// The rate at which the slack decreases after the cloth was held apart [1/s].
const CONTRACTION_RATE: f32 = 2.0;

/// The load that tethers leave to the links, over the cloth's own weight: folds and wind add to it.
const LOAD_FACTOR: f32 = 4.0;

/// Copies the positions of the pins to `scratch.tether_pins`, one per particle, if there are many
/// pins.
pub(crate) fn refresh_pin_positions(world: &mut World) {
    let [x, y, z] = world.particles.x.all();
    let (y, z) = (&y[..x.len()], &z[..x.len()]);
    for set in world.tethers.sets().iter().filter(|set| set.single_pin.is_none()) {
        let positions = &mut world.scratch.tether_pins;
        positions.resize(set.pin.len());
        let [to_x, to_y, to_z] = positions.all_mut();
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

/// Computes the slack of this tick by the formula of the module doc.
pub(crate) fn update_slack(world: &mut World) {
    refresh_pin_positions(world);
    let hold_stretch = update_hold_stretch(world);
    let own = 1.0 + compute_weight_strain(world);
    let now = min(world.tether_slack, compute_max_stretch(world));
    let contracted = now - CONTRACTION_RATE * world.settings.tick;
    world.tether_slack = max(contracted, max(hold_stretch, own));
}

/// The largest distance of a particle from its pin over its geodesic distance.
fn compute_max_stretch(world: &World) -> f32 {
    let (level, x) = (world.level, world.particles.x.all());
    let mut max_ratio2 = 0.0;
    for set in world.tethers.sets() {
        match set.single_pin {
            Some(pin) => {
                let pin = world.particles.x.at(pin as usize).to_array();
                max_ratio_to_single(level, x, pin, &set.length, &mut max_ratio2);
            }
            None => {
                max_ratio_to_each(
                    level,
                    x,
                    world.scratch.tether_pins.all(),
                    &set.length,
                    &mut max_ratio2,
                );
            }
        }
    }
    max_ratio2.sqrt()
}

/// The strain ε that tethers leave to compliant links, see the module doc; 0 if links are rigid.
fn compute_weight_strain(world: &World) -> f32 {
    let material = &world.material;
    let (weft, warp) = (material.stretch_stiffness_weft, material.stretch_stiffness_warp);
    let softest = if weft > 0.0 && (warp == 0.0 || weft < warp) { weft } else { warp };
    if softest == 0.0 {
        return 0.0;
    }
    let sets = world.tethers.sets().iter().flat_map(|set| &set.length);
    let longest =
        sets.fold(0.0, |largest: f32, l| if l.is_finite() { max(*l, largest) } else { largest });
    let [_, heaviest] = world.mass_scales.range();
    let load = material.density * world.settings.gravity.length() * heaviest;
    let strain = load * longest / softest;
    let own = MIN_SOFT_SLACK + LOAD_FACTOR * strain;
    let bound = world.settings.max_stretch;
    if bound > 0.0 && bound * 0.5 < own { bound * 0.5 } else { own }
}

/// The largest distance of two pinned or grabbed particles over their geodesic distance; at least
/// 1.
///
/// Updates `pin_stretch` if that is out of date.
fn update_hold_stretch(world: &mut World) -> f32 {
    if !world.is_pin_stretch_current {
        world.pin_stretch = compute_pin_stretch(world);
    }
    // A grab may move a pinned particle.
    let is_grabbed = world.grabs.iter().next().is_some();
    let x = &world.particles.x;
    // A pin that moved reaches its target up to rounding, and exactly one tick later.
    let is_at_rest = |pin: &Pin| {
        pin.from == pin.target && (pin.is_soft() || x.at(pin.particle as usize) == pin.target)
    };
    world.is_pin_stretch_current = !is_grabbed && world.pins.iter().all(is_at_rest);
    let mut largest = world.pin_stretch;
    for set in world.tethers.sets() {
        for held in world.grabs.iter().map(|held| held.particle as usize) {
            let (length, pin) = (set.length[held], set.pin[held]);
            if length > 0.0 && length.is_finite() {
                largest = max((x.at(held) - x.at(pin as usize)).length() / length, largest);
            }
        }
    }
    largest
}

/// The largest distance of two pins over their geodesic distance; at least 1.
fn compute_pin_stretch(world: &World) -> f32 {
    let x = &world.particles.x;
    let mut largest = 1.0;
    let mut compare = |a: u32, b: u32, geodesic: f32| {
        let span = x.at(b as usize) - x.at(a as usize);
        largest = max(span.length() / geodesic, largest);
    };
    for set in world.tethers.sets() {
        if let Some(pin) = set.single_pin {
            let others = world.pins.hard_particles().filter(|other| *other != pin);
            let joined = others.filter(|other| set.length[*other as usize].is_finite());
            joined.for_each(|other| compare(pin, other, set.length[other as usize]));
            continue;
        }
        // An edge between the regions of two pins closes a path from one pin to the other.
        for triangle in &world.mesh.triangles {
            let [a, b, c] = triangle.map(|v| v as usize);
            for (p, q) in [(a, b), (b, c), (c, a)] {
                let (from, to) = (set.pin[p], set.pin[q]);
                if from != to && set.length[p].is_finite() && set.length[q].is_finite() {
                    let rest = |v: usize| world.rest[world.mesh.source[v] as usize];
                    compare(from, to, set.length[p] + (rest(q) - rest(p)).length() + set.length[q]);
                }
            }
        }
    }
    largest
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
            })
        }
        None => {
            threads.parallel_for(
                (particles, pins.all()),
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
            let pin = x.at(pin as usize).to_array();
            threads.parallel_for(
                (x.all_mut(), length, w),
                MIN_PARTICLES_PER_THREAD,
                |(x, length, w)| {
                    columns_to_single(level, x, pin, length, slack, w);
                },
            );
        }
        None => {
            let particles = (x.all_mut(), pins.all(), length, w);
            threads.parallel_for(particles, MIN_PARTICLES_PER_THREAD, |(x, pins, length, w)| {
                columns_to_each(level, x, pins, length, slack, w);
            });
        }
    }
}

vectored! {
    fn columns_to_single(x: [&mut [f32]; 3], pin: [f32; 3], length: &[f32], slack: f32, w: &[f32])
        = single_lanes, Avx512, single_scalar
}

vectored! {
    fn columns_to_each(
        x: [&mut [f32]; 3],
        pins: [&[f32]; 3],
        length: &[f32],
        slack: f32,
        w: &[f32],
    ) = each_lanes, Avx512, each_scalar
}

vectored! {
    /// Raises `largest` to the largest squared ratio of distance to geodesic distance.
    fn max_ratio_to_single(x: [&[f32]; 3], pin: [f32; 3], length: &[f32], largest: &mut f32)
        = single_ratio_lanes, Avx2, single_ratio_scalar
}

vectored! {
    fn max_ratio_to_each(x: [&[f32]; 3], pins: [&[f32]; 3], length: &[f32], largest: &mut f32)
        = each_ratio_lanes, Avx2, each_ratio_scalar
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
/// the nearest point of the sphere; none if no lane moves. `radius` is in [m].
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

#[inline(always)]
fn single_ratio_lanes<S: Simd>(
    s: S,
    [x, y, z]: [&[f32]; 3],
    pin: [f32; 3],
    length: &[f32],
    largest: &mut f32,
) {
    let mut ratio = s.splat(*largest);
    let pins = [s.splat(pin[0]), s.splat(pin[1]), s.splat(pin[2])];
    let count = length.len();
    let (x, y, z) = (&x[..count], &y[..count], &z[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let x = [s.load(x, at), s.load(y, at), s.load(z, at)];
        ratio = squared_ratio(x, pins, s.load(length, at)).max(ratio);
        at += S::LANES;
    }
    *largest = max_lane(s, ratio);
    single_ratio_scalar([&x[at..], &y[at..], &z[at..]], pin, &length[at..], largest);
}

fn single_ratio_scalar([x, y, z]: [&[f32]; 3], pin: [f32; 3], length: &[f32], largest: &mut f32) {
    for (((x, y), z), length) in x.iter().zip(y).zip(z).zip(length) {
        *largest = max(squared_ratio([*x, *y, *z], pin, *length), *largest);
    }
}

#[inline(always)]
fn each_ratio_lanes<S: Simd>(
    s: S,
    [x, y, z]: [&[f32]; 3],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    largest: &mut f32,
) {
    let mut ratio = s.splat(*largest);
    let count = length.len();
    let (x, y, z) = (&x[..count], &y[..count], &z[..count]);
    let (px, py, pz) = (&px[..count], &py[..count], &pz[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let x = [s.load(x, at), s.load(y, at), s.load(z, at)];
        let pins = [s.load(px, at), s.load(py, at), s.load(pz, at)];
        ratio = squared_ratio(x, pins, s.load(length, at)).max(ratio);
        at += S::LANES;
    }
    *largest = max_lane(s, ratio);
    let pins = [&px[at..], &py[at..], &pz[at..]];
    each_ratio_scalar([&x[at..], &y[at..], &z[at..]], pins, &length[at..], largest);
}

fn each_ratio_scalar(
    [x, y, z]: [&[f32]; 3],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    largest: &mut f32,
) {
    let pins = px.iter().zip(py).zip(pz);
    for ((((x, y), z), ((px, py), pz)), length) in x.iter().zip(y).zip(z).zip(pins).zip(length) {
        *largest = max(squared_ratio([*x, *y, *z], [*px, *py, *pz], *length), *largest);
    }
}

/// The largest number of all lanes.
#[inline(always)]
fn max_lane<S: Simd>(s: S, numbers: S::F) -> f32 {
    let mut lanes = [0.0; MAX_LANES];
    s.store(&mut lanes, 0, numbers);
    lanes.into_iter().fold(0.0, max)
}

/// The squared ratio of the distance of a particle from its pin to its geodesic distance. It is NaN
/// for a pin itself, 0 / 0, which `max` ignores.
#[inline(always)]
fn squared_ratio<F: Float>(x: [F; 3], pin: [F; 3], length: F) -> F {
    let [dx, dy, dz] = [x[0] - pin[0], x[1] - pin[1], x[2] - pin[2]];
    (dx * dx + dy * dy + dz * dz) / (length * length)
}
