//! Public calls for a moving reference frame: the body that wears the cloth teleports or moves.
//!
//! A teleport applies the rigid motion `to · from⁻¹` to all state at once. `move_frame` applies
//! only the part of the motion that inertia does not cover, and leaves the rest to the tick.
//!
//! The origin moves along with a cloth that a motion takes far away, so that the motion does not
//! round positions.
//!
//! Reads the caller's poses; writes `World::reference_pose`, particles, pins, attachments, anchors
//! and grabs.
//! Invariant: nothing moves if any transformed value would not be finite.

use crate::cloth::Cloth;
use crate::error::{Result, check};
use crate::geometry::transform::Transform;
use crate::math::float_env::with_float_env;
use crate::solver::world::World;
use crate::state::origin::shift_with_cloth;
use crate::state::pose::{Pose, check_pose};
use glam::{Quat, Vec3};

/// Names of the pose arguments in error messages.
const FRAME_FIELDS: [&str; 2] = ["position", "rotation"];

impl Cloth {
    /// Sets the pose of the body that wears the cloth, the start for [`Cloth::teleport`] and
    /// [`Cloth::move_frame`]. Moves nothing.
    ///
    /// The initial pose, also after [`Cloth::reset`], is the origin without rotation.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if `position` is not finite or `rotation` is not
    /// a unit quaternion. The cloth is unchanged.
    pub fn set_frame(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        with_float_env(|| {
            check_pose(position, rotation, FRAME_FIELDS)?;
            self.world.reference_pose = Pose::new(position, rotation);
            Ok(())
        })
    }

    /// Moves the cloth with the body that wears it to a new pose at once, as a rigid body and
    /// without inertia. Velocities rotate with it.
    ///
    /// The motion starts at the pose of the last [`Cloth::set_frame`], [`Cloth::move_frame`] or
    /// `teleport`. Pins, attachments, grabs and anchors move too; colliders do not, see
    /// [`Cloth::teleport_collider`].
    ///
    /// In a frame, call this before [`Cloth::move_attachment`] and [`Cloth::set_anchors`], which
    /// set the targets from the new pose on.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if `position` is not finite, `rotation` is not a
    /// unit quaternion, or a moved value would not be finite. The cloth is unchanged.
    pub fn teleport(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        with_float_env(|| {
            check_pose(position, rotation, FRAME_FIELDS)?;
            self.world.teleport_frame(Pose::new(position, rotation))
        })?;
        self.update_state();
        Ok(())
    }

    /// Moves the cloth with the body that wears it to a new pose over the ticks of the next
    /// [`Cloth::advance`], or in the next tick of [`Cloth::step`]; the cloth feels only the share
    /// `inertia` of the motion.
    ///
    /// | `inertia` | effect |
    /// | --- | --- |
    /// | 1 | the cloth feels the whole motion, as without this call |
    /// | 0 | the cloth feels nothing, as if the body stood still and the world moved |
    /// | between | it feels this share of the translation and of the rotation |
    ///
    /// The motion starts at the pose of the last [`Cloth::set_frame`], [`Cloth::teleport`] or
    /// `move_frame`. The part that is not felt moves particles at once, as a rigid body. Pins,
    /// attachments and anchors reach the body's new pose evenly over these ticks. Colliders and
    /// grabs stay at the poses that the caller gives; the cloth meets them with the velocity that
    /// they have relative to the body. The air moves with the body by the share that is not felt.
    ///
    /// In a frame, call this before [`Cloth::move_attachment`], [`Cloth::move_collider`] and
    /// [`Cloth::set_anchors`], which set the poses for the end of the frame.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if `position` is not finite, `rotation` is not a
    /// unit quaternion, `inertia` is not from 0 to 1, or a moved value would not be finite. The
    /// cloth is unchanged.
    pub fn move_frame(&mut self, position: Vec3, rotation: Quat, inertia: f32) -> Result<()> {
        with_float_env(|| {
            check_pose(position, rotation, FRAME_FIELDS)?;
            check((0.0..=1.0).contains(&inertia), "inertia", "be from 0 to 1")?;
            self.world.advance_frame(Pose::new(position, rotation), inertia)
        })?;
        self.update_state();
        Ok(())
    }
}

