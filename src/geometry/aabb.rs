//! Axis-aligned bounding boxes (AABB).
//!
//! Two boxes overlap if their intervals overlap on all three axes. Comparisons are written so that
//! NaN counts as overlapping: a broken number must not hide a contact.
//!
//! Reads and writes only its own fields.
//! Invariant: a box with `low > high` on an axis is empty; merging with it changes nothing.

use crate::math::{max, min};
use glam::Vec3;

/// All points from `low` to `high` [m], both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb {
    pub low: Vec3,
    pub high: Vec3,
}

impl Aabb {
    /// The box without points.
    pub const EMPTY: Self =
        Self { low: Vec3::splat(f32::INFINITY), high: Vec3::splat(f32::NEG_INFINITY) };

    /// The box of all points.
    pub const ALL: Self =
        Self { low: Vec3::splat(f32::NEG_INFINITY), high: Vec3::splat(f32::INFINITY) };

    /// Returns the smallest box that contains all `points`.
    pub fn from_points(points: impl IntoIterator<Item = Vec3>) -> Self {
        let mut bounds = Self::EMPTY;
        points.into_iter().for_each(|x| bounds.include(x));
        bounds
    }

    /// Grows the box until it contains `x`.
    #[inline(always)]
    pub fn include(&mut self, x: Vec3) {
        self.low = Vec3::new(min(x.x, self.low.x), min(x.y, self.low.y), min(x.z, self.low.z));
        self.high = Vec3::new(max(x.x, self.high.x), max(x.y, self.high.y), max(x.z, self.high.z));
    }

    /// Grows the box until it contains `other`.
    pub fn merge(&mut self, other: &Self) {
        self.include(other.low);
        self.include(other.high);
    }

    /// Returns the box with every side moved outward by `margin` [m]; inward if it is negative.
    pub fn expanded(&self, margin: f32) -> Self {
        Self { low: self.low - Vec3::splat(margin), high: self.high + Vec3::splat(margin) }
    }

    /// Returns whether the boxes have a common point; true if a coordinate is NaN.
    #[inline(always)]
    pub fn overlaps(&self, other: &Self) -> bool {
        let (a, b) = (self, other);
        !(a.low.x > b.high.x
            || a.low.y > b.high.y
            || a.low.z > b.high.z
            || b.low.x > a.high.x
            || b.low.y > a.high.y
            || b.low.z > a.high.z)
    }

    /// Returns whether the whole of `other` lies in this box.
    pub fn contains(&self, other: &Self) -> bool {
        other.low.cmpge(self.low).all() && other.high.cmple(self.high).all()
    }

    /// Returns the square of the distance from `point` to the box [m²]; 0 inside.
    pub fn distance_squared(&self, point: Vec3) -> f32 {
        let outside = |low: f32, x: f32, high: f32| max(0.0, max(low - x, x - high));
        let (low, high) = (self.low, self.high);
        let x = outside(low.x, point.x, high.x);
        let y = outside(low.y, point.y, high.y);
        let z = outside(low.z, point.z, high.z);
        x * x + y * y + z * z
    }

    /// The center [m].
    pub fn center(&self) -> Vec3 {
        (self.low + self.high) * 0.5
    }

    /// Half of the size on each axis [m].
    pub fn half_extents(&self) -> Vec3 {
        (self.high - self.low) * 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn touching_boxes_overlap_and_a_box_contains_what_lies_inside() {
        let one = Aabb::from_points([Vec3::ZERO, Vec3::ONE]);
        let beside = Aabb::from_points([Vec3::new(1.0, 0.5, 0.5), Vec3::splat(2.0)]);
        assert!(one.overlaps(&beside) && beside.overlaps(&one));
        assert!(!one.overlaps(&beside.expanded(-0.1)) && !one.overlaps(&Aabb::EMPTY));
        assert!(one.expanded(1.0).contains(&beside) && !one.contains(&beside));
        assert!(Aabb::ALL.overlaps(&one) && Aabb::ALL.contains(&one));
        let (center, half) = (beside.center(), one.half_extents());
        assert_eq!((center, half), (Vec3::new(1.5, 1.25, 1.25), Vec3::splat(0.5)));
    }
}
