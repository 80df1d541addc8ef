//! Positions of all particles at the start of a substep and now, and a motion bound of each
//! particle.
//!
//! ```text
//!   start ●───────────────▶● now          motion bound: a box around the displacement now − start,
//!                       ┌─────┐           grown by a slack for what later stages and contacts add
//!                       │  ●  │
//!                       └─────┘
//! ```
//! The bound is the conservative estimate of where a particle may end the substep. All culling
//! (swept AABBs, separation test) relies on it. A particle that leaves its bound has *escaped*: its
//! bound is widened and its pairs are tested again.
//!
//! Reads and writes its own lists; [`interleaved::gather`] fills `start` and `now`.
//!
//! Invariant: pairs that culling dropped cannot touch while every particle stays within its bound.
//! A stage that moves particles later must widen the bounds of those that escaped and test their
//! pairs again.

use crate::math::wide4::{Float4, Wide4, XYZ_MASK, xyz};
use crate::math::{max, min};
use crate::solver::particle_stage::interleaved::{self, mean_displacement};
use crate::solver::self_collide::surface::swept_aabb::SweptAabb;
use glam::Vec3;

/// Slack of a motion bound: the smaller of a share of the mean rest length and a share of the gap,
/// plus a share of how far the particle moved relative to the mean displacement.
const SLACK: f32 = 0.03;
const SLACK_OF_GAP: f32 = 1.5;
const SLACK_OF_DISPLACEMENT: f32 = 0.25;

/// All particles of a cloth in a substep.
#[derive(Clone, Debug)]
pub(crate) struct SweptParticles {
    /// Positions at the start of the substep, and current positions; inverse masses.
    pub start: Vec<Float4>,
    pub now: Vec<Float4>,
    /// Mean displacement of all particles in the substep [m].
    pub mean_displacement: Vec3,
    /// Displacement of particles that roll back [m]: the mean, or 0 where colliders touch the
    /// cloth, since only the start positions are known to lie outside them.
    pub rollback_displacement: Vec3,
    /// Motion bounds: the lower and the upper corner of the box of displacements from the start
    /// [m].
    bound_low: Vec<Float4>,
    bound_high: Vec<Float4>,
    /// Whether each particle has escaped from its motion bound.
    escaped: Vec<bool>,
    /// Whether each particle has moved since the last detection.
    moved: Vec<bool>,
}

/// Result of [`SweptParticles::widen_bounds`].
pub(crate) struct Widened {
    /// Whether the bound of any particle was widened.
    pub any: bool,
    /// Whether all particles are within their bounds now. False only for NaN.
    pub are_all_within: bool,
}

impl SweptParticles {
    pub fn new(capacity: usize) -> Self {
        let [start, now, bound_low, bound_high] = [(); 4].map(|()| Vec::with_capacity(capacity));
        let [escaped, moved] = [(); 2].map(|()| Vec::with_capacity(capacity));
        Self {
            start,
            now,
            mean_displacement: Vec3::ZERO,
            rollback_displacement: Vec3::ZERO,
            bound_low,
            bound_high,
            escaped,
            moved,
        }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        let lists = [&self.start, &self.now, &self.bound_low, &self.bound_high];
        size_of::<Float4>() * lists.iter().map(|list| list.capacity()).sum::<usize>()
            + self.escaped.capacity()
            + self.moved.capacity()
    }

    /// Resets the motion bound of each particle to a box around its current displacement.
    ///
    /// `spacing` is the mean rest length, `gap` the gap between layers [m]; `touches_collider` says
    /// whether any particle touches a collider.
    pub fn reset_bounds(&mut self, spacing: f32, gap: f32, touches_collider: bool) {
        let Self { start, now, bound_low, bound_high, .. } = self;
        self.mean_displacement = mean_displacement(start, now);
        self.rollback_displacement =
            if touches_collider { Vec3::ZERO } else { self.mean_displacement };
        bound_low.resize(start.len(), [0.0; 4]);
        bound_high.resize(start.len(), [0.0; 4]);
        let slack = min(spacing * SLACK, gap * SLACK_OF_GAP);
        interleaved::compute_motion_bounds(
            [start, now],
            [bound_low, bound_high],
            self.mean_displacement,
            [SLACK_OF_DISPLACEMENT, slack],
        );
    }

    /// Widens the motion bounds of escaped particles to contain their current displacement; with
    /// `may_roll_back`, every bound is widened to contain `rollback_displacement` as well.
    pub fn widen_bounds(&mut self, spacing: f32, gap: f32, may_roll_back: bool) -> Widened {
        let slack = min(spacing * SLACK, gap * SLACK_OF_GAP);
        let rollback = Wide4::from_vec3(self.rollback_displacement);
        let (mut any, mut are_all_within) = (false, true);
        self.escaped.clear();
        self.escaped.resize(self.now.len(), false);
        let bounds = self.bound_low.iter_mut().zip(&mut self.bound_high).zip(&mut self.escaped);
        for ((start, now), ((low, high), escaped)) in self.start.iter().zip(&self.now).zip(bounds) {
            if surely_contains(low, high, Wide4::load(now) - Wide4::load(start))
                && (!may_roll_back || surely_contains(low, high, rollback))
            {
                continue;
            }
            let displacement = xyz(now) - xyz(start);
            *escaped = !contains(low, high, displacement);
            if *escaped {
                let relative = displacement.distance(self.mean_displacement);
                widen(low, high, displacement, relative * SLACK_OF_DISPLACEMENT + slack);
            }
            if may_roll_back && !contains(low, high, self.rollback_displacement) {
                widen(low, high, self.rollback_displacement, slack);
                *escaped = true;
            }
            any |= *escaped;
            are_all_within &= contains(low, high, displacement);
        }
        Widened { any, are_all_within }
    }

