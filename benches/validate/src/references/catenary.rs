//! Chains without bending stiffness that hang between two supports, or bulge in the wind.
//!
//! ```text
//! L = 2 a sinh(S / 2a),   sag = a (cosh(S / 2a) − 1),   a = H / (σ g)
//! ```
//! H: horizontal tension per width [N/m]; S: span [m]; L: length [m].
//! The elastic one: H. M. Irvine, "Cable Structures", MIT Press 1981, section 1.3.

use super::root;

/// Sag over the span of an inextensible chain of length `ratio` spans.
pub fn sag(ratio: f64) -> f64 {
    // z = S / 2a; sinh(z) / z grows with z.
    let z = root([1.0e-6, 20.0], |z| z.sinh() / z - ratio);
    (z.cosh() - 1.0) / (2.0 * z)
}

/// Sag over the span of an elastic chain that is as long as the span without load. `stiffness`:
/// Ks / (σ g S).
pub fn elastic_sag(stiffness: f64) -> f64 {
    // With the half length ½ and the weight 1 per length: S/2 = H l / Ks + H asinh(l / H).
    let half = 0.5;
    let span = |h: f64| 2.0 * (h * half / stiffness + h * (half / h).asinh());
    let h = root([1.0e-6, 1.0e4], |h| span(h) - 1.0);
    half * half / (2.0 * stiffness) + h * ((1.0 + (half / h).powi(2)).sqrt() - 1.0)
}

/// Sag over the span of an elastic strip in a wind across its span that presses on it with the
/// dynamic pressure times the squared cosine of its slope. `stiffness`: Ks / (pressure S).
///
/// A pressure along the normal keeps the tension T constant, so T dθ/ds = p cos² θ, and tan θ = p s
/// / T: a catenary of the length S (1 + T / Ks).
pub fn wind_sag(stiffness: f64) -> f64 {
    // The tension over p S.
    let length = |t: f64| 2.0 * t * (0.5 / t).sinh();
    let t = root([0.05, 1.0e4], |t| 1.0 + t / stiffness - length(t));
    t * ((0.5 / t).cosh() - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sags_agree_with_published_asymptotes() {
        // Taut: sag² = 3/8 S (L − S); elastic: sag³ = 3 σ g S⁴ / (64 Ks).
        assert!((sag(1.0001) / (0.375 * 0.0001_f64).sqrt() - 1.0).abs() < 1.0e-3);
        for taut in [elastic_sag(1.0e6), wind_sag(1.0e6)] {
            assert!((taut / (3.0_f64 / 64.0e6).cbrt() - 1.0).abs() < 1.0e-3, "{taut}");
        }
    }
}
