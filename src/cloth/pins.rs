//! Particles are pinned, hard or soft, and let go.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_finite, check_index};
use crate::math::float_env::with_float_env;
use glam::Vec3;

impl Cloth {
    /// Holds a particle at `target` [m], or where it is. The target is reached over the next tick;
    /// a particle that is pinned already gets a new target, and nothing carries it any more; its stiffness
    /// stays.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not,
    /// [`Error::BadValue`](crate::Error::BadValue) for a target that is not finite.
    pub fn pin(&mut self, particle: u32, target: Option<Vec3>) -> Result<()> {
        check_index(particle, self.world.particles.len(), "particle")?;
        let x = self.world.particles.x.at(particle as usize);
        let target = target.unwrap_or(x);
        check_finite(target, "target")?;
        self.put_pin(particle, target);
        Ok(())
    }

    /// Lets a particle go. One that is not pinned stays as it is.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not.
    pub fn unpin(&mut self, particle: u32) -> Result<()> {
        check_index(particle, self.world.particles.len(), "particle")?;
        if self.world.pins.remove(particle) {
            with_float_env(|| self.world.refresh_inverse_mass(particle));
            self.changed_pins();
        }
        Ok(())
    }

    /// Lets every particle go.
    pub fn unpin_all(&mut self) {
        self.world.pins.clear();
        with_float_env(|| {
            (0..self.world.particles.len() as u32).for_each(|i| self.world.refresh_inverse_mass(i));
        });
        self.changed_pins();
    }

    /// Gives many pins their targets [m] at once; particles that are not pinned yet are from now on.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless there are as many targets as particles, all
    /// finite; [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not.
    pub fn set_pin_targets(&mut self, particles: &[u32], targets: &[Vec3]) -> Result<()> {
        check(particles.len() == targets.len(), "targets", "be as many as `particles`")?;
        for (particle, target) in particles.iter().zip(targets) {
            check_index(*particle, self.world.particles.len(), "particles")?;
            check_finite(*target, "targets")?;
        }
        for (particle, target) in particles.iter().zip(targets) {
            self.put_pin(*particle, *target);
        }
        Ok(())
    }

    pub(super) fn put_pin(&mut self, particle: u32, target: Vec3) {
        let x = self.world.particles.x.at(particle as usize);
        if self.world.pins.insert(particle, x, target) {
            with_float_env(|| self.world.refresh_inverse_mass(particle));
            self.changed_pins();
        }
    }

    /// The pinned particles, lowest first.
    pub fn pinned(&self) -> impl Iterator<Item = u32> + '_ {
        self.world.pins.iter().map(|pin| pin.particle)
    }

    /// Says how hard pins pull towards their targets [N/m]: as springs, or exactly if `stiffness` is 0, as
    /// they do at first. A soft pin holds a load of 1 N 1/`stiffness` from its target; the cloth counts as
    /// free there, for tears and for `max_stretch`, and is not tethered to it. 1e3 N/m feels firm, 10 N/m
    /// lets a sheet of cotton sag by a few centimetres.
    ///
    /// A tear through a soft pin shares its stiffness out by mass.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not,
    /// [`Error::BadValue`](crate::Error::BadValue) for one that is not pinned, or a stiffness that is below
    /// 0 or not finite.
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
            let is_other_kind = pin.is_soft() != (stiffness > 0.0);
            pin.stiffness = stiffness;
            with_float_env(|| self.world.refresh_inverse_mass(*particle));
            if is_other_kind {
                self.changed_pins();
            }
        }
        self.world.reserve_effective_mass();
        Ok(())
    }

    /// How hard the pin of a particle pulls [N/m]; 0 if it holds it exactly, nothing if it is not pinned.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not.
    pub fn pin_stiffness(&self, particle: u32) -> Result<Option<f32>> {
        check_index(particle, self.world.particles.len(), "particle")?;
        Ok(self.world.pins.get(particle).map(|pin| pin.stiffness))
    }

    pub(super) fn changed_pins(&mut self) {
        self.pins_changed = true;
        self.world.tether_slack = f32::INFINITY;
    }
}
