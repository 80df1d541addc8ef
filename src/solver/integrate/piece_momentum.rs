//! Momentum conservation of cloth in several pieces: what `momentum` does, for each piece by itself.
//!
//! ```text
//! Stretch ▶ Bend ▶ Limit      each piece keeps its momentum           begin_particle_contacts
//! particle collision          pieces that touch keep their sum        remove_internal_momentum
//! ```
//! Internal stages exchange no momentum between pieces, so each piece is corrected by itself, by the
//! rules of `momentum` for a cloth of one piece. Contacts do exchange momentum: pieces whose
//! particles touch form a group (union–find), whose total momentum stays. A group that something
//! holds is left as it is, since particle collision already conserves the sum of its pairs. Pieces
//! that are sewn together form a group too.
//!
//! Reads predicted positions, the displacement history, the particles of each piece; writes
//! positions, predicted displacements, `scratch.piece_groups`, and the scratch lists
//! `relative_wind` and `correction`.
//! Invariant: sums run over the particles in ascending order, so the bits depend neither on the SIMD
//! level nor on how the pieces came about.

use crate::math::columns::Columns;
use crate::solver::integrate::impact_momentum::{self, IMPACT};
use crate::solver::integrate::momentum::{
    self, MAX_FIXED, compute_angular_errors, fixed_particles, has_collider_impulse,
    has_corrections, may_add_spin, pivot,
};
use crate::solver::integrate::momentum_sums::PointSums;
use crate::solver::integrate::rigid_motion::{Pivot, RigidMotion};
use crate::solver::self_collide::particle_contacts;
use crate::solver::stretch::sewn_pairs;
use crate::solver::world::World;
use crate::state::pins::Pin;
use glam::{DVec3, Vec3};

/// Before particle collision: removes the momentum that internal stages added to each piece since
/// prediction, and joins the pieces that will exchange momentum.
pub(crate) fn begin_particle_contacts(world: &mut World) {
    if world.pieces < 2 {
        return;
    }
    let is_sewn = !world.sewing.is_empty();
    if is_sewn {
        world.scratch.piece_groups.reset(world.pieces);
        sewn_pairs::join_sewn_pieces(world);
    }
    if world.scratch.particle_collision.is_none() {
        return;
    }
    if is_sewn && world.scratch.piece_groups.has_joined {
        remove_from_groups(world, Rounding::Corrected);
    } else {
        remove_from_pieces(world, Rounding::Corrected);
    }
    particle_contacts::join_touching_pieces(world);
    sewn_pairs::join_sewn_pieces(world);
}

/// After particle collision: removes the momentum that the corrections since prediction added to
/// each piece, or to each group of pieces that touch.
pub(crate) fn remove_internal_momentum(world: &mut World) {
    if world.pieces == 1 {
        momentum::remove_internal_momentum(world);
    } else if (world.scratch.particle_collision.is_some() || !world.sewing.is_empty())
        && world.scratch.piece_groups.has_joined
    {
        remove_from_groups(world, Rounding::Exact);
    } else {
        remove_from_pieces(world, Rounding::Exact);
    }
}

/// Starts the phase after the last substep: stores the velocities. `collide::begin_last_phase` stores
/// the positions.
pub(crate) fn begin_last_phase(world: &mut World) {
    world.scratch.correction.copy_from(&world.particles.v);
    world.scratch.rests_on_collider = impact_momentum::rests(world);
}

/// Ends the phase after the last substep: gives each free piece the momentum and the angular momentum
/// back that it had before. Hard constraints move particles without a force, and what a collider
/// gave to a few particles belongs to the whole piece. Where colliders push the centre of mass off its
/// path, the angular momentum about it stays, and they get the rest as an angular impulse.
pub(crate) fn end_last_phase(world: &mut World) {
    if world.pins.has_soft() || !world.anchors.is_empty() {
        return;
    }
    let h = world.regular_scheme().h;
    let is_pushed = has_collider_impulse(world);
    let (p, scratch) = (&mut world.particles, &world.scratch);
    let (x, v) = (&scratch.predicted, &scratch.correction);
    if p.x == *x && p.v == *v {
        return;
    }
    let mut torques = DVec3::ZERO;
    let pushes: f32 = world.colliders.iter().map(|body| body.impulse.linear.length()).sum();
    let pull = world.settings.gravity.length() * world.settings.tick;
    for piece in scratch.pieces.members.iter() {
        let particles = || piece.iter().map(|i| *i as usize);
        if particles().any(|i| p.w[i] <= 0.0) {
            continue;
        }
        let sums = |x: &Columns, v: &Columns| PointSums::of_columns(piece, x, v, &p.mass);
        let (mut before, now) = (sums(x, v), sums(&p.x, &p.v));
        if scratch.rests_on_collider && pushes <= IMPACT * before.mass as f32 * pull {
            // Cloth that rests is pushed a little in every tick; that must not turn it.
            before = sums(&p.x, v);
        }
        if is_pushed {
            let shift = now.mean_position() - before.mean_position();
            let torque = shift.cross(before.momentum);
            before.spin += torque;
            torques += torque;
        }
        let motion = RigidMotion::between(&before, &now, (piece, &p.x, &p.mass));
        for i in particles() {
            p.add_velocity(i, motion.displacement_at(p.x.get(i)), h);
        }
    }
    let pusher = scratch.contacts.first_pusher;
    if let Some(body) = world.colliders.iter_mut().nth(pusher) {
        body.impulse.angular -= torques.as_vec3();
    }
}

