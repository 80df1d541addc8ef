//! Boxes along the axes: what can be told apart cheaply.

use crate::math::{max, min};
use glam::Vec3;

/// All points from `low` to `high`; none if they are the wrong way round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb {
    pub low: Vec3,
    pub high: Vec3,
}

impl Aabb {
    /// No point at all.
    pub const EMPTY: Self =
        Self { low: Vec3::splat(f32::INFINITY), high: Vec3::splat(f32::NEG_INFINITY) };

    /// Every point.
    pub const ALL: Self =
        Self { low: Vec3::splat(f32::NEG_INFINITY), high: Vec3::splat(f32::INFINITY) };

    /// The least that holds all points.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        let mut bounds = Self::EMPTY;
        points.into_iter().for_each(|x| bounds.add(x));
        bounds
    }

    /// Grows to hold a point.
    #[inline(always)]
    pub fn add(&mut self, x: Vec3) {
        self.low = Vec3::new(min(x.x, self.low.x), min(x.y, self.low.y), min(x.z, self.low.z));
        self.high = Vec3::new(max(x.x, self.high.x), max(x.y, self.high.y), max(x.z, self.high.z));
    }

    /// Grows to hold another box.
    pub fn join(&mut self, other: &Self) {
        self.add(other.low);
        self.add(other.high);
    }

    /// Larger by `by` on every side.
    pub fn grown(&self, by: f32) -> Self {
        Self { low: self.low - Vec3::splat(by), high: self.high + Vec3::splat(by) }
    }

    /// Whether some point may be in both. What is not a number is everywhere.
    #[inline(always)]
    pub fn meets(&self, other: &Self) -> bool {
        let (a, b) = (self, other);
        !(a.low.x > b.high.x
            || a.low.y > b.high.y
            || a.low.z > b.high.z
            || b.low.x > a.high.x
            || b.low.y > a.high.y
            || b.low.z > a.high.z)
    }

    /// Whether all of another box is in this one.
    pub fn holds(&self, other: &Self) -> bool {
        other.low.cmpge(self.low).all() && other.high.cmple(self.high).all()
    }

    /// The middle.
    pub fn center(&self) -> Vec3 {
        (self.low + self.high) * 0.5
    }

    /// From the middle to the sides.
    pub fn half(&self) -> Vec3 {
        (self.high - self.low) * 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_meet_where_they_touch_and_hold_what_is_inside() {
        let one = Aabb::around([Vec3::ZERO, Vec3::ONE]);
        let beside = Aabb::around([Vec3::new(1.0, 0.5, 0.5), Vec3::splat(2.0)]);
        assert!(one.meets(&beside) && beside.meets(&one));
        assert!(!one.meets(&beside.grown(-0.1)) && !one.meets(&Aabb::EMPTY));
        assert!(one.grown(1.0).holds(&beside) && !one.holds(&beside));
        assert!(Aabb::ALL.meets(&one) && Aabb::ALL.holds(&one));
        assert_eq!((beside.center(), one.half()), (Vec3::new(1.5, 1.25, 1.25), Vec3::splat(0.5)));
    }
}
