//! A contact between a particle and a collider, as the velocity pass needs it.
//!
//! Reads and writes only its own fields. The position pass fills the list, one entry per pair of
//! particle and collider; `response` turns it into velocities and impulses.
//! Invariant: vectors are in world space.

use glam::Vec3;

/// The index of no contact.
pub(super) const NO_CONTACT: u32 = u32::MAX;

/// A particle that touched a collider in a substep, by itself or as a corner of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ColliderContact {
    pub particle: u32,
    /// The index of the collider among the live ones.
    pub body: u32,
    /// The barycentric weight of the particle in the contact point, in 0..=1: 1 for the particle
    /// itself.
    pub weight: f32,
    /// The outward normal of the collider, of length one.
    pub normal: Vec3,
    /// The velocity of the collider at the contact [m/s].
    pub surface_velocity: Vec3,
    /// The velocity of the particle before the contact [m/s].
    pub approach_velocity: Vec3,
    /// The sum of all position corrections of the substep [m].
    pub correction: Vec3,
    /// The distance that the particle keeps from the collider [m].
    pub gap: f32,
    /// The distance from the collider, if another one pushes the particle towards it [m].
    pub distance: f32,
    /// How far the particle was pushed along a crease [m].
    pub way_in_crease: Vec3,
    /// Where the particle was along the normal after the position pass [m].
    pub height: f32,
    /// How far surface collision pushed it along the normal [m].
    pub pushed: f32,
    /// The coefficient of friction.
    pub friction: f32,
    pub restitution: f32,
    pub tangential_restitution: f32,
    /// The index of the contact of the same particle before this one; [`NO_CONTACT`] for the first.
    pub previous: u32,
}

impl ColliderContact {
    /// Returns the index of the last contact of a particle in a list; `slot` is where it was put
    /// last, in this list or in an earlier one.
    pub fn last_of(contacts: &[Self], particle: usize, slot: u32) -> Option<usize> {
        let contact = contacts.get(slot as usize)?;
        (contact.particle as usize == particle).then_some(slot as usize)
    }

    /// Returns the index of the contact between a particle and a collider; `last` is the last contact
    /// of the particle.
    pub fn find(contacts: &[Self], last: Option<usize>, body: u32) -> Option<usize> {
        let mut at = last?;
        while contacts[at].body != body {
            let previous = contacts[at].previous;
            if previous == NO_CONTACT {
                return None;
            }
            at = previous as usize;
        }
        Some(at)
    }

    /// Sorts contacts by collider, those of one collider in their order. Nearly all are sorted
    /// already. `slots` are the last contacts of all particles.
    pub fn sort_by_body(contacts: &mut [Self], slots: &mut [u32]) {
        let mut are_moved = false;
        for at in 1..contacts.len() {
            let body = contacts[at].body;
            if contacts[at - 1].body > body {
                let to = contacts[..at].partition_point(|one| one.body <= body);
                contacts[to..=at].rotate_right(1);
                are_moved = true;
            }
        }
        if are_moved {
            contacts.iter().for_each(|one| slots[one.particle as usize] = NO_CONTACT);
            for (at, contact) in contacts.iter_mut().enumerate() {
                let slot = &mut slots[contact.particle as usize];
                contact.previous = core::mem::replace(slot, at as u32);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(particle: u32, body: u32, previous: u32) -> ColliderContact {
        ColliderContact {
            particle,
            body,
            weight: 1.0,
            normal: Vec3::Y,
            surface_velocity: Vec3::ZERO,
            approach_velocity: Vec3::ZERO,
            correction: Vec3::ZERO,
            gap: 0.0,
            distance: 0.0,
            way_in_crease: Vec3::ZERO,
            height: 0.0,
            pushed: 0.0,
            friction: 0.0,
            restitution: 0.0,
            tangential_restitution: 1.0,
            previous,
        }
    }

    #[test]
    fn contacts_of_a_particle_are_found_before_and_after_sorting() {
        let of_seven = |body, previous| contact(7, body, previous);
        let mut contacts = [
            contact(5, 0, NO_CONTACT),
            of_seven(1, NO_CONTACT),
            contact(6, 1, NO_CONTACT),
            of_seven(2, 1),
            of_seven(0, 3),
        ];
        let mut slots = [NO_CONTACT; 8];
        (slots[5], slots[6], slots[7]) = (0, 2, 4);
        let find = |contacts: &[ColliderContact], slots: &[u32], body: u32| {
            let last = ColliderContact::last_of(contacts, 7, slots[7]);
            ColliderContact::find(contacts, last, body)
        };
        assert_eq!(
            [0, 1, 2, 3].map(|b| find(&contacts, &slots, b)),
            [Some(4), Some(1), Some(3), None]
        );
        ColliderContact::sort_by_body(&mut contacts, &mut slots);
        let order = contacts.each_ref().map(|one| (one.body, one.particle));
        assert_eq!(order, [(0, 5), (0, 7), (1, 7), (1, 6), (2, 7)]);
        assert_eq!(
            [0, 1, 2, 3].map(|b| find(&contacts, &slots, b)),
            [Some(1), Some(2), Some(4), None]
        );
        assert_eq!(ColliderContact::last_of(&contacts, 4, 1), None);
    }
}
