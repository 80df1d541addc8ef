//! Accumulates the corrections of triangle contacts and applies their weighted mean to each corner
//! (Jacobi iteration).
//!
//! ```text
//! p = Σ bₖ xₖ is to move by c:   Δxₖ = c bₖ wₖ / Σ bⱼ² wⱼ     (b: barycentric weight, w: 1/mass)
//! mean over contacts, weighted by bₖ · depth
//! ```
//! The weight makes a contact fade in and out with its depth, so no position jumps when a contact
//! begins or ends. If contacts were applied one after the other (Gauss–Seidel), only the last one
//! would be exact, and cloth that lies over an edge would never come to rest.
//!
//! Reads contacts in the local frame of a collider; writes positions and contacts through
//! [`LocalParticles`].
//! Invariant: particles are moved in the order of their first contact.

use crate::math::reserve::ReserveTotal;
use crate::solver::collide::local_particles::{LocalParticles, Penetration};
use glam::Vec3;

/// The accumulated corrections of one collider in one round.
#[derive(Clone, Debug, Default)]
pub(super) struct PushAccumulator {
    /// An entry for each particle.
    sums: Vec<AccumulatedPush>,
    /// The particles with a correction, in the order of their first contacts.
    pushed: Vec<u32>,
    /// While corners roll back: penetrations up to this depth do not count [m].
    rollback_depth: Option<f32>,
    /// Whether the last round moved a particle.
    has_moved: bool,
}

#[derive(Clone, Copy, Debug)]
struct AccumulatedPush {
    /// Weighted sum of corrections [m].
    correction: Vec3,
    /// Weighted sum of normals.
    normal: Vec3,
    /// Weighted sum of the motions of the surface [m].
    carry: Vec3,
    weight: f32,
    /// The largest barycentric weight of the particle in a contact.
    max_barycentric: f32,
}

impl AccumulatedPush {
    const NONE: Self = Self {
        correction: Vec3::ZERO,
        normal: Vec3::ZERO,
        carry: Vec3::ZERO,
        weight: 0.0,
        max_barycentric: 0.0,
    };
}

impl PushAccumulator {
    /// Allocates for `particles` particles.
    pub fn reserve(&mut self, particles: usize) {
        self.sums.reserve_total(particles);
        self.pushed.reserve_total(particles);
    }

    /// Removes all particles.
    pub fn clear(&mut self) {
        self.sums.clear();
        self.pushed.clear();
        (self.rollback_depth, self.has_moved) = (None, false);
    }

    /// From now on corners are not corrected but go back to where the substep began, if a
    /// penetration is deeper than this [m]. `None`: they are corrected, as at first.
    pub fn set_rollback(&mut self, depth: Option<f32>) {
        self.rollback_depth = depth;
    }

    /// Returns whether the last round moved a particle.
    pub fn has_moved(&self) -> bool {
        self.has_moved
    }

    /// Begins a round with `count` particles and no corrections.
    pub fn reset(&mut self, count: usize) {
        self.sums.resize(count, AccumulatedPush::NONE);
        self.pushed.clear();
    }

    /// Returns the particles that were corrected in this round.
    pub fn pushed(&self) -> &[u32] {
        &self.pushed
    }

    /// Adds the correction of a point of a triangle, given by its barycentric weights, to the
    /// corners. `carries` are the ways that the surface carries them in the substep [m]; vectors are in
    /// local space.
    pub fn add(
        &mut self,
        particles: &LocalParticles<'_>,
        (corners, weights): ([usize; 3], [f32; 3]),
        correction: Vec3,
        Penetration { normal, depth, .. }: Penetration,
        carries: [Vec3; 3],
    ) {
        let w = corners.map(|i| particles.mobility(i, normal));
        let denominator: f32 = (0..3).map(|k| weights[k] * weights[k] * w[k]).sum();
        let is_ignored = self.rollback_depth.is_some_and(|ignored| depth <= ignored);
        if denominator <= 0.0 || is_ignored {
            return;
        }
        for k in 0..3 {
            let mobility = weights[k] * w[k];
            if mobility <= 0.0 {
                continue;
            }
            let sum = &mut self.sums[corners[k]];
            if sum.weight == 0.0 {
                self.pushed.push(corners[k] as u32);
            }
            let weight = weights[k] * depth;
            sum.correction += correction * (mobility / denominator * weight);
            sum.normal += normal * weight;
            sum.carry += carries[k] * weight;
            sum.weight += weight;
            if weights[k] > sum.max_barycentric {
                sum.max_barycentric = weights[k];
            }
        }
    }

    /// Moves all particles that have corrections, or rolls them back, and sets their sums to zero.
    pub fn apply(&mut self, particles: &mut LocalParticles<'_>) {
        self.has_moved = false;
        for i in &self.pushed {
            let i = *i as usize;
            let sum = core::mem::replace(&mut self.sums[i], AccumulatedPush::NONE);
            let length = sum.normal.length();
            if length > 0.0 {
                let frame = particles.frames[1];
                let normal = frame.vector_to_world(sum.normal * (1.0 / length));
                let at = particles.end_position(i);
                let carry = sum.carry * (1.0 / sum.weight);
                let correction = if self.rollback_depth.is_some() {
                    particles.start_position(i) - at + carry
                } else {
                    sum.correction * (1.0 / sum.weight)
                };
                self.has_moved |= correction != Vec3::ZERO;
                let correction = frame.vector_to_world(correction);
                particles.apply_correction(i, (at, carry), normal, correction, sum.max_barycentric);
            }
        }
    }
}
