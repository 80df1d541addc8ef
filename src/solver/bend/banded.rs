//! Systems of five diagonals along the rows or the columns of a grid, factored once and solved often.
//!
//! Along rows x, y and z go together; along columns, all columns. What is held is out of its system.

use crate::math::simd::{Level, leveled};

/// VectorColumns columns of numbers.
pub(crate) type VectorColumns = [Vec<f32>; 3];

/// L D Lᵀ of five diagonals.
#[derive(Clone, Debug, Default)]
pub(crate) struct PentadiagonalFactor {
    /// One over D; 0 for what is held.
    inverse: Vec<f32>,
    /// L beside the diagonal, and beside that.
    near: Vec<f32>,
    far: Vec<f32>,
}

/// Particles along a line of a grid.
#[derive(Clone, Copy)]
pub(crate) struct GridLine {
    pub first: usize,
    pub step: usize,
    pub count: usize,
}

impl PentadiagonalFactor {
    /// Room for so many particles.
    pub fn new(count: usize) -> Self {
        let list = || vec![0.0; count];
        Self { inverse: list(), near: list(), far: list() }
    }

    /// Factors µM + h² K along a line, with elements so stiff over one inside.
    pub fn factor(
        &mut self,
        line: GridLine,
        weight: &[f32],
        w: &[f32],
        mass: &[f32],
        stiffness: f32,
        shift: f32,
    ) {
        let at = |k: usize| line.first + k * line.step;
        let weight = |k: usize| if k < line.count { f64::from(weight[at(k)]) } else { 0.0 };
        let is_held = |k: usize| w[at(k)] == 0.0;
        let k_all = f64::from(stiffness);
        // D, and L beside it, of the two particles before.
        let (mut last, mut last_but_one, mut last_near) = (1.0, 1.0, 0.0);
        for k in 0..line.count {
            let i = at(k);
            if is_held(k) {
                (self.inverse[i], self.near[i], self.far[i]) = (0.0, 0.0, 0.0);
                (last_but_one, last, last_near) = (last, 1.0, 0.0);
                continue;
            }
            let before = if k > 0 { weight(k - 1) } else { 0.0 };
            let diagonal = f64::from(mass[i]) * f64::from(shift)
                + k_all * (4.0 * weight(k) + before + weight(k + 1));
            let has = |reach: usize| k >= reach && !is_held(k - reach);
            let near = if has(1) { -2.0 * k_all * (weight(k) + before) } else { 0.0 };
            let far = if has(2) { k_all * before } else { 0.0 };
            let l_far = far / last_but_one;
            let l_near = (near - far * last_near) / last;
            let d = diagonal - l_near * l_near * last - l_far * l_far * last_but_one;
            self.inverse[i] = (1.0 / d) as f32;
            self.near[i] = l_near as f32;
            self.far[i] = l_far as f32;
            (last_but_one, last, last_near) = (last, d, l_near);
        }
    }

    /// Along each row, from end to end and back.
    pub fn solve_rows(&self, columns: usize, v: &mut VectorColumns) {
        let [x, y, z] = v;
        let factors = self.inverse.chunks_exact(columns).zip(self.near.chunks_exact(columns));
        let factors = factors.zip(self.far.chunks_exact(columns));
        let rows = x.chunks_exact_mut(columns).zip(y.chunks_exact_mut(columns));
        let rows = rows.zip(z.chunks_exact_mut(columns));
        for (((x, y), z), ((inverse, near), far)) in rows.zip(factors) {
            let (mut last, mut before) = ([0.0; 3], [0.0; 3]);
            for k in 0..columns {
                let now = [x[k], y[k], z[k]];
                let mut next = [0.0; 3];
                for axis in 0..3 {
                    next[axis] = now[axis] - far[k] * before[axis] - near[k] * last[axis];
                }
                [x[k], y[k], z[k]] = next;
                (before, last) = (last, next);
            }
            (last, before) = ([0.0; 3], [0.0; 3]);
            let (mut near_last, mut far_last, mut far_before) = (0.0, 0.0, 0.0);
            for k in (0..columns).rev() {
                let now = [x[k], y[k], z[k]];
                let mut next = [0.0; 3];
                for axis in 0..3 {
                    next[axis] =
                        now[axis] * inverse[k] - far_before * before[axis] - near_last * last[axis];
                }
                [x[k], y[k], z[k]] = next;
                (before, last) = (last, next);
                (far_before, far_last, near_last) = (far_last, far[k], near[k]);
            }
        }
    }

    /// Along all columns at once.
    pub fn solve_columns(&self, level: Level, columns: usize, v: &mut VectorColumns) {
        v.iter_mut().for_each(|v| down_and_up(level, v, self, columns));
    }
}

leveled! {
    fn down_and_up(v: &mut [f32], factor: &PentadiagonalFactor, columns: usize) = down_and_up_lanes
}

#[inline(always)]
fn down_and_up_lanes(v: &mut [f32], factor: &PentadiagonalFactor, columns: usize) {
    let count = v.len();
    for first in (columns..count).step_by(columns) {
        let (above, row) = v.split_at_mut(first);
        let row = &mut row[..columns];
        let near = &factor.near[first..first + columns];
        let far = &factor.far[first..first + columns];
        let last = &above[first - columns..];
        if first >= 2 * columns {
            let before = &above[first - 2 * columns..first - columns];
            for ((((v, near), far), last), before) in
                row.iter_mut().zip(near).zip(far).zip(last).zip(before)
            {
                *v = *v - far * before - near * last;
            }
        } else {
            for ((v, near), last) in row.iter_mut().zip(near).zip(last) {
                *v -= near * last;
            }
        }
    }
    for (v, inverse) in v.iter_mut().zip(&factor.inverse) {
        *v *= inverse;
    }
    for first in (0..count - columns).step_by(columns).rev() {
        let (above, below) = v.split_at_mut(first + columns);
        let row = &mut above[first..];
        let near = &factor.near[first + columns..first + 2 * columns];
        let last = &below[..columns];
        if below.len() >= 2 * columns {
            let far = &factor.far[first + 2 * columns..first + 3 * columns];
            let before = &below[columns..2 * columns];
            for ((((v, near), far), last), before) in
                row.iter_mut().zip(near).zip(far).zip(last).zip(before)
            {
                *v = *v - far * before - near * last;
            }
        } else {
            for ((v, near), last) in row.iter_mut().zip(near).zip(last) {
                *v -= near * last;
            }
        }
    }
}
