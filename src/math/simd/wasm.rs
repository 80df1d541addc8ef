//! The instruction set of WebAssembly: simd128 with 4 lanes.
//!
//! The choice is made at compile time: the module is built once with simd128 and once without it.
//! Each operation is one instruction; `max` and `min` are the pseudo-maximum and pseudo-minimum,
//! whose operands are swapped so that NaN gives `other`, as [`Float`] demands.
//!
//! Reads and writes only through `load_from`, `store_to`, and the points of [`GatherPairs`].
//! Invariant: this file is compiled only with simd128, so the token can be made anywhere.

use super::lanes::{Float, GatherPairs, Simd};
use crate::math::shared_points::SharedPoints;
use core::arch::wasm32::*;
use core::ops::{Add, Div, Mul, Sub};

/// simd128, four lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simd128;

impl Simd128 {
    #[inline(always)]
    pub fn new() -> Self {
        Self
    }
}

/// One `f32` per lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct F32x4(v128);

impl Add for F32x4 {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(f32x4_add(self.0, other.0))
    }
}

impl Sub for F32x4 {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(f32x4_sub(self.0, other.0))
    }
}

impl Mul for F32x4 {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(f32x4_mul(self.0, other.0))
    }
}

impl Div for F32x4 {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(f32x4_div(self.0, other.0))
    }
}

impl Float for F32x4 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(f32x4_sqrt(self.0))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // `pmax(a, b)` is b where a < b, and a otherwise.
        Self(f32x4_pmax(other.0, self.0))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // `pmin(a, b)` is b where b < a, and a otherwise.
        Self(f32x4_pmin(other.0, self.0))
    }
}

impl Simd for Simd128 {
    type F = F32x4;

    const LANES: usize = 4;

    #[inline(always)]
    fn splat(self, value: f32) -> F32x4 {
        F32x4(f32x4_splat(value))
    }

    #[inline(always)]
    unsafe fn load_from(self, source: *const f32) -> F32x4 {
        // SAFETY: the caller guarantees it.
        F32x4(unsafe { v128_load(source.cast()) })
    }

    #[inline(always)]
    unsafe fn store_to(self, target: *mut f32, v: F32x4) {
        // SAFETY: the caller guarantees it.
        unsafe { v128_store(target.cast(), v.0) };
    }

    #[inline(always)]
    fn select(self, condition: F32x4, new: F32x4, old: F32x4) -> F32x4 {
        F32x4(v128_bitselect(new.0, old.0, f32x4_gt(condition.0, f32x4_splat(0.0))))
    }

    #[inline(always)]
    fn select_or_zero(self, condition: F32x4, v: F32x4) -> F32x4 {
        F32x4(v128_and(v.0, f32x4_gt(condition.0, f32x4_splat(0.0))))
    }

    #[inline(always)]
    fn any_positive(self, v: F32x4) -> bool {
        v128_any_true(f32x4_gt(v.0, f32x4_splat(0.0)))
    }

    #[inline(always)]
    fn positive_mask(self, v: F32x4) -> u32 {
        u32::from(i32x4_bitmask(f32x4_gt(v.0, f32x4_splat(0.0))))
    }

    #[inline(always)]
    fn deinterleave(self, low: F32x4, high: F32x4) -> (F32x4, F32x4) {
        let even = i32x4_shuffle::<0, 2, 4, 6>(low.0, high.0);
        (F32x4(even), F32x4(i32x4_shuffle::<1, 3, 5, 7>(low.0, high.0)))
    }

    #[inline(always)]
    fn interleave(self, even: F32x4, odd: F32x4) -> (F32x4, F32x4) {
        let low = i32x4_shuffle::<0, 4, 1, 5>(even.0, odd.0);
        (F32x4(low), F32x4(i32x4_shuffle::<2, 6, 3, 7>(even.0, odd.0)))
    }

