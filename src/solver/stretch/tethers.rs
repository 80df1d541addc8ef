//! Stage `Tethers`: no particle gets farther from a pin than its way along the cloth.

// Where there are no vectors, all goes number by number.
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

/// What tethers of soft links give at least.
const LEAST_SLACK: f32 = 0.005;

/// How fast what was held apart is drawn in once nothing holds it, in lengths of the way a second.
const DRAW_IN: f32 = 2.0;

/// By how much the load may exceed the cloth's own weight on a strip.
const SAFETY: f32 = 4.0;

/// Looks up where the pins are, after they moved.
pub(crate) fn look(world: &mut World) {
    let [x, y, z] = world.particles.x.all();
    let (y, z) = (&y[..x.len()], &z[..x.len()]);
    for set in world.tethers.sets().iter().filter(|set| set.single_pin.is_none()) {
        let found = &mut world.scratch.tether_anchor;
        found.resize(set.pin.len());
        let [to_x, to_y, to_z] = found.all_mut();
        for (((anchor, to_x), to_y), to_z) in set.pin.iter().zip(to_x).zip(to_y).zip(to_z) {
            let at = *anchor as usize;
            (*to_x, *to_y, *to_z) = (x[at], y[at], z[at]);
        }
    }
}

/// Pulls every particle within reach of the pins it is tethered to.
pub(crate) fn solve(world: &mut World) {
    draw_in(world, world.tether_slack);
}

/// How much farther than along the cloth at rest a particle may get, as a factor: so much that
/// tethers bear what the sweeps have not got to, and nothing of what the cloth really stretches by.
///
/// Cloth that was held apart is drawn in little by little: at once would fling it.
pub(crate) fn measure_slack(world: &mut World) {
    look(world);
    let apart = held_apart(world);
    let own = 1.0 + stretch_of_own_weight(world);
    let now = min(world.tether_slack, farthest(world));
    let eased = now - DRAW_IN * world.settings.tick;
    world.tether_slack = max(eased, max(apart, own));
}

/// How far the cloth is from its pins now: the distance over the way, at most.
fn farthest(world: &World) -> f32 {
    let (level, x) = (world.level, world.particles.x.all());
    let mut most = 0.0;
    for set in world.tethers.sets() {
        match set.single_pin {
            Some(pin) => {
                let pin = world.particles.x.at(pin as usize).to_array();
                farthest_from_one(level, x, pin, &set.length, &mut most);
            }
            None => {
                farthest_from_many(
                    level,
                    x,
                    world.scratch.tether_anchor.all(),
                    &set.length,
                    &mut most,
                );
            }
        }
    }
    most.sqrt()
}

/// More than the load of gravity stretches the cloth by; nothing where links are rigid.
///
/// A strip of length L hangs with a strain of σ g L / K at its top; folds and wind may add to that.
fn stretch_of_own_weight(world: &World) -> f32 {
    let material = &world.material;
    let (weft, warp) = (material.stretch_stiffness_weft, material.stretch_stiffness_warp);
    let softest = if weft > 0.0 && (warp == 0.0 || weft < warp) { weft } else { warp };
    if softest == 0.0 {
        return 0.0;
    }
    let sets = world.tethers.sets().iter().flat_map(|set| &set.length);
    let longest = sets.fold(0.0, |most: f32, l| if l.is_finite() { max(*l, most) } else { most });
    let [_, heaviest] = world.mass_scales.range();
    let load = material.density * world.settings.gravity.length() * heaviest;
    let strain = load * longest / softest;
    let own = LEAST_SLACK + SAFETY * strain;
    let bound = world.settings.max_stretch;
    if bound > 0.0 && bound * 0.5 < own { bound * 0.5 } else { own }
}

