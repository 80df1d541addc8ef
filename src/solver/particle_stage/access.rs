//! Random access to particles by index: one particle, or one per SIMD lane (gather and scatter).
//!
//! [`ParticleAccess`] hides the memory layout from kernels: a kernel is compiled once for columns
//! ([`Particles`], [`ParticleSlices`]) and once for the interleaved layout.
//!
//! Reads and writes whatever the layout borrows; inverse masses are read only.
//! Invariant: the indices of one [`scatter_positions`] call are distinct, so the order of the lanes
//! does not change the result.

use crate::math::columns::Columns;
use crate::math::simd::{LANES, Simd};
use crate::state::particles::Particles;
use glam::Vec3;

/// A particle layout that kernels read and write by particle index.
pub(crate) trait ParticleAccess {
    /// The position [m] and the inverse mass [1/kg] of particle `i`.
    fn particle(&self, i: usize) -> (Vec3, f32);

    /// Sets the position of particle `i` [m].
    fn set_position(&mut self, i: usize, x: Vec3);
}

impl ParticleAccess for Particles {
    #[inline(always)]
    fn particle(&self, i: usize) -> (Vec3, f32) {
        (self.x.get(i), self.w[i])
    }

    #[inline(always)]
    fn set_position(&mut self, i: usize, x: Vec3) {
        self.x.set(i, x);
    }
}

/// Columns of positions and inverse masses, cut to one length so that the compiler needs one bounds
/// check per particle instead of four.
pub(crate) struct ParticleSlices<'a> {
    x: [&'a mut [f32]; 3],
    w: &'a [f32],
}

impl<'a> ParticleSlices<'a> {
    #[inline(always)]
    pub fn new(p: &'a mut Particles) -> Self {
        let count = p.w.len();
        let Columns { x, y, z } = &mut p.x;
        Self { x: [&mut x[..count], &mut y[..count], &mut z[..count]], w: &p.w[..count] }
    }
}

impl ParticleAccess for ParticleSlices<'_> {
    #[inline(always)]
    fn particle(&self, i: usize) -> (Vec3, f32) {
        let [x, y, z] = &self.x;
        (Vec3::new(x[i], y[i], z[i]), self.w[i])
    }

    #[inline(always)]
    fn set_position(&mut self, i: usize, at: Vec3) {
        let [x, y, z] = &mut self.x;
        (x[i], y[i], z[i]) = (at.x, at.y, at.z);
    }
}

/// Gathers the positions and inverse masses of the first `S::LANES` particles of `indices`.
#[inline(always)]
pub(crate) fn gather_particles<S: Simd, P: ParticleAccess>(
    s: S,
    particles: &P,
    indices: &[u32],
) -> ([S::F; 3], S::F) {
    let indices = &indices[..S::LANES];
    let (mut x, mut w) = ([[0.0; LANES]; 3], [0.0; LANES]);
    for lane in 0..S::LANES {
        let (position, weight) = particles.particle(indices[lane] as usize);
        (x[0][lane], x[1][lane], x[2][lane], w[lane]) =
            (position.x, position.y, position.z, weight);
    }
    ([s.load(&x[0], 0), s.load(&x[1], 0), s.load(&x[2], 0)], s.load(&w, 0))
}

/// Scatters `positions` to the first `S::LANES` particles of `indices`, which are distinct.
#[inline(always)]
pub(crate) fn scatter_positions<S: Simd, P: ParticleAccess>(
    s: S,
    particles: &mut P,
    indices: &[u32],
    positions: [S::F; 3],
) {
    let indices = &indices[..S::LANES];
    let mut x = [[0.0; LANES]; 3];
    for axis in 0..3 {
        s.store(&mut x[axis], 0, positions[axis]);
    }
    for lane in 0..S::LANES {
        let position = Vec3::new(x[0][lane], x[1][lane], x[2][lane]);
        particles.set_position(indices[lane] as usize, position);
    }
}
