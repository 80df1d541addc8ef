//! The projection of one distance constraint (link), in scalar and in SIMD form.
//!
//! ```text
//! a ●───── n ─────▶ ● b        l = |x_b − x_a|,   n = (x_b − x_a) / l,   C = l − rest
//! ```
//! Three laws, chosen at compile time:
//!
//! | law | correction of the pair | source |
//! | --- | --- | --- |
//! | `SOFT` | Δλ = −(C + α̃ λ) / (w_a + w_b + α̃), α̃ = compliance / h² | XPBD, eq. 18 |
//! | `RIGID` | Halley's step to the root of l² = rest², w relative to their mean | below |
//! | `BOUND` | as `SOFT` with α̃ = 0 and C = max(l − limit · rest, 0) | Provot 1995 |
//!
//! XPBD: Macklin, Müller, Chentanez, "XPBD", MIG 2016. Halley's step needs no square root: a link
//! of length l gets the length l (l² + 3 rest²) / (3 l² + rest²), which turns an error of 10 % into
//! one of 0.03 %. Provot: "Deformation constraints in a mass-spring model", Graphics Interface
//! 1995.
//!
//! Reads the ends' positions and weights, `rest`, `compliance` and λ; writes the positions and,
//! under `SOFT`, λ.
//! Invariant: every SIMD kernel calls [`compute_correction`], so that all kernels give the same
//! bits as the scalar code.

use crate::math::simd::{Float, Scalar, Simd};
use crate::math::{TINY, max};
use crate::model::links::{LinkKind, Links};
use crate::model::material::Material;
use crate::solver::particle_stage::access::ParticleAccess;

/// Law of a link that has a compliance. Laws are integers so that kernels can be generic over them.
pub(crate) const SOFT: u8 = 0;
/// Law of a link without compliance.
pub(crate) const RIGID: u8 = 1;
/// Law of a link that resists only if it is longer than a limit.
pub(crate) const BOUND: u8 = 2;

/// Whether the links of a kind have no compliance, so that they need no multiplier from sweep to
/// sweep.
pub(crate) fn is_rigid(material: &Material, kind: LinkKind) -> bool {
    let stretch_is_rigid =
        material.stretch_stiffness_warp == 0.0 && material.stretch_stiffness_weft == 0.0;
    match kind {
        LinkKind::Stretch => stretch_is_rigid,
        LinkKind::Shear => stretch_is_rigid && material.shear_stiffness == 0.0,
        // Compliant bending is done by plate elements and hinges, not by links.
        LinkKind::Bend => true,
    }
}

/// Projects one link of a list, if it is active. For `scale` see [`compute_correction`].
#[inline(always)]
pub(crate) fn project_link<const LAW: u8, P: ParticleAccess>(
    (links, lambda): (&Links, &mut [f32]),
    link: usize,
    particles: &mut P,
    scale: f32,
) {
    if !links.active[link] {
        return;
    }
    let ends = (links.a[link] as usize, links.b[link] as usize);
    let (rest, compliance, old) = (links.rest[link], links.compliance[link], lambda[link]);
    let new = project_pair::<LAW, _>(ends, rest, compliance, old, particles, scale);
    if LAW == SOFT {
        lambda[link] = new;
    }
}

/// Projects the link between two particles, and returns its new multiplier λ.
#[inline(always)]
pub(crate) fn project_pair<const LAW: u8, P: ParticleAccess>(
    (a, b): (usize, usize),
    rest: f32,
    compliance: f32,
    lambda: f32,
    particles: &mut P,
    scale: f32,
) -> f32 {
    let ((xa, wa), (xb, wb)) = (particles.particle(a), particles.particle(b));
    let span = xb - xa;
    let weights = if LAW == RIGID { relative_weights([wa, wb]) } else { [wa, wb] };
    let ([to_a, to_b], lambda) = compute_correction::<LAW, _>(
        Scalar,
        span.to_array(),
        weights,
        rest,
        compliance,
        lambda,
        scale,
    );
    particles.set_position(a, xa + span * to_a);
    particles.set_position(b, xb - span * to_b);
    lambda
}

/// Two inverse masses divided by their mean: 1 and 1 if they are equal and positive.
#[inline(always)]
pub(crate) fn relative_weights([wa, wb]: [f32; 2]) -> [f32; 2] {
    let mean = max(0.5 * (wa + wb), TINY);
    [wa / mean, wb / mean]
}

/// The correction of a link: the shares of its span that a moves along and b moves against, and λ.
///
/// `weights` are the inverse masses [1/kg] of a and b; under `RIGID` those of [`relative_weights`].
/// `scale` is 1/h² [1/s²] under `SOFT`, the largest allowed length over `rest` under `BOUND`, and
/// unused under `RIGID`. λ changes under `SOFT` only.
#[inline(always)]
pub(crate) fn compute_correction<const LAW: u8, S: Simd>(
    s: S,
    [dx, dy, dz]: [S::F; 3],
    [wa, wb]: [S::F; 2],
    rest: S::F,
    compliance: S::F,
    lambda: S::F,
    scale: f32,
) -> ([S::F; 2], S::F) {
    let tiny = s.splat(TINY);
    let length2 = dx * dx + dy * dy + dz * dz;
    if LAW == RIGID {
        // The guard is on `rest2`, which is known early, so that no operation waits for it.
        let rest2 = (rest * rest).max(tiny);
        let share = (length2 - rest2) / (length2 * s.splat(3.0) + rest2);
        return ([share * wa, share * wb], lambda);
    }
    let (length, weight) = (length2.sqrt().max(tiny), wa + wb);
    if LAW == SOFT {
        let softness = compliance * s.splat(scale);
        let pull = length - rest + softness * lambda;
        let share = pull / (length * (weight + softness).max(tiny));
        return ([share * wa, share * wb], lambda - share * length);
    }
    let stretch = (length - rest * s.splat(scale)).max(s.splat(0.0));
    let share = stretch / (length * weight.max(tiny));
    ([share * wa, share * wb], lambda)
}
