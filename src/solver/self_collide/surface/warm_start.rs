//! What sides bear on each other with: where the next substep begins, so that what lies still stays as it is.
//!
//! Contacts that begin at nothing have to find anew in each substep what holds a heap up, and never quite do; those
//! that begin at what they found last go on finding it (Catto, "Iterative dynamics with temporal coherence", 2005).

use crate::solver::self_collide::surface::contact::{Contact, Kind};
use crate::solver::self_collide::surface::contact_solver::Push;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Room for so many of a particle.
const EACH: usize = 8;

/// Two sides, and the forces that the first gets from the second [N].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Load {
    pub ids: [u32; 4],
    pub first: Kind,
    pub push: f32,
    pub rub: Vec3,
}

impl Load {
    /// Whether it is one: what does not push bears nothing.
    fn is_sound(&self) -> bool {
        self.push > 0.0 && self.push.is_finite() && self.rub.is_finite()
    }
}

/// All that bear on each other, in the order of their contacts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct WarmStart(Vec<Load>);

impl WarmStart {
    /// Sees to room for those of so many particles.
    pub fn reserve(&mut self, particles: usize) {
        let room = EACH * particles;
        self.0.reserve_exact(room.saturating_sub(self.0.len()));
    }

    pub fn clear(&mut self) {
        self.0.clear();
    }

    pub fn iter(&self) -> impl Iterator<Item = &Load> {
        self.0.iter()
    }

    pub fn bytes(&self) -> usize {
        size_of::<Load>() * self.0.capacity()
    }

    /// Whether they may be of a cloth of so many particles.
    pub fn are_sound(&self, particles: usize) -> bool {
        let is_of = |load: &Load| load.ids.iter().all(|id| (*id as usize) < particles);
        self.0.iter().all(|load| is_of(load) && load.is_sound())
    }

    /// Keeps what contacts push with; `times` makes forces of it.
    pub(crate) fn keep(&mut self, contacts: &[Contact], active: &[Push], times: f32) {
        self.0.clear();
        let load = |push: &Push| {
            let Contact { ids, first, .. } = contacts[push.contact as usize];
            Load { ids, first, push: push.push * times, rub: push.rub * times }
        };
        self.0.extend(active.iter().map(load).filter(Load::is_sound));
    }
}

/// Finds loads by their sides.
#[derive(Clone, Debug)]
pub(crate) struct Finder {
    /// One more than the place of a load, or 0; a power of two.
    slots: Vec<u32>,
}

impl Finder {
    /// For the loads of so many particles.
    pub fn new(particles: usize) -> Self {
        Self { slots: Vec::with_capacity((2 * EACH * particles).next_power_of_two()) }
    }

    pub fn bytes(&self) -> usize {
        size_of::<u32>() * self.slots.capacity()
    }

    /// Sorts all in.
    pub fn sort(&mut self, loads: &WarmStart) {
        self.slots.clear();
        self.slots.resize((2 * loads.0.len()).next_power_of_two(), 0);
        for (at, load) in loads.0.iter().enumerate() {
            let mut slot = self.slot(load.ids, load.first);
            while self.slots[slot] != 0 {
                slot = (slot + 1) & (self.slots.len() - 1);
            }
            self.slots[slot] = at as u32 + 1;
        }
    }

    /// The load of a contact.
    pub fn find<'a>(&self, contact: &Contact, loads: &'a WarmStart) -> Option<&'a Load> {
        let mut slot = self.slot(contact.ids, contact.first);
        while self.slots[slot] != 0 {
            let load = &loads.0[self.slots[slot] as usize - 1];
            if load.ids == contact.ids && load.first == contact.first {
                return Some(load);
            }
            slot = (slot + 1) & (self.slots.len() - 1);
        }
        None
    }

    fn slot(&self, [a, b, c, d]: [u32; 4], first: Kind) -> usize {
        let mixed = [b, c, d, first].iter().fold(a, |sum, id| (sum ^ id).wrapping_mul(0x9e37_79b1));
        (mixed ^ mixed >> 15) as usize & (self.slots.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn load(at: u32, first: Kind) -> Load {
        let ids = [at, at / 2, at % 7, 3];
        Load { ids, first, push: at as f32 + 1.0, rub: Vec3::ZERO }
    }

    #[test]
    fn each_is_found_by_its_sides_and_no_other() {
        let mut contact = Contact::of([0; 4], 1);
        for count in [0, 1, 40] {
            let loads = WarmStart((0..count).flat_map(|at| [load(at, 1), load(at, 2)]).collect());
            let mut finder = Finder::new(3);
            finder.sort(&loads);
            for wanted in loads.iter() {
                (contact.ids, contact.first) = (wanted.ids, wanted.first);
                assert_eq!(finder.find(&contact, &loads), Some(wanted));
            }
            contact.ids = [count, count, 1, 1];
            assert_eq!(finder.find(&contact, &loads), None);
        }
    }

    #[test]
    fn what_no_cloth_can_have_is_refused() {
        let sound = |load: Load| WarmStart(vec![load]).are_sound(10);
        assert!(sound(load(9, 1)) && !sound(load(10, 1)));
        assert!(!sound(Load { push: f32::NAN, ..load(1, 1) }));
        assert!(!sound(Load { push: -1.0, ..load(1, 1) }));
        assert!(!sound(Load { rub: Vec3::INFINITY, ..load(1, 1) }));
    }
}
