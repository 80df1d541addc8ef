//! Particles in the local frame of one collider during one substep: narrow phases read positions
//! here and apply their corrections here.
//!
//! ```text
//! start = R₀ᵀ (x₀ − o₀)     x₀, R₀, o₀: position and frame at the start of the substep
//! end   = R₁ᵀ (x  − o₁)     x, R₁, o₁:  position now, frame at the end of the substep
//! ```
//! In this frame the collider rests, so the path from `start` to `end` is the motion relative to
//! it, and continuous detection works the same for moving and for resting colliders.
//!
//! Friction is Coulomb friction on positions: of the tangential motion relative to the surface, a
//! correction of depth d takes back up to μ d (Macklin, Müller, Chentanez, Kim, "Unified particle
//! physics for real-time applications", SIGGRAPH 2014).
//!
//! Reads predicted positions, displacements, velocities and inverse masses; writes positions and
//! the list of contacts.
//! Invariant: a pair of particle and collider has at most one contact in the list.

use crate::geometry::transform::Transform;
use crate::math::columns::Columns;
use crate::math::{max, min};
use crate::model::maps::{Map, Maps};
use crate::solver::collide::collider_contact::{ColliderContact, NO_CONTACT};
use crate::solver::collide::room::{Room, least};
use crate::state::colliders::ColliderBody;
use crate::state::settings::BdfScheme;
use glam::Vec3;

/// Below this cosine between their normals, one contact opposes another.
const MAX_OPPOSED_COSINE: f32 = -0.5;

/// The part of its mobility that a corner keeps which another collider pushes back. Were it 0, the other
/// corners would have to move far where their weights are small.
const HELD_MOBILITY: f32 = 1.0 / 64.0;

/// The coefficients of a contact, from the collider or else from the cloth material.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactMaterial {
    friction: f32,
    restitution: f32,
    tangential_restitution: f32,
}

impl ContactMaterial {
    /// Without friction and without bounce.
    pub const FRICTIONLESS: Self =
        Self { friction: 0.0, restitution: 0.0, tangential_restitution: 1.0 };

    /// Returns the coefficients of `body`; those of the material where the collider has none of its
    /// own.
    pub fn of(body: &ColliderBody, friction: f32, restitution: f32) -> Self {
        let own = |value: f32, default: f32| if value < 0.0 { default } else { value };
        Self {
            friction: own(body.desc.friction, friction),
            restitution: own(body.desc.restitution, restitution),
            tangential_restitution: body.desc.tangential_restitution,
        }
    }

    /// Returns the fraction of a tangential motion of length `slide` [m] that friction cancels at a
    /// correction of `depth` [m]. `scale` is that of the friction.
    fn friction_fraction(&self, slide: f32, depth: f32, scale: f32) -> f32 {
        let most = self.friction * scale * depth;
        if slide <= most { 1.0 } else { most / slide }
    }
}

/// The painted scales of contacts.
#[derive(Clone, Copy)]
pub(super) struct ContactScales<'a> {
    friction: Option<&'a [f32]>,
    thickness: Option<&'a [f32]>,
    /// The share of all distances that each particle has room for.
    room: Option<&'a [f32]>,
    /// The least and the largest scale of the thickness.
    pub thickness_range: [f32; 2],
}

impl<'a> ContactScales<'a> {
    pub fn new(maps: &'a Maps, room: &'a Room) -> Self {
        Self {
            friction: maps.get(Map::Friction),
            thickness: maps.get(Map::Thickness),
            room: room.shares(),
            thickness_range: maps.range(Map::Thickness),
        }
    }

    /// The scale of the friction at a point of a triangle.
    fn friction(&self, corners: &[usize], weights: &[f32]) -> f32 {
        self.friction.map_or(1.0, |scales| {
            corners.iter().zip(weights).map(|(i, weight)| scales[*i] * weight).sum()
        })
    }

    /// The scale of the distance of an edge or a triangle: the least of its corners, so that it does
    /// not push a corner away that keeps less.
    pub fn thickness(&self, corners: &[usize]) -> f32 {
        least(self.thickness, corners) * self.room(corners)
    }

    /// Returns whether a particle is between colliders that leave it less than its gap.
    pub fn has_less_room(&self, i: usize) -> bool {
        self.room(&[i]) < 1.0
    }

    /// The shares of all particles, if any has less than all the room.
    pub fn all_room(&self) -> Option<&'a [f32]> {
        self.room
    }

    /// The share of all distances that there is room for at all these particles.
    #[inline(always)]
    pub fn room(&self, corners: &[usize]) -> f32 {
        least(self.room, corners)
    }
}

/// A penetration to resolve: direction and depth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Penetration {
    /// Outward, of length one.
    pub normal: Vec3,
    /// [m]
    pub depth: f32,
    /// Whether friction does not act on it.
    pub is_frictionless: bool,
    /// How far the surface moved there in the substep, in the frame of the collider [m].
    pub carry: Vec3,
}

