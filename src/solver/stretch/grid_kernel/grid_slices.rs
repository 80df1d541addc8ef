//! The columns of particles and links that the kernels of a grid work on, whole or in part.
//!
//! With several threads each thread has the slices of its band, which begin at the first particle
//! and link of the band. With one thread they begin at 0.
//!
//! Reads nothing by itself; kernels write `x`, `y`, `z` and `lambda` through it.
//! Invariant: the particle lists have one length, and so have the link lists.

use crate::model::grid_rows::{LinkRow, RowPattern};
use crate::solver::particle_stage::access::ParticleAccess;
use glam::Vec3;

/// `RowPattern::Straight` as a constant that kernels can be generic over.
pub(crate) const STRAIGHT: u8 = RowPattern::Straight as u8;
/// `RowPattern::Pairs`, likewise.
pub(crate) const PAIRS: u8 = RowPattern::Pairs as u8;
/// `RowPattern::Quads`, likewise.
pub(crate) const QUADS: u8 = RowPattern::Quads as u8;

/// Columns of particles and links, from a first particle and a first link on.
pub(crate) struct GridSlices<'a> {
    pub first_particle: u32,
    pub first_link: u32,
    pub x: &'a mut [f32],
    pub y: &'a mut [f32],
    pub z: &'a mut [f32],
    pub w: &'a [f32],
    /// 1 for a link that is in its row, 0 for one that left it.
    pub mask: &'a [f32],
    pub rest: &'a [f32],
    pub compliance: &'a [f32],
    /// The weights of the links' ends, see `end_weights`.
    pub ends: [&'a [f32]; 2],
    pub lambda: &'a mut [f32],
}

impl GridSlices<'_> {
    /// A row with its indices relative to these slices.
    #[inline(always)]
    pub fn to_local(&self, row: &LinkRow) -> LinkRow {
        let (a, b) = (row.a - self.first_particle, row.b - self.first_particle);
        LinkRow { a, b, first: row.first - self.first_link, ..*row }
    }
}

impl ParticleAccess for GridSlices<'_> {
    #[inline(always)]
    fn particle(&self, i: usize) -> (Vec3, f32) {
        (Vec3::new(self.x[i], self.y[i], self.z[i]), self.w[i])
    }

    #[inline(always)]
    fn set_position(&mut self, i: usize, x: Vec3) {
        (self.x[i], self.y[i], self.z[i]) = (x.x, x.y, x.z);
    }
}
