//! Contact graph: the contacts of each particle, and a work list of contacts to check.
//!
//! ```text
//! particle 0: contacts 0 3 7         A particle that moves becomes dirty. To schedule the dirty
//! particle 1: contacts 1 3           particles means to set the pending bits of their contacts. So
//! particle 2: contacts 7 …           the non-crossing pass checks only the affected contacts.
//! ```
//! Adjacency lists in compressed rows (counting sort by particle), a bit set for pending contacts.
//!
//! Reads contacts; writes its own lists.
//!
//! Invariant: pending contacts come out in ascending order, so the result follows from the contacts
//! alone.

use crate::solver::self_collide::surface::contact::Contact;

/// Contacts by particle, and the pending contacts.
#[derive(Clone, Debug)]
pub(crate) struct ContactGraph {
    /// Index of each particle's first contact in `contacts`, and one more entry for the end.
    starts: Vec<u32>,
    contacts: Vec<u32>,
    /// Number of contacts in the adjacency lists.
    count: usize,
    /// A bit for each contact: set if it has to be checked.
    pending: Vec<u64>,
    /// Particles that moved since their contacts were scheduled last.
    dirty: Vec<u32>,
    /// Particles that moved since [`ContactGraph::clear_moved`].
    moved: Vec<u32>,
    /// `DIRTY` and `MOVED` bits of each particle.
    flags: Vec<u8>,
    /// Whether any particle moved since [`ContactGraph::reset`].
    pub any_moved: bool,
}

/// Bits in a word of the bit set.
pub(crate) const WORD_BITS: usize = 64;

/// Bits of `flags`: the particle is in `dirty`; the particle is in `moved`.
const DIRTY: u8 = 1;
const MOVED: u8 = 2;

impl ContactGraph {
    /// Allocates lists for `capacity` particles and `contacts` contacts.
    pub fn new(capacity: usize, contacts: usize) -> Self {
        Self {
            starts: Vec::with_capacity(capacity + 1),
            contacts: Vec::with_capacity(4 * contacts),
            count: 0,
            pending: Vec::with_capacity(contacts.div_ceil(64)),
            dirty: Vec::with_capacity(capacity),
            moved: Vec::with_capacity(capacity),
            flags: Vec::with_capacity(capacity),
            any_moved: false,
        }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        let lists = [&self.starts, &self.contacts, &self.dirty, &self.moved];
        let words: usize = lists.iter().map(|list| list.capacity()).sum();
        4 * words + 8 * self.pending.capacity() + self.flags.capacity()
    }

    /// Clears all lists, for a cloth of `particles` particles.
    pub fn reset(&mut self, particles: usize) {
        self.count = 0;
        self.starts.resize(particles + 1, 0);
        self.clear_moved();
        self.dirty.drain(..).for_each(|i| self.flags[i as usize] = 0);
        self.flags.resize(particles, 0);
        self.pending.clear();
        self.any_moved = false;
    }

    /// Rebuilds the adjacency lists if contacts were added.
    fn rebuild_adjacency(&mut self, contacts: &[Contact]) {
        if self.count == contacts.len() {
            return;
        }
        self.count = contacts.len();
        let starts = &mut self.starts;
        starts.fill(0);
        for contact in contacts {
            contact.ids.iter().for_each(|id| starts[*id as usize] += 1);
        }
        let mut sum = 0;
        for start in starts.iter_mut() {
            sum += *start;
            *start = sum;
        }
        self.contacts.clear();
        self.contacts.resize(4 * contacts.len(), 0);
        for (i, contact) in contacts.iter().enumerate().rev() {
            for id in contact.ids {
                let slot = &mut starts[id as usize];
                *slot -= 1;
                self.contacts[*slot as usize] = i as u32;
            }
        }
    }

    /// Marks a particle as moved and dirty.
    #[inline(always)]
    pub fn mark_moved(&mut self, particle: u32) {
        let flags = core::mem::replace(&mut self.flags[particle as usize], DIRTY | MOVED);
        if flags & DIRTY == 0 {
            self.dirty.push(particle);
        }
        if flags & MOVED == 0 {
            self.moved.push(particle);
            self.any_moved = true;
        }
    }

    /// Clears the list of moved particles. Dirty particles stay dirty.
    pub fn clear_moved(&mut self) {
        self.moved.drain(..).for_each(|i| self.flags[i as usize] &= !MOVED);
    }

    /// Particles that moved since [`Self::clear_moved`].
    pub fn moved(&self) -> &[u32] {
        &self.moved
    }

    /// Whether any of four particles moved since [`Self::clear_moved`].
    #[inline(always)]
    pub fn has_moved(&self, particles: [u32; 4]) -> bool {
        let flags = particles.map(|i| self.flags[i as usize]);
        flags.into_iter().fold(0, |all, flags| all | flags) & MOVED != 0
    }

    pub fn has_dirty(&self) -> bool {
        !self.dirty.is_empty()
    }

    /// Schedules all contacts from index `first` on.
    pub fn schedule_from(&mut self, first: usize, contacts: &[Contact]) {
        self.pending.resize(contacts.len().div_ceil(64), 0);
        (first..contacts.len()).for_each(|i| self.pending[i / 64] |= 1 << (i % 64));
    }

    /// Removes the contacts whose bits are set in `bits` from word `word` of the pending set.
    pub fn unschedule(&mut self, word: usize, bits: u64) {
        self.pending[word] &= !bits;
    }

    /// Schedules the contacts of all dirty particles, which are clean afterwards.
    pub fn schedule_dirty(&mut self, contacts: &[Contact]) {
        self.pending.resize(contacts.len().div_ceil(64), 0);
        if self.dirty.is_empty() {
            return;
        }
        self.rebuild_adjacency(contacts);
        while let Some(particle) = self.dirty.pop() {
            self.flags[particle as usize] &= !DIRTY;
            self.schedule_contacts_of(particle);
        }
    }

    /// Schedules one contact.
    pub fn schedule(&mut self, contact: u32) {
        self.pending[contact as usize / 64] |= 1 << (contact % 64);
    }

    #[inline(always)]
    fn schedule_contacts_of(&mut self, particle: u32) {
        let i = particle as usize;
        for contact in &self.contacts[self.starts[i] as usize..self.starts[i + 1] as usize] {
            self.pending[*contact as usize / 64] |= 1 << (contact % 64);
        }
    }

    /// Removes and returns the first pending contact with an index of at least `from`.
    #[inline(always)]
    pub fn pop_pending(&mut self, from: usize) -> Option<usize> {
        let mut word = from / 64;
        let mut bits = *self.pending.get(word)? & (u64::MAX << (from % 64));
        while bits == 0 {
            word += 1;
            bits = *self.pending.get(word)?;
        }
        let i = 64 * word + bits.trailing_zeros() as usize;
        self.pending[word] &= !(1 << (i % 64));
        Some(i)
    }
}
