//! The links of a grid, as many at a time as there are lanes.
//!
//! A row's particles lie next to each other, so that its links are straight loads. The arithmetic
//! is `links::correct`, the very one that goes link by link, so the bits are the same too. What is
//! left of a row after whole chunks is one more chunk from its end, of which only the new links count.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use super::links::{BOUND, RIGID, SOFT, Spots, correct, pull};
use crate::fabric::links::Links;
use crate::fabric::rows::{Pattern, Row, Rows};
use crate::math::columns::Columns;
use crate::math::simd::{Level, Simd, vectored};
use crate::state::particles::Particles;
use core::ops::Range;
use glam::Vec3;

/// The patterns as numbers that a kernel can be compiled for.
const STRAIGHT: u8 = Pattern::Straight as u8;
const PAIRS: u8 = Pattern::Pairs as u8;
const QUADS: u8 = Pattern::Quads as u8;

/// The most lanes that there are, and the fewest.
const MOST: usize = 16;
const FEWEST: usize = 4;

/// Solves the links `range`, which are a batch, but for those that left their rows.
pub(crate) fn solve<const LAW: u8>(
    level: Level,
    grid: &Rows,
    range: Range<usize>,
    links: &mut Links,
    p: &mut Particles,
    scale: f32,
) {
    let Links { rest, compliance, lambda, .. } = links;
    let Columns { x, y, z } = &mut p.x;
    let mut sheet = Sheet {
        first_particle: 0,
        first_link: 0,
        x,
        y,
        z,
        w: &p.w,
        mask: &grid.mask,
        rest,
        compliance,
        lambda,
    };
    solve_rows::<LAW>(level, &grid.rows[grid.between(range)], &mut sheet, scale);
}

/// Solves rows, all within the sheet.
pub(crate) fn solve_rows<const LAW: u8>(
    level: Level,
    rows: &[Row],
    sheet: &mut Sheet<'_>,
    scale: f32,
) {
    match LAW {
        SOFT => solve_soft(level, rows, sheet, scale),
        RIGID => solve_rigid(level, rows, sheet, scale),
        _ => solve_bound(level, rows, sheet, scale),
    }
}

