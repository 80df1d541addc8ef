//! Deterministic arithmetic: the same bits on every platform.
//!
//! Only `+ - * /`, square root and comparisons are used, which IEEE 754 defines to the bit.
//! Functions of the standard library or libm whose results differ between platforms (sine,
//! exponential, `f32::min` of NaN) have replacements here.
//!
//! Reads and writes only what callers pass in.
//! Invariant: the order of operations never depends on the platform, the SIMD level or the number
//! of threads.

pub(crate) mod column;
pub(crate) mod columns;
pub(crate) mod float_env;
pub(crate) mod hasher;
pub(crate) mod heap_bytes;
pub(crate) mod pack;
pub(crate) mod reserve;
pub(crate) mod shared;
pub(crate) mod shared_points;
pub(crate) mod simd;
pub(crate) mod sort;
pub(crate) mod swap;
pub(crate) mod threads;
pub(crate) mod trig;
pub(crate) mod wide4;

use glam::Vec3;

/// Lengths and sums of inverse masses below this count as zero.
pub(crate) const TINY: f32 = 1.0e-18;

/// Returns whether two lists hold the same bits. Blocks of 64 are compared without an early exit,
/// so that the compiler vectorises the loop.
pub(crate) fn same_bits(a: &[f32], b: &[f32]) -> bool {
    let differences = |(a, b): (&[f32], &[f32])| {
        a.iter().zip(b).fold(0, |all, (a, b)| all | (a.to_bits() ^ b.to_bits()))
    };
    a.len() == b.len() && a.chunks(64).zip(b.chunks(64)).all(|pair| differences(pair) == 0)
}

/// Returns the smaller of two numbers; `b` if either is NaN, on every platform.
#[inline(always)]
pub(crate) fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Returns the larger of two numbers; `b` if either is NaN, on every platform.
#[inline(always)]
pub(crate) fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Interpolates linearly from `from` (t = 0) to `to` (t = 1), without overflow for distant points.
#[inline(always)]
pub(crate) fn lerp(from: Vec3, to: Vec3, t: f32) -> Vec3 {
    let v = from + (to - from) * t;
    if v.is_finite() { v } else { from * (1.0 - t) + to * t }
}

/// Returns a finite vector: infinite components become the largest finite number, and NaN becomes
/// 0.
#[inline(always)]
pub(crate) fn saturate(v: Vec3) -> Vec3 {
    if v.is_finite() { v } else { saturate_cold(v) }
}

#[cold]
fn saturate_cold(v: Vec3) -> Vec3 {
    let number = |x: f32| if x.is_nan() { 0.0 } else { x.clamp(-f32::MAX, f32::MAX) };
    Vec3::from_array(v.to_array().map(number))
}
