//! Bending of a single hinge: two triangles that share an edge. Used for the hinges that cuts add.
//!
//! ```text
//!       a          C = Σ cᵢ xᵢ − rest n         x: p, q, a, b     n: unit normal of the hinge
//!      ╱ ╲         Δλ = −(C + α̃ λ) / (Σ cᵢ² wᵢ + α̃)      α̃ = 1 / (shape · stiffness)
//!     p───q        Δxᵢ = wᵢ cᵢ Δλ
//!      ╲ ╱
//!       b
//! ```
//! Method: XPBD with a vector constraint and a vector multiplier (Macklin, Müller, Chentanez,
//! "XPBD", MIG 2016). C is linear in the positions, so its gradient is constant and needs no square
//! root.
//!
//! Reads the hinge and the start positions of the substep; writes four positions and λ.
//! Invariant: Σ cᵢ = 0, so a hinge conserves linear momentum.

use crate::model::hinge::{Hinge, hinge_normal};
use crate::solver::particle_stage::access::ParticleAccess;
use glam::Vec3;

/// Parameters of bending in one substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HingeStep {
    /// Bending rigidity times the square of the substep, damping included [kg m²].
    pub stiffness: f32,
    /// Share of the start positions to subtract from the positions; above 0 with damping. With
    /// lag = damping / h it is lag / (1 + lag).
    pub start_share: f32,
}

/// Projects one hinge. `start` gives the position of a particle at the start of the substep [m]; the
/// multiplier `lambda` [kg m] continues from the last sweep of the substep.
#[inline(always)]
pub(crate) fn project<S: ParticleAccess>(
    hinge: &Hinge,
    step: HingeStep,
    start: impl Fn(usize) -> Vec3,
    lambda: &mut Vec3,
    particles: &mut S,
) {
    let at = hinge.particles.map(|vertex| vertex as usize);
    let corners = at.map(|i| particles.particle(i));
    let (mut curve, mut weight) = (Vec3::ZERO, 0.0);
    for ((x, w), c) in corners.iter().zip(hinge.weight) {
        curve += *x * c;
        weight += c * c * w;
    }
    if step.start_share > 0.0 {
        for (i, c) in at.iter().zip(hinge.weight) {
            curve -= start(*i) * (c * step.start_share);
        }
    }
    if hinge.rest != 0.0 {
        let n = hinge_normal(corners.map(|(x, _)| x));
        curve -= n * (hinge.rest * (1.0 - step.start_share));
    }
    let compliance = 1.0 / (hinge.shape * step.stiffness);
    let change = (curve + *lambda * compliance) * (-1.0 / (weight + compliance));
    *lambda += change;
    for ((i, (_, w)), c) in at.iter().zip(corners).zip(hinge.weight) {
        // Read the position again, because a hinge may contain a particle twice.
        let (x, _) = particles.particle(*i);
        particles.set_position(*i, x + change * (c * w));
    }
}
