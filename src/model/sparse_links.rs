//! Sparse links: the few links of a list outside the regular rows, packed by colour, so that a
//! sweep does not read the others.
//!
//! Reads `Links`; writes packed columns for gather/scatter kernels.
//!
//! Invariant: within a coloured group no particle appears twice.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::model::coloring::{ColorGroup, Coloring, MAX_GROUPS};
use crate::model::links::{LinkKind, Links};
use core::ops::Range;

/// Packed links, sorted by colour.
#[derive(Clone, Debug, Default)]
pub(crate) struct SparseLinks {
    /// Particles of each link.
    pub a: Vec<u32>,
    pub b: Vec<u32>,
    /// Rest length [m].
    pub rest: Vec<f32>,
    /// Number of each link in its list.
    pub link: Vec<u32>,
    /// Inverse masses of the two ends, see `solver::stretch::inverse_masses`; empty until they are
    /// computed.
    pub w: [Vec<f32>; 2],
    /// Links of one kind and colour.
    groups: Vec<ColorGroup>,
}

heap_bytes!(SparseLinks { a, b, rest, link, w, groups } plain {});

impl SparseLinks {
    /// Allocates for `count` links in all.
    pub fn reserve(&mut self, count: usize) {
        let additional = |len: usize| count.saturating_sub(len);
        for list in [&mut self.a, &mut self.b, &mut self.link] {
            list.reserve_exact(additional(list.len()));
        }
        let [w_a, w_b] = &mut self.w;
        for list in [&mut self.rest, w_a, w_b] {
            list.reserve_exact(additional(list.len()));
        }
        self.groups.reserve_total(MAX_GROUPS);
    }

    /// Removes all links.
    pub fn clear(&mut self) {
        [&mut self.a, &mut self.b, &mut self.link].into_iter().for_each(Vec::clear);
        self.rest.clear();
        self.w.iter_mut().for_each(Vec::clear);
        self.groups.clear();
    }

    /// Appends a batch of links that share no particle.
    pub fn push_batch(&mut self, kind: LinkKind, links: &Links, link_numbers: &[u32]) {
        let (first, count) = (self.link.len(), link_numbers.len());
        self.groups.push(ColorGroup { kind: kind as usize, is_colored: true, first, count });
        self.append(links, link_numbers);
    }

    /// Replaces the content by the active links of a list, coloured.
    pub fn rebuild_colored(&mut self, links: &Links, particles: usize, coloring: &mut Coloring) {
        self.clear();
        let ends = |link: usize| {
            links.active[link].then(|| (links.kind(link) as usize, [links.a[link], links.b[link]]))
        };
        let order = coloring.assign(links.len(), particles, ends, &mut self.groups);
        self.append(links, order);
    }

    fn append(&mut self, links: &Links, link_numbers: &[u32]) {
        for number in link_numbers {
            let link = *number as usize;
            self.a.push(links.a[link]);
            self.b.push(links.b[link]);
            self.rest.push(links.rest[link]);
            self.link.push(*number);
        }
    }

    /// Copies the rest lengths from the list.
    pub fn update_rest_lengths(&mut self, links: &Links) {
        for (rest, link) in self.rest.iter_mut().zip(&self.link) {
            *rest = links.rest[*link as usize];
        }
    }

    /// Returns whether the inverse masses are computed.
    pub fn has_inverse_masses(&self) -> bool {
        self.w[0].len() == self.link.len()
    }

    /// Computes the inverse masses of the ends: `inverse_masses_of(kind, [a, b])`.
    pub fn compute_inverse_masses(
        &mut self,
        inverse_masses_of: impl Fn(usize, [u32; 2]) -> [f32; 2],
    ) {
        let Self { a, b, w: [w_a, w_b], groups, .. } = self;
        w_a.clear();
        w_b.clear();
        for group in &*groups {
            for (a, b) in a[group.range()].iter().zip(&b[group.range()]) {
                let [wa, wb] = inverse_masses_of(group.kind, [*a, *b]);
                w_a.push(wa);
                w_b.push(wb);
            }
        }
    }

    /// The links of a batch, and whether no two of them share a particle.
    pub fn batch(&self, batch: usize) -> (Range<usize>, bool) {
        self.groups.get(batch).map_or((0..0, true), |group| (group.range(), group.is_colored))
    }

    /// The batches of a kind, which are consecutive.
    pub fn batches_of(&self, kind: LinkKind) -> Range<usize> {
        let first = self.groups.partition_point(|group| group.kind < kind as usize);
        first..self.groups.partition_point(|group| group.kind <= kind as usize)
    }
}
