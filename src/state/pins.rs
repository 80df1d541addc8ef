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

    pub fn find(&self, particle: u32) -> Option<&Pin> {
        let at = self.list.binary_search_by_key(&particle, |pin| pin.particle).ok()?;
        Some(&self.list[at])
    }

    /// Pins a particle that is at `x`, or gives an old pin a new target. True if it is a new pin.
    pub fn insert(&mut self, particle: u32, x: Vec3, target: Vec3) -> bool {
        match self.list.binary_search_by_key(&particle, |pin| pin.particle) {
            Ok(at) => {
                self.list[at].target = target;
                false
            }
            Err(at) => {
                self.list.insert(at, Pin { particle, from: x, target });
                true
            }
        }
    }

    /// True if there was such a pin.
    pub fn remove(&mut self, particle: u32) -> bool {
        let found = self.list.binary_search_by_key(&particle, |pin| pin.particle);
        found.map(|at| self.list.remove(at)).is_ok()
    }

    pub fn clear(&mut self) {
        self.list.clear();
    }

    /// Whether particles rise strictly, as they always do; for bytes from outside.
    pub fn is_sorted(&self) -> bool {
        self.list.is_sorted_by(|a, b| a.particle < b.particle)
    }

    /// The tick is over: every pin is where it was to be.
    pub fn arrive(&mut self) {
        self.list.iter_mut().for_each(|pin| pin.from = pin.target);
    }
}
