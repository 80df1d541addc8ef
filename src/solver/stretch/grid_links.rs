//! The links of a grid, as many at a time as there are lanes.
//!
//! A row's particles lie next to each other, so that its links are straight loads. The arithmetic
//! is `links::correct`, the very one that goes link by link, so the bits are the same too. What is
//! left of a row after whole chunks is one more chunk that reaches over its end, of which only the
//! row's links count; at the end of all lists one that reaches back. It writes what is beyond anew
//! as it was, and what follows would have to wait for that: so ends come after the whole chunks of
//! many rows. GridRows that are alike, as nearly all are, go together (see `alike`).

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code, unused_imports)
)]

use crate::math::column::Column;
use crate::math::columns::Columns;
use crate::math::simd::{Baseline, Level, Simd, vectored};
use crate::model::grid_rows::{GridRows, LinkRow, RowPattern};
use crate::model::links::Links;
use crate::solver::particle_stage::access::ParticleAccess;
use crate::solver::stretch::grid_kernel::row_chunk::{Chunk, Terms};
use crate::solver::stretch::grid_kernel::row_layout::{Lists, Spot, in_chunks, in_chunks_of};
use crate::solver::stretch::grid_kernel::uniform_rows::Alike;
use crate::solver::stretch::link_projection::{BOUND, RIGID, SOFT, project_pair};
use crate::state::particles::Particles;
use core::ops::Range;
use glam::Vec3;

/// The patterns as numbers that a kernel can be compiled for.
pub(crate) const STRAIGHT: u8 = RowPattern::Straight as u8;
const PAIRS: u8 = RowPattern::Pairs as u8;
const QUADS: u8 = RowPattern::Quads as u8;

/// Solves the links `range`, which are a batch, but for those that left their rows.
pub(crate) fn solve<const LAW: u8>(
    level: Level,
    grid: &GridRows,
    range: Range<usize>,
    links: &mut Links,
    ends: &[Column; 2],
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
    solve_rows::<LAW>(level, &grid.rows[grid.rows_of_batch(range)], &mut sheet, scale);
}

/// Solves rows, all within the sheet.
pub(crate) fn solve_rows<const LAW: u8>(
    level: Level,
    rows: &[LinkRow],
    sheet: &mut Sheet<'_>,
    scale: f32,
) {
    if Level::HAS_SCALAR && level == Level::Scalar {
        return rows.iter().for_each(|row| solve_apart::<LAW>(row, 0, sheet, scale));
    }
    let mut left = rows;
    while let Some(first) = left.first() {
        let [solve_whole, solve_torn] = match (LAW, first.pattern) {
            (SOFT, RowPattern::Straight) => [soft_straight, torn_soft_straight],
            (SOFT, RowPattern::Pairs) => [soft_pairs, torn_soft_pairs],
            (SOFT, RowPattern::Quads) => [soft_quads, torn_soft_quads],
            (RIGID, RowPattern::Straight) => [rigid_straight, torn_rigid_straight],
            (RIGID, RowPattern::Pairs) => [rigid_pairs, torn_rigid_pairs],
            (RIGID, RowPattern::Quads) => [rigid_quads, torn_rigid_quads],
            (_, RowPattern::Straight) => [bound_straight, torn_bound_straight],
            (_, RowPattern::Pairs) => [bound_pairs, torn_bound_pairs],
            (_, RowPattern::Quads) => [bound_quads, torn_bound_quads],
        };
        let mut pass = Pass { rows: left.len(), ..Pass::default() };
        solve_whole(level, left, sheet, scale, &mut pass);
        let rows;
        (rows, left) = left.split_at(pass.rows);
        if pass.has_torn {
            solve_torn(level, rows, sheet, scale, &mut pass);
        }
        if pass.has_apart {
            for row in rows.iter().filter(|row| in_chunks(row) < row.count as usize) {
                solve_apart::<LAW>(row, in_chunks(row), sheet, scale);
            }
        }
    }
}

/// What a kernel went through, and what it left to others.
#[derive(Default)]
struct Pass {
    /// How many rows, all of its pattern.
    rows: usize,
    /// Whether some of them are torn.
    has_torn: bool,
    /// Whether some have links that go one by one.
    has_apart: bool,
}

