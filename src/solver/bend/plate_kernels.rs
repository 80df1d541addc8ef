//! Kernels of `plate`: loops over all elements or particles of a grid, along one axis.
//!
//! Method: one function per step of the solver, vectorised by the compiler; see `plate`.
//!
//! Reads and writes the slices that it is given. The curvatures of elements have a margin of one row
//! and one particle on both sides, so that every particle has an element on each side.
//! Invariant: each function has the bits of its scalar loop.

use crate::math::simd::leveled;
use crate::model::plate_elements::PerKind;

leveled! {
    /// Computes positions less a share of the start positions.
    pub(crate) fn subtract_start(shifted: &mut [f32], x: &[f32], start: [&[f32]; 2], share: f32)
        = subtract_start_lanes
}

#[inline(always)]
fn subtract_start_lanes(
    shifted: &mut [f32],
    x: &[f32],
    [predicted, displacement]: [&[f32]; 2],
    share: f32,
) {
    for (((shifted, x), predicted), displacement) in
        shifted.iter_mut().zip(x).zip(predicted).zip(displacement)
    {
        *shifted = x - (predicted - displacement) * share;
    }
}

leveled! {
    /// Computes the curvature of each weft and warp element, times its weight.
    pub(crate) fn compute_curvature(
        x: &[f32],
        weight: &PerKind<Vec<f32>>,
        curve: &mut PerKind<Vec<f32>>,
        columns: usize,
    ) = compute_curvature_lanes
}

#[inline(always)]
fn compute_curvature_lanes(
    x: &[f32],
    [weft, warp, _]: &PerKind<Vec<f32>>,
    [to_weft, to_warp, _]: &mut PerKind<Vec<f32>>,
    columns: usize,
) {
    let (count, edge) = (x.len(), columns + 1);
    let out = to_weft[edge + 1..edge + count - 1].iter_mut().zip(&weft[1..count - 1]);
    // `windows` needs one base address for three neighbours.
    for ((out, weight), x) in out.zip(x.windows(3)) {
        *out = ((x[0] + x[2]) - 2.0 * x[1]) * weight;
    }
    let inner = columns..count - columns;
    let out = to_warp[edge + columns..edge + count - columns].iter_mut().zip(&warp[inner.clone()]);
    let ends = x[..count - 2 * columns].iter().zip(&x[2 * columns..]);
    for (((out, weight), (a, b)), m) in out.zip(ends).zip(&x[inner]) {
        *out = ((a + b) - 2.0 * m) * weight;
    }
}

leveled! {
    /// Computes the twist of each cell, times its weight.
    pub(crate) fn compute_twist(x: &[f32], weight: &[f32], twist: &mut [f32], columns: usize)
        = compute_twist_lanes
}

#[inline(always)]
fn compute_twist_lanes(x: &[f32], weight: &[f32], twist: &mut [f32], columns: usize) {
    let cells = x.len() - columns - 1;
    let edge = columns + 1;
    let out = twist[edge..edge + cells].iter_mut().zip(&weight[..cells]);
    for (((out, weight), upper), lower) in out.zip(x.windows(2)).zip(x[columns..].windows(2)) {
        *out = ((upper[0] - upper[1]) - (lower[0] - lower[1])) * weight;
    }
}

leveled! {
    /// Subtracts the weighted rest curvature of each element.
    pub(crate) fn subtract_rest(
        weight: &[f32],
        rest: &[f32],
        direction: &[f32],
        share: f32,
        curve: &mut [f32],
    ) = subtract_rest_lanes
}

#[inline(always)]
fn subtract_rest_lanes(
    weight: &[f32],
    rest: &[f32],
    direction: &[f32],
    share: f32,
    curve: &mut [f32],
) {
    for (((curve, weight), rest), direction) in
        curve.iter_mut().zip(weight).zip(rest).zip(direction)
    {
        *curve -= rest * share * direction * weight;
    }
}

leveled! {
    /// Gathers the force on each particle from its elements, times h².
    pub(crate) fn gather_forces(
        curve: &PerKind<Vec<f32>>,
        stiffness: f32,
        force: &mut [f32],
        columns: usize,
    ) = gather_forces_lanes
}

#[inline(always)]
fn gather_forces_lanes(
    [weft, warp, twist]: &PerKind<Vec<f32>>,
    stiffness: f32,
    force: &mut [f32],
    columns: usize,
) {
    let (count, edge) = (force.len(), columns + 1);
    let weft = weft[edge - 1..].windows(3);
    let warp = warp[1..][..count].iter().zip(&warp[edge..]).zip(&warp[edge + columns..]);
    let twist = twist[..count + 1].windows(2).zip(twist[columns..].windows(2));
    for (((force, weft), ((above, warp), below)), (upper, lower)) in
        force.iter_mut().zip(weft).zip(warp).zip(twist)
    {
        let weft_force = (2.0 * weft[1] - weft[0]) - weft[2];
        let warp_force = (2.0 * warp - above) - below;
        let twist_force = (lower[1] - lower[0]) - (upper[1] - upper[0]);
        *force = ((weft_force + warp_force) - twist_force) * stiffness;
    }
}

