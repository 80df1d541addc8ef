//! Which contacts each particle is part of, so that after some moved only theirs are looked at again.

use super::contacts::Contact;

/// Contacts by particle, and those of them that are due for a look.
#[derive(Clone, Debug)]
pub(super) struct Around {
    /// Where the contacts of each particle begin in `contacts`; one more at the end.
    starts: Vec<u32>,
    contacts: Vec<u32>,
    /// How many contacts were sorted in.
    count: usize,
    /// A bit for each contact that is due, in order.
    due: Vec<u64>,
    /// Particles that moved since the last look, and whether each is among them.
    moved: Vec<u32>,
    has_moved: Vec<bool>,
    /// Whether any moved since this was last set to false, and since all began.
    pub is_stirred: bool,
    pub was_stirred: bool,
}

impl Around {
    /// Of so many particles there may be; contacts that there is room for.
    pub fn new(capacity: usize, contacts: usize) -> Self {
        Self {
            starts: Vec::with_capacity(capacity + 1),
            contacts: Vec::with_capacity(4 * contacts),
            count: 0,
            due: Vec::with_capacity(contacts.div_ceil(64)),
            moved: Vec::with_capacity(capacity),
            has_moved: Vec::with_capacity(capacity),
            is_stirred: false,
            was_stirred: false,
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let words = self.starts.capacity() + self.contacts.capacity() + self.moved.capacity();
        4 * words + 8 * self.due.capacity() + self.has_moved.capacity()
    }

    /// Nothing moved among so many particles, and contacts are to be sorted in anew.
    pub fn begin(&mut self, particles: usize) {
        self.count = 0;
        self.starts.resize(particles + 1, 0);
        self.moved.drain(..).for_each(|at| self.has_moved[at as usize] = false);
        self.has_moved.resize(particles, false);
        self.due.clear();
        self.was_stirred = false;
    }

    /// Sorts contacts in by their particles, unless that was done.
    fn sort(&mut self, contacts: &[Contact]) {
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
        for (at, contact) in contacts.iter().enumerate().rev() {
            for id in contact.ids {
                let place = &mut starts[id as usize];
                *place -= 1;
                self.contacts[*place as usize] = at as u32;
            }
        }
    }

    /// Notes that a particle moved.
    #[inline(always)]
    pub fn moves(&mut self, particle: u32) {
        let has_moved = &mut self.has_moved[particle as usize];
        if !*has_moved {
            *has_moved = true;
            (self.is_stirred, self.was_stirred) = (true, true);
            self.moved.push(particle);
        }
    }

    /// Whether any particle moved.
    pub fn has_moved(&self) -> bool {
        !self.moved.is_empty()
    }

    /// All from one on are due.
    pub fn call_from(&mut self, first: usize, contacts: &[Contact]) {
        self.due.resize(contacts.len().div_ceil(64), 0);
        (first..contacts.len()).for_each(|at| self.due[at / 64] |= 1 << (at % 64));
    }

    /// Those are due whose particles moved.
    pub fn call_moved(&mut self, contacts: &[Contact]) {
        self.due.resize(contacts.len().div_ceil(64), 0);
        if self.moved.is_empty() {
            return;
        }
        self.sort(contacts);
        while let Some(particle) = self.moved.pop() {
            self.has_moved[particle as usize] = false;
            self.call(particle);
        }
    }

    /// One is due.
    pub fn call_one(&mut self, contact: u32) {
        self.due[contact as usize / 64] |= 1 << (contact % 64);
    }

    #[inline(always)]
    fn call(&mut self, particle: u32) {
        let at = particle as usize;
        for contact in &self.contacts[self.starts[at] as usize..self.starts[at + 1] as usize] {
            self.due[*contact as usize / 64] |= 1 << (contact % 64);
        }
    }

    /// The next that is due from a place on, which it is no more.
    #[inline(always)]
    pub fn next_due(&mut self, from: usize) -> Option<usize> {
        let mut word = from / 64;
        let mut bits = *self.due.get(word)? & (u64::MAX << (from % 64));
        while bits == 0 {
            word += 1;
            bits = *self.due.get(word)?;
        }
        let at = 64 * word + bits.trailing_zeros() as usize;
        self.due[word] &= !(1 << (at % 64));
        Some(at)
    }
}
