//! SIMD kernel of the line solver: the two tridiagonal systems of a block of chains.
//!
//! For the equations see `line_solver`. The forward pass eliminates the first system (tensions);
//! the backward pass substitutes the tensions and, in the same loop, eliminates the second system
//! (displacements). The substitution of the displacements is part of the scatter:
//!
//! ```text
//! forward    i = 1…N:  s_i = c_i / pivot₋,  pivot_i = d_i − s_i c_i,  rhs_i = C_i + s_i rhs₋
//! backward   i = N…1:  λ_i = (rhs_i + c₊ λ₊) / pivot_i,  g = w / (1 + w (q_i + hold₊))
//!                      share_i = g q_i,   offset_i = g (pull₊ − t_i n_i)
//!                      pull_i = t_i n_i + q_i offset_i,   hold_i = q_i (1 − share_i)
//! scatter    i = 1…N:  u_i = share_i u₋ + offset_i
//! ```
//! with d = (w₋ + w₊)(1 + REGULARIZATION) + α̃ and c = w₋ (n₋·n).
//!
//! Reads gathered positions, weights and targets (`LineStep`); writes the shares and offsets into
//! the steps, and −λ of compliant links.
//! Invariant: lanes do not interact. Where a piece of a chain begins, and behind its last link,
//! there is a step without a link (rest ≤ 0): its λ, q and coupling are 0, so it separates the
//! systems.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::TINY;
use crate::math::simd::{Float, LANES, LaneArray, Scalar, Simd, vectored};
use crate::mesh::NONE;
use crate::model::chain_blocks;
use crate::model::links::SoftLinks;
use crate::solver::stretch::line_gather::LinePoints;
use crate::solver::stretch::line_step::{Lanes3, LineStep};

/// Added to the diagonal as a share of it, and the least pivot as a share of w₋ + w₊: the system of
/// a straight chain with two held ends is singular.
const REGULARIZATION: f32 = 1.0e-6;

/// Defines a function that solves a block: with compliance or without, gathering it or gathered
/// before.
macro_rules! solving {
    ($name:ident, $soft:literal, $gathers:literal) => {
        vectored! {
            pub(crate) fn $name(
                block: &[chain_blocks::ChainStep],
                points: LinePoints<'_>,
                steps: &mut [LineStep],
                links: &mut SoftLinks<'_>,
                scale: f32,
            ) = solve_lanes::<_, $soft, $gathers>, solve_scalar::<$soft, $gathers>
        }
    };
}

solving!(solve_rigid, false, false);
solving!(solve_soft, true, false);
solving!(gather_solve_rigid, false, true);
solving!(gather_solve_soft, true, true);

/// Solves one chain at a time.
fn solve_scalar<const SOFT: bool, const GATHERS: bool>(
    block: &[chain_blocks::ChainStep],
    points: LinePoints<'_>,
    steps: &mut [LineStep],
    links: &mut SoftLinks<'_>,
    scale: f32,
) {
    solve_lanes::<_, SOFT, GATHERS>(Scalar, block, points, steps, links, scale);
}

