//! What a cloth may touch: added, moved and removed.

use crate::cloth::Cloth;
use crate::error::Result;
use crate::math::float_env::with_float_env;
use crate::state::collider_desc::ColliderDesc;
use crate::state::colliders::{Collider, ColliderBody, Impulse};
use glam::{Quat, Vec3};

impl Cloth {
    /// Adds a collider.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) names the field and the rule,
    /// [`Error::Full`](crate::Error::Full) if there are 1024 colliders already.
    pub fn add_collider(&mut self, desc: &ColliderDesc) -> Result<Collider> {
        let body = with_float_env(|| ColliderBody::new(desc.clone()))?;
        let handle = self.world.colliders.insert(Box::new(body), "another collider")?;
        self.world.reserve_contacts();
        self.world.wake();
        Ok(Collider(handle))
    }

    /// Moves a collider; it gets there over the next tick.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was removed,
    /// [`Error::BadValue`](crate::Error::BadValue) for a pose that cannot be.
    pub fn move_collider(
        &mut self,
        collider: Collider,
        position: Vec3,
        rotation: Quat,
    ) -> Result<()> {
        let body = self.world.colliders.get_mut(collider.0, "collider")?;
        with_float_env(|| body.move_to(position, rotation))
    }

    /// Puts a collider somewhere at once: it does not sweep, and what lay on it does not feel it go.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was removed,
    /// [`Error::BadValue`](crate::Error::BadValue) for a pose that cannot be.
    pub fn teleport_collider(
        &mut self,
        collider: Collider,
        position: Vec3,
        rotation: Quat,
    ) -> Result<()> {
        let body = self.world.colliders.get_mut(collider.0, "collider")?;
        with_float_env(|| body.teleport(position, rotation))?;
        self.world.scratch.contacts.nearby.invalidate();
        self.world.wake();
        Ok(())
    }

    /// Removes a collider.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was removed before.
    pub fn remove_collider(&mut self, collider: Collider) -> Result<()> {
        self.world.colliders.remove(collider.0, "collider")?;
        self.world.scratch.contacts.nearby.invalidate();
        self.world.wake();
        Ok(())
    }

    /// What the cloth did to a collider in the last tick.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if it was removed.
    pub fn collider_impulse(&self, collider: Collider) -> Result<Impulse> {
        Ok(self.world.colliders.get(collider.0, "collider")?.impulse)
    }
}
