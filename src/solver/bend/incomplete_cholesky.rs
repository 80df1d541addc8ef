//! Incomplete Cholesky factorisation of M + h² K, which preconditions implicit bending of meshes.
//!
//! ```text
//! M + h² K ≈ P = Uᵀ D U        U: unit upper triangle with few entries per row, D: diagonal
//! ```
//! Method: row by row (Jones and Plassmann, "An improved incomplete Cholesky factorization", TOMS
//! 1995). Entries below a size are dropped (Saad, "ILUT", 1994). Both pivots take on a dropped entry:
//! its value if it is positive or small, so that rigid displacements stay exact (Gustafsson 1978);
//! its absolute value otherwise, so that P is stiffer than the matrix (Ajiz and Jennings 1984). The
//! size is relative to the masses, so P is nearly exact for soft and for narrow meshes.
//!
//! Reads the stiffness matrix and masses; `solve` reads and writes vectors of the particles.
//! Invariant: a pivot is at least the mass, as in the exact factorisation, so P is positive
//! definite. Sums have a fixed order, so the bits are the same on every platform.

use crate::math::heap_bytes::heap_bytes;
use crate::math::sort::{sort, sort_measured};
use crate::math::{max, min};
use crate::solver::bend::stiffness_matrix::{Entry, StiffnessMatrix};
use glam::Vec4;

/// Largest number of entries per row.
const MAX_ENTRIES: usize = 16;

/// Entries up to this share of the geometric mean of masses and diagonals at both particles are
/// dropped.
const MAX_DROPPED: f64 = 0.02;
const MAX_DROPPED_4: f64 = MAX_DROPPED * MAX_DROPPED * MAX_DROPPED * MAX_DROPPED;

/// Dropped negative entries count as small, and reduce both pivots, up to this share of the lighter
/// mass.
const MAX_REMOVED: f32 = 0.02;

/// End of a list of rows.
const NONE: u32 = u32::MAX;

/// The row of a particle during the factorisation.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// Entry of the current row in this column, valid if `owner` is the current row.
    value: f32,
    owner: u32,
    /// First of the rows whose next entry is in this column, and the row after this one in the list
    /// that it is in.
    first: u32,
    next: u32,
    /// Next entry of this row to be used.
    cursor: u32,
    /// Diagonal of the matrix, and of D [kg].
    diagonal: f32,
    pivot: f32,
    /// Sum of the absolute differences between P and the matrix in this row [kg].
    error: f32,
}

/// The factors U and D, and buffers to compute them.
#[derive(Clone, Debug, Default)]
pub(crate) struct IncompleteCholesky {
    /// End of each row in `entries`.
    ends: Vec<u32>,
    /// Entries of U above the diagonal, sorted by row and column.
    entries: Vec<Entry>,
    /// Inverse of D; 0 for held particles [1/kg].
    inverse_pivot: Vec<f32>,
    /// Bound of the relative error of P for any displacement.
    error: f32,
    rows: Vec<Row>,
    /// Columns of the current row.
    columns: Vec<u32>,
    /// Entries of the current row by ascending size: negative size, column, 0.
    candidates: Vec<(f64, u32, u32)>,
}

heap_bytes!(
    IncompleteCholesky {
        ends, entries, inverse_pivot, rows, columns, candidates,
    } plain { error }
);

