//! Which contacts each particle is part of, so that after some moved only theirs are looked at again.

use crate::solver::self_collide::surface::contact::Contact;

/// Contacts by particle, and those of them that are due for a look.
#[derive(Clone, Debug)]
pub(crate) struct Around {
    /// Where the contacts of each particle begin in `contacts`; one more at the end.
    starts: Vec<u32>,
    contacts: Vec<u32>,
    /// How many contacts were sorted in.
    count: usize,
    /// A bit for each contact that is due, in order.
    due: Vec<u64>,
    /// Particles that moved since contacts were last called for it, those that did since all were last at rest, and
    /// which of both each is among.
    moved: Vec<u32>,
    stirred: Vec<u32>,
    states: Vec<u8>,
    /// Whether any moved since all began.
    pub was_stirred: bool,
}

/// Bits in a word.
pub(crate) const BITS: usize = 64;

/// What a particle is.
const MOVED: u8 = 1;
const STIRRED: u8 = 2;

impl Around {
    /// Of so many particles there may be; contacts that there is room for.
    pub fn new(capacity: usize, contacts: usize) -> Self {
        Self {
            starts: Vec::with_capacity(capacity + 1),
            contacts: Vec::with_capacity(4 * contacts),
            count: 0,
            due: Vec::with_capacity(contacts.div_ceil(64)),
            moved: Vec::with_capacity(capacity),
            stirred: Vec::with_capacity(capacity),
            states: Vec::with_capacity(capacity),
            was_stirred: false,
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let lists = [&self.starts, &self.contacts, &self.moved, &self.stirred];
        let words: usize = lists.iter().map(|list| list.capacity()).sum();
        4 * words + 8 * self.due.capacity() + self.states.capacity()
    }

    /// Nothing moved among so many particles, and contacts are to be sorted in anew.
    pub fn begin(&mut self, particles: usize) {
        self.count = 0;
        self.starts.resize(particles + 1, 0);
        self.rest();
        self.moved.drain(..).for_each(|at| self.states[at as usize] = 0);
        self.states.resize(particles, 0);
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
        let state = core::mem::replace(&mut self.states[particle as usize], MOVED | STIRRED);
        if state & MOVED == 0 {
            self.moved.push(particle);
        }
        if state & STIRRED == 0 {
            self.stirred.push(particle);
            self.was_stirred = true;
        }
    }

    /// All are at rest.
    pub fn rest(&mut self) {
        self.stirred.drain(..).for_each(|at| self.states[at as usize] &= !STIRRED);
    }

    /// Those that moved since.
    pub fn stirred(&self) -> &[u32] {
        &self.stirred
    }

    /// Whether any of these did.
    #[inline(always)]
    pub fn are_stirred(&self, particles: [u32; 4]) -> bool {
        let states = particles.map(|at| self.states[at as usize]);
        states.into_iter().fold(0, |all, state| all | state) & STIRRED != 0
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

    /// Those of a word are due no more that have a bit.
    pub fn let_go(&mut self, word: usize, bits: u64) {
        self.due[word] &= !bits;
    }

    /// Those are due whose particles moved.
    pub fn call_moved(&mut self, contacts: &[Contact]) {
        self.due.resize(contacts.len().div_ceil(64), 0);
        if self.moved.is_empty() {
            return;
        }
        self.sort(contacts);
        while let Some(particle) = self.moved.pop() {
            self.states[particle as usize] &= !MOVED;
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
