//! Four numbers side by side, as particles have them: in one vector where there are any.

use crate::math::simd::{Baseline, Float, Simd};
use core::array;
use core::ops::{Add, Mul, Sub};
use glam::Vec3;

/// x, y, z of a particle and a fourth number, often its inverse mass.
pub(crate) type Float4 = [f32; 4];

/// The first three numbers as a vector.
#[inline(always)]
pub(crate) fn xyz(v: &Float4) -> Vec3 {
    Vec3::new(v[0], v[1], v[2])
}

/// How many vectors that takes.
const COUNT: usize = 4 / Baseline::LANES;

/// Bits of `positives` for x, y and z.
pub(crate) const WAYS: u32 = 0b111;

/// Four numbers.
#[derive(Clone, Copy)]
pub(crate) struct Four([<Baseline as Simd>::F; COUNT]);

impl Four {
    #[inline(always)]
    pub fn of(spot: &Float4) -> Self {
        Self(array::from_fn(|k| Baseline::new().load(spot, k * Baseline::LANES)))
    }

    /// A vector, and 0.
    #[inline(always)]
    pub fn way(v: Vec3) -> Self {
        Self::of(&[v.x, v.y, v.z, 0.0])
    }

    #[inline(always)]
    pub fn all(value: f32) -> Self {
        Self([Baseline::new().splat(value); COUNT])
    }

    #[inline(always)]
    pub fn spot(self) -> Float4 {
        let mut spot = [0.0; 4];
        self.put(&mut spot);
        spot
    }

    #[inline(always)]
    pub fn put(self, spot: &mut Float4) {
        for (k, part) in self.0.into_iter().enumerate() {
            Baseline::new().store(spot, k * Baseline::LANES, part);
        }
    }

    /// Without the last.
    #[inline(always)]
    pub fn ways(self) -> Self {
        let are_ways = Self::of(&[1.0, 1.0, 1.0, 0.0]);
        Self(array::from_fn(|k| Baseline::new().select_or_zero(are_ways.0[k], self.0[k])))
    }

    /// Without the last, as a vector.
    #[inline(always)]
    pub fn vector(self) -> Vec3 {
        xyz(&self.spot())
    }

    /// The sum of the first three products, in order.
    #[inline(always)]
    pub fn dot(self, other: Self) -> f32 {
        let [x, y, z, _] = (self * other).spot();
        x + y + z
    }

    #[inline(always)]
    pub fn times(self, value: f32) -> Self {
        self * Self::all(value)
    }

    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self(array::from_fn(|k| Float::min(self.0[k], other.0[k])))
    }

    /// Which are above 0: a bit for each.
    #[inline(always)]
    pub fn positives(self) -> u32 {
        let bits = |(k, part)| Baseline::new().positive_mask(part) << (k * Baseline::LANES);
        self.0.into_iter().enumerate().map(bits).fold(0, |all, bits| all | bits)
    }
}

impl Add for Four {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Four {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl Mul for Four {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(array::from_fn(|k| self.0[k] * other.0[k]))
    }
}
