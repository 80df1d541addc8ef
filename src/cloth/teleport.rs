//! A cloth goes along with a body that jumps.

use super::Cloth;
use crate::error::Result;
use crate::math::float_env::guarded;
use crate::solver::World;
use crate::state::pose::{Pose, check_pose};
use glam::{Quat, Vec3};

/// What the numbers of a frame's pose are called.
const OF_FRAME: [&str; 2] = ["position", "rotation"];

impl Cloth {
    /// Says where the body is that wears the cloth, and how it is turned: [`Cloth::teleport`] goes from there.
    /// At first, and after a reset, that is the origin. It moves nothing.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) for a position that is not finite or a rotation that is no
    /// unit quaternion.
    pub fn set_frame(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        guarded(|| {
            check_pose(position, rotation, OF_FRAME)?;
            self.world.reference = Pose::new(position, rotation);
            Ok(())
        })
    }

    /// Takes the cloth along as the body that wears it jumps from where [`Cloth::set_frame`] or the last
    /// `teleport` had it: at once, as a solid body, and without feeling it. Velocities turn with it. Pins,
    /// attachments, grabs and anchors go along; colliders do not, see [`Cloth::teleport_collider`].
    ///
    /// A call in the same frame as `move_attachment` or `set_anchors` comes first: those tell where things go
    /// from there.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) for a position that is not finite or a rotation that is no
    /// unit quaternion.
    pub fn teleport(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        guarded(|| {
            check_pose(position, rotation, OF_FRAME)?;
            self.world.jump(Pose::new(position, rotation));
            Ok(())
        })?;
        self.changed_state();
        Ok(())
    }
}

impl World {
    /// Moves all but colliders with the body that it goes along with.
    fn jump(&mut self, to: Pose) {
        let from = core::mem::replace(&mut self.reference, to);
        let (old, new) = (from.frame(), to.frame());
        let point = |x: Vec3| new.outward(old.inward(x));
        let turn = |v: Vec3| new.turn(old.turn_inward(v));
        let p = &mut self.particles;
        for i in 0..p.len() {
            for places in [&mut p.x, &mut p.x_last] {
                places.set(i, point(places.at(i)));
            }
            for ways in [&mut p.v, &mut p.v_ahead, &mut p.moved] {
                ways.set(i, turn(ways.at(i)));
            }
        }
        for carrier in self.attachments.iter_mut() {
            (carrier.last, carrier.next) =
                (carrier.last.jump(&from, &to), carrier.next.jump(&from, &to));
        }
        for pin in self.pins.iter_mut() {
            (pin.from, pin.target) = (point(pin.from), point(pin.target));
            if let Ok(carrier) = self.attachments.get(pin.carrier, "attachment") {
                pin.target = carrier.next.frame().outward(pin.local);
            }
        }
        self.grabs.iter_mut().for_each(|held| held.target = point(held.target));
        for leash in self.leashes.iter_mut() {
            (leash.from, leash.anchor) = (point(leash.from), point(leash.anchor));
            (leash.normal_from, leash.normal) = (turn(leash.normal_from), turn(leash.normal));
        }
        self.scratch.contacts.near.forget();
        self.wake();
    }
}
