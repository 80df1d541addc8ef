//! Points turned into lanes and back.

use super::Simd;

/// Four numbers of each of some points, turned so that each number has its lanes.
///
/// # Panics
/// If a point is not there, or `at` has not one for every lane.
#[inline(always)]
pub(crate) fn turn<S: Simd>(s: S, points: &[[f32; 4]], at: &[u32]) -> [S::F; 4] {
    let at = &at[..S::LANES];
    assert_all_within(points, at);
    if S::LANES == 4 {
        let mut rows = [s.splat(0.0); 4];
        for (row, at) in rows.iter_mut().zip(at) {
            // SAFETY: all of `at` were just found to be within; a point is four numbers.
            *row = unsafe { s.load_from(points.get_unchecked(*at as usize).as_ptr()) };
        }
        return turned(s, rows);
    }
    let mut lanes = [[0.0; 8]; 4];
    #[cfg(target_arch = "x86_64")]
    if S::LANES == 8 {
        // SAFETY: only AVX2 has eight lanes, and all of `at` were just found to be within.
        lanes = unsafe { avx2::gather(points, at) };
        let [x, y, z, w] = &lanes;
        return [s.load(x, 0), s.load(y, 0), s.load(z, 0), s.load(w, 0)];
    }
    for (lane, at) in at.iter().enumerate() {
        let [x, y, z, w] = points[*at as usize];
        (lanes[0][lane], lanes[1][lane], lanes[2][lane], lanes[3][lane]) = (x, y, z, w);
    }
    let [x, y, z, w] = &lanes;
    [s.load(x, 0), s.load(y, 0), s.load(z, 0), s.load(w, 0)]
}

/// Puts points back. Of equal places the last one stays.
///
/// # Panics
/// As `turn`.
#[inline(always)]
pub(crate) fn turn_back<S: Simd>(s: S, points: &mut [[f32; 4]], at: &[u32], numbers: [S::F; 4]) {
    let at = &at[..S::LANES];
    assert_all_within(points, at);
    if S::LANES == 4 {
        for (row, at) in turned(s, numbers).into_iter().zip(at) {
            // SAFETY: as in `turn`.
            unsafe { s.store_to(points.get_unchecked_mut(*at as usize).as_mut_ptr(), row) };
        }
        return;
    }
    let mut lanes = [[0.0; 8]; 4];
    for (lanes, number) in lanes.iter_mut().zip(numbers) {
        s.store(lanes, 0, number);
    }
    #[cfg(target_arch = "x86_64")]
    if S::LANES == 8 {
        // SAFETY: as in `turn`.
        unsafe { avx2::scatter(points, at, &lanes) };
        return;
    }
    for (lane, at) in at.iter().enumerate() {
        let [x, y, z, w] = &lanes;
        points[*at as usize] = [x[lane], y[lane], z[lane], w[lane]];
    }
}

/// Four by four numbers turned, of vectors of four lanes; done twice it changes nothing.
#[inline(always)]
pub(crate) fn turned<S: Simd>(s: S, [a, b, c, d]: [S::F; 4]) -> [S::F; 4] {
    let ((ab_low, ab_high), (cd_low, cd_high)) = (s.gather_up(a, b), s.gather_up(c, d));
    let ((x, y), (z, w)) = (s.deal_twos(ab_low, cd_low), s.deal_twos(ab_high, cd_high));
    [x, y, z, w]
}

/// One comparison for all.
#[inline(always)]
fn assert_all_within(points: &[[f32; 4]], at: &[u32]) {
    let mut most = 0;
    for index in at {
        most = if *index > most { *index } else { most };
    }
    assert!((most as usize) < points.len(), "a link ends at a particle");
}

/// What compilers do not find by themselves: four by four numbers turned in registers.
#[cfg(target_arch = "x86_64")]
mod avx2 {
    use core::arch::x86_64::{
        __m256, _mm_loadu_ps, _mm_storeu_ps, _mm256_castps128_ps256, _mm256_castps256_ps128,
        _mm256_extractf128_ps, _mm256_insertf128_ps, _mm256_shuffle_ps, _mm256_unpackhi_ps,
        _mm256_unpacklo_ps,
    };

    /// # Safety
    /// `at` has eight entries, all below the number of points.
    #[inline]
    #[target_feature(enable = "avx2")]
    pub unsafe fn gather(points: &[[f32; 4]], at: &[u32]) -> [[f32; 8]; 4] {
        let two = |lane: usize| {
            // SAFETY: the caller's promise above; a point is sixteen bytes.
            unsafe {
                let low =
                    _mm_loadu_ps(points.get_unchecked(*at.get_unchecked(lane) as usize).as_ptr());
                let high = _mm_loadu_ps(
                    points.get_unchecked(*at.get_unchecked(lane + 4) as usize).as_ptr(),
                );
                _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(low), high)
            }
        };
        let turned = turn([two(0), two(1), two(2), two(3)]);
        // SAFETY: both are eight times four floats.
        unsafe { core::mem::transmute::<[__m256; 4], [[f32; 8]; 4]>(turned) }
    }

    /// # Safety
    /// `at` has eight entries, all below the number of points.
    #[inline]
    #[target_feature(enable = "avx2")]
    pub unsafe fn scatter(points: &mut [[f32; 4]], at: &[u32], lanes: &[[f32; 8]; 4]) {
        // SAFETY: both are eight times four floats.
        let lanes = unsafe { core::mem::transmute::<[[f32; 8]; 4], [__m256; 4]>(*lanes) };
        for (lane, two) in turn(lanes).into_iter().enumerate() {
            // SAFETY: the caller's promise above; a point is sixteen bytes.
            unsafe {
                let low = points.get_unchecked_mut(*at.get_unchecked(lane) as usize).as_mut_ptr();
                _mm_storeu_ps(low, _mm256_castps256_ps128(two));
                let high =
                    points.get_unchecked_mut(*at.get_unchecked(lane + 4) as usize).as_mut_ptr();
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
