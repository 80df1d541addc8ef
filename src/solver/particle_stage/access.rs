//! Where kernels find the particles of what lies anywhere: one by one, or some side by side in lanes.

use crate::math::columns::Columns;
use crate::math::simd::{LANES, Simd};
use crate::state::particles::Particles;
use glam::Vec3;

/// Where particles are while something moves them.
pub(crate) trait Spots {
    /// A particle's position and inverse mass.
    fn spot(&self, i: usize) -> (Vec3, f32);

    /// Moves a particle.
    fn put(&mut self, i: usize, x: Vec3);
}

impl Spots for Particles {
    #[inline(always)]
    fn spot(&self, i: usize) -> (Vec3, f32) {
        (self.x.at(i), self.w[i])
    }

    #[inline(always)]
    fn put(&mut self, i: usize, x: Vec3) {
        self.x.set(i, x);
    }
}

/// Particles in columns that are all as long as each other, so that one check does for all.
pub(crate) struct Sheet<'a> {
    x: [&'a mut [f32]; 3],
    w: &'a [f32],
}

impl<'a> Sheet<'a> {
    #[inline(always)]
    pub fn new(p: &'a mut Particles) -> Self {
        let count = p.w.len();
        let Columns { x, y, z } = &mut p.x;
        Self { x: [&mut x[..count], &mut y[..count], &mut z[..count]], w: &p.w[..count] }
    }
}

impl Spots for Sheet<'_> {
    #[inline(always)]
    fn spot(&self, i: usize) -> (Vec3, f32) {
        let [x, y, z] = &self.x;
        (Vec3::new(x[i], y[i], z[i]), self.w[i])
    }

    #[inline(always)]
    fn put(&mut self, i: usize, at: Vec3) {
        let [x, y, z] = &mut self.x;
        (x[i], y[i], z[i]) = (at.x, at.y, at.z);
    }
}

/// The positions and inverse masses of as many particles as there are lanes.
#[inline(always)]
pub(crate) fn fetch<S: Simd, P: Spots>(s: S, spots: &P, at: &[u32]) -> ([S::F; 3], S::F) {
    let at = &at[..S::LANES];
    let (mut x, mut w) = ([[0.0; LANES]; 3], [0.0; LANES]);
    for lane in 0..S::LANES {
        let (spot, weight) = spots.spot(at[lane] as usize);
        (x[0][lane], x[1][lane], x[2][lane], w[lane]) = (spot.x, spot.y, spot.z, weight);
    }
    ([s.load(&x[0], 0), s.load(&x[1], 0), s.load(&x[2], 0)], s.load(&w, 0))
}

/// Moves as many particles as there are lanes, no two of them the same.
#[inline(always)]
pub(crate) fn put<S: Simd, P: Spots>(s: S, spots: &mut P, at: &[u32], to: [S::F; 3]) {
    let at = &at[..S::LANES];
    let mut x = [[0.0; LANES]; 3];
    for axis in 0..3 {
        s.store(&mut x[axis], 0, to[axis]);
    }
    for lane in 0..S::LANES {
        spots.put(at[lane] as usize, Vec3::new(x[0][lane], x[1][lane], x[2][lane]));
    }
}