/// How far pins and grabs hold the cloth apart: the distance between two of them over the way along
/// the cloth between them, at most.
fn held_apart(world: &mut World) -> f32 {
    if !world.is_pin_stretch_current {
        world.pin_stretch = pins_apart(world);
    }
    // A grab may hold a pinned particle too.
    let is_held = world.grabs.iter().next().is_some();
    let x = &world.particles.x;
    // One that moved gets to its target but for rounding, and is there a tick later.
    let rests = |pin: &Pin| {
        pin.from == pin.target && (pin.is_soft() || x.at(pin.particle as usize) == pin.target)
    };
    world.is_pin_stretch_current = !is_held && world.pins.iter().all(rests);
    let mut most = world.pin_stretch;
    for set in world.tethers.sets() {
        for held in world.grabs.iter().map(|held| held.particle as usize) {
            let (length, anchor) = (set.length[held], set.pin[held]);
            if length > 0.0 && length.is_finite() {
                most = max((x.at(held) - x.at(anchor as usize)).length() / length, most);
            }
        }
    }
    most
}

/// As `held_apart`, for pins only; at least 1.
fn pins_apart(world: &World) -> f32 {
    let x = &world.particles.x;
    let mut most = 1.0;
    let mut compare = |a: u32, b: u32, way: f32| {
        let span = x.at(b as usize) - x.at(a as usize);
        most = max(span.length() / way, most);
    };
    for set in world.tethers.sets() {
        if let Some(pin) = set.single_pin {
            let others = world.pins.hard_particles().filter(|other| *other != pin);
            let joined = others.filter(|other| set.length[*other as usize].is_finite());
            joined.for_each(|other| compare(pin, other, set.length[other as usize]));
            continue;
        }
        // Where the parts of two pins meet, a way leads from one to the other.
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
    most
}

/// Pulls every particle within `slack` times its way to the pins.
pub(crate) fn draw_in(world: &mut World, slack: f32) {
    let (level, threads, p) = (world.level, world.threads, &mut world.particles);
    let (found, interleaved) = (&world.scratch.tether_anchor, &mut world.scratch.interleaved);
    for set in world.tethers.sets() {
        if interleaved.is_current {
            pull_packed(threads, set, slack, found, interleaved);
        } else {
            pull_set(level, threads, set, slack, found, &mut p.x, &p.w);
        }
    }
}

fn pull_packed(
    threads: Threads,
    set: &TetherSet,
    slack: f32,
    found: &Columns,
    interleaved: &mut InterleavedParticles,
) {
    let InterleavedParticles { points, w, .. } = interleaved;
    let only = set.single_pin.map(|pin| points[pin as usize]);
    let particles = (&mut points[..], &w[..], &set.length[..]);
    match only {
        Some(pin) => {
            threads.parallel_for(particles, MIN_PARTICLES_PER_THREAD, |(points, w, length)| {
                packed_to_one(points, pin, length, slack, w);
            })
        }
        None => {
            threads.parallel_for(
                (particles, found.all()),
                MIN_PARTICLES_PER_THREAD,
                |((points, w, length), pins)| {
                    packed_to_many(points, pins, length, slack, w);
                },
            );
        }
    }
}

fn packed_to_one(
    points: &mut [[f32; 4]],
    [px, py, pz, _]: [f32; 4],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    for ((point, length), w) in points.iter_mut().zip(length).zip(w) {
        let [x, y, z, _] = *point;
        if let Some([x, y, z]) = within(Scalar, [x, y, z], [px, py, pz], length * slack, *w) {
            *point = [x, y, z, 0.0];
        }
    }
}

fn packed_to_many(
    points: &mut [[f32; 4]],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    let pins = px.iter().zip(py).zip(pz);
    for (((point, length), w), ((px, py), pz)) in points.iter_mut().zip(length).zip(w).zip(pins) {
        let [x, y, z, _] = *point;
        if let Some([x, y, z]) = within(Scalar, [x, y, z], [*px, *py, *pz], length * slack, *w) {
            *point = [x, y, z, 0.0];
        }
    }
}

fn pull_set(
    level: Level,
    threads: Threads,
    set: &TetherSet,
    slack: f32,
    found: &Columns,
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
                    pull_to_one(level, x, pin, length, slack, w);
                },
            );
        }
        None => {
            let particles = (x.all_mut(), found.all(), length, w);
            threads.parallel_for(particles, MIN_PARTICLES_PER_THREAD, |(x, pins, length, w)| {
                pull_to_many(level, x, pins, length, slack, w);
            });
        }
    }
}

