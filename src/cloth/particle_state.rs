//! Public calls for positions, velocities and masses of particles, one by one or in bulk.
//!
//! Reads the caller's lists and `World::particles`; writes positions, velocities and their history,
//! and the pins of particles that are placed.
//! Invariant: a bulk call leaves the state that the same calls for single particles leave, in the
//! order of the list, except that the origin moves at most once.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_all_finite, check_finite, check_index};
use crate::math::float_env::with_float_env;
use glam::Vec3;

impl Cloth {
    /// Returns the number of particles.
    pub fn particle_count(&self) -> u32 {
        self.world.particles.len() as u32
    }

    /// Returns the position of a particle [m]; `None` if it does not exist.
    pub fn position(&self, particle: u32) -> Option<Vec3> {
        let at = particle as usize;
        let world = &self.world;
        (at < world.particles.len()).then(|| world.to_absolute(world.particles.x.get(at)))
    }

    /// Returns the velocity of a particle [m/s]; `None` if it does not exist.
    pub fn velocity(&self, particle: u32) -> Option<Vec3> {
        let at = particle as usize;
        (at < self.world.particles.len()).then(|| self.world.particles.v.get(at))
    }

    /// Returns the velocity of each particle [m/s].
    pub fn velocities(&self) -> impl ExactSizeIterator<Item = Vec3> + '_ {
        (0..self.world.particles.len()).map(|at| self.world.particles.v.get(at))
    }

    /// Returns the position of each particle in the rest shape [m]: where the descriptor placed it,
    /// whatever moved it since. A particle that a tear split off has that of its source; one that a
    /// cut added has the point of the rest edge that was cut.
    pub fn rest_positions(&self) -> impl ExactSizeIterator<Item = Vec3> + '_ {
        let world = &self.world;
        world.mesh.source.iter().map(|site| {
            let rest = world.rest[*site as usize];
            if world.rest_origin == Vec3::ZERO { rest } else { rest + world.rest_origin }
        })
    }

    /// Returns the mass of a particle [kg]; `None` if it does not exist.
    pub fn mass(&self, particle: u32) -> Option<f32> {
        self.world.particles.mass.get(particle as usize).copied()
    }

    /// Places a particle at `position` [m] at once. Its velocity stays as it is. A pinned particle
    /// stays pinned, at the new position.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) if `particle` does not exist;
    /// [`Error::BadValue`](crate::Error::BadValue) if `position` is not finite. The cloth is
    /// unchanged.
    pub fn set_position(&mut self, particle: u32, position: Vec3) -> Result<()> {
        check_index(particle, self.world.particles.len(), "particle")?;
        check_finite(position, "position")?;
        self.place(particle, &[position]);
        Ok(())
    }

    /// Places the particles from `first` on at `positions` [m] at once: a whole pose, if there is
    /// one position per particle. Velocities stay as they are; set them too
    /// ([`Cloth::set_velocities`]) to continue from a recorded state. Pinned particles stay pinned,
    /// at the new positions.
    ///
    /// ```
    /// use muslin::glam::Vec3;
    /// use muslin::{Cloth, GridDesc};
    ///
    /// let mut cloth = Cloth::grid(&GridDesc::default())?;
    /// let lifted: Vec<Vec3> = cloth.rest_positions().map(|rest| rest + Vec3::Y).collect();
    /// cloth.set_positions(0, &lifted)?;
    /// cloth.set_velocities(0, &vec![Vec3::ZERO; lifted.len()])?;
    /// assert_eq!(cloth.positions(), lifted);
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// - [`Error::BadIndex`](crate::Error::BadIndex) if particle `first` does not exist.
    /// - [`Error::BadValue`](crate::Error::BadValue) if there are more positions than particles
    ///   from `first` on.
    /// - [`Error::BadEntry`](crate::Error::BadEntry) names the first position that is not finite.
    ///
    /// The cloth is unchanged then.
    pub fn set_positions(&mut self, first: u32, positions: &[Vec3]) -> Result<()> {
        self.check_range(first, positions, "positions")?;
        if !positions.is_empty() {
            self.place(first, positions);
        }
        Ok(())
    }

    /// Sets the velocity of a particle [m/s].
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) if `particle` does not exist;
    /// [`Error::BadValue`](crate::Error::BadValue) if `velocity` is not finite. The cloth is
    /// unchanged.
    pub fn set_velocity(&mut self, particle: u32, velocity: Vec3) -> Result<()> {
        check_index(particle, self.world.particles.len(), "particle")?;
        check_finite(velocity, "velocity")?;
        self.launch(particle, &[velocity]);
        Ok(())
    }

    /// Sets the velocities of the particles from `first` on [m/s].
    ///
    /// # Errors
    /// As [`Cloth::set_positions`], for `velocities`. The cloth is unchanged then.
    pub fn set_velocities(&mut self, first: u32, velocities: &[Vec3]) -> Result<()> {
        self.check_range(first, velocities, "velocities")?;
        if !velocities.is_empty() {
            self.launch(first, velocities);
        }
        Ok(())
    }

    /// Checks a list with one vector for each particle from `first` on.
    fn check_range(&self, first: u32, list: &[Vec3], field: &'static str) -> Result<()> {
        let count = self.world.particles.len();
        check_index(first, count + usize::from(list.is_empty()), "first")?;
        let fits = list.len() <= count - first as usize;
        check(fits, field, "have at most as many entries as there are particles from `first` on")?;
        check_all_finite(list, field)
    }

    /// Places the particles from `first` on, whose positions were checked.
    fn place(&mut self, first: u32, positions: &[Vec3]) {
        let world = &mut *self.world;
        with_float_env(|| {
            world.move_origin_near(positions);
            for (particle, position) in (first..).zip(positions) {
                let (at, x) = (particle as usize, world.to_relative(*position));
                let v = world.particles.v.get(at);
                world.set_particle_state(at, x, v);
                world.particles.x_prev_tick.set(at, x);
                world.move_pin(particle, x);
            }
            world.is_tangled = true;
        });
        self.update_state();
    }

    /// Sets the velocities of the particles from `first` on, which were checked.
    fn launch(&mut self, first: u32, velocities: &[Vec3]) {
        let world = &mut *self.world;
        with_float_env(|| {
            for (at, velocity) in (first as usize..).zip(velocities) {
                let x = world.particles.x.get(at);
                world.set_particle_state(at, x, *velocity);
            }
        });
        self.update_state();
    }
}
