use core::ops::Range;

/// A colour for each pair, the lowest that neither end has yet, in the order of the list.
pub(crate) fn greedy(pairs: &[[u32; 2]], particle_count: usize) -> Vec<u32> {
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

/// So many colours has a kind at most; what finds none free is of one more, and goes one by one.
const COLORS: usize = 10;

/// As many kinds as a particle has room to note the colours of.
const KINDS: usize = 3;

/// Colours of all kinds, and those without.
pub(crate) const MAX_GROUPS: usize = KINDS * (COLORS + 1);

/// The group of what is left out.
const NO_GROUP: u8 = u8::MAX;

/// Things of a kind and colour, next to each other in the order that a palette gives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ColorGroup {
    pub kind: usize,
    /// Whether no two share a particle.
    pub is_colored: bool,
    pub first: usize,
    pub count: usize,
}

impl ColorGroup {
    /// Their places in the order.
    pub fn range(&self) -> Range<usize> {
        self.first..self.first + self.count
    }
}

/// What it takes to colour things, each with the lowest colour that none of its particles has yet.
#[derive(Clone, Debug, Default)]
pub(crate) struct Coloring {
    /// The colours that each particle has, a bit each, kind by kind.
    taken: Vec<u32>,
    /// The group of each thing.
    groups: Vec<u8>,
    /// The things, kind by kind and colour by colour.
    order: Vec<u32>,
}

impl Coloring {
    /// Makes room for `things` and `particles` in all.
    pub fn reserve(&mut self, things: usize, particles: usize) {
        self.taken.reserve_exact(particles.saturating_sub(self.taken.len()));
        self.groups.reserve_exact(things.saturating_sub(self.groups.len()));
        self.order.reserve_exact(things.saturating_sub(self.order.len()));
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of::<u32>() * (self.taken.capacity() + self.order.capacity()) + self.groups.capacity()
    }

    /// Colours `things`, of which `of` gives the kind and the particles, or none to leave one out; puts the
    /// groups that there are into `found`, and gives the order.
    pub fn assign<const ENDS: usize>(
        &mut self,
        things: usize,
        particles: usize,
        of: impl Fn(usize) -> Option<(usize, [u32; ENDS])>,
        found: &mut Vec<ColorGroup>,
    ) -> &[u32] {
        self.taken.clear();
        self.taken.resize(particles, 0);
        self.groups.clear();
        let mut counts = [0; MAX_GROUPS];
        for thing in 0..things {
            let group = of(thing).map_or(NO_GROUP, |(kind, ends)| self.assign_one(kind, ends));
            if let Some(count) = counts.get_mut(usize::from(group)) {
                *count += 1;
            }
            self.groups.push(group);
        }
        found.clear();
        let mut next = [0; MAX_GROUPS];
        let mut first = 0;
        for (group, count) in counts.into_iter().enumerate() {
            next[group] = first;
            if count > 0 {
                let (kind, color) = (group / (COLORS + 1), group % (COLORS + 1));
                found.push(ColorGroup { kind, is_colored: color < COLORS, first, count });
            }
            first += count;
        }
        self.order.clear();
        self.order.resize(first, 0);
        for (thing, group) in self.groups.iter().enumerate() {
            if let Some(at) = next.get_mut(usize::from(*group)) {
                self.order[*at] = thing as u32;
                *at += 1;
            }
        }
        &self.order
    }

    /// Finds a thing its colour, and so its group.
    fn assign_one<const ENDS: usize>(&mut self, kind: usize, ends: [u32; ENDS]) -> u8 {
        let (mut taken, mut twice) = (0, false);
        for (at, end) in ends.iter().enumerate() {
            taken |= self.taken[*end as usize] >> (kind * COLORS);
            twice |= ends[..at].contains(end);
        }
        // What names a particle twice is for itself.
        let color = if twice { COLORS } else { (taken.trailing_ones() as usize).min(COLORS) };
        if color < COLORS {
            ends.into_iter().for_each(|end| {
                self.taken[end as usize] |= 1 << (kind * COLORS + color);
            });
        }
        (kind * (COLORS + 1) + color) as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seven sites in a row and what lies over three of them, seven times each; one is left out, and one is
    /// bent upon itself.
    fn over_three(thing: usize) -> Option<(usize, [u32; 3])> {
        let first = (thing % 5) as u32;
        match thing {
            3 => None,
            4 => Some((1, [2, 2, 5])),
            _ => Some((thing % 2, [first, first + 1, first + 2])),
        }
    }

    #[test]
    fn groups_share_no_particle_and_hold_all_things_once() {
        let (mut coloring, mut groups) = (Coloring::default(), Vec::new());
        let order = coloring.assign(35, 7, over_three, &mut groups).to_vec();
        let mut met = [0; 35];
        for group in &groups {
            let mut taken = [false; 7];
            for thing in &order[group.range()] {
                let (kind, ends) = over_three(*thing as usize).expect("it is not left out");
                assert_eq!(kind, group.kind);
                met[*thing as usize] += 1;
                for end in ends.iter().filter(|_| group.is_colored) {
                    assert!(!core::mem::replace(&mut taken[*end as usize], true));
                }
            }
        }
        assert!(met.iter().enumerate().all(|(thing, met)| *met == i32::from(thing != 3)));
        // Twelve or thirteen of a kind lie over the one in the middle, and only ten can have a colour.
        let apart = groups.iter().filter(|group| !group.is_colored).count();
        assert_eq!(apart, 2, "{groups:?}");
    }

    #[test]
    fn no_particle_appears_twice_in_a_color() {
        let pairs: Vec<[u32; 2]> =
            (0..40u32).flat_map(|a| (1..5).map(move |d| [a, (a * 7 + d * 3) % 41])).collect();
        let pairs: Vec<[u32; 2]> = pairs.into_iter().filter(|[a, b]| a != b).collect();
        let colors = greedy(&pairs, 41);
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
