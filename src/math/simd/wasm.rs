//! Vectors of WebAssembly: four lanes. The module is compiled with or without them.

use super::{Arithmetic, Number, Simd};
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

    type Half = Self;

    #[inline(always)]
    fn half(self) -> Self {
        self
    }

    #[inline(always)]
    fn load(self, list: &[f32], at: usize) -> Four {
        let list = &list[at..at + 4];
        // SAFETY: the slice has a number for every lane.
        Four(unsafe { v128_load(list.as_ptr().cast()) })
    }

    #[inline(always)]
    fn store(self, list: &mut [f32], at: usize, v: Four) {
        let list = &mut list[at..at + 4];
        // SAFETY: as in `load`.
        unsafe { v128_store(list.as_mut_ptr().cast(), v.0) };
    }

    #[inline(always)]
    fn pick(self, keep: Four, new: Four, old: Four) -> Four {
        Four(v128_bitselect(new.0, old.0, f32x4_gt(keep.0, f32x4_splat(0.0))))
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

    #[inline(always)]
    unsafe fn fetch(self, points: &[[f32; 4]], at: &[u32]) -> [Four; 4] {
        // SAFETY: the caller's promise; a point is sixteen bytes.
        let one = |lane: usize| unsafe {
            v128_load(points.get_unchecked(*at.get_unchecked(lane) as usize).as_ptr().cast())
        };
        turn([one(0), one(1), one(2), one(3)]).map(Four)
    }

    #[inline(always)]
    unsafe fn put(self, points: &mut [[f32; 4]], at: &[u32], lanes: [Four; 4]) {
        for (lane, one) in turn(lanes.map(|v| v.0)).into_iter().enumerate() {
            // SAFETY: the caller's promise; a point is sixteen bytes.
            unsafe {
                let point = points.get_unchecked_mut(*at.get_unchecked(lane) as usize);
                v128_store(point.as_mut_ptr().cast(), one);
            }
        }
    }
}

/// Turns four by four numbers.
#[inline(always)]
fn turn([a, b, c, d]: [v128; 4]) -> [v128; 4] {
    let ab = (i32x4_shuffle::<0, 4, 1, 5>(a, b), i32x4_shuffle::<2, 6, 3, 7>(a, b));
    let cd = (i32x4_shuffle::<0, 4, 1, 5>(c, d), i32x4_shuffle::<2, 6, 3, 7>(c, d));
    [
        i64x2_shuffle::<0, 2>(ab.0, cd.0),
        i64x2_shuffle::<1, 3>(ab.0, cd.0),
        i64x2_shuffle::<0, 2>(ab.1, cd.1),
        i64x2_shuffle::<1, 3>(ab.1, cd.1),
    ]
}
