//! Greedy graph colouring: items of one colour share no particle, so their order cannot change the
//! result.
//!
//! - [`color_greedily`] colours links once, at creation, with as many colours as needed.
//! - [`Coloring`] colours items again after each change of topology, with at most `MAX_COLORS`
//!   colours per kind and without allocation. Items that find no free colour form one more group,
//!   which is solved one by one.
//!
//! Reads lists of particles per item; writes colours, or groups and an order.
//!
//! Invariant: the result depends only on the order of the items.
use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use core::ops::Range;

/// Returns a colour per pair: the lowest that neither particle has yet, in the order of the list.
pub(crate) fn color_greedily(pairs: &[[u32; 2]], particle_count: usize) -> Vec<u32> {
    let mut taken: Vec<Vec<bool>> = vec![Vec::new(); particle_count];
    let mut colors = Vec::with_capacity(pairs.len());
    for [a, b] in pairs.iter().map(|pair| pair.map(|v| v as usize)) {
        let is_taken = |end: usize, color: usize| taken[end].get(color).copied().unwrap_or(false);
        let color = (0..).find(|c| !is_taken(a, *c) && !is_taken(b, *c)).unwrap_or(0);
        for end in [a, b] {
            if taken[end].len() <= color {
                taken[end].resize(color + 1, false);
            }
            taken[end][color] = true;
        }
        colors.push(color as u32);
    }
    colors
}

/// Maximum number of colours per kind.
const MAX_COLORS: usize = 10;

/// Maximum number of kinds: a particle notes its colours in 32 bits.
const MAX_KINDS: usize = 3;

/// Maximum number of groups: for each kind its colours, and one group of uncoloured items.
pub(crate) const MAX_GROUPS: usize = MAX_KINDS * (MAX_COLORS + 1);

/// Group of an item that is left out.
const NO_GROUP: u8 = u8::MAX;

/// Items of one kind and colour, consecutive in the order of a colouring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ColorGroup {
    /// Kind of the items.
    pub kind: usize,
    /// Whether no two items share a particle. False for the group of uncoloured items.
    pub is_colored: bool,
    /// First item in the order.
    pub first: usize,
    /// Number of items.
    pub count: usize,
}

impl ColorGroup {
    /// Range of the items in the order.
    pub fn range(&self) -> Range<usize> {
        self.first..self.first + self.count
    }
}

/// Scratch buffers of a colouring that is repeated after changes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Coloring {
    /// Colours in use at each particle: `MAX_COLORS` bits per kind.
    taken: Vec<u32>,
    /// Group of each item.
    groups: Vec<u8>,
    /// Items sorted by group, in their own order within a group.
    order: Vec<u32>,
}

heap_bytes!(Coloring { taken, groups, order } plain {});

impl Coloring {
    /// Allocates for `item_count` items and `particles` particles.
    pub fn reserve(&mut self, item_count: usize, particles: usize) {
        self.taken.reserve_total(particles);
        self.groups.reserve_total(item_count);
        self.order.reserve_total(item_count);
    }

    /// Colours items `0..item_count`: each gets the lowest colour that none of its particles has
    /// yet.
    ///
    /// `of` returns the kind and the particles of an item, or `None` to leave it out. Writes the
    /// groups that are not empty into `groups_found`, and returns the items in the order of the
    /// groups.
    pub fn assign<const ENDS: usize>(
        &mut self,
        item_count: usize,
        particles: usize,
        of: impl Fn(usize) -> Option<(usize, [u32; ENDS])>,
        groups_found: &mut Vec<ColorGroup>,
    ) -> &[u32] {
        self.taken.clear();
        self.taken.resize(particles, 0);
        self.groups.clear();
        let mut counts = [0; MAX_GROUPS];
        for item in 0..item_count {
            let group = of(item).map_or(NO_GROUP, |(kind, ends)| self.assign_one(kind, ends));
            if let Some(count) = counts.get_mut(usize::from(group)) {
                *count += 1;
            }
            self.groups.push(group);
        }
        groups_found.clear();
        let mut next = [0; MAX_GROUPS];
        let mut first = 0;
        for (group, count) in counts.into_iter().enumerate() {
            next[group] = first;
            if count > 0 {
                let (kind, color) = (group / (MAX_COLORS + 1), group % (MAX_COLORS + 1));
                groups_found.push(ColorGroup {
                    kind,
                    is_colored: color < MAX_COLORS,
                    first,
                    count,
                });
            }
            first += count;
        }
        self.order.clear();
        self.order.resize(first, 0);
        for (item, group) in self.groups.iter().enumerate() {
            if let Some(at) = next.get_mut(usize::from(*group)) {
                self.order[*at] = item as u32;
                *at += 1;
            }
        }
        &self.order
    }

