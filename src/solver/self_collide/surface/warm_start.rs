//! Warm start: contact forces of the last substep, used to start the contact solver of the next.
//!
//! If contacts start at zero, the six sweeps of a substep do not converge to the forces that hold
//! up a stack. If they start at the last solution, they converge over many substeps (Catto,
//! "Iterative Dynamics with Temporal Coherence", GDC 2005).
//!
//! Forces are stored, not impulses, so that the step size may change between substeps. The force
//! that holds up a stack keeps its size when substeps become longer; that of an impact m v / h falls
//! as 1 / h, and would throw layers apart if it did not. So all fall as 1 / h then, and the solver
//! adds what a stack lacks. They are part of a saved state and of the state hash.
//!
//! Reads and writes its own lists. [`WarmStartIndex`] is a hash table with open addressing, from
//! the particles of a contact to its force.
//!
//! Invariant: forces are stored in the order of their contacts, and each one pushes (`normal > 0`)
//! and is finite.

use crate::math::reserve::ReserveTotal;
use crate::solver::self_collide::surface::contact::{Contact, ContactKind};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Forces per particle that memory is reserved for.
const FORCES_PER_PARTICLE: usize = 8;

/// The force of a contact on its first side [N].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ContactForce {
    pub ids: [u32; 4],
    pub kind: ContactKind,
    /// Along the contact normal.
    pub normal: f32,
    /// Friction.
    pub tangent: Vec3,
}

impl ContactForce {
    fn is_valid(&self) -> bool {
        self.normal > 0.0 && self.normal.is_finite() && self.tangent.is_finite()
    }
}

/// All contact forces of the last substep, in the order of their contacts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct WarmStart(Vec<ContactForce>);

impl WarmStart {
    /// Reserves memory for the forces of a cloth of `particles` particles.
    pub fn reserve(&mut self, particles: usize) {
        let capacity = FORCES_PER_PARTICLE * particles;
        self.0.reserve_total(capacity);
    }

    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Reduces the forces when the substep length changes from `before` to `after` [s] and grows.
    pub fn change_step(&mut self, before: f32, after: f32) {
        if before < after {
            let share = before / after;
            self.0.iter_mut().for_each(|force| {
                force.normal *= share;
                force.tangent *= share;
            });
            // The smallest forces round to zero.
            self.0.retain(ContactForce::is_valid);
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = &ContactForce> {
        self.0.iter()
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        size_of::<ContactForce>() * self.0.capacity()
    }

    /// Whether all forces are valid for a cloth of `particles` particles.
    pub fn is_valid(&self, particles: usize) -> bool {
        let has_ids = |force: &ContactForce| force.ids.iter().all(|id| (*id as usize) < particles);
        self.0.iter().all(|force| has_ids(force) && force.is_valid())
    }

    /// Replaces all forces. Those that do not push or are not finite are dropped.
    pub(crate) fn replace(&mut self, forces: impl Iterator<Item = ContactForce>) {
        self.0.clear();
        self.0.extend(forces.filter(ContactForce::is_valid));
    }
}

/// Hash table from contacts to their forces.
#[derive(Clone, Debug)]
pub(crate) struct WarmStartIndex {
    /// Index of a force plus 1, or 0 for a free slot. The length is a power of two.
    slots: Vec<u32>,
}

impl WarmStartIndex {
    /// Reserves memory for the forces of `particles` particles.
    pub fn new(particles: usize) -> Self {
        let slots = (2 * FORCES_PER_PARTICLE * particles).next_power_of_two();
        Self { slots: Vec::with_capacity(slots) }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        size_of::<u32>() * self.slots.capacity()
    }

    /// Rebuilds the table from all forces.
    pub fn rebuild(&mut self, forces: &WarmStart) {
        self.slots.clear();
        self.slots.resize((2 * forces.0.len()).next_power_of_two(), 0);
        for (i, force) in forces.0.iter().enumerate() {
            let mut slot = self.slot(force.ids, force.kind);
            while self.slots[slot] != 0 {
                slot = (slot + 1) & (self.slots.len() - 1);
            }
            self.slots[slot] = i as u32 + 1;
        }
    }

    /// The force of a contact in the last substep, if it had one.
    pub fn find_force<'a>(
        &self,
        contact: &Contact,
        forces: &'a WarmStart,
    ) -> Option<&'a ContactForce> {
        let mut slot = self.slot(contact.ids, contact.kind);
        while self.slots[slot] != 0 {
            let force = &forces.0[self.slots[slot] as usize - 1];
            if force.ids == contact.ids && force.kind == contact.kind {
                return Some(force);
            }
            slot = (slot + 1) & (self.slots.len() - 1);
        }
        None
    }

    fn slot(&self, [a, b, c, d]: [u32; 4], kind: ContactKind) -> usize {
        let mixed = [b, c, d, kind].iter().fold(a, |sum, id| (sum ^ id).wrapping_mul(0x9e37_79b1));
        (mixed ^ mixed >> 15) as usize & (self.slots.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn force(i: u32, kind: ContactKind) -> ContactForce {
        let ids = [i, i / 2, i % 7, 3];
        ContactForce { ids, kind, normal: i as f32 + 1.0, tangent: Vec3::ZERO }
    }

    #[test]
    fn the_index_finds_the_force_of_each_contact_and_no_other() {
        let mut contact = Contact::inactive([0; 4], 1);
        for count in [0, 1, 40] {
            let forces = WarmStart((0..count).flat_map(|i| [force(i, 1), force(i, 2)]).collect());
            let mut index = WarmStartIndex::new(3);
            index.rebuild(&forces);
            for wanted in forces.iter() {
                (contact.ids, contact.kind) = (wanted.ids, wanted.kind);
                assert_eq!(index.find_force(&contact, &forces), Some(wanted));
            }
            contact.ids = [count, count, 1, 1];
            assert_eq!(index.find_force(&contact, &forces), None);
        }
    }

    #[test]
    fn forces_with_bad_ids_or_values_are_invalid() {
        let is_valid = |force: ContactForce| WarmStart(vec![force]).is_valid(10);
        assert!(is_valid(force(9, 1)) && !is_valid(force(10, 1)));
        assert!(!is_valid(ContactForce { normal: f32::NAN, ..force(1, 1) }));
        assert!(!is_valid(ContactForce { normal: -1.0, ..force(1, 1) }));
        assert!(!is_valid(ContactForce { tangent: Vec3::INFINITY, ..force(1, 1) }));
    }
}
