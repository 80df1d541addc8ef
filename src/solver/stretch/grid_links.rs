//! Distance constraints of a grid: chooses the SIMD kernel for each run of rows of a batch.
//!
//! The particles of a row are contiguous, so that its links are plain loads (see `grid_kernel`). A
//! batch is solved in up to three passes over each run of rows of one pattern:
//!
//! ```text
//! intact rows   uniform ones together, widest vectors      uniform_rows
//! torn rows     masked chunks                              row_chunk, see `is_masked`
//! scalar links  rows shorter than a vector, odd last links project_pair
//! ```
//! Reads `GridRows`, rest lengths, compliances, weights of the ends; writes positions and λ.
//! Invariant: all arithmetic is `link_projection::compute_correction`, so the bits are those of the
//! scalar code. Links that left their row are masked; `sparse` solves them.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code, unused_imports)
)]

use crate::math::column::Column;
use crate::math::columns::Columns;
use crate::math::simd::{Baseline, Level, Simd, vectored};
use crate::model::grid_rows::{GridRows, LinkRow, RowPattern};
use crate::model::links::Links;
use crate::solver::stretch::grid_kernel::grid_slices::{GridSlices, PAIRS, QUADS, STRAIGHT};
use crate::solver::stretch::grid_kernel::row_chunk::{LinkChunk, RowParameters, solve_row_tail};
use crate::solver::stretch::grid_kernel::row_layout::{
    GridPointers, simd_link_count, simd_link_count_of,
};
use crate::solver::stretch::grid_kernel::uniform_rows::UniformRows;
use crate::solver::stretch::link_projection::{BOUND, RIGID, SOFT, project_pair};
use crate::state::particles::Particles;
use core::ops::Range;

