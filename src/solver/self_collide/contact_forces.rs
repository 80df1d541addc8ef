//! Contact forces of the last substep: the state that surface collision keeps from substep to
//! substep. They are part of a saved state and of the state hash.
//!
//! Reads and writes its own list; `surface::warm_start` says what it is for.
//! Invariant: each force pushes (`normal > 0`) and is finite.

use crate::math::heap_bytes::HeapBytes;
use crate::math::reserve::ReserveTotal;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Forces per particle that memory is reserved for.
pub(super) const FORCES_PER_PARTICLE: usize = 8;

/// The force of a contact on its first side [N].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ContactForce {
    pub ids: [u32; 4],
    /// A `ContactKind`.
    pub kind: u32,
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
pub(crate) struct WarmStart(pub(super) Vec<ContactForce>);

impl HeapBytes for WarmStart {
    fn heap_bytes(&self) -> usize {
        self.0.heap_bytes()
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    fn force(i: u32) -> ContactForce {
        ContactForce { ids: [i, i / 2, i % 7, 3], kind: 1, normal: 1.0, tangent: Vec3::ZERO }
    }

    #[test]
    fn forces_with_bad_ids_or_values_are_invalid() {
        let is_valid = |force: ContactForce| WarmStart(vec![force]).is_valid(10);
        assert!(is_valid(force(9)) && !is_valid(force(10)));
        assert!(!is_valid(ContactForce { normal: f32::NAN, ..force(1) }));
        assert!(!is_valid(ContactForce { normal: -1.0, ..force(1) }));
        assert!(!is_valid(ContactForce { tangent: Vec3::INFINITY, ..force(1) }));
    }
}