impl IncompleteCholesky {
    /// Allocates the factors of a matrix with at most `capacity` rows.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            ends: Vec::with_capacity(capacity),
            entries: Vec::with_capacity(capacity * MAX_ENTRIES),
            inverse_pivot: Vec::with_capacity(capacity),
            error: 0.0,
            rows: Vec::with_capacity(capacity),
            columns: Vec::with_capacity(capacity),
            candidates: Vec::with_capacity(capacity),
        }
    }

    /// Bound of the relative error of P for any displacement: it is at most as stiff and as heavy as
    /// 1 + this times the matrix.
    pub fn error(&self) -> f32 {
        self.error
    }

    /// Factorises the matrix for these masses, which are 0 for held particles.
    #[inline(never)]
    pub fn factorise(&mut self, matrix: &StiffnessMatrix, mass: &[f32]) {
        self.rows.clear();
        self.rows.extend(mass.iter().zip(matrix.diagonal()).map(|(mass, diagonal)| Row {
            value: 0.0,
            owner: NONE,
            first: NONE,
            next: NONE,
            cursor: 0,
            diagonal: mass + diagonal,
            pivot: mass + diagonal,
            error: 0.0,
        }));
        self.entries.clear();
        self.ends.clear();
        self.inverse_pivot.clear();
        self.error = 0.0;
        for row in 0..mass.len() {
            let start = self.entries.len() as u32;
            let mut inverse_pivot = 0.0;
            self.columns.clear();
            if mass[row] > 0.0 {
                matrix.for_each_in_row(row, |Entry { column, stiffness }| {
                    if mass[column as usize] > 0.0 {
                        self.add(row, column, -stiffness);
                    }
                });
                self.subtract_rows_above(row);
                self.store_row(row, mass);
                inverse_pivot = 1.0 / max(self.rows[row].pivot, mass[row]);
            }
            self.inverse_pivot.push(inverse_pivot);
            self.ends.push(self.entries.len() as u32);
            self.append_to_list(row, start);
        }
        let mut start = 0;
        for (row, inverse_pivot) in self.inverse_pivot.iter().enumerate() {
            let end = self.ends[row] as usize;
            self.entries[start..end].iter_mut().for_each(|entry| entry.stiffness *= inverse_pivot);
            start = end;
            if mass[row] > 0.0 {
                self.error = max(self.error, self.rows[row].error / mass[row]);
            }
        }
    }

    /// Adds `value` to an entry of the current row.
    fn add(&mut self, row: usize, column: u32, value: f32) {
        let at = &mut self.rows[column as usize];
        if at.owner == row as u32 {
            at.value += value;
        } else {
            (at.owner, at.value) = (row as u32, value);
            self.columns.push(column);
        }
    }

    /// Eliminates all rows above that have an entry in this column.
    fn subtract_rows_above(&mut self, row: usize) {
        let mut above = self.rows[row].first;
        while above != NONE {
            let Row { cursor, next, .. } = self.rows[above as usize];
            let entry = self.entries[cursor as usize].stiffness;
            let multiplier = entry * self.inverse_pivot[above as usize];
            self.rows[row].pivot -= multiplier * entry;
            for at in cursor + 1..self.ends[above as usize] {
                let Entry { column, stiffness } = self.entries[at as usize];
                self.add(row, column, -(multiplier * stiffness));
            }
            self.append_to_list(above as usize, cursor + 1);
            above = next;
        }
    }

    /// Adds a row to the list of the column of its entry `cursor`, if it has that.
    fn append_to_list(&mut self, row: usize, cursor: u32) {
        if cursor < self.ends[row] {
            let first = &mut self.rows[self.entries[cursor as usize].column as usize].first;
            let next = core::mem::replace(first, row as u32);
            (self.rows[row].cursor, self.rows[row].next) = (cursor, next);
        }
    }

    /// Appends the largest entries of the current row to the factor, and drops the others.
    fn store_row(&mut self, row: usize, mass: &[f32]) {
        let size_of = |at: &Row, mass: f32| f64::from(at.diagonal) * f64::from(mass);
        let limit = MAX_DROPPED_4 * size_of(&self.rows[row], mass[row]);
        self.candidates.clear();
        for at in 0..self.columns.len() {
            let column = self.columns[at];
            let other = &self.rows[column as usize];
            let square = f64::from(other.value) * f64::from(other.value);
            let size = square * square / size_of(other, mass[column as usize]);
            if size > limit {
                self.candidates.push((-size, column, 0));
            } else {
                self.drop_entry(row, column, mass);
            }
        }
        if self.candidates.len() > MAX_ENTRIES {
            sort_measured(&mut self.candidates);
            for at in MAX_ENTRIES..self.candidates.len() {
                self.drop_entry(row, self.candidates[at].1, mass);
            }
            self.candidates.truncate(MAX_ENTRIES);
        }
        self.columns.clear();
        self.columns.extend(self.candidates.iter().map(|(_, column, _)| *column));
        sort(&mut self.columns);
        for column in &self.columns {
            let stiffness = self.rows[*column as usize].value;
            self.entries.push(Entry { column: *column, stiffness });
        }
    }

    fn drop_entry(&mut self, row: usize, column: u32, mass: &[f32]) {
        let column = column as usize;
        let value = self.rows[column].value;
        let moved = if value > -MAX_REMOVED * min(mass[row], mass[column]) {
            [value; 2]
        } else {
            let scale = (self.rows[row].diagonal / self.rows[column].diagonal).sqrt();
            [-value * scale, -value / scale]
        };
        for (at, moved) in [row, column].into_iter().zip(moved) {
            self.rows[at].pivot += moved;
            self.rows[at].error += value.abs() + moved.abs();
        }
    }

    /// Solves P x = `residual`.
    #[inline(never)]
    pub fn solve(&self, residual: &[Vec4], x: &mut [Vec4]) {
        x.copy_from_slice(residual);
        let mut start = 0;
        for row in 0..x.len() {
            let (from, end) = (x[row], self.ends[row] as usize);
            for entry in &self.entries[start..end] {
                x[entry.column as usize] -= from * entry.stiffness;
            }
            x[row] = from * self.inverse_pivot[row];
            start = end;
        }
        for row in (0..x.len()).rev() {
            let end = start;
            start = if row > 0 { self.ends[row - 1] as usize } else { 0 };
            // The nearest row comes last, because its value was computed just before.
            let mut sum = x[row];
            for entry in self.entries[start..end].iter().rev() {
                sum -= x[entry.column as usize] * entry.stiffness;
            }
            x[row] = sum;
        }
    }
}
