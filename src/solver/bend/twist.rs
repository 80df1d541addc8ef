//! Twist of grid cells: one implicit step along strips of cells.
//!
//! ```text
//! a ─── b ─── ·     T = a − b − c + d per cell. In a strip a cell shares particles with the
//! │  ╲  │     │     two neighbouring cells only, so the multipliers solve a tridiagonal system
//! c ─── d ─── ·     (Σ w + α̃) λ − (w_b + w_d) λ₊ − … = −(T + α̃ λ₀)
//! ```
//! Method: XPBD solved exactly per strip by L D Lᵀ factors. Strips along rows remove the errors
//! that are long along rows; strips along columns remove the other errors. So saddle shapes, which
//! the rows and columns of `plate` do not resist, are solved implicitly too. Strips 0, 2, 4 … share
//! no particle and are solved at once, then strips 1, 3, 5 …. Steps that are the same for all cells
//! run over all cells, with zeros in the other strips, so the compiler vectorises them.
//!
//! Reads element weights, inverse masses, folds and start positions; writes positions and `lambda`.
//! Invariant: multipliers start at zero in the first solve of a substep, and the second solve
//! continues with them.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::{ReserveTotal, zeros};
use crate::math::simd::{Level, leveled};
use crate::math::swap::swap;
use crate::model::plate_elements::PlateElements;
use crate::solver::bend::banded::VectorColumns;

/// Multipliers and buffers of one tick.
#[derive(Clone, Debug, Default)]
struct TwistBuffers {
    /// Multipliers of this substep, one vector per cell [kg m].
    lambda: VectorColumns,
    /// Start positions of one axis, and the damping share of the twist at the start, in the order
    /// of additions of rows and of columns.
    start: Vec<f32>,
    start_twist: [VectorColumns; 2],
    /// Rest twist of each cell [m].
    rest: VectorColumns,
    /// Right sides, then changes of the multipliers, after a margin of zeros.
    change: VectorColumns,
}

/// Buffers of the twist, and factors that are valid until pins, masses or stiffness change.
#[derive(Clone, Debug, Default)]
pub(crate) struct Twist {
    buffers: TwistBuffers,
    /// Compliance of each cell [1/kg]; 0 where there is no cell.
    compliance: Vec<f32>,
    /// Factors of the strips along rows, and of the even and the odd strips along columns; the
    /// entries of other strips are 0.
    rows: TridiagonalFactor,
    columns: [TridiagonalFactor; 2],
}

heap_bytes!(Twist { compliance, rows, columns } plain { buffers });

/// L D Lᵀ factors of tridiagonal systems.
#[derive(Clone, Debug, Default)]
struct TridiagonalFactor {
    inverse: Vec<f32>,
    near: Vec<f32>,
}

heap_bytes!(TridiagonalFactor { inverse, near } plain {});

/// A strip of `count` cells: first corner of the first cell, and index offsets along and across.
#[derive(Clone, Copy)]
struct CellStrip {
    first: usize,
    along: usize,
    across: usize,
    count: usize,
}

/// Data for the offset that is subtracted from the twist of each cell.
#[derive(Clone, Copy)]
pub(crate) struct TwistOffset<'a> {
    /// Share of the start positions to subtract, for damping; see `HingeStep`.
    pub start_share: f32,
    pub predicted: &'a Columns,
    pub displacement: &'a Columns,
    /// Rest twist of each cell [m] and its direction; `None` without folds.
    pub rest: Option<(&'a [f32], &'a Columns)>,
}

impl Twist {
    pub fn new(plates: &PlateElements) -> Self {
        let count = plates.count();
        let factor = || TridiagonalFactor { inverse: zeros(count), near: zeros(count) };
        Self {
            buffers: TwistBuffers::default(),
            compliance: zeros(count),
            rows: factor(),
            columns: [factor(), factor()],
        }
    }

    /// Exchanges the buffers of one tick with those of `other`.
    pub fn swap_lent(&mut self, other: &mut Self) {
        swap(&mut self.buffers, &mut other.buffers);
    }

    fn lists_of_tick(&mut self) -> impl Iterator<Item = &mut Vec<f32>> {
        let TwistBuffers { lambda, start, start_twist, rest, change } = &mut self.buffers;
        let lists = start_twist.as_flattened_mut().iter_mut().chain(lambda).chain(rest);
        change.iter_mut().chain(lists).chain([start])
    }

