//! The instruction set of aarch64: NEON with 4 lanes.
//!
//! Each operation is one or two intrinsics; `max` and `min` are a comparison and a select, because
//! `vmaxq_f32` treats NaN differently from [`Float::max`].
//!
//! Reads and writes only through `load_from`, `store_to`, and the points of [`GatherPairs`].
//! Invariant: every aarch64 target of Rust has NEON, so the token can be made anywhere.

use super::lanes::{Float, GatherPairs, Simd};
use crate::math::shared_points::SharedPoints;
use core::arch::aarch64::*;
use core::ops::{Add, Div, Mul, Sub};

/// NEON, four lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neon;

impl Neon {
    #[inline(always)]
    pub fn new() -> Self {
        Self
    }
}

/// One `f32` per lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct F32x4(float32x4_t);

// SAFETY of all functions below: every aarch64 target of Rust has NEON.

impl Add for F32x4 {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vaddq_f32(self.0, other.0) })
    }
}

impl Sub for F32x4 {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vsubq_f32(self.0, other.0) })
    }
}

impl Mul for F32x4 {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vmulq_f32(self.0, other.0) })
    }
}

impl Div for F32x4 {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vdivq_f32(self.0, other.0) })
    }
}

impl Float for F32x4 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vsqrtq_f32(self.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vbslq_f32(vcgtq_f32(self.0, other.0), self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vbslq_f32(vcltq_f32(self.0, other.0), self.0, other.0) })
    }
}

impl Simd for Neon {
    type F = F32x4;

    const LANES: usize = 4;

    #[inline(always)]
    fn splat(self, value: f32) -> F32x4 {
        // SAFETY: see above.
        F32x4(unsafe { vdupq_n_f32(value) })
    }

    #[inline(always)]
    unsafe fn load_from(self, source: *const f32) -> F32x4 {
        // SAFETY: the caller guarantees it.
        F32x4(unsafe { vld1q_f32(source) })
    }

    #[inline(always)]
    unsafe fn store_to(self, target: *mut f32, v: F32x4) {
        // SAFETY: the caller guarantees it.
        unsafe { vst1q_f32(target, v.0) };
    }

    #[inline(always)]
    fn select(self, condition: F32x4, new: F32x4, old: F32x4) -> F32x4 {
        // SAFETY: see above.
        unsafe { F32x4(vbslq_f32(vcgtq_f32(condition.0, vdupq_n_f32(0.0)), new.0, old.0)) }
    }

    #[inline(always)]
    fn select_or_zero(self, condition: F32x4, v: F32x4) -> F32x4 {
        // SAFETY: see above.
        unsafe {
            let mask = vcgtq_f32(condition.0, vdupq_n_f32(0.0));
            F32x4(vreinterpretq_f32_u32(vandq_u32(vreinterpretq_u32_f32(v.0), mask)))
        }
    }

    #[inline(always)]
    fn any_positive(self, v: F32x4) -> bool {
        // SAFETY: see above.
        unsafe { vmaxvq_u32(vcgtq_f32(v.0, vdupq_n_f32(0.0))) != 0 }
    }

    #[inline(always)]
    fn positive_mask(self, v: F32x4) -> u32 {
        // SAFETY: see above; the array has four numbers to load.
        unsafe {
            let bits = vld1q_u32([1, 2, 4, 8].as_ptr());
            vaddvq_u32(vandq_u32(vcgtq_f32(v.0, vdupq_n_f32(0.0)), bits))
        }
    }

    #[inline(always)]
    fn deinterleave(self, low: F32x4, high: F32x4) -> (F32x4, F32x4) {
        // SAFETY: see above.
        unsafe { (F32x4(vuzp1q_f32(low.0, high.0)), F32x4(vuzp2q_f32(low.0, high.0))) }
    }

    #[inline(always)]
    fn interleave(self, even: F32x4, odd: F32x4) -> (F32x4, F32x4) {
        // SAFETY: see above.
        unsafe { (F32x4(vzip1q_f32(even.0, odd.0)), F32x4(vzip2q_f32(even.0, odd.0))) }
    }

    #[inline(always)]
    fn deinterleave_pairs(self, low: F32x4, high: F32x4) -> (F32x4, F32x4) {
        // SAFETY: see above.
        let [even, odd] = unsafe { pairs_of(low.0, high.0) };
        (F32x4(even), F32x4(odd))
    }

