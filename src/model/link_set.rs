//! Sorted set of link numbers: links that left their place in a regular layout and are still
//! active.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use core::ops::Range;

/// Link numbers, ascending.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinkSet {
    links: Vec<u32>,
}

heap_bytes!(LinkSet { links } plain {});

impl LinkSet {
    /// Allocates for `count` links in all.
    pub fn reserve(&mut self, count: usize) {
        self.links.reserve_total(count);
    }

    /// Adds or removes a link.
    pub fn set(&mut self, link: usize, is_member: bool) {
        match (self.links.binary_search(&(link as u32)), is_member) {
            (Err(at), true) => self.links.insert(at, link as u32),
            (Ok(at), false) => {
                self.links.remove(at);
            }
            _ => {}
        }
    }

    /// All links, ascending.
    pub fn as_slice(&self) -> &[u32] {
        &self.links
    }

    /// The links within `range`.
    pub fn in_range(&self, range: Range<usize>) -> &[u32] {
        let at = |link: usize| self.links.partition_point(|other| (*other as usize) < link);
        &self.links[at(range.start)..at(range.end)]
    }
}
