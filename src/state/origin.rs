//! The origin of a cloth: the point that its positions are relative to.
//!
//! ```text
//! absolute position = origin + relative position      origin: whole metres on each axis
//! ```
//! An f32 resolves 0.03 µm near zero, 8 µm at 100 m and 0.5 mm at 5 km. The solver works with
//! relative positions, so it has the resolution of zero everywhere. This is the floating origin of
//! engines with large worlds (Thorne, "Using a Floating Origin", Cyberworlds 2005), per cloth.
//!
//! Invariant: the origin is zero until most of the cloth is farther than [`MAX_DISTANCE`] from
//! zero, so that it changes no bits of a cloth near zero.

use crate::math::sort::sort_by;
use crate::math::{max, min};
use glam::Vec3;

/// Largest distance of the cloth from its origin along an axis [m].
const MAX_DISTANCE: f32 = 16.0;

/// That of a slow cloth whose origin is not zero [m].
const MAX_SLOW_DISTANCE: f32 = 2.0;

/// A cloth is slow if it takes longer than this from its origin to that distance [s].
const SLOW_TIME: f32 = 1.0;

/// Largest coordinate of an origin [m]. An f32 holds all whole metres up to here.
const MAX_COORDINATE: f32 = 8_388_608.0;

/// Largest number of particles that stand for the whole cloth.
const MAX_SAMPLES: usize = 63;

/// Returns whether `origin` can be the origin of a cloth; for saved data.
pub(crate) fn is_valid_origin(origin: Vec3) -> bool {
    let is_valid = |x: f32| x.abs() <= MAX_COORDINATE && x == x.floor();
    origin.to_array().into_iter().all(is_valid)
}

/// A few particles that stand for all of a cloth.
pub(crate) struct Samples {
    values: [[f32; MAX_SAMPLES]; 3],
    count: usize,
}

impl Samples {
    /// Takes at most [`MAX_SAMPLES`] of `count` vectors.
    pub fn of(count: usize, vector: &dyn Fn(usize) -> Vec3) -> Self {
        let mut samples = Self { values: [[0.0; MAX_SAMPLES]; 3], count: 0 };
        for i in (0..count).step_by(count.div_ceil(MAX_SAMPLES)) {
            for (values, x) in samples.values.iter_mut().zip(vector(i).to_array()) {
                values[samples.count] = x;
            }
            samples.count += 1;
        }
        samples
    }

    /// The median along each axis: a piece that came off and falls does not change it much.
    pub fn median(&self) -> Vec3 {
        let median = |values: &[f32; MAX_SAMPLES]| {
            let mut sorted = *values;
            sort_by(&mut sorted[..self.count], f32::total_cmp);
            sorted[self.count / 2]
        };
        Vec3::from_array(self.values.each_ref().map(median))
    }

    /// The largest coordinate of all.
    fn farthest(&self) -> f32 {
        self.values.as_flattened().iter().fold(0.0, |farthest, x| max(farthest, x.abs()))
    }
}

/// Returns by how much the origin of a cloth moves, in whole metres; zero if most of the cloth is
/// near. `positions` are relative to it; `speed` returns the speed of the cloth [m/s].
///
/// `#[inline(never)]`: this and `dyn` keep the code small.
#[inline(never)]
pub(crate) fn shift_to_cloth(origin: Vec3, positions: &Samples, speed: &dyn Fn() -> f32) -> Vec3 {
    let least = if origin == Vec3::ZERO { MAX_DISTANCE } else { MAX_SLOW_DISTANCE };
    if positions.farthest() <= least {
        return Vec3::ZERO;
    }
    let center = positions.median();
    let largest = min(max(speed() * SLOW_TIME, least), MAX_DISTANCE);
    if is_near(center, largest) { Vec3::ZERO } else { whole_metres(origin, center) }
}

/// Returns by how much the origin moves with a cloth whose centre moves at once between two
/// positions relative to it, in whole metres; zero if it is near afterwards.
pub(crate) fn shift_with_cloth(origin: Vec3, [from, to]: [Vec3; 2]) -> Vec3 {
    let largest = if origin == Vec3::ZERO { MAX_DISTANCE } else { MAX_SLOW_DISTANCE };
    if is_near(to, largest) { Vec3::ZERO } else { whole_metres(origin, to - from) }
}

/// Returns `position` in whole metres; zero if it is near zero.
pub(crate) fn center_near(position: Vec3) -> Vec3 {
    let is_near = is_near(position, MAX_SLOW_DISTANCE);
    if is_near { Vec3::ZERO } else { whole_metres(Vec3::ZERO, position) }
}

fn is_near(position: Vec3, distance: f32) -> bool {
    position.to_array().into_iter().all(|x| x.abs() <= distance)
}

/// Rounds a shift of `origin` to whole metres. The shift is zero along an axis on which the origin
/// would leave its range.
pub(crate) fn whole_metres(origin: Vec3, shift: Vec3) -> Vec3 {
    let rounded = |origin: f32, shift: f32| {
        let whole = (shift + 0.5).floor();
        if (origin + whole).abs() <= MAX_COORDINATE { whole } else { 0.0 }
    };
    let [from, by] = [origin.to_array(), shift.to_array()];
    Vec3::from_array([0, 1, 2].map(|axis| rounded(from[axis], by[axis])))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shift(origin: Vec3, x: f32, speed: f32) -> Vec3 {
        let positions =
            Samples::of(1000, &|i| Vec3::new(x, if i < 400 { -1.0e3 } else { 0.2 }, 0.0));
        shift_to_cloth(origin, &positions, &|| speed)
    }

    #[test]
    fn the_origin_stays_zero_until_most_of_the_cloth_is_16_m_away() {
        assert_eq!(shift(Vec3::ZERO, 16.0, 0.0), Vec3::ZERO);
        assert_eq!(shift(Vec3::ZERO, 100.4, 0.0), Vec3::X * 100.0);
    }

    #[test]
    fn other_origins_move_early_if_the_cloth_is_slow() {
        assert_eq!(shift(Vec3::Y, 2.6, 1.0), Vec3::X * 3.0);
        assert_eq!(shift(Vec3::Y, 2.6, 5.0), Vec3::ZERO);
        assert_eq!(shift(Vec3::Y, 16.2, 500.0), Vec3::X * 16.0);
    }

    #[test]
    fn the_origin_stays_in_the_range_of_whole_metres() {
        let origin = Vec3::X * MAX_COORDINATE;
        assert_eq!(shift(origin, 100.0, 0.0), Vec3::ZERO);
        assert!(is_valid_origin(origin) && !is_valid_origin(origin * 2.0));
        assert!(!is_valid_origin(Vec3::splat(0.5)) && !is_valid_origin(Vec3::NAN));
    }
}
