//! Rows of a grid that are alike, one after the other with nothing to find out for each; or one
//! row.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::simd::{MAX_LANES, Simd};
use crate::model::grid_rows::LinkRow;
use crate::solver::stretch::grid_kernel::row_chunk::{Chunk, Terms};
use crate::solver::stretch::grid_kernel::row_layout::{Lists, Spot, in_chunks_of};
use crate::solver::stretch::grid_links::{STRAIGHT, solve_last};
use crate::solver::stretch::link_projection::{BOUND, RIGID};
use core::ops::Range;

/// Links that go together, about: the positions at their ends fit into the nearest memory several
/// times.
const BLOCK: usize = 1024;

/// Rows that differ in nothing but their places, which are as far from each other.
pub(crate) struct Alike {
    first: Spot,
    last: Spot,
    /// What leads from one to the next.
    step: Spot,
    rows: usize,
    /// How many links of each go in chunks.
    count: usize,
    /// From which link of each to before which the two ends weigh the same.
    even: [usize; 2],
}

impl Alike {
    /// Finds out where they are.
    ///
    /// # Panics
    /// If they do not lie within the lists, or are not alike.
    #[inline(always)]
    pub fn of<const PATTERN: u8>(lists: &Lists, rows: &[LinkRow]) -> Self {
        let spot = |row: &LinkRow| lists.spot::<PATTERN>(row, in_chunks_of::<PATTERN>(row));
        let (first, last) = (&rows[0], &rows[rows.len() - 1]);
        // There may be no next.
        let step = rows.get(1).map_or(0, |next| next.a - first.a) as usize;
        let step = Spot { a: step, b: step, link: first.count as usize };
        let own = Self {
            first: spot(first),
            last: spot(last),
            step,
            rows: rows.len(),
            count: in_chunks_of::<PATTERN>(first),
            even: first.equal_mass.map(|link| link.saturating_sub(first.first) as usize),
        };
        let are_alike = last.count == first.count && own.row(own.rows - 1) == own.last;
        assert!(are_alike, "rows are alike");
        own
    }

    /// Where a row begins: between the first and the last.
    #[inline(always)]
    fn row(&self, number: usize) -> Spot {
        let Self { first, step, .. } = self;
        Spot {
            a: first.a + number * step.a,
            b: first.b + number * step.b,
            link: first.link + number * step.link,
        }
    }

    /// Solves all their links.
    #[inline(always)]
    pub fn solve<S: Simd, const LAW: u8, const PATTERN: u8>(
        &self,
        s: S,
        lists: &Lists,
        terms: Terms,
    ) {
        let left = self.count % S::LANES;
        let whole = self.count - left;
        let chunks = whole / S::LANES;
        // What weighs the same at both ends, as nearly all does, has less to compute.
        let [from, to] = self.even;
        let from = if LAW == BOUND { chunks } else { from.div_ceil(S::LANES).min(chunks) };
        let to = (to / S::LANES).clamp(from, chunks);
        // Chunks of a kind go together, in so few rows that these are still near when the others
        // come.
        let block = (BLOCK / self.count.max(1)).max(1);
        // SAFETY: the first and the last row lie within the lists, and all others between them.
        unsafe {
            for first in (0..self.rows).step_by(block) {
                let rows = first..(first + block).min(self.rows);
                for chunks in [0..from, to..chunks] {
                    let part = (rows.clone(), chunks);
                    self.solve_chunks::<S, LAW, PATTERN, false>(s, lists, part, terms);
                }
                if LAW != BOUND {
                    let part = (rows, from..to);
                    self.solve_chunks::<S, LAW, PATTERN, true>(s, lists, part, terms);
                }
            }
            if left == 0 {
                return;
            }
            // Two ends that fill half a chunk each are one, where all that is loaded for them are
            // places.
            let is_even = self.even[0] <= whole && self.even[1] >= self.count;
            let mut rows = 0..self.rows;
            if LAW == RIGID && PATTERN != STRAIGHT && is_even && 2 * left <= S::LANES {
                let by_twos = rows.clone();
                rows.start =
                    self.solve_ends::<S, LAW, PATTERN, true>(s, lists, by_twos, left, terms);
            }
            self.solve_ends::<S, LAW, PATTERN, false>(s, lists, rows, left, terms);
        }
    }

