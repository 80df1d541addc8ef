//! Loose links: the few of a list that lie in no row, colour by colour. What a sweep needs of them lies
//! side by side here, so that it reads nothing of all the others.

use crate::fabric::links::{Batch, LinkKind, Links};
use core::ops::Range;

/// So many colours has a kind at most; what finds none free is of one more, and goes one by one.
const COLORS: usize = 10;

/// Colours of all three kinds, and those without.
const GROUPS: usize = 3 * (COLORS + 1);

/// The group of a link that holds no more.
const NO_GROUP: u8 = u8::MAX;

/// Links by colour.
#[derive(Clone, Debug, Default)]
pub(crate) struct Loose {
    /// Their particles, …
    pub a: Vec<u32>,
    pub b: Vec<u32>,
    /// … their lengths at rest [m], …
    pub rest: Vec<f32>,
    /// … and what number each has in its list.
    pub link: Vec<u32>,
    /// Those of a kind and colour, next to each other.
    pub batches: Vec<Batch>,
    /// Of each batch, whether no two of its links share a particle.
    are_colored: Vec<bool>,
}

impl Loose {
    /// Makes room for `count` in all.
    pub fn reserve(&mut self, count: usize) {
        let more = count.saturating_sub(self.link.len());
        self.a.reserve_exact(more);
        self.b.reserve_exact(more);
        self.rest.reserve_exact(more);
        self.link.reserve_exact(more);
        self.batches.reserve_exact(GROUPS.saturating_sub(self.batches.len()));
        self.are_colored.reserve_exact(GROUPS.saturating_sub(self.are_colored.len()));
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        4 * size_of::<u32>() * self.link.capacity()
    }

    pub fn clear(&mut self) {
        self.a.clear();
        self.b.clear();
        self.rest.clear();
        self.link.clear();
        self.batches.clear();
        self.are_colored.clear();
    }

    /// Adds a batch of links from a list, no two of which share a particle.
    pub fn add(&mut self, kind: LinkKind, links: &Links, numbers: &[u32]) {
        self.batches.push(Batch { kind, first: self.link.len(), count: numbers.len() });
        self.are_colored.push(true);
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

    /// Whether no two links of a batch share a particle.
    pub fn is_colored(&self, batch: usize) -> bool {
        self.are_colored.get(batch).is_some_and(|colored| *colored)
    }

    /// The links of a batch.
    pub fn of_batch(&self, batch: usize) -> Range<usize> {
        let none = Batch { kind: LinkKind::Stretch, first: 0, count: 0 };
        let batch = self.batches.get(batch).unwrap_or(&none);
        batch.first..batch.first + batch.count
    }

    /// The batches of a kind, which lie next to each other.
    pub fn batches_of(&self, kind: LinkKind) -> Range<usize> {
        let first = self.batches.partition_point(|batch| batch.kind < kind);
        first..self.batches.partition_point(|batch| batch.kind <= kind)
    }
}

/// What it takes to colour links without an order of their own, each with the lowest colour that neither
/// of its particles has yet.
#[derive(Clone, Debug, Default)]
pub(crate) struct Palette {
    /// The colours that each particle has, a bit each, kind by kind.
    taken: Vec<u32>,
    /// The group of each link.
    groups: Vec<u8>,
}

impl Palette {
    /// Makes room for `links` and `particles` in all.
    pub fn reserve(&mut self, links: usize, particles: usize) {
        self.taken.reserve_exact(particles.saturating_sub(self.taken.len()));
        self.groups.reserve_exact(links.saturating_sub(self.groups.len()));
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of::<u32>() * self.taken.capacity() + self.groups.capacity()
    }

    /// Colours those of `links` that hold.
    pub fn color(&mut self, links: &Links, particles: usize, loose: &mut Loose) {
        self.taken.clear();
        self.taken.resize(particles, 0);
        self.groups.clear();
        let mut counts = [0; GROUPS];
        for link in 0..links.len() {
            let group = if links.active[link] { self.take(links, link) } else { NO_GROUP };
            if let Some(count) = counts.get_mut(usize::from(group)) {
                *count += 1;
            }
            self.groups.push(group);
        }
        loose.clear();
        let mut next = [0; GROUPS];
        let mut first = 0;
        for (group, count) in counts.into_iter().enumerate() {
            next[group] = first;
            if count > 0 {
                let kinds = [LinkKind::Stretch, LinkKind::Shear, LinkKind::Bend];
                loose.batches.push(Batch { kind: kinds[group / (COLORS + 1)], first, count });
                loose.are_colored.push(group % (COLORS + 1) < COLORS);
            }
            first += count;
        }
        loose.a.resize(first, 0);
        loose.b.resize(first, 0);
        loose.rest.resize(first, 0.0);
        loose.link.resize(first, 0);
        for (link, group) in self.groups.iter().enumerate() {
            if let Some(at) = next.get_mut(usize::from(*group)) {
                loose.a[*at] = links.a[link];
                loose.b[*at] = links.b[link];
                loose.rest[*at] = links.rest[link];
                loose.link[*at] = link as u32;
                *at += 1;
            }
        }
    }

    /// Finds a link its colour, and so its group.
    fn take(&mut self, links: &Links, link: usize) -> u8 {
        let ends = [links.a[link] as usize, links.b[link] as usize];
        let kind = links.kind(link) as usize;
        let taken = ends.into_iter().fold(0, |taken, end| taken | self.taken[end]);
        let color = ((taken >> (kind * COLORS)).trailing_ones() as usize).min(COLORS);
        if color < COLORS {
            ends.into_iter().for_each(|end| self.taken[end] |= 1 << (kind * COLORS + color));
        }
        (kind * (COLORS + 1) + color) as u8
    }
}
