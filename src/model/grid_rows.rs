//! Rows of links of a regular grid, whose particles lie at regular strides for SIMD loads.
//!
//! ```text
//! Straight  a+k ── b+k         two grid rows; also diagonals and vertical bend links
//! Pairs     a+2k ── a+2k+1     ●─● ●─● ●─●       neighbours in one row
//! Quads     a+k ── a+k+2       k = 0, 1, 4, 5, 8, …: every second in one row
//! ```
//! An optimised layout of the general list of links: same links, same colours. A link that is torn,
//! or gets another particle, leaves its row (its mask becomes 0). If it is still active it becomes
//! irregular and is solved by gather and scatter.
//!
//! Reads `Links` sorted by batch; writes rows, masks and the `SparseLinks` of irregular links.
//!
//! Invariant: a link is active exactly if its mask is 1 or it is in the irregular set.

use crate::math::heap_bytes::heap_bytes;
use crate::math::shared::Shared;
use crate::math::simd::MAX_LANES;
use crate::model::link_set::LinkSet;
use crate::model::links::{LinkBatch, Links};
use crate::model::sparse_links::SparseLinks;
use core::ops::Range;

/// Memory layout of the particles of a row of links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RowPattern {
    /// Link `k` joins `a + k` and `b + k`: particles of two rows of the grid.
    Straight,
    /// Link `k` joins `a + 2k` and `a + 2k + 1`: neighbours in one row.
    Pairs,
    /// Links join `a + k` and `a + k + 2` for k = 0, 1, 4, 5, 8, …: every second particle in one
    /// row.
    Quads,
}

/// A row of links.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkRow {
    pub pattern: RowPattern,
    /// First particle of the lower ends, and of the upper ends.
    pub a: u32,
    pub b: u32,
    /// First link, and number of links.
    pub first: u32,
    pub count: u32,
    /// Rest length of all its links [m].
    pub rest: f32,
    /// Whether a link has left the row.
    pub is_torn: bool,
    /// Range of links whose two ends have equal inverse masses, see
    /// `solver::stretch::inverse_masses`.
    pub equal_mass: [u32; 2],
    /// Number of rows from this one on that are uniform: not torn, the same range of equal masses,
    /// and a constant stride from one row to the next. 0 if this row is torn.
    pub uniform_run: u32,
}

/// All rows of a grid's links.
#[derive(Clone, Debug, Default)]
pub(crate) struct GridRows {
    pub rows: Vec<LinkRow>,
    /// 1 for a link in its row, 0 for one that left it.
    pub mask: Shared<Vec<f32>>,
    /// Active links that left their row.
    irregular: LinkSet,
    /// The irregular links as the kernels read them, batch by batch; valid after `rebuild_sparse`.
    pub sparse: SparseLinks,
    /// Row of each link.
    row_of: Shared<Vec<u32>>,
}

heap_bytes!(GridRows { rows, mask, irregular, sparse, row_of } plain {});

impl GridRows {
    /// Divides links into rows. `a`, `b` and `rest` describe the links of a fresh grid with
    /// `columns` columns, sorted by batch; `batch_starts` are the first links of the batches.
    pub fn new(columns: u32, [a, b]: [&[u32]; 2], rest: &[f32], batch_starts: &[usize]) -> Self {
        let mut rows: Vec<LinkRow> = Vec::new();
        let mut row_of = Vec::with_capacity(a.len());
        for link in 0..a.len() {
            let continues = rows.last_mut().is_some_and(|row| {
                let may_continue = rest[link] == row.rest && !row.is_full(columns);
                let fits =
                    may_continue && !batch_starts.contains(&link) && row.accepts(a[link], b[link]);
                row.count += u32::from(fits);
                fits
            });
            if !continues {
                rows.push(LinkRow::new(link as u32, (a[link], b[link]), rest[link]));
            }
            row_of.push(rows.len() as u32 - 1);
        }
        let (mask, row_of) = (Shared::new(vec![1.0; a.len()]), Shared::new(row_of));
        Self { rows, mask, row_of, ..Self::default() }
    }

    /// The rows of a batch, given its range of links.
    pub fn rows_of_batch(&self, range: Range<usize>) -> Range<usize> {
        let row = |link: usize| self.row_of.get(link).map_or(self.rows.len(), |row| *row as usize);
        row(range.start)..row(range.end)
    }

    /// The irregular links within `range`.
    #[cfg(feature = "parallel")]
    pub fn irregular_in(&self, range: Range<usize>) -> &[u32] {
        self.irregular.in_range(range)
    }

    /// Updates the row, mask and set of a link after its ends or its activity changed.
    pub fn update_link(&mut self, link: usize, ends: (u32, u32), is_active: bool) {
        let row = &self.rows[self.row_of[link] as usize];
        let is_in_place = row.ends(link as u32 - row.first) == ends;
        self.mask[link] = if is_in_place && is_active { 1.0 } else { 0.0 };
        if self.mask[link] == 0.0 {
            self.mark_torn(self.row_of[link] as usize);
        }
        self.irregular.set(link, is_active && !is_in_place);
    }

    /// Marks a row as torn, and shortens the uniform runs that contain it.
    fn mark_torn(&mut self, row: usize) {
        (self.rows[row].is_torn, self.rows[row].uniform_run) = (true, 0);
        let before = self.rows[..row].iter_mut().rev().zip(1..);
        for (row, until) in before.take_while(|(row, until)| row.uniform_run > *until) {
            row.uniform_run = until;
        }
    }

