//! Public calls for attachments: groups of pins that a moving transform carries (bone, pole, car
//! body).
//!
//! Each attached pin stores its position in the frame of the transform; a moved transform gives
//! `target = pose · local`. The solver interpolates the pose over the ticks of an `advance`.
//!
//! Reads the caller's poses; writes `World::attachments` and `World::pins`.
//! Invariant: the target of a carried pin is always `AttachmentPose::next` applied to `pin.local`.

use crate::cloth::Cloth;
use crate::error::{Result, check_index};
use crate::math::float_env::with_float_env;
use crate::math::saturate;
use crate::solver::world::World;
use crate::state::attachments::{Attachment, AttachmentPose};
use crate::state::pose::{Pose, check_pose};
use glam::{Quat, Vec3};

/// Names of the pose arguments in error messages.
const ATTACHMENT_FIELDS: [&str; 2] = ["position", "rotation"];

impl Cloth {
    /// Attaches particles to a transform at `position` [m] with `rotation`, e.g. a bone, a pole or
    /// a car body. The particles are pinned at their current positions; [`Cloth::move_attachment`]
    /// moves them.
    ///
    /// - A particle that is already pinned, or attached to another transform, keeps its stiffness
    ///   ([`Cloth::set_pin_stiffness`]) and moves to this attachment.
    /// - A particle leaves the attachment when it gets a pin target of its own or is unpinned.
    /// - A tear or cut through attached particles attaches the new particles too.
    /// - [`Cloth::reset`] removes all attachments.
    ///
    /// ```
    /// use muslin::glam::{Quat, Vec3};
    /// use muslin::{Cloth, GridDesc, PinMode};
    ///
    /// let mut cloth = Cloth::grid(&GridDesc { pin_mode: PinMode::None, ..GridDesc::default() })?;
    /// let edge: Vec<u32> = (0..40).collect();
    /// let pole = cloth.attach(&edge, Vec3::ZERO, Quat::IDENTITY)?;
    /// for frame in 1..=60 {
    ///     cloth.move_attachment(pole, Vec3::ZERO, Quat::from_rotation_y(0.02 * frame as f32))?;
    ///     cloth.advance(1.0 / 60.0)?;
    /// }
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// - [`Error::BadIndex`](crate::Error::BadIndex) if a particle does not exist.
    /// - [`Error::BadValue`](crate::Error::BadValue) if `position` is not finite or `rotation` is
    ///   not a unit quaternion.
    /// - [`Error::Full`](crate::Error::Full) if there are 64 attachments already.
    ///
    /// The cloth is unchanged then.
    pub fn attach(
        &mut self,
        particles: &[u32],
        position: Vec3,
        rotation: Quat,
    ) -> Result<Attachment> {
        for particle in particles {
            check_index(*particle, self.world.particles.len(), "particles")?;
        }
        with_float_env(|| {
            check_pose(position, rotation, ATTACHMENT_FIELDS)?;
            let mut pose = Pose::new(self.world.to_relative(position), rotation);
            let center = self.world.local_center(&pose);
            pose.position = pose.offset(pose.position.as_dvec3(), center);
            let motion =
                AttachmentPose { last: pose, next: pose, center, ..AttachmentPose::default() };
            let handle = self.world.attachments.insert(motion, "another attachment")?;
            let frame = pose.to_transform();
            for particle in particles {
                let x = self.world.particles.x.get(*particle as usize);
                let local = saturate(frame.point_to_local(x));
                self.set_pin(*particle, saturate(frame.point_to_world(local)));
                if let Some(pin) = self.world.pins.get_mut(*particle) {
                    (pin.from, pin.attachment, pin.local) = (x, handle, local);
                }
            }
            Ok(Attachment(handle))
        })
    }

    /// Moves an attachment: its particles reach the new pose evenly over the ticks of the next
    /// [`Cloth::advance`], or in the next tick of [`Cloth::step`]. They rotate with the transform
    /// on the way, and are exactly there at the end.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was detached;
    /// [`Error::BadValue`](crate::Error::BadValue) if `position` is not finite or `rotation` is not
    /// a unit quaternion. The cloth is unchanged.
    pub fn move_attachment(
        &mut self,
        attachment: Attachment,
        position: Vec3,
        rotation: Quat,
    ) -> Result<()> {
        let world = &mut *self.world;
        let origin = world.origin;
        let motion = world.attachments.get_mut(attachment.0, "attachment")?;
        with_float_env(|| {
            check_pose(position, rotation, ATTACHMENT_FIELDS)?;
            motion.next = Pose::new(position, rotation);
            let position = position.as_dvec3() - origin.as_dvec3();
            motion.next.position = motion.next.offset(position, motion.center);
            let frame = motion.next.to_transform();
            for pin in world.pins.iter_mut().filter(|pin| pin.attachment == attachment.0) {
                pin.target = saturate(frame.point_to_world(pin.local));
            }
            Ok(())
        })
    }

    /// Removes an attachment and unpins the particles that it still carries; they keep their
    /// velocities.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was detached before.
    pub fn detach(&mut self, attachment: Attachment) -> Result<()> {
        self.world.attachments.remove(attachment.0, "attachment")?;
        self.world.wake();
        if self.world.pins.remove_attached(attachment.0) {
            with_float_env(|| {
                (0..self.world.particles.len() as u32)
                    .for_each(|i| self.world.refresh_inverse_mass(i));
            });
            self.mark_pins_changed();
        }
        Ok(())
    }

    /// Returns the particles that an attachment carries, in ascending order.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was detached.
    pub fn attached(&self, attachment: Attachment) -> Result<impl Iterator<Item = u32> + '_> {
        self.world.attachments.get(attachment.0, "attachment")?;
        let pins = self.world.pins.iter().filter(move |pin| pin.attachment == attachment.0);
        Ok(pins.map(|pin| pin.particle))
    }
}

impl World {
    /// Moves the pin of `particle`, if it has one, to `position` relative to the origin [m] at
    /// once. A carried pin stays attached, with a new local position.
    pub(super) fn move_pin(&mut self, particle: u32, position: Vec3) {
        let Some(pin) = self.pins.get_mut(particle) else { return };
        (pin.from, pin.target) = (position, position);
        if let Ok(motion) = self.attachments.get(pin.attachment, "attachment") {
            pin.local = saturate(motion.last.to_transform().point_to_local(position));
            pin.target = saturate(motion.next.to_transform().point_to_world(pin.local));
        }
    }
}
