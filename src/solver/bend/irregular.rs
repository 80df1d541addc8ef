//! Bending of grid elements that left the regular layout after a tear, in SIMD lanes.
//!
//! ```text
//! a ── m ── b     C = a − 2 m + b − rest n,   Δλ = −(C + α̃ λ) / (w_a + 4 w_m + w_b + α̃)
//!                 Δx = w c Δλ
//! ```
//! Method: XPBD per element, as in `hinge`, with the fixed weights (1, −2, 1). Elements of one
//! colour share no particle and run in lanes; elements without a colour run one after the other.
//!
//! Reads the elements, folds and start positions; writes positions and the multipliers λ.
//! Invariant: the order of the elements of a colour does not change the result.

use crate::math::TINY;
use crate::math::columns::Columns;
use crate::math::simd::{Float, LANES, Level, Scalar, Simd, vectored};
use crate::model::bend_scale::BendScale;
use crate::model::irregular_bend::IrregularBends;
use crate::solver::bend::banded::VectorColumns;
use crate::solver::particle_stage::access::{
    ParticleAccess, ParticleSlices, gather_particles, scatter_positions,
};
use crate::solver::stretch::sweep_order::SweepOrder;
use crate::state::particles::Particles;
use core::ops::Range;

/// Elements and parameters of one substep.
#[derive(Clone, Copy)]
pub(crate) struct IrregularStep<'a> {
    pub elements: &'a IrregularBends,
    /// Stiffness of an element times the squared substep [kg].
    pub stiffness: f32,
    /// Share of the start positions to subtract, for damping; see `HingeStep`.
    pub start_share: f32,
    /// Predicted positions and displacements; their difference is the start position.
    pub predicted: &'a Columns,
    pub displacement: &'a Columns,
    /// Rest curvature of the elements along weft and warp [m]; `None` without folds.
    pub rest: Option<[&'a [f32]; 2]>,
    pub scale: BendScale<'a>,
}

/// Projects all irregular elements once, group by group in the given order. The multipliers
/// `lambda` [kg m] continue from the last sweep.
pub(crate) fn solve(
    level: Level,
    step: IrregularStep<'_>,
    order: SweepOrder,
    lambda: &mut VectorColumns,
    p: &mut Particles,
) {
    let groups = &step.elements.groups;
    for at in 0..groups.len() {
        let group = match order {
            SweepOrder::Forward => &groups[at],
            SweepOrder::Backward => &groups[groups.len() - 1 - at],
        };
        let (own, rest) = (group.range(), step.rest.map(|rest| rest[group.kind]));
        if group.is_colored {
            solve_color(level, step, own, rest, lambda, p);
        } else {
            solve_in_turn(step, own, order, rest, lambda, p);
        }
    }
}

vectored! {
    /// Projects elements of which no two share a particle.
    fn solve_color(
        step: IrregularStep<'_>,
        own: Range<usize>,
        rest: Option<&[f32]>,
        lambda: &mut VectorColumns,
        p: &mut Particles,
    ) = solve_color_lanes, solve_scalar
}

/// Projects elements of one colour without SIMD.
fn solve_scalar(
    step: IrregularStep<'_>,
    own: Range<usize>,
    rest: Option<&[f32]>,
    lambda: &mut VectorColumns,
    p: &mut Particles,
) {
    solve_color_lanes(Scalar, step, own, rest, lambda, p);
}

/// Projects elements one after the other, in the given order.
fn solve_in_turn(
    step: IrregularStep<'_>,
    own: Range<usize>,
    order: SweepOrder,
    rest: Option<&[f32]>,
    lambda: &mut VectorColumns,
    p: &mut Particles,
) {
    let slices = &mut ParticleSlices::new(p);
    for k in 0..own.len() {
        let at = match order {
            SweepOrder::Forward => own.start + k,
            SweepOrder::Backward => own.end - 1 - k,
        };
        project_lanes(Scalar, step, at, rest, lambda, slices);
    }
}

#[inline(always)]
fn solve_color_lanes<S: Simd>(
    s: S,
    step: IrregularStep<'_>,
    own: Range<usize>,
    rest: Option<&[f32]>,
    lambda: &mut VectorColumns,
    p: &mut Particles,
) {
    let slices = &mut ParticleSlices::new(p);
    let whole = own.start + own.len() / S::LANES * S::LANES;
    for at in (own.start..whole).step_by(S::LANES) {
        project_lanes(s, step, at, rest, lambda, slices);
    }
    for at in whole..own.end {
        project_lanes(Scalar, step, at, rest, lambda, slices);
    }
}

