//! The heavy elastica: the equilibrium shape of a strip under gravity that is clamped level at one
//! end. Solved by shooting from the free end, with fourth-order Runge–Kutta steps.
//!
//! ```text
//! θ'' = −Γ (1 − s) cos θ,   θ(0) = 0,   θ'(1) = 0,   Γ = σ g L³ / D
//! ```
//!
//! θ: slope [rad]; s: arc length from the clamp over the length L; σ: mass per area; D: bending
//! rigidity; Γ: gravito-bending number.

/// Free end of a strip of length 1: its drop below the clamp, its horizontal distance from the
/// clamp, and its slope [rad].
#[derive(Clone, Copy, Debug)]
pub struct Tip {
    pub drop: f64,
    pub span: f64,
    pub slope: f64,
}

/// Integrates from the free end, which has the slope `slope` [rad], to the clamp. Returns the slope
fn integrate_to_clamp(gamma: f64, slope: f64) -> (f64, f64, f64) {
    const STEPS: u32 = 4000;
    let h = 1.0 / f64::from(STEPS);
    let rate = |u: f64, [angle, bend, ..]: [f64; 4]| {
        [-bend, gamma * u * angle.cos(), angle.sin(), angle.cos()]
    };
    let mut y = [slope, 0.0, 0.0, 0.0];
    let along = |y: [f64; 4], k: [f64; 4], h: f64| core::array::from_fn(|i| y[i] + h * k[i]);
    for step in 0..STEPS {
        let u = f64::from(step) * h;
        let k1 = rate(u, y);
        let k2 = rate(u + 0.5 * h, along(y, k1, 0.5 * h));
        let k3 = rate(u + 0.5 * h, along(y, k2, 0.5 * h));
        let k4 = rate(u + h, along(y, k3, h));
        y = core::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    (y[0], y[2], y[3])
}

/// Shape of the free end at the gravito-bending number `gamma`, by bisection over its slope.
pub fn tip(gamma: f64) -> Tip {
    let (mut low, mut high) = (0.0, core::f64::consts::FRAC_PI_2);
    for _ in 0..60 {
        let slope = 0.5 * (low + high);
        if integrate_to_clamp(gamma, slope).0 > 0.0 { high = slope } else { low = slope }
    }
    let slope = 0.5 * (low + high);
    let (_, drop, span) = integrate_to_clamp(gamma, slope);
    Tip { drop, span, slope }
}

/// Gravito-bending number at which the drop divided by the span is `drop_over_span`.
pub fn gamma_of(drop_over_span: f64) -> f64 {
    let (mut low, mut high) = (1.0e-4_f64, 1.0e4_f64);
    for _ in 0..50 {
        let gamma = (low * high).sqrt();
        let tip = tip(gamma);
        if tip.drop / tip.span > drop_over_span { high = gamma } else { low = gamma }
    }
    (low * high).sqrt()
}