impl Penetration {
    /// A penetration with friction, at a surface that does not move in its frame.
    pub fn new(normal: Vec3, depth: f32) -> Self {
        Self { normal, depth, is_frictionless: false, carry: Vec3::ZERO }
    }
}

/// Limits how fast a point that started the substep inside a collider comes out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Depenetration {
    /// The largest distance that such a point rises in the substep [m].
    pub max_step: f32,
    /// A point deeper than this [m] rises by at most `max_step`, even if something pulls it inward,
    /// and slides without friction. So cloth that starts inside a shape leaves it on the side to
    /// which most of its points are pushed, and does not tear.
    pub deep: f32,
    /// Whether a deep point does not rise at all, but also does not sink.
    pub holds_deep: bool,
}

impl Depenetration {
    /// Returns the penetration of a point at a signed distance of `start` [m] at the start of the
    /// substep and `end` [m] now, with contact distance `gap` [m]; `None` if it needs no
    /// correction.
    pub fn penetration(&self, normal: Vec3, gap: f32, start: f32, end: f32) -> Option<Penetration> {
        let is_frictionless = start < -self.deep;
        let rise = if is_frictionless && self.holds_deep { 0.0 } else { self.max_step };
        let depth = min(gap, start + rise) - end;
        let depth = if is_frictionless { min(depth, self.max_step) } else { depth };
        (depth > 0.0).then(|| Penetration { is_frictionless, ..Penetration::new(normal, depth) })
    }
}

/// The particles of a cloth as one collider sees them in one substep.
pub(super) struct LocalParticles<'a> {
    pub x: &'a mut Columns,
    pub v: &'a Columns,
    /// Inverse masses [1/kg].
    pub w: &'a [f32],
    /// The displacements that prediction gave in this substep [m].
    pub displacement: &'a Columns,
    /// The predicted positions [m].
    pub predicted: &'a Columns,
    /// The frames of the collider at the start and at the end of the substep.
    pub frames: [Transform; 2],
    /// Whether these two differ.
    pub is_moving: bool,
    pub material: ContactMaterial,
    pub contact_scales: ContactScales<'a>,
    /// The distance that particles keep from the shape at scale 1, without `margin` [m].
    pub gap: f32,
    /// What they keep on top of it at smooth shapes, whatever their scale [m].
    pub margin: f32,
    pub depenetration: Depenetration,
    pub scheme: BdfScheme,
    /// The index of the collider among the live ones.
    pub body: u32,
    /// Whether the origin of the cloth is not zero.
    pub is_far_from_zero: bool,
    /// Whether corners of triangles hardly yield where another collider pushes them back.
    pub holds_corners: bool,
    pub contacts: &'a mut Vec<ColliderContact>,
    /// For each particle the index of its last contact in `contacts`.
    pub contact_slots: &'a mut [u32],
    /// The largest number of contacts.
    pub max_contacts: usize,
}

