//! Mass scales: how much heavier or lighter than its material each particle is.

use serde::{Deserialize, Serialize};

/// A factor for each particle, or none where all are as heavy as the material says.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct MassScales {
    list: Vec<f32>,
}

impl MassScales {
    /// Makes room for `capacity` particles in all, if any has a factor.
    pub fn reserve(&mut self, capacity: usize) {
        if !self.list.is_empty() {
            self.list.reserve_exact(capacity.saturating_sub(self.list.len()));
        }
    }

    /// Gives one of `count` particles a factor.
    pub fn set(&mut self, particle: u32, scale: f32, count: usize) {
        self.list.resize(count, 1.0);
        self.list[particle as usize] = scale;
    }

    pub fn get(&self, particle: usize) -> f32 {
        self.list.get(particle).copied().unwrap_or(1.0)
    }

    /// Multiplies masses; changes nothing where there are no factors.
    pub fn apply(&self, mass: &mut [f32]) {
        mass.iter_mut().zip(&self.list).for_each(|(mass, scale)| *mass *= scale);
    }

    /// A particle more, as heavy as `scale` says.
    pub fn push(&mut self, scale: f32) {
        if !self.list.is_empty() {
            self.list.push(scale);
        }
    }

    /// The least and the greatest factor; 1 where there are none.
    pub fn range(&self) -> [f32; 2] {
        let first = self.get(0);
        self.list.iter().fold([first; 2], |[least, most], scale| {
            [if *scale < least { *scale } else { least }, if *scale > most { *scale } else { most }]
        })
    }

    /// Whether they are such as a cloth of `count` particles can have; for bytes from outside.
    pub fn are_valid(&self, count: usize) -> bool {
        (self.list.is_empty() || self.list.len() == count)
            && self.list.iter().all(|scale| is_valid_scale(*scale))
    }
}

/// Whether masses may be multiplied by it.
pub(crate) fn is_valid_scale(scale: f32) -> bool {
    (1.0e-3..=1.0e3).contains(&scale)
}
