//! StrayLinks: links that left the place where they were woven, and still hold.

use core::ops::Range;

/// The numbers of some links, lowest first.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinkSet {
    links: Vec<u32>,
}

impl LinkSet {
    /// Makes room for so many in all.
    pub fn reserve(&mut self, count: usize) {
        self.links.reserve_exact(count.saturating_sub(self.links.len()));
    }

    /// Takes note of whether a link is one of them.
    pub fn set(&mut self, link: usize, is_member: bool) {
        match (self.links.binary_search(&(link as u32)), is_member) {
            (Err(at), true) => self.links.insert(at, link as u32),
            (Ok(at), false) => {
                self.links.remove(at);
            }
            _ => {}
        }
    }

    /// All of them.
    pub fn as_slice(&self) -> &[u32] {
        &self.links
    }

    /// Those among the links `range`.
    pub fn in_range(&self, range: Range<usize>) -> &[u32] {
        let at = |link: usize| self.links.partition_point(|other| (*other as usize) < link);
        &self.links[at(range.start)..at(range.end)]
    }
}
