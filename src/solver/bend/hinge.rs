//! Hinges one by one: those where anything was cut.
//!
//! ```text
//! C = Σ cᵢ xᵢ − rest n,   λ = −C / (Σ cᵢ² wᵢ + α̃),   Δxᵢ = wᵢ cᵢ λ
//! ```
//! A vector with a vector for its multiplier: its gradient is always the same, so there is no root to
//! take. Each gives way by its compliance as in Macklin, Müller, Chentanez, "XPBD", MIG 2016.

use crate::model::hinge::{Hinge, hinge_normal};
use crate::solver::particle_stage::access::ParticleAccess;
use glam::Vec3;

/// What a substep of bending works with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HingeStep {
    /// Bending rigidity times the square of the substep, damping included [kg m²].
    pub stiffness: f32,
    /// The share of where particles were that is taken off where they are, for damping.
    pub start_share: f32,
}

/// Bends one hinge.
#[inline(always)]
pub(crate) fn project<S: ParticleAccess>(
    hinge: &Hinge,
    step: HingeStep,
    start: impl Fn(usize) -> Vec3,
    spots: &mut S,
) {
    let at = hinge.particles.map(|vertex| vertex as usize);
    let seats = at.map(|i| spots.particle(i));
    let (mut curve, mut weight) = (Vec3::ZERO, 0.0);
    for ((x, w), c) in seats.iter().zip(hinge.weight) {
        curve += *x * c;
        weight += c * c * w;
    }
    if step.start_share > 0.0 {
        for (i, c) in at.iter().zip(hinge.weight) {
            curve -= start(*i) * (c * step.start_share);
        }
    }
    if hinge.rest != 0.0 {
        let n = hinge_normal(seats.map(|(x, _)| x));
        curve -= n * (hinge.rest * (1.0 - step.start_share));
    }
    let compliance = 1.0 / (hinge.shape * step.stiffness);
    let change = curve * (-1.0 / (weight + compliance));
    for ((i, (_, w)), c) in at.iter().zip(seats).zip(hinge.weight) {
        // Again, for a hinge may name a particle twice.
        let (x, _) = spots.particle(*i);
        spots.set_position(*i, x + change * (c * w));
    }
}