    #[inline(always)]
    fn shuffle(self, v: F32x4) -> F32x4 {
        v
    }

    #[inline(always)]
    fn unshuffle(self, v: F32x4) -> F32x4 {
        v
    }
}

/// Returns the lower pairs and the upper pairs of two vectors.
///
/// # Safety
/// None needed: every aarch64 target has NEON.
#[inline(always)]
unsafe fn pairs_of(low: float32x4_t, high: float32x4_t) -> [float32x4_t; 2] {
    // SAFETY: see above.
    unsafe {
        let (low, high) = (vreinterpretq_f64_f32(low), vreinterpretq_f64_f32(high));
        let (even, odd) = (vuzp1q_f64(low, high), vuzp2q_f64(low, high));
        [vreinterpretq_f32_f64(even), vreinterpretq_f32_f64(odd)]
    }
}

impl GatherPairs for Neon {
    type Pairs = [[float32x4_t; 4]; 2];

    #[inline(always)]
    unsafe fn gather_pairs(
        self,
        points: SharedPoints<'_>,
        at: [&[u32]; 2],
    ) -> (Self::Pairs, [F32x4; 3]) {
        // SAFETY: the caller guarantees the indices; a point is sixteen bytes.
        unsafe {
            let (a, b) = (load_four(points, at[0]), load_four(points, at[1]));
            let span = [
                vsubq_f32(b[0], a[0]),
                vsubq_f32(b[1], a[1]),
                vsubq_f32(b[2], a[2]),
                vsubq_f32(b[3], a[3]),
            ];
            let [x, y] = pairs_of(vzip1q_f32(span[0], span[1]), vzip1q_f32(span[2], span[3]));
            let [z, _] = pairs_of(vzip2q_f32(span[0], span[1]), vzip2q_f32(span[2], span[3]));
            ([a, b], [F32x4(x), F32x4(y), F32x4(z)])
        }
    }

    #[inline(always)]
    unsafe fn scatter_pairs<const MASKED: bool>(
        self,
        points: SharedPoints<'_>,
        at: [&[u32]; 2],
        [a, b]: Self::Pairs,
        shares: [F32x4; 2],
        mask: &[bool],
    ) {
        // SAFETY: the caller guarantees the indices; a point is sixteen bytes.
        unsafe {
            let (to_a, to_b) = (broadcast_lanes(shares[0].0), broadcast_lanes(shares[1].0));
            for lane in 0..4 {
                if MASKED && !*mask.get_unchecked(lane) {
                    continue;
                }
                let span = vsubq_f32(b[lane], a[lane]);
                let at_a = *at[0].get_unchecked(lane);
                let at_b = *at[1].get_unchecked(lane);
                let a = vaddq_f32(a[lane], vmulq_f32(span, to_a[lane]));
                vst1q_f32(points.ptr(at_a), a);
                let b = vsubq_f32(b[lane], vmulq_f32(span, to_b[lane]));
                vst1q_f32(points.ptr(at_b), b);
            }
        }
    }
}

/// Loads the points of four lanes.
///
/// # Safety
/// `at` has four entries, each below the number of points.
#[inline(always)]
unsafe fn load_four(points: SharedPoints<'_>, at: &[u32]) -> [float32x4_t; 4] {
    // SAFETY: the caller guarantees it.
    unsafe {
        [
            load_one(points, at, 0),
            load_one(points, at, 1),
            load_one(points, at, 2),
            load_one(points, at, 3),
        ]
    }
}

/// Loads the point of one lane.
///
/// # Safety
/// `at` has entry `lane`, and that is below the number of points.
#[inline(always)]
unsafe fn load_one(points: SharedPoints<'_>, at: &[u32], lane: usize) -> float32x4_t {
    // SAFETY: the caller guarantees the indices; a point is sixteen bytes.
    unsafe {
        let at = *at.get_unchecked(lane);
        vld1q_f32(points.ptr(at))
    }
}

/// Returns four vectors: number `i` of `v` in all lanes of vector `i`.
///
/// # Safety
/// None needed: every aarch64 target has NEON.
#[inline(always)]
unsafe fn broadcast_lanes(v: float32x4_t) -> [float32x4_t; 4] {
    // SAFETY: see above.
    unsafe {
        [
            vdupq_laneq_f32::<0>(v),
            vdupq_laneq_f32::<1>(v),
            vdupq_laneq_f32::<2>(v),
            vdupq_laneq_f32::<3>(v),
        ]
    }
}