/// A rigid motion of the reference frame, from one pose to another.
#[derive(Clone, Copy)]
struct FrameMove {
    from: Pose,
    to: Pose,
    frames: [Transform; 2],
}

impl FrameMove {
    #[inline(never)]
    fn new(from: Pose, to: Pose) -> Self {
        Self { from, to, frames: [from.to_transform(), to.to_transform()] }
    }

    fn point(&self, x: Vec3) -> Vec3 {
        self.frames[1].point_to_world(self.frames[0].point_to_local(x))
    }

    fn direction(&self, v: Vec3) -> Vec3 {
        self.frames[1].vector_to_world(self.frames[0].vector_to_local(v))
    }

    fn pose(&self, pose: &Pose) -> Pose {
        pose.moved_with(&self.from, &self.to)
    }
}

impl World {
    /// Moves everything but colliders with the reference frame, to the absolute pose `to`.
    fn teleport_frame(&mut self, to: Pose) -> Result<()> {
        let [from, end] = self.near_poses([self.reference_pose, to]);
        let shift = self.shift_with_frame(&FrameMove::new(from, end));
        let all = FrameMove::new(from, end.translated(-shift));
        self.check_stays_finite(&all, &all)?;
        self.transform_with_frame(&all, &all);
        self.grabs.iter_mut().for_each(|grab| grab.target = all.point(grab.target));
        self.set_origin_if_moved(shift);
        self.reference_pose = to;
        Ok(())
    }

    /// Converts absolute poses of the reference frame to poses relative to the origin of a point of
    /// the frame that is near the cloth at the first pose.
    fn near_poses<const COUNT: usize>(&self, poses: [Pose; COUNT]) -> [Pose; COUNT] {
        let relative = poses.map(|pose| Pose { position: self.to_relative(pose.position), ..pose });
        let center = self.local_center(&relative[0]);
        relative.map(|pose| {
            let position = pose.offset(pose.position.as_dvec3(), center);
            Pose { position, ..pose }
        })
    }

    /// By how much the origin moves with a cloth that moves at once [m].
    fn shift_with_frame(&self, by: &FrameMove) -> Vec3 {
        if by.from == by.to {
            return Vec3::ZERO;
        }
        let center = self.sample_positions().median();
        shift_with_cloth(self.origin, [center, by.point(center)])
    }

    /// Sets the origin after particles and what holds them moved to it.
    fn set_origin_if_moved(&mut self, shift: Vec3) {
        if shift != Vec3::ZERO {
            self.set_origin(self.origin + shift);
        }
    }

    /// Moves the reference frame to the absolute pose `to` for the next tick. The share of the
    /// motion that is not felt is applied at once; the rest is left to the tick. Colliders' last
    /// poses are moved too, so that their velocities are relative to the frame.
    fn advance_frame(&mut self, to: Pose, inertia: f32) -> Result<()> {
        if self.reference_pose == to {
            return Ok(());
        }
        let from = self.reference_pose;
        let unfelt = match inertia {
            1.0 => from,
            0.0 => to,
            felt => to.interpolate(&from, felt),
        };
        let [from, unfelt, end] = self.near_poses([from, unfelt, to]);
        let shift = self.shift_with_frame(&FrameMove::new(from, unfelt));
        let move_to = |end: Pose| FrameMove::new(from, end.translated(-shift));
        let (unfelt, all) = (move_to(unfelt), move_to(end));
        self.check_stays_finite(&unfelt, &all)?;
        self.reference_pose = to;
        self.transform_with_frame(&unfelt, &all);
        self.grabs.iter_mut().for_each(|grab| grab.target -= shift);
        self.set_origin_if_moved(shift);
        let unfelt = FrameMove::new(from.translated(-shift), unfelt.to);
        if unfelt.from != unfelt.to {
            self.colliders.iter_mut().for_each(|body| body.last = unfelt.pose(&body.last));
        }
        Ok(())
    }

