//! Vectors of aarch64: four lanes, which every such machine has.

use super::{Arithmetic, Between, Number, Simd};
use crate::math::shared::Points;
use core::arch::aarch64::*;
use core::ops::{Add, Div, Mul, Sub};

/// Four lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neon;

impl Neon {
    #[inline(always)]
    pub fn new() -> Self {
        Self
    }
}

/// Numbers in lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Four(float32x4_t);

// SAFETY of all that follows: every aarch64 target of Rust has NEON, and loads and stores are as their
// callers promise.

impl Add for Four {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vaddq_f32(self.0, other.0) })
    }
}

impl Sub for Four {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vsubq_f32(self.0, other.0) })
    }
}

impl Mul for Four {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vmulq_f32(self.0, other.0) })
    }
}

impl Div for Four {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { vdivq_f32(self.0, other.0) })
    }
}

impl Number for Four {
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

impl Arithmetic for Neon {
    type F = Four;

    #[inline(always)]
    fn splat(self, value: f32) -> Four {
        // SAFETY: see above.
        Four(unsafe { vdupq_n_f32(value) })
    }
}

impl Simd for Neon {
    const LANES: usize = 4;

    #[inline(always)]
    unsafe fn load_from(self, place: *const f32) -> Four {
        // SAFETY: the caller's promise.
        Four(unsafe { vld1q_f32(place) })
    }

    #[inline(always)]
    unsafe fn store_to(self, place: *mut f32, v: Four) {
        // SAFETY: the caller's promise.
        unsafe { vst1q_f32(place, v.0) };
    }

    #[inline(always)]
    fn pick(self, keep: Four, new: Four, old: Four) -> Four {
        // SAFETY: see above.
        unsafe { Four(vbslq_f32(vcgtq_f32(keep.0, vdupq_n_f32(0.0)), new.0, old.0)) }
    }

    #[inline(always)]
    fn keep(self, keep: Four, v: Four) -> Four {
        // SAFETY: see above.
        unsafe {
            let kept = vcgtq_f32(keep.0, vdupq_n_f32(0.0));
            Four(vreinterpretq_f32_u32(vandq_u32(vreinterpretq_u32_f32(v.0), kept)))
        }
    }

    #[inline(always)]
    fn is_any_positive(self, v: Four) -> bool {
        // SAFETY: see above.
        unsafe { vmaxvq_u32(vcgtq_f32(v.0, vdupq_n_f32(0.0))) != 0 }
    }

    #[inline(always)]
    fn positives(self, v: Four) -> u32 {
        // SAFETY: see above; there are four bits to load.
        unsafe {
            let bits = vld1q_u32([1, 2, 4, 8].as_ptr());
            vaddvq_u32(vandq_u32(vcgtq_f32(v.0, vdupq_n_f32(0.0)), bits))
        }
    }

    #[inline(always)]
    fn deal(self, low: Four, high: Four) -> (Four, Four) {
        // SAFETY: see above.
        unsafe { (Four(vuzp1q_f32(low.0, high.0)), Four(vuzp2q_f32(low.0, high.0))) }
    }

    #[inline(always)]
    fn gather_up(self, even: Four, odd: Four) -> (Four, Four) {
        // SAFETY: see above.
        unsafe { (Four(vzip1q_f32(even.0, odd.0)), Four(vzip2q_f32(even.0, odd.0))) }
    }

    #[inline(always)]
    fn deal_twos(self, low: Four, high: Four) -> (Four, Four) {
        // SAFETY: see above.
        let [even, odd] = unsafe { twos(low.0, high.0) };
        (Four(even), Four(odd))
    }

    #[inline(always)]
    fn dealt(self, v: Four) -> Four {
        v
    }

    #[inline(always)]
    fn undealt(self, v: Four) -> Four {
        v
    }
}

/// The lower and the upper twos of two vectors.
///
/// # Safety
/// None is needed where there is NEON, which is everywhere.
#[inline(always)]
unsafe fn twos(low: float32x4_t, high: float32x4_t) -> [float32x4_t; 2] {
    // SAFETY: see above.
    unsafe {
        let (low, high) = (vreinterpretq_f64_f32(low), vreinterpretq_f64_f32(high));
        let (even, odd) = (vuzp1q_f64(low, high), vuzp2q_f64(low, high));
        [vreinterpretq_f32_f64(even), vreinterpretq_f32_f64(odd)]
    }
}

impl Between for Neon {
    type Pairs = [[float32x4_t; 4]; 2];

    #[inline(always)]
    unsafe fn fetch(self, points: Points<'_>, at: [&[u32]; 2]) -> (Self::Pairs, [Four; 3]) {
        // SAFETY: the caller's promise; a point is sixteen bytes.
        unsafe {
            let (a, b) = (all_four(points, at[0]), all_four(points, at[1]));
            let span = [
                vsubq_f32(b[0], a[0]),
                vsubq_f32(b[1], a[1]),
                vsubq_f32(b[2], a[2]),
                vsubq_f32(b[3], a[3]),
            ];
            let [x, y] = twos(vzip1q_f32(span[0], span[1]), vzip1q_f32(span[2], span[3]));
            let [z, _] = twos(vzip2q_f32(span[0], span[1]), vzip2q_f32(span[2], span[3]));
            ([a, b], [Four(x), Four(y), Four(z)])
        }
    }

    #[inline(always)]
    unsafe fn put<const CHOOSY: bool>(
        self,
        points: Points<'_>,
        at: [&[u32]; 2],
        [a, b]: Self::Pairs,
        shares: [Four; 2],
        moves: &[bool],
    ) {
        // SAFETY: the caller's promise; a point is sixteen bytes.
        unsafe {
            let (to_a, to_b) = (each(shares[0].0), each(shares[1].0));
            for lane in 0..4 {
                if CHOOSY && !*moves.get_unchecked(lane) {
                    continue;
                }
                let span = vsubq_f32(b[lane], a[lane]);
                let at_a = *at[0].get_unchecked(lane);
                let at_b = *at[1].get_unchecked(lane);
                let a = vaddq_f32(a[lane], vmulq_f32(span, to_a[lane]));
                vst1q_f32(points.at(at_a), a);
                let b = vsubq_f32(b[lane], vmulq_f32(span, to_b[lane]));
                vst1q_f32(points.at(at_b), b);
            }
        }
    }
}

/// Four of the points.
///
/// # Safety
/// `at` has four entries, each below the number of points.
#[inline(always)]
unsafe fn all_four(points: Points<'_>, at: &[u32]) -> [float32x4_t; 4] {
    // SAFETY: the caller's promise.
    unsafe { [one(points, at, 0), one(points, at, 1), one(points, at, 2), one(points, at, 3)] }
}

/// One of the points.
///
/// # Safety
/// `at` has entry `lane`, and that is below the number of points.
#[inline(always)]
unsafe fn one(points: Points<'_>, at: &[u32], lane: usize) -> float32x4_t {
    // SAFETY: the caller's promise; a point is sixteen bytes.
    unsafe {
        let at = *at.get_unchecked(lane);
        vld1q_f32(points.at(at))
    }
}

/// Each number in all lanes of a vector.
///
/// # Safety
/// None is needed: every such machine has NEON.
#[inline(always)]
unsafe fn each(v: float32x4_t) -> [float32x4_t; 4] {
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