/// Projects one element per lane, from `first` on.
#[inline(always)]
fn project_lanes<S: Simd, P: ParticleAccess>(
    s: S,
    step: IrregularStep<'_>,
    first: usize,
    rest: Option<&[f32]>,
    lambda: &mut VectorColumns,
    particles: &mut P,
) {
    let (elements, own) = (step.elements, first..first + S::LANES);
    let (a, middle) = (&elements.a[own.clone()], &elements.middle[own.clone()]);
    let (b, element) = (&elements.b[own.clone()], &elements.element[own]);
    let ((xa, wa), (xm, wm)) =
        (gather_particles(s, particles, a), gather_particles(s, particles, middle));
    let (xb, wb) = gather_particles(s, particles, b);
    let mut c = second_difference(s, xa, xm, xb);
    if step.start_share > 0.0 {
        subtract_start(s, step, [a, middle, b], &mut c);
    }
    if let Some(rest) = rest {
        subtract_rest(s, rest, element, 1.0 - step.start_share, &mut c);
    }
    let (zero, one) = (s.splat(0.0), s.splat(1.0));
    // A held middle between one held and one free end doubles the stiffness, as in
    // `plate::clamped`.
    let clamped_ends = s.select(wa, zero, one) - s.select(wb, zero, one);
    let clamped = s.select(wm, one, one + clamped_ends * clamped_ends);
    let mut stiffness = s.load(&elements.area_fraction, first) * clamped * s.splat(step.stiffness);
    if !step.scale.is_one() {
        let mut scales = [0.0; LANES];
        for (scale, (element, middle)) in scales.iter_mut().zip(element.iter().zip(middle)) {
            *scale = step.scale.of_element(*element as usize, &[*middle]);
        }
        stiffness = stiffness * s.load(&scales, 0);
    }
    let weight = (wa + wb) + s.splat(4.0) * wm;
    let share = one / (weight * stiffness + one);
    let (mut ya, mut ym, mut yb) = (xa, xm, xb);
    for (axis, lambda) in lambda.iter_mut().enumerate() {
        let last = s.load(lambda, first);
        let change = (c[axis] * stiffness + last) * share;
        s.store(lambda, first, last - change);
        ya[axis] = xa[axis] - change * wa;
        ym[axis] = xm[axis] + change * (s.splat(2.0) * wm);
        yb[axis] = xb[axis] - change * wb;
    }
    scatter_positions(s, particles, a, ya);
    scatter_positions(s, particles, middle, ym);
    scatter_positions(s, particles, b, yb);
}

/// Second difference a − 2 m + b of three points [m]; zero if m is the midpoint of a and b.
#[inline(always)]
fn second_difference<S: Simd>(s: S, a: [S::F; 3], middle: [S::F; 3], b: [S::F; 3]) -> [S::F; 3] {
    let (two, mut c) = (s.splat(2.0), a);
    for axis in 0..3 {
        c[axis] = (a[axis] + b[axis]) - two * middle[axis];
    }
    c
}

/// Subtracts `start_share` of the second difference at the start of the substep.
#[inline(always)]
fn subtract_start<S: Simd>(
    s: S,
    step: IrregularStep<'_>,
    at: [&[u32]; 3],
    current: &mut [S::F; 3],
) {
    let mut starts = [[s.splat(0.0); 3]; 3];
    for (start, at) in starts.iter_mut().zip(at) {
        for (axis, start) in start.iter_mut().enumerate() {
            let (predicted, displacement) =
                (step.predicted.slices()[axis], step.displacement.slices()[axis]);
            let mut lanes = [0.0; LANES];
            for lane in 0..S::LANES {
                let particle = at[lane] as usize;
                lanes[lane] = predicted[particle] - displacement[particle];
            }
            *start = s.load(&lanes, 0);
        }
    }
    let [a, middle, b] = starts;
    let at_start = second_difference(s, a, middle, b);
    for axis in 0..3 {
        current[axis] = current[axis] - at_start[axis] * s.splat(step.start_share);
    }
}

/// Subtracts a share of the rest curvature. These elements have no normal, so the rest curvature
/// takes the direction in which the element is bent now.
#[inline(always)]
fn subtract_rest<S: Simd>(s: S, rest: &[f32], element: &[u32], share: f32, c: &mut [S::F; 3]) {
    let mut lanes = [0.0; LANES];
    for lane in 0..S::LANES {
        lanes[lane] = rest[element[lane] as usize].abs();
    }
    let length = (c[0] * c[0] + c[1] * c[1] + c[2] * c[2]).sqrt();
    let part = s.load(&lanes, 0) * s.splat(share) / length.max(s.splat(TINY));
    for axis in 0..3 {
        c[axis] = c[axis] - c[axis] * part;
    }
}