    /// Empties the buffers of one tick.
    pub fn clear_lent(&mut self) {
        self.lists_of_tick().for_each(Vec::clear);
    }

    /// Gives the buffers of one tick the lengths for `plates`. New entries are zero.
    pub fn resize_lent(&mut self, plates: &PlateElements) {
        let (count, margin) = (plates.count(), margin(plates.columns));
        for (at, list) in self.lists_of_tick().enumerate() {
            resize(list, if at < 3 { margin + count } else { count });
        }
    }

    /// Factors all strips. `weight` is the stiffness of each cell relative to an interior one,
    /// `stiffness` that of an interior cell times h² [kg].
    pub fn factor(&mut self, plates: &PlateElements, weight: &[f32], w: &[f32], stiffness: f32) {
        for (compliance, weight) in self.compliance.iter_mut().zip(weight) {
            *compliance = if *weight > 0.0 { 1.0 / (weight * stiffness) } else { 0.0 };
        }
        let (columns, rows) = (plates.columns, plates.rows);
        for first in (0..rows - 1).map(|row| row * columns) {
            let strip = CellStrip { first, along: 1, across: columns, count: columns - 1 };
            self.rows.factor(strip, &self.compliance, w);
        }
        for first in 0..columns - 1 {
            let strip = CellStrip { first, along: columns, across: 1, count: rows - 1 };
            self.columns[first % 2].factor(strip, &self.compliance, w);
        }
    }

    /// Solves rows and then columns in the first solve of a substep, or the same in reverse order.
    ///
    /// Even strips run before odd ones, so no side of the sheet is favoured.
    pub fn solve(
        &mut self,
        level: Level,
        columns: usize,
        x: &mut Columns,
        w: &[f32],
        offset: TwistOffset<'_>,
        is_first: bool,
    ) {
        self.compute_offsets(level, columns, offset);
        if is_first {
            self.buffers.lambda.iter_mut().for_each(|lambda| lambda.fill(0.0));
            for odd in 0..2 {
                self.solve_rows(level, columns, x, w, odd);
            }
            for odd in 0..2 {
                self.solve_columns(level, columns, x, w, odd);
            }
        } else {
            for odd in [1, 0] {
                self.solve_columns(level, columns, x, w, odd);
            }
            for odd in [1, 0] {
                self.solve_rows(level, columns, x, w, odd);
            }
        }
    }

    /// Computes the offsets by damping and by folds.
    fn compute_offsets(&mut self, level: Level, columns: usize, offset: TwistOffset<'_>) {
        let TwistBuffers { start, start_twist: [rows, across], rest, .. } = &mut self.buffers;
        let count = start.len();
        let cells = count - columns - 1;
        for axis in 0..3 {
            if offset.start_share > 0.0 {
                let [to, displacement] = [offset.predicted, offset.displacement]
                    .map(|list| &list.slices()[axis][..count]);
                compute_start(level, start, to, displacement);
                scaled_twist(
                    level,
                    &mut rows[axis][..cells],
                    start,
                    [1, columns],
                    offset.start_share,
                );
                scaled_twist(
                    level,
                    &mut across[axis][..cells],
                    start,
                    [columns, 1],
                    offset.start_share,
                );
            } else {
                rows[axis].fill(0.0);
                across[axis].fill(0.0);
            }
            if let Some((rest_twist, directions)) = offset.rest {
                let direction = &directions.slices()[axis][..cells];
                scaled_rest(
                    level,
                    &mut rest[axis][..cells],
                    &rest_twist[..cells],
                    direction,
                    1.0 - offset.start_share,
                );
            } else {
                rest[axis].fill(0.0);
            }
        }
    }

    fn solve_rows(&mut self, level: Level, columns: usize, x: &mut Columns, w: &[f32], odd: usize) {
        let strides = [1, columns];
        let last = self.buffers.start.len() / columns - 1;
        for row in (odd..last).step_by(2) {
            // The last index of a row has no cell and no factors.
            let first = row * columns;
            self.compute_residual(level, strides, x, [first, first + columns - 1], 0);
        }
        self.rows.solve_rows(columns, odd, &mut self.buffers.change);
        self.apply_change(level, strides, x, w);
    }

    fn solve_columns(
        &mut self,
        level: Level,
        columns: usize,
        x: &mut Columns,
        w: &[f32],
        odd: usize,
    ) {
        let strides = [columns, 1];
        let cells = self.buffers.start.len() - columns - 1;
        self.compute_residual(level, strides, x, [0, cells], 1);
        let factor = &self.columns[odd];
        for change in &mut self.buffers.change {
            substitute_columns(level, &mut change[margin(columns)..], factor, columns);
        }
        self.apply_change(level, strides, x, w);
    }

