//! The heavy elastica between two clamps: equilibrium of an inextensible strip whose clamps are
//! nearer to each other than it is long, and of a strip that is closed to a loop.
//!
//! ```text
//! θ'' = h sin θ − γ s cos θ      θ(0) = 0 in the middle, θ(1) = end slope, ∫ cos θ ds = reach
//! ```
//! θ: slope [rad]; s: arc length from the middle over half the length l; γ = σ g l³ / D; h: tension
//! in the middle times l² / D. Shooting from the middle by fourth-order Runge–Kutta steps; Newton's
//! method finds θ'(0) and h, with γ raised in small factors.

/// What holds the end of the half strip.
#[derive(Clone, Copy, Debug)]
pub struct Clamp {
    /// Slope at the clamp [rad].
    pub slope: f64,
    /// Horizontal distance of the clamp from the middle, over half the length.
    pub reach: f64,
}

/// The half strip at its clamp: slope, horizontal and vertical distance from the middle.
fn shoot(gamma: f64, [bend, tension]: [f64; 2]) -> [f64; 3] {
    const STEPS: u32 = 2000;
    let h = 1.0 / f64::from(STEPS);
    let rate = |s: f64, [angle, bend, ..]: [f64; 4]| {
        let (sine, cosine) = angle.sin_cos();
        [bend, tension * sine - gamma * s * cosine, cosine, sine]
    };
    let along = |y: [f64; 4], k: [f64; 4], h: f64| core::array::from_fn(|i| y[i] + h * k[i]);
    let mut y = [0.0, bend, 0.0, 0.0];
    for step in 0..STEPS {
        let s = f64::from(step) * h;
        let k1 = rate(s, y);
        let k2 = rate(s + 0.5 * h, along(y, k1, 0.5 * h));
        let k3 = rate(s + 0.5 * h, along(y, k2, 0.5 * h));
        let k4 = rate(s + h, along(y, k3, h));
        y = core::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    [y[0], y[2], y[3]]
}

/// Newton's method for the curvature and the tension in the middle. Returns `None` if it does not
/// converge.
fn solve(gamma: f64, clamp: Clamp, mut unknown: [f64; 2]) -> Option<[f64; 2]> {
    let miss = |unknown: [f64; 2]| {
        let [slope, reach, _] = shoot(gamma, unknown);
        [slope - clamp.slope, reach - clamp.reach]
    };
    for _ in 0..40 {
        let [a, b] = miss(unknown);
        if a.abs() + b.abs() < 1.0e-9 {
            return Some(unknown);
        }
        let step = unknown.map(|value| 1.0e-6 * (1.0 + value.abs()));
        let beside = [[unknown[0] + step[0], unknown[1]], [unknown[0], unknown[1] + step[1]]];
        let [[ax, bx], [ay, by]] = beside.map(miss);
        let [ax, bx] = [(ax - a) / step[0], (bx - b) / step[0]];
        let [ay, by] = [(ay - a) / step[1], (by - b) / step[1]];
        let det = ax * by - ay * bx;
        let change = [(b * ay - a * by) / det, (a * bx - b * ax) / det];
        unknown = [unknown[0] + change[0], unknown[1] + change[1]];
    }
    None
}

/// Depth of the middle below the clamps over the whole length. `gamma`: σ g L³ / D of the whole
/// length. `start`: θ'(0) and h without weight.
fn depth(gamma: f64, clamp: Clamp, start: [f64; 2]) -> f64 {
    let target = gamma / 8.0;
    let (mut at, mut unknown, mut step) = (0.0, start, 0.02_f64);
    let mut before = (-step, unknown);
    while at < target {
        let next = (at + step).min(target);
        // Extrapolates from the last two solutions; one far from there is of another branch.
        let share = (next - at) / (at - before.0);
        let guess = core::array::from_fn(|i| unknown[i] + share * (unknown[i] - before.1[i]));
        let is_near = |found: &[f64; 2]| {
            (0..2).all(|i| (found[i] - guess[i]).abs() < 0.02 * (1.0 + guess[i].abs()))
        };
        match solve(next, clamp, guess).filter(is_near) {
            Some(found) => {
                before = (at, unknown);
                (at, unknown) = (next, found);
                step *= 1.2;
            }
            None => step *= 0.5,
        }
        assert!(step > 1.0e-9, "the elastica has no solution at gamma {gamma}");
    }
    0.5 * shoot(target, unknown)[2]
}

/// Sag over the length of a strip between level clamps whose distance is `span` lengths.
pub fn level_clamps(gamma: f64, span: f64) -> f64 {
    let clamp = Clamp { slope: 0.0, reach: span };
    // Buckled without weight: θ ≈ a sin π s with the mean cosine 1 − a² / 4.
    let amplitude = 2.0 * (1.0 - span).sqrt();
    let pi = core::f64::consts::PI;
    let start = solve(0.0, clamp, [amplitude * pi, -pi * pi * (1.0 - amplitude * amplitude / 8.0)]);
    depth(gamma, clamp, start.expect("the buckled elastica has a solution"))
}

/// Height over the length of a strip that is closed to a ring and hangs from where its ends meet,
/// both level.
pub fn hanging_ring(gamma: f64) -> f64 {
    let pi = core::f64::consts::PI;
    depth(gamma, Clamp { slope: pi, reach: 0.0 }, [pi, 0.0])
}

#[cfg(test)]
mod tests {
    use super::super::catenary;
    use super::*;

    #[test]
    fn a_limp_strip_between_clamps_is_nearly_a_catenary() {
        let limp = level_clamps(1000.0, 0.8) / 0.8;
        assert!((limp - catenary::sag(1.25)).abs() < 0.005, "{limp}");
    }

    #[test]
    fn a_ring_without_weight_is_a_circle() {
        let height = hanging_ring(1.0e-3);
        assert!((height - 1.0 / core::f64::consts::PI).abs() < 1.0e-4, "{height}");
        assert!((0.4..0.5).contains(&hanging_ring(1000.0)));
    }
}