vectored! {
    fn solve_soft(rows: &[Row], sheet: &mut Sheet<'_>, scale: f32)
        = solve_in_chunks::<_, SOFT>, Avx512, solve_all_apart::<SOFT>
}

vectored! {
    fn solve_rigid(rows: &[Row], sheet: &mut Sheet<'_>, scale: f32)
        = solve_in_chunks::<_, RIGID>, Avx512, solve_all_apart::<RIGID>
}

vectored! {
    fn solve_bound(rows: &[Row], sheet: &mut Sheet<'_>, scale: f32)
        = solve_in_chunks::<_, BOUND>, Avx512, solve_all_apart::<BOUND>
}

#[inline(always)]
fn solve_in_chunks<S: Simd, const LAW: u8>(s: S, rows: &[Row], sheet: &mut Sheet<'_>, scale: f32) {
    // One length for all columns, so that one check does for all.
    let (particles, all) = (sheet.w.len(), sheet.rest.len());
    let mut sheet = Sheet {
        x: &mut sheet.x[..particles],
        y: &mut sheet.y[..particles],
        z: &mut sheet.z[..particles],
        mask: &sheet.mask[..all],
        compliance: &sheet.compliance[..all],
        lambda: &mut sheet.lambda[..all],
        ..*sheet
    };
    for row in rows {
        let row = &sheet.own(row);
        match row.pattern {
            Pattern::Straight => solve_row::<S, LAW, STRAIGHT>(s, row, &mut sheet, scale),
            Pattern::Pairs => solve_row::<S, LAW, PAIRS>(s, row, &mut sheet, scale),
            Pattern::Quads => solve_row::<S, LAW, QUADS>(s, row, &mut sheet, scale),
        }
    }
    for row in rows {
        let row = &sheet.own(row);
        solve_apart::<LAW>(row, in_chunks(row)..row.count as usize, &mut sheet, scale);
    }
}

/// How many links of a row go in chunks: all, but for those of a row shorter than any chunk, and an
/// odd one where every two links belong together.
#[inline(always)]
fn in_chunks(row: &Row) -> usize {
    let count = row.count as usize;
    let even = if row.pattern == Pattern::Quads { count & !1 } else { count };
    if even < FEWEST { 0 } else { even }
}

#[inline(always)]
fn solve_all_apart<const LAW: u8>(rows: &[Row], sheet: &mut Sheet<'_>, scale: f32) {
    for row in rows {
        let row = &sheet.own(row);
        solve_apart::<LAW>(row, 0..row.count as usize, sheet, scale);
    }
}

/// Links of a row one by one.
#[inline(always)]
fn solve_apart<const LAW: u8>(row: &Row, range: Range<usize>, sheet: &mut Sheet<'_>, scale: f32) {
    for k in range {
        let link = row.first as usize + k;
        if sheet.mask[link] != 0.0 {
            let (a, b) = row.ends(k as u32);
            let (rest, compliance) = (sheet.rest[link], sheet.compliance[link]);
            let lambda = sheet.lambda[link];
            let ends = (a as usize, b as usize);
            let lambda = pull::<LAW, _>(ends, rest, compliance, lambda, sheet, scale);
            if LAW == SOFT {
                sheet.lambda[link] = lambda;
            }
        }
    }
}

/// Particles and links as the kernels see them, both from some first one on: the lists of each have
/// one length.
pub(crate) struct Sheet<'a> {
    pub first_particle: u32,
    pub first_link: u32,
    pub x: &'a mut [f32],
    pub y: &'a mut [f32],
    pub z: &'a mut [f32],
    pub w: &'a [f32],
    pub mask: &'a [f32],
    pub rest: &'a [f32],
    pub compliance: &'a [f32],
    pub lambda: &'a mut [f32],
}

impl Sheet<'_> {
    /// A row as it lies in these lists.
    #[inline(always)]
    fn own(&self, row: &Row) -> Row {
        let (a, b) = (row.a - self.first_particle, row.b - self.first_particle);
        Row { a, b, first: row.first - self.first_link, ..*row }
    }
}

impl Spots for Sheet<'_> {
    #[inline(always)]
    fn spot(&self, i: usize) -> (Vec3, f32) {
        (Vec3::new(self.x[i], self.y[i], self.z[i]), self.w[i])
    }

    #[inline(always)]
    fn put(&mut self, i: usize, x: Vec3) {
        (self.x[i], self.y[i], self.z[i]) = (x.x, x.y, x.z);
    }
}

