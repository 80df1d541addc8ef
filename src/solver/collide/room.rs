//! How much of their gaps colliders leave to the particles between them.
//!
//! Reads and writes only its own fields.
//! Invariant: shares are in 0..=1, and 1 for all particles that are not listed in `narrowed`.

use crate::math::min;
use crate::math::reserve::ReserveTotal;

/// The share of their gaps that colliders keep from each particle.
#[derive(Clone, Debug, Default)]
pub(crate) struct Room {
    shares: Vec<f32>,
    /// The particles whose share is less than 1.
    narrowed: Vec<u32>,
}

impl Room {
    /// Removes all particles.
    pub fn clear(&mut self) {
        self.shares.clear();
        self.narrowed.clear();
    }

    /// Allocates for `particles` particles.
    pub fn reserve(&mut self, particles: usize) {
        self.shares.reserve_total(particles);
        self.shares.resize(particles, 1.0);
        self.narrowed.reserve_total(particles);
    }

    /// Gives all particles the whole gap.
    pub fn reset(&mut self) {
        for i in self.narrowed.drain(..) {
            self.shares[i as usize] = 1.0;
        }
    }

    /// Leaves a particle at most a share of the gaps that it had.
    pub fn narrow(&mut self, i: usize, share: f32) {
        if self.shares[i] == 1.0 && share < 1.0 {
            self.narrowed.push(i as u32);
        }
        self.shares[i] *= share;
    }

    /// The shares of all particles, if any has less than the whole gap.
    pub fn shares(&self) -> Option<&[f32]> {
        (!self.narrowed.is_empty()).then_some(&self.shares)
    }
}

/// Returns the least value of some particles; 1 without values.
#[inline(always)]
pub(super) fn least(values: Option<&[f32]>, corners: &[usize]) -> f32 {
    values
        .map_or(1.0, |values| corners.iter().fold(f32::INFINITY, |least, i| min(values[*i], least)))
}
