//! Public call for mesh colliders that deform.
//!
//! Reads the caller's vertices; writes `World::colliders`.
//! Invariant: nothing changes unless all vertices are valid.

use crate::cloth::Cloth;
use crate::error::Result;
use crate::math::float_env::with_float_env;
use crate::state::collider_desc::check_coordinates;
use crate::state::colliders::Collider;
use glam::Vec3;

impl Cloth {
    /// Gives a mesh collider new vertices, of the same number and with the same triangles: the body of
    /// a character in its next pose. Its surface reaches them evenly over the ticks of the next
    /// [`Cloth::advance`], or in the next tick of [`Cloth::step`], and is swept on its way: it carries
    /// cloth along, by friction with the speed of each place. `positions` are in the local frame of
    /// the collider [m], all of them; [`Cloth::move_collider`] moves that frame as before.
    ///
    /// The first call prepares the mesh for that, which takes as long as adding it. Substeps are added
    /// where cloth and surface move fast relative to each other.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if the collider was removed;
    /// [`Error::BadValue`](crate::Error::BadValue) if it is no mesh or the number of vertices differs;
    /// [`Error::BadEntry`](crate::Error::BadEntry) if a vertex is not between −1e6 and 1e6. The cloth
    /// is unchanged.
    pub fn update_collider(&mut self, collider: Collider, positions: &[Vec3]) -> Result<()> {
        self.check_collider_vertices(collider, positions.len())?;
        check_coordinates(positions.len(), &|i| positions[i], "positions")?;
        let body = self.world.colliders.get_mut(collider.0, "collider")?;
        let is_first = body.deformation().is_none();
        with_float_env(|| body.update(&|i| positions[i]));
        if is_first {
            self.world.reserve_contacts();
        }
        Ok(())
    }

    /// Checks that a collider is a mesh of `count` vertices, for language bindings.
    #[doc(hidden)]
    pub fn check_collider_vertices(&self, collider: Collider, count: usize) -> Result<()> {
        self.world.colliders.get(collider.0, "collider")?.check_vertices(count)
    }
}
