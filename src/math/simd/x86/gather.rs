//! Vectors of x86-64 for links between points that lie anywhere.

use super::{Avx2, Eight, Four, Sse2};
use crate::math::shared::Points;
use crate::math::simd::Between;
use core::arch::x86_64::*;

impl Between for Sse2 {
    type Pairs = [[__m128; 4]; 2];

    #[inline(always)]
    unsafe fn fetch(self, points: Points<'_>, at: [&[u32]; 2]) -> (Self::Pairs, [Four; 3]) {
        // SAFETY: the caller's promise; a point is sixteen bytes.
        unsafe {
            let (a, b) = (all_four(points, at[0]), all_four(points, at[1]));
            let span = [
                _mm_sub_ps(b[0], a[0]),
                _mm_sub_ps(b[1], a[1]),
                _mm_sub_ps(b[2], a[2]),
                _mm_sub_ps(b[3], a[3]),
            ];
            let low = [_mm_unpacklo_ps(span[0], span[1]), _mm_unpacklo_ps(span[2], span[3])];
            let high = [_mm_unpackhi_ps(span[0], span[1]), _mm_unpackhi_ps(span[2], span[3])];
            let x = _mm_movelh_ps(low[0], low[1]);
            let y = _mm_movehl_ps(low[1], low[0]);
            ([a, b], [Four(x), Four(y), Four(_mm_movelh_ps(high[0], high[1]))])
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
                let span = _mm_sub_ps(b[lane], a[lane]);
                let at_a = *at[0].get_unchecked(lane);
                let at_b = *at[1].get_unchecked(lane);
                let a = _mm_add_ps(a[lane], _mm_mul_ps(span, to_a[lane]));
                _mm_storeu_ps(points.at(at_a), a);
                let b = _mm_sub_ps(b[lane], _mm_mul_ps(span, to_b[lane]));
                _mm_storeu_ps(points.at(at_b), b);
            }
        }
    }
}

impl Between for Avx2 {
    /// Pair `i` is the lower half of vector `i`, pair `i + 4` the upper one.
    type Pairs = [[__m256; 4]; 2];

    #[inline(always)]
    unsafe fn fetch(self, points: Points<'_>, at: [&[u32]; 2]) -> (Self::Pairs, [Eight; 3]) {
        // SAFETY: the caller's promise; a point is sixteen bytes.
        unsafe {
            let (a, b) = (all_eight(points, at[0]), all_eight(points, at[1]));
            let span = [
                _mm256_sub_ps(b[0], a[0]),
                _mm256_sub_ps(b[1], a[1]),
                _mm256_sub_ps(b[2], a[2]),
                _mm256_sub_ps(b[3], a[3]),
            ];
            let low = [_mm256_unpacklo_ps(span[0], span[1]), _mm256_unpacklo_ps(span[2], span[3])];
            let high = [_mm256_unpackhi_ps(span[0], span[1]), _mm256_unpackhi_ps(span[2], span[3])];
            let x = _mm256_shuffle_ps::<0x44>(low[0], low[1]);
            let y = _mm256_shuffle_ps::<0xee>(low[0], low[1]);
            let z = _mm256_shuffle_ps::<0x44>(high[0], high[1]);
            ([a, b], [Eight(x), Eight(y), Eight(z)])
        }
    }

    #[inline(always)]
    unsafe fn put<const CHOOSY: bool>(
        self,
        points: Points<'_>,
        at: [&[u32]; 2],
        [a, b]: Self::Pairs,
        shares: [Eight; 2],
        moves: &[bool],
    ) {
        // SAFETY: the caller's promise; a point is sixteen bytes.
        unsafe {
            let (to_a, to_b) = (each_twice(shares[0].0), each_twice(shares[1].0));
            for lane in 0..4 {
                let span = _mm256_sub_ps(b[lane], a[lane]);
                let a = _mm256_add_ps(a[lane], _mm256_mul_ps(span, to_a[lane]));
                let b = _mm256_sub_ps(b[lane], _mm256_mul_ps(span, to_b[lane]));
                if !CHOOSY || *moves.get_unchecked(lane) {
                    let at_a = *at[0].get_unchecked(lane);
                    let at_b = *at[1].get_unchecked(lane);
                    let (a, b) = (_mm256_castps256_ps128(a), _mm256_castps256_ps128(b));
                    _mm_storeu_ps(points.at(at_a), a);
                    _mm_storeu_ps(points.at(at_b), b);
                }
                if !CHOOSY || *moves.get_unchecked(lane + 4) {
                    let at_a = *at[0].get_unchecked(lane + 4);
                    let at_b = *at[1].get_unchecked(lane + 4);
                    let (a, b) = (_mm256_extractf128_ps::<1>(a), _mm256_extractf128_ps::<1>(b));
                    _mm_storeu_ps(points.at(at_a), a);
                    _mm_storeu_ps(points.at(at_b), b);
                }
            }
        }
    }
}

/// Four of the points.
///
/// # Safety
/// `at` has four entries, each below the number of points.
#[inline(always)]
unsafe fn all_four(points: Points<'_>, at: &[u32]) -> [__m128; 4] {
    // SAFETY: the caller's promise.
    unsafe { [one(points, at, 0), one(points, at, 1), one(points, at, 2), one(points, at, 3)] }
}

/// One of the points.
///
/// # Safety
/// `at` has entry `lane`, and that is below the number of points.
#[inline(always)]
unsafe fn one(points: Points<'_>, at: &[u32], lane: usize) -> __m128 {
    // SAFETY: the caller's promise; a point is sixteen bytes.
    unsafe {
        let at = *at.get_unchecked(lane);
        _mm_loadu_ps(points.at(at))
    }
}

/// Each number in all lanes of a vector.
///
/// # Safety
/// None is needed: every x86-64 has SSE2.
#[inline(always)]
unsafe fn each(v: __m128) -> [__m128; 4] {
    // SAFETY: see above.
    unsafe {
        [
            _mm_shuffle_ps::<0b00_00_00_00>(v, v),
            _mm_shuffle_ps::<0b01_01_01_01>(v, v),
            _mm_shuffle_ps::<0b10_10_10_10>(v, v),
            _mm_shuffle_ps::<0b11_11_11_11>(v, v),
        ]
    }
}

/// Eight of the points, `i` and `i + 4` in one vector.
///
/// # Safety
/// `at` has eight entries, each below the number of points, and the machine has AVX2.
#[inline(always)]
unsafe fn all_eight(points: Points<'_>, at: &[u32]) -> [__m256; 4] {
    // SAFETY: the caller's promise.
    unsafe { [two(points, at, 0), two(points, at, 1), two(points, at, 2), two(points, at, 3)] }
}

/// Two of the points.
///
/// # Safety
/// As for `all_eight`; `lane` is below four.
#[inline(always)]
unsafe fn two(points: Points<'_>, at: &[u32], lane: usize) -> __m256 {
    // SAFETY: the caller's promise.
    unsafe {
        let low = _mm256_castps128_ps256(one(points, at, lane));
        _mm256_insertf128_ps::<1>(low, one(points, at, lane + 4))
    }
}

/// Each number of a half in all lanes of that half.
///
/// # Safety
/// The machine has AVX2.
#[inline(always)]
unsafe fn each_twice(v: __m256) -> [__m256; 4] {
    // SAFETY: the caller's promise.
    unsafe {
        [
            _mm256_permute_ps::<0b00_00_00_00>(v),
            _mm256_permute_ps::<0b01_01_01_01>(v),
            _mm256_permute_ps::<0b10_10_10_10>(v),
            _mm256_permute_ps::<0b11_11_11_11>(v),
        ]
    }
}
