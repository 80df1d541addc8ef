//! IrregularBends, as many at a time as there are lanes: each resists that its two threads bend where they meet.
//!
//! ```text
//! a ── m ── b     C = a − 2 m + b − rest n,   λ = −C / (w_a + 4 w_m + w_b + α̃),   Δx = w c λ
//! ```
//! These are hinges, see `hinges`, that all have the same weights.

use crate::math::TINY;
use crate::math::columns::Columns;
use crate::math::simd::{Float, LANES, Level, Scalar, Simd, vectored};
use crate::model::hardening::Softening;
use crate::model::irregular_bend::IrregularBends;
use crate::solver::particle_stage::access::{
    ParticleAccess, ParticleSlices, gather_particles, scatter_positions,
};
use crate::state::particles::Particles;
use core::ops::Range;

/// What a substep of bending works with.
#[derive(Clone, Copy)]
pub(crate) struct IrregularStep<'a> {
    pub elements: &'a IrregularBends,
    /// Stiffness of an element times the square of the substep [kg].
    pub stiffness: f32,
    /// The share of where particles were that is taken off where they are, for damping.
    pub start_share: f32,
    /// Where the substep began: where particles were led to, and by which way.
    pub predicted: &'a Columns,
    pub displacement: &'a Columns,
    /// What elements are bent by at rest along the weft and along the warp [m]; none if none is.
    pub rest: Option<[&'a [f32]; 2]>,
    /// How much softer elements are by what gave way, if they are.
    pub softening: Option<Softening<'a>>,
}

/// Bends all of them once.
pub(crate) fn solve(level: Level, step: IrregularStep<'_>, p: &mut Particles) {
    for group in &step.elements.groups {
        let (own, rest) = (group.range(), step.rest.map(|rest| rest[group.kind]));
        if group.is_colored {
            abreast(level, step, own, rest, p);
        } else {
            one_by_one(step, own, rest, p);
        }
    }
}

vectored! {
    fn abreast(step: IrregularStep<'_>, own: Range<usize>, rest: Option<&[f32]>, p: &mut Particles)
        = bend_color, Avx2, one_by_one
}

fn one_by_one(step: IrregularStep<'_>, own: Range<usize>, rest: Option<&[f32]>, p: &mut Particles) {
    bend_color(Scalar, step, own, rest, p);
}

/// IrregularBends no two of which share a particle, or one after the other.
#[inline(always)]
fn bend_color<S: Simd>(
    s: S,
    step: IrregularStep<'_>,
    own: Range<usize>,
    rest: Option<&[f32]>,
    p: &mut Particles,
) {
    let sheet = &mut ParticleSlices::new(p);
    let whole = own.start + own.len() / S::LANES * S::LANES;
    for at in (own.start..whole).step_by(S::LANES) {
        bend_some(s, step, at, rest, sheet);
    }
    for at in whole..own.end {
        bend_some(Scalar, step, at, rest, sheet);
    }
}

/// As many elbows as there are lanes.
#[inline(always)]
fn bend_some<S: Simd, P: ParticleAccess>(
    s: S,
    step: IrregularStep<'_>,
    first: usize,
    rest: Option<&[f32]>,
    spots: &mut P,
) {
    let (elbows, own) = (step.elements, first..first + S::LANES);
    let (a, middle) = (&elbows.a[own.clone()], &elbows.middle[own.clone()]);
    let (b, woven) = (&elbows.b[own.clone()], &elbows.element[own]);
    let ((xa, wa), (xm, wm)) = (gather_particles(s, spots, a), gather_particles(s, spots, middle));
    let (xb, wb) = gather_particles(s, spots, b);
    let mut bow = bow(s, xa, xm, xb);
    if step.start_share > 0.0 {
        take_before(s, step, [a, middle, b], &mut bow);
    }
    if let Some(rest) = rest {
        take_rest(s, rest, woven, 1.0 - step.start_share, &mut bow);
    }
    let (zero, one) = (s.splat(0.0), s.splat(1.0));
    // A middle that is held is stiffer between one end that is held and one that is not, see `plates`.
    let lean = s.select(wa, zero, one) - s.select(wb, zero, one);
    let clamped = s.select(wm, one, one + lean * lean);
    let mut stiffness = s.load(&elbows.area_fraction, first) * clamped * s.splat(step.stiffness);
    if let Some(softening) = step.softening {
        let mut left = [0.0; LANES];
        for (left, at) in left.iter_mut().zip(woven) {
            *left = softening.stiffness_scale(softening.curvature[*at as usize]);
        }
        stiffness = stiffness * s.load(&left, 0);
    }
    let weight = (wa + wb) + s.splat(4.0) * wm;
    let pull = stiffness / (weight * stiffness + one);
    let (to_a, to_middle, to_b) = (wa * pull, s.splat(2.0) * wm * pull, wb * pull);
    let (mut ya, mut ym, mut yb) = (xa, xm, xb);
    for axis in 0..3 {
        ya[axis] = xa[axis] - bow[axis] * to_a;
        ym[axis] = xm[axis] + bow[axis] * to_middle;
        yb[axis] = xb[axis] - bow[axis] * to_b;
    }
    scatter_positions(s, spots, a, ya);
    scatter_positions(s, spots, middle, ym);
    scatter_positions(s, spots, b, yb);
}

/// How far from straight three points are, twice the way from their middle to the line between the others.
#[inline(always)]
fn bow<S: Simd>(s: S, a: [S::F; 3], middle: [S::F; 3], b: [S::F; 3]) -> [S::F; 3] {
    let (two, mut bow) = (s.splat(2.0), a);
    for axis in 0..3 {
        bow[axis] = (a[axis] + b[axis]) - two * middle[axis];
    }
    bow
}

/// Takes off a share of how bent they were when the substep began.
#[inline(always)]
fn take_before<S: Simd>(s: S, step: IrregularStep<'_>, at: [&[u32]; 3], bow_now: &mut [S::F; 3]) {
    let mut starts = [[s.splat(0.0); 3]; 3];
    for (start, at) in starts.iter_mut().zip(at) {
        for (axis, start) in start.iter_mut().enumerate() {
            let (predicted, way) = (step.predicted.all()[axis], step.displacement.all()[axis]);
            let mut lanes = [0.0; LANES];
            for lane in 0..S::LANES {
                let particle = at[lane] as usize;
                lanes[lane] = predicted[particle] - way[particle];
            }
            *start = s.load(&lanes, 0);
        }
    }
    let [a, middle, b] = starts;
    let was = bow(s, a, middle, b);
    for axis in 0..3 {
        bow_now[axis] = bow_now[axis] - was[axis] * s.splat(step.start_share);
    }
}

/// Takes off a share of what they are bent by at rest. There is no edge to be square to: so much is taken
/// off to whichever side they are bent.
#[inline(always)]
fn take_rest<S: Simd>(s: S, rest: &[f32], woven: &[u32], share: f32, bow: &mut [S::F; 3]) {
    let mut lanes = [0.0; LANES];
    for lane in 0..S::LANES {
        lanes[lane] = rest[woven[lane] as usize].abs();
    }
    let length = (bow[0] * bow[0] + bow[1] * bow[1] + bow[2] * bow[2]).sqrt();
    let part = s.load(&lanes, 0) * s.splat(share) / length.max(s.splat(TINY));
    for axis in 0..3 {
        bow[axis] = bow[axis] - bow[axis] * part;
    }
}
