//! Gather and scatter of interleaved points: `[x, y, z, w]` in memory, columns x, y, z, w in lanes.
//!
//! ```text
//! memory              lanes
//! x0 y0 z0 w0         x0 x1 x2 x3
//! x1 y1 z1 w1   ⇄     y0 y1 y2 y3
//! x2 y2 z2 w2         z0 z1 z2 z3
//! x3 y3 z3 w3         w0 w1 w2 w3
//! ```
//! Four lanes are one 4 × 4 transpose of two rounds of shuffles; AVX2 does two of them side by
//! side.
//!
//! Reads and writes the points at given indices.
//! Invariant: only whole points are moved; the arithmetic of callers sees the numbers unchanged.

use super::lanes::Simd;

/// Gathers `points[at[lane]]` for each lane and returns the columns x, y, z, w.
///
/// # Panics
/// If `at` has fewer entries than lanes, or an index is out of bounds.
#[inline(always)]
pub(crate) fn gather_transpose<S: Simd>(s: S, points: &[[f32; 4]], at: &[u32]) -> [S::F; 4] {
    let at = &at[..S::LANES];
    assert_in_bounds(points, at);
    if S::LANES == 4 {
        let mut rows = [s.splat(0.0); 4];
        for (row, at) in rows.iter_mut().zip(at) {
            // SAFETY: all indices were just checked; a point is four numbers.
            *row = unsafe { s.load_from(points.get_unchecked(*at as usize).as_ptr()) };
        }
        return transpose_4x4(s, rows);
    }
    let mut lanes = [[0.0; 8]; 4];
    #[cfg(target_arch = "x86_64")]
    if S::LANES == 8 {
        // SAFETY: only AVX2 has eight lanes, and all indices were just checked.
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

/// Scatters the columns x, y, z, w to `points[at[lane]]`. Where an index occurs twice, the last
/// lane stays.
///
/// # Panics
/// As [`gather_transpose`].
#[inline(always)]
pub(crate) fn scatter_transpose<S: Simd>(
    s: S,
    points: &mut [[f32; 4]],
    at: &[u32],
    numbers: [S::F; 4],
) {
    let at = &at[..S::LANES];
    assert_in_bounds(points, at);
    if S::LANES == 4 {
        for (row, at) in transpose_4x4(s, numbers).into_iter().zip(at) {
            // SAFETY: as in `gather_transpose`.
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
        // SAFETY: as in `gather_transpose`.
        unsafe { avx2::scatter(points, at, &lanes) };
        return;
    }
    for (lane, at) in at.iter().enumerate() {
        let [x, y, z, w] = &lanes;
        points[*at as usize] = [x[lane], y[lane], z[lane], w[lane]];
    }
}

/// Transposes a 4 × 4 matrix, given as four vectors of four lanes. It is its own inverse.
#[inline(always)]
pub(crate) fn transpose_4x4<S: Simd>(s: S, [a, b, c, d]: [S::F; 4]) -> [S::F; 4] {
    let ((ab_low, ab_high), (cd_low, cd_high)) = (s.interleave(a, b), s.interleave(c, d));
    let ((x, y), (z, w)) =
        (s.deinterleave_pairs(ab_low, cd_low), s.deinterleave_pairs(ab_high, cd_high));
    [x, y, z, w]
}

/// Panics if an index is out of bounds: one comparison, of the largest index.
#[inline(always)]
fn assert_in_bounds(points: &[[f32; 4]], at: &[u32]) {
    let mut largest = 0;
    for index in at {
        largest = if *index > largest { *index } else { largest };
    }
    assert!((largest as usize) < points.len(), "an index of a point is out of bounds");
}

/// Eight points at once: two 4 × 4 transposes in registers, which compilers do not find.
#[cfg(target_arch = "x86_64")]
mod avx2 {
    use core::arch::x86_64::{
        __m256, _mm_loadu_ps, _mm_storeu_ps, _mm256_castps128_ps256, _mm256_castps256_ps128,
        _mm256_extractf128_ps, _mm256_insertf128_ps, _mm256_shuffle_ps, _mm256_unpackhi_ps,
        _mm256_unpacklo_ps,
    };

    /// Gathers eight points as columns.
    ///
    /// # Safety
    /// `at` has eight entries, all below the number of points.
    #[inline]
    #[target_feature(enable = "avx2")]
    pub unsafe fn gather(points: &[[f32; 4]], at: &[u32]) -> [[f32; 8]; 4] {
        let two = |lane: usize| {
            // SAFETY: the caller guarantees the indices; a point is sixteen bytes.
            unsafe {
                let low =
                    _mm_loadu_ps(points.get_unchecked(*at.get_unchecked(lane) as usize).as_ptr());
                let high = _mm_loadu_ps(
                    points.get_unchecked(*at.get_unchecked(lane + 4) as usize).as_ptr(),
                );
                _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(low), high)
            }
        };
        let columns = transpose([two(0), two(1), two(2), two(3)]);
        // SAFETY: both types are 4 × 8 floats without padding.
        unsafe { core::mem::transmute::<[__m256; 4], [[f32; 8]; 4]>(columns) }
    }

    /// Scatters eight points from columns.
    ///
    /// # Safety
    /// `at` has eight entries, all below the number of points.
    #[inline]
    #[target_feature(enable = "avx2")]
    pub unsafe fn scatter(points: &mut [[f32; 4]], at: &[u32], lanes: &[[f32; 8]; 4]) {
        // SAFETY: both types are 4 × 8 floats without padding.
        let lanes = unsafe { core::mem::transmute::<[[f32; 8]; 4], [__m256; 4]>(*lanes) };
        for (lane, two) in transpose(lanes).into_iter().enumerate() {
            // SAFETY: the caller guarantees the indices; a point is sixteen bytes.
            unsafe {
                let low = points.get_unchecked_mut(*at.get_unchecked(lane) as usize).as_mut_ptr();
                _mm_storeu_ps(low, _mm256_castps256_ps128(two));
                let high =
                    points.get_unchecked_mut(*at.get_unchecked(lane + 4) as usize).as_mut_ptr();
                _mm_storeu_ps(high, _mm256_extractf128_ps::<1>(two));
            }
        }
    }

    /// Transposes the 4 × 4 matrices in the lower and in the upper halves.
    #[inline]
    #[target_feature(enable = "avx2")]
    fn transpose([a, b, c, d]: [__m256; 4]) -> [__m256; 4] {
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
