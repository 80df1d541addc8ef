//! One source for every instruction set: a kernel is compiled once for each level, and the level is
//! chosen when the program runs. No level has a fused or approximate operation, so all give the same
//! bits.
//!
//! Most kernels are plain loops, which compilers turn into vectors by themselves (`leveled`). Those of
//! the links are written over [`Simd`] (`vectored`), since compilers do not find how to deal out the
//! particles of a row, or to turn four by four numbers.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

#[cfg(target_arch = "aarch64")]
mod neon;
mod transpose;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod wasm;
#[cfg(target_arch = "x86_64")]
mod x86;

#[cfg(target_arch = "aarch64")]
pub(crate) use neon::Neon;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub(crate) use wasm::Simd128;
#[cfg(target_arch = "x86_64")]
pub(crate) use x86::{Avx2, Avx512, Sse2};

use crate::math::shared::Points;
pub(crate) use transpose::{turn, turn_back, turned};

/// What the target always has, for what is not worth a copy for each level.
#[cfg(target_arch = "aarch64")]
pub(crate) type Base = Neon;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub(crate) type Base = Simd128;
#[cfg(target_arch = "x86_64")]
pub(crate) type Base = Sse2;
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")))]
pub(crate) type Base = Scalar;

use core::ops::{Add, Div, Mul, Sub};

/// A number, or one in each lane.
pub(crate) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Correctly rounded.
    fn sqrt(self) -> Self;

    /// The larger; `other` if either is not a number.
    fn max(self, other: Self) -> Self;

    /// The smaller; `other` if either is not a number.
    fn min(self, other: Self) -> Self;
}

impl Number for f32 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        super::max(self, other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        super::min(self, other)
    }
}

/// Something to compute with, whose being there says that the machine can.
pub(crate) trait Arithmetic: Copy {
    type F: Number;

    /// The same in every lane.
    fn splat(self, value: f32) -> Self::F;
}

/// Number by number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scalar;

impl Scalar {
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")))]
    pub fn new() -> Self {
        Self
    }
}

impl Arithmetic for Scalar {
    type F = f32;

    #[inline(always)]
    fn splat(self, value: f32) -> f32 {
        value
    }
}

/// Vectors of a number of lanes that is known when a kernel is compiled.
pub(crate) trait Simd: Arithmetic {
    /// A power of two, at least four but for `Scalar`, which deals nothing out.
    const LANES: usize;

    /// The numbers from a place on.
    ///
    /// # Safety
    /// There is one for each lane, which nobody else writes to.
    unsafe fn load_from(self, place: *const f32) -> Self::F;

    /// Puts numbers at a place and behind it.
    ///
    /// # Safety
    /// There is room for each lane, which nobody else reads or writes.
    unsafe fn store_to(self, place: *mut f32, v: Self::F);

    /// Numbers `at` and on of a list.
    ///
    /// # Panics
    /// If they are not there; so does `store`.
    #[inline(always)]
    fn load(self, list: &[f32], at: usize) -> Self::F {
        let list = &list[at..at + Self::LANES];
        // SAFETY: the slice has a number for every lane.
        unsafe { self.load_from(list.as_ptr()) }
    }

    /// Puts numbers `at` and on into a list.
    #[inline(always)]
    fn store(self, list: &mut [f32], at: usize, v: Self::F) {
        let list = &mut list[at..at + Self::LANES];
        // SAFETY: the slice has room for every lane.
        unsafe { self.store_to(list.as_mut_ptr(), v) };
    }

    /// `new` where `keep` is above 0, else `old`.
    fn pick(self, keep: Self::F, new: Self::F, old: Self::F) -> Self::F;

    /// `v` where `keep` is above 0, else 0.
    fn keep(self, keep: Self::F, v: Self::F) -> Self::F;

    /// Whether any number is above 0.
    fn is_any_positive(self, v: Self::F) -> bool;

    /// Which numbers are above 0: a bit for each lane, the lowest for the first.
    fn positives(self, v: Self::F) -> u32;

    /// Deals two vectors out by turns: the even and the odd numbers. In what order, `dealt` says.
    fn deal(self, low: Self::F, high: Self::F) -> (Self::F, Self::F);

    /// Takes back what `deal` did.
    fn gather_up(self, even: Self::F, odd: Self::F) -> (Self::F, Self::F);

    /// Deals two vectors out two by two, in the order of `dealt`. Done twice it changes nothing.
    fn deal_twos(self, low: Self::F, high: Self::F) -> (Self::F, Self::F);

