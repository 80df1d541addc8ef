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
use super::places::{Lists, Place, in_chunks};
use crate::fabric::links::Links;
use crate::fabric::rows::{Pattern, Row, Rows};
use crate::math::columns::Columns;
use crate::math::simd::{Level, Simd, vectored};
use crate::state::particles::Particles;
use core::ops::Range;
use glam::Vec3;

/// The patterns as numbers that a kernel can be compiled for.
pub(crate) const STRAIGHT: u8 = Pattern::Straight as u8;
const PAIRS: u8 = Pattern::Pairs as u8;
const QUADS: u8 = Pattern::Quads as u8;

/// The most lanes that there are.
const MOST: usize = 16;

/// Solves the links `range`, which are a batch, but for those that left their rows.
pub(crate) fn solve<const LAW: u8>(
    level: Level,
    grid: &Rows,
    range: Range<usize>,
    links: &mut Links,
    ends: &[Vec<f32>; 2],
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
        ends: ends.each_ref().map(|list| &list[..]),
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
    if level == Level::Scalar {
        return rows.iter().for_each(|row| solve_apart::<LAW>(row, 0, sheet, scale));
    }
    for rows in rows.chunk_by(|one, next| one.pattern == next.pattern) {
        let solve = match (LAW, rows[0].pattern) {
            (SOFT, Pattern::Straight) => soft_straight,
            (SOFT, Pattern::Pairs) => soft_pairs,
            (SOFT, Pattern::Quads) => soft_quads,
            (RIGID, Pattern::Straight) => rigid_straight,
            (RIGID, Pattern::Pairs) => rigid_pairs,
            (RIGID, Pattern::Quads) => rigid_quads,
            (_, Pattern::Straight) => bound_straight,
            (_, Pattern::Pairs) => bound_pairs,
            (_, Pattern::Quads) => bound_quads,
        };
        solve(level, rows, sheet, scale);
        for row in rows.iter().filter(|row| in_chunks(row) < row.count as usize) {
            solve_apart::<LAW>(row, in_chunks(row), sheet, scale);
        }
    }
}

