//! The instruction sets of x86-64: SSE2 with 4 and AVX2 with 8 lanes.
//!
//! One vector type per register width (`F32x4`, `F32x8`) and one token per instruction
//! set. Each operation is one intrinsic; `_mm_max_ps` and `_mm_min_ps` return their second operand
//! for NaN, as [`Float`] demands. Shuffles of 256 bits work within each 128-bit part, hence
//! the shuffled order of [`Simd::shuffle`].
//!
//! Reads and writes only through `load_from` and `store_to`.
//! Invariant: a token exists only where the CPU has its instructions: `Avx2::new` can be called only
//! from a function that enables them.

mod gather;

use super::lanes::{Float, Simd};
use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Sub};

/// SSE2, four lanes: every x86-64 CPU has it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sse2(());

/// AVX2, eight lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(());

impl Sse2 {
    #[inline(always)]
    pub fn new() -> Self {
        Self(())
    }
}

impl Avx2 {
    #[inline]
    #[target_feature(enable = "avx2")]
    pub fn new() -> Self {
        Self(())
    }
}

/// Defines a vector type and its arithmetic, one instruction for each operation.
///
/// A vector can be made only with a token, and a token exists only where the CPU has the
/// instructions.
macro_rules! vector {
    (
        $vector:ident($raw:ty), $add:ident, $sub:ident, $mul:ident,
        $div:ident, $sqrt:ident, $max:ident, $min:ident
    ) => {
        /// One `f32` per lane.
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $vector($raw);

        impl Add for $vector {
            type Output = Self;

            #[inline(always)]
            fn add(self, other: Self) -> Self {
                // SAFETY: a vector exists, so the CPU has its instructions.
                Self(unsafe { $add(self.0, other.0) })
            }
        }

        impl Sub for $vector {
            type Output = Self;

            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                // SAFETY: as for `add`.
                Self(unsafe { $sub(self.0, other.0) })
            }
        }

        impl Mul for $vector {
            type Output = Self;

            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                // SAFETY: as for `add`.
                Self(unsafe { $mul(self.0, other.0) })
            }
        }

        impl Div for $vector {
            type Output = Self;

            #[inline(always)]
            fn div(self, other: Self) -> Self {
                // SAFETY: as for `add`.
                Self(unsafe { $div(self.0, other.0) })
            }
        }

        impl Float for $vector {
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: as for `add`.
                Self(unsafe { $sqrt(self.0) })
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // SAFETY: as for `add`.
                Self(unsafe { $max(self.0, other.0) })
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                // SAFETY: as for `add`.
                Self(unsafe { $min(self.0, other.0) })
            }
        }
    };
}

vector! {
    F32x4(__m128), _mm_add_ps, _mm_sub_ps, _mm_mul_ps,
    _mm_div_ps, _mm_sqrt_ps, _mm_max_ps, _mm_min_ps
}

vector! {
    F32x8(__m256), _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps,
    _mm256_div_ps, _mm256_sqrt_ps, _mm256_max_ps, _mm256_min_ps
}

// SAFETY of all functions below: `self` is a token, so the CPU has the instructions.

impl Simd for Sse2 {
    type F = F32x4;

    const LANES: usize = 4;

    #[inline(always)]
    fn splat(self, value: f32) -> F32x4 {
        // SAFETY: see above.
        F32x4(unsafe { _mm_set1_ps(value) })
    }

    #[inline(always)]
    unsafe fn load_from(self, source: *const f32) -> F32x4 {
        // SAFETY: the caller guarantees the pointer; see above.
        F32x4(unsafe { _mm_loadu_ps(source) })
    }

    #[inline(always)]
    unsafe fn store_to(self, target: *mut f32, v: F32x4) {
        // SAFETY: the caller guarantees the pointer; see above.
        unsafe { _mm_storeu_ps(target, v.0) };
    }

    #[inline(always)]
    fn select(self, condition: F32x4, new: F32x4, old: F32x4) -> F32x4 {
        // SAFETY: see above.
        unsafe {
            let mask = _mm_cmpgt_ps(condition.0, _mm_setzero_ps());
            F32x4(_mm_or_ps(_mm_and_ps(mask, new.0), _mm_andnot_ps(mask, old.0)))
        }
    }

    #[inline(always)]
    fn select_or_zero(self, condition: F32x4, v: F32x4) -> F32x4 {
        // SAFETY: see above.
        F32x4(unsafe { _mm_and_ps(v.0, _mm_cmpgt_ps(condition.0, _mm_setzero_ps())) })
    }

    #[inline(always)]
    fn any_positive(self, v: F32x4) -> bool {
        // SAFETY: see above.
        unsafe { _mm_movemask_ps(_mm_cmpgt_ps(v.0, _mm_setzero_ps())) != 0 }
    }

