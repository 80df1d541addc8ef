//! The heavy elastica: what a strip that is held level at one end hangs like.
//!
//! ```text
//! θ'' = −Γ (1 − s) cos θ,   θ(0) = 0,   θ'(1) = 0,   Γ = σ g L³ / D
//! ```

/// The tip of a strip of length 1: how far down it is, how far out, and its slope [rad].
#[derive(Clone, Copy, Debug)]
pub struct Tip {
    pub drop: f64,
    pub reach: f64,
    pub slope: f64,
}

/// From the tip back to the clamp, for the slope that the tip has: the slope at the clamp, drop and reach.
fn back(gamma: f64, slope: f64) -> (f64, f64, f64) {
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

/// The tip at a gravito-bending number `gamma`.
pub fn tip(gamma: f64) -> Tip {
    let (mut low, mut high) = (0.0, core::f64::consts::FRAC_PI_2);
    for _ in 0..60 {
        let slope = 0.5 * (low + high);
        if back(gamma, slope).0 > 0.0 { high = slope } else { low = slope }
    }
    let slope = 0.5 * (low + high);
    let (_, drop, reach) = back(gamma, slope);
    Tip { drop, reach, slope }
}

/// The gravito-bending number of a strip that hangs with this drop over reach.
pub fn gamma_of(drop_over_reach: f64) -> f64 {
    let (mut low, mut high) = (1.0e-4_f64, 1.0e4_f64);
    for _ in 0..50 {
        let gamma = (low * high).sqrt();
        let tip = tip(gamma);
        if tip.drop / tip.reach > drop_over_reach { high = gamma } else { low = gamma }
    }
    (low * high).sqrt()
}
