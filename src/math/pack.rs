//! Packing of vertex attributes for GPUs: half floats, 16-bit signed normalised integers (snorm16),
//! and octahedral unit vectors.
//!
//! Half floats round to nearest, ties to even. Octahedral encoding is that of Cigolle, Donow,
//! Evangelakos, Mara, McGuire, Meyer, "A survey of efficient representations for independent unit
//! vectors", JCGT 2014.
//!
//! Reads a block of 64 numbers and writes a block of the same length.
//! Invariant: loops have no branches, so they vectorise, and every SIMD level gives the same bits.

use crate::math::simd::leveled;

/// Vertices that are packed together.
pub(crate) const BLOCK: usize = 64;

/// One number for each vertex of a block.
pub(crate) type FloatBlock = [f32; BLOCK];

/// 16 bits for each vertex of a block.
pub(crate) type HalfBlock = [u16; BLOCK];

leveled! {
    /// Converts to half floats: to nearest, ties to even. Larger numbers become the largest, 65504.
    pub(crate) fn to_f16(values: &FloatBlock, out: &mut HalfBlock) = f16_lanes
}

#[inline(always)]
fn f16_lanes(values: &FloatBlock, out: &mut HalfBlock) {
    for (out, value) in out.iter_mut().zip(values) {
        *out = f16(*value);
    }
}

#[inline(always)]
fn f16(value: f32) -> u16 {
    const LARGEST: u32 = 0x477f_e000; // 65504
    const LEAST_NORMAL: u32 = 0x3880_0000; // 2^-14
    const HALF: u32 = 0x3f00_0000; // 0.5
    let bits = value.to_bits();
    let magnitude = bits & 0x7fff_ffff;
    let magnitude = if magnitude > LARGEST { LARGEST } else { magnitude };
    // The bias of the exponent falls from 127 to 15, and 13 bits are rounded off.
    let rounding = 0xfff + (magnitude >> 13 & 1);
    let normal = magnitude.wrapping_sub(112 << 23).wrapping_add(rounding) >> 13;
    // Subnormal halves have a step of 2^-24, which is the last bit of an f32 at 0.5.
    let subnormal = (f32::from_bits(magnitude) + 0.5).to_bits().wrapping_sub(HALF);
    let half = if magnitude < LEAST_NORMAL { subnormal } else { normal };
    (half | (bits >> 16 & 0x8000)) as u16
}

leveled! {
    /// Converts -1..=1 to integers in -32767..=32767, to nearest. Numbers outside are clamped.
    pub(crate) fn to_snorm16(values: &FloatBlock, out: &mut HalfBlock) = snorm16_lanes
}

#[inline(always)]
fn snorm16_lanes(values: &FloatBlock, out: &mut HalfBlock) {
    for (out, value) in out.iter_mut().zip(values) {
        let value = if *value > 1.0 { 1.0 } else { *value };
        let value = if value < -1.0 { -1.0 } else { value };
        *out = (value * 32767.0 + f32::copysign(0.5, value)) as i32 as u16;
    }
}

leveled! {
    /// Converts directions to octahedral coordinates in -1..=1, which replace x and y: the
    /// direction is projected onto the octahedron |x| + |y| + |z| = 1, and its lower half is folded
    /// outward over the diagonals. Zero stays zero.
    pub(crate) fn to_octahedral(x: &mut FloatBlock, y: &mut FloatBlock, z: &FloatBlock)
        = octahedral_lanes
}