    /// Solves some whole chunks of each of some rows.
    ///
    /// # Safety
    /// There are such chunks and rows, all within the lists.
    #[inline(always)]
    unsafe fn solve_chunks<S: Simd, const LAW: u8, const PATTERN: u8, const IS_EVEN: bool>(
        &self,
        s: S,
        lists: &Lists,
        (rows, chunks): (Range<usize>, Range<usize>),
        terms: Terms,
    ) {
        let (count, mut rows_left) = (chunks.len(), rows.len());
        if count == 0 {
            return;
        }
        let mut spot = self.row(rows.start).after::<PATTERN>(chunks.start * S::LANES);
        // From behind the last of a row to the first of the next; of a row alone, wherever that is.
        let done = Spot::default().after::<PATTERN>(count * S::LANES);
        let step = self.step.before(done);
        // SAFETY: the caller's promise.
        unsafe {
            while rows_left > 0 {
                for _ in 0..count {
                    let place = lists.place::<S, PATTERN>(spot);
                    let chunk = Chunk::of::<LAW, PATTERN, IS_EVEN>(s, place, terms);
                    chunk.finish::<LAW, PATTERN>(s, place);
                    spot = spot.after::<PATTERN>(S::LANES);
                }
                spot = spot.behind(step);
                rows_left -= 1;
            }
        }
    }

    /// Solves the last `left` links of some rows, fewer than a chunk; with `BY_TWOS` set, those of
    /// two rows at a time, as far as there are two and room. Gives the first row that it left.
    ///
    /// # Safety
    /// All rows lie within the lists; two ends of even links fit into a chunk, each in half of it,
    /// if they are to go by twos.
    #[inline(always)]
    unsafe fn solve_ends<S: Simd, const LAW: u8, const PATTERN: u8, const BY_TWOS: bool>(
        &self,
        s: S,
        lists: &Lists,
        rows: Range<usize>,
        left: usize,
        terms: Terms,
    ) -> usize {
        let end = |number: usize| self.row(number).after::<PATTERN>(self.count - left);
        // Chunks that reach over the ends of the last rows may reach over those of the lists.
        let mut roomy = rows.end;
        while roomy > rows.start && !lists.have_room::<PATTERN>(end(roomy - 1), S::LANES) {
            roomy -= 1;
        }
        let (mut spot, mut step) = (end(rows.start), self.step);
        let (mut keep, mut count) = ([0.0; MAX_LANES], roomy - rows.start);
        keep[..left].fill(1.0);
        if PATTERN != STRAIGHT {
            spot.b = spot.a + S::LANES;
        }
        if BY_TWOS {
            spot.b = end(rows.start + 1).a;
            keep[S::LANES / 2..][..left].fill(1.0);
            (step, count) = (step.behind(step), count / 2);
        }
        // SAFETY: the caller's promise, and there is room.
        unsafe {
            if count > 0 {
                let keep = s.load(&keep, 0);
                for _ in 0..count {
                    let place = lists.place_of(spot);
                    let chunk = Chunk::of::<LAW, PATTERN, BY_TWOS>(s, place, terms);
                    chunk.finish_only::<LAW, PATTERN>(s, place, keep);
                    spot = spot.behind(step);
                }
            }
            if BY_TWOS {
                return rows.start + 2 * count;
            }
            for number in roomy..rows.end {
                let done = self.count - left;
                solve_last::<LAW, PATTERN>(lists, self.row(number), done, self.count, terms);
            }
            rows.end
        }
    }
}
