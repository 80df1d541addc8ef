//! The data of collider contacts during a tick.
//!
//! Part of the cache of a cloth: everything here can be rebuilt, and none of it is saved or hashed.
//! Stage functions in `collide` fill and read it. `nearby` and `long` hold between ticks and belong to
//! the cloth, but for the candidate pairs; all other lists are lent by the pool of the thread.
//!
//! Invariant: after [`ContactScratch::reserve_lent`] no stage allocates, except that a list of
//! candidate pairs grows when there are more pairs than ever before.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::math::swap::swap;
use crate::solver::collide::body_motion::BodyMotion;
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::collide::inside_count::InsideCount;
use crate::solver::collide::long_pairs::LongPairs;
use crate::solver::collide::long_triangles::LongTriangles;
use crate::solver::collide::nearby_blocks::NearbyBlocks;
use crate::solver::collide::push_accumulator::PushAccumulator;
use crate::solver::collide::pushed_corners::PushedCorner;
use crate::solver::collide::room::Room;
use crate::state::colliders::Impulse;
use glam::Vec3;

/// Buffers for collider contacts. They are empty until the first collider is added.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactScratch {
    pub nearby: NearbyBlocks,
    pub(super) long: LongTriangles,
    /// The motion of each live collider over this tick.
    pub(super) body_motions: Vec<BodyMotion>,
    /// The contacts of this substep, by collider, then in the order of detection. Contacts beyond
    /// `max_contacts` are dropped: their particles neither bounce nor push the collider.
    pub collider_contacts: Vec<ColliderContact>,
    /// The largest number of contacts.
    pub(super) max_contacts: usize,
    /// Scratch: the particles that another stage moved into a collider, as contacts.
    pub(super) projections: Vec<ColliderContact>,
    /// Scratch: for each of their particles the sum of its corrections [m].
    pub(super) net_corrections: Vec<Vec3>,
    /// Scratch: their indices.
    pub projected: Vec<u32>,
    /// The impulse on each live collider in this tick, about the world origin.
    pub impulses: Vec<Impulse>,
    /// The impulse of all colliders that the velocities of the cloth took up in this substep, about
    /// the world origin.
    pub arrived: Impulse,
    /// The collider that the largest part of it came from, among the live ones.
    pub first_pusher: usize,
    /// For each live collider, what later stages of this substep pushed out of it: mass times
    /// displacement [kg m], and its moment about the world origin [kg m²].
    pub(super) late_pushes: Vec<Impulse>,
    /// A lower bound of the distance of each particle from one collider, over its path in this
    /// substep [m].
    pub(super) clearance: Vec<f32>,
    pub(super) pushes: PushAccumulator,
    /// The slacks of the candidate pairs of one collider [m].
    pub(super) slacks: Vec<f32>,
    pub(super) long_pairs: LongPairs,
    /// How far each particle has been pushed by the rounds of one collider.
    pub(super) corners: Vec<PushedCorner>,
    pub(super) room: Room,
    /// For each particle the index of its last contact in `collider_contacts`.
    pub(super) contact_slots: Vec<u32>,
    /// Scratch: whether each particle was found inside a collider; empty if none was.
    pub(super) is_inside: Vec<bool>,
    /// The held and the free particles inside solid meshes that do not come out in this tick.
    pub(super) in_solid_meshes: [InsideCount; 2],
}

impl ContactScratch {
    /// What the last projection of particles moved, as contacts.
    pub fn projections(&self) -> &[ColliderContact] {
        &self.projections
    }

    /// Adds to the angular impulse on the cloth, as if it came from the collider that pushed it most
    /// in this substep.
    pub fn add_torque(&mut self, torque: Vec3) {
        if let Some(impulse) = self.impulses.get_mut(self.first_pusher) {
            impulse.angular -= torque;
        }
    }

    /// Forgets the pushes of later stages, for those that give no velocity.
    pub fn forget_late_pushes(&mut self) {
        self.late_pushes.fill(Impulse::default());
    }

    /// Allocates what holds between ticks, for `bodies` colliders and a cloth of `particles` particles
    /// and `triangles` triangles, and invalidates it.
    pub fn reserve(&mut self, bodies: usize, particles: usize, triangles: usize) {
        self.nearby.reserve(bodies, particles, triangles);
        self.long.reserve(particles, triangles);
    }

    /// Allocates the lent lists for `bodies` colliders and a cloth of at most `particles` particles
    /// and `triangles` triangles.
    #[inline(never)]
    pub fn reserve_lent(&mut self, bodies: usize, particles: usize, triangles: usize) {
        self.body_motions.reserve_total(bodies);
        self.max_contacts = particles;
        self.collider_contacts.reserve_total(particles);
        self.projections.reserve_total(particles);
        self.net_corrections.reserve_total(particles);
        self.net_corrections.resize(particles, Vec3::ZERO);
        self.projected.reserve_total(particles);
        self.impulses.reserve_total(bodies);
        self.late_pushes.reserve_total(bodies);
        self.clearance.reserve_total(particles);
        self.pushes.reserve(particles);
        self.slacks.reserve_total(5 * bodies.min(4) * triangles);
        self.long_pairs.reserve(triangles);
        self.corners.reserve_total(particles);
        self.contact_slots.reserve_total(particles);
        self.contact_slots.resize(particles, 0);
        self.room.reserve(particles);
        self.is_inside.reserve_total(particles);
    }

    /// Exchanges all that lives within a tick with that of `other`.
    #[inline(never)]
    pub fn swap_lent(&mut self, other: &mut Self) {
        swap(self, other);
        swap(&mut self.nearby, &mut other.nearby);
        self.nearby.swap_lent(&mut other.nearby);
        swap(&mut self.long, &mut other.long);
    }

    /// Makes the lent lists those of a cloth that was just made, but for their memory.
    #[inline(never)]
    pub fn clear_lent(&mut self) {
        self.nearby.clear_lent();
        self.body_motions.clear();
        self.collider_contacts.clear();
        self.projections.clear();
        self.net_corrections.clear();
        self.projected.clear();
        self.impulses.clear();
        (self.arrived, self.first_pusher) = (Impulse::default(), 0);
        self.late_pushes.clear();
        self.clearance.clear();
        self.pushes.clear();
        self.slacks.clear();
        self.long_pairs.clear();
        self.corners.clear();
        self.contact_slots.clear();
        self.room.clear();
        self.is_inside.clear();
        self.in_solid_meshes = Default::default();
    }
}

heap_bytes!(
    ContactScratch { nearby, long } plain {
        body_motions, collider_contacts, max_contacts, projections, net_corrections, projected,
        impulses, arrived, first_pusher, late_pushes, clearance, pushes, slacks, long_pairs,
        corners, room, contact_slots, is_inside, in_solid_meshes,
    }
);