    /// The order in which numbers are dealt.
    fn dealt(self, v: Self::F) -> Self::F;

    /// Takes back what `dealt` did.
    fn undealt(self, v: Self::F) -> Self::F;
}

impl Simd for Scalar {
    const LANES: usize = 1;

    #[inline(always)]
    unsafe fn load_from(self, place: *const f32) -> f32 {
        // SAFETY: the caller's promise.
        unsafe { *place }
    }

    #[inline(always)]
    unsafe fn store_to(self, place: *mut f32, v: f32) {
        // SAFETY: the caller's promise.
        unsafe { *place = v };
    }

    #[inline(always)]
    fn pick(self, keep: f32, new: f32, old: f32) -> f32 {
        if keep > 0.0 { new } else { old }
    }

    #[inline(always)]
    fn keep(self, keep: f32, v: f32) -> f32 {
        if keep > 0.0 { v } else { 0.0 }
    }

    #[inline(always)]
    fn is_any_positive(self, v: f32) -> bool {
        v > 0.0
    }

    #[inline(always)]
    fn positives(self, v: f32) -> u32 {
        u32::from(v > 0.0)
    }

    #[inline(always)]
    fn deal(self, low: f32, high: f32) -> (f32, f32) {
        (low, high)
    }

    #[inline(always)]
    fn gather_up(self, even: f32, odd: f32) -> (f32, f32) {
        (even, odd)
    }

    #[inline(always)]
    fn deal_twos(self, low: f32, high: f32) -> (f32, f32) {
        (low, high)
    }

    #[inline(always)]
    fn dealt(self, v: f32) -> f32 {
        v
    }

    #[inline(always)]
    fn undealt(self, v: f32) -> f32 {
        v
    }
}

/// Vectors for links between points that lie anywhere.
pub(crate) trait Between: Simd {
    /// As many pairs of points as there are lanes.
    type Pairs: Copy;

    /// Pairs of points, and what leads from the first of each to the second, turned so that each
    /// number has its lanes.
    ///
    /// # Safety
    /// Both lists of places have an entry for each lane, each below the number of points, and no other
    /// thread reaches those points meanwhile; so for `put`.
    unsafe fn fetch(self, points: Points<'_>, at: [&[u32]; 2]) -> (Self::Pairs, [Self::F; 3]);

    /// Puts pairs back, moved along what led from one to the other: the first by so much of it, the
    /// second by so much against it; with `CHOOSY` set, only those that are to move.
    ///
    /// # Safety
    /// As for `fetch`; there is an entry of `moves` for each lane.
    unsafe fn put<const CHOOSY: bool>(
        self,
        points: Points<'_>,
        at: [&[u32]; 2],
        pairs: Self::Pairs,
        shares: [Self::F; 2],
        moves: &[bool],
    );
}

/// The instruction sets that kernels are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    /// Number by number, as far as the code says: what machines without vectors do.
    #[cfg_attr(
        any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"),
        allow(dead_code)
    )]
    Scalar,
    /// What the target always has: SSE2, NEON or simd128, four lanes.
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))]
    Base,
    /// Eight lanes.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// Sixteen lanes.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Level {
    /// Whether kernels are compiled to go number by number too: where nothing else can be done, and in
    /// tests, which compare.
    pub const HAS_SCALAR: bool = cfg!(any(
        test,
        not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))
    ));

    /// The best that this machine has.
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            let is_widest = std::is_x86_feature_detected!("avx512f")
                && std::is_x86_feature_detected!("avx512vl");
            if is_widest && cfg!(not(muslin_at_most_avx2)) {
                return Self::Avx512;
            }
            if std::is_x86_feature_detected!("avx2") {
                return Self::Avx2;
            }
        }
        #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))]
        return Self::Base;
        #[cfg(not(any(
            target_arch = "x86_64",
            target_arch = "aarch64",
            target_feature = "simd128"
        )))]
        Self::Scalar
    }

    /// All that this machine has, the least first.
    #[cfg(test)]
    pub fn all() -> Vec<Self> {
        let all = [
            Self::Scalar,
            #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
            Self::Base,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2,
            #[cfg(target_arch = "x86_64")]
            Self::Avx512,
        ];
        let best = all.iter().position(|level| *level == Self::best());
        all[..=best.expect("the best is one of all")].to_vec()
    }
}

