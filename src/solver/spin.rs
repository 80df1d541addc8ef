//! A cloth of one piece that nothing holds gets no spin from keeping apart.
//!
//! ```text
//! Δ = x - predicted        Σ m (r - c) × Δ = 0        r: where velocities count from, c: the middle of all r
//! ```
//! What solves a substep moves particles along the lines between them as those are then, and velocities count
//! from where particles were: so each move has a little torque. Mostly all of these cancel, but of what presses
//! and pulls at itself, as crumpled paper does, something is left that would turn it for ever. By `Scheme` the
//! sum above is what the spin grew by, so it is turned back by that.

use super::rigid::{Free, RigidMotion};
use super::{World, bend};

/// Turns the cloth back by what its own stages turned it.
pub(crate) fn keep(world: &mut World) {
    let may_turn = world.crowd.is_some() || bend::may_turn(world);
    if !may_turn || world.pieces != 1 || is_held(world) {
        return;
    }
    let scheme = world.settings.scheme();
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    // Air counts once in a tick, and what nothing holds has no anchors.
    let (from, moves) = (&mut scratch.air, &mut scratch.anchor);
    moves.resize(p.len());
    let start = p.x.all().into_iter().zip(scratch.predicted.all());
    let ways = scratch.way.all().into_iter().zip(p.moved.all());
    let write = from.all_mut().into_iter().zip(moves.all_mut());
    for (((x, predicted), (way, moved)), (from, by)) in start.zip(ways).zip(write) {
        let back = scheme.trail / scheme.lead;
        list(x, [predicted, way, moved], back, from, by);
    }
    let free = Free { x: from.all(), way: moves.all(), mass: &p.mass, w: &p.w };
    let whole = RigidMotion::of_free(world.level, free);
    for i in 0..p.len() {
        p.x.add(i, -whole.at(p.x.at(i)));
    }
}

/// Whether anything else than itself may have moved it so far in this substep.
fn is_held(world: &World) -> bool {
    world.pins.are_any_soft() || world.particles.w.iter().any(|w| *w <= 0.0)
}

/// Lists, along one axis, where velocities count from and the moves.
fn list(
    x: &[f32],
    [predicted, way, moved]: [&[f32]; 3],
    back: f32,
    from: &mut [f32],
    moves: &mut [f32],
) {
    let read = x.iter().zip(predicted).zip(way).zip(moved);
    for ((((x, predicted), way), moved), (from, by)) in read.zip(from.iter_mut().zip(moves)) {
        *from = predicted - way + moved * back;
        *by = x - predicted;
    }
}
