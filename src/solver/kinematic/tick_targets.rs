//! Tick targets: divides the motion of kinematic targets evenly over the ticks of an `advance`.
//!
//! ```text
//! pose     last ─ ─ ─ ○ ─ ─ ─ ○ ─ ─ ─ ● final pose, set by the host
//! tick           1       2       3       step k of n covers 1 / (n − k + 1) of the remaining way
//! ```
//! A host sets poses once per frame, and a frame runs some number of ticks. If the first tick took
//! the whole motion, held particles would stop in the others, and the cloth would jerk. Fixed time
//! steps in games interpolate kinematic bodies for the same reason (Fiedler, "Fix Your Timestep!",
//! 2004). Positions move linearly and rotations at constant angular velocity.
//!
//! Reads and writes pins, attachments, grabs, anchors and colliders: their poses at the end of the
//! next tick, and the final poses. Invariant: the last tick ends exactly at the poses that the host
//! set, and a pose at rest keeps its bits. With one tick nothing here runs.

use crate::math::saturate;
use crate::solver::world::World;
use crate::state::anchors::unit_or_zero;
use glam::Vec3;

/// Stores the poses that the host set as the final poses, before the first tick of an `advance`.
pub(crate) fn store_final(world: &mut World) {
    world.pins.iter_mut().for_each(|pin| pin.final_target = pin.target);
    world.attachments.iter_mut().for_each(|motion| motion.final_pose = motion.next);
    world.grabs.iter_mut().for_each(|grab| grab.final_target = grab.target);
    world.anchors.iter_mut().for_each(|a| a.final_anchor = [a.anchor, a.normal]);
    world.colliders.iter_mut().for_each(|body| body.final_pose = body.next);
}

/// Sets the poses at the end of the next tick, with `ticks_left` ticks of the `advance` to run, the
/// next one included.
pub(crate) fn update(world: &mut World, ticks_left: u32) {
    let share = 1.0 / ticks_left as f32;
    for motion in world.attachments.iter_mut() {
        motion.next = motion.last.first_step(&motion.final_pose, ticks_left);
        motion.offset_left = 1.0 - share;
    }
    for pin in world.pins.iter_mut() {
        let motion = world.attachments.get(pin.attachment, "attachment").ok();
        pin.target = match motion.filter(|motion| ticks_left > 1 && motion.last != motion.next) {
            Some(motion) => {
                let [last, next] = [motion.last, motion.next]
                    .map(|pose| pose.to_transform().point_to_world(pin.local));
                saturate(next + (pin.from - last) * motion.offset_left)
            }
            None => first_step(pin.from, pin.final_target, ticks_left),
        };
    }
    for grab in world.grabs.iter_mut() {
        let x = world.particles.x.get(grab.particle as usize);
        grab.target = first_step(x, grab.final_target, ticks_left);
    }
    for anchor in world.anchors.iter_mut() {
        let [position, normal] = anchor.final_anchor;
        anchor.anchor = first_step(anchor.from, position, ticks_left);
        let is_turning = ticks_left > 1 && anchor.normal_from != normal;
        anchor.normal = if is_turning {
            unit_or_zero(anchor.normal_from + (normal - anchor.normal_from) * share)
        } else {
            normal
        };
    }
    for body in world.colliders.iter_mut() {
        body.next = body.last.first_step(&body.final_pose, ticks_left);
        if let Some(deformation) = body.deformation_mut() {
            deformation.first_step(ticks_left);
        }
    }
}

/// The point after the first of `count` equal steps from `from` to `end`: exactly `end` if `count`
/// is 1 or both are equal.
fn first_step(from: Vec3, end: Vec3, count: u32) -> Vec3 {
    if count == 1 || from == end {
        return end;
    }
    saturate(from + (end - from) * (1.0 / count as f32))
}
