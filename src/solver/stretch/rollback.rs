//! Rollback positions for the strain limit: the positions of the last tick, moved along with the
//! rigid motion of each piece.
//!
//! The lengths of all links were within `max_stretch` at the end of the last tick. A rigid motion
//! changes no length, so a piece that returns to
//!
//! ```text
//! held piece, held by an attachment    x = T_now T_last⁻¹ x_last        T: frame of the attachment
//! held piece, otherwise                x = x_last + mean displacement of all held particles
//! free piece with anchors              x = R x_last + t, fitted to the motion of its anchors
//! free piece                           x = R x_last + t, fitted to its own motion (mass-weighted)
//! ```
//! satisfies the limit again. So a free piece keeps flying, falling and spinning. Pieces that are
//! sewn together count as one.
//!
//! Reads `particles`, pins, grabs, attachments, anchors, the piece of each triangle; writes
//! `scratch.rollback`. Invariant: held particles (w = 0) roll back to where they are now, so that
//! the rollback does not move them.

use crate::geometry::transform::Transform;
use crate::solver::integrate::rigid_motion::RigidMotion;
use crate::solver::stretch::sewn_pairs;
use crate::solver::world::World;
use glam::Vec3;

/// Computes the rollback position of every particle.
pub(crate) fn compute(world: &mut World) {
    let mut positions = core::mem::take(&mut world.scratch.rollback.positions);
    let is_grouped = sewn_pairs::group_sewn_pieces(world);
    let (p, shift) = (&world.particles, mean_held_displacement(world));
    positions.copy_from(&p.x);
    let (pieces, groups) = (&world.scratch.pieces.members, &world.scratch.piece_groups.members);
    for piece in if is_grouped { groups } else { pieces }.iter().filter(|piece| !piece.is_empty()) {
        let particles = || piece.iter().map(|i| *i as usize);
        if particles().any(|i| p.w[i] <= 0.0) {
            let free = particles().filter(|i| p.w[*i] > 0.0);
            match attachment_frames(world, particles()) {
                Some([last, next]) => {
                    free.for_each(|i| {
                        let local = last.point_to_local(p.x_prev_tick.get(i));
                        positions.set(i, next.point_to_world(local));
                    });
                }
                None => free.for_each(|i| positions.set(i, p.x_prev_tick.get(i) + shift)),
            }
        } else {
            let displacement = |i: usize| p.x.get(i) - p.x_prev_tick.get(i);
            let anchors = || particles().filter_map(|i| world.anchors.get(i as u32));
            let motion = if anchors().next().is_some() {
                RigidMotion::of_points(&|add| {
                    anchors().for_each(|anchor| add(anchor.from, anchor.anchor - anchor.from, 1.0));
                })
            } else {
                RigidMotion::fit(particles, &p.x_prev_tick, displacement, &p.mass)
            };
            particles().for_each(|i| positions.set(i, motion.transform(p.x_prev_tick.get(i))));
        }
    }
    world.scratch.rollback.positions = positions;
}

/// The last and the current frame of the attachment that holds the first attached particle of a
/// piece, if an attachment holds one.
fn attachment_frames(
    world: &World,
    mut particles: impl Iterator<Item = usize>,
) -> Option<[Transform; 2]> {
    if world.pins.iter().all(|pin| pin.attachment == 0) {
        return None;
    }
    let pin = particles.find_map(|i| {
        let pin = world.pins.get(i as u32)?;
        (pin.attachment != 0 && !pin.is_soft()).then_some(pin)
    })?;
    let motion = world.attachments.get(pin.attachment, "attachment").ok()?;
    Some([motion.last.to_transform(), motion.next.to_transform()])
}

/// The mean displacement of pinned and grabbed particles in this tick [m]; zero if there are none.
fn mean_held_displacement(world: &World) -> Vec3 {
    let p = &world.particles;
    let (mut sum, mut count) = (Vec3::ZERO, 0.0);
    for i in (0..p.len()).filter(|i| p.w[*i] <= 0.0) {
        sum += p.x.get(i) - p.x_prev_tick.get(i);
        count += 1.0;
    }
    if count > 0.0 { sum * (1.0 / count) } else { Vec3::ZERO }
}
