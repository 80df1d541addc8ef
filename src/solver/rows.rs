//! The links of a grid, eight at a time.
//!
//! A row's particles lie next to each other, so that its links are straight loads. The arithmetic
//! is `links::correct`, the very one that goes link by link, so the bits are the same too. What is
//! left of a row after whole chunks is one more chunk from its end, of which only the new links count.

use super::links::{BOUND, RIGID, SOFT, correct, project};
use crate::fabric::links::Links;
use crate::fabric::rows::{Pattern, Row, Rows};
use crate::math::columns::Columns;
use crate::math::simd::{LANES, Lanes, Level, lanes, leveled};
use crate::state::particles::Particles;
use core::ops::Range;

/// The patterns as numbers that a kernel can be compiled for.
const STRAIGHT: u8 = Pattern::Straight as u8;
const PAIRS: u8 = Pattern::Pairs as u8;
const QUADS: u8 = Pattern::Quads as u8;

/// Solves the links `range`, which are a batch, but for those that left their rows.
pub(crate) fn solve<const LAW: u8>(
    level: Level,
    grid: &Rows,
    range: Range<usize>,
    links: &mut Links,
    p: &mut Particles,
    scale: f32,
) {
    let rows = &grid.rows[grid.between(range)];
    match LAW {
        SOFT => solve_soft(level, rows, &grid.mask, links, p, scale),
        RIGID => solve_rigid(level, rows, &grid.mask, links, p, scale),
        _ => solve_bound(level, rows, &grid.mask, links, p, scale),
    }
}

leveled! {
    fn solve_rigid(rows: &[Row], mask: &[f32], links: &mut Links, p: &mut Particles, scale: f32)
        = solve_rows::<RIGID>
}

leveled! {
    fn solve_bound(rows: &[Row], mask: &[f32], links: &mut Links, p: &mut Particles, scale: f32)
        = solve_rows::<BOUND>
}

leveled! {
    fn solve_soft(rows: &[Row], mask: &[f32], links: &mut Links, p: &mut Particles, scale: f32)
        = solve_rows::<SOFT>
}

#[inline(always)]
fn solve_rows<const LAW: u8>(
    rows: &[Row],
    mask: &[f32],
    links: &mut Links,
    p: &mut Particles,
    scale: f32,
) {
    for row in rows {
        match row.pattern {
            Pattern::Straight => solve_row::<LAW, STRAIGHT>(row, mask, links, p, scale),
            Pattern::Pairs => solve_row::<LAW, PAIRS>(row, mask, links, p, scale),
            Pattern::Quads => solve_row::<LAW, QUADS>(row, mask, links, p, scale),
        }
    }
}

#[inline(always)]
fn solve_row<const LAW: u8, const PATTERN: u8>(
    row: &Row,
    mask: &[f32],
    links: &mut Links,
    p: &mut Particles,
    scale: f32,
) {
    let count = row.count as usize;
    let whole = count / LANES * LANES;
    for k in (0..whole).step_by(LANES) {
        if row.is_torn {
            solve_chunk::<LAW, PATTERN, true>(row, k, 0, mask, links, p, scale);
        } else {
            solve_chunk::<LAW, PATTERN, false>(row, k, 0, mask, links, p, scale);
        }
    }
    // An even number, since every two links of a row of quads belong together.
    let tail = count.saturating_sub(LANES) & !1;
    if count < LANES {
        solve_apart::<LAW>(row, 0..count, mask, links, p, scale);
    } else if whole < count {
        solve_chunk::<LAW, PATTERN, true>(row, tail, whole - tail, mask, links, p, scale);
        solve_apart::<LAW>(row, tail + LANES..count, mask, links, p, scale);
    }
}

/// Links of a row one by one.
#[inline(always)]
fn solve_apart<const LAW: u8>(
    row: &Row,
    range: Range<usize>,
    mask: &[f32],
    links: &mut Links,
    p: &mut Particles,
    scale: f32,
) {
    for k in range {
        let link = row.first as usize + k;
        if mask[link] != 0.0 {
            project::<LAW, _>(links, link, p, scale);
        }
    }
}

