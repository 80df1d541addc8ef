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

use super::pentads::Three;
use crate::fabric::plates::Plates;
use crate::math::columns::Columns;
use crate::math::simd::{Level, leveled};

/// Room to work in, and factors that stay as long as pins, masses and stiffness do.
#[derive(Clone, Debug, Default)]
pub(crate) struct Twist {
    /// Multipliers of this substep [kg m].
    lambda: Three,
    /// Compliances [1/kg]; 0 where there is no cell.
    compliance: Vec<f32>,
    /// Of the bands along rows; of the even and of the odd ones along columns, naught for the others.
    rows: Factor,
    columns: [Factor; 2],
    /// Where the substep began.
    start: Vec<f32>,
    /// What is not yet resisted, then what is added to the multipliers, behind a margin of naught.
    own: Three,
}

/// L D Lᵀ of three diagonals.
#[derive(Clone, Debug, Default)]
struct Factor {
    inverse: Vec<f32>,
    near: Vec<f32>,
}

/// Cells next to each other: the first one's first corner, what leads along and across, and how many.
#[derive(Clone, Copy)]
struct Band {
    first: usize,
    along: usize,
    across: usize,
    count: usize,
}

/// What a cell's curvature is measured from.
#[derive(Clone, Copy)]
pub(crate) struct Seen<'a> {
    /// The share of where particles were that is taken off where they are, for damping.
    pub before: f32,
    pub predicted: &'a Columns,
    pub way: &'a Columns,
    /// What each cell is twisted by at rest, and which way.
    pub rest: Option<(&'a [f32], &'a Columns)>,
}

impl Twist {
    pub fn new(plates: &Plates) -> Self {
        let count = plates.count();
        let factor = || Factor { inverse: vec![0.0; count], near: vec![0.0; count] };
        let list = || vec![0.0; count];
        let own = || vec![0.0; margin(plates.columns) + count];
        Self {
            lambda: [list(), list(), list()],
            compliance: list(),
            rows: factor(),
            columns: [factor(), factor()],
            start: list(),
            own: [own(), own(), own()],
        }
    }

