//! Warm start: contact forces of the last substep, used to start the contact solver of the next.
//!
//! If contacts start at zero, the six sweeps of a substep do not converge to the forces that hold
//! up a stack. If they start at the last solution, they converge over many substeps (Catto,
//! "Iterative Dynamics with Temporal Coherence", GDC 2005).
//!
//! Forces are stored, not impulses, so that the step size may change between substeps. The force
//! that holds up a stack keeps its size when substeps become longer; that of an impact m v / h falls
//! as 1 / h, and would throw layers apart if it did not. So all fall as 1 / h then, and the solver
//! adds what a stack lacks. `contact_forces` stores them.
//!
//! Reads the forces; writes [`WarmStartIndex`], a hash table with open addressing from the particles
//! of a contact to its force.
//!
//! Invariant: forces are stored in the order of their contacts.

use crate::solver::self_collide::contact_forces::{ContactForce, FORCES_PER_PARTICLE, WarmStart};
use crate::solver::self_collide::surface::contact::{Contact, ContactKind};

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
    use glam::Vec3;

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
}