#[inline(always)]
fn octahedral_lanes(x: &mut FloatBlock, y: &mut FloatBlock, z: &FloatBlock) {
    for k in 0..BLOCK {
        let sum = x[k].abs() + y[k].abs() + z[k].abs();
        let inverse = if sum > 0.0 { 1.0 / sum } else { 0.0 };
        let (u, v) = (x[k] * inverse, y[k] * inverse);
        let folded = (f32::copysign(1.0 - v.abs(), u), f32::copysign(1.0 - u.abs(), v));
        (x[k], y[k]) = if z[k] < 0.0 { folded } else { (u, v) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::simd::Level;

    /// Returns the value of a half float.
    fn half_value(half: u16) -> f64 {
        let (exponent, part) = (i32::from(half >> 10 & 31), f64::from(half & 1023));
        let size = match exponent {
            0 => part * 2.0_f64.powi(-24),
            _ => (1024.0 + part) * 2.0_f64.powi(exponent - 25),
        };
        if half >> 15 == 1 { -size } else { size }
    }

    /// Packs all values at every level, and asserts that the levels agree.
    fn pack(values: &[f32], to: fn(Level, &FloatBlock, &mut HalfBlock)) -> Vec<u16> {
        let mut packed = Vec::new();
        for chunk in values.chunks(BLOCK) {
            let (mut block, mut out) = ([0.0; BLOCK], [0; BLOCK]);
            block[..chunk.len()].copy_from_slice(chunk);
            let mut first = None;
            for level in Level::available() {
                to(level, &block, &mut out);
                assert_eq!(*first.get_or_insert(out), out);
            }
            packed.extend_from_slice(&out[..chunk.len()]);
        }
        packed
    }

    #[test]
    fn half_floats_round_trip_and_round_to_nearest_even() {
        for half in (0..0x7c00_u16).step_by(BLOCK) {
            let halves: Vec<u16> = (half..half + BLOCK as u16).collect();
            let exact: Vec<f32> = halves.iter().map(|half| half_value(*half) as f32).collect();
            assert_eq!(pack(&exact, to_f16), halves);
            let below: Vec<f32> = exact.iter().map(|value| -value).collect();
            assert!(pack(&below, to_f16).iter().zip(&halves).all(|(p, h)| *p == h | 0x8000));
            for (half, exact) in halves.iter().zip(&exact).filter(|(half, _)| **half < 0x7bff) {
                let middle = (f64::from(*exact) + half_value(half + 1)) as f32 / 2.0;
                let even = half + (half & 1);
                let around = [middle.next_down(), middle, middle.next_up()];
                assert_eq!(pack(&around, to_f16), [*half, even, half + 1]);
            }
        }
    }

    #[test]
    fn numbers_beyond_half_floats_become_the_largest_or_zero() {
        let values = [65519.0, 65520.0, 1e30, f32::MAX, -1e9, 1e-9, -1e-9];
        let packed = pack(&values, to_f16);
        assert_eq!(packed, [0x7bff, 0x7bff, 0x7bff, 0x7bff, 0xfbff, 0, 0x8000]);
    }

    #[test]
    fn snorm16_rounds_to_nearest_and_clamps() {
        let values = [0.0, 1.0, -1.0, 0.5, -0.5, 7.0, -7.0, 1.0 / 32767.0, 0.49 / 32767.0];
        let packed: Vec<i16> = pack(&values, to_snorm16).iter().map(|half| *half as i16).collect();
        assert_eq!(packed, [0, 32767, -32767, 16384, -16384, 32767, -32767, 1, 0]);
    }

    #[test]
    fn octahedral_directions_round_trip() {
        for turn in 0..100 {
            let mut v = [[0.0_f32; BLOCK]; 3];
            for k in 0..BLOCK {
                let (a, z) = (turn as f32 * 0.0628, k as f32 / 31.5 - 1.0);
                let r = (1.0 - z * z).max(0.0).sqrt();
                (v[0][k], v[1][k], v[2][k]) = (a.cos() * r, a.sin() * r, z);
            }
            let mut out = [v[0], v[1]];
            let [x, y] = &mut out;
            to_octahedral(Level::best(), x, y, &v[2]);
            for k in 0..BLOCK {
                // The decoding that shaders use.
                let (mut x, mut y) = (out[0][k], out[1][k]);
                let z = 1.0 - x.abs() - y.abs();
                let t = (-z).max(0.0);
                x += if x >= 0.0 { -t } else { t };
                y += if y >= 0.0 { -t } else { t };
                let length = (x * x + y * y + z * z).sqrt();
                let error = [x / length - v[0][k], y / length - v[1][k], z / length - v[2][k]];
                assert!(error.iter().all(|d| d.abs() < 1e-6), "{turn} {k}: {error:?}");
            }
        }
    }
}