/// A function for each law and pattern: together they would be too long for engines to compile well.
macro_rules! kernels {
    ($($name:ident: $law:ident $pattern:ident;)*) => {$(
        vectored! {
            #[inline(never)]
            fn $name(rows: &[Row], sheet: &mut Sheet<'_>, scale: f32)
                = solve_in_chunks::<_, $law, $pattern>, Avx512, nothing
        }
    )*};
}

kernels! {
    soft_straight: SOFT STRAIGHT;
    soft_pairs: SOFT PAIRS;
    soft_quads: SOFT QUADS;
    rigid_straight: RIGID STRAIGHT;
    rigid_pairs: RIGID PAIRS;
    rigid_quads: RIGID QUADS;
    bound_straight: BOUND STRAIGHT;
    bound_pairs: BOUND PAIRS;
    bound_quads: BOUND QUADS;
}

/// Without vectors there are no chunks.
fn nothing(_: &[Row], _: &mut Sheet<'_>, _: f32) {}

#[inline(always)]
fn solve_in_chunks<S: Simd, const LAW: u8, const PATTERN: u8>(
    s: S,
    rows: &[Row],
    sheet: &mut Sheet<'_>,
    scale: f32,
) {
    let lists = Lists::of(rows, sheet);
    for row in rows.iter().filter(|row| !row.is_torn) {
        // SAFETY: all rows lie within the lists.
        unsafe { solve_whole::<S, LAW, PATTERN>(s, lists.place::<PATTERN>(row), row, scale) };
    }
    // Rests reach back over links that were just solved. Only here, for a machine that is to read
    // what it has not finished writing must wait.
    for row in rows.iter().filter(|row| !row.is_torn) {
        let (place, count) = (lists.place::<PATTERN>(row), in_chunks(row));
        let done = count / S::LANES * S::LANES;
        // SAFETY: as above.
        unsafe { solve_rest::<S, LAW, PATTERN, false>(s, place, done, count, scale) };
    }
    for row in rows.iter().filter(|row| row.is_torn) {
        // SAFETY: as above.
        unsafe {
            solve_torn::<S, LAW, PATTERN>(s, lists.place::<PATTERN>(row), in_chunks(row), scale);
        }
    }
}

/// Links of a row one by one, from some link on.
#[inline(always)]
fn solve_apart<const LAW: u8>(row: &Row, from: usize, sheet: &mut Sheet<'_>, scale: f32) {
    let row = &sheet.own(row);
    for k in from..row.count as usize {
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
    /// What their ends weigh.
    pub ends: [&'a [f32]; 2],
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

/// Solves as many of a row's first `count` links as go in whole chunks.
///
/// # Safety
/// The row has as many links; so for all that follow.
#[inline(always)]
unsafe fn solve_whole<S: Simd, const LAW: u8, const PATTERN: u8>(
    s: S,
    mut place: Place,
    row: &Row,
    scale: f32,
) {
    let count = in_chunks(row);
    let even = row.even.map(|link| (link.max(row.first) - row.first) as usize);
    let (from, end) = (even[0].next_multiple_of(S::LANES).min(count), even[1].min(count));
    let mut k = 0;
    // SAFETY: the caller's promise.
    unsafe {
        // What weighs the same at both ends, as nearly all does, has less to compute.
        if LAW != BOUND {
            while k < from && k + S::LANES <= count {
                solve_chunk::<S, LAW, PATTERN, false, false>(s, place, 0, scale);
                (place, k) = (place.after::<PATTERN>(S::LANES), k + S::LANES);
            }
            // Two at a time, so that they share what finds their places.
            while k + 2 * S::LANES <= end {
                let next = place.after::<PATTERN>(S::LANES);
                solve_chunk::<S, LAW, PATTERN, false, true>(s, place, 0, scale);
                solve_chunk::<S, LAW, PATTERN, false, true>(s, next, 0, scale);
                (place, k) = (place.after::<PATTERN>(2 * S::LANES), k + 2 * S::LANES);
            }
            if k + S::LANES <= end {
                solve_chunk::<S, LAW, PATTERN, false, true>(s, place, 0, scale);
                (place, k) = (place.after::<PATTERN>(S::LANES), k + S::LANES);
            }
        }
        while k + S::LANES <= count {
            solve_chunk::<S, LAW, PATTERN, false, false>(s, place, 0, scale);
            (place, k) = (place.after::<PATTERN>(S::LANES), k + S::LANES);
        }
    }
}

/// Solves those links that are still in their row.
///
/// # Safety
/// As for `solve_whole`.
#[inline(always)]
unsafe fn solve_torn<S: Simd, const LAW: u8, const PATTERN: u8>(
    s: S,
    place: Place,
    count: usize,
    scale: f32,
) {
    let mut k = 0;
    // SAFETY: the caller's promise.
    unsafe {
        while k + S::LANES <= count {
            solve_chunk::<S, LAW, PATTERN, true, false>(s, place.after::<PATTERN>(k), 0, scale);
            k += S::LANES;
        }
        solve_rest::<S, LAW, PATTERN, true>(s, place, k, count, scale);
    }
}

/// Solves links `k` to `count` of a row, fewer than a chunk: with no more lanes than it takes, where
/// need be as one chunk that reaches back over links which are done.
///
/// # Safety
/// As for `solve_whole`.
#[inline(always)]
unsafe fn solve_rest<S: Simd, const LAW: u8, const PATTERN: u8, const CHOOSY: bool>(
    s: S,
    row: Place,
    mut k: usize,
    count: usize,
    scale: f32,
) {
    let (left, few) = (count - k, <S::Half as Simd>::LANES);
    if left == 0 {
        return;
    }
    // SAFETY: the caller's promise.
    unsafe {
        if few < S::LANES && (left <= few || count < S::LANES) {
            let half = s.half();
            if left >= few {
                let place = row.after::<PATTERN>(k);
                solve_chunk::<S::Half, LAW, PATTERN, CHOOSY, false>(half, place, 0, scale);
                k += few;
            }
            return solve_rest::<S::Half, LAW, PATTERN, CHOOSY>(half, row, k, count, scale);
        }
        let from = count - S::LANES;
        solve_chunk::<S, LAW, PATTERN, true, false>(s, row.after::<PATTERN>(from), k - from, scale);
    }
}

/// As many links of a row as there are lanes, but for the first `done` of them; with `CHOOSY` set,
/// only those that are still in the row; with `IS_EVEN` set, both ends of each weigh the same.
///
/// # Safety
/// As for `solve_whole`.
#[inline(always)]
unsafe fn solve_chunk<
    S: Simd,
    const LAW: u8,
    const PATTERN: u8,
    const CHOOSY: bool,
    const IS_EVEN: bool,
>(
    s: S,
    place: Place,
    done: usize,
    scale: f32,
) {
    let in_order = |v: S::F| if PATTERN == STRAIGHT { v } else { s.dealt(v) };
    let zero = s.splat(0.0);
    // SAFETY: the caller's promise.
    unsafe {
        let rest = in_order(s.load_from(place.rest));
        let (mut compliance, mut lambda) = (zero, zero);
        if LAW == SOFT {
            compliance = in_order(s.load_from(place.compliance));
            lambda = in_order(s.load_from(place.lambda));
        }
        let (xa, xb) = load::<S, PATTERN>(s, fixed(place.x));
        let (ya, yb) = load::<S, PATTERN>(s, fixed(place.y));
        let (za, zb) = load::<S, PATTERN>(s, fixed(place.z));
        let weights = if LAW == BOUND {
            load::<S, PATTERN>(s, place.w).into()
        } else if IS_EVEN {
            // Those of rigid links are 1 then.
            let one = s.splat(1.0);
            [if LAW == RIGID { one } else { in_order(s.load_from(place.ends[0])) }; 2]
        } else {
            [in_order(s.load_from(place.ends[0])), in_order(s.load_from(place.ends[1]))]
        };
        let (dx, dy, dz) = (xb - xa, yb - ya, zb - za);
        let ([to_a, to_b], multiplier) =
            correct::<LAW, S>(s, [dx, dy, dz], weights, rest, compliance, lambda, scale);
        let keep = if CHOOSY {
            let counts = s.load(&COUNTS, MOST - done);
            in_order(s.pick(counts, s.load_from(place.mask), zero))
        } else {
            zero
        };
        let take = |new: S::F, old: S::F| if CHOOSY { s.pick(keep, new, old) } else { new };
        if LAW == SOFT {
            let multiplier = take(multiplier, lambda);
            let multiplier = if PATTERN == STRAIGHT { multiplier } else { s.undealt(multiplier) };
            s.store_to(place.lambda, multiplier);
        }
        store::<S, PATTERN>(s, place.x, take(xa + dx * to_a, xa), take(xb - dx * to_b, xb));
        store::<S, PATTERN>(s, place.y, take(ya + dy * to_a, ya), take(yb - dy * to_b, yb));
        store::<S, PATTERN>(s, place.z, take(za + dz * to_a, za), take(zb - dz * to_b, zb));
    }
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

#[inline(always)]
fn fixed([a, b]: [*mut f32; 2]) -> [*const f32; 2] {
    [a, b]
}

/// One column at both ends of a chunk's links.
///
/// # Safety
/// As for `solve_whole`.
#[inline(always)]
unsafe fn load<S: Simd, const PATTERN: u8>(s: S, [a, b]: [*const f32; 2]) -> (S::F, S::F) {
    // SAFETY: the caller's promise.
    unsafe {
        if PATTERN == STRAIGHT {
            return (s.load_from(a), s.load_from(b));
        }
        let (low, high) = (s.load_from(a), s.load_from(a.add(S::LANES)));
        if PATTERN == PAIRS { s.deal(low, high) } else { s.deal_twos(low, high) }
    }
}

/// Puts back what `load` read.
///
/// # Safety
/// As for `solve_whole`.
#[inline(always)]
unsafe fn store<S: Simd, const PATTERN: u8>(s: S, [to_a, to_b]: [*mut f32; 2], a: S::F, b: S::F) {
    // SAFETY: the caller's promise.
    unsafe {
        if PATTERN == STRAIGHT {
            s.store_to(to_a, a);
            s.store_to(to_b, b);
            return;
        }
        let (low, high) = if PATTERN == PAIRS { s.gather_up(a, b) } else { s.deal_twos(a, b) };
        s.store_to(to_a, low);
        s.store_to(to_a.add(S::LANES), high);
    }
}
