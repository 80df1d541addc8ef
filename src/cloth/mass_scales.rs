//! How heavy particles are, beside what the material says.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_index};
use crate::math::float_env::with_float_env;
use crate::state::mass_scales::is_valid_scale;

impl Cloth {
    /// Makes particles heavier or lighter than their material, by a factor each: 1, as at first, is what
    /// its density and the area about them give. A hem of 5 hangs straight; a coin sewn in may be 100.
    ///
    /// Factors stay when the density changes, and a tear or a cut shares a heavy particle's mass out as it
    /// does that of any other. Velocities stay as they are. Neighbours may well be a hundredfold apart; where
    /// it is thousands, what hangs by the light ones stretches them until there are more substeps.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless there are as many factors as particles, all from
    /// 0.001 to 1000; [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not.
    pub fn set_mass_scales(&mut self, particles: &[u32], scales: &[f32]) -> Result<()> {
        check(particles.len() == scales.len(), "scales", "be as many as `particles`")?;
        let count = self.world.particles.len();
        particles.iter().try_for_each(|particle| check_index(*particle, count, "particles"))?;
        let are_scales = scales.iter().all(|scale| is_valid_scale(*scale));
        check(are_scales, "scales", "be from 0.001 to 1000")?;
        let world = &mut self.world;
        for (particle, scale) in particles.iter().zip(scales) {
            world.mass_scales.set(*particle, *scale, count);
        }
        world.mass_scales.reserve(world.capacity());
        with_float_env(|| world.compute_masses());
        Ok(())
    }
}
