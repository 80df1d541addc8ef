//! Pentadiagonal systems along the rows or the columns of a grid, factored once and solved often.
//!
//! ```text
//! (µ M + h² K) y = f      K: squared second differences a − 2 m + b along a line, 5 diagonals
//! L D Lᵀ                  L has two subdiagonals `near` and `far`
//! ```
//! Method: L D Lᵀ factorisation without pivoting, in f64; forward and backward substitution in f32.
//! Rows solve x, y and z together; columns solve all columns of a grid together, so the loops
//! vectorise.
//!
//! Reads element weights, masses and inverse masses; `factor` writes the factors and the solvers
//! replace a right side by the solution.
//! Invariant: a held particle (w = 0) is not part of its system; its solution is 0.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::zeros;
use crate::math::simd::{Level, leveled};

/// Columns x, y, z of a vector per particle.
pub(crate) type VectorColumns = [Vec<f32>; 3];

/// L D Lᵀ factors of a pentadiagonal matrix per line.
#[derive(Clone, Debug, Default)]
pub(crate) struct PentadiagonalFactor {
    /// Inverse of D; 0 for a held particle.
    inverse: Vec<f32>,
    /// First and second subdiagonal of L.
    near: Vec<f32>,
    far: Vec<f32>,
}

heap_bytes!(PentadiagonalFactor { inverse, near, far } plain {});

/// Particles of a row or a column: `count` of them from `first` on, `step` apart.
#[derive(Clone, Copy)]
pub(crate) struct GridLine {
    pub first: usize,
    pub step: usize,
    pub count: usize,
}

impl PentadiagonalFactor {
    /// Allocates factors for `count` particles.
    pub fn new(count: usize) -> Self {
        let list = || zeros(count);
        Self { inverse: list(), near: list(), far: list() }
    }

    /// Factors µ M + h² K along a line.
    ///
    /// `weight` is the stiffness of each element relative to an interior one, `stiffness` that of
    /// an interior element times h² [kg], `shift` is µ.
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
        let k_interior = f64::from(stiffness);
        // D of the two previous particles, and `near` of the last one.
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
                + k_interior * (4.0 * weight(k) + before + weight(k + 1));
            let has = |distance: usize| k >= distance && !is_held(k - distance);
            let near = if has(1) { -2.0 * k_interior * (weight(k) + before) } else { 0.0 };
            let far = if has(2) { k_interior * before } else { 0.0 };
            let l_far = far / last_but_one;
            let l_near = (near - far * last_near) / last;
            let d = diagonal - l_near * l_near * last - l_far * l_far * last_but_one;
            self.inverse[i] = (1.0 / d) as f32;
            self.near[i] = l_near as f32;
            self.far[i] = l_far as f32;
            (last_but_one, last, last_near) = (last, d, l_near);
        }
    }

    /// Solves all rows in place.
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

    /// Solves all columns in place.
    pub fn solve_columns(&self, level: Level, columns: usize, v: &mut VectorColumns) {
        v.iter_mut().for_each(|v| substitute_columns(level, v, self, columns));
    }
}

leveled! {
    /// Forward and backward substitution along all columns.
    fn substitute_columns(v: &mut [f32], factor: &PentadiagonalFactor, columns: usize)
        = substitute_columns_lanes
}

#[inline(always)]
fn substitute_columns_lanes(v: &mut [f32], factor: &PentadiagonalFactor, columns: usize) {
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
