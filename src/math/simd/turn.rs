//! Points turned into lanes and back, for kernels that are plain loops over eight lanes.

use super::{LANES, Lanes};

/// Four numbers of each of eight points, turned so that each number has its lanes.
///
/// `FAST` is whether the code around is compiled for AVX2 or better.
///
/// # Panics
/// If a point is not there.
#[inline(always)]
pub(crate) fn gather<const FAST: bool>(points: &[[f32; 4]], at: &[u32; LANES]) -> [Lanes; 4] {
    assert_all_within(points, at);
    #[cfg(target_arch = "x86_64")]
    if FAST {
        // SAFETY: the caller runs with AVX2, and all indices were just found to be within.
        return unsafe { avx2::gather(points, at) };
    }
    let mut lanes = [[0.0; LANES]; 4];
    for lane in 0..LANES {
        let point = points[at[lane] as usize];
        for number in 0..4 {
            lanes[number][lane] = point[number];
        }
    }
    lanes
}

/// Puts eight points back. Of equal indices the last one stays.
///
/// # Panics
/// If a point is not there.
#[inline(always)]
pub(crate) fn scatter<const FAST: bool>(
    points: &mut [[f32; 4]],
    at: &[u32; LANES],
    lanes: &[Lanes; 4],
) {
    assert_all_within(points, at);
    #[cfg(target_arch = "x86_64")]
    if FAST {
        // SAFETY: as in `gather`.
        unsafe { avx2::scatter(points, at, lanes) };
        return;
    }
    for lane in 0..LANES {
        points[at[lane] as usize] = [0, 1, 2, 3].map(|number| lanes[number][lane]);
    }
}

/// One comparison for all eight.
#[inline(always)]
fn assert_all_within(points: &[[f32; 4]], at: &[u32; LANES]) {
    let mut most = 0;
    for index in at {
        most = if *index > most { *index } else { most };
    }
    assert!((most as usize) < points.len(), "a link ends at a particle");
}

/// What compilers do not find by themselves: four by four numbers turned in registers.
#[cfg(target_arch = "x86_64")]
mod avx2 {
    use super::{LANES, Lanes};
    use core::arch::x86_64::{
        __m256, _mm_loadu_ps, _mm_storeu_ps, _mm256_castps128_ps256, _mm256_castps256_ps128,
        _mm256_extractf128_ps, _mm256_insertf128_ps, _mm256_shuffle_ps, _mm256_unpackhi_ps,
        _mm256_unpacklo_ps,
    };

    /// # Safety
    /// All of `at` are below the number of points.
    #[inline]
    #[target_feature(enable = "avx2")]
    pub unsafe fn gather(points: &[[f32; 4]], at: &[u32; LANES]) -> [Lanes; 4] {
        let two = |lane: usize| {
            // SAFETY: the caller's promise above; a point is sixteen bytes.
            unsafe {
                let low = _mm_loadu_ps(points.get_unchecked(at[lane] as usize).as_ptr());
                let high = _mm_loadu_ps(points.get_unchecked(at[lane + 4] as usize).as_ptr());
                _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(low), high)
            }
        };
        let turned = turn([two(0), two(1), two(2), two(3)]);
        // SAFETY: both are eight times four floats.
        unsafe { core::mem::transmute::<[__m256; 4], [Lanes; 4]>(turned) }
    }

    /// # Safety
    /// All of `at` are below the number of points.
    #[inline]
    #[target_feature(enable = "avx2")]
    pub unsafe fn scatter(points: &mut [[f32; 4]], at: &[u32; LANES], lanes: &[Lanes; 4]) {
        // SAFETY: both are eight times four floats.
        let lanes = unsafe { core::mem::transmute::<[Lanes; 4], [__m256; 4]>(*lanes) };
        for (lane, two) in turn(lanes).into_iter().enumerate() {
            // SAFETY: the caller's promise above; a point is sixteen bytes.
            unsafe {
                let low = points.get_unchecked_mut(at[lane] as usize).as_mut_ptr();
                _mm_storeu_ps(low, _mm256_castps256_ps128(two));
                let high = points.get_unchecked_mut(at[lane + 4] as usize).as_mut_ptr();
                _mm_storeu_ps(high, _mm256_extractf128_ps::<1>(two));
            }
        }
    }

    /// Turns four by four numbers, in both halves.
    #[inline]
    #[target_feature(enable = "avx2")]
    fn turn([a, b, c, d]: [__m256; 4]) -> [__m256; 4] {
        let (ab_low, ab_high) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        let (cd_low, cd_high) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        [
            _mm256_shuffle_ps::<0x44>(ab_low, cd_low),
            _mm256_shuffle_ps::<0xee>(ab_low, cd_low),
            _mm256_shuffle_ps::<0x44>(ab_high, cd_high),
            _mm256_shuffle_ps::<0xee>(ab_high, cd_high),
        ]
    }
}