/// Solves all lanes of a block; `steps` begins with the sentinel.
///
/// Two groups of lanes are interleaved if the block has enough lanes: each step depends on the one
/// before, so that one group alone leaves the processor waiting for divisions and roots.
#[inline(always)]
fn solve_lanes<S: Simd, const SOFT: bool, const GATHERS: bool>(
    s: S,
    block: &[chain_blocks::ChainStep],
    points: LinePoints<'_>,
    steps: &mut [LineStep],
    links: &mut SoftLinks<'_>,
    scale: f32,
) {
    let Some((sentinel, steps)) = steps.split_first_mut() else { return };
    let is_double = 2 * S::LANES <= LANES;
    for first in (0..LANES).step_by(2 * S::LANES) {
        let (group, other) = (LaneGroup { s, first }, LaneGroup { s, first: first + S::LANES });
        let (mut forward, mut other_forward) = (group.begin_forward(), group.begin_forward());
        let (mut start, mut other_start) = ([s.splat(0.0); 4], [s.splat(0.0); 4]);
        let mut last = &*sentinel;
        for (chain_step, step) in block.iter().zip(&mut *steps) {
            if GATHERS {
                points.gather_step::<S, SOFT>(s, group.first, &mut start, chain_step, step);
            }
            group.eliminate::<SOFT>(&mut forward, last, (chain_step, step), links, scale);
            if is_double {
                if GATHERS {
                    points.gather_step::<S, SOFT>(
                        s,
                        other.first,
                        &mut other_start,
                        chain_step,
                        step,
                    );
                }
                other.eliminate::<SOFT>(&mut other_forward, last, (chain_step, step), links, scale);
            }
            last = step;
        }
        let (mut backward, mut other_backward) = (group.begin_backward(), group.begin_backward());
        for (chain_step, step) in block.iter().zip(&mut *steps).rev() {
            group.substitute::<SOFT>(&mut backward, (chain_step, step), links);
            if is_double {
                other.substitute::<SOFT>(&mut other_backward, (chain_step, step), links);
            }
        }
    }
}

/// `S::LANES` neighbouring lanes of a block.
#[derive(Clone, Copy)]
struct LaneGroup<S> {
    s: S,
    /// The number of its first lane in the block.
    first: usize,
}

/// The values that the forward pass hands from a step to the next in registers.
struct Forward<F> {
    inv_pivot: F,
    rhs: F,
}

/// The values that the backward pass hands from a step to the one before.
struct Backward<F> {
    /// The coupling times λ of the link after.
    coupled_lambda: F,
    /// The constant part of the pull of the link after on its first end.
    pull: [F; 3],
    /// The stiffness of that pull against a displacement of the end.
    hold: F,
}

