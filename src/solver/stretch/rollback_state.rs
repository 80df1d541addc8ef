//! The positions that the strain limit falls back to, and the particles sorted by piece.
//!
//! Written by `rollback::compute`, read by `strain_limit`.
//! Invariant: has capacity for all particles and pieces that tears may still make, so that no tick
//! allocates.

use crate::math::columns::Columns;

/// The rollback position of each particle [m], and scratch buffers to compute it.
#[derive(Clone, Debug, Default)]
pub(crate) struct RollbackState {
    pub positions: Columns,
    /// Particles sorted by piece (counting sort).
    pub order: Vec<u32>,
    /// Where each piece ends in `order`.
    pub ends: Vec<u32>,
}

impl RollbackState {
    /// Allocates buffers for `particles` particles in at most `triangles` pieces.
    pub fn with_capacity(particles: usize, triangles: usize) -> Self {
        Self {
            positions: Columns::with_capacity(particles),
            order: Vec::with_capacity(particles),
            ends: Vec::with_capacity(triangles),
        }
    }

    /// Grows the capacity to `triangles` triangles, each of which may become a piece.
    pub fn reserve(&mut self, triangles: usize) {
        self.ends.reserve_exact(triangles.saturating_sub(self.ends.len()));
    }

    /// The particles of each piece.
    pub fn pieces(&self) -> impl Iterator<Item = &[u32]> {
        let starts = core::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(start, end)| &self.order[*start as usize..*end as usize])
    }

    /// Sorts the particles `0..particles` by their piece; those without a piece are left out.
    pub fn sort_by_piece(
        &mut self,
        particles: usize,
        pieces: usize,
        piece_of: impl Fn(usize) -> Option<usize>,
    ) {
        let Self { order, ends, .. } = self;
        let members = || (0..particles).filter_map(|i| piece_of(i).map(|piece| (i, piece)));
        ends.clear();
        ends.resize(pieces, 0);
        members().for_each(|(_, piece)| ends[piece] += 1);
        let mut before = 0;
        for end in ends.iter_mut() {
            before += core::mem::replace(end, before);
        }
        order.clear();
        order.resize(before as usize, 0);
        for (particle, piece) in members() {
            order[ends[piece] as usize] = particle as u32;
            ends[piece] += 1;
        }
    }
}
