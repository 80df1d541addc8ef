//! Pins: particles held at a target that may move.
//!
//! A hard pin sets the inverse mass of its particle to 0. A soft pin pulls with a stiffness k; an
//! implicit step of length s gives its particle the effective inverse mass 1 / (m + k s²).
//!
//! Invariant: the list is sorted by particle, so that the order of processing comes from the mesh.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// One pinned particle. Field order is part of the save format.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pin {
    pub particle: u32,
    /// Target at the end of the last tick [m].
    pub from: Vec3,
    /// Target at the end of the next tick [m].
    pub target: Vec3,
    /// Stiffness towards the target [N/m]; 0 holds the particle exactly there.
    pub stiffness: f32,
    /// Handle of the attachment that moves this pin; 0 if none does.
    pub attachment: u32,
    /// Target in the frame of that attachment [m].
    pub local: Vec3,
    /// Target at the end of an `advance` [m], while its ticks run; see
    /// `solver::kinematic::tick_targets`.
    #[serde(skip)]
    pub final_target: Vec3,
}

impl Pin {
    /// A hard pin that moves between two positions.
    fn new(particle: u32, from: Vec3, target: Vec3) -> Self {
        Self {
            particle,
            from,
            target,
            stiffness: 0.0,
            attachment: 0,
            local: Vec3::ZERO,
            final_target: target,
        }
    }

    /// Returns whether the pin has a finite stiffness.
    pub fn is_soft(&self) -> bool {
        self.stiffness > 0.0
    }

    /// Inverse mass with the inertia of a soft pin over a step of `step` seconds [1/kg], see
    /// `solver::kinematic`.
    pub fn effective_inverse_mass(&self, mass: f32, step: f32) -> f32 {
        1.0 / (mass + self.stiffness * step * step)
    }

    /// Returns whether all numbers are finite and the stiffness is not negative; for saved data.
    pub fn is_valid(&self) -> bool {
        let places = [self.from, self.target, self.local];
        places.iter().all(|v| v.is_finite()) && self.stiffness.is_finite() && self.stiffness >= 0.0
    }
}

/// All pins, sorted by particle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pins {
    list: Vec<Pin>,
}

heap_bytes!(Pins { list } plain {});

impl Pins {
    /// Allocates for `capacity` pins in all.
    pub fn reserve(&mut self, capacity: usize) {
        self.list.reserve_total(capacity);
    }

    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Pin> + Clone {
        self.list.iter()
    }

    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Pin> {
        self.list.iter_mut()
    }

    /// The particles with a hard pin.
    pub fn hard_particles(&self) -> impl Iterator<Item = u32> + Clone {
        self.list.iter().filter(|pin| !pin.is_soft()).map(|pin| pin.particle)
    }

    /// Returns whether any pin is soft.
    pub fn has_soft(&self) -> bool {
        self.list.iter().any(Pin::is_soft)
    }

    fn search(&self, particle: u32) -> Result<usize, usize> {
        self.list.binary_search_by_key(&particle, |pin| pin.particle)
    }

    pub fn get(&self, particle: u32) -> Option<&Pin> {
        Some(&self.list[self.search(particle).ok()?])
    }

    pub fn get_mut(&mut self, particle: u32) -> Option<&mut Pin> {
        let at = self.search(particle).ok()?;
        Some(&mut self.list[at])
    }

    /// Pins a particle at position `x` to `target`, or retargets its pin and detaches it. Returns
    /// true if the pin is new.
    pub fn insert(&mut self, particle: u32, x: Vec3, target: Vec3) -> bool {
        match self.search(particle) {
            Ok(at) => {
                (self.list[at].target, self.list[at].attachment) = (target, 0);
                false
            }
            Err(at) => {
                self.list.insert(at, Pin::new(particle, x, target));
                true
            }
        }
    }

    /// Pins a particle like `pin`, unless it is pinned already.
    pub fn insert_copy(&mut self, particle: u32, pin: Pin) {
        if let Err(at) = self.search(particle) {
            self.list.insert(at, Pin { particle, ..pin });
        }
    }

    /// Removes the pin of a particle. Returns whether there was one.
    pub fn remove(&mut self, particle: u32) -> bool {
        self.search(particle).map(|at| self.list.remove(at)).is_ok()
    }

    /// Removes all pins that an attachment moves. Returns whether there were any.
    pub fn remove_attached(&mut self, attachment: u32) -> bool {
        let before = self.list.len();
        self.list.retain(|pin| pin.attachment != attachment);
        self.list.len() < before
    }

    pub fn clear(&mut self) {
        self.list.clear();
    }

    /// Returns whether particles strictly ascend; for saved data.
    pub fn is_sorted(&self) -> bool {
        self.list.is_sorted_by(|a, b| a.particle < b.particle)
    }

    /// Completes the motion of a tick: every pin has arrived at its target.
    pub fn finish_tick(&mut self) {
        self.list.iter_mut().for_each(|pin| pin.from = pin.target);
    }
}
