//! Sums over triangles, scattered to their corners, and the split of a grid into bands for threads.
//!
//! Contributions are evaluated eight triangles at a time and added one by one, in the order of the
//! triangles. The cells of a grid go through `grid_cells`, which adds in the same order.
//!
//! ```text
//! triangles   0 … 2 cells − 1: cells of a grid (grid_cells) │ pieces that cuts made (here)
//! threads     each adds to the particles of its own rows; the threads on both sides of a border
//!             evaluate the cells at it
//! ```
//! Reads a `SumInput`; adds to the columns `out`, which the caller cleared.
//! Invariant: the additions to one particle come in the order of the triangles, whatever the
//! instruction set and the number of threads, so the bits are always the same.

use crate::math::columns::Columns;
use crate::math::simd::{LANES, LaneArray, Scalar, Simd};
use crate::math::threads::Threads;
use crate::model::grid_cells::GridCells;
use crate::solver::vertex_sums::contribution::{
    RowBand, SumInput, TriangleContribution, corner_share, evaluate_gathered,
};
use crate::solver::vertex_sums::grid_cells;
use core::ops::Range;

/// The least number of cells that is worth a thread.
#[cfg(feature = "parallel")]
const MIN_CELLS_PER_THREAD: usize = 8192;

/// Runs `sum` for all particles: once, or on several threads for bands of an untorn grid.
///
/// `sum` gets a band, and the columns to add to, which begin at the first particle of the band.
pub(crate) fn sum_in_bands(
    threads: Threads,
    input: SumInput<'_>,
    out: &mut Columns,
    sum: impl Fn(RowBand, [&mut [f32]; 3]) + Sync,
) {
    #[cfg(feature = "parallel")]
    if let Some(cells) = input.cells {
        let GridCells { columns, rows, .. } = *cells;
        let parts = threads.parts(columns * rows, MIN_CELLS_PER_THREAD).min(rows);
        if parts > 1 && columns > LANES && input.x.x.len() == columns * rows {
            let row = |part: usize| rows * part / parts;
            let add = |part: usize, out: [&mut [f32]; 3]| {
                sum(RowBand { first: row(part), end: row(part + 1) }, out);
            };
            return threads.parallel_for_parts(
                parts,
                out.slices_mut(),
                |part| columns * row(part),
                add,
            );
        }
    }
    let _ = (threads, input);
    sum(RowBand::ALL, out.slices_mut());
}

/// Adds the contributions of all triangles to the particles of a band, whose sums are 0 so far.
#[inline(always)]
pub(crate) fn sum<S: Simd, C: TriangleContribution>(
    s: S,
    input: SumInput<'_>,
    contribution: C,
    band: RowBand,
    mut out: [&mut [f32]; 3],
) {
    let (out, count) = (&mut out, input.triangles.len());
    let fits = |cells: &&GridCells| (LANES + 1..=grid_cells::MAX_COLUMNS).contains(&cells.columns);
    let mut first = 0;
    if let Some(cells) = input.cells.filter(fits) {
        grid_cells::sum(s, input, cells, contribution, band, out);
        // The triangles that cuts added come after those of the cells.
        first = 2 * (cells.columns - 1) * (cells.rows - 1);
    }
    for first in (first..count).step_by(LANES) {
        add_triangles(s, input, first..(first + LANES).min(count), contribution, out);
    }
}

/// As [`sum`], without SIMD.
pub(crate) fn sum_scalar<C: TriangleContribution>(
    input: SumInput<'_>,
    contribution: C,
    band: RowBand,
    out: [&mut [f32]; 3],
) {
    sum(Scalar, input, contribution, band, out);
}

/// Adds the contributions of up to eight triangles to their corners.
#[inline(always)]
fn add_triangles<S: Simd, C: TriangleContribution>(
    s: S,
    input: SumInput<'_>,
    own: Range<usize>,
    contribution: C,
    out: &mut [&mut [f32]; 3],
) {
    let (corners, areas) = (&input.triangles[own.clone()], &input.areas[own]);
    let mut rest_areas = [0.0; LANES];
    rest_areas.iter_mut().zip(areas).for_each(|(rest, [a, b, c])| *rest = a + b + c);
    let vectors = evaluate_gathered(s, input, corners, &rest_areas, contribution);
    scatter_to_corners(&vectors, corners, areas, C::WEIGHTED_BY_AREA, out);
}

/// Adds one vector per triangle to the corners of up to eight triangles, one by one.
#[inline(never)]
fn scatter_to_corners(
    vectors: &[LaneArray; 3],
    corners: &[[u32; 3]],
    areas: &[[f32; 3]],
    is_weighted_by_area: bool,
    out: &mut [&mut [f32]; 3],
) {
    for (lane, (corners, areas)) in corners.iter().zip(areas).enumerate() {
        for (v, area) in corners.iter().zip(areas) {
            let share = corner_share(*area, is_weighted_by_area);
            for axis in 0..3 {
                out[axis][*v as usize] += vectors[axis][lane % LANES] * share;
            }
        }
    }
}
