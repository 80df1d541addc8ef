//! Pins: particles held at a target that may move.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// One held particle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pin {
    pub particle: u32,
    /// Where it was held at the end of the last tick [m].
    pub from: Vec3,
    /// Where it is held at the end of the next tick [m].
    pub target: Vec3,
    /// How hard it pulls towards its target [N/m]; 0 if it holds the particle exactly there.
    pub stiffness: f32,
    /// The attachment that carries it, 0 if none does, …
    pub attachment: u32,
    /// … and where its target is as that sees it [m].
    pub local: Vec3,
}

impl Pin {
    /// A pin that holds a particle exactly, on its way between two places.
    fn new(particle: u32, from: Vec3, target: Vec3) -> Self {
        Self { particle, from, target, stiffness: 0.0, attachment: 0, local: Vec3::ZERO }
    }

    /// Whether it gives way to the cloth.
    pub fn is_soft(&self) -> bool {
        self.stiffness > 0.0
    }

    /// The inverse of a mass and of what a soft pin adds to it over a step [1/kg], see `solver::hold`.
    pub fn effective_inverse_mass(&self, mass: f32, step: f32) -> f32 {
        1.0 / (mass + self.stiffness * step * step)
    }

    /// Whether its numbers are such as a pin can have; for bytes from outside.
    pub fn is_valid(&self) -> bool {
        let places = [self.from, self.target, self.local];
        places.iter().all(|v| v.is_finite()) && self.stiffness.is_finite() && self.stiffness >= 0.0
    }
}

/// All pins, sorted by particle, so that order comes from the mesh.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pins {
    list: Vec<Pin>,
}

impl Pins {
    /// Makes room for `capacity` pins in all.
    pub fn reserve(&mut self, capacity: usize) {
        self.list.reserve_exact(capacity.saturating_sub(self.list.len()));
    }

    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Pin> + Clone {
        self.list.iter()
    }

    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Pin> {
        self.list.iter_mut()
    }

    /// The particles that are held exactly.
    pub fn hard_particles(&self) -> impl Iterator<Item = u32> + Clone {
        self.list.iter().filter(|pin| !pin.is_soft()).map(|pin| pin.particle)
    }

    /// Whether any gives way to the cloth.
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

    /// Pins a particle that is at `x`, or gives an old pin a new target, which nothing carries. True if it is
    /// a new pin.
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

    /// Pins a particle that was not pinned just as another one.
    pub fn insert_copy(&mut self, particle: u32, pin: Pin) {
        if let Err(at) = self.search(particle) {
            self.list.insert(at, Pin { particle, ..pin });
        }
    }

    /// True if there was such a pin.
    pub fn remove(&mut self, particle: u32) -> bool {
        self.search(particle).map(|at| self.list.remove(at)).is_ok()
    }

    /// Removes all that an attachment carries. True if there were any.
    pub fn remove_attached(&mut self, attachment: u32) -> bool {
        let before = self.list.len();
        self.list.retain(|pin| pin.attachment != attachment);
        self.list.len() < before
    }

    pub fn clear(&mut self) {
        self.list.clear();
    }

    /// Whether particles rise strictly, as they always do; for bytes from outside.
    pub fn is_sorted(&self) -> bool {
        self.list.is_sorted_by(|a, b| a.particle < b.particle)
    }

    /// The tick is over: every pin is where it was to be.
    pub fn finish_tick(&mut self) {
        self.list.iter_mut().for_each(|pin| pin.from = pin.target);
    }
}
