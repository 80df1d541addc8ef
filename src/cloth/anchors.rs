//! Public calls for anchors: per-particle maximum distance and backstop around an animated target.
//!
//! Game engines call these max distance and backstop (Unity, Unreal, Jolt); NvCloth calls them
//! motion and separation constraints. The constraint itself, with a diagram, is in
//! `state::anchors`.
//!
//! Reads the caller's lists; writes `World::anchors`.
//! Invariant: all lists are checked before the first constraint changes.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_finite, check_index};
use crate::math::float_env::with_float_env;
use crate::state::anchors::{AnchorConstraint, unit_or_zero};
use glam::Vec3;

impl Cloth {
    /// Limits how far particles may be from their anchors [m]. The limit holds after every tick,
    /// whatever pulls at the particle.
    ///
    /// Infinity, the initial value, means no limit; 0 fixes the particle to its anchor. Skirts and
    /// sleeves are commonly painted from 0 at the seam to 0.2 at the hem.
    ///
    /// The anchor of a particle is the position of the last [`Cloth::set_anchors`]; before the
    /// first one, it is the particle's current position. Pins and grabs take precedence over the
    /// limit. A limit may stretch the cloth past `max_stretch`; this is reported as for pins, in
    /// [`Stats::over_stretched`](crate::Stats) and by an event. [`Cloth::reset`] removes all
    /// limits.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless there is one distance per particle, each
    /// at least 0; [`Error::BadIndex`](crate::Error::BadIndex) if a particle does not exist. The
    /// cloth is unchanged.
    pub fn set_max_distances(&mut self, particles: &[u32], distances: &[f32]) -> Result<()> {
        check(
            particles.len() == distances.len(),
            "distances",
            "have as many entries as `particles`",
        )?;
        self.check_particles(particles)?;
        let are_valid = distances.iter().all(|distance| *distance >= 0.0);
        check(are_valid, "distances", "be at least 0")?;
        self.edit_anchors(particles, |at, anchor| anchor.max_distance = distances[at]);
        Ok(())
    }

    /// Gives particles backstops: spheres behind their anchors that the particles cannot enter, so
    /// that a garment does not sink into the body that wears it.
    ///
    /// Each sphere has a radius [m], 0 for none. Its surface is `distance` [m] behind the anchor,
    /// opposite to the normal of [`Cloth::set_anchors`]; a particle without a normal has no
    /// backstop. A radius that is large compared with the body makes the backstop nearly a plane.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless there is one distance and one radius per
    /// particle, each at least 0 and finite; [`Error::BadIndex`](crate::Error::BadIndex) if a
    /// particle does not exist. The cloth is unchanged.
    pub fn set_backstops(
        &mut self,
        particles: &[u32],
        distances: &[f32],
        radii: &[f32],
    ) -> Result<()> {
        check(
            particles.len() == distances.len(),
            "distances",
            "have as many entries as `particles`",
        )?;
        check(particles.len() == radii.len(), "radii", "have as many entries as `particles`")?;
        self.check_particles(particles)?;
        let all_lengths = |list: &[f32]| list.iter().all(|v| v.is_finite() && *v >= 0.0);
        check(all_lengths(distances), "distances", "be at least 0 and finite")?;
        check(all_lengths(radii), "radii", "be at least 0 and finite")?;
        self.edit_anchors(particles, |at, anchor| {
            (anchor.backstop_distance, anchor.backstop_radius) = (distances[at], radii[at]);
        });
        Ok(())
    }

    /// Sets the animated positions [m] and outward normals of particles, for
    /// [`Cloth::set_max_distances`] and [`Cloth::set_backstops`]. Call it once per frame.
    ///
    /// Anchors move to the new positions evenly over the ticks of the next [`Cloth::advance`], or in
    /// the next tick of [`Cloth::step`]; a particle's first anchor is in place at once. Normals
    /// need not have length 1. An empty `normals` keeps the previous normals.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless there is one position per particle, and
    /// one normal per particle or none, all finite and no normal of length 0;
    /// [`Error::BadIndex`](crate::Error::BadIndex) if a particle does not exist. The cloth is
    /// unchanged.
    pub fn set_anchors(
        &mut self,
        particles: &[u32],
        positions: &[Vec3],
        normals: &[Vec3],
    ) -> Result<()> {
        check(
            particles.len() == positions.len(),
            "positions",
            "have as many entries as `particles`",
        )?;
        let fits = normals.is_empty() || particles.len() == normals.len();
        check(fits, "normals", "have as many entries as `particles`, or none")?;
        self.check_particles(particles)?;
        positions.iter().try_for_each(|position| check_finite(*position, "positions"))?;
        normals.iter().try_for_each(|normal| check_finite(*normal, "normals"))?;
        let normals =
            with_float_env(|| -> Vec<Vec3> { normals.iter().map(|n| unit_or_zero(*n)).collect() });
        let are_nonzero = normals.iter().all(|n| n.is_finite() && *n != Vec3::ZERO);
        check(are_nonzero, "normals", "have a length above 0")?;
        let world = &mut *self.world;
        for (at, particle) in particles.iter().enumerate() {
            let position = world.to_relative(positions[at]);
            let constraint = world.anchors.get_or_insert(*particle, position);
            constraint.anchor = position;
            if let Some(normal) = normals.get(at) {
                constraint.normal = *normal;
                if constraint.normal_from == Vec3::ZERO {
                    constraint.normal_from = *normal;
                }
            }
        }
        world.reserve_anchor_scratch();
        Ok(())
    }

    /// Removes all anchors, maximum distances and backstops.
    pub fn clear_leashes(&mut self) {
        self.world.anchors.clear();
        self.world.wake();
    }

    fn check_particles(&self, particles: &[u32]) -> Result<()> {
        let count = self.world.particles.len();
        particles.iter().try_for_each(|particle| check_index(*particle, count, "particles"))
    }

    /// Calls `change` with each list index and the constraint of that particle, which is made if
    /// missing.
    fn edit_anchors(&mut self, particles: &[u32], change: impl Fn(usize, &mut AnchorConstraint)) {
        let world = &mut *self.world;
        for (at, particle) in particles.iter().enumerate() {
            let x = world.particles.x.get(*particle as usize);
            change(at, world.anchors.get_or_insert(*particle, x));
        }
        world.reserve_anchor_scratch();
        world.wake();
    }
}
