//! Tearing by hand.

use crate::cloth::Cloth;
use crate::error::{Error, Result, check, check_index};
use crate::math::float_env::with_float_env;
use crate::solver::topology::tear;

impl Cloth {
    /// Tears the cloth between two neighbouring particles, as over-stretching would: the more loaded
    /// of the two is split by the plane across the way between them. Where neither has anything on
    /// its other side, the edge itself opens, if it starts at a border. Says whether it tore: an end
    /// that is pinned or grabbed does not give way, nor does an edge that is a border already.
    ///
    /// # Errors
    /// [`Error::BadIndex`] for a particle that is not; [`Error::BadValue`] unless the two are the ends
    /// of an edge; [`Error::Full`] if the reserve for tears is used up.
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
        let torn = with_float_env(|| tear::tear_edge(&mut self.world, particle_a, particle_b));
        if torn {
            self.changed_topology();
            self.changed_state();
        }
        Ok(torn)
    }
}