/// Functions for each law and pattern: together they would be too long for engines to compile well.
macro_rules! kernels {
    ($solve:ident, $widest:ident; $($name:ident: $law:ident $pattern:ident;)*) => {$(
        vectored! {
            #[cfg_attr(not(target_arch = "wasm32"), inline(never))] // there `vectored` says so
            fn $name(rows: &[LinkRow], sheet: &mut Sheet<'_>, scale: f32, pass: &mut Pass)
                = $solve::<_, $law, $pattern>, $widest, none
        }
    )*};
}

kernels! {
    solve_whole, Avx512;
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

// Few rows are torn: what the widest vectors would save is not worth another copy.
kernels! {
    solve_torn, Avx2;
    torn_soft_straight: SOFT STRAIGHT;
    torn_soft_pairs: SOFT PAIRS;
    torn_soft_quads: SOFT QUADS;
    torn_rigid_straight: RIGID STRAIGHT;
    torn_rigid_pairs: RIGID PAIRS;
    torn_rigid_quads: RIGID QUADS;
    torn_bound_straight: BOUND STRAIGHT;
    torn_bound_pairs: BOUND PAIRS;
    torn_bound_quads: BOUND QUADS;
}

/// Without vectors there are no chunks.
fn none(_: &[LinkRow], _: &mut Sheet<'_>, _: f32, _: &mut Pass) {}

/// The rows that no link has left, as far as all are of the pattern.
#[inline(always)]
fn solve_whole<S: Simd, const LAW: u8, const PATTERN: u8>(
    s: S,
    rows: &[LinkRow],
    sheet: &mut Sheet<'_>,
    scale: f32,
    pass: &mut Pass,
) {
    let lists = Lists::of(sheet);
    let mut number = 0;
    while let Some(row) = rows.get(number) {
        if row.pattern as u8 != PATTERN {
            pass.rows = number;
            break;
        }
        pass.has_apart |= in_chunks_of::<PATTERN>(row) < row.count as usize;
        if row.is_torn {
            pass.has_torn = true;
            number += 1;
            continue;
        }
        let left = &rows[number..];
        let alike = &left[..left.len().min(row.uniform_run.max(1) as usize)];
        Alike::of::<PATTERN>(&lists, alike).solve::<S, LAW, PATTERN>(
            s,
            &lists,
            Terms { scale, rest: row.rest },
        );
        number += alike.len();
    }
}

/// The rows that links have left.
#[inline(always)]
fn solve_torn<S: Simd, const LAW: u8, const PATTERN: u8>(
    s: S,
    rows: &[LinkRow],
    sheet: &mut Sheet<'_>,
    scale: f32,
    _: &mut Pass,
) {
    let lists = Lists::of(sheet);
    for row in rows.iter().filter(|row| row.is_torn) {
        let (count, terms) = (in_chunks_of::<PATTERN>(row), Terms { scale, rest: row.rest });
        let (start, mut done) = (lists.spot::<PATTERN>(row, count), 0);
        // SAFETY: the row was just found to lie within the lists; there is room for whole chunks,
        // or none is made.
        unsafe {
            while S::LANES > Baseline::LANES && done < count {
                let spot = start.after::<PATTERN>(done);
                if !lists.have_room::<PATTERN>(spot, S::LANES) {
                    break;
                }
                let place = lists.place::<S, PATTERN>(spot);
                let first = Chunk::first(s, S::LANES.min(count - done));
                let keep = s.select_or_zero(first, Chunk::in_row(s, place, 0));
                let chunk = Chunk::of::<LAW, PATTERN, false>(s, place, terms);
                chunk.finish_only::<LAW, PATTERN>(s, place, keep);
                done += S::LANES;
            }
            solve_last::<LAW, PATTERN>(&lists, start, done, count, terms);
        }
    }
}

/// Links of a row one by one, from some link on.
#[inline(never)]
fn solve_apart<const LAW: u8>(row: &LinkRow, from: usize, sheet: &mut Sheet<'_>, scale: f32) {
    let row = &sheet.own(row);
    for k in from..row.count as usize {
        let link = row.first as usize + k;
        if sheet.mask[link] != 0.0 {
            let (a, b) = row.ends(k as u32);
            let (rest, compliance) = (sheet.rest[link], sheet.compliance[link]);
            let lambda = sheet.lambda[link];
            let ends = (a as usize, b as usize);
            let lambda = project_pair::<LAW, _>(ends, rest, compliance, lambda, sheet, scale);
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
    fn own(&self, row: &LinkRow) -> LinkRow {
        let (a, b) = (row.a - self.first_particle, row.b - self.first_particle);
        LinkRow { a, b, first: row.first - self.first_link, ..*row }
    }
}

impl ParticleAccess for Sheet<'_> {
    #[inline(always)]
    fn particle(&self, i: usize) -> (Vec3, f32) {
        (Vec3::new(self.x[i], self.y[i], self.z[i]), self.w[i])
    }

    #[inline(always)]
    fn set_position(&mut self, i: usize, x: Vec3) {
        (self.x[i], self.y[i], self.z[i]) = (x.x, x.y, x.z);
    }
}

/// Solves links `done` to `count` of a row, if there are any: by the fewest lanes at a time, the
/// last ones as a chunk that reaches back over links which are done, as nothing may lie behind. So
/// few rows need it that one way to go about it serves all machines.
///
/// # Safety
/// The row lies within the lists, and has links for the fewest lanes if it has any.
#[inline(never)]
pub(crate) unsafe fn solve_last<const LAW: u8, const PATTERN: u8>(
    lists: &Lists,
    row: Spot,
    mut done: usize,
    count: usize,
    terms: Terms,
) {
    let s = Baseline::new();
    while done < count {
        let from = done.min(count - Baseline::LANES);
        // SAFETY: the caller's promise.
        unsafe {
            let place = lists.place::<Baseline, PATTERN>(row.after::<PATTERN>(from));
            let chunk = Chunk::of::<LAW, PATTERN, false>(s, place, terms);
            let keep = Chunk::in_row(s, place, done - from);
            chunk.finish_only::<LAW, PATTERN>(s, place, keep);
        }
        done = from + Baseline::LANES;
    }
}
