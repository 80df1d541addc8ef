//! SIMD traits: one generic interface for scalar code and for every vector instruction set.
//!
//! A kernel is a generic function over `S: Simd`. The value `s: S` is a token: it has no data, and
//! its existence proves that the CPU has the instructions of `S`. `S::F` is the vector type.
//!
//! ```text
//! S        F        lanes   instructions
//! Scalar   f32        1     none
//! Sse2     F32x4      4     SSE2     (every x86-64)
//! Neon     F32x4      4     NEON     (every aarch64)
//! Simd128  F32x4      4     simd128  (WebAssembly, if compiled in)
//! Avx2     F32x8      8     AVX2
//! ```
//!
//! Reads and writes only the slices and points that a kernel passes in.
//!
//! Invariant: every operation is the IEEE 754 operation of each lane (`+ - * /`, square root,
//! comparison) with no fused multiply-add and no approximation. A kernel therefore gives the same
//! bits with every `S`, as long as lanes do not exchange values.

use crate::math::shared_points::SharedPoints;
use core::ops::{Add, Div, Mul, Sub};

/// Largest number of lanes of any instruction set.
pub(crate) const MAX_LANES: usize = 8;

/// Lanes of one block of data that is stored in array-of-structures-of-arrays order.
pub(crate) const LANES: usize = 8;

/// One number for each lane of such a block.
pub(crate) type LaneArray = [f32; LANES];

/// `f32`, or a vector with one `f32` in each lane.
pub(crate) trait Float:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;

    /// The larger number of each lane; `other` if either is NaN.
    fn max(self, other: Self) -> Self;

    /// The smaller number of each lane; `other` if either is NaN.
    fn min(self, other: Self) -> Self;
}

impl Float for f32 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        crate::math::max(self, other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        crate::math::min(self, other)
    }
}

/// An instruction set: the token that makes vectors, and the operations that need it.
///
/// Conditions are numbers, not masks: a lane is true if its number is above 0. NaN is false.
pub(crate) trait Simd: Copy {
    /// The vector type.
    type F: Float;

    /// Numbers in a vector: a power of two, at least 4, except 1 for [`Scalar`].
    const LANES: usize;

    /// `value` in every lane.
    fn splat(self, value: f32) -> Self::F;

    /// Loads one number for each lane from `source`, which needs no alignment.
    ///
    /// # Safety
    /// `source` is valid for reads of `LANES` numbers, which no other thread writes meanwhile.
    unsafe fn load_from(self, source: *const f32) -> Self::F;

    /// Stores the number of each lane to `target`, which needs no alignment.
    ///
    /// # Safety
    /// `target` is valid for writes of `LANES` numbers, which no other thread accesses meanwhile.
    unsafe fn store_to(self, target: *mut f32, v: Self::F);

    /// Loads `list[at..at + LANES]`.
    ///
    /// # Panics
    /// If that range is out of bounds.
    #[inline(always)]
    fn load(self, list: &[f32], at: usize) -> Self::F {
        let list = &list[at..at + Self::LANES];
        // SAFETY: the slice has a number for every lane.
        unsafe { self.load_from(list.as_ptr()) }
    }

    /// Stores into `list[at..at + LANES]`.
    ///
    /// # Panics
    /// If that range is out of bounds.
    #[inline(always)]
    fn store(self, list: &mut [f32], at: usize, v: Self::F) {
        let list = &mut list[at..at + Self::LANES];
        // SAFETY: the slice has room for every lane.
        unsafe { self.store_to(list.as_mut_ptr(), v) };
    }

    /// `new` in the lanes where `condition` is above 0, else `old`.
    fn select(self, condition: Self::F, new: Self::F, old: Self::F) -> Self::F;

    /// `v` in the lanes where `condition` is above 0, else 0.
    fn select_or_zero(self, condition: Self::F, v: Self::F) -> Self::F;

    /// Returns whether any number is above 0.
    fn any_positive(self, v: Self::F) -> bool;

    /// Returns a bit for each lane, set where the number is above 0. The lowest bit is the first
    /// lane.
    fn positive_mask(self, v: Self::F) -> u32;

