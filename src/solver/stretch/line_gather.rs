//! Gather and scatter of chains whose particles are at arbitrary indices.
//!
//! ```text
//! columns or interleaved  ──gather──▶  points [x, y, z, w]  ──gather_step──▶  LineStep (8 lanes)
//!                         ◀─scatter──                       ◀─scatter_block─
//! ```
//! A particle is one load of `[x, y, z, w]`, and eight of them are transposed to lanes. Entry 0 of
//! the points is a sentinel: lanes without a link read and write it, so that no lane needs a
//! branch.
//!
//! Reads positions, inverse masses and `scratch.predicted − scratch.displacement`, the positions at
//! the start of the substep; writes `scratch.lines` and at the end the positions.
//! Invariant: the particle with index i has the entry i + 1.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::simd::{
    Float, LANES, Level, Scalar, Simd, gather_transpose, scatter_transpose, vectored,
};
use crate::model::chain_blocks;
use crate::solver::stretch::line_step::{
    LineStep, clamp_length, length, limit_excess, max_component,
};
use crate::solver::world::World;

/// Copies the particles to `scratch.lines.points`, and their positions at the start of the substep
/// if links are rigid.
pub(crate) fn gather(world: &mut World, is_rigid: bool) {
    let (level, p, scratch) = (world.level, &world.particles, &mut world.scratch);
    let s = &mut scratch.lines;
    s.points.resize(p.len() + 1, [0.0; 4]);
    s.points[0] = [0.0; 4];
    if scratch.interleaved.is_current {
        let particles = scratch.interleaved.points.iter().zip(&p.w);
        for (point, ([x, y, z, _], w)) in s.points[1..].iter_mut().zip(particles) {
            *point = [*x, *y, *z, *w];
        }
    } else {
        interleave(level, p.x.slices(), &p.w, &mut s.points[1..]);
    }
    s.start_points.clear();
    if is_rigid {
        s.start_points.resize(p.len() + 1, [0.0; 4]);
        interleave_starts(
            level,
            scratch.predicted.slices(),
            scratch.displacement.slices(),
            &mut s.start_points[1..],
        );
    }
}

/// Gathered particles, after a sentinel.
#[derive(Clone, Copy)]
pub(crate) struct LinePoints<'a> {
    /// `[x, y, z, w]` now.
    pub points: &'a [[f32; 4]],
    /// `[x, y, z, 0]` at the start of the substep; empty if links are compliant.
    pub start_points: &'a [[f32; 4]],
}

impl LinePoints<'_> {
    /// Gathers the positions, inverse masses and target lengths of `S::LANES` lanes of a step.
    ///
    /// `start` holds the positions at the start of the substep: of the step before on entry, of
    /// this step on return.
    #[inline(always)]
    pub fn gather_step<S: Simd, const SOFT: bool>(
        &self,
        s: S,
        first: usize,
        start: &mut [S::F; 4],
        chain_step: &chain_blocks::ChainStep,
        step: &mut LineStep,
    ) {
        let to = gather_transpose(s, self.points, &chain_step.to[first..]);
        for (lanes, to) in step.to.iter_mut().zip(to) {
            s.store(lanes, first, to);
        }
        if SOFT {
            return step.set_rest_target(s, first, &chain_step.rest);
        }
        let last = *start;
        *start = gather_transpose(s, self.start_points, &chain_step.to[first..]);
        let span = [start[0] - last[0], start[1] - last[1], start[2] - last[2]];
        step.set_relaxed_target(s, first, length(s, span), &chain_step.rest);
    }
}

vectored! {
    /// Gathers a whole block of rigid links.
    pub(crate) fn gather_rigid(
        block: &[chain_blocks::ChainStep],
        points: LinePoints<'_>,
        steps: &mut [LineStep],
    ) = gather_lanes::<_, false>, gather_scalar::<false>
}

vectored! {
    /// Gathers a whole block of compliant links.
    pub(crate) fn gather_soft(
        block: &[chain_blocks::ChainStep],
        points: LinePoints<'_>,
        steps: &mut [LineStep],
    ) = gather_lanes::<_, true>, gather_scalar::<true>
}

