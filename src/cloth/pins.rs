//! Public calls for pins: particles that are held at targets, exactly or by springs.
//!
//! Reads the caller's targets; writes `World::pins` and the inverse masses of the pinned particles.
//! Invariant: tethers are measured again before the next tick after the set of hard pins changed.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_finite, check_index};
use crate::math::float_env::with_float_env;
use glam::Vec3;

impl Cloth {
    /// Pins a particle at `target` [m], or at its current position if that is `None`.
    ///
    /// The particle reaches the target evenly over the ticks of the next [`Cloth::advance`], or in
    /// the next tick of [`Cloth::step`]. If it is already pinned, the target changes and the
    /// stiffness stays; an attached particle leaves its attachment.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) if `particle` does not exist;
    /// [`Error::BadValue`](crate::Error::BadValue) if `target` is not finite. The cloth is
    /// unchanged.
    pub fn pin(&mut self, particle: u32, target: Option<Vec3>) -> Result<()> {
        check_index(particle, self.world.particles.len(), "particle")?;
        let x = self.world.particles.x.get(particle as usize);
        check_finite(target.unwrap_or(x), "target")?;
        self.set_pin(particle, target.map_or(x, |target| self.world.to_relative(target)));
        Ok(())
    }

    /// Releases a pinned particle, which keeps its velocity. Has no effect on a particle that is
    /// not pinned.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) if `particle` does not exist.
    pub fn unpin(&mut self, particle: u32) -> Result<()> {
        check_index(particle, self.world.particles.len(), "particle")?;
        if self.world.pins.remove(particle) {
            with_float_env(|| self.world.refresh_inverse_mass(particle));
            self.mark_pins_changed();
        }
        Ok(())
    }

    /// Releases all pinned particles.
    pub fn unpin_all(&mut self) {
        self.world.pins.clear();
        with_float_env(|| {
            (0..self.world.particles.len() as u32).for_each(|i| self.world.refresh_inverse_mass(i));
        });
        self.mark_pins_changed();
    }

    /// Sets the targets [m] of many pins at once, e.g. every frame for an animated edge. Particles
    /// that are not pinned yet become pinned. They reach their targets as those of [`Cloth::pin`].
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless there is one finite target per particle;
    /// [`Error::BadIndex`](crate::Error::BadIndex) if a particle does not exist. The cloth is
    /// unchanged.
    pub fn set_pin_targets(&mut self, particles: &[u32], targets: &[Vec3]) -> Result<()> {
        check(particles.len() == targets.len(), "targets", "have as many entries as `particles`")?;
        for (particle, target) in particles.iter().zip(targets) {
            check_index(*particle, self.world.particles.len(), "particles")?;
            check_finite(*target, "targets")?;
        }
        for (particle, target) in particles.iter().zip(targets) {
            self.set_pin(*particle, self.world.to_relative(*target));
        }
        Ok(())
    }

    /// Pins `particle` at `target` relative to the origin [m], or changes the target of its pin.
    pub(super) fn set_pin(&mut self, particle: u32, target: Vec3) {
        let x = self.world.particles.x.get(particle as usize);
        if self.world.pins.insert(particle, x, target) {
            with_float_env(|| self.world.refresh_inverse_mass(particle));
            self.mark_pins_changed();
        }
    }

    /// Returns the pinned particles, in ascending order.
    pub fn pinned(&self) -> impl Iterator<Item = u32> + '_ {
        self.world.pins.iter().map(|pin| pin.particle)
    }

    /// Sets the stiffness [N/m] with which pins pull particles towards their targets. 0, the
    /// initial value, holds them exactly; above 0 the pin is a spring.
    ///
    /// A load of 1 N moves a soft pin's particle 1/`stiffness` metres from its target: 1e3 N/m
    /// feels firm, 10 N/m lets a sheet of cotton sag by a few centimetres. For tears and
    /// `max_stretch` the cloth counts as free at a soft pin, and it is not tethered to it. A tear
    /// through a soft pin divides its stiffness in proportion to mass.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) if a particle does not exist;
    /// [`Error::BadValue`](crate::Error::BadValue) if a particle is not pinned, or `stiffness` is
    /// negative or not finite. The cloth is unchanged.
    pub fn set_pin_stiffness(&mut self, particles: &[u32], stiffness: f32) -> Result<()> {
        let is_stiffness = stiffness.is_finite() && stiffness >= 0.0;
        check(is_stiffness, "stiffness", "be at least 0 and finite")?;
        for particle in particles {
            check_index(*particle, self.world.particles.len(), "particles")?;
            let is_pinned = self.world.pins.get(*particle).is_some();
            check(is_pinned, "particles", "be pinned")?;
        }
        for particle in particles {
            let Some(pin) = self.world.pins.get_mut(*particle) else { continue };
            let changes_softness = pin.is_soft() != (stiffness > 0.0);
            pin.stiffness = stiffness;
            with_float_env(|| self.world.refresh_inverse_mass(*particle));
            if changes_softness {
                self.mark_pins_changed();
            }
        }
        self.world.reserve_effective_mass();
        Ok(())
    }

    /// Returns the stiffness of a particle's pin [N/m]; 0 for an exact pin, `None` if it is not
    /// pinned.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) if `particle` does not exist.
    pub fn pin_stiffness(&self, particle: u32) -> Result<Option<f32>> {
        check_index(particle, self.world.particles.len(), "particle")?;
        Ok(self.world.pins.get(particle).map(|pin| pin.stiffness))
    }

    /// Returns the target of a particle's pin [m], which the particle reaches with the next ticks;
    /// that of an attached particle follows from the pose of its attachment. `None` if it is not
    /// pinned.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) if `particle` does not exist.
    pub fn pin_target(&self, particle: u32) -> Result<Option<Vec3>> {
        check_index(particle, self.world.particles.len(), "particle")?;
        Ok(self.world.pins.get(particle).map(|pin| self.world.to_absolute(pin.target)))
    }

    /// Requests that the next tick measures the tethers again.
    pub(super) fn mark_pins_changed(&mut self) {
        self.pins_changed = true;
        self.world.tether_slack = f32::INFINITY;
        self.world.reserve_tethers();
    }
}