    /// Splits `low` and `high`, which are consecutive in memory, into the numbers at even and at
    /// odd places. Both results are in shuffled order (see [`Simd::shuffle`]).
    fn deinterleave(self, low: Self::F, high: Self::F) -> (Self::F, Self::F);

    /// The inverse of [`Simd::deinterleave`].
    fn interleave(self, even: Self::F, odd: Self::F) -> (Self::F, Self::F);

    /// Like [`Simd::deinterleave`], but splits pairs of numbers: (0, 1), (4, 5) … and (2, 3),
    /// (6, 7) …. It is its own inverse.
    fn deinterleave_pairs(self, low: Self::F, high: Self::F) -> (Self::F, Self::F);

    /// Permutes lanes from memory order to the order that `deinterleave` leaves them in.
    ///
    /// Wide x86 vectors are shuffled within each 128-bit part, so there the two orders differ.
    fn shuffle(self, v: Self::F) -> Self::F;

    /// The inverse of [`Simd::shuffle`].
    fn unshuffle(self, v: Self::F) -> Self::F;
}

/// Scalar code: one lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scalar;

impl Scalar {
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")))]
    pub fn new() -> Self {
        Self
    }
}

impl Simd for Scalar {
    type F = f32;

    const LANES: usize = 1;

    #[inline(always)]
    fn splat(self, value: f32) -> f32 {
        value
    }

    #[inline(always)]
    unsafe fn load_from(self, source: *const f32) -> f32 {
        // SAFETY: the caller guarantees it.
        unsafe { *source }
    }

    #[inline(always)]
    unsafe fn store_to(self, target: *mut f32, v: f32) {
        // SAFETY: the caller guarantees it.
        unsafe { *target = v };
    }

    #[inline(always)]
    fn select(self, condition: f32, new: f32, old: f32) -> f32 {
        if condition > 0.0 { new } else { old }
    }

    #[inline(always)]
    fn select_or_zero(self, condition: f32, v: f32) -> f32 {
        if condition > 0.0 { v } else { 0.0 }
    }

    #[inline(always)]
    fn any_positive(self, v: f32) -> bool {
        v > 0.0
    }

    #[inline(always)]
    fn positive_mask(self, v: f32) -> u32 {
        u32::from(v > 0.0)
    }

    #[inline(always)]
    fn deinterleave(self, low: f32, high: f32) -> (f32, f32) {
        (low, high)
    }

    #[inline(always)]
    fn interleave(self, even: f32, odd: f32) -> (f32, f32) {
        (even, odd)
    }

    #[inline(always)]
    fn deinterleave_pairs(self, low: f32, high: f32) -> (f32, f32) {
        (low, high)
    }

    #[inline(always)]
    fn shuffle(self, v: f32) -> f32 {
        v
    }

    #[inline(always)]
    fn unshuffle(self, v: f32) -> f32 {
        v
    }
}

/// An instruction set that can gather and scatter pairs of points at arbitrary indices.
///
/// Mesh links use it: each lane is one link, and its two points lie anywhere in the interleaved
/// `[x, y, z, w]` buffer.
pub(crate) trait GatherPairs: Simd {
    /// The gathered points, or their addresses, for [`GatherPairs::scatter_pairs`].
    type Pairs: Copy;

    /// Gathers the two points of every lane, and returns them with the vectors from the first point
    /// to the second, transposed to columns x, y, z.
    ///
    /// # Safety
    /// Both lists of `at` have an entry for each lane, each entry is below `points.len()`, and no
    /// other thread accesses those points meanwhile.
    unsafe fn gather_pairs(
        self,
        points: SharedPoints<'_>,
        at: [&[u32]; 2],
    ) -> (Self::Pairs, [Self::F; 3]);

    /// Moves the two points of every lane along the vector d between them and scatters them:
    /// `a += d * shares[0]`, `b -= d * shares[1]`. If `MASKED` is set, only the lanes whose `mask`
    /// is true are written.
    ///
    /// # Safety
    /// As for [`GatherPairs::gather_pairs`]; `mask` has an entry for each lane.
    unsafe fn scatter_pairs<const MASKED: bool>(
        self,
        points: SharedPoints<'_>,
        at: [&[u32]; 2],
        pairs: Self::Pairs,
        shares: [Self::F; 2],
        mask: &[bool],
    );
}
