//! The twist of a grid's cells, band by band: one implicit step of it.
//!
//! ```text
//! a ─── b ─── ·     T = a − b − c + d for each cell. In a band, a cell is coupled to the next one only, so
//! │  ╲  │     │     that the multipliers of a band are those of a tridiagonal system with always the same
//! c ─── d ─── ·     factors: (Σ w + α̃) λ − (w_b + w_d) λ₊ − … = −(T + α̃ λ₀)
//! ```
//! The bands along all rows take what is long along them, those along the columns the rest. Saddles, which
//! neither rows nor columns resist, so stay implicit as well.
//!
//! Every other band goes at once, since they share no particle. What is the same for all cells is done for the
//! cells of all bands, and comes to naught where a band is not of them: so compilers make vectors of it.

use crate::math::columns::Columns;
use crate::math::simd::{Level, leveled};
use crate::model::plate_elements::PlateElements;
use crate::solver::bend::banded::VectorColumns;

/// Room to work in, and factors that stay as long as pins, masses and stiffness do.
#[derive(Clone, Debug, Default)]
pub(crate) struct Twist {
    /// Multipliers of this substep [kg m].
    lambda: VectorColumns,
    /// Compliances [1/kg]; 0 where there is no cell.
    compliance: Vec<f32>,
    /// Of the bands along rows; of the even and of the odd ones along columns, naught for the others.
    rows: TridiagonalFactor,
    columns: [TridiagonalFactor; 2],
    /// Where the substep began, and the share that is taken off of what cells were twisted by then, as rows and as
    /// columns add it up.
    start: Vec<f32>,
    before: [VectorColumns; 2],
    /// What is taken off of them for what they are twisted by at rest.
    rest: VectorColumns,
    /// What is not yet resisted, then what is added to the multipliers, behind a margin of naught.
    own: VectorColumns,
}

/// L D Lᵀ of three diagonals.
#[derive(Clone, Debug, Default)]
struct TridiagonalFactor {
    inverse: Vec<f32>,
    near: Vec<f32>,
}

/// Cells next to each other: the first one's first corner, what leads along and across, and how many.
#[derive(Clone, Copy)]
struct CellStrip {
    first: usize,
    along: usize,
    across: usize,
    count: usize,
}

/// What a cell's curvature is measured from.
#[derive(Clone, Copy)]
pub(crate) struct TwistOffset<'a> {
    /// The share of where particles were that is taken off where they are, for damping.
    pub start_share: f32,
    pub predicted: &'a Columns,
    pub displacement: &'a Columns,
    /// What each cell is twisted by at rest, and which way.
    pub rest: Option<(&'a [f32], &'a Columns)>,
}

impl Twist {
    pub fn new(plates: &PlateElements) -> Self {
        let count = plates.count();
        let factor = || TridiagonalFactor { inverse: vec![0.0; count], near: vec![0.0; count] };
        let list = || vec![0.0; count];
        let own = || vec![0.0; margin(plates.columns) + count];
        Self {
            lambda: [list(), list(), list()],
            compliance: list(),
            rows: factor(),
            columns: [factor(), factor()],
            start: list(),
            before: [[list(), list(), list()], [list(), list(), list()]],
            rest: [list(), list(), list()],
            own: [own(), own(), own()],
        }
    }

    /// For cells so stiff, over one inside, times `stiffness` [kg].
    pub fn factor(&mut self, plates: &PlateElements, weight: &[f32], w: &[f32], stiffness: f32) {
        for (compliance, weight) in self.compliance.iter_mut().zip(weight) {
            *compliance = if *weight > 0.0 { 1.0 / (weight * stiffness) } else { 0.0 };
        }
        let (columns, rows) = (plates.columns, plates.rows);
        for first in (0..rows - 1).map(|row| row * columns) {
            let band = CellStrip { first, along: 1, across: columns, count: columns - 1 };
            self.rows.factor(band, &self.compliance, w);
        }
        for first in 0..columns - 1 {
            let band = CellStrip { first, along: columns, across: 1, count: rows - 1 };
            self.columns[first % 2].factor(band, &self.compliance, w);
        }
    }

