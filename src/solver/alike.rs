//! Rows of a grid that are alike, one after the other with nothing to find out for each; or one row.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use super::chunk::Chunk;
use super::links::BOUND;
use super::places::{Lists, Spot, in_chunks_of};
use super::rows::{solve_end, solve_run};
use crate::fabric::rows::Row;
use crate::math::simd::Simd;

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
    pub fn of<const PATTERN: u8>(lists: &Lists, rows: &[Row]) -> Self {
        let spot = |row: &Row| lists.spot::<PATTERN>(row, in_chunks_of::<PATTERN>(row));
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
            even: first.even.map(|link| link.saturating_sub(first.first) as usize),
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
        scale: f32,
    ) {
        let left = self.count % S::LANES;
        let whole = self.count - left;
        // What weighs the same at both ends, as nearly all does, has less to compute.
        let chunks = whole / S::LANES;
        let [from, to] = self.even;
        let from = if LAW == BOUND { 0 } else { from.div_ceil(S::LANES).min(chunks) };
        let runs = [from, (to / S::LANES).clamp(from, chunks), chunks];
        let is_end_even = LAW != BOUND && self.even[0] <= whole && self.even[1] >= self.count;
        // SAFETY: the first and the last row lie within the lists, and all others between them.
        unsafe {
            for number in 0..self.rows {
                let mut spot = self.row(number);
                let [from, to, end] = runs.map(|chunks| spot.link + chunks * S::LANES);
                solve_run::<S, LAW, PATTERN, false>(s, lists, &mut spot, from, scale);
                if LAW != BOUND {
                    solve_run::<S, LAW, PATTERN, true>(s, lists, &mut spot, to, scale);
                }
                solve_run::<S, LAW, PATTERN, false>(s, lists, &mut spot, end, scale);
            }
            if left == 0 {
                return;
            }
            let end = |number: usize| self.row(number).after::<PATTERN>(whole);
            // Chunks that reach over the ends of the last rows may reach over those of the lists.
            let mut roomy = self.rows;
            while roomy > 0 && !lists.have_room::<PATTERN>(end(roomy - 1), S::LANES) {
                roomy -= 1;
            }
            for number in 0..roomy {
                let place = lists.place(end(number));
                let chunk = if is_end_even {
                    Chunk::of::<LAW, PATTERN, true>(s, place, scale)
                } else {
                    Chunk::of::<LAW, PATTERN, false>(s, place, scale)
                };
                chunk.only_first::<LAW, PATTERN>(s, place, left).store::<LAW, PATTERN>(s, place);
            }
            for number in roomy..self.rows {
                let ends = [self.row(number), end(number)];
                solve_end::<S, LAW, PATTERN, false>(s, lists, ends, self.count, scale);
            }
        }
    }
}
