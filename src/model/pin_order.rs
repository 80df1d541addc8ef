//! Pin order: links sorted by their distance from the pins, the order in which one sweep of the
//! strain limit corrects a hanging chain.
//!
//! Reads `Tethers` and `Links`; writes the order.
//!
//! Invariant: current after `rebuild`, which must run whenever the tethers change.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::math::sort::sort_by;
use crate::model::links::Links;
use crate::model::tethers::Tethers;

/// Links sorted by the distance of their farther end from the pins.
#[derive(Clone, Debug, Default)]
pub(crate) struct PinOrder {
    order: Vec<u32>,
    /// Geodesic distance of each particle to the nearest pin [m]; infinite where there is none.
    distance: Vec<f32>,
}

heap_bytes!(PinOrder { order, distance } plain {});

impl PinOrder {
    /// Allocates for `particles` and `links` in all.
    pub fn reserve(&mut self, particles: usize, links: usize) {
        self.order.reserve_total(links);
        self.distance.reserve_total(particles);
    }

    /// Sorts the links by the distances that the tethers measured.
    pub fn rebuild(&mut self, tethers: &Tethers, particle_count: usize, links: &Links) {
        self.distance.clear();
        self.distance.resize(particle_count, f32::INFINITY);
        for set in tethers.sets() {
            for (distance, length) in self.distance.iter_mut().zip(&set.length) {
                *distance = if *length < *distance { *length } else { *distance };
            }
        }
        self.order.clear();
        self.order.extend(0..links.len() as u32);
        let distance = &self.distance;
        let farther = |link: &u32| {
            let ends = [links.a[*link as usize], links.b[*link as usize]];
            let [a, b] = ends.map(|end| distance[end as usize]);
            if a > b { a } else { b }
        };
        sort_by(&mut self.order, |p, q| farther(p).total_cmp(&farther(q)).then(p.cmp(q)));
    }

    /// The links, nearest to a pin first.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Returns whether particle `a` is clearly nearer to a pin than `b`, by more than rounding.
    pub fn is_nearer(&self, a: usize, b: usize) -> bool {
        self.distance[a] < self.distance[b] * (1.0 - 1.0e-4)
    }
}
