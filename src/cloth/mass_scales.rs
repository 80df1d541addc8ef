//! Public call for mass scales: per-particle factors on the mass that the material gives.
//!
//! `mass = density · area · scale`. Reads the caller's factors; writes `World::mass_scales` and the
//! particle masses.
//! Invariant: a stored factor is within the valid range.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_index};
use crate::math::float_env::with_float_env;
use crate::state::mass_scales::is_valid_scale;

impl Cloth {
    /// Multiplies the masses of particles by factors: 1, the initial value, keeps the mass that
    /// density and surrounding area give. A hem hangs straight at about 5; a coin that is sewn in
    /// may be 100.
    ///
    /// Factors stay when the density changes, and a tear or cut divides a heavy particle's mass
    /// like any other. Velocities do not change. Neighbours may differ by a factor of 100; at
    /// factors in the thousands, light particles that carry heavy ones stretch unless `substeps` is
    /// raised.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless there is one factor per particle, each
    /// from 0.001 to 1000; [`Error::BadIndex`](crate::Error::BadIndex) if a particle does not
    /// exist. The cloth is unchanged.
    pub fn set_mass_scales(&mut self, particles: &[u32], scales: &[f32]) -> Result<()> {
        check(particles.len() == scales.len(), "scales", "have as many entries as `particles`")?;
        let count = self.world.particles.len();
        particles.iter().try_for_each(|particle| check_index(*particle, count, "particles"))?;
        let are_scales = scales.iter().all(|scale| is_valid_scale(*scale));
        check(are_scales, "scales", "be from 0.001 to 1000")?;
        let world = &mut *self.world;
        for (particle, scale) in particles.iter().zip(scales) {
            world.mass_scales.set(*particle, *scale, count);
        }
        world.mass_scales.reserve(world.allocated_particles());
        with_float_env(|| world.compute_masses());
        Ok(())
    }
}