    /// Sets which particles moved since the pairs were detected; `None`: any may have.
    pub fn set_moved(&mut self, moved: Option<&[u32]>) {
        self.moved.clear();
        self.moved.resize(self.now.len(), moved.is_none());
        moved.into_iter().flatten().for_each(|i| self.moved[*i as usize] = true);
    }

    /// Whether a particle is one of [`Self::set_moved`].
    #[inline(always)]
    pub fn has_moved(&self, particle: u32) -> bool {
        self.moved[particle as usize]
    }

    /// Whether the last [`Self::widen_bounds`] widened the bound of a particle.
    #[inline(always)]
    pub fn has_escaped(&self, particle: u32) -> bool {
        self.escaped[particle as usize]
    }

    /// Whether the current displacements of some particles lie within their motion bounds.
    pub fn are_within_bounds(&self, mut particles: impl Iterator<Item = u32>) -> bool {
        particles.all(|i| {
            let i = i as usize;
            let displacement = xyz(&self.now[i]) - xyz(&self.start[i]);
            contains(&self.bound_low[i], &self.bound_high[i], displacement)
        })
    }

    /// Start positions, and the lower and upper corners of the motion bounds.
    pub fn start_and_bounds(&self) -> [&[Float4]; 3] {
        [&self.start, &self.bound_low, &self.bound_high]
    }

    /// The motion bound of a particle: lower and upper corner [m].
    #[inline(always)]
    pub fn bound_of(&self, i: usize) -> [Vec3; 2] {
        [xyz(&self.bound_low[i]), xyz(&self.bound_high[i])]
    }

    /// The AABB of some particles at the start of the substep, without displacement.
    #[inline(always)]
    pub fn start_aabb<const COUNT: usize>(&self, particles: [u32; COUNT]) -> SweptAabb {
        let mut all = SweptAabb::EMPTY;
        for particle in particles {
            let start = &self.start[particle as usize];
            for k in 0..4 {
                all.low[k] = min(all.low[k], start[k]);
                all.high[k] = max(all.high[k], start[k]);
            }
        }
        SweptAabb { displacement_low: [0.0; 4], displacement_high: [0.0; 4], ..all }
    }

    /// The swept AABB of one particle.
    #[inline(always)]
    pub fn swept_point(&self, particle: u32) -> SweptAabb {
        let i = particle as usize;
        let start = self.start[i];
        SweptAabb {
            low: start,
            high: start,
            displacement_low: self.bound_low[i],
            displacement_high: self.bound_high[i],
        }
    }

    /// The swept AABB of some particles.
    #[inline(always)]
    pub fn swept_aabb<const COUNT: usize>(&self, particles: [u32; COUNT]) -> SweptAabb {
        let mut all = self.swept_point(particles[0]);
        for particle in &particles[1..] {
            all.merge(&self.swept_point(*particle));
        }
        all
    }

    /// The least and the greatest coordinate along `n` that a particle may end the substep at [m].
    #[inline(always)]
    pub fn end_range_along(&self, particle: u32, n: Vec3) -> [f32; 2] {
        let i = particle as usize;
        let (low, high) = (xyz(&self.bound_low[i]), xyz(&self.bound_high[i]));
        let (a, b) = (n * low, n * high);
        let start = n.dot(xyz(&self.start[i]));
        [
            start + min(a.x, b.x) + min(a.y, b.y) + min(a.z, b.z),
            start + max(a.x, b.x) + max(a.y, b.y) + max(a.z, b.z),
        ]
    }
}

#[inline(always)]
fn contains(low: &Float4, high: &Float4, displacement: Vec3) -> bool {
    let displacement = displacement.to_array();
    (0..3).all(|k| displacement[k] >= low[k] && displacement[k] <= high[k])
}

/// As [`contains`], in fewer instructions; false for a displacement that lies just on the border.
#[inline(always)]
fn surely_contains(low: &Float4, high: &Float4, displacement: Wide4) -> bool {
    let slack = (displacement - Wide4::load(low)).min(Wide4::load(high) - displacement);
    slack.positive_mask() & XYZ_MASK == XYZ_MASK
}

/// Grows a box to contain a cube around `center` with half the size `half` [m].
#[inline(always)]
fn widen(low: &mut Float4, high: &mut Float4, center: Vec3, half: f32) {
    for (k, center) in center.to_array().into_iter().enumerate() {
        low[k] = min(low[k], center - half);
        high[k] = max(high[k], center + half);
    }
}
