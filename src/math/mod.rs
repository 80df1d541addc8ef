//! Arithmetic that gives the same bits on every machine: only `+ - * / sqrt` and comparisons.

pub(crate) mod column;
pub(crate) mod columns;
pub(crate) mod float_env;
pub(crate) mod hasher;
pub(crate) mod pack;
pub(crate) mod shared_points;
pub(crate) mod simd;
pub(crate) mod sort;
pub(crate) mod threads;
pub(crate) mod trig;
pub(crate) mod wide4;

use glam::Vec3;

/// Below this a length or a sum of inverse masses counts as nothing.
pub(crate) const TINY: f32 = 1.0e-18;

/// Whether two lists hold the same bits. Some at a time, with no way out between, so that they
/// become vectors.
pub(crate) fn same_bits(a: &[f32], b: &[f32]) -> bool {
    let differences = |(a, b): (&[f32], &[f32])| {
        a.iter().zip(b).fold(0, |all, (a, b)| all | (a.to_bits() ^ b.to_bits()))
    };
    a.len() == b.len() && a.chunks(64).zip(b.chunks(64)).all(|pair| differences(pair) == 0)
}

/// The smaller of two numbers; `b` if either is not a number. One rule on every target.
#[inline(always)]
pub(crate) fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger of two numbers; `b` if either is not a number. One rule on every target.
#[inline(always)]
pub(crate) fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// What is at a share of the way from one point to another, however far apart they are.
#[inline(always)]
pub(crate) fn lerp(from: Vec3, to: Vec3, share: f32) -> Vec3 {
    let v = from + (to - from) * share;
    if v.is_finite() { v } else { from * (1.0 - share) + to * share }
}

/// The same with the largest number there is in place of what none can say, and 0 for what came out
/// of two such.
#[inline(always)]
pub(crate) fn saturate(v: Vec3) -> Vec3 {
    if v.is_finite() { v } else { saturate_cold(v) }
}

#[cold]
fn saturate_cold(v: Vec3) -> Vec3 {
    let number = |x: f32| if x.is_nan() { 0.0 } else { x.clamp(-f32::MAX, f32::MAX) };
    Vec3::from_array(v.to_array().map(number))
}
