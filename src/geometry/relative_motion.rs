//! Bounds of the motion of points relative to parts of a moving surface, for searches of pairs.
//!
//! ```text
//! distance(t) ≥ distance(now) − |motion of the point − motion of the part| until t
//! ```
//! So what moves along with a surface has few parts of it in reach, however fast both are.
//!
//! Reads motions over a tick; writes nothing.

use crate::math::max;
use glam::Vec3;

/// The motion of a triangle, an edge or a vertex in the whole tick.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PartMotion {
    /// The mean of its corners [m].
    pub mean: Vec3,
    /// The largest distance of a corner's motion from the mean [m].
    pub spread: f32,
}

impl PartMotion {
    /// Returns the motion of a part with corners that move like this [m].
    pub fn new<const COUNT: usize>(motions: [Vec3; COUNT]) -> Self {
        let sum = motions.iter().fold(Vec3::ZERO, |sum, motion| sum + *motion);
        let mean = sum * (1.0 / COUNT as f32);
        let spread = |motion: &Vec3| (*motion - mean).length_squared();
        Self { mean, spread: motions.iter().map(spread).fold(0.0, max).sqrt() }
    }

    /// Returns the length of the longest way of a corner [m], or more.
    pub fn longest(&self) -> f32 {
        self.mean.length() + self.spread
    }
}

/// The motion of a point in a tick, as a search for pairs knows it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PointMotion {
    /// From now to the end of the tick, as expected, and from the start of the substep to now [m].
    pub ways: [Vec3; 2],
    /// The shares of the tick that these take.
    pub shares: [f32; 2],
}

impl PointMotion {
    /// Returns how far the point moves relative to a part, at most [m].
    #[inline(always)]
    pub fn reach(&self, part: &PartMotion) -> f32 {
        let reach = |k: usize| {
            (self.ways[k] - part.mean * self.shares[k]).length() + part.spread * self.shares[k]
        };
        max(reach(0), reach(1))
    }
}
