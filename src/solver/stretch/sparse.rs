//! SIMD kernel for sparse links: links at arbitrary indices, whose ends are gathered and scattered.
//!
//! These are the links that left the rows of a grid (irregular links) and those that tears made
//! (dynamic links). They have colours of their own. Links of a batch that could not be coloured go
//! one by one, in sweep order.
//!
//! Reads `SparseLinks` (ends, rest lengths, weights) and the compliances of the list that they
//! index; writes positions and λ.
//! Invariant: all arithmetic is `link_projection::compute_correction`, so the bits are those of the
//! scalar code; the links of a colour share no particle, so lanes may go in any order.

use crate::math::simd::{LANES, Level, Scalar, Simd, vectored};
use crate::model::links::SoftLinks;
use crate::model::sparse_links::SparseLinks;
use crate::solver::particle_stage::access::{
    ParticleAccess, ParticleSlices, gather_particles, scatter_positions,
};
use crate::solver::particle_stage::interleaved_particles::InterleavedParticles;
use crate::solver::stretch::link_projection::{BOUND, RIGID, SOFT, compute_correction};
use crate::solver::stretch::sweep_order::SweepOrder;
use crate::state::particles::Particles;

/// The sparse links of a batch, and the columns of the list that `link` indexes.
pub(crate) struct SparseColor<'a> {
    a: &'a [u32],
    b: &'a [u32],
    rest: &'a [f32],
    /// Weights of the ends; empty under `BOUND`.
    ends: [&'a [f32]; 2],
    link: &'a [u32],
    compliance: &'a [f32],
    lambda: &'a mut [f32],
}

/// Whether the links of a colour are solved side by side. On WebAssembly they are not: the kernels
/// would make the module larger, and few links are sparse.
const HAS_LANES: bool = cfg!(not(target_arch = "wasm32"));