impl LocalParticles<'_> {
    /// Returns the inverse mass with which a corner of a triangle yields to a push along a local normal
    /// [1/kg]: nearly none where another collider pushes it back.
    #[inline(never)]
    pub fn mobility(&self, i: usize, normal: Vec3) -> f32 {
        if !self.holds_corners {
            return self.w[i];
        }
        let normal = self.frames[1].vector_to_world(normal);
        let mut at = self.contact_slots[i];
        while let Some(contact) = self.contacts.get(at as usize) {
            // A slot may be that of an earlier list.
            if contact.particle as usize != i {
                break;
            }
            if contact.body != self.body && contact.normal.dot(normal) < MAX_OPPOSED_COSINE {
                return self.w[i] * HELD_MOBILITY;
            }
            at = contact.previous;
        }
        self.w[i]
    }

    /// Returns the distance that a particle keeps from the shape [m].
    #[inline(always)]
    pub fn gap_of(&self, i: usize) -> f32 {
        self.gap * self.contact_scales.thickness(&[i])
            + self.margin * self.contact_scales.room(&[i])
    }

    /// Returns the largest distance that a particle keeps [m].
    #[inline(always)]
    pub fn largest_gap(&self) -> f32 {
        self.gap * self.contact_scales.thickness_range[1] + self.margin
    }

    /// Returns the local position of a particle at the start of the substep [m].
    #[inline(never)]
    pub fn start_position(&self, i: usize) -> Vec3 {
        self.frames[0].point_to_local(self.start_in_world(i))
    }

    /// Returns the position of a particle at the start of the substep [m].
    #[inline(always)]
    pub fn start_in_world(&self, i: usize) -> Vec3 {
        self.predicted.get(i) - self.displacement.get(i)
    }

    /// Returns the local position of a particle now [m].
    #[inline(never)]
    pub fn end_position(&self, i: usize) -> Vec3 {
        self.frames[1].point_to_local(self.x.get(i))
    }

    /// Returns the local positions of a particle at the start of the substep and now [m].
    #[inline(always)]
    pub fn path_of(&self, i: usize) -> [Vec3; 2] {
        let start = self.frames[0].point_to_local(self.start_in_world(i));
        [start, self.frames[1].point_to_local(self.x.get(i))]
    }

    /// Returns the path of a point of a triangle in this substep, in world space [m].
    #[inline(never)]
    fn path(&self, corners: &[usize], weights: &[f32]) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for (i, weight) in corners.iter().zip(weights) {
            let start = self.start_in_world(*i);
            sum += (self.x.get(*i) - start) * *weight;
        }
        sum
    }

    /// Returns the correction of a point of a triangle that moved from `start` to `end` [m]: out
    /// of the penetration, and back along the surface by friction.
    #[inline]
    pub fn correction(
        &self,
        (corners, weights): ([usize; 3], [f32; 3]),
        [start, end]: [Vec3; 2],
        penetration: Penetration,
    ) -> Vec3 {
        let out = penetration.normal * penetration.depth;
        if penetration.is_frictionless {
            return out;
        }
        let slide = if self.is_far_from_zero && !self.is_moving {
            // Local positions may have lost digits: those in a large collider that the cloth is at
            // the far end of.
            self.frames[1].vector_to_local(self.path(&corners, &weights)) + out - penetration.carry
        } else {
            end + out - start
        };
        let tangential = slide - penetration.normal * slide.dot(penetration.normal);
        let (length, scale) =
            (tangential.length(), self.contact_scales.friction(&corners, &weights));
        out - tangential * self.material.friction_fraction(length, penetration.depth, scale)
    }

    /// Returns the velocity of the collider at a local point, in world space [m/s]. Its surface moved
    /// there by `carry` [m].
    fn surface_velocity(&self, at: Vec3, carry: Vec3) -> Vec3 {
        let mut travel = Vec3::ZERO;
        if self.is_moving {
            travel = self.frames[1].point_to_world(at) - self.frames[0].point_to_world(at);
        }
        if carry != Vec3::ZERO {
            travel += self.frames[1].vector_to_world(carry);
        }
        travel * (1.0 / self.scheme.h)
    }

    /// Moves particle `i` out of a penetration at the end of its `path`, with friction, and records
    /// the contact.
    #[cfg_attr(not(target_arch = "wasm32"), inline(never))]
    pub fn push_out(&mut self, i: usize, path: &[Vec3; 2], penetration: &Penetration) {
        let correction = self.correction(([i; 3], [1.0, 0.0, 0.0]), *path, *penetration);
        self.apply_local_correction(i, path[1], *penetration, correction);
    }

    /// Moves particle `i`, which itself touches the collider at the local point `at`, by a
    /// correction of a penetration in local space [m], and records the contact.
    pub fn apply_local_correction(
        &mut self,
        i: usize,
        at: Vec3,
        Penetration { normal, carry, .. }: Penetration,
        correction: Vec3,
    ) {
        let normal = self.frames[1].vector_to_world(normal);
        let correction = self.frames[1].vector_to_world(correction);
        self.apply_correction(i, (at, carry), normal, correction, 1.0);
    }

    /// Moves particle `i` by a correction in world space [m] and records the contact, merged with
    /// an earlier one of the same pair. `at` is the local point that it touches, where the surface
    /// moved by `carry` [m]. `weight` is the barycentric weight of the particle in the
    /// contact point. If the list of contacts is full, the particle is moved but neither bounces
    /// nor pushes the collider.
    pub fn apply_correction(
        &mut self,
        i: usize,
        (at, carry): (Vec3, Vec3),
        normal: Vec3,
        correction: Vec3,
        weight: f32,
    ) {
        self.x.add(i, correction);
        let last = ColliderContact::last_of(self.contacts, i, self.contact_slots[i]);
        if let Some(at) = ColliderContact::find(self.contacts, last, self.body) {
            let contact = &mut self.contacts[at];
            // The larger correction gives the normal.
            if correction.length_squared() > contact.correction.length_squared() {
                contact.normal = normal;
            }
            contact.correction += correction;
            contact.weight = max(weight, contact.weight);
        } else if self.contacts.len() < self.max_contacts {
            self.contact_slots[i] = self.contacts.len() as u32;
            self.contacts.push(ColliderContact {
                particle: i as u32,
                body: self.body,
                weight,
                normal,
                surface_velocity: self.surface_velocity(at, carry),
                approach_velocity: self.v.get(i),
                correction,
                gap: self.gap_of(i),
                distance: 0.0,
                way_in_crease: Vec3::ZERO,
                height: 0.0,
                pushed: 0.0,
                friction: self.material.friction * self.contact_scales.friction(&[i], &[1.0]),
                restitution: self.material.restitution,
                tangential_restitution: self.material.tangential_restitution,
                previous: last.map_or(NO_CONTACT, |at| at as u32),
            });
        }
    }
}
