//! Weights of the two ends of every link, stored beside the link so that kernels load them in
//! order.
//!
//! Under `SOFT` a weight is the inverse mass [1/kg] of the particle. Under `RIGID` only the ratio
//! matters, so both are divided by their mean (`link_projection::relative_weights`). They are 1 and
//! 1 where both ends have the same inverse mass, which holds almost everywhere; there a kernel
//! neither loads nor multiplies by a weight.
//!
//! Written by `inverse_masses::refresh`; read by the kernels of `grid_links`, `mesh_kernel`,
//! `sparse`.
//! Invariant: `ends` and `is_even` have one entry per link of `constraints.links`.

use crate::math::column::Column;
use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::math::same_bits;
use crate::model::links::Links;
use crate::solver::stretch::link_projection::relative_weights;
use core::ops::Range;

/// The weights of the links' ends.
#[derive(Clone, Debug, Default)]
pub(crate) struct EndWeights {
    /// The inverse masses that the weights were computed from.
    w: Vec<f32>,
    /// Whether each kind of link was rigid at that time.
    rigid: [bool; 3],
    /// The weight of end a and of end b of each link.
    pub ends: [Column; 2],
    /// Whether both ends of each link have the same weight, and it is not 0.
    pub is_even: Vec<bool>,
}

heap_bytes!(EndWeights { w, ends, is_even } plain { rigid });

impl EndWeights {
    /// Grows the capacity to `particles` particles and `links` links in total.
    pub fn reserve(&mut self, particles: usize, links: usize) {
        self.w.reserve_total(particles);
        for list in &mut self.ends {
            list.reserve(links);
        }
        self.is_even.reserve_total(links);
    }

    /// Whether the weights were computed from these inverse masses and these rigid kinds.
    pub fn is_current(&self, w: &[f32], rigid: [bool; 3]) -> bool {
        same_bits(&self.w, w) && self.rigid == rigid
    }

    /// Stores the inverse masses to compute from, and resizes the lists to `links` entries.
    pub fn reset(&mut self, w: &[f32], rigid: [bool; 3], links: usize) {
        self.w.clear();
        self.w.extend_from_slice(w);
        self.rigid = rigid;
        self.ends.iter_mut().for_each(|list| list.resize(links));
        self.is_even.resize(links, false);
    }

    /// Computes the weights of a range of links.
    pub fn update(&mut self, links: &Links, range: Range<usize>, is_rigid: bool) {
        for link in range {
            let [a, b] = self.of([links.a[link], links.b[link]], is_rigid);
            (self.ends[0][link], self.ends[1][link]) = (a, b);
            self.is_even[link] = a == b && a > 0.0;
        }
    }

    /// The weights of a link between two particles.
    pub fn of(&self, ends: [u32; 2], is_rigid: bool) -> [f32; 2] {
        let ends = ends.map(|end| self.w[end as usize]);
        if is_rigid { relative_weights(ends) } else { ends }
    }
}