fn gather_scalar<const SOFT: bool>(
    block: &[chain_blocks::ChainStep],
    points: LinePoints<'_>,
    steps: &mut [LineStep],
) {
    gather_lanes::<_, SOFT>(Scalar, block, points, steps);
}

#[inline(always)]
fn gather_lanes<S: Simd, const SOFT: bool>(
    s: S,
    block: &[chain_blocks::ChainStep],
    points: LinePoints<'_>,
    steps: &mut [LineStep],
) {
    for first in (0..LANES).step_by(S::LANES) {
        let mut start = [s.splat(0.0); 4];
        for (chain_step, step) in block.iter().zip(&mut *steps) {
            points.gather_step::<S, SOFT>(s, first, &mut start, chain_step, step);
        }
    }
}

/// Displaces the particles of a block; none moves farther than the rest length of its link.
pub(crate) fn scatter_block(
    level: Level,
    block: &[chain_blocks::ChainStep],
    steps: &[LineStep],
    points: &mut [[f32; 4]],
) {
    let mut may_exceed = false;
    scatter_unclamped(level, block, steps, points, &mut may_exceed);
    if may_exceed {
        scatter_clamped(block, steps, points, &mut may_exceed);
    }
}

vectored! {
    /// Displaces the particles of a block without a limit, and sets `may_exceed` if one may move
    /// farther than its limit; then [`scatter_clamped`] must repeat it.
    fn scatter_unclamped(
        block: &[chain_blocks::ChainStep],
        steps: &[LineStep],
        points: &mut [[f32; 4]],
        may_exceed: &mut bool,
    ) = scatter_lanes, scatter_clamped
}

#[inline(always)]
fn scatter_lanes<S: Simd>(
    s: S,
    block: &[chain_blocks::ChainStep],
    steps: &[LineStep],
    points: &mut [[f32; 4]],
    may_exceed: &mut bool,
) {
    for first in (0..LANES).step_by(S::LANES) {
        let (mut u, mut excess) = ([s.splat(0.0); 3], s.splat(0.0));
        for (chain_step, step) in block.iter().zip(steps) {
            u = step.displacement(s, first, u);
            excess = limit_excess(s, max_component(s, u), &chain_step.rest, first).max(excess);
            let [x, y, z] = step.displaced(s, first, u);
            scatter_transpose(
                s,
                points,
                &chain_step.to[first..],
                [x, y, z, s.load(&step.to[3], first)],
            );
        }
        *may_exceed |= s.any_positive(excess);
    }
}

#[inline(never)]
fn scatter_clamped(
    block: &[chain_blocks::ChainStep],
    steps: &[LineStep],
    points: &mut [[f32; 4]],
    _: &mut bool,
) {
    for lane in 0..LANES {
        let mut u = [0.0; 3];
        for (chain_step, step) in block.iter().zip(steps) {
            u = step.displacement(Scalar, lane, u);
            let limit = chain_step.rest[lane].abs();
            let [x, y, z] = step.displaced(Scalar, lane, clamp_length(u, limit));
            points[chain_step.to[lane] as usize] = [x, y, z, step.to[3][lane]];
        }
    }
}

/// Copies the positions of all particles back to the layout that they came from.
pub(crate) fn scatter(world: &mut World) {
    let points = &world.scratch.lines.points[1..];
    if world.scratch.interleaved.is_current {
        let interleaved = &mut world.scratch.interleaved.points;
        for (to, [x, y, z, _]) in interleaved.iter_mut().zip(points) {
            *to = [*x, *y, *z, 0.0];
        }
    } else {
        deinterleave(world.level, points, world.particles.x.slices_mut());
    }
}

vectored! {
    /// Interleaves columns of positions and inverse masses.
    fn interleave(columns: [&[f32]; 3], w: &[f32], points: &mut [[f32; 4]])
        = interleave_lanes, interleave_scalar
}

