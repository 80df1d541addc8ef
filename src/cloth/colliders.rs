//! Public calls for colliders: add, move, teleport, remove, and read the impulse.
//!
//! Reads [`ColliderDesc`]; writes `World::colliders`.
//! Invariant: any change invalidates the cached collider contacts or happens through the swept
//! pose.

use crate::cloth::Cloth;
use crate::error::Result;
use crate::math::float_env::with_float_env;
use crate::state::collider_desc::ColliderDesc;
use crate::state::colliders::{Collider, ColliderBody, Impulse};
use crate::state::pose::Pose;
use glam::{Quat, Vec3};

impl Cloth {
    /// Adds a collider to the cloth and returns its handle. It acts from the next tick on.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) or [`Error::BadIndex`](crate::Error::BadIndex)
    /// names the invalid field of `desc` and its rule; [`Error::Full`](crate::Error::Full) if there
    /// are 1024 colliders already. The cloth is unchanged.
    pub fn add_collider(&mut self, desc: &ColliderDesc) -> Result<Collider> {
        let body = with_float_env(|| ColliderBody::new(desc.clone(), self.world.origin))?;
        let handle = self.world.colliders.insert(Box::new(body), "another collider")?;
        self.world.reserve_contacts();
        self.world.wake();
        Ok(Collider(handle))
    }

    /// Moves a collider to a new pose [m], which it reaches evenly over the ticks of the next
    /// [`Cloth::advance`], or in the next tick of [`Cloth::step`]. The motion is swept, so a fast
    /// collider does not jump through the cloth.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was removed;
    /// [`Error::BadValue`](crate::Error::BadValue) if `position` is not finite or `rotation` is not
    /// a unit quaternion. The cloth is unchanged.
    pub fn move_collider(
        &mut self,
        collider: Collider,
        position: Vec3,
        rotation: Quat,
    ) -> Result<()> {
        let origin = self.world.origin;
        let body = self.world.colliders.get_mut(collider.0, "collider")?;
        with_float_env(|| body.move_to(position, rotation, origin))
    }

    /// Places a collider at a new pose [m] at once, without a sweep and without dragging the cloth
    /// along.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was removed;
    /// [`Error::BadValue`](crate::Error::BadValue) if `position` is not finite or `rotation` is not
    /// a unit quaternion. The cloth is unchanged.
    pub fn teleport_collider(
        &mut self,
        collider: Collider,
        position: Vec3,
        rotation: Quat,
    ) -> Result<()> {
        let origin = self.world.origin;
        let body = self.world.colliders.get_mut(collider.0, "collider")?;
        with_float_env(|| body.teleport(position, rotation, origin))?;
        self.world.scratch.contacts.nearby.invalidate();
        self.world.wake();
        Ok(())
    }

    /// Removes a collider. Its handle becomes stale.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was removed before.
    pub fn remove_collider(&mut self, collider: Collider) -> Result<()> {
        self.world.colliders.remove(collider.0, "collider")?;
        self.world.scratch.contacts.nearby.invalidate();
        self.world.wake();
        Ok(())
    }

    /// Returns the position [m] and the rotation of a collider where it is now: after the last tick,
    /// or where it was added or teleported to since. A pose of [`Cloth::move_collider`] counts once
    /// a tick has reached it.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was removed.
    pub fn collider_pose(&self, collider: Collider) -> Result<(Vec3, Quat)> {
        let body = self.world.colliders.get(collider.0, "collider")?;
        let Pose { position, rotation } = with_float_env(|| body.pose(self.world.origin));
        Ok((position, rotation))
    }

    /// Returns the impulse that the cloth applied to a collider in the last tick. Divided by the
    /// length of the tick, it is the force and torque for an engine that simulates the collider as
    /// a rigid body.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was removed.
    pub fn collider_impulse(&self, collider: Collider) -> Result<Impulse> {
        Ok(self.world.colliders.get(collider.0, "collider")?.impulse)
    }
}
