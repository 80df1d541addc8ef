//! Public call for tearing an edge by hand.
//!
//! Reads the mesh; `solver::topology::tear` splits the vertex, as it does for an over-stretched
//! link.
//! Invariant: an edge that does not tear leaves the cloth unchanged.

use crate::cloth::Cloth;
use crate::error::{Error, Result, check, check_index};
use crate::math::float_env::with_float_env;
use crate::solver::collide;
use crate::solver::scratch_pool;
use crate::solver::topology::tear;

impl Cloth {
    /// Tears the cloth between two neighbouring particles, as over-stretching does. Returns whether
    /// it tore.
    ///
    /// The particle under the higher load is split by the plane that is perpendicular to the edge.
    /// If neither particle has triangles on its other side, the edge itself opens, provided that it
    /// starts at a border. The result is `false` if both ends are pinned or grabbed, or if the edge
    /// is already a border. The first call allocates the reserve for tears, unless
    /// [`Settings::tearing`](crate::Settings) did.
    ///
    /// # Errors
    /// [`Error::BadIndex`] if a particle does not exist; [`Error::BadValue`] unless the two are the
    /// ends of an edge; [`Error::Full`] if the reserve for tears is used up. The cloth is
    /// unchanged.
    pub fn tear_edge(&mut self, particle_a: u32, particle_b: u32) -> Result<bool> {
        let count = self.world.particles.len();
        check_index(particle_a, count, "particle_a")?;
        check_index(particle_b, count, "particle_b")?;
        let is_edge = self.world.mesh.triangles.iter().any(|triangle| {
            particle_a != particle_b
                && triangle.contains(&particle_a)
                && triangle.contains(&particle_b)
        });
        check(is_edge, "particle_b", "be joined to `particle_a` by an edge")?;
        if self.world.is_reserve_used_up() {
            return Err(Error::Full { what: "another torn vertex" });
        }
        self.reserve_for_tears();
        let torn = with_float_env(|| {
            scratch_pool::with_lent(&mut self.world, |world| {
                if world.scratch.surface_collision.is_some() {
                    collide::begin_between_ticks(world);
                }
                tear::tear_edge(world, particle_a, particle_b)
            })
        });
        if torn {
            self.update_topology();
            self.update_state();
        }
        Ok(torn)
    }
}
