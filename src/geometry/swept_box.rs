//! Boxes that move along straight lines: a swept AABB for each of two moving parts, compared at the
//! same times.
//!
//! ```text
//! start of the substep ── now ── end of the tick        each side of a box moves evenly in between
//! ```
//! A part that moves evenly stays within the linear interpolation of its boxes. So two parts do not
//! meet if one axis separates their boxes, in the same order, at all three times. A part that moves
//! along with a surface is compared with it at the same times, not with the whole space that the
//! surface passes through.
//!
//! Reads and writes only its own fields.
//! Invariant: parts that meet at any time are never reported apart; NaN counts as meeting.

use crate::geometry::aabb::Aabb;
use crate::math::wide4::{Float4, Wide4, XYZ_MASK};
use glam::Vec3;

/// The box of a part at three times [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct SweptBox {
    low: [Float4; 3],
    /// The highest point, with its sign changed: so both ends are minima.
    minus_high: [Float4; 3],
}

impl SweptBox {
    /// The box without points.
    pub const EMPTY: Self =
        Self { low: [[f32::INFINITY; 4]; 3], minus_high: [[f32::INFINITY; 4]; 3] };

    /// Makes the box of a part that is in `now`, moved by `back` since the substep began, and moves by
    /// `forward` until the tick ends [m]. `spread` is the largest distance of a corner from these mean
    /// motions, forward and back [m].
    #[inline(never)]
    pub fn new(now: Aabb, [forward, back]: [Vec3; 2], spread: [f32; 2]) -> Self {
        let ways = [(-back, spread[1]), (Vec3::ZERO, 0.0), (forward, spread[0])];
        let ends = |end: Vec3, sign: f32| {
            ways.map(|(way, spread)| {
                let [x, y, z] = (end + way * sign - Vec3::splat(spread)).to_array();
                [x, y, z, 0.0]
            })
        };
        Self { low: ends(now.low, 1.0), minus_high: ends(-now.high, -1.0) }
    }

    /// Grows the box until it contains `other`.
    #[inline(never)]
    pub fn merge(&mut self, other: &Self) {
        let ends = self.low.iter_mut().chain(&mut self.minus_high);
        for (own, other) in ends.zip(other.low.iter().chain(&other.minus_high)) {
            Wide4::load(own).min(Wide4::load(other)).store(own);
        }
    }

    /// Returns whether the parts may come together at any time.
    #[inline(never)]
    pub fn may_meet(&self, other: &Self) -> bool {
        let (mut above, mut below) = (XYZ_MASK, XYZ_MASK);
        for time in 0..3 {
            let ends = [&self.low, &self.minus_high, &other.low, &other.minus_high];
            let [low, minus_high, other_low, other_minus_high] =
                ends.map(|end| Wide4::load(&end[time]));
            above &= (low + other_minus_high).positive_mask();
            below &= (other_low + minus_high).positive_mask();
        }
        above | below == 0
    }
}

/// The boxes of a part at the start and at the end of a tick, in which each of its points moves evenly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovingBox {
    low: [Float4; 2],
    minus_high: [Float4; 2],
}

impl MovingBox {
    /// The box without points.
    pub const EMPTY: Self =
        Self { low: [[f32::INFINITY; 4]; 2], minus_high: [[f32::INFINITY; 4]; 2] };

    pub fn new(boxes: [Aabb; 2]) -> Self {
        let point = |v: Vec3| Wide4::from_vec3(v).to_array();
        Self { low: boxes.map(|one| point(one.low)), minus_high: boxes.map(|one| point(-one.high)) }
    }

    /// Grows the box until it contains `other`.
    #[inline(never)]
    pub fn merge(&mut self, other: &Self) {
        let ends = self.low.iter_mut().chain(&mut self.minus_high);
        for (own, other) in ends.zip(other.low.iter().chain(&other.minus_high)) {
            Wide4::load(own).min(Wide4::load(other)).store(own);
        }
    }

    /// The box around both.
    pub fn bounds(&self) -> Aabb {
        let least = |[a, b]: &[Float4; 2]| Wide4::load(a).min(Wide4::load(b)).xyz();
        Aabb { low: least(&self.low), high: -least(&self.minus_high) }
    }

    /// Returns whether the part may come together with another one, whose box is given at these times
    /// of the tick.
    #[inline(never)]
    pub fn may_meet(&self, other: &SweptBox, times: [f32; 3]) -> bool {
        let (mut above, mut below) = (XYZ_MASK, XYZ_MASK);
        for (time, at) in times.into_iter().enumerate() {
            let end = |[from, to]: &[Float4; 2]| {
                let from = Wide4::load(from);
                from + (Wide4::load(to) - from).scale(at)
            };
            let (low, minus_high) = (end(&self.low), end(&self.minus_high));
            above &= (low + Wide4::load(&other.minus_high[time])).positive_mask();
            below &= (minus_high + Wide4::load(&other.low[time])).positive_mask();
        }
        above | below == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moving(center: Vec3, forward: Vec3) -> SweptBox {
        SweptBox::new(Aabb::from_points([center]).expanded(0.1), [forward, Vec3::ZERO], [0.0; 2])
    }

    #[test]
    fn boxes_meet_if_they_overlap_at_the_same_time() {
        let rising = moving(Vec3::ZERO, Vec3::Y);
        assert!(rising.may_meet(&moving(Vec3::Y * 0.5, Vec3::ZERO)));
        assert!(rising.may_meet(&moving(Vec3::Y, -Vec3::Y)));
        // It rises just as fast in front of the other one.
        assert!(!rising.may_meet(&moving(Vec3::Y * 0.5, Vec3::Y)));
        assert!(!rising.may_meet(&SweptBox::EMPTY));
    }

    #[test]
    fn a_group_meets_what_one_of_its_boxes_meets() {
        let mut group = SweptBox::EMPTY;
        for x in [0.0, 1.0] {
            group.merge(&moving(Vec3::X * x, Vec3::Y));
        }
        assert!(group.may_meet(&moving(Vec3::X, Vec3::ZERO)));
        assert!(!group.may_meet(&moving(Vec3::X * 2.0, Vec3::ZERO)));
        assert!(!group.may_meet(&moving(Vec3::Y * -0.5, Vec3::ZERO)));
    }

    #[test]
    fn a_moving_box_is_compared_where_it_is() {
        let at = |y: f32| Aabb::from_points([Vec3::Y * y]).expanded(0.1);
        let rising = MovingBox::new([at(0.0), at(1.0)]);
        let rests = |y: f32| moving(Vec3::Y * y, Vec3::ZERO);
        assert!(rising.bounds().contains(&at(0.0)) && rising.bounds().contains(&at(1.0)));
        assert!(rising.may_meet(&rests(0.5), [0.0, 0.25, 1.0]));
        assert!(!rising.may_meet(&rests(0.5), [0.0, 0.1, 0.2]));
        assert!(!rising.may_meet(&moving(Vec3::Y * 0.5, Vec3::Y), [0.0, 0.0, 1.0]));
    }

    #[test]
    fn nan_counts_as_meeting() {
        let nan = Aabb { low: Vec3::NAN, high: Vec3::NAN };
        let broken = SweptBox::new(nan, [Vec3::ZERO; 2], [0.0; 2]);
        assert!(broken.may_meet(&moving(Vec3::X * 9.0, Vec3::ZERO)));
    }
}
