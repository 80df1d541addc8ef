//! Stage `Guard`: particles with invalid numbers return to their position one tick ago.
//!
//! Method: a number is invalid if it is NaN, infinite or beyond `MAX_COORDINATE`. Such a particle
//! gets its last position, velocity zero and the history of free fall.
//!
//! Reads and writes position, history and velocities of particles; writes one event `Recovered`.
//! Invariant: after this stage every position, velocity and history is finite.

use crate::math::simd::leveled;
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use crate::state::events::EventKind;
use core::sync::atomic::{AtomicBool, Ordering};
use glam::Vec3;

/// Largest valid coordinate, relative to the origin [m]. The cloth is near its origin at any speed
/// below this per tick.
const MAX_COORDINATE: f32 = 1.0e6;

/// Restores all invalid particles, and pushes one event with their number if there are any.
pub(crate) fn restore_invalid(world: &mut World) {
    if is_all_valid(world) {
        return;
    }
    let (h, gravity) = (world.regular_scheme().h, world.settings.gravity);
    let p = &mut world.particles;
    let (mut restored, mut first) = (0, Vec3::ZERO);
    for i in 0..p.len() {
        let is_valid = [&p.x, &p.displacement, &p.v, &p.v_extrapolated]
            .iter()
            .all(|columns| is_valid_vector(columns.get(i)));
        if is_valid {
            continue;
        }
        let last = p.x_prev_tick.get(i);
        if restored == 0 {
            first = last;
        }
        restored += 1;
        p.set_motion(i, last, Vec3::ZERO, gravity, h);
    }
    if restored > 0 {
        let mut event = world.event_at(EventKind::Recovered, first);
        event.count = restored;
        world.events.push(event);
    }
}

/// Returns whether all positions are valid numbers.
pub(crate) fn are_positions_valid(world: &World) -> bool {
    let mut all_valid = true;
    for column in world.particles.x.slices() {
        check_column(world.level, column, &mut all_valid);
    }
    all_valid
}

fn is_all_valid(world: &World) -> bool {
    let (level, p) = (world.level, &world.particles);
    let is_one_invalid = AtomicBool::new(false);
    let columns = (p.x.slices(), p.displacement.slices(), p.v.slices(), p.v_extrapolated.slices());
    world.threads.parallel_for(columns, MIN_PARTICLES_PER_THREAD, |(x, moved, v, v_ahead)| {
        let mut all_valid = true;
        for column in [x, moved, v, v_ahead].into_iter().flatten() {
            check_column(level, column, &mut all_valid);
        }
        if !all_valid {
            is_one_invalid.store(true, Ordering::Relaxed);
        }
    });
    !is_one_invalid.into_inner()
}

leveled! {
    /// Clears `all_valid` if a number of the column is invalid.
    fn check_column(column: &[f32], all_valid: &mut bool) = check_column_lanes
}

#[inline(always)]
fn check_column_lanes(column: &[f32], all_valid: &mut bool) {
    let mut is_valid = *all_valid;
    for c in column {
        is_valid &= is_valid_number(*c);
    }
    *all_valid = is_valid;
}

fn is_valid_vector(v: Vec3) -> bool {
    is_valid_number(v.x) && is_valid_number(v.y) && is_valid_number(v.z)
}

#[inline(always)]
fn is_valid_number(c: f32) -> bool {
    c > -MAX_COORDINATE && c < MAX_COORDINATE
}
