//! Particles on a leash: no farther from where animation has them than they may be, and not in their backstop.
//!
//! What games call max distance and backstop (Unity, Unreal, Jolt), and NvCloth motion and separation
//! constraints.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_finite, check_index};
use crate::math::float_env::with_float_env;
use crate::state::anchors::{AnchorConstraint, unit_or_zero};
use glam::Vec3;

impl Cloth {
    /// Says how far particles may be from their anchors [m]: after every tick none is farther, whatever pulls
    /// at it. Infinity, as at first, is as far as they like; 0 holds them there. Skirts and sleeves are
    /// commonly painted from 0 at the seam to 0.2 at the hem.
    ///
    /// The anchor of a particle is where [`Cloth::set_anchors`] has it, and until that was called where the
    /// particle is now. A pinned or grabbed particle goes by that alone. What keeps a cloth apart so may stretch
    /// it past `max_stretch`, which is told as if pins did.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless there are as many distances as particles, all at
    /// least 0; [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not.
    pub fn set_max_distances(&mut self, particles: &[u32], distances: &[f32]) -> Result<()> {
        check(particles.len() == distances.len(), "distances", "be as many as `particles`")?;
        self.check_particles(particles)?;
        let are_distances = distances.iter().all(|distance| *distance >= 0.0);
        check(are_distances, "distances", "be at least 0")?;
        self.leash(particles, |at, leash| leash.max_distance = distances[at]);
        Ok(())
    }

    /// Gives particles backstops: spheres behind their anchors that they stay out of, so that a garment does
    /// not sink into the body that wears it. Each has a radius [m], 0 for none, and begins a distance [m]
    /// behind its anchor, against the normal that [`Cloth::set_anchors`] gave: without one there is no
    /// backstop. A radius that is large beside that of the body makes it all but a plane.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless there are as many distances and radii as particles,
    /// all at least 0 and finite; [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not.
    pub fn set_backstops(
        &mut self,
        particles: &[u32],
        distances: &[f32],
        radii: &[f32],
    ) -> Result<()> {
        check(particles.len() == distances.len(), "distances", "be as many as `particles`")?;
        check(particles.len() == radii.len(), "radii", "be as many as `particles`")?;
        self.check_particles(particles)?;
        let are_lengths = |list: &[f32]| list.iter().all(|v| v.is_finite() && *v >= 0.0);
        check(are_lengths(distances), "distances", "be at least 0 and finite")?;
        check(are_lengths(radii), "radii", "be at least 0 and finite")?;
        self.leash(particles, |at, leash| {
            (leash.backstop_distance, leash.backstop_radius) = (distances[at], radii[at]);
        });
        Ok(())
    }

    /// Says where animation has particles [m], and which way is out of the body there, for
    /// [`Cloth::set_max_distances`] and [`Cloth::set_backstops`]. Call it each frame: anchors get there over the
    /// next tick, and those of particles that had none are there at once. Normals need not be of length 1;
    /// with none at all those of before stay.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless there are as many positions as particles, and as
    /// many normals or none, all finite and no normal zero; [`Error::BadIndex`](crate::Error::BadIndex) for a
    /// particle that is not.
    pub fn set_anchors(
        &mut self,
        particles: &[u32],
        positions: &[Vec3],
        normals: &[Vec3],
    ) -> Result<()> {
        check(particles.len() == positions.len(), "positions", "be as many as `particles`")?;
        let fits = normals.is_empty() || particles.len() == normals.len();
        check(fits, "normals", "be as many as `particles`, or none")?;
        self.check_particles(particles)?;
        positions.iter().try_for_each(|position| check_finite(*position, "positions"))?;
        normals.iter().try_for_each(|normal| check_finite(*normal, "normals"))?;
        let normals =
            with_float_env(|| -> Vec<Vec3> { normals.iter().map(|n| unit_or_zero(*n)).collect() });
        let are_directions = normals.iter().all(|n| n.is_finite() && *n != Vec3::ZERO);
        check(are_directions, "normals", "have a length that numbers can tell from 0")?;
        let world = &mut self.world;
        for (at, particle) in particles.iter().enumerate() {
            let leash = world.anchors.get_or_insert(*particle, positions[at]);
            leash.anchor = positions[at];
            if let Some(normal) = normals.get(at) {
                leash.normal = *normal;
                if leash.normal_from == Vec3::ZERO {
                    leash.normal_from = *normal;
                }
            }
        }
        world.reserve_anchor_scratch();
        Ok(())
    }

    /// Takes away all anchors, maximum distances and backstops.
    pub fn clear_leashes(&mut self) {
        self.world.anchors.clear();
        self.world.wake();
    }

    fn check_particles(&self, particles: &[u32]) -> Result<()> {
        let count = self.world.particles.len();
        particles.iter().try_for_each(|particle| check_index(*particle, count, "particles"))
    }

    fn leash(&mut self, particles: &[u32], change: impl Fn(usize, &mut AnchorConstraint)) {
        let world = &mut self.world;
        for (at, particle) in particles.iter().enumerate() {
            let x = world.particles.x.at(*particle as usize);
            change(at, world.anchors.get_or_insert(*particle, x));
        }
        world.reserve_anchor_scratch();
        world.wake();
    }
}
