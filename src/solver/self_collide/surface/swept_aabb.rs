//! Swept AABBs: a box around start positions and a box around displacements.
//!
//! ```text
//!   ┌────┐ displacement    Separation per axis, for A below B:
//!   │ A  │────►  ┌────┐
//!   └────┘       │ B  │──►     B.low − A.high − max(0, A.displacement_high − B.displacement_low)
//!                └────┘
//! ```
//! Both boxes move over the same time, so the test uses the relative displacement: layers that
//! travel together do not overlap, however fast they are (conservative test; see Ericson,
//! "Real-Time Collision Detection", 5.5.8, "Intersecting Moving AABB Against AABB").
//!
//! Reads start positions and motion bounds of particles; writes the boxes and bit masks of
//! overlaps.
//!
//! Invariant: two boxes that are reported as separated by `gap` contain no pair of points that
//! comes nearer than `gap`, as long as each point stays within its displacement box. A box with NaN
//! overlaps every box.

use crate::math::simd::{Baseline, Float, Simd};
use crate::math::wide4::Float4;
use crate::math::{max, min};

/// Boxes in a [`SweptAabbBlock`].
pub(crate) const LANES: usize = 8;

/// A box around start positions, and a box around the displacements from there [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct SweptAabb {
    pub low: Float4,
    pub high: Float4,
    pub displacement_low: Float4,
    pub displacement_high: Float4,
}

impl SweptAabb {
    /// Contains no point.
    pub const EMPTY: Self = Self {
        low: [f32::INFINITY; 4],
        high: [f32::NEG_INFINITY; 4],
        displacement_low: [f32::INFINITY; 4],
        displacement_high: [f32::NEG_INFINITY; 4],
    };

    /// Grows to contain another swept AABB.
    #[inline(always)]
    pub fn merge(&mut self, other: &Self) {
        for k in 0..4 {
            self.low[k] = min(self.low[k], other.low[k]);
            self.high[k] = max(self.high[k], other.high[k]);
            self.displacement_low[k] = min(self.displacement_low[k], other.displacement_low[k]);
            self.displacement_high[k] = max(self.displacement_high[k], other.displacement_high[k]);
        }
    }

    /// The swept AABB of some particles, from lists of start positions and motion bounds (low,
    /// high).
    #[inline(always)]
    pub fn of_particles(particles: &[u32], [start, bound_low, bound_high]: [&[Float4]; 3]) -> Self {
        let (simd, mut all) = (Baseline::new(), Self::EMPTY);
        for k in (0..4).step_by(Baseline::LANES) {
            let [plus, minus] = [f32::INFINITY, f32::NEG_INFINITY].map(|end| simd.splat(end));
            let ([mut low, mut first], [mut high, mut last]) = ([plus; 2], [minus; 2]);
            for particle in particles {
                let load = |list: &[Float4]| simd.load(&list[*particle as usize], k);
                let x = load(start);
                (low, high) = (Float::min(low, x), Float::max(high, x));
                first = Float::min(first, load(bound_low));
                last = Float::max(last, load(bound_high));
            }
            simd.store(&mut all.low, k, low);
            simd.store(&mut all.high, k, high);
            simd.store(&mut all.displacement_low, k, first);
            simd.store(&mut all.displacement_high, k, last);
        }
        all
    }

    /// Whether a point of one may come nearer than `gap` [m] to a point of the other. True for NaN.
    #[inline(always)]
    pub fn overlaps(&self, other: &Self, gap: f32) -> bool {
        let (simd, a, b) = (Baseline::new(), self, other);
        let (zero, gap) = (simd.splat(0.0), simd.splat(gap));
        let mut separated = 0;
        for k in (0..4).step_by(Baseline::LANES) {
            let load = |v: &Float4| simd.load(v, k);
            let down = Float::min(load(&a.displacement_low) - load(&b.displacement_high), zero);
            let up = Float::max(load(&a.displacement_high) - load(&b.displacement_low), zero);
            let below = load(&a.low) + down - (load(&b.high) + gap);
            let above = load(&b.low) - gap - (load(&a.high) + up);
            separated |= (simd.positive_mask(below) | simd.positive_mask(above)) << k;
        }
        // The fourth number is an inverse mass, not a coordinate.
        separated & 0b111 == 0
    }

    /// The largest extent of the displacement box along an axis [m]: how far its points move
    /// relative to each other at most, per axis.
    pub fn displacement_extent(&self) -> f32 {
        let along = |k: usize| self.displacement_high[k] - self.displacement_low[k];
        max(along(0), max(along(1), along(2)))
    }

    /// An upper bound of the relative displacement of a point of one and a point of the other [m].
    #[inline(always)]
    pub fn max_relative_displacement(&self, other: &Self) -> f32 {
        let mut sum = 0.0;
        for k in 0..3 {
            let relative = max(
                self.displacement_high[k] - other.displacement_low[k],
                other.displacement_high[k] - self.displacement_low[k],
            );
            sum += relative * relative;
        }
        sum.sqrt()
    }
}

/// [`LANES`] swept AABBs in columns (SoA).
#[derive(Clone, Copy, Debug)]
pub(crate) struct SweptAabbBlock {
    low: [[f32; LANES]; 3],
    high: [[f32; LANES]; 3],
    displacement_low: [[f32; LANES]; 3],
    displacement_high: [[f32; LANES]; 3],
}

