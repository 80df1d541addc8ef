//! Deterministic sine, cosine, arcsine and exponential. Those of libm differ between platforms.
//!
//! Power series in f64 after range reduction (Abramowitz and Stegun, "Handbook of Mathematical
//! Functions", 4.3.65, 4.3.66, 4.2.1), rounded to f32 at the end.
//!
//! Reads and writes nothing but arguments and results.
//! Invariant: every step is an IEEE 754 operation, so every platform gets the same bits.

use crate::math::{max, min};
use core::f64::consts::{FRAC_2_PI, FRAC_PI_2, LN_2, LOG2_E};

/// Beyond this many radians the reduced angle has no correct digits; the angle counts as zero.
const FAR: f64 = 1.0e9;

/// Returns the sine of `x` [rad]; zero if `x` is not finite or beyond 1e9.
pub(crate) fn sin(x: f64) -> f32 {
    let (quadrant, r) = reduce(x);
    match quadrant {
        0 => sin_series(r) as f32,
        1 => cos_series(r) as f32,
        2 => -sin_series(r) as f32,
        _ => -cos_series(r) as f32,
    }
}

/// Returns the cosine of `x` [rad]; one if `x` is not finite or beyond 1e9.
pub(crate) fn cos(x: f64) -> f32 {
    let (quadrant, r) = reduce(x);
    match quadrant {
        0 => cos_series(r) as f32,
        1 => -sin_series(r) as f32,
        2 => -cos_series(r) as f32,
        _ => sin_series(r) as f32,
    }
}

/// Returns the sine of `x` [rad] to about 1e-6 for |x| up to a few thousand, without a branch, so
/// that loops over it vectorise. The result lies in -1.1..=1.1 for any `x`.
#[inline(always)]
pub(crate) fn sin_branchless(x: f32) -> f32 {
    // Adding and subtracting 1.5 · 2²³ rounds to the nearest integer.
    const ROUND: f32 = 12_582_912.0;
    let half_turns = (x * core::f32::consts::FRAC_1_PI + ROUND) - ROUND;
    // π as a sum of three parts; the first times a small integer is exact.
    let r = ((x - half_turns * 3.140_625) - half_turns * 9.675_026e-4) - half_turns * 1.509_958e-7;
    let r = max(min(r, 1.6), -1.6);
    let s = r * r;
    let sine = r
        * (1.0
            - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0 * (1.0 - s / 110.0)))));
    let odd = half_turns - 2.0 * ((half_turns * 0.5 + ROUND) - ROUND);
    sine * (1.0 - 2.0 * min(odd * odd, 1.0))
}

/// Returns the arcsine [rad] of `x` in -1..=1, to about 1e-7 (Abramowitz and Stegun, 4.4.46).
pub(crate) fn asin(x: f32) -> f32 {
    const SERIES: [f64; 8] = [
        1.570_796_305_0,
        -0.214_598_801_6,
        0.088_978_987_4,
        -0.050_174_304_6,
        0.030_891_881_0,
        -0.017_088_125_6,
        0.006_670_090_1,
        -0.001_262_491_1,
    ];
    let size = f64::from(min(x.abs(), 1.0));
    let sum = SERIES.iter().rev().fold(0.0, |sum, term| sum * size + term);
    let angle = (FRAC_PI_2 - (1.0 - size).sqrt() * sum) as f32;
    if x < 0.0 { -angle } else { angle }
}

/// Returns e to the power of `x` for `x` in -80..=0; values outside are clamped to that range.
pub(crate) fn exp_decay(x: f64) -> f32 {
    let x = if x < -80.0 {
        -80.0
    } else if x < 0.0 {
        x
    } else {
        0.0
    };
    let halvings = (-x * LOG2_E) as i32;
    let r = x + f64::from(halvings) * LN_2;
    let mut term = 1.0;
    let mut sum = 1.0;
    for n in 1..=16 {
        term *= r / f64::from(n);
        sum += term;
    }
    for _ in 0..halvings {
        sum *= 0.5;
    }
    sum as f32
}

