//! Vectors of x86-64: four, eight and sixteen lanes.

mod gather;

use super::{Arithmetic, Number, Simd};
use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Sub};

/// Four lanes; every x86-64 has them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sse2(());

/// Eight lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(());

/// Sixteen lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx512(());

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

impl Avx512 {
    #[inline]
    #[target_feature(enable = "avx2,avx512f,avx512vl")]
    pub fn new() -> Self {
        Self(())
    }
}

/// A vector type with its operations, one instruction each.
///
/// A vector is only made by what its token lets one make, and the token says that the machine has the
/// instructions.
macro_rules! vector {
    (
        $token:ident, $vector:ident($raw:ty), $set:ident, $add:ident, $sub:ident, $mul:ident,
        $div:ident, $sqrt:ident, $max:ident, $min:ident
    ) => {
        /// Numbers in lanes.
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $vector($raw);

        impl Add for $vector {
            type Output = Self;

            #[inline(always)]
            fn add(self, other: Self) -> Self {
                // SAFETY: there is a vector, so the machine has its instructions; so for all others.
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

        impl Number for $vector {
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

        impl Arithmetic for $token {
            type F = $vector;

            #[inline(always)]
            fn splat(self, value: f32) -> $vector {
                // SAFETY: there is a token, so the machine has the instructions.
                $vector(unsafe { $set(value) })
            }
        }
    };
}

vector! {
    Sse2, Four(__m128), _mm_set1_ps, _mm_add_ps, _mm_sub_ps, _mm_mul_ps,
    _mm_div_ps, _mm_sqrt_ps, _mm_max_ps, _mm_min_ps
}

vector! {
    Avx2, Eight(__m256), _mm256_set1_ps, _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps,
    _mm256_div_ps, _mm256_sqrt_ps, _mm256_max_ps, _mm256_min_ps
}

vector! {
    Avx512, Sixteen(__m512), _mm512_set1_ps, _mm512_add_ps, _mm512_sub_ps, _mm512_mul_ps,
    _mm512_div_ps, _mm512_sqrt_ps, _mm512_max_ps, _mm512_min_ps
}

// SAFETY of all that follows: a token says that the machine has the instructions, and loads and stores
// are as their callers promise.

impl Simd for Sse2 {
    const LANES: usize = 4;

    #[inline(always)]
    unsafe fn load_from(self, place: *const f32) -> Four {
        // SAFETY: the caller's promise, and see above.
        Four(unsafe { _mm_loadu_ps(place) })
    }

    #[inline(always)]
    unsafe fn store_to(self, place: *mut f32, v: Four) {
        // SAFETY: the caller's promise, and see above.
        unsafe { _mm_storeu_ps(place, v.0) };
    }

    #[inline(always)]
    fn pick(self, keep: Four, new: Four, old: Four) -> Four {
        // SAFETY: see above.
        unsafe {
            let keep = _mm_cmpgt_ps(keep.0, _mm_setzero_ps());
            Four(_mm_or_ps(_mm_and_ps(keep, new.0), _mm_andnot_ps(keep, old.0)))
        }
    }

    #[inline(always)]
    fn keep(self, keep: Four, v: Four) -> Four {
        // SAFETY: see above.
        Four(unsafe { _mm_and_ps(v.0, _mm_cmpgt_ps(keep.0, _mm_setzero_ps())) })
    }

    #[inline(always)]
    fn is_any_positive(self, v: Four) -> bool {
        // SAFETY: see above.
        unsafe { _mm_movemask_ps(_mm_cmpgt_ps(v.0, _mm_setzero_ps())) != 0 }
    }

    #[inline(always)]
    fn positives(self, v: Four) -> u32 {
        // SAFETY: see above.
        unsafe { _mm_movemask_ps(_mm_cmpgt_ps(v.0, _mm_setzero_ps())) as u32 }
    }

    #[inline(always)]
    fn deal(self, low: Four, high: Four) -> (Four, Four) {
        // SAFETY: see above.
        unsafe {
            let even = _mm_shuffle_ps::<0x88>(low.0, high.0);
            (Four(even), Four(_mm_shuffle_ps::<0xdd>(low.0, high.0)))
        }
    }

    #[inline(always)]
    fn gather_up(self, even: Four, odd: Four) -> (Four, Four) {
        // SAFETY: see above.
        unsafe { (Four(_mm_unpacklo_ps(even.0, odd.0)), Four(_mm_unpackhi_ps(even.0, odd.0))) }
    }

    #[inline(always)]
    fn deal_twos(self, low: Four, high: Four) -> (Four, Four) {
        // SAFETY: see above.
        unsafe { (Four(_mm_movelh_ps(low.0, high.0)), Four(_mm_shuffle_ps::<0xee>(low.0, high.0))) }
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

impl Simd for Avx2 {
    const LANES: usize = 8;

    #[inline(always)]
    unsafe fn load_from(self, place: *const f32) -> Eight {
        // SAFETY: the caller's promise, and see above.
        Eight(unsafe { _mm256_loadu_ps(place) })
    }

    #[inline(always)]
    unsafe fn store_to(self, place: *mut f32, v: Eight) {
        // SAFETY: the caller's promise, and see above.
        unsafe { _mm256_storeu_ps(place, v.0) };
    }

    #[inline(always)]
    fn pick(self, keep: Eight, new: Eight, old: Eight) -> Eight {
        // SAFETY: see above.
        unsafe {
            let keep = _mm256_cmp_ps::<_CMP_GT_OQ>(keep.0, _mm256_setzero_ps());
            Eight(_mm256_blendv_ps(old.0, new.0, keep))
        }
    }

    #[inline(always)]
    fn keep(self, keep: Eight, v: Eight) -> Eight {
        // SAFETY: see above.
        unsafe {
            let keep = _mm256_cmp_ps::<_CMP_GT_OQ>(keep.0, _mm256_setzero_ps());
            Eight(_mm256_and_ps(v.0, keep))
        }
    }

    #[inline(always)]
    fn is_any_positive(self, v: Eight) -> bool {
        // SAFETY: see above.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_GT_OQ>(v.0, _mm256_setzero_ps())) != 0 }
    }

    #[inline(always)]
    fn positives(self, v: Eight) -> u32 {
        // SAFETY: see above.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_GT_OQ>(v.0, _mm256_setzero_ps())) as u32 }
    }

    #[inline(always)]
    fn deal(self, low: Eight, high: Eight) -> (Eight, Eight) {
        // SAFETY: see above.
        unsafe {
            let even = _mm256_shuffle_ps::<0x88>(low.0, high.0);
            (Eight(even), Eight(_mm256_shuffle_ps::<0xdd>(low.0, high.0)))
        }
    }

    #[inline(always)]
    fn gather_up(self, even: Eight, odd: Eight) -> (Eight, Eight) {
        // SAFETY: see above.
        unsafe {
            (Eight(_mm256_unpacklo_ps(even.0, odd.0)), Eight(_mm256_unpackhi_ps(even.0, odd.0)))
        }
    }

    #[inline(always)]
    fn deal_twos(self, low: Eight, high: Eight) -> (Eight, Eight) {
        // SAFETY: see above.
        unsafe {
            let even = _mm256_shuffle_ps::<0x44>(low.0, high.0);
            (Eight(even), Eight(_mm256_shuffle_ps::<0xee>(low.0, high.0)))
        }
    }

    #[inline(always)]
    fn dealt(self, v: Eight) -> Eight {
        // SAFETY: see above. Instructions deal within halves, so twos go by turns; and back by the
        // same.
        unsafe {
            let twos = _mm256_castps_pd(v.0);
            Eight(_mm256_castpd_ps(_mm256_permute4x64_pd::<0b11_01_10_00>(twos)))
        }
    }

    #[inline(always)]
    fn undealt(self, v: Eight) -> Eight {
        self.dealt(v)
    }
}

impl Simd for Avx512 {
    const LANES: usize = 16;

    #[inline(always)]
    unsafe fn load_from(self, place: *const f32) -> Sixteen {
        // SAFETY: the caller's promise, and see above.
        Sixteen(unsafe { _mm512_loadu_ps(place) })
    }

    #[inline(always)]
    unsafe fn store_to(self, place: *mut f32, v: Sixteen) {
        // SAFETY: the caller's promise, and see above.
        unsafe { _mm512_storeu_ps(place, v.0) };
    }

    #[inline(always)]
    fn pick(self, keep: Sixteen, new: Sixteen, old: Sixteen) -> Sixteen {
        // SAFETY: see above.
        unsafe {
            let keep = _mm512_cmp_ps_mask::<_CMP_GT_OQ>(keep.0, _mm512_setzero_ps());
            Sixteen(_mm512_mask_blend_ps(keep, old.0, new.0))
        }
    }

    #[inline(always)]
    fn keep(self, keep: Sixteen, v: Sixteen) -> Sixteen {
        // SAFETY: see above.
        unsafe {
            let keep = _mm512_cmp_ps_mask::<_CMP_GT_OQ>(keep.0, _mm512_setzero_ps());
            Sixteen(_mm512_maskz_mov_ps(keep, v.0))
        }
    }

    #[inline(always)]
    fn is_any_positive(self, v: Sixteen) -> bool {
        // SAFETY: see above.
        unsafe { _mm512_cmp_ps_mask::<_CMP_GT_OQ>(v.0, _mm512_setzero_ps()) != 0 }
    }

    #[inline(always)]
    fn positives(self, v: Sixteen) -> u32 {
        // SAFETY: see above.
        u32::from(unsafe { _mm512_cmp_ps_mask::<_CMP_GT_OQ>(v.0, _mm512_setzero_ps()) })
    }

    #[inline(always)]
    fn deal(self, low: Sixteen, high: Sixteen) -> (Sixteen, Sixteen) {
        // SAFETY: see above.
        unsafe {
            let even = _mm512_shuffle_ps::<0x88>(low.0, high.0);
            (Sixteen(even), Sixteen(_mm512_shuffle_ps::<0xdd>(low.0, high.0)))
        }
    }

    #[inline(always)]
    fn gather_up(self, even: Sixteen, odd: Sixteen) -> (Sixteen, Sixteen) {
        // SAFETY: see above.
        unsafe {
            let low = _mm512_unpacklo_ps(even.0, odd.0);
            (Sixteen(low), Sixteen(_mm512_unpackhi_ps(even.0, odd.0)))
        }
    }

    #[inline(always)]
    fn deal_twos(self, low: Sixteen, high: Sixteen) -> (Sixteen, Sixteen) {
        // SAFETY: see above.
        unsafe {
            let even = _mm512_shuffle_ps::<0x44>(low.0, high.0);
            (Sixteen(even), Sixteen(_mm512_shuffle_ps::<0xee>(low.0, high.0)))
        }
    }

    #[inline(always)]
    fn dealt(self, v: Sixteen) -> Sixteen {
        // SAFETY: see above. Instructions deal within quarters, so twos come from either half by turns.
        unsafe {
            let order = _mm512_setr_epi64(0, 4, 1, 5, 2, 6, 3, 7);
            let twos = _mm512_permutexvar_pd(order, _mm512_castps_pd(v.0));
            Sixteen(_mm512_castpd_ps(twos))
        }
    }

    #[inline(always)]
    fn undealt(self, v: Sixteen) -> Sixteen {
        // SAFETY: see above.
        unsafe {
            let order = _mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7);
            let twos = _mm512_permutexvar_pd(order, _mm512_castps_pd(v.0));
            Sixteen(_mm512_castpd_ps(twos))
        }
    }
}
