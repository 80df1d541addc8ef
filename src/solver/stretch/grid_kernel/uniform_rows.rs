//! Rows of a grid that differ only in their position, solved in one loop; also single rows.
//!
//! ```text
//! row 0   ▓▓▓▓ ▓▓▓▓ ▓▓▓▓ ▒      ▓ whole chunks, ▒ tail (fewer links than lanes)
//! row 1   ▓▓▓▓ ▓▓▓▓ ▓▓▓▓ ▒      order: whole chunks of a block of rows, …, then all tails
//! row 2   ▓▓▓▓ ▓▓▓▓ ▓▓▓▓ ▒
//! ```
//! Cursors advance by a constant step, so that nothing is read from the rows themselves. Chunks
//! whose ends all have equal weights use a shorter kernel, in a loop of their own. A tail is one
//! chunk that reaches beyond its row; masked lanes are stored unchanged. The next row would have to
//! wait for that store, so tails come after the whole chunks of many rows.
//!
//! Reads rows, and particles and links through `GridPointers`; writes positions and λ.
//! Invariant: the links of these rows are of one colour, so their order does not change the result.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::simd::{MAX_LANES, Simd};
use crate::model::grid_rows::LinkRow;
use crate::solver::stretch::grid_kernel::grid_slices::STRAIGHT;
use crate::solver::stretch::grid_kernel::row_chunk::{LinkChunk, RowParameters, solve_row_tail};
use crate::solver::stretch::grid_kernel::row_layout::{
    GridPointers, RowCursor, simd_link_count_of,
};
use crate::solver::stretch::link_projection::{BOUND, RIGID};
use core::ops::Range;

/// The number of links of a block of rows: the positions at their ends fit several times into the
/// L1 cache.
const LINKS_PER_BLOCK: usize = 1024;

/// Rows at a constant distance from each other, and alike otherwise.
pub(crate) struct UniformRows {
    first: RowCursor,
    last: RowCursor,
    /// The distance from a row to the next.
    step: RowCursor,
    rows: usize,
    /// The number of links of each row that go through SIMD chunks.
    count: usize,
    /// The range of links of each row whose two ends have equal weights.
    even: [usize; 2],
}

impl UniformRows {
    /// Checks the rows and computes their cursors.
    ///
    /// # Panics
    /// If they do not lie within the slices, or differ in more than their position.
    #[inline(always)]
    pub fn new<const PATTERN: u8>(pointers: &GridPointers, rows: &[LinkRow]) -> Self {
        let cursor =
            |row: &LinkRow| pointers.cursor::<PATTERN>(row, simd_link_count_of::<PATTERN>(row));
        let (first, last) = (&rows[0], &rows[rows.len() - 1]);
        // A single row has no next one.
        let step = rows.get(1).map_or(0, |next| next.a - first.a) as usize;
        let step = RowCursor { a: step, b: step, link: first.count as usize };
        let own = Self {
            first: cursor(first),
            last: cursor(last),
            step,
            rows: rows.len(),
            count: simd_link_count_of::<PATTERN>(first),
            even: first.equal_mass.map(|link| link.saturating_sub(first.first) as usize),
        };
        let are_uniform = last.count == first.count && own.row(own.rows - 1) == own.last;
        assert!(are_uniform, "uniform rows lie at a constant distance");
        own
    }

    /// The cursor at the first link of a row.
    #[inline(always)]
    fn row(&self, number: usize) -> RowCursor {
        let Self { first, step, .. } = self;
        RowCursor {
            a: first.a + number * step.a,
            b: first.b + number * step.b,
            link: first.link + number * step.link,
        }
    }

    /// Solves all links of all rows that go through SIMD chunks.
    #[inline(always)]
    pub fn solve<S: Simd, const LAW: u8, const PATTERN: u8>(
        &self,
        s: S,
        pointers: &GridPointers,
        parameters: RowParameters,
    ) {
        let tail = self.count % S::LANES;
        let whole = self.count - tail;
        let chunks = whole / S::LANES;
        // Chunks `from..to` have equal weights at both ends of all links, which is nearly all of
        // them.
        let [from, to] = self.even;
        let from = if LAW == BOUND { chunks } else { from.div_ceil(S::LANES).min(chunks) };
        let to = (to / S::LANES).clamp(from, chunks);
        // The positions of a block are still in the cache when its other chunks are solved.
        let block = (LINKS_PER_BLOCK / self.count.max(1)).max(1);
        // SAFETY: the first and the last row lie within the slices, and all others between them.
        unsafe {
            for first in (0..self.rows).step_by(block) {
                let rows = first..(first + block).min(self.rows);
                for chunks in [0..from, to..chunks] {
                    let part = (rows.clone(), chunks);
                    self.solve_chunks::<S, LAW, PATTERN, false>(s, pointers, part, parameters);
                }
                if LAW != BOUND {
                    let part = (rows, from..to);
                    self.solve_chunks::<S, LAW, PATTERN, true>(s, pointers, part, parameters);
                }
            }
            if tail == 0 {
                return;
            }
            // Two tails of at most half a chunk share one chunk, if nothing but positions is
            // loaded.
            let is_even = self.even[0] <= whole && self.even[1] >= self.count;
            let mut rows = 0..self.rows;
            if LAW == RIGID && PATTERN != STRAIGHT && is_even && 2 * tail <= S::LANES {
                let pairs = rows.clone();
                rows.start =
                    self.solve_tails::<S, LAW, PATTERN, true>(s, pointers, pairs, tail, parameters);
            }
            self.solve_tails::<S, LAW, PATTERN, false>(s, pointers, rows, tail, parameters);
        }
    }

