//! Planes that the non-crossing pass must not push particles through: the tangent planes of the
//! colliders that these particles touch.
//!
//! ```text
//!      ●  particle, pushed by a contact          n · x ≥ n · p
//!      ↓ ↘                                       n: outward normal of the collider
//!   ───●──▶●──────  plane through p, where the   p: position that the collider pass gave
//!  collider ▒▒▒▒▒   particle rests; it may slide along the plane or leave it
//! ```
//! Projection onto half-spaces between the pushes of pair contacts solves both kinds of constraints
//! in one Gauss-Seidel loop, which converges faster than whole passes in turn.
//!
//! Reads contacts of the collider pass; its callers move particles of `SweptParticles`.
//!
//! Invariant: a particle has at most one plane for each collider.

use crate::math::wide4::{Float4, xyz};
use crate::solver::particle_stage::interleaved::translate;
use glam::Vec3;

/// The end of a particle's list of planes.
const NONE: u32 = u32::MAX;

/// A particle that is lower above a plane than this touches it [m].
const TOUCHING: f32 = 1.0e-5;

/// A plane stops motions whose direction has at least this share against its normal.
const STEEP: f32 = 0.5;

/// One plane of one particle.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: Vec3,
    /// `normal · x` of points on the plane [m].
    offset: f32,
    /// The index of the collider among the live ones.
    body: u32,
    /// The next plane of the same particle.
    next: u32,
}

/// The planes of all particles.
#[derive(Clone, Debug)]
pub(crate) struct SupportPlanes {
    /// For each particle its newest plane.
    first: Vec<u32>,
    planes: Vec<Plane>,
    /// The particles that have planes.
    particles: Vec<u32>,
}

impl SupportPlanes {
    pub fn new(capacity: usize) -> Self {
        Self {
            first: Vec::with_capacity(capacity),
            planes: Vec::with_capacity(capacity),
            particles: Vec::with_capacity(capacity),
        }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        size_of::<u32>() * (self.first.capacity() + self.particles.capacity())
            + size_of::<Plane>() * self.planes.capacity()
    }

    /// Removes all planes, for a cloth of `count` particles.
    pub fn reset(&mut self, count: usize) {
        if self.first.len() != count {
            self.first.clear();
            self.first.resize(count, NONE);
        } else {
            self.particles.iter().for_each(|i| self.first[*i as usize] = NONE);
        }
        self.particles.clear();
        self.planes.clear();
    }

    /// Inserts the plane through `at` with this outward normal, in place of an earlier one of the
    /// same particle and collider. A plane that exceeds the capacity is dropped.
    pub fn insert(&mut self, particle: u32, body: u32, normal: Vec3, at: Vec3) {
        let offset = normal.dot(at);
        let mut index = self.first[particle as usize];
        while index != NONE {
            let plane = &mut self.planes[index as usize];
            if plane.body == body {
                (plane.normal, plane.offset) = (normal, offset);
                return;
            }
            index = plane.next;
        }
        if self.planes.len() == self.planes.capacity() {
            return;
        }
        let next = self.first[particle as usize];
        if next == NONE {
            self.particles.push(particle);
        }
        self.first[particle as usize] = self.planes.len() as u32;
        self.planes.push(Plane { normal, offset, body, next });
    }

    /// Whether a plane stops a particle that moves in this direction of length one.
    #[inline(always)]
    pub fn blocks(&self, particle: usize, x: &Float4, direction: Vec3) -> bool {
        let mut index = self.first[particle];
        while index != NONE {
            let plane = &self.planes[index as usize];
            let height = plane.normal.dot(xyz(x)) - plane.offset;
            if height < TOUCHING && plane.normal.dot(direction) < -STEEP {
                return true;
            }
            index = plane.next;
        }
        false
    }

    /// Projects a particle onto the planes that it is behind. Returns whether it moved.
    #[inline(always)]
    pub fn project(&self, particle: usize, x: &mut Float4) -> bool {
        let mut index = self.first[particle];
        let mut has_moved = false;
        while index != NONE {
            let plane = &self.planes[index as usize];
            let depth = plane.offset - plane.normal.dot(xyz(x));
            if depth > 0.0 {
                translate(x, plane.normal * depth);
                has_moved = true;
            }
            index = plane.next;
        }
        has_moved
    }

    /// Projects all particles that have planes. Returns whether any moved.
    pub fn project_all(&self, now: &mut [Float4]) -> bool {
        let mut has_moved = false;
        for i in self.particles.iter().map(|i| *i as usize) {
            has_moved |= self.project(i, &mut now[i]);
        }
        has_moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_particle_is_projected_onto_each_plane_that_it_is_behind() {
        let mut planes = SupportPlanes::new(3);
        planes.reset(3);
        planes.insert(1, 0, Vec3::Y, Vec3::ZERO);
        planes.insert(1, 4, Vec3::X, Vec3::X);
        let mut now = [[0.0, -1.0, 0.0, 1.0]; 3];
        assert!(planes.project_all(&mut now));
        assert_eq!(now[1], [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(now[0], now[2]);
        assert!(!planes.project_all(&mut now));
    }

    #[test]
    fn a_later_plane_of_the_same_collider_replaces_the_earlier_one() {
        let mut planes = SupportPlanes::new(1);
        planes.reset(1);
        planes.insert(0, 0, Vec3::Y, Vec3::ZERO);
        planes.insert(0, 0, Vec3::X, Vec3::ZERO);
        let mut now = [[0.0, -1.0, 0.0, 1.0]];
        assert!(!planes.project_all(&mut now));
        planes.reset(1);
        now[0][0] = -1.0;
        assert!(!planes.project_all(&mut now));
    }
}