    /// Along the rows and then the columns, beginning anew; or back. Of each the even ones first, then the odd ones,
    /// so that neither side of the sheet comes first.
    pub fn solve(
        &mut self,
        level: Level,
        columns: usize,
        x: &mut Columns,
        w: &[f32],
        seen: TwistOffset<'_>,
        is_first: bool,
    ) {
        self.begin(level, columns, seen);
        if is_first {
            self.lambda.iter_mut().for_each(|lambda| lambda.fill(0.0));
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

    /// Finds what is taken off of what cells are twisted by.
    fn begin(&mut self, level: Level, columns: usize, seen: TwistOffset<'_>) {
        let Self { start, before: [rows, across], rest, .. } = self;
        let count = start.len();
        let cells = count - columns - 1;
        for axis in 0..3 {
            if seen.start_share > 0.0 {
                let [to, way] =
                    [seen.predicted, seen.displacement].map(|list| &list.all()[axis][..count]);
                begin(level, start, to, way);
                share_of_twist(
                    level,
                    &mut rows[axis][..cells],
                    start,
                    [1, columns],
                    seen.start_share,
                );
                share_of_twist(
                    level,
                    &mut across[axis][..cells],
                    start,
                    [columns, 1],
                    seen.start_share,
                );
            } else {
                rows[axis].fill(0.0);
                across[axis].fill(0.0);
            }
            if let Some((by, ways)) = seen.rest {
                let way = &ways.all()[axis][..cells];
                share_of_rest(
                    level,
                    &mut rest[axis][..cells],
                    &by[..cells],
                    way,
                    1.0 - seen.start_share,
                );
            } else {
                rest[axis].fill(0.0);
            }
        }
    }

    fn solve_rows(&mut self, level: Level, columns: usize, x: &mut Columns, w: &[f32], odd: usize) {
        let ways = [1, columns];
        let last = self.start.len() / columns - 1;
        for row in (odd..last).step_by(2) {
            // The last cell of a row is none, and without factors.
            let first = row * columns;
            self.look(level, ways, x, [first, first + columns - 1], 0);
        }
        self.rows.solve_rows(columns, odd, &mut self.own);
        self.go_on(level, ways, x, w);
    }

    fn solve_columns(
        &mut self,
        level: Level,
        columns: usize,
        x: &mut Columns,
        w: &[f32],
        odd: usize,
    ) {
        let ways = [columns, 1];
        let cells = self.start.len() - columns - 1;
        self.look(level, ways, x, [0, cells], 1);
        let factor = &self.columns[odd];
        for own in &mut self.own {
            down_and_up(level, &mut own[margin(columns)..], factor, columns);
        }
        self.go_on(level, ways, x, w);
    }

    /// Finds what some cells do not resist yet.
    fn look(
        &mut self,
        level: Level,
        ways: [usize; 2],
        x: &Columns,
        [from, to]: [usize; 2],
        kind: usize,
    ) {
        let Self { lambda, compliance, before, rest, own, .. } = self;
        let edge = ways[0] + ways[1];
        for (axis, (own, lambda)) in own.iter_mut().zip(lambda).enumerate() {
            let off = [&before[kind][axis][from..to], &rest[axis][from..to]];
            let against = [&compliance[from..to], &lambda[from..to]];
            let x = &x.all()[axis][from..to + edge];
            look(level, &mut own[edge + from..edge + to], x, ways, off, against);
        }
    }

    /// Moves particles, and keeps what that took.
    fn go_on(&mut self, level: Level, ways: [usize; 2], x: &mut Columns, w: &[f32]) {
        let Self { lambda, own, .. } = self;
        for ((lambda, own), x) in lambda.iter_mut().zip(own).zip(x.all_mut()) {
            let count = lambda.len();
            move_on(level, lambda, own, &mut x[..count], &w[..count], ways);
        }
    }
}

/// What cells have before them, so that each has a cell before it, above it, and before that one.
fn margin(columns: usize) -> usize {
    columns + 1
}

impl TridiagonalFactor {
    fn factor(&mut self, band: CellStrip, compliance: &[f32], w: &[f32]) {
        let CellStrip { first, along, across, count } = band;
        let both = |i: usize| f64::from(w[i]) + f64::from(w[i + across]);
        let (mut last, mut had_one) = (1.0, false);
        for i in (0..count).map(|k| first + k * along) {
            if compliance[i] == 0.0 {
                (self.inverse[i], self.near[i], had_one) = (0.0, 0.0, false);
                continue;
            }
            let beside = if had_one { -both(i) } else { 0.0 };
            let near = beside / last;
            let d = both(i) + both(i + along) + f64::from(compliance[i]) - near * beside;
            (self.inverse[i], self.near[i]) = ((1.0 / d) as f32, near as f32);
            (last, had_one) = (d, true);
        }
    }

    /// Along every other row, from end to end and back; the others, and what is beyond the cells of a row, come to
    /// naught.
    fn solve_rows(&self, columns: usize, odd: usize, own: &mut VectorColumns) {
        let [x, y, z] = own.each_mut().map(|own| own[margin(columns)..].chunks_exact_mut(columns));
        let factors = self.inverse.chunks_exact(columns).zip(self.near.chunks_exact(columns));
        for (row, (((x, y), z), (inverse, near))) in x.zip(y).zip(z).zip(factors).enumerate() {
            if row % 2 != odd {
                [x, y, z].into_iter().for_each(|own| own.fill(0.0));
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
    /// Where the substep began.
    fn begin(start: &mut [f32], to: &[f32], way: &[f32]) = begin_lanes
}

#[inline(always)]
fn begin_lanes(start: &mut [f32], to: &[f32], way: &[f32]) {
    for ((start, to), way) in start.iter_mut().zip(to).zip(way) {
        *start = to - way;
    }
}

leveled! {
    /// A share of what cells are twisted by.
    fn share_of_twist(out: &mut [f32], x: &[f32], ways: [usize; 2], share: f32) = share_of_twist_lanes
}

#[inline(always)]
fn share_of_twist_lanes(out: &mut [f32], x: &[f32], [along, across]: [usize; 2], share: f32) {
    let corners = x.iter().zip(&x[across..]).zip(x[along..].iter().zip(&x[along + across..]));
    for (out, ((a, b), (c, d))) in out.iter_mut().zip(corners) {
        *out = ((a - b) - (c - d)) * share;
    }
}

leveled! {
    /// A share of what cells are twisted by at rest.
    fn share_of_rest(out: &mut [f32], rest: &[f32], way: &[f32], share: f32) = share_of_rest_lanes
}

#[inline(always)]
fn share_of_rest_lanes(out: &mut [f32], rest: &[f32], way: &[f32], share: f32) {
    for ((out, rest), way) in out.iter_mut().zip(rest).zip(way) {
        *out = way * (rest * share);
    }
}

leveled! {
    /// What is to be added for what cells are twisted by and do not resist yet.
    fn look(
        own: &mut [f32],
        x: &[f32],
        ways: [usize; 2],
        off: [&[f32]; 2],
        against: [&[f32]; 2],
    ) = look_lanes
}

#[inline(always)]
fn look_lanes(
    own: &mut [f32],
    x: &[f32],
    [along, across]: [usize; 2],
    [before, rest]: [&[f32]; 2],
    [compliance, lambda]: [&[f32]; 2],
) {
    let corners = x.iter().zip(&x[across..]).zip(x[along..].iter().zip(&x[along + across..]));
    let off = before.iter().zip(rest);
    let against = compliance.iter().zip(lambda);
    for (((own, ((a, b), (c, d))), (before, rest)), (compliance, lambda)) in
        own.iter_mut().zip(corners).zip(off).zip(against)
    {
        let twist = ((a - b) - (c - d)) - before - rest;
        *own = -(twist + compliance * lambda);
    }
}

leveled! {
    /// Along all columns that a factor is of, down and up again; the others come to naught.
    fn down_and_up(own: &mut [f32], factor: &TridiagonalFactor, columns: usize) = down_and_up_lanes
}

#[inline(always)]
fn down_and_up_lanes(own: &mut [f32], factor: &TridiagonalFactor, columns: usize) {
    let cells = own.len() - columns;
    for first in (columns..cells).step_by(columns) {
        let (above, row) = own.split_at_mut(first);
        let near = &factor.near[first..first + columns];
        for ((own, near), last) in row.iter_mut().zip(near).zip(&above[first - columns..]) {
            *own -= near * last;
        }
    }
    for (own, inverse) in own[..cells].iter_mut().zip(&factor.inverse) {
        *own *= inverse;
    }
    for first in (0..cells - columns).step_by(columns).rev() {
        let (row, below) = own[first..].split_at_mut(columns);
        let near = &factor.near[first + columns..first + 2 * columns];
        for ((own, near), last) in row.iter_mut().zip(near).zip(&*below) {
            *own -= near * last;
        }
    }
}

leveled! {
    /// Moves particles by what is added to the multipliers of the cells around them.
    fn move_on(lambda: &mut [f32], own: &[f32], x: &mut [f32], w: &[f32], ways: [usize; 2]) = move_on_lanes
}

#[inline(always)]
fn move_on_lanes(
    lambda: &mut [f32],
    own: &[f32],
    x: &mut [f32],
    w: &[f32],
    [along, across]: [usize; 2],
) {
    let near = own[across..].iter().zip(&own[along..]).zip(own);
    let own = &own[along + across..];
    for (((lambda, own), (x, w)), ((before, beside), beyond)) in
        lambda.iter_mut().zip(own).zip(x.iter_mut().zip(w)).zip(near)
    {
        *lambda += own;
        *x += w * ((own - before) - (beside - beyond));
    }
}