    #[inline(always)]
    fn positive_mask(self, v: F32x4) -> u32 {
        // SAFETY: see above.
        unsafe { _mm_movemask_ps(_mm_cmpgt_ps(v.0, _mm_setzero_ps())) as u32 }
    }

    #[inline(always)]
    fn deinterleave(self, low: F32x4, high: F32x4) -> (F32x4, F32x4) {
        // SAFETY: see above.
        unsafe {
            let even = _mm_shuffle_ps::<0x88>(low.0, high.0);
            (F32x4(even), F32x4(_mm_shuffle_ps::<0xdd>(low.0, high.0)))
        }
    }

    #[inline(always)]
    fn interleave(self, even: F32x4, odd: F32x4) -> (F32x4, F32x4) {
        // SAFETY: see above.
        unsafe { (F32x4(_mm_unpacklo_ps(even.0, odd.0)), F32x4(_mm_unpackhi_ps(even.0, odd.0))) }
    }

    #[inline(always)]
    fn deinterleave_pairs(self, low: F32x4, high: F32x4) -> (F32x4, F32x4) {
        // SAFETY: see above.
        unsafe {
            (F32x4(_mm_movelh_ps(low.0, high.0)), F32x4(_mm_shuffle_ps::<0xee>(low.0, high.0)))
        }
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

impl Simd for Avx2 {
    type F = F32x8;

    const LANES: usize = 8;

    #[inline(always)]
    fn splat(self, value: f32) -> F32x8 {
        // SAFETY: see above.
        F32x8(unsafe { _mm256_set1_ps(value) })
    }

    #[inline(always)]
    unsafe fn load_from(self, source: *const f32) -> F32x8 {
        // SAFETY: the caller guarantees the pointer; see above.
        F32x8(unsafe { _mm256_loadu_ps(source) })
    }

    #[inline(always)]
    unsafe fn store_to(self, target: *mut f32, v: F32x8) {
        // SAFETY: the caller guarantees the pointer; see above.
        unsafe { _mm256_storeu_ps(target, v.0) };
    }

    #[inline(always)]
    fn select(self, condition: F32x8, new: F32x8, old: F32x8) -> F32x8 {
        // SAFETY: see above.
        unsafe {
            let mask = _mm256_cmp_ps::<_CMP_GT_OQ>(condition.0, _mm256_setzero_ps());
            F32x8(_mm256_blendv_ps(old.0, new.0, mask))
        }
    }

    #[inline(always)]
    fn select_or_zero(self, condition: F32x8, v: F32x8) -> F32x8 {
        // SAFETY: see above.
        unsafe {
            let mask = _mm256_cmp_ps::<_CMP_GT_OQ>(condition.0, _mm256_setzero_ps());
            F32x8(_mm256_and_ps(v.0, mask))
        }
    }

    #[inline(always)]
    fn any_positive(self, v: F32x8) -> bool {
        // SAFETY: see above.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_GT_OQ>(v.0, _mm256_setzero_ps())) != 0 }
    }

    #[inline(always)]
    fn positive_mask(self, v: F32x8) -> u32 {
        // SAFETY: see above.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_GT_OQ>(v.0, _mm256_setzero_ps())) as u32 }
    }

    #[inline(always)]
    fn deinterleave(self, low: F32x8, high: F32x8) -> (F32x8, F32x8) {
        // SAFETY: see above.
        unsafe {
            let even = _mm256_shuffle_ps::<0x88>(low.0, high.0);
            (F32x8(even), F32x8(_mm256_shuffle_ps::<0xdd>(low.0, high.0)))
        }
    }

    #[inline(always)]
    fn interleave(self, even: F32x8, odd: F32x8) -> (F32x8, F32x8) {
        // SAFETY: see above.
        unsafe {
            (F32x8(_mm256_unpacklo_ps(even.0, odd.0)), F32x8(_mm256_unpackhi_ps(even.0, odd.0)))
        }
    }

    #[inline(always)]
    fn deinterleave_pairs(self, low: F32x8, high: F32x8) -> (F32x8, F32x8) {
        // SAFETY: see above.
        unsafe {
            let even = _mm256_shuffle_ps::<0x44>(low.0, high.0);
            (F32x8(even), F32x8(_mm256_shuffle_ps::<0xee>(low.0, high.0)))
        }
    }

    #[inline(always)]
    fn shuffle(self, v: F32x8) -> F32x8 {
        // SAFETY: see above. AVX2 shuffles within halves, so pairs of numbers alternate between the
        // halves. The permutation is its own inverse.
        unsafe {
            let pairs = _mm256_castps_pd(v.0);
            F32x8(_mm256_castpd_ps(_mm256_permute4x64_pd::<0b11_01_10_00>(pairs)))
        }
    }

    #[inline(always)]
    fn unshuffle(self, v: F32x8) -> F32x8 {
        self.shuffle(v)
    }
}