vectored! {
    /// Interleaves predicted positions minus displacements.
    fn interleave_starts(
        predicted: [&[f32]; 3],
        displacement: [&[f32]; 3],
        points: &mut [[f32; 4]],
    ) = interleave_starts_lanes, interleave_starts_scalar
}

vectored! {
    /// Copies positions from interleaved points to columns.
    fn deinterleave(points: &[[f32; 4]], columns: [&mut [f32]; 3])
        = deinterleave_lanes, deinterleave_scalar
}

#[inline(always)]
fn interleave_lanes<S: Simd>(s: S, [x, y, z]: [&[f32]; 3], w: &[f32], points: &mut [[f32; 4]]) {
    // Equal lengths let the compiler drop all bounds checks but one.
    let count = points.len();
    let (x, y, z, w) = (&x[..count], &y[..count], &z[..count], &w[..count]);
    let mut first = 0;
    while first + S::LANES <= count {
        let numbers = [s.load(x, first), s.load(y, first), s.load(z, first), s.load(w, first)];
        scatter_transpose(s, &mut points[first..first + S::LANES], &CONSECUTIVE, numbers);
        first += S::LANES;
    }
    interleave_scalar([&x[first..], &y[first..], &z[first..]], &w[first..], &mut points[first..]);
}

fn interleave_scalar([x, y, z]: [&[f32]; 3], w: &[f32], points: &mut [[f32; 4]]) {
    for ((((point, x), y), z), w) in points.iter_mut().zip(x).zip(y).zip(z).zip(w) {
        *point = [*x, *y, *z, *w];
    }
}

#[inline(always)]
fn interleave_starts_lanes<S: Simd>(
    s: S,
    predicted: [&[f32]; 3],
    displacement: [&[f32]; 3],
    points: &mut [[f32; 4]],
) {
    let count = points.len();
    let [predicted, displacement] =
        [predicted, displacement].map(|columns| columns.map(|column| &column[..count]));
    let mut first = 0;
    while first + S::LANES <= count {
        let mut numbers = [s.splat(0.0); 4];
        for axis in 0..3 {
            numbers[axis] = s.load(predicted[axis], first) - s.load(displacement[axis], first);
        }
        scatter_transpose(s, &mut points[first..first + S::LANES], &CONSECUTIVE, numbers);
        first += S::LANES;
    }
    interleave_starts_scalar(
        predicted.map(|column| &column[first..]),
        displacement.map(|column| &column[first..]),
        &mut points[first..],
    );
}

fn interleave_starts_scalar(
    predicted: [&[f32]; 3],
    displacement: [&[f32]; 3],
    points: &mut [[f32; 4]],
) {
    for (at, point) in points.iter_mut().enumerate() {
        for axis in 0..3 {
            point[axis] = predicted[axis][at] - displacement[axis][at];
        }
        point[3] = 0.0;
    }
}

#[inline(always)]
fn deinterleave_lanes<S: Simd>(s: S, points: &[[f32; 4]], columns: [&mut [f32]; 3]) {
    let count = points.len();
    let [x, y, z] = columns;
    let (x, y, z) = (&mut x[..count], &mut y[..count], &mut z[..count]);
    let mut first = 0;
    while first + S::LANES <= count {
        let numbers = gather_transpose(s, &points[first..first + S::LANES], &CONSECUTIVE);
        s.store(x, first, numbers[0]);
        s.store(y, first, numbers[1]);
        s.store(z, first, numbers[2]);
        first += S::LANES;
    }
    deinterleave_scalar(&points[first..], [&mut x[first..], &mut y[first..], &mut z[first..]]);
}

fn deinterleave_scalar(points: &[[f32; 4]], [x, y, z]: [&mut [f32]; 3]) {
    for (((point, x), y), z) in points.iter().zip(x).zip(y).zip(z) {
        [*x, *y, *z, _] = *point;
    }
}

/// The indices of eight neighbouring points.
const CONSECUTIVE: [u32; LANES] = [0, 1, 2, 3, 4, 5, 6, 7];
