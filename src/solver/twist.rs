//! The twist of a grid's cells, band by band: one implicit step of it.
//!
//! ```text
//! a ─── b ─── ·     T = a − b − c + d for each cell. In a band, a cell is coupled to the next one only, so
//! │  ╲  │     │     that the multipliers of a band are those of a tridiagonal system with always the same
//! c ─── d ─── ·     factors: (Σ w + α̃) λ − (w_b + w_d) λ₊ − … = −(T + α̃ λ₀)
//! ```
//! The bands along all rows take what is long along them, those along the columns the rest. Saddles, which
//! neither rows nor columns resist, so stay implicit as well.

use crate::fabric::plates::Plates;
use crate::math::columns::Columns;

type V = [f32; 3];

/// Room to work in, and factors that stay as long as pins, masses and stiffness do.
#[derive(Clone, Debug, Default)]
pub(crate) struct Twist {
    /// Multipliers of this substep [kg m].
    lambda: Vec<V>,
    /// Compliances [1/kg]; 0 where there is no cell.
    compliance: Vec<f32>,
    rows: Factor,
    columns: Factor,
    /// The multipliers of a band before they are known.
    line: Vec<V>,
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
        Self {
            lambda: vec![[0.0; 3]; count],
            compliance: vec![0.0; count],
            rows: factor(),
            columns: factor(),
            line: vec![[0.0; 3]; plates.columns.max(plates.rows)],
        }
    }

    /// For cells so stiff, over one inside, times `stiffness` [kg].
    pub fn factor(&mut self, plates: &Plates, weight: &[f32], w: &[f32], stiffness: f32) {
        for (compliance, weight) in self.compliance.iter_mut().zip(weight) {
            *compliance = if *weight > 0.0 { 1.0 / (weight * stiffness) } else { 0.0 };
        }
        for band in along_rows(plates) {
            self.rows.factor(band, &self.compliance, w);
        }
        for band in along_columns(plates) {
            self.columns.factor(band, &self.compliance, w);
        }
    }

    /// Along the rows and then the columns, beginning anew; or back.
    pub fn solve(
        &mut self,
        plates: &Plates,
        x: &mut Columns,
        w: &[f32],
        seen: Seen<'_>,
        is_first: bool,
    ) {
        let Self { lambda, compliance, rows, columns, line } = self;
        let mut cells = Cells { lambda, compliance, line, x, w, seen };
        if is_first {
            cells.lambda.fill([0.0; 3]);
            along_rows(plates).for_each(|band| cells.solve(band, rows));
            along_columns(plates).for_each(|band| cells.solve(band, columns));
        } else {
            along_columns(plates).rev().for_each(|band| cells.solve(band, columns));
            along_rows(plates).rev().for_each(|band| cells.solve(band, rows));
        }
    }
}

/// The even ones first, then the odd ones, so that neither side of the sheet comes first.
fn in_turn(count: usize) -> impl DoubleEndedIterator<Item = usize> {
    (0..count).step_by(2).chain((1..count).step_by(2))
}

fn along_rows(plates: &Plates) -> impl DoubleEndedIterator<Item = Band> {
    let (columns, rows) = (plates.columns, plates.rows);
    in_turn(rows - 1).map(move |row| Band {
        first: row * columns,
        along: 1,
        across: columns,
        count: columns - 1,
    })
}

fn along_columns(plates: &Plates) -> impl DoubleEndedIterator<Item = Band> {
    let (columns, rows) = (plates.columns, plates.rows);
    in_turn(columns - 1).map(move |column| Band {
        first: column,
        along: columns,
        across: 1,
        count: rows - 1,
    })
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
}

struct Cells<'a> {
    lambda: &'a mut [V],
    compliance: &'a [f32],
    line: &'a mut [V],
    x: &'a mut Columns,
    w: &'a [f32],
    seen: Seen<'a>,
}

impl Cells<'_> {
    fn solve(&mut self, band: Band, factor: &Factor) {
        let Band { first, along, across, count } = band;
        let mut last = [0.0; 3];
        for k in 0..count {
            let i = first + k * along;
            let twist = self.twist(i, along, across);
            let (near, compliance, lambda) = (factor.near[i], self.compliance[i], self.lambda[i]);
            for axis in 0..3 {
                let right = -(twist[axis] + compliance * lambda[axis]);
                last[axis] = right - near * last[axis];
            }
            self.line[k] = last;
        }
        last = [0.0; 3];
        let mut near_last = 0.0;
        for k in (0..count).rev() {
            let i = first + k * along;
            let inverse = factor.inverse[i];
            for axis in 0..3 {
                last[axis] = self.line[k][axis] * inverse - near_last * last[axis];
                self.lambda[i][axis] += last[axis];
            }
            self.line[k] = last;
            near_last = factor.near[i];
        }
        let mut before = [0.0; 3];
        for k in 0..=count {
            let i = first + k * along;
            let own = if k < count { self.line[k] } else { [0.0; 3] };
            let (wa, wb) = (self.w[i], self.w[i + across]);
            let columns = [&mut self.x.x, &mut self.x.y, &mut self.x.z];
            for ((column, own), before) in columns.into_iter().zip(own).zip(before) {
                let pull = own - before;
                column[i] += wa * pull;
                column[i + across] -= wb * pull;
            }
            before = own;
        }
    }

    #[inline(always)]
    fn twist(&self, i: usize, along: usize, across: usize) -> V {
        let seen = &self.seen;
        let mut twist = [0.0; 3];
        for (axis, twist) in twist.iter_mut().enumerate() {
            let x = self.x.all()[axis];
            *twist = (x[i] - x[i + across]) - (x[i + along] - x[i + along + across]);
        }
        if seen.before > 0.0 {
            for (axis, twist) in twist.iter_mut().enumerate() {
                let (to, way) = (seen.predicted.all()[axis], seen.way.all()[axis]);
                let x = |i: usize| to[i] - way[i];
                let was = (x(i) - x(i + across)) - (x(i + along) - x(i + along + across));
                *twist -= was * seen.before;
            }
        }
        if let Some((rest, ways)) = seen.rest
            && rest[i] != 0.0
        {
            let share = rest[i] * (1.0 - seen.before);
            let n = ways.at(i).to_array();
            twist.iter_mut().zip(n).for_each(|(twist, n)| *twist -= n * share);
        }
        twist
    }
}