/// Defines `$name(level, arguments…)`, which runs `$body(arguments…)` as compiled for that level; after
/// a second body, that one where there is AVX2 or better.
///
/// The bodies must be `#[inline(always)]`.
macro_rules! leveled {
    ($(#[$doc:meta])* $vis:vis fn $name:ident($($arg:ident: $type:ty),* $(,)?) = $body:path) => {
        $crate::math::simd::leveled! {
            $(#[$doc])* $vis fn $name($($arg: $type),*) = $body, $body
        }
    };
    (
        $(#[$doc:meta])* $vis:vis fn $name:ident($($arg:ident: $type:ty),* $(,)?)
            = $body:path, $fast:path
    ) => {
        $(#[$doc])*
        // Engines leave a function as it is, uncompiled, that many kernels make too long.
        #[cfg_attr(target_arch = "wasm32", inline(never))]
        $vis fn $name(level: $crate::math::simd::Level, $($arg: $type),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2")]
                fn avx2($($arg: $type),*) {
                    $fast($($arg),*);
                }
                #[target_feature(enable = "avx512f,avx512vl")]
                fn avx512($($arg: $type),*) {
                    $fast($($arg),*);
                }
                match level {
                    // SAFETY: `Level::best` gave this level, so the machine has these instructions.
                    $crate::math::simd::Level::Avx2 => return unsafe { avx2($($arg),*) },
                    // SAFETY: as above.
                    $crate::math::simd::Level::Avx512 => return unsafe { avx512($($arg),*) },
                    _ => {}
                }
            }
            let _ = level;
            $body($($arg),*);
        }
    };
}
pub(crate) use leveled;

/// The most lanes that any vectors have.
pub(crate) const MOST_LANES: usize = 16;

/// Lanes of a chunk.
pub(crate) const LANES: usize = 8;

pub(crate) type Lanes = [f32; LANES];

/// Defines `$name(level, arguments…)`, which runs `$body(simd, arguments…)` with the widest vectors of
/// that level, though none wider than `$widest`; without vectors, `$scalar(arguments…)`.
///
/// The bodies must be `#[inline(always)]`.
macro_rules! vectored {
    (
        $(#[$doc:meta])* $vis:vis fn $name:ident($($arg:ident: $type:ty),* $(,)?)
            = $body:path, $widest:ident, $scalar:path
    ) => {
        $(#[$doc])*
        // Engines leave a function as it is, uncompiled, that many kernels make too long.
        #[cfg_attr(target_arch = "wasm32", inline(never))]
        $vis fn $name(level: $crate::math::simd::Level, $($arg: $type),*) {
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2")]
            fn avx2($($arg: $type),*) {
                $body($crate::math::simd::Avx2::new(), $($arg),*);
            }
            #[cfg(target_arch = "x86_64")]
            let widest = $crate::math::simd::vectored!(@$widest avx2, $body, $($arg: $type),*);
            match level {
                $crate::math::simd::Level::Scalar if $crate::math::simd::Level::HAS_SCALAR => {
                    $scalar($($arg),*);
                }
                // SAFETY: `Level::best` gave this level, so the machine has these instructions.
                #[cfg(target_arch = "x86_64")]
                $crate::math::simd::Level::Avx2 => unsafe { avx2($($arg),*) },
                // SAFETY: as above.
                #[cfg(target_arch = "x86_64")]
                $crate::math::simd::Level::Avx512 => unsafe { widest($($arg),*) },
                #[cfg(target_arch = "x86_64")]
                _ => $body($crate::math::simd::Sse2::new(), $($arg),*),
                #[cfg(target_arch = "aarch64")]
                _ => $body($crate::math::simd::Neon::new(), $($arg),*),
                #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
                _ => $body($crate::math::simd::Simd128::new(), $($arg),*),
                #[cfg(not(any(
                    target_arch = "x86_64",
                    target_arch = "aarch64",
                    target_feature = "simd128"
                )))]
                _ => {}
            }
        }
    };
    (@Avx2 $avx2:ident, $body:path, $($arg:ident: $type:ty),*) => { $avx2 };
    (@Avx512 $avx2:ident, $body:path, $($arg:ident: $type:ty),*) => {{
        #[target_feature(enable = "avx2,avx512f,avx512vl")]
        fn avx512($($arg: $type),*) {
            $body($crate::math::simd::Avx512::new(), $($arg),*);
        }
        avx512
    }};
}
pub(crate) use vectored;