    /// Checks that everything that `transform_with_frame` moves, and grabs and colliders, stays
    /// finite.
    fn check_stays_finite(&self, now: &FrameMove, then: &FrameMove) -> Result<()> {
        let p = &self.particles;
        let is_finite_after = |i: usize| {
            let points = [&p.x, &p.x_prev_tick].map(|column| now.point(column.get(i)));
            let vectors = [&p.v, &p.v_extrapolated, &p.displacement]
                .map(|column| now.direction(column.get(i)));
            points.iter().chain(&vectors).all(|v| v.is_finite())
        };
        let mut bodies = self.colliders.iter();
        let mut motions = self.attachments.iter();
        let mut pins = self.pins.iter();
        let mut anchors = self.anchors.iter();
        let are_finite = (0..p.len()).all(is_finite_after)
            && bodies.all(|body| now.pose(&body.last).position.is_finite())
            && self.grabs.iter().all(|grab| now.point(grab.target).is_finite())
            && motions.all(|motion| {
                let ends = [now.pose(&motion.last), then.pose(&motion.next)];
                ends.iter().all(|pose| pose.position.is_finite())
            })
            && pins.all(|pin| {
                let target = match self.attachments.get(pin.attachment, "attachment") {
                    Ok(motion) => then.pose(&motion.next).to_transform().point_to_world(pin.local),
                    Err(_) => then.point(pin.target),
                };
                target.is_finite() && now.point(pin.from).is_finite()
            })
            && anchors.all(|anchor| {
                then.point(anchor.anchor).is_finite() && now.point(anchor.from).is_finite()
            });
        check(are_finite, "position", "keep every position and velocity finite")
    }

    /// Moves the state at the start of the tick by `now`, and the targets at the end of the tick by
    /// `then`.
    fn transform_with_frame(&mut self, now: &FrameMove, then: &FrameMove) {
        if now.from != now.to {
            self.transform_tick_start(now);
        }
        self.attachments.iter_mut().for_each(|motion| motion.next = then.pose(&motion.next));
        for pin in self.pins.iter_mut() {
            pin.target = match self.attachments.get(pin.attachment, "attachment") {
                Ok(motion) => motion.next.to_transform().point_to_world(pin.local),
                Err(_) => then.point(pin.target),
            };
        }
        for anchor in self.anchors.iter_mut() {
            (anchor.anchor, anchor.normal) =
                (then.point(anchor.anchor), then.direction(anchor.normal));
        }
        self.wake();
    }

    /// Moves particles and the start poses of attachments, pins and anchors.
    fn transform_tick_start(&mut self, by: &FrameMove) {
        let p = &mut self.particles;
        for i in 0..p.len() {
            for column in [&mut p.x, &mut p.x_prev_tick] {
                column.set(i, by.point(column.get(i)));
            }
            for column in [&mut p.v, &mut p.v_extrapolated, &mut p.displacement] {
                column.set(i, by.direction(column.get(i)));
            }
        }
        self.attachments.iter_mut().for_each(|motion| motion.last = by.pose(&motion.last));
        self.pins.iter_mut().for_each(|pin| pin.from = by.point(pin.from));
        for anchor in self.anchors.iter_mut() {
            anchor.from = by.point(anchor.from);
            anchor.normal_from = by.direction(anchor.normal_from);
        }
        self.scratch.contacts.nearby.invalidate();
        // Rotation changes the distances between pins by rounding errors. Measure them again, as a
        // restored cloth does.
        self.is_pin_stretch_current = false;
    }
}