impl<S: Simd> LaneGroup<S> {
    /// The entries of these lanes.
    #[inline(always)]
    fn own<'b, T>(&self, step: &'b [T; LANES]) -> &'b [T] {
        &step[self.first..self.first + S::LANES]
    }

    #[inline(always)]
    fn load(&self, lanes: &LaneArray) -> S::F {
        self.s.load(lanes, self.first)
    }

    #[inline(always)]
    fn store(&self, lanes: &mut LaneArray, v: S::F) {
        self.s.store(lanes, self.first, v);
    }

    #[inline(always)]
    fn load3(&self, [x, y, z]: &Lanes3) -> [S::F; 3] {
        [self.load(x), self.load(y), self.load(z)]
    }

    #[inline(always)]
    fn store3(&self, lanes: &mut Lanes3, [x, y, z]: [S::F; 3]) {
        self.store(&mut lanes[0], x);
        self.store(&mut lanes[1], y);
        self.store(&mut lanes[2], z);
    }

    /// The state before the first step.
    #[inline(always)]
    fn begin_forward(&self) -> Forward<S::F> {
        let zero = self.s.splat(0.0);
        Forward { inv_pivot: zero, rhs: zero }
    }

    /// The state behind the last step.
    #[inline(always)]
    fn begin_backward(&self) -> Backward<S::F> {
        let zero = self.s.splat(0.0);
        Backward { coupled_lambda: zero, pull: [zero; 3], hold: zero }
    }

    /// Eliminates the coupling to the link before from the row of this link in the first system.
    #[inline(always)]
    fn eliminate<const SOFT: bool>(
        &self,
        forward: &mut Forward<S::F>,
        last: &LineStep,
        (chain_step, step): (&chain_blocks::ChainStep, &mut LineStep),
        links: &SoftLinks<'_>,
        scale: f32,
    ) {
        let s = self.s;
        let (one, tiny) = (s.splat(1.0), s.splat(TINY));
        let [to_x, to_y, to_z, to_w] = &step.to;
        let [from_x, from_y, from_z, from_w] = &last.to;
        let dx = self.load(to_x) - self.load(from_x);
        let dy = self.load(to_y) - self.load(from_y);
        let dz = self.load(to_z) - self.load(from_z);
        let length = (dx * dx + dy * dy + dz * dz).sqrt().max(tiny);
        let over = one / length;
        let n = [dx * over, dy * over, dz * over];
        self.store3(&mut step.n, n);
        let n_before = self.load3(&last.n);
        let cosine = n[0] * n_before[0] + n[1] * n_before[1] + n[2] * n_before[2];
        let error = length - self.load(&step.target);
        self.store(&mut step.target, length * self.load(&step.inv_target));
        let (rest, last_w) = (self.load(&chain_step.rest), self.load(from_w));
        let coupling = s.select_or_zero(rest, last_w * cosine);
        self.store(&mut step.coupling, coupling);
        let both = last_w + self.load(to_w);
        let mut diagonal = both * s.splat(1.0 + REGULARIZATION);
        if SOFT {
            let softness = self.softness(links, self.own(&chain_step.links), scale);
            diagonal = diagonal + softness;
            let relative = softness * self.load(&step.inv_target);
            self.store(&mut step.relative_compliance, relative);
        }
        let share = coupling * forward.inv_pivot;
        let pivot = (diagonal - share * coupling).max(both * s.splat(REGULARIZATION));
        // There is nothing to solve without a link (rest <= 0) or between two held ends (both = 0).
        forward.inv_pivot = s.select_or_zero(both.min(rest), one / pivot);
        forward.rhs = error + share * forward.rhs;
        self.store(&mut step.inv_pivot, forward.inv_pivot);
        self.store(&mut step.rhs, forward.rhs);
    }

    /// The α̃ of the links of these lanes; 0 without a link.
    #[inline(always)]
    fn softness(&self, links: &SoftLinks<'_>, own: &[u32], scale: f32) -> S::F {
        let mut softness = [0.0; LANES];
        for (softness, link) in softness.iter_mut().zip(own) {
            if *link != NONE {
                *softness = links.compliance[*link as usize] * scale;
            }
        }
        self.s.load(&softness, 0)
    }

    /// Substitutes λ of this link, and eliminates the coupling to the particle after from the row
    /// of this particle in the second system.
    #[inline(always)]
    fn substitute<const SOFT: bool>(
        &self,
        backward: &mut Backward<S::F>,
        (chain_step, step): (&chain_blocks::ChainStep, &mut LineStep),
        links: &mut SoftLinks<'_>,
    ) {
        let s = self.s;
        let (zero, one) = (s.splat(0.0), s.splat(1.0));
        let lambda = (self.load(&step.rhs) + backward.coupled_lambda) * self.load(&step.inv_pivot);
        let mut pull = lambda;
        if SOFT {
            pull = lambda / (one + self.load(&step.relative_compliance) * lambda.max(zero));
        }
        let q = s.select_or_zero(lambda, pull * self.load(&step.inv_target));
        let tension = s.select(lambda, pull * self.load(&step.target), lambda);
        let w = self.load(&step.to[3]);
        let give = w / (one + w * (q + backward.hold));
        let share = give * q;
        let n = self.load3(&step.n);
        let mut offset = [zero; 3];
        for axis in 0..3 {
            let pull = n[axis] * tension;
            offset[axis] = (backward.pull[axis] - pull) * give;
            backward.pull[axis] = pull + q * offset[axis];
        }
        backward.hold = q * (one - share);
        backward.coupled_lambda = self.load(&step.coupling) * lambda;
        self.store3(&mut step.n, offset);
        self.store(&mut step.rhs, share);
        if SOFT {
            let mut lanes = [0.0; LANES];
            s.store(&mut lanes, 0, lambda);
            for (link, lambda) in self.own(&chain_step.links).iter().zip(lanes) {
                if *link != NONE {
                    links.lambda[*link as usize] = -lambda;
                }
            }
        }
    }
}
