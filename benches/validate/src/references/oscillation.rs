//! Periods of the pendulum and of the hanging chain.

use super::root;
use std::f64::consts::{PI, TAU};

/// Period of a pendulum released at `degrees`, over that of small swings: (2/π) K(sin² θ₀/2), by
/// the arithmetic-geometric mean (Abramowitz and Stegun, 17.6).
pub fn pendulum_ratio(degrees: f64) -> f64 {
    let half = (0.5 * degrees.to_radians()).sin();
    let (mut a, mut b) = (1.0, (1.0 - half * half).sqrt());
    for _ in 0..40 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    1.0 / a
}

/// Period of small swings of a pendulum of length `length` [m] [s].
pub fn small_swing(length: f64, gravity: f64) -> f64 {
    TAU * (length / gravity).sqrt()
}

/// Bessel function J₀ for arguments up to 10, by its power series.
pub fn bessel_j0(x: f64) -> f64 {
    let quarter = -0.25 * x * x;
    let (mut sum, mut term) = (1.0, 1.0);
    for k in 1..60 {
        term *= quarter / f64::from(k * k);
        sum += term;
    }
    sum
}

/// First zero of J₀.
pub fn first_zero() -> f64 {
    root([2.0, 3.0], |x| -bessel_j0(x))
}

/// Period of the lowest mode of a hanging chain, 4 π / j₀ √(L / g) (D. Bernoulli 1733; Lamb,
/// "Hydrodynamics", art. 205).
pub fn hanging_chain(length: f64, gravity: f64) -> f64 {
    4.0 * PI / first_zero() * (length / gravity).sqrt()
}

/// Displacement of the lowest mode at the distance `from_top` over the length, 1 at the free end.
pub fn chain_mode(from_top: f64) -> f64 {
    bessel_j0(first_zero() * (1.0 - from_top).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_agree_with_tables() {
        assert!((pendulum_ratio(90.0) - 1.180341).abs() < 1.0e-6);
        assert!((first_zero() - 2.404_825_557_7).abs() < 1.0e-9);
        assert!((hanging_chain(1.0, 1.0) - 5.225481).abs() < 1.0e-5);
    }
}
