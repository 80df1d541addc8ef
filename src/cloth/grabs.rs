//! Public calls for grabs: particles that follow a pointer.
//!
//! A grabbed particle is a kinematic target with a speed limit of `max_displacement` per substep.
//!
//! Reads the caller's rays and targets; writes `World::grabs` and the inverse masses of the grabbed
//! particles.
//! Invariant: a handle is stale once its grab is released; it never refers to another grab.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_finite, check_index};
use crate::math::float_env::with_float_env;
use crate::state::grabs::{Grab, GrabbedParticle};
use glam::Vec3;

impl Cloth {
    /// Grabs a particle at its current position and returns a handle.
    ///
    /// The particle then follows the target of [`Cloth::move_grab`] exactly, at most
    /// `max_displacement` per substep, and pulls the cloth along. Up to 64 grabs may exist at once,
    /// e.g. one per pointer.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) if `particle` does not exist;
    /// [`Error::Full`](crate::Error::Full) if there are 64 grabs already. The cloth is unchanged.
    pub fn grab_particle(&mut self, particle: u32) -> Result<Grab> {
        check_index(particle, self.world.particles.len(), "particle")?;
        let target = self.world.particles.x.get(particle as usize);
        let grabbed = GrabbedParticle { particle, target, final_target: target };
        let handle = self.world.grabs.insert(grabbed, "another grab")?;
        with_float_env(|| self.world.refresh_inverse_mass(particle));
        Ok(Grab(handle))
    }

    /// Grabs the particle that a ray points at, and returns its handle and the particle's position
    /// [m]; `None` if there is no such particle.
    ///
    /// The particle is the nearest corner of the first triangle that the ray hits; if it hits none,
    /// the particle nearest to the ray within `radius` [m]. See [`Cloth::grab_particle`].
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if `origin` or `direction` is not finite,
    /// `direction` is zero, or `radius` is negative or not finite;
    /// [`Error::Full`](crate::Error::Full) if there are 64 grabs already. The cloth is unchanged.
    pub fn grab_ray(
        &mut self,
        origin: Vec3,
        direction: Vec3,
        radius: f32,
    ) -> Result<Option<(Grab, Vec3)>> {
        check(radius.is_finite() && radius >= 0.0, "radius", "be at least 0 and finite")?;
        let ray = self.relative_ray(origin, direction)?;
        let picked = with_float_env(|| {
            let hit = self.first_hit(&ray, f32::INFINITY).map(|hit| hit.particle);
            hit.or_else(|| self.nearest_to(&ray, radius))
        });
        let Some(particle) = picked else {
            return Ok(None);
        };
        let grab = self.grab_particle(particle)?;
        Ok(self.position(particle).map(|x| (grab, x)))
    }

    /// Sets the target of a grab [m]. Within the speed limit the particle reaches it evenly over the
    /// ticks of the next [`Cloth::advance`], or in the next tick of [`Cloth::step`].
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if the grab was released;
    /// [`Error::BadValue`](crate::Error::BadValue) if `target` is not finite. The cloth is
    /// unchanged.
    pub fn move_grab(&mut self, grab: Grab, target: Vec3) -> Result<()> {
        check_finite(target, "target")?;
        let target = self.world.to_relative(target);
        self.world.grabs.get_mut(grab.0, "grab")?.target = target;
        Ok(())
    }

    /// Releases a grabbed particle, which keeps its velocity. A pinned particle stays pinned and
    /// returns to its pin evenly over the ticks of the next [`Cloth::advance`], or in the next tick
    /// of [`Cloth::step`].
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if the grab was released before.
    pub fn release(&mut self, grab: Grab) -> Result<()> {
        let grabbed = self.world.grabs.remove(grab.0, "grab")?;
        let (at, world) = (grabbed.particle, &mut *self.world);
        if let Some(pin) = world.pins.get_mut(at) {
            pin.from = world.particles.x.get(at as usize);
        }
        with_float_env(|| world.refresh_inverse_mass(at));
        Ok(())
    }
}