/// Solves the links `range`, which are one batch, except those that left their rows. For `scale`
/// see `link_projection::compute_correction`.
pub(crate) fn solve<const LAW: u8>(
    level: Level,
    grid: &GridRows,
    range: Range<usize>,
    (links, lambda): (&Links, &mut [f32]),
    ends: &[Column; 2],
    p: &mut Particles,
    scale: f32,
) {
    let Links { rest, compliance, .. } = links;
    let Columns { x, y, z } = &mut p.x;
    let mut slices = GridSlices {
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
    solve_rows::<LAW>(level, &grid.rows[grid.rows_of_batch(range)], &mut slices, scale);
}

/// Solves rows of one colour, all within the slices.
pub(crate) fn solve_rows<const LAW: u8>(
    level: Level,
    rows: &[LinkRow],
    slices: &mut GridSlices<'_>,
    scale: f32,
) {
    if Level::HAS_SCALAR && level == Level::Scalar {
        return rows.iter().for_each(|row| solve_scalar::<LAW>(row, 0, slices, scale));
    }
    let mut left = rows;
    while let Some(first) = left.first() {
        let [solve_intact, solve_torn] = match (LAW, first.pattern) {
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
        let mut pass = RowPass { rows: left.len(), ..RowPass::default() };
        solve_intact(level, left, slices, scale, &mut pass);
        let rows;
        (rows, left) = left.split_at(pass.rows);
        if pass.has_torn {
            solve_torn(level, rows, slices, scale, &mut pass);
        }
        if pass.has_scalar {
            for row in rows.iter().filter(|row| simd_link_count(row) < row.count as usize) {
                solve_scalar::<LAW>(row, simd_link_count(row), slices, scale);
            }
        }
    }
}

/// The rows that a kernel went through, and which of them need another pass.
#[derive(Default)]
struct RowPass {
    /// The number of rows; all have the pattern of the kernel.
    rows: usize,
    /// Whether one of them is torn.
    has_torn: bool,
    /// Whether one of them has links that go through the scalar code.
    has_scalar: bool,
}

/// Defines one function per law and pattern: WebAssembly engines compile one long function badly.
macro_rules! kernels {
    ($solve:ident; $($name:ident: $law:ident $pattern:ident;)*) => {$(
        vectored! {
            #[cfg_attr(not(target_arch = "wasm32"), inline(never))] // `vectored` adds it on wasm32
            fn $name(rows: &[LinkRow], slices: &mut GridSlices<'_>, scale: f32, pass: &mut RowPass)
                = $solve::<_, $law, $pattern>, no_simd
        }
    )*};
}

kernels! {
    solve_intact;
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

kernels! {
    solve_torn;
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

/// Without SIMD there are no chunks; `solve_rows` uses the scalar code.
fn no_simd(_: &[LinkRow], _: &mut GridSlices<'_>, _: f32, _: &mut RowPass) {}

/// Whether a row is solved in masked chunks: a torn one. On WebAssembly the strain limit solves all
/// rows so, because kernels of its own would make the module 4 kB larger.
#[inline(always)]
fn is_masked<const LAW: u8>(row: &LinkRow) -> bool {
    row.is_torn || (LAW == BOUND && cfg!(target_arch = "wasm32"))
}

/// Solves intact rows, up to the first one of another pattern.
#[inline(always)]
fn solve_intact<S: Simd, const LAW: u8, const PATTERN: u8>(
    s: S,
    rows: &[LinkRow],
    slices: &mut GridSlices<'_>,
    scale: f32,
    pass: &mut RowPass,
) {
    let pointers = GridPointers::new(slices);
    let mut number = 0;
    while let Some(row) = rows.get(number) {
        if row.pattern as u8 != PATTERN {
            pass.rows = number;
            break;
        }
        pass.has_scalar |= simd_link_count_of::<PATTERN>(row) < row.count as usize;
        if is_masked::<LAW>(row) {
            pass.has_torn = true;
            number += 1;
            continue;
        }
        let left = &rows[number..];
        let uniform = &left[..left.len().min(row.uniform_run.max(1) as usize)];
        UniformRows::new::<PATTERN>(&pointers, uniform).solve::<S, LAW, PATTERN>(
            s,
            &pointers,
            RowParameters { scale, rest: row.rest },
        );
        number += uniform.len();
    }
}

/// Solves torn rows.
#[inline(always)]
fn solve_torn<S: Simd, const LAW: u8, const PATTERN: u8>(
    s: S,
    rows: &[LinkRow],
    slices: &mut GridSlices<'_>,
    scale: f32,
    _: &mut RowPass,
) {
    let pointers = GridPointers::new(slices);
    for row in rows.iter().filter(|row| is_masked::<LAW>(row)) {
        let (count, parameters) =
            (simd_link_count_of::<PATTERN>(row), RowParameters { scale, rest: row.rest });
        let (start, mut done) = (pointers.cursor::<PATTERN>(row, count), 0);
        // SAFETY: `cursor` checked that the row lies within the slices, and `contains` each chunk.
        unsafe {
            while S::LANES > Baseline::LANES && done < count {
                let cursor = start.advance::<PATTERN>(done);
                if !pointers.contains::<PATTERN>(cursor, S::LANES) {
                    break;
                }
                let at = pointers.chunk::<S, PATTERN>(cursor);
                let first = LinkChunk::first_mask(s, S::LANES.min(count - done));
                let mask = s.select_or_zero(first, LinkChunk::row_mask(s, at, 0));
                let chunk = LinkChunk::compute::<LAW, PATTERN, false>(s, at, parameters);
                chunk.apply_masked::<LAW, PATTERN>(s, at, mask);
                done += S::LANES;
            }
            solve_row_tail::<LAW, PATTERN>(&pointers, start, done, count, parameters);
        }
    }
}

/// Solves the links of a row one by one, from link `from` on.
#[inline(never)]
fn solve_scalar<const LAW: u8>(
    row: &LinkRow,
    from: usize,
    slices: &mut GridSlices<'_>,
    scale: f32,
) {
    let row = &slices.to_local(row);
    for k in from..row.count as usize {
        let link = row.first as usize + k;
        if slices.mask[link] != 0.0 {
            let (a, b) = row.ends(k as u32);
            let (rest, compliance) = (slices.rest[link], slices.compliance[link]);
            let lambda = slices.lambda[link];
            let ends = (a as usize, b as usize);
            let lambda = project_pair::<LAW, _>(ends, rest, compliance, lambda, slices, scale);
            if LAW == SOFT {
                slices.lambda[link] = lambda;
            }
        }
    }
}