vectored! {
    fn pull_to_one(x: [&mut [f32]; 3], pin: [f32; 3], length: &[f32], slack: f32, w: &[f32])
        = to_one, Avx512, to_one_apart
}

vectored! {
    fn pull_to_many(
        x: [&mut [f32]; 3],
        pins: [&[f32]; 3],
        length: &[f32],
        slack: f32,
        w: &[f32],
    ) = to_many, Avx512, to_many_apart
}

vectored! {
    /// The square of how far a particle is from its pin over the way, if that is more than `most`.
    fn farthest_from_one(x: [&[f32]; 3], pin: [f32; 3], length: &[f32], most: &mut f32)
        = from_one, Avx2, from_one_apart
}

vectored! {
    fn farthest_from_many(x: [&[f32]; 3], pins: [&[f32]; 3], length: &[f32], most: &mut f32)
        = from_many, Avx2, from_many_apart
}

#[inline(always)]
fn to_one<S: Simd>(
    s: S,
    [x, y, z]: [&mut [f32]; 3],
    pin: [f32; 3],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    let pins = [s.splat(pin[0]), s.splat(pin[1]), s.splat(pin[2])];
    // One length for all, so that one check does.
    let count = length.len();
    let (x, y, z, w) = (&mut x[..count], &mut y[..count], &mut z[..count], &w[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let reach = s.load(length, at) * s.splat(slack);
        let from = [s.load(x, at), s.load(y, at), s.load(z, at)];
        if let Some(near) = within(s, from, pins, reach, s.load(w, at)) {
            s.store(x, at, near[0]);
            s.store(y, at, near[1]);
            s.store(z, at, near[2]);
        }
        at += S::LANES;
    }
    let x = [&mut x[at..], &mut y[at..], &mut z[at..]];
    to_one_apart(x, pin, &length[at..], slack, &w[at..]);
}

fn to_one_apart([x, y, z]: [&mut [f32]; 3], pin: [f32; 3], length: &[f32], slack: f32, w: &[f32]) {
    let particles = x.iter_mut().zip(y).zip(z);
    for ((((x, y), z), length), w) in particles.zip(length).zip(w) {
        if let Some(near) = within(Scalar, [*x, *y, *z], pin, length * slack, *w) {
            [*x, *y, *z] = near;
        }
    }
}

#[inline(always)]
fn to_many<S: Simd>(
    s: S,
    [x, y, z]: [&mut [f32]; 3],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    // As in `to_one`.
    let count = length.len();
    let (x, y, z, w) = (&mut x[..count], &mut y[..count], &mut z[..count], &w[..count]);
    let (px, py, pz) = (&px[..count], &py[..count], &pz[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let pins = [s.load(px, at), s.load(py, at), s.load(pz, at)];
        let reach = s.load(length, at) * s.splat(slack);
        let from = [s.load(x, at), s.load(y, at), s.load(z, at)];
        if let Some(near) = within(s, from, pins, reach, s.load(w, at)) {
            s.store(x, at, near[0]);
            s.store(y, at, near[1]);
            s.store(z, at, near[2]);
        }
        at += S::LANES;
    }
    let (x, pins) = ([&mut x[at..], &mut y[at..], &mut z[at..]], [&px[at..], &py[at..], &pz[at..]]);
    to_many_apart(x, pins, &length[at..], slack, &w[at..]);
}

fn to_many_apart(
    [x, y, z]: [&mut [f32]; 3],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    let particles = x.iter_mut().zip(y).zip(z);
    let pins = px.iter().zip(py).zip(pz);
    for (((((x, y), z), ((px, py), pz)), length), w) in particles.zip(pins).zip(length).zip(w) {
        if let Some(near) = within(Scalar, [*x, *y, *z], [*px, *py, *pz], length * slack, *w) {
            [*x, *y, *z] = near;
        }
    }
}

/// `x` where it is held or within `reach` of `pin`, else as far towards it as that; nothing if all
/// are where they may be.
#[inline(always)]
pub(crate) fn within<S: Simd>(
    s: S,
    x: [S::F; 3],
    pin: [S::F; 3],
    reach: S::F,
    w: S::F,
) -> Option<[S::F; 3]> {
    let [dx, dy, dz] = [x[0] - pin[0], x[1] - pin[1], x[2] - pin[2]];
    let length2 = dx * dx + dy * dy + dz * dz;
    let is_far = (length2 - reach * reach).min(w);
    if !s.any_positive(is_far) {
        return None;
    }
    let share = reach / length2.sqrt();
    Some([
        s.select(is_far, pin[0] + dx * share, x[0]),
        s.select(is_far, pin[1] + dy * share, x[1]),
        s.select(is_far, pin[2] + dz * share, x[2]),
    ])
}

#[inline(always)]
fn from_one<S: Simd>(s: S, [x, y, z]: [&[f32]; 3], pin: [f32; 3], length: &[f32], most: &mut f32) {
    let mut far = s.splat(*most);
    let pins = [s.splat(pin[0]), s.splat(pin[1]), s.splat(pin[2])];
    let count = length.len();
    let (x, y, z) = (&x[..count], &y[..count], &z[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let x = [s.load(x, at), s.load(y, at), s.load(z, at)];
        far = ratio2(x, pins, s.load(length, at)).max(far);
        at += S::LANES;
    }
    *most = greatest(s, far);
    from_one_apart([&x[at..], &y[at..], &z[at..]], pin, &length[at..], most);
}

fn from_one_apart([x, y, z]: [&[f32]; 3], pin: [f32; 3], length: &[f32], most: &mut f32) {
    for (((x, y), z), length) in x.iter().zip(y).zip(z).zip(length) {
        *most = max(ratio2([*x, *y, *z], pin, *length), *most);
    }
}

#[inline(always)]
fn from_many<S: Simd>(
    s: S,
    [x, y, z]: [&[f32]; 3],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    most: &mut f32,
) {
    let mut far = s.splat(*most);
    let count = length.len();
    let (x, y, z) = (&x[..count], &y[..count], &z[..count]);
    let (px, py, pz) = (&px[..count], &py[..count], &pz[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let x = [s.load(x, at), s.load(y, at), s.load(z, at)];
        let pins = [s.load(px, at), s.load(py, at), s.load(pz, at)];
        far = ratio2(x, pins, s.load(length, at)).max(far);
        at += S::LANES;
    }
    *most = greatest(s, far);
    let pins = [&px[at..], &py[at..], &pz[at..]];
    from_many_apart([&x[at..], &y[at..], &z[at..]], pins, &length[at..], most);
}

fn from_many_apart(
    [x, y, z]: [&[f32]; 3],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    most: &mut f32,
) {
    let pins = px.iter().zip(py).zip(pz);
    for ((((x, y), z), ((px, py), pz)), length) in x.iter().zip(y).zip(z).zip(pins).zip(length) {
        *most = max(ratio2([*x, *y, *z], [*px, *py, *pz], *length), *most);
    }
}

/// The greatest number of all lanes.
#[inline(always)]
fn greatest<S: Simd>(s: S, numbers: S::F) -> f32 {
    let mut lanes = [0.0; MAX_LANES];
    s.store(&mut lanes, 0, numbers);
    lanes.into_iter().fold(0.0, max)
}

/// The square of how far a particle is from its pin over the way. A pin is no way from itself,
/// which is no number here, and counts for nothing.
#[inline(always)]
fn ratio2<F: Float>(x: [F; 3], pin: [F; 3], length: F) -> F {
    let [dx, dy, dz] = [x[0] - pin[0], x[1] - pin[1], x[2] - pin[2]];
    (dx * dx + dy * dy + dz * dz) / (length * length)
}
