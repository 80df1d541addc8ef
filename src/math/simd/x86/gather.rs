//! [`GatherPairs`] for SSE2 and AVX2: the two ends of 4 or 8 links at a time.
//!
//! Each point is one 128-bit load; four of them are transposed to columns by two rounds of
//! shuffles. The points stay in registers until [`GatherPairs::scatter_pairs`] writes them back.
//!
//! Reads and writes the interleaved points at the given indices, 16 bytes each.
//! Invariant: no point occurs in two lanes (links of one colour), so the order of stores is
//! irrelevant.

use super::{Avx2, F32x4, F32x8, Sse2};
use crate::math::shared_points::SharedPoints;
use crate::math::simd::lanes::GatherPairs;
use core::arch::x86_64::*;

impl GatherPairs for Sse2 {
    type Pairs = [[__m128; 4]; 2];

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
                _mm_sub_ps(b[0], a[0]),
                _mm_sub_ps(b[1], a[1]),
                _mm_sub_ps(b[2], a[2]),
                _mm_sub_ps(b[3], a[3]),
            ];
            let low = [_mm_unpacklo_ps(span[0], span[1]), _mm_unpacklo_ps(span[2], span[3])];
            let high = [_mm_unpackhi_ps(span[0], span[1]), _mm_unpackhi_ps(span[2], span[3])];
            let x = _mm_movelh_ps(low[0], low[1]);
            let y = _mm_movehl_ps(low[1], low[0]);
            ([a, b], [F32x4(x), F32x4(y), F32x4(_mm_movelh_ps(high[0], high[1]))])
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
                let span = _mm_sub_ps(b[lane], a[lane]);
                let at_a = *at[0].get_unchecked(lane);
                let at_b = *at[1].get_unchecked(lane);
                let a = _mm_add_ps(a[lane], _mm_mul_ps(span, to_a[lane]));
                _mm_storeu_ps(points.ptr(at_a), a);
                let b = _mm_sub_ps(b[lane], _mm_mul_ps(span, to_b[lane]));
                _mm_storeu_ps(points.ptr(at_b), b);
            }
        }
    }
}

impl GatherPairs for Avx2 {
    /// Vector `i` holds the point of lane `i` in its lower half and that of lane `i + 4` in its
    /// upper.
    type Pairs = [[__m256; 4]; 2];

    #[inline(always)]
    unsafe fn gather_pairs(
        self,
        points: SharedPoints<'_>,
        at: [&[u32]; 2],
    ) -> (Self::Pairs, [F32x8; 3]) {
        // SAFETY: the caller guarantees the indices; a point is sixteen bytes.
        unsafe {
            let (a, b) = (load_eight(points, at[0]), load_eight(points, at[1]));
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
            ([a, b], [F32x8(x), F32x8(y), F32x8(z)])
        }
    }

    #[inline(always)]
    unsafe fn scatter_pairs<const MASKED: bool>(
        self,
        points: SharedPoints<'_>,
        at: [&[u32]; 2],
        [a, b]: Self::Pairs,
        shares: [F32x8; 2],
        mask: &[bool],
    ) {
        // SAFETY: the caller guarantees the indices; a point is sixteen bytes.
        unsafe {
            let (to_a, to_b) =
                (broadcast_lanes_of_halves(shares[0].0), broadcast_lanes_of_halves(shares[1].0));
            for lane in 0..4 {
                let span = _mm256_sub_ps(b[lane], a[lane]);
                let a = _mm256_add_ps(a[lane], _mm256_mul_ps(span, to_a[lane]));
                let b = _mm256_sub_ps(b[lane], _mm256_mul_ps(span, to_b[lane]));
                if !MASKED || *mask.get_unchecked(lane) {
                    let at_a = *at[0].get_unchecked(lane);
                    let at_b = *at[1].get_unchecked(lane);
                    let (a, b) = (_mm256_castps256_ps128(a), _mm256_castps256_ps128(b));
                    _mm_storeu_ps(points.ptr(at_a), a);
                    _mm_storeu_ps(points.ptr(at_b), b);
                }
                if !MASKED || *mask.get_unchecked(lane + 4) {
                    let at_a = *at[0].get_unchecked(lane + 4);
                    let at_b = *at[1].get_unchecked(lane + 4);
                    let (a, b) = (_mm256_extractf128_ps::<1>(a), _mm256_extractf128_ps::<1>(b));
                    _mm_storeu_ps(points.ptr(at_a), a);
                    _mm_storeu_ps(points.ptr(at_b), b);
                }
            }
        }
    }
}

/// Loads the points of four lanes.
///
/// # Safety
/// `at` has four entries, each below the number of points.
#[inline(always)]
unsafe fn load_four(points: SharedPoints<'_>, at: &[u32]) -> [__m128; 4] {
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
unsafe fn load_one(points: SharedPoints<'_>, at: &[u32], lane: usize) -> __m128 {
    // SAFETY: the caller guarantees the indices; a point is sixteen bytes.
    unsafe {
        let at = *at.get_unchecked(lane);
        _mm_loadu_ps(points.ptr(at))
    }
}

/// Returns four vectors: number `i` of `v` in all lanes of vector `i`.
///
/// # Safety
/// None needed: every x86-64 CPU has SSE2.
#[inline(always)]
unsafe fn broadcast_lanes(v: __m128) -> [__m128; 4] {
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

/// Loads the points of eight lanes, those of `i` and `i + 4` into one vector.
///
/// # Safety
/// `at` has eight entries, each below the number of points, and the CPU has AVX2.
#[inline(always)]
unsafe fn load_eight(points: SharedPoints<'_>, at: &[u32]) -> [__m256; 4] {
    // SAFETY: the caller guarantees it.
    unsafe {
        [
            load_two(points, at, 0),
            load_two(points, at, 1),
            load_two(points, at, 2),
            load_two(points, at, 3),
        ]
    }
}

/// Loads the points of lanes `lane` and `lane + 4` into one vector.
///
/// # Safety
/// As for `load_eight`; `lane` is below four.
#[inline(always)]
unsafe fn load_two(points: SharedPoints<'_>, at: &[u32], lane: usize) -> __m256 {
    // SAFETY: the caller guarantees it.
    unsafe {
        let low = _mm256_castps128_ps256(load_one(points, at, lane));
        _mm256_insertf128_ps::<1>(low, load_one(points, at, lane + 4))
    }
}

/// Returns four vectors: number `i` of each half of `v` in all lanes of that half of vector `i`.
///
/// # Safety
/// The CPU has AVX2.
#[inline(always)]
unsafe fn broadcast_lanes_of_halves(v: __m256) -> [__m256; 4] {
    // SAFETY: the caller guarantees it.
    unsafe {
        [
            _mm256_permute_ps::<0b00_00_00_00>(v),
            _mm256_permute_ps::<0b01_01_01_01>(v),
            _mm256_permute_ps::<0b10_10_10_10>(v),
            _mm256_permute_ps::<0b11_11_11_11>(v),
        ]
    }
}