/// Returns the quadrant of `x` and the rest in -π/4..=π/4.
fn reduce(x: f64) -> (u8, f64) {
    if !(x > -FAR && x < FAR) {
        return (0, 0.0);
    }
    let turns = x * FRAC_2_PI;
    let nearest = (turns + if turns < 0.0 { -0.5 } else { 0.5 }) as i64;
    (nearest.rem_euclid(4) as u8, x - nearest as f64 * FRAC_PI_2)
}

fn sin_series(r: f64) -> f64 {
    let s = r * r;
    let tail = 1.0 - s / 110.0 * (1.0 - s / 156.0);
    r * (1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0 * tail))))
}

fn cos_series(r: f64) -> f64 {
    let s = r * r;
    let tail = 1.0 - s / 90.0 * (1.0 - s / 132.0);
    1.0 - s / 2.0 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * tail)))
}

/// Returns `x % divisor` bit for bit, for a positive divisor, by long division. Each difference is
/// exact, since it is of two numbers that differ by at most a factor of two (Sterbenz).
///
/// The operator calls `fmod`, which makes a wasm module larger.
pub(crate) fn remainder(x: f64, divisor: f64) -> f64 {
    if !x.is_finite() {
        return f64::NAN;
    }
    let (mut rest, mut step) = (x.abs(), divisor);
    while step <= 0.5 * rest {
        step *= 2.0;
    }
    loop {
        if step <= rest {
            rest -= step;
        }
        if step <= divisor {
            return rest.copysign(x);
        }
        step *= 0.5;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::TAU;

    #[test]
    fn arcsine_is_accurate() {
        for i in -200..=200 {
            let x = i as f32 / 200.0;
            let exact = f64::from(x).asin() as f32;
            assert!((asin(x) - exact).abs() < 3.0e-7, "{x}: {} {exact}", asin(x));
        }
    }

    #[test]
    fn sine_and_cosine_stay_within_one_ulp_of_exact() {
        for i in -40_000..40_000 {
            let x = f64::from(i) * 0.013;
            assert!((f64::from(sin(x)) - x.sin()).abs() < 1.2e-7, "sin {x}");
            assert!((f64::from(cos(x)) - x.cos()).abs() < 1.2e-7, "cos {x}");
        }
        assert_eq!((sin(f64::NAN), cos(f64::INFINITY)), (0.0, 1.0));
    }

    #[test]
    fn the_branchless_sine_is_accurate_and_bounded() {
        for i in -40_000..40_000 {
            let x = i as f32 * 0.05;
            assert!(
                (f64::from(sin_branchless(x)) - f64::from(x).sin()).abs() < 2.0e-6,
                "sin {x}: {}",
                sin_branchless(x)
            );
        }
        for x in [f32::NAN, f32::INFINITY, -1.0e30, 1.0e9] {
            assert!(
                sin_branchless(x).abs() <= 1.1 || sin_branchless(x).is_nan(),
                "{x}: {}",
                sin_branchless(x)
            );
        }
    }

    #[test]
    fn decay_stays_within_one_ulp_of_exact() {
        for i in 0..8_000 {
            let x = -f64::from(i) * 0.01;
            let (ours, exact) = (f64::from(exp_decay(x)), x.exp());
            assert!((ours - exact).abs() <= exact * 1.2e-7, "exp {x}: {ours} {exact}");
        }
        assert_eq!(exp_decay(1.0), 1.0);
    }

    #[test]
    fn remainders_have_the_bits_of_the_operator() {
        let mut x = 1.0e-3_f64;
        while x < 1.0e300 {
            for x in [x, -x, x.round()] {
                for divisor in [TAU, 1.0, 0.3] {
                    assert_eq!(remainder(x, divisor).to_bits(), (x % divisor).to_bits(), "{x}");
                }
            }
            x *= 1.37;
        }
        for x in [0.0, -0.0, TAU, -TAU, 2.0 * TAU, f64::MAX] {
            assert_eq!(remainder(x, TAU).to_bits(), (x % TAU).to_bits(), "{x}");
        }
        assert!(remainder(f64::INFINITY, TAU).is_nan());
    }
}