    /// Colours one item and returns its group.
    fn assign_one<const ENDS: usize>(&mut self, kind: usize, ends: [u32; ENDS]) -> u8 {
        let (mut taken, mut is_repeated) = (0, false);
        for (at, end) in ends.iter().enumerate() {
            taken |= self.taken[*end as usize] >> (kind * MAX_COLORS);
            is_repeated |= ends[..at].contains(end);
        }
        // An item that names a particle twice stays uncoloured.
        let color =
            if is_repeated { MAX_COLORS } else { (taken.trailing_ones() as usize).min(MAX_COLORS) };
        if color < MAX_COLORS {
            ends.into_iter().for_each(|end| {
                self.taken[end as usize] |= 1 << (kind * MAX_COLORS + color);
            });
        }
        (kind * (MAX_COLORS + 1) + color) as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Items over three of seven particles in a row. One is left out, and one names a particle
    /// twice.
    fn over_three(item: usize) -> Option<(usize, [u32; 3])> {
        let first = (item % 5) as u32;
        match item {
            3 => None,
            4 => Some((1, [2, 2, 5])),
            _ => Some((item % 2, [first, first + 1, first + 2])),
        }
    }

    #[test]
    fn colored_groups_share_no_particle_and_contain_all_items_once() {
        let (mut coloring, mut groups) = (Coloring::default(), Vec::new());
        let order = coloring.assign(35, 7, over_three, &mut groups).to_vec();
        let mut times_seen = [0; 35];
        for group in &groups {
            let mut taken = [false; 7];
            for item in &order[group.range()] {
                let (kind, ends) = over_three(*item as usize).expect("item is not left out");
                assert_eq!(kind, group.kind);
                times_seen[*item as usize] += 1;
                for end in ends.iter().filter(|_| group.is_colored) {
                    assert!(!core::mem::replace(&mut taken[*end as usize], true));
                }
            }
        }
        assert!(
            times_seen
                .iter()
                .enumerate()
                .all(|(item, times_seen)| *times_seen == i32::from(item != 3))
        );
        // Twelve or thirteen items of a kind contain the middle particle, but there are only ten
        // colours.
        let uncolored = groups.iter().filter(|group| !group.is_colored).count();
        assert_eq!(uncolored, 2, "{groups:?}");
    }

    #[test]
    fn no_particle_appears_twice_in_a_greedy_color() {
        let pairs: Vec<[u32; 2]> =
            (0..40u32).flat_map(|a| (1..5).map(move |d| [a, (a * 7 + d * 3) % 41])).collect();
        let pairs: Vec<[u32; 2]> = pairs.into_iter().filter(|[a, b]| a != b).collect();
        let colors = color_greedily(&pairs, 41);
        for color in 0..=*colors.iter().max().unwrap() {
            let mut ends: Vec<u32> = pairs
                .iter()
                .zip(&colors)
                .filter(|(_, c)| **c == color)
                .flat_map(|(p, _)| *p)
                .collect();
            let all = ends.len();
            ends.sort_unstable();
            ends.dedup();
            assert_eq!(ends.len(), all, "color {color}");
        }
    }
}
