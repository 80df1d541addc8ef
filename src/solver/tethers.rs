//! Stage `Tethers`: no particle gets farther from a pin than its way along the cloth.

use super::packed::Packed;
use super::{PARTICLES, World};
use crate::fabric::tethers::TetherSet;
use crate::math::columns::Columns;
use crate::math::simd::{LANES, Level, leveled};
use crate::math::threads::Threads;
use crate::math::{max, min};
use crate::state::pins::Pin;

/// What tethers of soft links give at least.
const LEAST_SLACK: f32 = 0.005;

/// How fast what was held apart is drawn in once nothing holds it, in lengths of the way a second.
const DRAW_IN: f32 = 2.0;

/// By how much the load may exceed the cloth's own weight on a strip.
const SAFETY: f32 = 4.0;

/// Looks up where the pins are, after they moved.
pub(crate) fn look(world: &mut World) {
    let x = &world.particles.x;
    for set in world.tethers.sets().iter().filter(|set| set.only.is_none()) {
        let found = &mut world.scratch.anchor;
        for (to, from) in [(&mut found.x, &x.x), (&mut found.y, &x.y), (&mut found.z, &x.z)] {
            to.clear();
            to.extend(set.anchor.iter().map(|anchor| from[*anchor as usize]));
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
    let (level, x) = (world.level, &world.particles.x);
    let mut most = 0.0;
    for set in world.tethers.sets() {
        match set.only {
            Some(pin) => {
                let pin = x.at(pin as usize).to_array();
                farthest_from_one(level, x, pin, &set.length, &mut most);
            }
            None => farthest_from_many(level, x, &world.scratch.anchor, &set.length, &mut most),
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
    if !world.is_apart_current {
        world.apart = pins_apart(world);
    }
    // A grab may hold a pinned particle too.
    let is_held = world.grabs.iter().next().is_some();
    let x = &world.particles.x;
    // One that moved gets to its target but for rounding, and is there a tick later.
    let rests = |pin: &Pin| {
        pin.from == pin.target && (pin.is_soft() || x.at(pin.particle as usize) == pin.target)
    };
    world.is_apart_current = !is_held && world.pins.iter().all(rests);
    let mut most = world.apart;
    for set in world.tethers.sets() {
        for held in world.grabs.iter().map(|held| held.particle as usize) {
            let (length, anchor) = (set.length[held], set.anchor[held]);
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
        if let Some(pin) = set.only {
            let others = world.pins.hard().filter(|other| *other != pin);
            let joined = others.filter(|other| set.length[*other as usize].is_finite());
            joined.for_each(|other| compare(pin, other, set.length[other as usize]));
            continue;
        }
        // Where the parts of two pins meet, a way leads from one to the other.
        for triangle in &world.mesh.triangles {
            let [a, b, c] = triangle.map(|v| v as usize);
            for (p, q) in [(a, b), (b, c), (c, a)] {
                let (from, to) = (set.anchor[p], set.anchor[q]);
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
    let (found, packed) = (&world.scratch.anchor, &mut world.scratch.packed);
    for set in world.tethers.sets() {
        if packed.is_current {
            pull_packed(threads, set, slack, found, packed);
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
    packed: &mut Packed,
) {
    let Packed { points, w, .. } = packed;
    let only = set.only.map(|pin| points[pin as usize]);
    let particles = (&mut points[..], &w[..], &set.length[..]);
    match only {
        Some(pin) => threads.over(particles, PARTICLES, |(points, w, length)| {
            packed_to_one(points, pin, length, slack, w);
        }),
        None => {
            threads.over((particles, found.all()), PARTICLES, |((points, w, length), pins)| {
                packed_to_many(points, pins, length, slack, w);
            });
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
        let [x, y, z] = within([x, y, z], [px, py, pz], length * slack, *w);
        *point = [x, y, z, 0.0];
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
        let [x, y, z] = within([x, y, z], [*px, *py, *pz], length * slack, *w);
        *point = [x, y, z, 0.0];
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
    match set.only {
        Some(pin) => {
            let pin = x.at(pin as usize).to_array();
            threads.over((x.all_mut(), length, w), PARTICLES, |(x, length, w)| {
                pull_to_one(level, x, pin, length, slack, w);
            });
        }
        None => {
            let particles = (x.all_mut(), found.all(), length, w);
            threads.over(particles, PARTICLES, |(x, pins, length, w)| {
                pull_to_many(level, x, pins, length, slack, w);
            });
        }
    }
}

leveled! {
    fn pull_to_one(x: [&mut [f32]; 3], pin: [f32; 3], length: &[f32], slack: f32, w: &[f32])
        = to_one
}

leveled! {
    fn pull_to_many(
        x: [&mut [f32]; 3],
        pins: [&[f32]; 3],
        length: &[f32],
        slack: f32,
        w: &[f32],
    ) = to_many
}

leveled! {
    fn farthest_from_one(x: &Columns, pin: [f32; 3], length: &[f32], most: &mut f32) = from_one
}

leveled! {
    fn farthest_from_many(x: &Columns, pins: &Columns, length: &[f32], most: &mut f32) = from_many
}

#[inline(always)]
fn to_one(
    [x, y, z]: [&mut [f32]; 3],
    [px, py, pz]: [f32; 3],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    let particles = x.iter_mut().zip(y).zip(z);
    for ((((x, y), z), length), w) in particles.zip(length).zip(w) {
        [*x, *y, *z] = within([*x, *y, *z], [px, py, pz], length * slack, *w);
    }
}

#[inline(always)]
fn to_many(
    [x, y, z]: [&mut [f32]; 3],
    [px, py, pz]: [&[f32]; 3],
    length: &[f32],
    slack: f32,
    w: &[f32],
) {
    let particles = x.iter_mut().zip(y).zip(z);
    let pins = px.iter().zip(py).zip(pz);
    for (((((x, y), z), ((px, py), pz)), length), w) in particles.zip(pins).zip(length).zip(w) {
        [*x, *y, *z] = within([*x, *y, *z], [*px, *py, *pz], length * slack, *w);
    }
}

/// `x` if it is held or within `reach` of `pin`, else as far towards it as that.
#[inline(always)]
fn within(x: [f32; 3], pin: [f32; 3], reach: f32, w: f32) -> [f32; 3] {
    let [dx, dy, dz] = [x[0] - pin[0], x[1] - pin[1], x[2] - pin[2]];
    let length2 = dx * dx + dy * dy + dz * dz;
    let is_far = length2 > reach * reach && w > 0.0;
    let share = reach / length2.sqrt();
    let take = |pulled: f32, x: f32| if is_far { pulled } else { x };
    [
        take(pin[0] + dx * share, x[0]),
        take(pin[1] + dy * share, x[1]),
        take(pin[2] + dz * share, x[2]),
    ]
}

#[inline(always)]
fn from_one(columns: &Columns, pin: [f32; 3], length: &[f32], most: &mut f32) {
    farthest_of(columns, |_| pin, length, most);
}

#[inline(always)]
fn from_many(columns: &Columns, pins: &Columns, length: &[f32], most: &mut f32) {
    farthest_of(columns, |i| [pins.x[i], pins.y[i], pins.z[i]], length, most);
}

/// The square of how far a particle is from its pin over the way, if that is more than `most`.
#[inline(always)]
fn farthest_of(
    Columns { x, y, z }: &Columns,
    pin: impl Fn(usize) -> [f32; 3],
    length: &[f32],
    most: &mut f32,
) {
    let (count, x) = (length.len(), [&x[..], &y[..], &z[..]]);
    let mut lanes = [*most; LANES];
    let whole = count / LANES * LANES;
    for first in (0..whole).step_by(LANES) {
        for lane in 0..LANES {
            // A pin is no way from itself, which is no number here, and does not count.
            let i = first + lane;
            lanes[lane] = max(ratio2(x, i, pin(i), length[i]), lanes[lane]);
        }
    }
    for i in whole..count {
        lanes[0] = max(ratio2(x, i, pin(i), length[i]), lanes[0]);
    }
    *most = lanes.into_iter().fold(*most, |most, ratio2| max(ratio2, most));
}

/// The square of how far a particle is from its pin over the way.
#[inline(always)]
fn ratio2([x, y, z]: [&[f32]; 3], i: usize, pin: [f32; 3], length: f32) -> f32 {
    let [dx, dy, dz] = [x[i] - pin[0], y[i] - pin[1], z[i] - pin[2]];
    (dx * dx + dy * dy + dz * dz) / (length * length)
}