/// Links `k` to `k + 8` of a row, but for the first `done` of them; with `CHOOSY` set, only those
/// that are still in the row.
#[inline(always)]
fn solve_chunk<const LAW: u8, const PATTERN: u8, const CHOOSY: bool>(
    row: &Row,
    k: usize,
    done: usize,
    mask: &[f32],
    links: &mut Links,
    p: &mut Particles,
    scale: f32,
) {
    let first = row.first as usize + k;
    let mut keep = [1.0; LANES];
    if CHOOSY {
        keep = lanes(mask, first);
        for i in 0..LANES {
            keep[i] = if i >= done { keep[i] } else { 0.0 };
        }
    }
    let rest = lanes(&links.rest, first);
    let (mut compliance, mut lambda) = ([0.0; LANES], [0.0; LANES]);
    if LAW == SOFT {
        compliance = lanes(&links.compliance, first);
        lambda = lanes(&links.lambda, first);
    }
    let Columns { x, y, z } = &mut p.x;
    let load = |column: &[f32]| load::<PATTERN>(row, k, column);
    let ((mut xa, mut xb), (mut ya, mut yb), (mut za, mut zb)) = (load(x), load(y), load(z));
    let (wa, wb) = load(&p.w);
    for i in 0..LANES {
        let (dx, dy, dz) = (xb[i] - xa[i], yb[i] - ya[i], zb[i] - za[i]);
        let (weight, compliance) = (wa[i] + wb[i], compliance[i]);
        let (share, multiplier) =
            correct::<LAW>([dx, dy, dz], weight, rest[i], compliance, lambda[i], scale);
        let (to_a, to_b) = (share * wa[i], -(share * wb[i]));
        let take = |new: f32, old: f32| if CHOOSY && keep[i] == 0.0 { old } else { new };
        xa[i] = take(xa[i] + dx * to_a, xa[i]);
        ya[i] = take(ya[i] + dy * to_a, ya[i]);
        za[i] = take(za[i] + dz * to_a, za[i]);
        xb[i] = take(xb[i] + dx * to_b, xb[i]);
        yb[i] = take(yb[i] + dy * to_b, yb[i]);
        zb[i] = take(zb[i] + dz * to_b, zb[i]);
        lambda[i] = take(multiplier, lambda[i]);
    }
    if LAW == SOFT {
        links.lambda[first..first + LANES].copy_from_slice(&lambda);
    }
    store::<PATTERN>(row, k, x, &xa, &xb);
    store::<PATTERN>(row, k, y, &ya, &yb);
    store::<PATTERN>(row, k, z, &za, &zb);
}

/// One column at both ends of links `k` to `k + 8` of a row.
#[inline(always)]
fn load<const PATTERN: u8>(row: &Row, k: usize, column: &[f32]) -> (Lanes, Lanes) {
    let (a, b) = (row.a as usize, row.b as usize);
    if PATTERN == STRAIGHT {
        return (lanes(column, a + k), lanes(column, b + k));
    }
    let mut c = [0.0; 2 * LANES];
    c.copy_from_slice(&column[a + 2 * k..a + 2 * (k + LANES)]);
    if PATTERN == PAIRS {
        let even = [c[0], c[2], c[4], c[6], c[8], c[10], c[12], c[14]];
        (even, [c[1], c[3], c[5], c[7], c[9], c[11], c[13], c[15]])
    } else {
        let lower = [c[0], c[1], c[4], c[5], c[8], c[9], c[12], c[13]];
        (lower, [c[2], c[3], c[6], c[7], c[10], c[11], c[14], c[15]])
    }
}

/// Puts back what `load` read.
#[inline(always)]
fn store<const PATTERN: u8>(row: &Row, k: usize, column: &mut [f32], a: &Lanes, b: &Lanes) {
    let (at_a, at_b) = (row.a as usize, row.b as usize);
    if PATTERN == STRAIGHT {
        column[at_a + k..at_a + k + LANES].copy_from_slice(a);
        column[at_b + k..at_b + k + LANES].copy_from_slice(b);
        return;
    }
    let both = if PATTERN == PAIRS {
        [
            a[0], b[0], a[1], b[1], a[2], b[2], a[3], b[3], a[4], b[4], a[5], b[5], a[6], b[6],
            a[7], b[7],
        ]
    } else {
        [
            a[0], a[1], b[0], b[1], a[2], a[3], b[2], b[3], a[4], a[5], b[4], b[5], a[6], a[7],
            b[6], b[7],
        ]
    };
    column[at_a + 2 * k..at_a + 2 * (k + LANES)].copy_from_slice(&both);
}