/// Those of a row: its links, and the particles at their ends.
struct Ends<'a> {
    x: [&'a mut [f32]; 2],
    y: [&'a mut [f32]; 2],
    z: [&'a mut [f32]; 2],
    w: [&'a [f32]; 2],
    mask: &'a [f32],
    rest: &'a [f32],
    compliance: &'a [f32],
    lambda: &'a mut [f32],
}

impl Ends<'_> {
    /// Those of some of the links.
    #[inline(always)]
    fn part<const PATTERN: u8>(&mut self, links: Range<usize>) -> Ends<'_> {
        let upper = if PATTERN == STRAIGHT { links.clone() } else { 0..0 };
        let lower =
            if PATTERN == STRAIGHT { links.clone() } else { 2 * links.start..2 * links.end };
        let [[xa, xb], [ya, yb], [za, zb]] = [&mut self.x, &mut self.y, &mut self.z];
        Ends {
            x: [&mut xa[lower.clone()], &mut xb[upper.clone()]],
            y: [&mut ya[lower.clone()], &mut yb[upper.clone()]],
            z: [&mut za[lower.clone()], &mut zb[upper.clone()]],
            w: [&self.w[0][lower.clone()], &self.w[1][upper.clone()]],
            mask: &self.mask[links.clone()],
            rest: &self.rest[links.clone()],
            compliance: &self.compliance[links.clone()],
            lambda: &mut self.lambda[links],
        }
    }
}

/// Solves those links of a row that go in chunks.
#[inline(always)]
fn solve_row<S: Simd, const LAW: u8, const PATTERN: u8>(
    s: S,
    row: &Row,
    sheet: &mut Sheet<'_>,
    scale: f32,
) {
    let (first, count) = (row.first as usize, in_chunks(row));
    let all = first..first + count;
    let mut ends = Ends {
        x: ends_mut::<PATTERN>(row, count, sheet.x),
        y: ends_mut::<PATTERN>(row, count, sheet.y),
        z: ends_mut::<PATTERN>(row, count, sheet.z),
        w: ends_of::<PATTERN>(row, count, sheet.w),
        mask: &sheet.mask[all.clone()],
        rest: &sheet.rest[all.clone()],
        compliance: &sheet.compliance[all.clone()],
        lambda: &mut sheet.lambda[all],
    };
    let mut k = 0;
    if row.is_torn {
        while k + S::LANES <= count {
            solve_chunk::<S, LAW, PATTERN, true>(s, k, 0, &mut ends, scale);
            k += S::LANES;
        }
    } else {
        // Two at a time, so that they share what finds their places.
        while k + 2 * S::LANES <= count {
            let mut two = ends.part::<PATTERN>(k..k + 2 * S::LANES);
            solve_chunk::<S, LAW, PATTERN, false>(s, 0, 0, &mut two, scale);
            solve_chunk::<S, LAW, PATTERN, false>(s, S::LANES, 0, &mut two, scale);
            k += 2 * S::LANES;
        }
        if k + S::LANES <= count {
            solve_chunk::<S, LAW, PATTERN, false>(s, k, 0, &mut ends, scale);
            k += S::LANES;
        }
    }
    solve_rest::<S, LAW, PATTERN>(s, k, count, row.is_torn, &mut ends, scale);
}

/// Solves links `k` to `count` of a row, fewer than a chunk: with no more lanes than it takes, where
/// need be as one chunk that reaches back over links which are done.
#[inline(always)]
fn solve_rest<S: Simd, const LAW: u8, const PATTERN: u8>(
    s: S,
    k: usize,
    count: usize,
    is_torn: bool,
    ends: &mut Ends<'_>,
    scale: f32,
) {
    let (left, few) = (count - k, <S::Half as Simd>::LANES);
    if left == 0 {
        return;
    }
    if few < S::LANES && (left <= few || count < S::LANES) {
        let half = s.half();
        let mut k = k;
        if left >= few {
            if is_torn {
                solve_chunk::<S::Half, LAW, PATTERN, true>(half, k, 0, ends, scale);
            } else {
                solve_chunk::<S::Half, LAW, PATTERN, false>(half, k, 0, ends, scale);
            }
            k += few;
        }
        return solve_rest::<S::Half, LAW, PATTERN>(half, k, count, is_torn, ends, scale);
    }
    let from = count - S::LANES;
    solve_chunk::<S, LAW, PATTERN, true>(s, from, k - from, ends, scale);
}

/// As many links of a row as there are lanes, from `k` on, but for the first `done` of them; with
/// `CHOOSY` set, only those that are still in the row.
#[inline(always)]
fn solve_chunk<S: Simd, const LAW: u8, const PATTERN: u8, const CHOOSY: bool>(
    s: S,
    k: usize,
    done: usize,
    ends: &mut Ends<'_>,
    scale: f32,
) {
    let in_order = |v: S::F| if PATTERN == STRAIGHT { v } else { s.dealt(v) };
    let rest = in_order(s.load(ends.rest, k));
    let zero = s.splat(0.0);
    let (mut compliance, mut lambda) = (zero, zero);
    if LAW == SOFT {
        compliance = in_order(s.load(ends.compliance, k));
        lambda = in_order(s.load(ends.lambda, k));
    }
    let (xa, xb) = load::<S, PATTERN>(s, [&*ends.x[0], &*ends.x[1]], k);
    let (ya, yb) = load::<S, PATTERN>(s, [&*ends.y[0], &*ends.y[1]], k);
    let (za, zb) = load::<S, PATTERN>(s, [&*ends.z[0], &*ends.z[1]], k);
    let (wa, wb) = load::<S, PATTERN>(s, ends.w, k);
    let (dx, dy, dz) = (xb - xa, yb - ya, zb - za);
    let (share, multiplier) =
        correct::<LAW, S>(s, [dx, dy, dz], wa + wb, rest, compliance, lambda, scale);
    let (to_a, to_b) = (share * wa, share * wb);
    let keep = if CHOOSY {
        let counts = s.load(&COUNTS, MOST - done);
        let mask = s.load(ends.mask, k);
        in_order(s.pick(counts, mask, zero))
    } else {
        zero
    };
    let take = |new: S::F, old: S::F| if CHOOSY { s.pick(keep, new, old) } else { new };
    if LAW == SOFT {
        let multiplier = take(multiplier, lambda);
        let multiplier = if PATTERN == STRAIGHT { multiplier } else { s.undealt(multiplier) };
        s.store(ends.lambda, k, multiplier);
    }
    store::<S, PATTERN>(s, &mut ends.x, k, take(xa + dx * to_a, xa), take(xb - dx * to_b, xb));
    store::<S, PATTERN>(s, &mut ends.y, k, take(ya + dy * to_a, ya), take(yb - dy * to_b, yb));
    store::<S, PATTERN>(s, &mut ends.z, k, take(za + dz * to_a, za), take(zb - dz * to_b, zb));
}

/// 0 as often as there may be lanes, then 1 as often.
const COUNTS: [f32; 2 * MOST] = {
    let mut counts = [0.0; 2 * MOST];
    let mut at = MOST;
    while at < 2 * MOST {
        counts[at] = 1.0;
        at += 1;
    }
    counts
};

/// One column at the ends of a row's first `count` links: the lower and the upper ends, or all in the
/// first list where they alternate.
#[inline(always)]
fn ends_of<'a, const PATTERN: u8>(row: &Row, count: usize, column: &'a [f32]) -> [&'a [f32]; 2] {
    let (a, b) = (row.a as usize, row.b as usize);
    if PATTERN == STRAIGHT {
        [&column[a..a + count], &column[b..b + count]]
    } else {
        [&column[a..a + 2 * count], &[]]
    }
}

