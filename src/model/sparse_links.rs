//! SparseLinks links: the few of a list that lie in no row, colour by colour. What a sweep needs of them lies
//! side by side here, so that it reads nothing of all the others.

use crate::model::coloring::{ColorGroup, Coloring, MAX_GROUPS};
use crate::model::links::{LinkKind, Links};
use core::ops::Range;

/// Links by colour.
#[derive(Clone, Debug, Default)]
pub(crate) struct SparseLinks {
    /// Their particles, …
    pub a: Vec<u32>,
    pub b: Vec<u32>,
    /// … their lengths at rest [m], …
    pub rest: Vec<f32>,
    /// … what number each has in its list, …
    pub link: Vec<u32>,
    /// … and what their ends weigh, see `solver::weights`; none until they are weighed.
    pub w: [Vec<f32>; 2],
    /// Those of a kind and colour, next to each other.
    groups: Vec<ColorGroup>,
}

impl SparseLinks {
    /// Makes room for `count` in all.
    pub fn reserve(&mut self, count: usize) {
        let more = |len: usize| count.saturating_sub(len);
        for list in [&mut self.a, &mut self.b, &mut self.link] {
            list.reserve_exact(more(list.len()));
        }
        let [w_a, w_b] = &mut self.w;
        for list in [&mut self.rest, w_a, w_b] {
            list.reserve_exact(more(list.len()));
        }
        self.groups.reserve_exact(MAX_GROUPS.saturating_sub(self.groups.len()));
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        6 * size_of::<u32>() * self.link.capacity()
    }

    pub fn clear(&mut self) {
        [&mut self.a, &mut self.b, &mut self.link].into_iter().for_each(Vec::clear);
        self.rest.clear();
        self.w.iter_mut().for_each(Vec::clear);
        self.groups.clear();
    }

    /// Adds a batch of links from a list, no two of which share a particle.
    pub fn push_batch(&mut self, kind: LinkKind, links: &Links, link_numbers: &[u32]) {
        let (first, count) = (self.link.len(), link_numbers.len());
        self.groups.push(ColorGroup { kind: kind as usize, is_colored: true, first, count });
        self.append(links, link_numbers);
    }

    /// Makes it those of a list that hold, coloured.
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

    /// Takes over lengths at rest that changed.
    pub fn update_rest_lengths(&mut self, links: &Links) {
        for (rest, link) in self.rest.iter_mut().zip(&self.link) {
            *rest = links.rest[*link as usize];
        }
    }

    /// Whether it is known what their ends weigh.
    pub fn has_inverse_masses(&self) -> bool {
        self.w[0].len() == self.link.len()
    }

    /// Takes note of what their ends weigh, by their kind.
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

    /// The batches of a kind, which lie next to each other.
    pub fn batches_of(&self, kind: LinkKind) -> Range<usize> {
        let first = self.groups.partition_point(|group| group.kind < kind as usize);
        first..self.groups.partition_point(|group| group.kind <= kind as usize)
    }
}
