//! Particle indices at one end of all links, with an upper bound, so that kernels check bounds once
//! per list instead of once per link.

use crate::math::heap_bytes::heap_bytes;
use crate::math::shared::Shared;
use core::ops::Deref;

/// A list of particles, read as a slice.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinkEnds {
    list: Shared<Vec<u32>>,
    /// Upper bound of all entries, past and present.
    max_particle: u32,
}

heap_bytes!(LinkEnds { list } plain { max_particle });

impl LinkEnds {
    /// Returns an upper bound of all entries.
    pub fn max_particle(&self) -> u32 {
        self.max_particle
    }

    /// Allocates for `additional` more entries.
    pub fn reserve(&mut self, additional: usize) {
        self.list.reserve_exact(additional);
    }

    /// Makes the list unique.
    pub fn make_unique(&mut self) {
        self.list.make_unique();
    }

    pub fn push(&mut self, particle: u32) {
        self.max_particle = self.max_particle.max(particle);
        self.list.push(particle);
    }

    pub fn set(&mut self, at: usize, particle: u32) {
        self.max_particle = self.max_particle.max(particle);
        self.list[at] = particle;
    }
}

impl Deref for LinkEnds {
    type Target = [u32];

    #[inline(always)]
    fn deref(&self) -> &[u32] {
        &self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_entry_exceeds_max_particle() {
        let mut ends = LinkEnds::default();
        [3, 7, 5].into_iter().for_each(|particle| ends.push(particle));
        assert_eq!((&*ends, ends.max_particle()), (&[3, 7, 5][..], 7));
        ends.set(0, 9);
        ends.set(0, 1);
        assert_eq!(&*ends, [1, 7, 5]);
        assert!(ends.iter().all(|particle| *particle <= ends.max_particle()));
    }
}