leveled! {
    /// First Chebyshev step, without a previous displacement.
    pub(crate) fn first_step(
        gain: f32,
        w: &[f32],
        force: &mut [f32],
        displacement: &mut [f32],
        x: &mut [f32],
    ) = first_step_lanes
}

#[inline(always)]
fn first_step_lanes(
    gain: f32,
    w: &[f32],
    force: &mut [f32],
    displacement: &mut [f32],
    x: &mut [f32],
) {
    for (((x, displacement), force), w) in x.iter_mut().zip(displacement).zip(force).zip(w) {
        // Adds zeros as `next_step` would, so that −0 becomes +0 in both.
        *force += 0.0;
        *displacement = 0.0 + *force * w * gain;
        *x += *displacement;
    }
}

leveled! {
    /// Chebyshev step: updates residual force, displacement and position.
    pub(crate) fn next_step(
        coefficients: [f32; 2],
        per_particle: [&[f32]; 3],
        force: &mut [f32],
        displacement: &mut [f32],
        x: &mut [f32],
    ) = next_step_lanes
}

#[inline(always)]
fn next_step_lanes(
    [keep, gain]: [f32; 2],
    [force_change, w, mass]: [&[f32]; 3],
    force: &mut [f32],
    displacement: &mut [f32],
    x: &mut [f32],
) {
    let per_particle = force_change.iter().zip(w).zip(mass);
    for (((x, displacement), force), ((force_change, w), mass)) in
        x.iter_mut().zip(displacement).zip(force).zip(per_particle)
    {
        *force += force_change - mass * *displacement;
        *displacement = *displacement * keep + *force * w * gain;
        *x += *displacement;
    }
}

leveled! {
    /// Computes the weighted second difference of particles `stride` apart.
    pub(crate) fn compute_line_curvature(
        x: &[f32],
        weight: &[f32],
        curve: &mut [f32],
        stride: usize,
    ) = compute_line_curvature_lanes
}

#[inline(always)]
fn compute_line_curvature_lanes(x: &[f32], weight: &[f32], curve: &mut [f32], stride: usize) {
    let inner = stride..x.len() - stride;
    let ends = x[..x.len() - 2 * stride].iter().zip(&x[2 * stride..]);
    let out = curve[inner.clone()].iter_mut().zip(&weight[inner.clone()]);
    for (((out, weight), (a, b)), m) in out.zip(ends).zip(&x[inner]) {
        *out = ((a + b) - 2.0 * m) * weight;
    }
}

leveled! {
    /// Gathers the force of second differences of particles `stride` apart on each particle, times
    /// h². The curvature of particle 0 is at index `margin`.
    pub(crate) fn gather_line_forces(
        curve: &[f32],
        stiffness: f32,
        force: &mut [f32],
        layout: [usize; 2],
    ) = gather_line_forces_lanes
}

#[inline(always)]
fn gather_line_forces_lanes(
    curve: &[f32],
    stiffness: f32,
    force: &mut [f32],
    [margin, stride]: [usize; 2],
) {
    let count = force.len();
    let before = &curve[margin - stride..][..count];
    let after = &curve[margin + stride..][..count];
    for (((force, before), own), after) in
        force.iter_mut().zip(before).zip(&curve[margin..][..count]).zip(after)
    {
        *force = ((2.0 * own - before) - after) * stiffness;
    }
}

leveled! {
    /// Subtracts the momentum of displacements from forces.
    pub(crate) fn subtract_momentum(force: &mut [f32], displacement: &[f32], mass: &[f32])
        = subtract_momentum_lanes
}

#[inline(always)]
fn subtract_momentum_lanes(force: &mut [f32], displacement: &[f32], mass: &[f32]) {
    for ((force, displacement), mass) in force.iter_mut().zip(displacement).zip(mass) {
        *force -= displacement * mass;
    }
}

leveled! {
    /// Adds displacements to positions and to the total of the substep.
    pub(crate) fn apply_displacement(
        x: &mut [f32],
        displacement: &[f32],
        total: &mut [f32],
        is_first: bool,
    ) = apply_displacement_lanes
}

#[inline(always)]
fn apply_displacement_lanes(
    x: &mut [f32],
    displacement: &[f32],
    total: &mut [f32],
    is_first: bool,
) {
    for ((x, displacement), total) in x.iter_mut().zip(displacement).zip(total) {
        *x += displacement;
        *total = if is_first { *displacement } else { *total + displacement };
    }
}