impl SweptAabbBlock {
    /// All lanes are empty.
    pub const EMPTY: Self = Self {
        low: [[f32::INFINITY; LANES]; 3],
        high: [[f32::NEG_INFINITY; LANES]; 3],
        displacement_low: [[0.0; LANES]; 3],
        displacement_high: [[0.0; LANES]; 3],
    };

    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, aabb: &SweptAabb) {
        for k in 0..3 {
            self.low[k][lane] = aabb.low[k];
            self.high[k][lane] = aabb.high[k];
            self.displacement_low[k][lane] = aabb.displacement_low[k];
            self.displacement_high[k][lane] = aabb.displacement_high[k];
        }
    }

    /// A bit for each lane: set if the lane may come nearer than `gap` [m] to `one`.
    #[inline(always)]
    pub fn overlap_mask(&self, one: &SweptAabb, gap: f32) -> u32 {
        let simd = Baseline::new();
        let zero = simd.splat(0.0);
        let mut bits = 0;
        for lane in (0..LANES).step_by(Baseline::LANES) {
            let mut separation = simd.splat(f32::NEG_INFINITY);
            for k in 0..3 {
                let back = simd.load(&self.displacement_high[k], lane)
                    - simd.splat(one.displacement_low[k]);
                let ahead = simd.splat(one.displacement_high[k])
                    - simd.load(&self.displacement_low[k], lane);
                let above = simd.splat(one.low[k] - gap) - simd.load(&self.high[k], lane);
                let below = simd.load(&self.low[k], lane) - simd.splat(one.high[k] + gap);
                let (above, below) =
                    (above - Float::max(back, zero), below - Float::max(ahead, zero));
                separation = Float::max(Float::max(above, below), separation);
            }
            if simd.any_positive(zero - separation) {
                let mut each = [0.0; LANES];
                simd.store(&mut each, 0, separation);
                for (i, separation) in each[..Baseline::LANES].iter().enumerate() {
                    bits |= u32::from(*separation < 0.0) << (lane + i);
                }
            }
        }
        bits
    }
}

/// A bit for each of the first `count` lanes of `blocks`: set if the lane may come nearer than
/// `gap` [m] to `one`.
#[inline(always)]
pub(crate) fn overlap_mask(
    blocks: &[SweptAabbBlock],
    count: u32,
    one: &SweptAabb,
    gap: f32,
) -> u32 {
    let mut bits = 0;
    for block in (0..count.div_ceil(LANES as u32)).rev() {
        bits = bits << LANES | blocks[block as usize].overlap_mask(one, gap);
    }
    // NaN overlaps the empty lanes as well.
    bits & ((1 << count) - 1)
}

/// The positions of the bits that are set, from the lowest on.
pub(crate) fn set_bits(mut bits: u32) -> impl Iterator<Item = u32> {
    core::iter::from_fn(move || {
        let position = bits.trailing_zeros();
        (bits != 0).then(|| {
            bits &= bits - 1;
            position
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit cube at `x` on each axis, displaced by `displacement` ± 0.1 on each axis.
    fn cube(x: f32, displacement: f32) -> SweptAabb {
        SweptAabb {
            low: [x; 4],
            high: [x + 1.0; 4],
            displacement_low: [displacement - 0.1; 4],
            displacement_high: [displacement + 0.1; 4],
        }
    }

    #[test]
    fn boxes_that_travel_together_do_not_overlap() {
        let (one, other) = (cube(0.0, 5.0), cube(2.0, 5.0));
        assert!(!one.overlaps(&other, 0.5) && one.overlaps(&other, 0.81));
        let slow = cube(2.0, 0.0);
        assert!(one.overlaps(&slow, 0.0) && slow.overlaps(&one, 0.0), "one runs into the other");
        let away = cube(2.0, 9.0);
        assert!(!one.overlaps(&away, 0.5), "one runs away from the other");
    }

    #[test]
    fn empty_lanes_overlap_nothing() {
        let mut block = SweptAabbBlock::EMPTY;
        block.set_lane(0, &cube(0.0, 1.0));
        for far in [f32::INFINITY, f32::NAN] {
            let one = SweptAabb {
                displacement_low: [-far; 4],
                displacement_high: [far; 4],
                ..cube(0.0, 0.0)
            };
            assert_eq!(overlap_mask(&[block], 1, &one, 0.1), 1, "{far}");
        }
    }

    #[test]
    fn a_block_gives_the_same_overlaps_as_single_boxes() {
        let mut block = SweptAabbBlock::EMPTY;
        let cubes: Vec<_> = (0..LANES - 1).map(|i| cube(0.7 * i as f32, 2.0 - i as f32)).collect();
        cubes.iter().enumerate().for_each(|(lane, cube)| block.set_lane(lane, cube));
        let one = cube(2.5, 0.5);
        for gap in [0.0, 0.3, 1.0] {
            let each = cubes.iter().enumerate();
            let bits = each.map(|(lane, cube)| u32::from(cube.overlaps(&one, gap)) << lane);
            assert_eq!(block.overlap_mask(&one, gap), bits.sum::<u32>(), "{gap}");
        }
    }
}