    /// For cells so stiff, over one inside, times `stiffness` [kg].
    pub fn factor(&mut self, plates: &Plates, weight: &[f32], w: &[f32], stiffness: f32) {
        for (compliance, weight) in self.compliance.iter_mut().zip(weight) {
            *compliance = if *weight > 0.0 { 1.0 / (weight * stiffness) } else { 0.0 };
        }
        let (columns, rows) = (plates.columns, plates.rows);
        for first in (0..rows - 1).map(|row| row * columns) {
            let band = Band { first, along: 1, across: columns, count: columns - 1 };
            self.rows.factor(band, &self.compliance, w);
        }
        for first in 0..columns - 1 {
            let band = Band { first, along: columns, across: 1, count: rows - 1 };
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
        seen: Seen<'_>,
        is_first: bool,
    ) {
        if is_first {
            self.lambda.iter_mut().for_each(|lambda| lambda.fill(0.0));
            for odd in 0..2 {
                self.solve_rows(level, columns, x, w, seen, odd);
            }
            for odd in 0..2 {
                self.solve_columns(level, columns, x, w, seen, odd);
            }
        } else {
            for odd in [1, 0] {
                self.solve_columns(level, columns, x, w, seen, odd);
            }
            for odd in [1, 0] {
                self.solve_rows(level, columns, x, w, seen, odd);
            }
        }
    }

    fn solve_rows(
        &mut self,
        level: Level,
        columns: usize,
        x: &mut Columns,
        w: &[f32],
        seen: Seen<'_>,
        odd: usize,
    ) {
        let ways = [1, columns];
        self.look(level, ways, x, seen);
        self.rows.solve_rows(columns, odd, &mut self.own);
        self.go_on(level, ways, x, w);
    }

    fn solve_columns(
        &mut self,
        level: Level,
        columns: usize,
        x: &mut Columns,
        w: &[f32],
        seen: Seen<'_>,
        odd: usize,
    ) {
        let ways = [columns, 1];
        self.look(level, ways, x, seen);
        let factor = &self.columns[odd];
        for own in &mut self.own {
            down_and_up(level, &mut own[margin(columns)..], factor, columns);
        }
        self.go_on(level, ways, x, w);
    }

    /// Finds what cells do not resist yet.
    fn look(&mut self, level: Level, ways: [usize; 2], x: &Columns, seen: Seen<'_>) {
        let Self { lambda, compliance, start, own, .. } = self;
        let (count, edge) = (start.len(), ways[0] + ways[1]);
        let cells = count - edge;
        let compliance = &compliance[..cells];
        for (axis, (own, lambda)) in own.iter_mut().zip(lambda).enumerate() {
            let own = &mut own[edge..][..cells];
            twist(level, own, &x.all()[axis][..count], ways);
            if seen.before > 0.0 {
                let [to, way] = [seen.predicted, seen.way].map(|list| &list.all()[axis][..count]);
                begin(level, start, to, way);
                take_twist(level, own, start, ways, seen.before);
            }
            if let Some((rest, normals)) = seen.rest {
                let normal = &normals.all()[axis][..cells];
                take_rest(level, own, &rest[..cells], normal, 1.0 - seen.before);
            }
            resist(level, own, compliance, &lambda[..cells]);
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

impl Factor {
    fn factor(&mut self, band: Band, compliance: &[f32], w: &[f32]) {
        let Band { first, along, across, count } = band;
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
    fn solve_rows(&self, columns: usize, odd: usize, own: &mut Three) {
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
    /// What cells are twisted by.
    fn twist(own: &mut [f32], x: &[f32], ways: [usize; 2]) = twist_lanes
}

#[inline(always)]
fn twist_lanes(own: &mut [f32], x: &[f32], [along, across]: [usize; 2]) {
    let corners = x.iter().zip(&x[across..]).zip(x[along..].iter().zip(&x[along + across..]));
    for (own, ((a, b), (c, d))) in own.iter_mut().zip(corners) {
        *own = (a - b) - (c - d);
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
    /// Takes off a share of what cells were twisted by.
    fn take_twist(own: &mut [f32], start: &[f32], ways: [usize; 2], share: f32) = take_twist_lanes
}

#[inline(always)]
fn take_twist_lanes(own: &mut [f32], start: &[f32], [along, across]: [usize; 2], share: f32) {
    let x = start;
    let corners = x.iter().zip(&x[across..]).zip(x[along..].iter().zip(&x[along + across..]));
    for (own, ((a, b), (c, d))) in own.iter_mut().zip(corners) {
        *own -= ((a - b) - (c - d)) * share;
    }
}

leveled! {
    /// Takes off a share of what cells are twisted by at rest.
    fn take_rest(own: &mut [f32], rest: &[f32], normal: &[f32], share: f32) = take_rest_lanes
}

#[inline(always)]
fn take_rest_lanes(own: &mut [f32], rest: &[f32], normal: &[f32], share: f32) {
    for ((own, rest), normal) in own.iter_mut().zip(rest).zip(normal) {
        let less = *own - normal * (rest * share);
        *own = if *rest != 0.0 { less } else { *own };
    }
}

leveled! {
    /// What is to be added for it.
    fn resist(own: &mut [f32], compliance: &[f32], lambda: &[f32]) = resist_lanes
}

#[inline(always)]
fn resist_lanes(own: &mut [f32], compliance: &[f32], lambda: &[f32]) {
    for ((own, compliance), lambda) in own.iter_mut().zip(compliance).zip(lambda) {
        *own = -(*own + compliance * lambda);
    }
}

leveled! {
    /// Along all columns that a factor is of, down and up again; the others come to naught.
    fn down_and_up(own: &mut [f32], factor: &Factor, columns: usize) = down_and_up_lanes
}

#[inline(always)]
fn down_and_up_lanes(own: &mut [f32], factor: &Factor, columns: usize) {
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
