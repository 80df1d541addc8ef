//! A four-number vector (x, y, z, w) held in SIMD registers.
//!
//! One particle of the interleaved layout is one [`Float4`]: its position and its inverse mass.
//! [`Wide4`] loads it into one register of four lanes where the target has such registers, else
//! into four scalars:
//!
//! ```text
//! Baseline::LANES = 4 (SSE2, NEON, simd128)  [ x y z w ]          one vector
//! Baseline::LANES = 1 (scalar)               [x] [y] [z] [w]      four vectors of one lane
//! ```
//! Reads and writes `Float4` values only.
//!
//! Invariant: every operation works on each number alone, and [`Wide4::dot3`] adds in a fixed
//! order, so the result has the same bits for both widths.

use crate::math::simd::{Baseline, Float, Simd};
use core::array;
use core::ops::{Add, Mul, Sub};
use glam::Vec3;

/// x, y and z of a particle, and a fourth number: often its inverse mass.
pub(crate) type Float4 = [f32; 4];

/// The first three numbers as a vector.
#[inline(always)]
pub(crate) fn xyz(v: &Float4) -> Vec3 {
    Vec3::new(v[0], v[1], v[2])
}

/// Vectors of the base width that hold four numbers.
const VECTORS: usize = 4 / Baseline::LANES;

/// The bits of [`Wide4::positive_mask`] that stand for x, y and z.
pub(crate) const XYZ_MASK: u32 = 0b111;

/// Four numbers in registers of the base width.
#[derive(Clone, Copy)]
pub(crate) struct Wide4([<Baseline as Simd>::F; VECTORS]);

impl Wide4 {
    #[inline(always)]
    pub fn load(v: &Float4) -> Self {
        Self(array::from_fn(|k| Baseline::new().load(v, k * Baseline::LANES)))
    }

    /// (x, y, z, 0).
    #[inline(always)]
    pub fn from_vec3(v: Vec3) -> Self {
        Self::load(&[v.x, v.y, v.z, 0.0])
    }

    #[inline(always)]
    pub fn splat(value: f32) -> Self {
        Self([Baseline::new().splat(value); VECTORS])
    }

    #[inline(always)]
    pub fn to_array(self) -> Float4 {
        let mut v = [0.0; 4];
        self.store(&mut v);
        v
    }

    #[inline(always)]
    pub fn store(self, v: &mut Float4) {
        for (k, part) in self.0.into_iter().enumerate() {
            Baseline::new().store(v, k * Baseline::LANES, part);
        }
    }

    /// Sets the fourth number to 0.
    #[inline(always)]
    pub fn xyz0(self) -> Self {
        let is_axis = Self::load(&[1.0, 1.0, 1.0, 0.0]);
        Self(array::from_fn(|k| Baseline::new().select_or_zero(is_axis.0[k], self.0[k])))
    }

    /// The first three numbers as a vector.
    #[inline(always)]
    pub fn xyz(self) -> Vec3 {
        xyz(&self.to_array())
    }

    /// The dot product of the first three numbers, added in the order x, y, z.
    #[inline(always)]
    pub fn dot3(self, other: Self) -> f32 {
        let [x, y, z, _] = (self * other).to_array();
        x + y + z
    }

    #[inline(always)]
    pub fn scale(self, factor: f32) -> Self {
        self * Self::splat(factor)
    }

    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self(array::from_fn(|k| Float::min(self.0[k], other.0[k])))
    }

    /// A bit for each number, the lowest for x: set if the number is above 0.
    #[inline(always)]
    pub fn positive_mask(self) -> u32 {
        let bits = |(k, part)| Baseline::new().positive_mask(part) << (k * Baseline::LANES);
        self.0.into_iter().enumerate().map(bits).fold(0, |all, bits| all | bits)
    }
}

impl Add for Wide4 {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Wide4 {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl Mul for Wide4 {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(array::from_fn(|k| self.0[k] * other.0[k]))
    }
}
