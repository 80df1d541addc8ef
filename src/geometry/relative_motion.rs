//! Bounds of the motion of points relative to parts of a moving surface, for searches of pairs.
//!
//! ```text
//! distance(t) ≥ distance(now) − |motion of the point − motion of the part| until t
//! ```
//! So a point that moves along with a surface has few parts of it in reach, however fast both are.
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
    /// The displacement from now to the end of the tick, as its velocity predicts it, and that from
    /// the start of the substep to now [m].
    pub displacements: [Vec3; 2],
    /// The duration of each, in ticks.
    pub shares: [f32; 2],
}

impl PointMotion {
    /// No motion.
    pub const NONE: Self = Self { displacements: [Vec3::ZERO; 2], shares: [0.0; 2] };

    /// Returns how far the point moves relative to a part, at most [m].
    #[inline(never)]
    pub fn reach(&self, part: &PartMotion) -> f32 {
        let reach = |k: usize| {
            (self.displacements[k] - part.mean * self.shares[k]).length()
                + part.spread * self.shares[k]
        };
        max(reach(0), reach(1))
    }
}

impl PointMotion {
    /// Returns the path of a part relative to the point from now to the end of the tick (0) or back to
    /// the start of the substep (1), and how far its corners may be off that [m].
    #[inline(always)]
    pub fn relative_path(&self, direction: usize, part: Option<&PartMotion>) -> (Vec3, f32) {
        let (own, share) = (self.displacements[direction], self.shares[direction]);
        let PartMotion { mean, spread } = part.copied().unwrap_or_default();
        let path = mean * share - own;
        (if direction == 0 { path } else { -path }, spread * share)
    }
}

/// The rigid motion of a feature in a substep: of a point of it and of the directions around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RigidStep {
    /// The point at the start and at the end [m].
    origins: [Vec3; 2],
    /// Three directions at the start and at the end, each perpendicular to the others and of length
    /// one; `None` if it does not turn.
    axes: Option<[[Vec3; 3]; 2]>,
}

impl RigidStep {
    /// No motion.
    pub const NONE: Self = Self { origins: [Vec3::ZERO; 2], axes: None };

    /// Returns the motion of a point with two directions perpendicular to each other, `before` at the
    /// start and `after` at the end. It does not turn where one of them is zero.
    pub fn new(origins: [Vec3; 2], before: [Vec3; 2], after: [Vec3; 2]) -> Self {
        let is_frame = |[u, v]: [Vec3; 2]| u != Vec3::ZERO && v != Vec3::ZERO;
        let frame = |[u, v]: [Vec3; 2]| is_frame([u, v]).then(|| [u, v, u.cross(v)]);
        let axes = if before == after { None } else { frame(before).zip(frame(after)) };
        Self { origins, axes: axes.map(|(before, after)| [before, after]) }
    }

    /// Returns an upper bound of the way of points that start up to `distance` from where the moving point
    /// ends [m].
    #[inline(always)]
    pub fn longest_way(&self, distance: impl FnOnce() -> f32) -> f32 {
        let [from, to] = self.origins;
        let shift = from.distance(to);
        let turned = self.axes.map_or(0.0, |[before, after]| {
            let turn2: f32 = (0..3).map(|k| (after[k] - before[k]).length_squared()).sum();
            turn2.sqrt() * (distance() + shift)
        });
        shift + turned
    }

    /// Returns where the motion takes a point [m].
    #[inline(never)]
    pub fn carry(&self, x: Vec3) -> Vec3 {
        let [from, to] = self.origins;
        match &self.axes {
            None if from == to => x,
            None => x + (to - from),
            Some([before, after]) => {
                let x = x - from;
                to + after[0] * x.dot(before[0])
                    + after[1] * x.dot(before[1])
                    + after[2] * x.dot(before[2])
            }
        }
    }
}
