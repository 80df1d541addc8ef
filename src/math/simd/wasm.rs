//! Vectors of WebAssembly: four lanes. The module is compiled with or without them.

use super::{Arithmetic, Between, Number, Simd};
use crate::math::shared::Points;
use core::arch::wasm32::*;
use core::ops::{Add, Div, Mul, Sub};

/// Four lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simd128;

impl Simd128 {
    #[inline(always)]
    pub fn new() -> Self {
        Self
    }
}

/// Numbers in lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Four(v128);

impl Add for Four {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(f32x4_add(self.0, other.0))
    }
}

impl Sub for Four {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(f32x4_sub(self.0, other.0))
    }
}

impl Mul for Four {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(f32x4_mul(self.0, other.0))
    }
}

impl Div for Four {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(f32x4_div(self.0, other.0))
    }
}

impl Number for Four {
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

impl Arithmetic for Simd128 {
    type F = Four;

    #[inline(always)]
    fn splat(self, value: f32) -> Four {
        Four(f32x4_splat(value))
    }
}

impl Simd for Simd128 {
    const LANES: usize = 4;

    #[inline(always)]
    unsafe fn load_from(self, place: *const f32) -> Four {
        // SAFETY: the caller's promise.
        Four(unsafe { v128_load(place.cast()) })
    }

    #[inline(always)]
    unsafe fn store_to(self, place: *mut f32, v: Four) {
        // SAFETY: the caller's promise.
        unsafe { v128_store(place.cast(), v.0) };
    }

    #[inline(always)]
    fn pick(self, keep: Four, new: Four, old: Four) -> Four {
        Four(v128_bitselect(new.0, old.0, f32x4_gt(keep.0, f32x4_splat(0.0))))
    }

    #[inline(always)]
    fn keep(self, keep: Four, v: Four) -> Four {
        Four(v128_and(v.0, f32x4_gt(keep.0, f32x4_splat(0.0))))
    }

    #[inline(always)]
    fn is_any_positive(self, v: Four) -> bool {
        v128_any_true(f32x4_gt(v.0, f32x4_splat(0.0)))
    }

    #[inline(always)]
    fn positives(self, v: Four) -> u32 {
        u32::from(i32x4_bitmask(f32x4_gt(v.0, f32x4_splat(0.0))))
    }

    #[inline(always)]
    fn deal(self, low: Four, high: Four) -> (Four, Four) {
        let even = i32x4_shuffle::<0, 2, 4, 6>(low.0, high.0);
        (Four(even), Four(i32x4_shuffle::<1, 3, 5, 7>(low.0, high.0)))
    }

    #[inline(always)]
    fn gather_up(self, even: Four, odd: Four) -> (Four, Four) {
        let low = i32x4_shuffle::<0, 4, 1, 5>(even.0, odd.0);
        (Four(low), Four(i32x4_shuffle::<2, 6, 3, 7>(even.0, odd.0)))
    }

    #[inline(always)]
    fn deal_twos(self, low: Four, high: Four) -> (Four, Four) {
        let even = i32x4_shuffle::<0, 1, 4, 5>(low.0, high.0);
        (Four(even), Four(i32x4_shuffle::<2, 3, 6, 7>(low.0, high.0)))
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

/// Pairs of points: where they lie, and what leads from one to the other. The points themselves are
/// fetched again, since engines run out of registers.
#[derive(Clone, Copy)]
pub(crate) struct Pairs {
    at: [[*mut v128; 4]; 2],
    span: [v128; 4],
}

impl Between for Simd128 {
    type Pairs = Pairs;

    #[inline(always)]
    unsafe fn fetch(self, points: Points<'_>, at: [&[u32]; 2]) -> (Pairs, [Four; 3]) {
        // SAFETY: the caller's promise; a point is sixteen bytes.
        unsafe {
            let at = at.map(|at| [0, 1, 2, 3].map(|lane| place(points, at, lane)));
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
            (Pairs { at, span }, [Four(x), Four(y), Four(z)])
        }
    }

    #[inline(always)]
    unsafe fn put<const CHOOSY: bool>(
        self,
        _: Points<'_>,
        _: [&[u32]; 2],
        pairs: Pairs,
        shares: [Four; 2],
        moves: &[bool],
    ) {
        // SAFETY: the caller's promise.
        unsafe {
            move_one::<0, CHOOSY>(pairs, shares, moves);
            move_one::<1, CHOOSY>(pairs, shares, moves);
            move_one::<2, CHOOSY>(pairs, shares, moves);
            move_one::<3, CHOOSY>(pairs, shares, moves);
        }
    }
}

/// Moves the two points of a lane.
///
/// # Safety
/// As for `put`.
#[inline(always)]
unsafe fn move_one<const LANE: usize, const CHOOSY: bool>(
    Pairs { at, span }: Pairs,
    [to_a, to_b]: [Four; 2],
    moves: &[bool],
) {
    // SAFETY: the caller's promise; a point is sixteen bytes.
    unsafe {
        if CHOOSY && !*moves.get_unchecked(LANE) {
            return;
        }
        let to_a = i32x4_shuffle::<LANE, LANE, LANE, LANE>(to_a.0, to_a.0);
        let to_b = i32x4_shuffle::<LANE, LANE, LANE, LANE>(to_b.0, to_b.0);
        let [a, b] = [at[0][LANE], at[1][LANE]];
        v128_store(a, f32x4_add(v128_load(a), f32x4_mul(span[LANE], to_a)));
        v128_store(b, f32x4_sub(v128_load(b), f32x4_mul(span[LANE], to_b)));
    }
}

/// Where one of the points lies.
///
/// # Safety
/// `at` has entry `lane`, and that is below the number of points.
#[inline(always)]
unsafe fn place(points: Points<'_>, at: &[u32], lane: usize) -> *mut v128 {
    // SAFETY: the caller's promise.
    unsafe { points.at(*at.get_unchecked(lane)).cast() }
}
