//! Slack of the tethers: the factor by which a particle may be farther from its pin than along the
//! cloth at rest.
//!
//! ```text
//! slack = max( min(slack, max |x − pin| / d) − 2 s⁻¹ tick,   hold stretch,   1 + ε )
//!
//! d              geodesic distance of a particle from its pin, along the cloth at rest [m]
//! hold stretch   max distance / d between two held particles, at least 1
//! ε              0 for rigid links; else 0.005 + 4 σ g L / K, at most max_stretch / 2
//! σ, L, K        largest mass per area, longest d, least stretch stiffness where it is painted
//!                least: σ g L / K is the strain at the top of a strip of length L that hangs under
//!                its own weight; pressure p in closed pieces adds p / 2 to σ g, since a sphere of
//!                radius L has p L / 2; the wind adds its greatest pressure on cloth at rest
//! ```
//! So tethers carry the load that the sweeps have not carried yet, and none of the load that really
//! stretches the cloth. A cloth that was held apart contracts at the rate of the first term,
//! because a contraction within one tick would give it a large velocity.
//!
//! Reads `tethers`, pins, grabs, positions, `material`, `maps`; writes `tether_slack` and `pin_stretch`.
//! Invariant: runs once a tick, before the substeps; the slack is at least 1.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::simd::{Float, MAX_LANES, Simd, vectored};
use crate::math::{max, min};
use crate::model::maps::Map;
use crate::solver::integrate::forces;
use crate::solver::stretch::tethers::refresh_pin_positions;
use crate::solver::world::World;
use crate::state::pins::Pin;

/// The least slack of tethers if links are compliant, beyond 1.
const MIN_SOFT_SLACK: f32 = 0.005;

/// The rate at which the slack decreases after the cloth was held apart [1/s].
const CONTRACTION_RATE: f32 = 2.0;

/// The load that tethers leave to the links, over the cloth's own weight: folds and wind add to it.
const LOAD_FACTOR: f32 = 4.0;

/// Painted scales of the stretch stiffness count as at least this.
const MIN_PAINTED_STRETCH: f32 = 1.0e-6;

/// Computes the slack of this tick by the formula of the module doc.
pub(crate) fn update(world: &mut World) {
    refresh_pin_positions(world);
    let hold_stretch = update_hold_stretch(world);
    let own = 1.0 + compute_weight_strain(world);
    let now = min(world.tether_slack, compute_max_stretch(world));
    let contracted = now - CONTRACTION_RATE * world.settings.tick;
    world.tether_slack = max(contracted, max(hold_stretch, own));
}

/// The largest distance of a particle from its pin over its geodesic distance.
fn compute_max_stretch(world: &World) -> f32 {
    let (level, x) = (world.level, world.particles.x.slices());
    let mut max_ratio2 = 0.0;
    for set in world.tethers.sets() {
        match set.single_pin {
            Some(pin) => {
                let pin = world.particles.x.get(pin as usize).to_array();
                max_ratio_to_single(level, x, pin, &set.length, &mut max_ratio2);
            }
            None => {
                max_ratio_to_each(
                    level,
                    x,
                    world.scratch.tether_pins.slices(),
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
    let [weakest, _] = world.maps.range(Map::Stretch);
    let pressure = if world.has_pressure() { world.settings.pressure.abs() } else { 0.0 };
    let load = material.density * world.settings.gravity.length() * heaviest
        + 0.5 * pressure
        + forces::greatest_wind_pressure(world);
    let strain = load * longest / (softest * max(weakest, MIN_PAINTED_STRETCH));
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
        pin.from == pin.target && (pin.is_soft() || x.get(pin.particle as usize) == pin.target)
    };
    world.is_pin_stretch_current = !is_grabbed && world.pins.iter().all(is_at_rest);
    let mut largest = world.pin_stretch;
    for set in world.tethers.sets() {
        for held in world.grabs.iter().map(|held| held.particle as usize) {
            let (length, pin) = (set.length[held], set.pin[held]);
            if length > 0.0 && length.is_finite() {
                largest = max((x.get(held) - x.get(pin as usize)).length() / length, largest);
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
        let span = x.get(b as usize) - x.get(a as usize);
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

vectored! {
    /// Raises `largest` to the largest squared ratio of distance to geodesic distance.
    fn max_ratio_to_single(x: [&[f32]; 3], pin: [f32; 3], length: &[f32], largest: &mut f32)
        = single_ratio_lanes, single_ratio_scalar
}

vectored! {
    fn max_ratio_to_each(x: [&[f32]; 3], pins: [&[f32]; 3], length: &[f32], largest: &mut f32)
        = each_ratio_lanes, each_ratio_scalar
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