    #[inline(always)]
    fn deinterleave_pairs(self, low: F32x4, high: F32x4) -> (F32x4, F32x4) {
        let even = i32x4_shuffle::<0, 1, 4, 5>(low.0, high.0);
        (F32x4(even), F32x4(i32x4_shuffle::<2, 3, 6, 7>(low.0, high.0)))
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

/// Pairs of points: their addresses and the vectors between them. The points themselves are loaded
/// again when they are scattered, because engines run out of registers otherwise.
#[derive(Clone, Copy)]
pub(crate) struct Pairs {
    at: [[*mut v128; 4]; 2],
    span: [v128; 4],
}

impl GatherPairs for Simd128 {
    type Pairs = Pairs;

    #[inline(always)]
    unsafe fn gather_pairs(self, points: SharedPoints<'_>, at: [&[u32]; 2]) -> (Pairs, [F32x4; 3]) {
        // SAFETY: the caller guarantees the indices; a point is sixteen bytes.
        unsafe {
            let at = at.map(|at| [0, 1, 2, 3].map(|lane| address(points, at, lane)));
            let span =
                [0, 1, 2, 3].map(|lane| f32x4_sub(v128_load(at[1][lane]), v128_load(at[0][lane])));
            let low = [
                i32x4_shuffle::<0, 4, 1, 5>(span[0], span[1]),
                i32x4_shuffle::<0, 4, 1, 5>(span[2], span[3]),
            ];
            let high = [
                i32x4_shuffle::<2, 6, 3, 7>(span[0], span[1]),
                i32x4_shuffle::<2, 6, 3, 7>(span[2], span[3]),
            ];
            let x = i64x2_shuffle::<0, 2>(low[0], low[1]);
            let y = i64x2_shuffle::<1, 3>(low[0], low[1]);
            let z = i64x2_shuffle::<0, 2>(high[0], high[1]);
            (Pairs { at, span }, [F32x4(x), F32x4(y), F32x4(z)])
        }
    }

    #[inline(always)]
    unsafe fn scatter_pairs<const MASKED: bool>(
        self,
        _: SharedPoints<'_>,
        _: [&[u32]; 2],
        pairs: Pairs,
        shares: [F32x4; 2],
        mask: &[bool],
    ) {
        // SAFETY: the caller guarantees it.
        unsafe {
            move_pair::<0, MASKED>(pairs, shares, mask);
            move_pair::<1, MASKED>(pairs, shares, mask);
            move_pair::<2, MASKED>(pairs, shares, mask);
            move_pair::<3, MASKED>(pairs, shares, mask);
        }
    }
}

/// Moves and stores the two points of one lane.
///
/// # Safety
/// As for `scatter_pairs`.
#[inline(always)]
unsafe fn move_pair<const LANE: usize, const MASKED: bool>(
    Pairs { at, span }: Pairs,
    [to_a, to_b]: [F32x4; 2],
    mask: &[bool],
) {
    // SAFETY: the caller guarantees the indices; a point is sixteen bytes.
    unsafe {
        if MASKED && !*mask.get_unchecked(LANE) {
            return;
        }
        let to_a = i32x4_shuffle::<LANE, LANE, LANE, LANE>(to_a.0, to_a.0);
        let to_b = i32x4_shuffle::<LANE, LANE, LANE, LANE>(to_b.0, to_b.0);
        let [a, b] = [at[0][LANE], at[1][LANE]];
        v128_store(a, f32x4_add(v128_load(a), f32x4_mul(span[LANE], to_a)));
        v128_store(b, f32x4_sub(v128_load(b), f32x4_mul(span[LANE], to_b)));
    }
}

/// Returns the address of the point of one lane.
///
/// # Safety
/// `at` has entry `lane`, and that is below the number of points.
#[inline(always)]
unsafe fn address(points: SharedPoints<'_>, at: &[u32], lane: usize) -> *mut v128 {
    // SAFETY: the caller guarantees it.
    unsafe { points.ptr(*at.get_unchecked(lane)).cast() }
}
