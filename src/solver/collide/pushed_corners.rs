//! How far the rounds that push triangles out of one collider have pushed each particle.
//!
//! Reads local particles and the list of those that a round pushed; writes its own list.
//! Invariant: the distance of a particle is that after the round that was measured last.

use crate::math::max;
use crate::solver::collide::local_particles::LocalParticles;
use glam::Vec3;

/// A particle, since slacks were computed.
#[derive(Clone, Copy, Debug)]
pub(super) struct PushedCorner {
    /// Its local position at the beginning [m].
    position: Vec3,
    /// How far it came in the substep until then, in the frame of the collider [m].
    way: f32,
    /// How far it has been pushed since [m].
    pushed: f32,
}

/// All particles, since slacks were computed.
pub(super) struct PushedCorners<'a>(&'a mut Vec<PushedCorner>);

impl<'a> PushedCorners<'a> {
    /// Starts to measure from the current positions.
    pub fn begin(corners: &'a mut Vec<PushedCorner>, particles: &LocalParticles<'_>) -> Self {
        corners.clear();
        corners.extend((0..particles.w.len()).map(|i| {
            let position = particles.end_position(i);
            let way = position.distance(particles.start_position(i));
            PushedCorner { position, way, pushed: 0.0 }
        }));
        Self(corners)
    }

    /// Measures how far the particles that the last round pushed are from where they began.
    pub fn measure(&mut self, pushed: &[u32], particles: &LocalParticles<'_>) {
        for i in pushed {
            let corner = &mut self.0[*i as usize];
            corner.pushed = particles.end_position(*i as usize).distance(corner.position);
        }
    }

    /// Returns the local position of a particle at the beginning [m].
    #[inline(always)]
    pub fn position(&self, i: u32) -> Vec3 {
        self.0[i as usize].position
    }

    /// Returns how far the fastest of some particles came in the substep until the beginning [m].
    #[inline(always)]
    pub fn longest_way(&self, particles: &[u32]) -> f32 {
        particles.iter().map(|i| self.0[*i as usize].way).fold(0.0, max)
    }

    /// Returns whether none of some particles has been pushed as far as `slack` [m].
    #[inline(always)]
    pub fn are_within(&self, particles: &[u32], slack: f32) -> bool {
        particles.iter().all(|i| self.0[*i as usize].pushed < slack)
    }
}