    /// Solves a range of whole chunks of a range of rows.
    ///
    /// # Safety
    /// These chunks and rows exist and lie within the slices.
    #[inline(always)]
    unsafe fn solve_chunks<S: Simd, const LAW: u8, const PATTERN: u8, const IS_EVEN: bool>(
        &self,
        s: S,
        pointers: &GridPointers,
        (rows, chunks): (Range<usize>, Range<usize>),
        parameters: RowParameters,
    ) {
        let (count, mut rows_left) = (chunks.len(), rows.len());
        if count == 0 {
            return;
        }
        let mut cursor = self.row(rows.start).advance::<PATTERN>(chunks.start * S::LANES);
        // The step from the end of the chunks of a row to their start in the next row. It may be
        // negative, so it wraps around.
        let done = RowCursor::default().advance::<PATTERN>(count * S::LANES);
        let step = self.step.minus(done);
        // SAFETY: the caller guarantees it.
        unsafe {
            while rows_left > 0 {
                for _ in 0..count {
                    let at = pointers.chunk::<S, PATTERN>(cursor);
                    let chunk = LinkChunk::compute::<LAW, PATTERN, IS_EVEN>(s, at, parameters);
                    chunk.apply::<LAW, PATTERN>(s, at);
                    cursor = cursor.advance::<PATTERN>(S::LANES);
                }
                cursor = cursor.offset_by(step);
                rows_left -= 1;
            }
        }
    }

    /// Solves the last `tail` links of a range of rows, and returns the first row that is left.
    ///
    /// With `PAIRED`, the tails of two rows share a chunk; an odd last row, and rows at the end of
    /// the slices, are left.
    ///
    /// # Safety
    /// All rows lie within the slices; `tail` is less than a chunk, with `PAIRED` at most half a
    /// chunk of links whose ends have equal weights.
    #[inline(always)]
    unsafe fn solve_tails<S: Simd, const LAW: u8, const PATTERN: u8, const PAIRED: bool>(
        &self,
        s: S,
        pointers: &GridPointers,
        rows: Range<usize>,
        tail: usize,
        parameters: RowParameters,
    ) -> usize {
        let end = |number: usize| self.row(number).advance::<PATTERN>(self.count - tail);
        // A chunk that reaches beyond one of the last rows may reach beyond the slices.
        let mut contained = rows.end;
        while contained > rows.start && !pointers.contains::<PATTERN>(end(contained - 1), S::LANES)
        {
            contained -= 1;
        }
        let (mut cursor, mut step) = (end(rows.start), self.step);
        let (mut mask, mut count) = ([0.0; MAX_LANES], contained - rows.start);
        mask[..tail].fill(1.0);
        if PATTERN != STRAIGHT {
            cursor.b = cursor.a + S::LANES;
        }
        if PAIRED {
            cursor.b = end(rows.start + 1).a;
            mask[S::LANES / 2..][..tail].fill(1.0);
            (step, count) = (step.offset_by(step), count / 2);
        }
        // SAFETY: the caller guarantees it, and the chunks lie within the slices.
        unsafe {
            if count > 0 {
                let mask = s.load(&mask, 0);
                for _ in 0..count {
                    let at = pointers.chunk_of_halves(cursor);
                    let chunk = LinkChunk::compute::<LAW, PATTERN, PAIRED>(s, at, parameters);
                    chunk.apply_masked::<LAW, PATTERN>(s, at, mask);
                    cursor = cursor.offset_by(step);
                }
            }
            if PAIRED {
                return rows.start + 2 * count;
            }
            for number in contained..rows.end {
                let done = self.count - tail;
                let row = self.row(number);
                solve_row_tail::<LAW, PATTERN>(pointers, row, done, self.count, parameters);
            }
            rows.end
        }
    }
}
