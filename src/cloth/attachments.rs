//! Pins that a moving transform carries.

use crate::cloth::Cloth;
use crate::error::{Result, check_index};
use crate::math::float_env::with_float_env;
use crate::math::saturate;
use crate::solver::world::World;
use crate::state::attachments::{Attachment, AttachmentPose};
use crate::state::pose::{Pose, check_pose};
use glam::{Quat, Vec3};

/// What the numbers of an attachment's pose are called.
const OF_ATTACHMENT: [&str; 2] = ["position", "rotation"];

impl Cloth {
    /// Attaches particles to a transform at `position` [m], turned by `rotation`: a bone, a pole, the body of a
    /// car. They are pinned where they are now, and from then on [`Cloth::move_attachment`] carries them.
    ///
    /// Those that are pinned already, or attached to something else, keep their stiffness
    /// ([`Cloth::set_pin_stiffness`]). One that gets a target of its own later, or is unpinned, leaves the
    /// attachment. Vertices that a tear or a cut makes of attached ones are attached too.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not,
    /// [`Error::BadValue`](crate::Error::BadValue) for a position that is not finite or a rotation that is no
    /// unit quaternion, [`Error::Full`](crate::Error::Full) if there are 64 attachments already.
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
            check_pose(position, rotation, OF_ATTACHMENT)?;
            let pose = Pose::new(position, rotation);
            let carrier = AttachmentPose { last: pose, next: pose };
            let handle = self.world.attachments.insert(carrier, "another attachment")?;
            let frame = pose.to_transform();
            for particle in particles {
                let x = self.world.particles.x.at(*particle as usize);
                let local = saturate(frame.point_to_local(x));
                self.put_pin(*particle, saturate(frame.point_to_world(local)));
                if let Some(pin) = self.world.pins.get_mut(*particle) {
                    (pin.from, pin.attachment, pin.local) = (x, handle, local);
                }
            }
            Ok(Attachment(handle))
        })
    }

    /// Moves a transform that particles are attached to: they get there over the next tick, turning on the way
    /// as it turns, and are exactly there when it ends.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was detached,
    /// [`Error::BadValue`](crate::Error::BadValue) for a position that is not finite or a rotation that is no
    /// unit quaternion.
    pub fn move_attachment(
        &mut self,
        attachment: Attachment,
        position: Vec3,
        rotation: Quat,
    ) -> Result<()> {
        let carrier = self.world.attachments.get_mut(attachment.0, "attachment")?;
        with_float_env(|| {
            check_pose(position, rotation, OF_ATTACHMENT)?;
            carrier.next = Pose::new(position, rotation);
            let frame = carrier.next.to_transform();
            for pin in self.world.pins.iter_mut().filter(|pin| pin.attachment == attachment.0) {
                pin.target = saturate(frame.point_to_world(pin.local));
            }
            Ok(())
        })
    }

    /// Lets all go that an attachment still carries, with the velocity that they have.
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
            self.changed_pins();
        }
        Ok(())
    }

    /// The particles that an attachment carries, lowest first.
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
    /// A pin, if there is one, holds a particle where it was put; what carries it goes on to do so.
    pub(super) fn bring_pin(&mut self, particle: u32, position: Vec3) {
        let Some(pin) = self.pins.get_mut(particle) else { return };
        (pin.from, pin.target) = (position, position);
        if let Ok(carrier) = self.attachments.get(pin.attachment, "attachment") {
            pin.local = saturate(carrier.last.to_transform().point_to_local(position));
            pin.target = saturate(carrier.next.to_transform().point_to_world(pin.local));
        }
    }
}