    /// Computes the right sides −(T + α̃ λ) of the cells `from..to`.
    fn compute_residual(
        &mut self,
        level: Level,
        strides: [usize; 2],
        x: &Columns,
        [from, to]: [usize; 2],
        kind: usize,
    ) {
        let Self { compliance, buffers, .. } = self;
        let TwistBuffers { lambda, start_twist, rest, change, .. } = buffers;
        let margin_length = strides[0] + strides[1];
        for (axis, (change, lambda)) in change.iter_mut().zip(lambda).enumerate() {
            let offsets = [&start_twist[kind][axis][from..to], &rest[axis][from..to]];
            let compliance_term = [&compliance[from..to], &lambda[from..to]];
            let x = &x.slices()[axis][from..to + margin_length];
            compute_residual(
                level,
                &mut change[margin_length + from..margin_length + to],
                x,
                strides,
                offsets,
                compliance_term,
            );
        }
    }

    /// Adds the changes to the multipliers and moves the particles.
    fn apply_change(&mut self, level: Level, strides: [usize; 2], x: &mut Columns, w: &[f32]) {
        let TwistBuffers { lambda, change, .. } = &mut self.buffers;
        for ((lambda, change), x) in lambda.iter_mut().zip(change).zip(x.slices_mut()) {
            let count = lambda.len();
            apply_lambda(level, lambda, change, &mut x[..count], &w[..count], strides);
        }
    }
}

/// Truncates a list to `count` entries, or extends it with zeros in memory for exactly so many.
#[inline(never)]
pub(super) fn resize(list: &mut Vec<f32>, count: usize) {
    list.reserve_total(count);
    list.resize(count, 0.0);
}

/// Number of zeros before the first cell, so that each cell has a neighbour before, above and
/// diagonally.
fn margin(columns: usize) -> usize {
    columns + 1
}

impl TridiagonalFactor {
    fn factor(&mut self, strip: CellStrip, compliance: &[f32], w: &[f32]) {
        let CellStrip { first, along, across, count } = strip;
        let both = |i: usize| f64::from(w[i]) + f64::from(w[i + across]);
        let (mut last, mut has_previous) = (1.0, false);
        for i in (0..count).map(|k| first + k * along) {
            if compliance[i] == 0.0 {
                (self.inverse[i], self.near[i], has_previous) = (0.0, 0.0, false);
                continue;
            }
            let beside = if has_previous { -both(i) } else { 0.0 };
            let near = beside / last;
            let d = both(i) + both(i + along) + f64::from(compliance[i]) - near * beside;
            (self.inverse[i], self.near[i]) = ((1.0 / d) as f32, near as f32);
            (last, has_previous) = (d, true);
        }
    }

    /// Solves every other row of cells; the other rows and the entries without a cell become 0.
    fn solve_rows(&self, columns: usize, odd: usize, change: &mut VectorColumns) {
        let [x, y, z] =
            change.each_mut().map(|change| change[margin(columns)..].chunks_exact_mut(columns));
        let factors = self.inverse.chunks_exact(columns).zip(self.near.chunks_exact(columns));
        for (row, (((x, y), z), (inverse, near))) in x.zip(y).zip(z).zip(factors).enumerate() {
            if row % 2 != odd {
                [x, y, z].into_iter().for_each(|change| change.fill(0.0));
                continue;
            }
            let mut last = [0.0; 3];
            for k in 0..columns - 1 {
                let right = [x[k], y[k], z[k]];
                for axis in 0..3 {
                    last[axis] = right[axis] - near[k] * last[axis];
                }
                [x[k], y[k], z[k]] = last;
            }
            (last, [x[columns - 1], y[columns - 1], z[columns - 1]]) = ([0.0; 3], [0.0; 3]);
            let mut near_last = 0.0;
            for k in (0..columns - 1).rev() {
                let line = [x[k], y[k], z[k]];
                for axis in 0..3 {
                    last[axis] = line[axis] * inverse[k] - near_last * last[axis];
                }
                [x[k], y[k], z[k]] = last;
                near_last = near[k];
            }
        }
    }
}

leveled! {
    /// Computes start positions: predicted position less displacement.
    fn compute_start(start: &mut [f32], to: &[f32], displacement: &[f32]) = compute_start_lanes
}

