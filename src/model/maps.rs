//! Painted maps: a factor per particle on what the material says.
//!
//! ```text
//! link, hinge, triangle, pair of layers:   value of the material · mean of the factors at its corners
//! point of a triangle:                     value of the material · Σ weightₖ factorₖ
//! ```
//! Weight maps as artists paint them: one number per vertex, 1 for what the material says.
//!
//! Reads nothing; `cloth` sets the maps, and tears and cuts append the factors of new particles.
//! Invariant: a map is empty (all factors are 1) or has one factor per particle, each in the valid
//! range.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::math::{max, min};
use serde::{Deserialize, Serialize};

/// The value of the material that a painted map scales, see
/// [`Cloth::set_map`](crate::Cloth::set_map).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum Map {
    /// Stiffness against stretch and shear. Links without compliance (a stiffness of 0) stay rigid;
    /// at scale 0 other links do not resist.
    Stretch = 0,
    /// Bending rigidity; at scale 0 the cloth is limp. Does not act on a `bend_stiffness` from 1 on.
    Bend = 1,
    /// Strength: the strain at which an edge tears, `tear_stretch` - 1. At scale 0 an edge tears as
    /// soon as it is stretched at all; a large scale keeps it from tearing.
    Tear = 2,
    /// Coefficient of friction of contacts with colliders and of surface self-collision.
    Friction = 3,
    /// Distance from colliders and between layers in self-collision.
    Thickness = 4,
    /// Drag coefficient; lift stays as it is.
    Drag = 5,
}

impl Map {
    /// All maps, in the order of their numbers.
    pub const ALL: [Self; 6] =
        [Self::Stretch, Self::Bend, Self::Tear, Self::Friction, Self::Thickness, Self::Drag];
}

/// Largest factor.
const MAX_SCALE: f32 = 1000.0;

/// The maps of a cloth.
#[derive(Clone, Debug, Default)]
pub(crate) struct Maps {
    /// The factors of each particle, by map; empty if all are 1.
    lists: [Vec<f32>; Map::ALL.len()],
    /// Counter of changes.
    pub revision: u32,
}

heap_bytes!(Maps { lists } plain { revision });

impl Maps {
    /// Replaces a map, with room for `capacity` particles; no scales take it away.
    pub fn set(&mut self, map: Map, scales: &[f32], capacity: usize) {
        let list = &mut self.lists[map as usize];
        *list = Vec::new();
        if !scales.is_empty() {
            list.reserve_total(capacity);
            list.extend_from_slice(scales);
        }
        self.revision = self.revision.wrapping_add(1);
    }

    /// The factors of a map; `None` if it is not set.
    pub fn get(&self, map: Map) -> Option<&[f32]> {
        let list = &self.lists[map as usize][..];
        (!list.is_empty()).then_some(list)
    }

    /// The mean factor of some particles; 1 if the map is not set.
    #[inline(never)]
    pub fn mean(&self, map: Map, particles: &[u32]) -> f32 {
        self.get(map).map_or(1.0, |scales| mean(scales, particles))
    }

    /// The smallest and the largest factor of a map; 1 and 1 if it is not set.
    #[inline(never)]
    pub fn range(&self, map: Map) -> [f32; 2] {
        let list = self.get(map).unwrap_or(&[1.0]);
        list.iter()
            .fold([list[0]; 2], |[least, most], scale| [min(least, *scale), max(most, *scale)])
    }

    /// Allocates for `capacity` particles in all, in the maps that are set.
    pub fn reserve(&mut self, capacity: usize) {
        self.lists_in_use().for_each(|list| list.reserve_total(capacity));
    }

    /// Appends the factors of a new particle between `a` and `b`, at `share` of the way.
    pub fn push_between(&mut self, [a, b]: [u32; 2], share: f32) {
        for list in self.lists_in_use() {
            let [a, b] = [list[a as usize], list[b as usize]];
            list.push(a + (b - a) * share);
        }
    }

    /// Keeps the factors of the first `count` particles.
    pub fn truncate(&mut self, count: usize) {
        self.lists.iter_mut().for_each(|list| list.truncate(count));
    }

    /// The maps that are set, with their numbers.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &[f32])> {
        (0..)
            .zip(&self.lists)
            .filter(|(_, list)| !list.is_empty())
            .map(|(map, list)| (map, &list[..]))
    }

    /// The maps that are set, as bits, and their factors one after the other, for a save.
    pub fn saved(&self) -> (u32, Vec<f32>) {
        let (mut bits, mut all) = (0, Vec::new());
        for (map, list) in self.iter() {
            bits |= 1 << map;
            all.extend_from_slice(list);
        }
        (bits, all)
    }

    /// Replaces the maps by saved ones. Returns false if they do not fit a cloth of `count` particles.
    pub fn restore(&mut self, (bits, all): (u32, Vec<f32>), count: usize) -> bool {
        let is_set = |map: &Map| bits >> *map as u32 & 1 == 1;
        let mut lists = all.chunks_exact(count.max(1));
        for map in Map::ALL.into_iter().filter(is_set) {
            self.set(map, lists.next().unwrap_or_default(), count);
        }
        let fits = all.len() == count * bits.count_ones() as usize && bits < 1 << Map::ALL.len();
        fits && all.iter().all(is_valid_map_scale)
    }

    fn lists_in_use(&mut self) -> impl Iterator<Item = &mut Vec<f32>> {
        self.lists.iter_mut().filter(|list| !list.is_empty())
    }
}

/// The mean factor of some particles.
#[inline(never)]
pub(crate) fn mean(scales: &[f32], particles: &[u32]) -> f32 {
    let sum: f32 = particles.iter().map(|particle| scales[*particle as usize]).sum();
    sum / particles.len() as f32
}

/// Returns whether a factor is in the valid range, 0 to 1000.
pub(crate) fn is_valid_map_scale(scale: &f32) -> bool {
    (0.0..=MAX_SCALE).contains(scale)
}
