//! Mass scales: a factor per particle on the mass that its material and area give.
//!
//! Invariant: the list is empty (all factors are 1) or has one entry per particle.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use serde::{Deserialize, Serialize};

/// A factor per particle; empty if all are 1.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct MassScales {
    list: Vec<f32>,
}

heap_bytes!(MassScales { list } plain {});

impl MassScales {
    /// Allocates for `capacity` particles in all, if there are factors.
    pub fn reserve(&mut self, capacity: usize) {
        if !self.list.is_empty() {
            self.list.reserve_total(capacity);
        }
    }

    /// Sets the factor of one of `count` particles.
    pub fn set(&mut self, particle: u32, scale: f32, count: usize) {
        self.list.resize(count, 1.0);
        self.list[particle as usize] = scale;
    }

    /// The factor of a particle.
    pub fn get(&self, particle: usize) -> f32 {
        self.list.get(particle).copied().unwrap_or(1.0)
    }

    /// Multiplies `mass` by the factors.
    pub fn apply(&self, mass: &mut [f32]) {
        mass.iter_mut().zip(&self.list).for_each(|(mass, scale)| *mass *= scale);
    }

    /// Appends the factor of a new particle, if there are factors.
    pub fn push(&mut self, scale: f32) {
        if !self.list.is_empty() {
            self.list.push(scale);
        }
    }

    /// The smallest and the largest factor.
    pub fn range(&self) -> [f32; 2] {
        let first = self.get(0);
        self.list.iter().fold([first; 2], |[least, most], scale| {
            [if *scale < least { *scale } else { least }, if *scale > most { *scale } else { most }]
        })
    }

    /// Returns whether the factors fit a cloth of `count` particles; for saved data.
    pub fn are_valid(&self, count: usize) -> bool {
        (self.list.is_empty() || self.list.len() == count)
            && self.list.iter().all(|scale| is_valid_scale(*scale))
    }
}

/// Returns whether a factor is in the valid range, 0.001 to 1000.
pub(crate) fn is_valid_scale(scale: f32) -> bool {
    (1.0e-3..=1.0e3).contains(&scale)
}
