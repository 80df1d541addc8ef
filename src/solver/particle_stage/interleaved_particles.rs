//! Interleaved positions for the distance constraints and the implicit bending of meshes.
//!
//! The position of a particle is one load of `[x, y, z, 0]`, whatever its index is; columns
//! would need three loads from three cache lines. Inverse masses stay in a list of their own,
//! because most links have the weights of their ends beside them (see `stretch::end_weights`).
//!
//! `gather` reads the columns of `Particles`; `scatter` writes the positions back to them.
//! Invariant: while `is_current`, these positions are the valid ones and the columns are out of
//! date.

use crate::math::columns::Columns;
use crate::math::reserve::ReserveTotal;
use crate::solver::particle_stage::access::ParticleAccess;
use crate::state::particles::Particles;
use glam::Vec3;

/// Positions of all particles, interleaved, and their inverse masses.
#[derive(Clone, Debug, Default)]
pub(crate) struct InterleavedParticles {
    /// `[x, y, z, 0]` of each particle [m].
    pub points: Vec<[f32; 4]>,
    /// Whether the positions are here and not in their columns.
    pub is_current: bool,
    /// Inverse mass of each particle [1/kg].
    pub w: Vec<f32>,
}

impl InterleavedParticles {
    /// Grows the capacity to `particles` in all.
    pub fn reserve(&mut self, particles: usize) {
        self.points.reserve_total(particles);
        self.w.reserve_total(particles);
    }

    /// Removes all particles.
    pub fn clear(&mut self) {
        self.points.clear();
        self.w.clear();
        self.is_current = false;
    }

    /// Copies positions and inverse masses from their columns.
    pub fn gather(&mut self, p: &Particles) {
        self.points.clear();
        let particles = p.x.x.iter().zip(&*p.x.y).zip(&*p.x.z);
        self.points.extend(particles.map(|((x, y), z)| [*x, *y, *z, 0.0]));
        self.w.clone_from(&p.w);
        self.is_current = true;
    }

    /// Copies positions back to their columns, if they are here.
    pub fn scatter(&mut self, x: &mut Columns) {
        if !core::mem::take(&mut self.is_current) {
            return;
        }
        let particles = x.x.iter_mut().zip(&mut *x.y).zip(&mut *x.z);
        for (((x, y), z), point) in particles.zip(&self.points) {
            [*x, *y, *z, _] = *point;
        }
    }
}

impl ParticleAccess for InterleavedParticles {
    #[inline(always)]
    fn particle(&self, i: usize) -> (Vec3, f32) {
        let [x, y, z, _] = self.points[i];
        (Vec3::new(x, y, z), self.w[i])
    }

    #[inline(always)]
    fn set_position(&mut self, i: usize, x: Vec3) {
        self.points[i][..3].copy_from_slice(&x.to_array());
    }
}