/// How velocities count the rounding of positions that a correction causes.
#[derive(Clone, Copy, Debug)]
enum Rounding {
    /// As part of the corrections of the substep, which the last correction removes.
    Corrected,
    /// Not at all: the predicted displacement takes it.
    Exact,
}

#[inline(never)]
fn remove_from_pieces(world: &mut World, rounding: Rounding) {
    if !has_corrections(world) {
        return;
    }
    compute_angular_errors(world);
    let is_pushed = has_collider_impulse(world);
    let members = core::mem::take(&mut world.scratch.pieces.members);
    for piece in members.iter() {
        remove_from(world, piece, MAX_FIXED, is_pushed, rounding);
    }
    world.scratch.pieces.members = members;
}

#[inline(never)]
fn remove_from_groups(world: &mut World, rounding: Rounding) {
    if !has_corrections(world) {
        return;
    }
    compute_angular_errors(world);
    let is_pushed = has_collider_impulse(world);
    let members = core::mem::take(&mut world.scratch.pieces.members);
    let mut groups = core::mem::take(&mut world.scratch.piece_groups);
    groups.sort(&world.mesh, &world.scratch.pieces.label);
    for (group, piece) in groups.members.iter().zip(members.iter()) {
        let is_joined = group.len() > piece.len();
        let max_fixed = if is_joined { 0 } else { MAX_FIXED };
        remove_from(world, group, max_fixed, is_pushed, rounding);
    }
    world.scratch.pieces.members = members;
    world.scratch.piece_groups = groups;
}

/// Removes the momentum that the corrections since prediction added to some particles, unless more
/// than `max_fixed` of them are fixed. `is_pushed`: whether a collider may push them. The middles and
/// errors of `compute_angular_errors` are in `relative_wind` and `correction`.
fn remove_from(
    world: &mut World,
    particles: &[u32],
    max_fixed: usize,
    is_pushed: bool,
    rounding: Rounding,
) {
    let all = || particles.iter().map(|i| *i as usize);
    let (p, scratch) = (&world.particles, &world.scratch);
    let (fixed, count) = fixed_particles(all(), &p.w);
    let correction = |i: usize| p.x.get(i) - scratch.predicted.get(i);
    if count > max_fixed
        || has_soft_pin(world, particles)
        || all().all(|i| correction(i) == Vec3::ZERO)
    {
        return;
    }
    let free = || all().filter(|i| p.w[*i] > 0.0);
    if is_pushed {
        if count == 0 && may_add_spin(world) {
            let scheme = world.scheme();
            let share = scheme.old_weight / scheme.new_weight;
            let motion = RigidMotion::of_points(&|add| {
                free()
                    .for_each(|i| add(velocity_origin(world, i, share), correction(i), p.mass[i]));
            });
            subtract(world, particles, rounding, |world, i| {
                motion.displacement_at(world.particles.x.get(i))
            });
        }
        return;
    }
    let pivot = pivot(p, fixed, count);
    let translation = match pivot {
        Pivot::Nothing => mean(free().map(|i| (correction(i), p.mass[i]))),
        Pivot::Point(_) | Pivot::Axis(..) => Vec3::ZERO,
    };
    let (middles, errors) = (&scratch.relative_wind, &scratch.correction);
    let motion = RigidMotion::of_points_about(
        &|add| free().for_each(|i| add(middles.get(i), errors.get(i), p.mass[i])),
        pivot,
    )
    .with_translation(translation);
    subtract(world, particles, rounding, |world, i| {
        motion.displacement_at(world.scratch.relative_wind.get(i))
    });
}

/// Whether a soft pin holds any of some particles.
fn has_soft_pin(world: &World, particles: &[u32]) -> bool {
    world.pins.has_soft() && particles.iter().any(|i| world.pins.get(*i).is_some_and(Pin::is_soft))
}

/// The position that the velocity of a particle counts from: predicted − displacement + last
/// displacement · `share` [m], where `share` is old weight / new weight.
fn velocity_origin(world: &World, i: usize, share: f32) -> Vec3 {
    let scratch = &world.scratch;
    let last = world.particles.displacement.get(i) * share;
    scratch.predicted.get(i) - scratch.displacement.get(i) + last
}

/// The mean of vectors by mass.
fn mean(vectors: impl Iterator<Item = (Vec3, f32)>) -> Vec3 {
    let (sum, total) = vectors.fold((Vec3::ZERO, 0.0), |(sum, total), (vector, mass)| {
        (sum + vector * mass, total + mass)
    });
    if total > 0.0 { sum * (1.0 / total) } else { Vec3::ZERO }
}

/// Subtracts displacements [m] from the free ones of some particles.
fn subtract(
    world: &mut World,
    particles: &[u32],
    rounding: Rounding,
    by: impl Fn(&World, usize) -> Vec3,
) {
    let share = world.correction_share();
    for i in particles.iter().map(|i| *i as usize) {
        if world.particles.w[i] > 0.0 {
            let (before, by) = (world.particles.x.get(i), by(world, i));
            let after = before - by;
            world.particles.x.set(i, after);
            if matches!(rounding, Rounding::Exact) {
                world.scratch.displacement.add(i, ((after - before) + by) * -share);
            }
        }
    }
}
