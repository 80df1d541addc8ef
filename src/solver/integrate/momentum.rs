//! A cloth of one piece that nothing holds gets no spin from keeping apart.
//!
//! ```text
//! Δ = x - predicted        Σ m (r - c) × Δ = 0        r: where velocities count from, c: the middle of all r
//! ```
//! What solves a substep moves particles along the lines between them as those are then, and velocities count
//! from where particles were: so each move has a little torque. Mostly all of these cancel, but of what presses
//! and pulls at itself, as crumpled paper does, something is left that would turn it for ever. By `Scheme` the
//! sum above is what the spin grew by, so it is turned back by that.

use crate::solver::bend;
use crate::solver::integrate::rigid_motion::{FreeParticles, RigidMotion};

use crate::solver::world::World;

/// Turns the cloth back by what its own stages turned it.
pub(crate) fn keep(world: &mut World) {
    let may_turn = world.particle_collision.is_some() || bend::may_add_spin(world);
    if !may_turn || world.pieces != 1 || is_held(world) {
        return;
    }
    list_starts(world);
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let moves = &mut scratch.tether_pins;
    moves.resize(p.len());
    let all = p.x.all().into_iter().zip(scratch.predicted.all()).zip(moves.all_mut());
    for ((x, predicted), moves) in all {
        for ((x, predicted), by) in x.iter().zip(predicted).zip(moves) {
            *by = x - predicted;
        }
    }
    let free = FreeParticles {
        x: scratch.relative_wind.all(),
        displacement: moves.all(),
        mass: &p.mass,
        w: &p.w,
    };
    let whole = RigidMotion::of_free(world.level, free);
    for i in 0..p.len() {
        p.x.add(i, -whole.displacement_at(p.x.at(i)));
    }
}

/// Whether anything else than itself may have moved it so far in this substep.
pub(crate) fn is_held(world: &World) -> bool {
    world.pins.has_soft() || world.particles.w.iter().any(|w| *w <= 0.0)
}

/// Lists where velocities count from. Air counts once in a tick, and what nothing holds has no anchors: so
/// starts are in the one and moves in the other.
pub(crate) fn list_starts(world: &mut World) {
    let scheme = world.settings.scheme();
    let back = scheme.old_weight / scheme.new_weight;
    let (p, scratch) = (&world.particles, &mut world.scratch);
    let ways = scratch.displacement.all().into_iter().zip(p.displacement.all());
    let read = scratch.predicted.all().into_iter().zip(ways);
    for ((predicted, (way, moved)), from) in read.zip(scratch.relative_wind.all_mut()) {
        let read = predicted.iter().zip(way).zip(moved);
        for (((predicted, way), moved), from) in read.zip(from.iter_mut()) {
            *from = predicted - way + moved * back;
        }
    }
}