    /// Recomputes `uniform_run` of all rows, after `equal_mass` changed.
    pub fn rebuild_uniform_runs(&mut self) {
        for at in (0..self.rows.len()).rev() {
            let (rows, behind) = self.rows.split_at_mut(at + 1);
            let row = &mut rows[at];
            row.uniform_run = match behind {
                _ if row.is_torn => 0,
                [next, ..] if !row.has_same_layout(next) => 1,
                [next, after, ..] if next.uniform_run > 1 && after.a - next.a != next.a - row.a => {
                    2
                }
                [next, ..] => next.uniform_run + 1,
                [] => 1,
            };
        }
    }

    /// Rebuilds `sparse` from the irregular links, after links changed.
    pub fn rebuild_sparse(&mut self, links: &Links, batches: &[LinkBatch]) {
        self.sparse.clear();
        for batch in batches {
            let own = self.irregular.in_range(batch.first..batch.first + batch.count);
            self.sparse.push_batch(batch.kind, links, own);
        }
    }

    /// Allocates so that every link may become irregular.
    pub fn reserve(&mut self) {
        self.irregular.reserve(self.mask.len());
        self.sparse.reserve(self.mask.len());
    }
}

impl LinkRow {
    /// A row of one link.
    fn new(first: u32, (a, b): (u32, u32), rest: f32) -> Self {
        let pattern = match b - a {
            1 => RowPattern::Pairs,
            2 => RowPattern::Quads,
            _ => RowPattern::Straight,
        };
        Self {
            pattern,
            a,
            b,
            first,
            count: 1,
            rest,
            is_torn: false,
            equal_mass: [first; 2],
            uniform_run: 0,
        }
    }

    /// Whether the row has all links of one grid row and fills whole SIMD chunks. A longer row
    /// would place the unequal masses at grid borders between equal ones.
    fn is_full(&self, columns: u32) -> bool {
        let is_whole = self.pattern != RowPattern::Straight && 2 * self.count == columns;
        is_whole && self.count.is_multiple_of(MAX_LANES as u32)
    }

    /// Whether a link from `a` to `b` continues the row. In a straight row all lower ends lie
    /// before the upper ends.
    fn accepts(&self, a: u32, b: u32) -> bool {
        let fits = self.pattern != RowPattern::Straight || a < self.b;
        fits && self.ends(self.count) == (a, b)
    }

    /// Whether the next row has the same layout at another offset.
    fn has_same_layout(&self, next: &Self) -> bool {
        next.uniform_run > 0
            && next.pattern == self.pattern
            && next.count == self.count
            && next.rest == self.rest
            && next.first == self.first + self.count
            && next.a > self.a
            && next.b - next.a == self.b - self.a
            && next.equal_mass.map(|link| link - next.first)
                == self.equal_mass.map(|link| link - self.first)
    }

    /// The particles of link `k` of the row.
    #[inline(always)]
    pub fn ends(&self, k: u32) -> (u32, u32) {
        let along = match self.pattern {
            RowPattern::Straight => k,
            RowPattern::Pairs => 2 * k,
            RowPattern::Quads => k / 2 * 4 + k % 2,
        };
        (self.a + along, self.b + along)
    }

    /// Number of links whose lower end lies before `particle`.
    #[cfg(feature = "parallel")]
    pub fn count_before(&self, particle: u32) -> u32 {
        let along = particle.saturating_sub(self.a);
        let count = match self.pattern {
            RowPattern::Straight => along,
            RowPattern::Pairs => along.div_ceil(2),
            RowPattern::Quads => along / 4 * 2 + (along % 4).min(2),
        };
        count.min(self.count)
    }

    /// The part of the row within a range of links, which must overlap. A row of quads is cut
    /// between two quads.
    #[cfg(feature = "parallel")]
    pub fn slice(&self, links: Range<u32>) -> Self {
        let from = links.start.max(self.first) - self.first;
        let end = links.end.min(self.first + self.count) - self.first;
        let (a, b) = self.ends(from);
        Self { a, b, first: self.first + from, count: end - from, uniform_run: 0, ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rows of one colour of a grid of five columns: four rows, two grid rows apart.
    fn four_rows() -> GridRows {
        let a: Vec<u32> = (0..4).flat_map(|row| (0..5).map(move |k| 10 * row + k)).collect();
        let b: Vec<u32> = a.iter().map(|a| a + 5).collect();
        let mut rows = GridRows::new(5, [&a, &b], &[0.1; 20], &[0]);
        for row in &mut rows.rows {
            row.equal_mass = [row.first, row.first + row.count];
        }
        rows
    }

    fn uniform_run(rows: &GridRows) -> Vec<u32> {
        rows.rows.iter().map(|row| row.uniform_run).collect()
    }

    #[test]
    fn a_uniform_run_ends_at_a_row_with_other_masses_or_another_stride() {
        let mut rows = four_rows();
        rows.rebuild_uniform_runs();
        assert_eq!(uniform_run(&rows), [4, 3, 2, 1]);
        rows.rows[1].equal_mass[0] += 1;
        rows.rebuild_uniform_runs();
        assert_eq!(uniform_run(&rows), [1, 1, 2, 1]);
        let mut rows = four_rows();
        (rows.rows[3].a, rows.rows[3].b) = (rows.rows[3].a + 1, rows.rows[3].b + 1);
        rows.rebuild_uniform_runs();
        assert_eq!(uniform_run(&rows), [3, 2, 2, 1]);
    }

    #[test]
    fn a_uniform_run_ends_at_a_torn_row() {
        let mut rows = four_rows();
        rows.rebuild_uniform_runs();
        let (link, ends) = (11, (21, 26));
        rows.update_link(link, ends, true);
        assert_eq!(uniform_run(&rows), [4, 3, 2, 1], "nothing changed");
        rows.update_link(link, ends, false);
        assert_eq!(uniform_run(&rows), [2, 1, 0, 1]);
    }
}
