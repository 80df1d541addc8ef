//! SparseLinks links: the few of a list that lie in no row, colour by colour. What a sweep needs of them lies
//! side by side here, so that it reads nothing of all the others.

use crate::model::links::{LinkKind, Links};
use crate::model::recoloring::{GROUPS, Group, Recoloring};
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
    pub ends: [Vec<f32>; 2],
    /// Those of a kind and colour, next to each other.
    groups: Vec<Group>,
}

impl SparseLinks {
    /// Makes room for `count` in all.
    pub fn reserve(&mut self, count: usize) {
        let more = |len: usize| count.saturating_sub(len);
        for list in [&mut self.a, &mut self.b, &mut self.link] {
            list.reserve_exact(more(list.len()));
        }
        let [ends_a, ends_b] = &mut self.ends;
        for list in [&mut self.rest, ends_a, ends_b] {
            list.reserve_exact(more(list.len()));
        }
        self.groups.reserve_exact(GROUPS.saturating_sub(self.groups.len()));
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        6 * size_of::<u32>() * self.link.capacity()
    }

    pub fn clear(&mut self) {
        [&mut self.a, &mut self.b, &mut self.link].into_iter().for_each(Vec::clear);
        self.rest.clear();
        self.ends.iter_mut().for_each(Vec::clear);
        self.groups.clear();
    }

    /// Adds a batch of links from a list, no two of which share a particle.
    pub fn add(&mut self, kind: LinkKind, links: &Links, numbers: &[u32]) {
        let (first, count) = (self.link.len(), numbers.len());
        self.groups.push(Group { kind: kind as usize, is_colored: true, first, count });
        self.append(links, numbers);
    }

    /// Makes it those of a list that hold, coloured.
    pub fn color(&mut self, links: &Links, particles: usize, palette: &mut Recoloring) {
        self.clear();
        let ends = |link: usize| {
            links.active[link].then(|| (links.kind(link) as usize, [links.a[link], links.b[link]]))
        };
        let order = palette.color(links.len(), particles, ends, &mut self.groups);
        self.append(links, order);
    }

    fn append(&mut self, links: &Links, numbers: &[u32]) {
        for number in numbers {
            let link = *number as usize;
            self.a.push(links.a[link]);
            self.b.push(links.b[link]);
            self.rest.push(links.rest[link]);
            self.link.push(*number);
        }
    }

    /// Takes over lengths at rest that changed.
    pub fn measure(&mut self, links: &Links) {
        for (rest, link) in self.rest.iter_mut().zip(&self.link) {
            *rest = links.rest[*link as usize];
        }
    }

    /// Whether it is known what their ends weigh.
    pub fn is_weighed(&self) -> bool {
        self.ends[0].len() == self.link.len()
    }

    /// Takes note of what their ends weigh, by their kind.
    pub fn weigh(&mut self, of: impl Fn(usize, [u32; 2]) -> [f32; 2]) {
        let Self { a, b, ends: [ends_a, ends_b], groups, .. } = self;
        ends_a.clear();
        ends_b.clear();
        for group in &*groups {
            for (a, b) in a[group.range()].iter().zip(&b[group.range()]) {
                let [wa, wb] = of(group.kind, [*a, *b]);
                ends_a.push(wa);
                ends_b.push(wb);
            }
        }
    }

    /// The links of a batch, and whether no two of them share a particle.
    pub fn of_batch(&self, batch: usize) -> (Range<usize>, bool) {
        self.groups.get(batch).map_or((0..0, true), |group| (group.range(), group.is_colored))
    }

    /// The batches of a kind, which lie next to each other.
    pub fn batches_of(&self, kind: LinkKind) -> Range<usize> {
        let first = self.groups.partition_point(|group| group.kind < kind as usize);
        first..self.groups.partition_point(|group| group.kind <= kind as usize)
    }
}