#[inline(always)]
fn compute_start_lanes(start: &mut [f32], to: &[f32], displacement: &[f32]) {
    for ((start, to), displacement) in start.iter_mut().zip(to).zip(displacement) {
        *start = to - displacement;
    }
}

leveled! {
    /// Computes a share of the twist of each cell.
    fn scaled_twist(out: &mut [f32], x: &[f32], strides: [usize; 2], share: f32)
        = scaled_twist_lanes
}

#[inline(always)]
fn scaled_twist_lanes(out: &mut [f32], x: &[f32], [along, across]: [usize; 2], share: f32) {
    let corners = x.iter().zip(&x[across..]).zip(x[along..].iter().zip(&x[along + across..]));
    for (out, ((a, b), (c, d))) in out.iter_mut().zip(corners) {
        *out = ((a - b) - (c - d)) * share;
    }
}

leveled! {
    /// Computes a share of the rest twist of each cell.
    fn scaled_rest(out: &mut [f32], rest: &[f32], direction: &[f32], share: f32) = scaled_rest_lanes
}

#[inline(always)]
fn scaled_rest_lanes(out: &mut [f32], rest: &[f32], direction: &[f32], share: f32) {
    for ((out, rest), direction) in out.iter_mut().zip(rest).zip(direction) {
        *out = direction * (rest * share);
    }
}

leveled! {
    /// Computes −(T + α̃ λ) per cell, with T less its offsets.
    fn compute_residual(
        change: &mut [f32],
        x: &[f32],
        strides: [usize; 2],
        offsets: [&[f32]; 2],
        compliance_term: [&[f32]; 2],
    ) = compute_residual_lanes
}

#[inline(always)]
fn compute_residual_lanes(
    change: &mut [f32],
    x: &[f32],
    [along, across]: [usize; 2],
    [start_twist, rest]: [&[f32]; 2],
    [compliance, lambda]: [&[f32]; 2],
) {
    let corners = x.iter().zip(&x[across..]).zip(x[along..].iter().zip(&x[along + across..]));
    let offsets = start_twist.iter().zip(rest);
    let compliance_term = compliance.iter().zip(lambda);
    for (((change, ((a, b), (c, d))), (start_twist, rest)), (compliance, lambda)) in
        change.iter_mut().zip(corners).zip(offsets).zip(compliance_term)
    {
        let twist = ((a - b) - (c - d)) - start_twist - rest;
        *change = -(twist + compliance * lambda);
    }
}

leveled! {
    /// Forward and backward substitution along the columns of a factor; other columns become 0.
    fn substitute_columns(change: &mut [f32], factor: &TridiagonalFactor, columns: usize)
        = substitute_columns_lanes
}

#[inline(always)]
fn substitute_columns_lanes(change: &mut [f32], factor: &TridiagonalFactor, columns: usize) {
    let cells = change.len() - columns;
    for first in (columns..cells).step_by(columns) {
        let (above, row) = change.split_at_mut(first);
        let near = &factor.near[first..first + columns];
        for ((change, near), last) in row.iter_mut().zip(near).zip(&above[first - columns..]) {
            *change -= near * last;
        }
    }
    for (change, inverse) in change[..cells].iter_mut().zip(&factor.inverse) {
        *change *= inverse;
    }
    for first in (0..cells - columns).step_by(columns).rev() {
        let (row, below) = change[first..].split_at_mut(columns);
        let near = &factor.near[first + columns..first + 2 * columns];
        for ((change, near), last) in row.iter_mut().zip(near).zip(&*below) {
            *change -= near * last;
        }
    }
}

leveled! {
    /// Adds changes to multipliers, and moves particles by the changes of the four cells around.
    fn apply_lambda(
        lambda: &mut [f32],
        change: &[f32],
        x: &mut [f32],
        w: &[f32],
        strides: [usize; 2],
    ) = apply_lambda_lanes
}

#[inline(always)]
fn apply_lambda_lanes(
    lambda: &mut [f32],
    change: &[f32],
    x: &mut [f32],
    w: &[f32],
    [along, across]: [usize; 2],
) {
    let near = change[across..].iter().zip(&change[along..]).zip(change);
    let change = &change[along + across..];
    for (((lambda, change), (x, w)), ((before, beside), beyond)) in
        lambda.iter_mut().zip(change).zip(x.iter_mut().zip(w)).zip(near)
    {
        *lambda += change;
        *x += w * ((change - before) - (beside - beyond));
    }
}