/// A particle layout with a SIMD kernel for sparse links.
pub(crate) trait SparseLayout: ParticleAccess {
    /// Solves links that share no particle, under the law `law`.
    fn solve_simd(&mut self, level: Level, color: SparseColor<'_>, law: u8, scale: f32);
}

impl SparseLayout for Particles {
    fn solve_simd(&mut self, level: Level, color: SparseColor<'_>, law: u8, scale: f32) {
        solve_columns(level, color, self, law, scale);
    }
}

impl SparseLayout for InterleavedParticles {
    fn solve_simd(&mut self, level: Level, color: SparseColor<'_>, law: u8, scale: f32) {
        solve_interleaved(level, color, self, law, scale);
    }
}

/// Solves one batch of sparse links. For `scale` see `link_projection::compute_correction`.
pub(crate) fn solve<const LAW: u8, P: SparseLayout>(
    level: Level,
    sparse: &SparseLinks,
    (batch, order): (usize, SweepOrder),
    links: SoftLinks<'_>,
    particles: &mut P,
    scale: f32,
) {
    let (own, is_colored) = sparse.batch(batch);
    if own.is_empty() {
        return;
    }
    // The strain limit may run before the weights of new links are computed.
    let ends = if LAW == BOUND { 0..0 } else { own.clone() };
    let mut color = SparseColor {
        a: &sparse.a[own.clone()],
        b: &sparse.b[own.clone()],
        rest: &sparse.rest[own.clone()],
        ends: [&sparse.w[0][ends.clone()], &sparse.w[1][ends]],
        link: &sparse.link[own],
        compliance: links.compliance,
        lambda: links.lambda,
    };
    if is_colored && HAS_LANES {
        return particles.solve_simd(level, color, LAW, scale);
    }
    let count = color.a.len();
    for number in 0..count {
        let at = if order == SweepOrder::Forward { number } else { count - 1 - number };
        color.solve_link::<P, LAW>(at, particles, scale);
    }
}

vectored! {
    fn solve_columns(color: SparseColor<'_>, p: &mut Particles, law: u8, scale: f32)
        = columns_lanes, columns_scalar
}

#[inline(always)]
fn columns_lanes<S: Simd>(s: S, color: SparseColor<'_>, p: &mut Particles, law: u8, scale: f32) {
    solve_law(s, color, &mut ParticleSlices::new(p), law, scale);
}

fn columns_scalar(color: SparseColor<'_>, p: &mut Particles, law: u8, scale: f32) {
    columns_lanes(Scalar, color, p, law, scale);
}

vectored! {
    fn solve_interleaved(
        color: SparseColor<'_>,
        particles: &mut InterleavedParticles,
        law: u8,
        scale: f32,
    ) = solve_law, interleaved_scalar
}

fn interleaved_scalar(
    color: SparseColor<'_>,
    particles: &mut InterleavedParticles,
    law: u8,
    scale: f32,
) {
    solve_law(Scalar, color, particles, law, scale);
}

#[inline(always)]
fn solve_law<S: Simd, P: ParticleAccess>(
    s: S,
    color: SparseColor<'_>,
    particles: &mut P,
    law: u8,
    scale: f32,
) {
    match law {
        SOFT => solve_color::<S, P, SOFT>(s, color, particles, scale),
        RIGID => solve_color::<S, P, RIGID>(s, color, particles, scale),
        _ => solve_color::<S, P, BOUND>(s, color, particles, scale),
    }
}

#[inline(always)]
fn solve_color<S: Simd, P: ParticleAccess, const LAW: u8>(
    s: S,
    mut color: SparseColor<'_>,
    particles: &mut P,
    scale: f32,
) {
    let count = color.a.len();
    let whole = count / S::LANES * S::LANES;
    for at in (0..whole).step_by(S::LANES) {
        color.solve_chunk::<S, P, LAW>(s, at, particles, scale);
    }
    for at in whole..count {
        color.solve_link::<P, LAW>(at, particles, scale);
    }
}

impl SparseColor<'_> {
    /// Solves link number `at`. Compiled once, not once per caller.
    #[inline(never)]
    fn solve_link<P: ParticleAccess, const LAW: u8>(
        &mut self,
        at: usize,
        particles: &mut P,
        scale: f32,
    ) {
        self.solve_chunk::<_, P, LAW>(Scalar, at, particles, scale);
    }

    /// Solves `S::LANES` links, from `first` on.
    #[inline(always)]
    fn solve_chunk<S: Simd, P: ParticleAccess, const LAW: u8>(
        &mut self,
        s: S,
        first: usize,
        particles: &mut P,
        scale: f32,
    ) {
        let own = first..first + S::LANES;
        let (a, b) = (&self.a[own.clone()], &self.b[own.clone()]);
        let ((xa, wa), (xb, wb)) =
            (gather_particles(s, particles, a), gather_particles(s, particles, b));
        let weights = if LAW == BOUND {
            [wa, wb]
        } else {
            [s.load(self.ends[0], first), s.load(self.ends[1], first)]
        };
        let link = &self.link[own];
        let (mut compliance, mut lambda) = ([0.0; LANES], [0.0; LANES]);
        if LAW == SOFT {
            for lane in 0..S::LANES {
                compliance[lane] = self.compliance[link[lane] as usize];
                lambda[lane] = self.lambda[link[lane] as usize];
            }
        }
        let (compliance, old_lambda) = (s.load(&compliance, 0), s.load(&lambda, 0));
        let span = [xb[0] - xa[0], xb[1] - xa[1], xb[2] - xa[2]];
        let rest = s.load(self.rest, first);
        let ([to_a, to_b], new_lambda) =
            compute_correction::<LAW, _>(s, span, weights, rest, compliance, old_lambda, scale);
        let (mut ya, mut yb) = (xa, xb);
        for axis in 0..3 {
            ya[axis] = xa[axis] + span[axis] * to_a;
            yb[axis] = xb[axis] - span[axis] * to_b;
        }
        scatter_positions(s, particles, a, ya);
        scatter_positions(s, particles, b, yb);
        if LAW == SOFT {
            s.store(&mut lambda, 0, new_lambda);
            for lane in 0..S::LANES {
                self.lambda[link[lane] as usize] = lambda[lane];
            }
        }
    }
}