/// As `ends_of`; a row's upper ends lie behind its lower ones.
#[inline(always)]
fn ends_mut<'a, const PATTERN: u8>(
    row: &Row,
    count: usize,
    column: &'a mut [f32],
) -> [&'a mut [f32]; 2] {
    let (a, b) = (row.a as usize, row.b as usize);
    if PATTERN == STRAIGHT {
        let (lower, upper) = column.split_at_mut(b);
        [&mut lower[a..a + count], &mut upper[..count]]
    } else {
        [&mut column[a..a + 2 * count], &mut []]
    }
}

/// One column at both ends of a chunk's links.
#[inline(always)]
fn load<S: Simd, const PATTERN: u8>(s: S, ends: [&[f32]; 2], k: usize) -> (S::F, S::F) {
    if PATTERN == STRAIGHT {
        return (s.load(ends[0], k), s.load(ends[1], k));
    }
    let (low, high) = (s.load(ends[0], 2 * k), s.load(ends[0], 2 * k + S::LANES));
    if PATTERN == PAIRS { s.deal(low, high) } else { s.deal_twos(low, high) }
}

/// Puts back what `load` read.
#[inline(always)]
fn store<S: Simd, const PATTERN: u8>(s: S, ends: &mut [&mut [f32]; 2], k: usize, a: S::F, b: S::F) {
    if PATTERN == STRAIGHT {
        s.store(ends[0], k, a);
        s.store(ends[1], k, b);
        return;
    }
    let (low, high) = if PATTERN == PAIRS { s.gather_up(a, b) } else { s.deal_twos(a, b) };
    s.store(ends[0], 2 * k, low);
    s.store(ends[0], 2 * k + S::LANES, high);
}
