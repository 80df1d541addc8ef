//! Sums over the cells of a grid: eight cells are evaluated, then eight particles gather from them.
//!
//! ```text
//!  ●───────●───────●   A particle gathers from the four cells around it in the order of their
//!  │ first │ second│   triangles: the two above, then the two below. Where the diagonals meet
//!  ●───────◉───────●   it is a corner of eight triangles and gets a quarter of the rest area of
//!  │ third │ fourth│   each; elsewhere it is the right angle of four triangles and gets half of
//!  ●───────●───────●   the rest area of each.
//! ```
//! Two rows of cells are kept: the row above and the row below the particles that gather. A corner
//! that was split off belongs to another particle now; the torn triangles scatter to their corners
//! instead, and the grid's particle leaves that corner out. Where a cut moved the corners of a
//! cell, the particles around it search the triangles of the cells one by one.
//!
//! Reads a `SumInput` and `GridCells`; writes the sums of the grid's particles, and adds to those
//! of the particles that tears split off.
//! Invariant: the additions to one particle come in the order of the triangles, as in `triangles`.

use crate::math::columns::Columns;
use crate::math::simd::{LANES, LaneArray, Simd};
use crate::mesh::grid::has_falling_diagonal;
use crate::model::grid_cells::GridCells;
use crate::solver::vertex_sums::contribution::{
    LaneVector, RowBand, SumInput, TriangleContribution, corner_share, evaluate_gathered,
    rest_areas_of,
};

/// The largest number of particles across; wider grids scatter triangle by triangle.
pub(crate) const MAX_COLUMNS: usize = 512;

/// Buffer columns of a row for contributions: three components of the first and of the second
/// triangle.
const COMPONENTS: usize = 6;
/// Buffer columns of a row for the masks of the six corners.
const CORNERS: usize = 6;

/// Entries of a buffer column besides the cells: one before them, and as many behind as a chunk may
/// read.
const PADDING: usize = 1 + LANES;

/// Buffer sizes for two rows. The smallest that suffices is used, because it is cleared each time.
const BUFFER_SIZES: [usize; 3] = [1024, 4096, 2 * (COMPONENTS + CORNERS) * (MAX_COLUMNS + PADDING)];

/// The contributions of a row of cells; entry 0 of each column is padding.
struct CellRowBuffer<'a> {
    /// Three components of the first triangle of each cell, then three of the second.
    vectors: [&'a mut [f32]; COMPONENTS],
    /// 1 for a corner that still belongs to the grid's particle, else 0; empty while the grid is
    /// untorn.
    intact: [&'a mut [f32]; CORNERS],
    /// The bits of the torn corners of each cell, see `GridCells::moved_corners`.
    torn: [u8; MAX_COLUMNS + PADDING],
    /// Whether a corner of the row was split off.
    is_torn: bool,
    /// Whether a cut moved a corner of the row.
    is_divided: bool,
}

/// A buffer to gather from.
#[derive(Clone, Copy)]
struct CellRowView<'a> {
    vectors: [&'a [f32]; COMPONENTS],
    intact: [&'a [f32]; CORNERS],
    is_torn: bool,
}

impl<'a> CellRowBuffer<'a> {
    /// Splits a cleared buffer into columns of `length`; without masks if it is too short for them.
    #[inline(never)]
    fn new(buffer: &'a mut [f32], length: usize) -> Self {
        let mut columns = buffer.chunks_exact_mut(length);
        let mut next = || columns.next().unwrap_or_default();
        Self {
            vectors: core::array::from_fn(|_| next()),
            intact: core::array::from_fn(|_| next()),
            torn: [0; MAX_COLUMNS + PADDING],
            is_torn: false,
            is_divided: false,
        }
    }

    /// The columns, cut to one length so that the compiler drops all bounds checks but one.
    #[inline(always)]
    fn view(&self) -> CellRowView<'_> {
        let length = self.vectors[0].len();
        let mut view = CellRowView {
            vectors: [&[]; COMPONENTS],
            intact: [&[]; CORNERS],
            is_torn: self.is_torn,
        };
        for (view, column) in view.vectors.iter_mut().zip(&self.vectors) {
            *view = &column[..length];
        }
        if self.is_torn {
            for (view, column) in view.intact.iter_mut().zip(&self.intact) {
                *view = &column[..length];
            }
        }
        view
    }

    /// Sets all contributions to 0: the row lies beyond the grid.
    fn clear(&mut self) {
        self.vectors.iter_mut().for_each(|column| column.fill(0.0));
        self.torn.fill(0);
        (self.is_torn, self.is_divided) = (false, false);
    }

    /// Loads the torn corners of a row.
    #[inline(never)]
    fn load_torn(&mut self, row: CellRow<'_>) {
        let own = row.number * row.across()..(row.number + 1) * row.across();
        let (triangles, _) = row.cells.torn_triangles(row.number);
        self.is_torn = !triangles.is_empty();
        self.is_divided = self.is_torn && row.cells.is_cut[own.clone()].contains(&true);
        self.torn[1..=row.across()].copy_from_slice(&row.cells.moved_corners[own]);
        if self.is_torn {
            self.intact.iter_mut().for_each(|column| column.fill(1.0));
        }
        for at in triangles {
            let (cell, half) = row.cell_of(*at as usize);
            let torn = row.cells.moved_corners_of(*at as usize);
            for corner in 0..3 {
                self.intact[3 * half + corner][cell + 1] = f32::from(!torn >> corner & 1);
            }
        }
    }

    /// Whether a cell is torn that one of the eight particles from `first` on gathers from.
    #[inline(always)]
    fn is_torn_at(&self, first: usize) -> bool {
        let mut bytes = [0; LANES];
        bytes.copy_from_slice(&self.torn[first..first + LANES]);
        self.is_torn && (u64::from_le_bytes(bytes) != 0 || self.torn[first + LANES] != 0)
    }
}

/// A row of cells.
#[derive(Clone, Copy)]
struct CellRow<'a> {
    cells: &'a GridCells,
    number: usize,
}

impl CellRow<'_> {
    /// The number of cells.
    fn across(&self) -> usize {
        self.cells.columns - 1
    }

    /// The index of the first triangle of a cell.
    #[inline(always)]
    fn triangle(&self, cell: usize) -> usize {
        2 * (self.number * self.across() + cell)
    }

    /// The shares of the corners in the rest area of half an uncut cell [m²], see
    /// `grid::corner_areas`.
    #[inline(always)]
    fn corner_areas(&self, cell: usize, half: usize) -> [f32; 3] {
        let mut areas = [self.cells.corner_area; 3];
        areas[half + usize::from(has_falling_diagonal(self.number as u32, cell as u32))] *= 2.0;
        areas
    }

    /// The cell of a triangle, and which half of the cell it is.
    #[inline(always)]
    fn cell_of(&self, triangle: usize) -> (usize, usize) {
        (triangle / 2 - self.number * self.across(), triangle % 2)
    }
}

/// Sums the contributions of all cells for the particles of a band, whose sums are 0 so far.
#[inline(always)]
pub(crate) fn sum<S: Simd, C: TriangleContribution>(
    s: S,
    input: SumInput<'_>,
    cells: &GridCells,
    contribution: C,
    band: RowBand,
    out: &mut [&mut [f32]; 3],
) {
    let columns = cells.columns;
    let length = columns - 1 + PADDING;
    let size = (COMPONENTS + if cells.is_torn() { CORNERS } else { 0 }) * length;
    let (mut small, mut medium, mut large);
    let buffer: &mut [f32] = if 2 * size <= BUFFER_SIZES[0] {
        small = [0.0; BUFFER_SIZES[0]];
        &mut small
    } else if 2 * size <= BUFFER_SIZES[1] {
        medium = [0.0; BUFFER_SIZES[1]];
        &mut medium
    } else {
        large = [0.0; BUFFER_SIZES[2]];
        &mut large
    };
    let (upper, lower) = buffer.split_at_mut(size);
    let (mut above, mut below) = (
        &mut CellRowBuffer::new(upper, length),
        &mut CellRowBuffer::new(&mut lower[..size], length),
    );
    // The first particles also gather from the row of cells above them, so that row is evaluated
    // first.
    for number in band.first.saturating_sub(1)..band.end.min(cells.rows) {
        let row = CellRow { cells, number };
        if number + 1 < cells.rows {
            evaluate_row(s, input, row, contribution, below, out);
        } else {
            below.clear();
        }
        if number >= band.first {
            let at = (number - band.first) * columns;
            gather_row(s, input, row, C::WEIGHTED_BY_AREA, [above, below], at, out);
        }
        (above, below) = (below, above);
    }
}

/// Sums the contributions around a row of particles, and stores the sums from `at` on.
///
/// Not inlined in wasm, which has one instruction set: all contributions share it.
#[cfg_attr(target_arch = "wasm32", inline(never))]
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn gather_row<S: Simd>(
    s: S,
    input: SumInput<'_>,
    row: CellRow<'_>,
    is_weighted_by_area: bool,
    [above, below]: [&CellRowBuffer<'_>; 2],
    at: usize,
    out: &mut [&mut [f32]; 3],
) {
    let columns = row.cells.columns;
    let views = [above.view(), below.view()];
    for start in (0..columns).step_by(S::LANES) {
        // The last chunk overlaps with particles that are done, and gives them the same sums.
        let first = start.min(columns - S::LANES);
        let at = at + first;
        if !(above.is_torn_at(first) || below.is_torn_at(first)) {
            gather_chunk::<S, false>(s, row, first, is_weighted_by_area, &views, at, out);
        } else if !(above.is_divided || below.is_divided) {
            gather_chunk::<S, true>(s, row, first, is_weighted_by_area, &views, at, out);
        } else {
            (0..S::LANES).for_each(|lane| {
                let (column, at) = (first + lane, at + lane);
                let buffers = [above, below];
                gather_searching(input, row, column, is_weighted_by_area, buffers, at, out);
            });
        }
    }
}

/// Evaluates a row of cells, and scatters the contributions of its torn triangles.
#[inline(always)]
fn evaluate_row<S: Simd, C: TriangleContribution>(
    s: S,
    input: SumInput<'_>,
    row: CellRow<'_>,
    contribution: C,
    buffer: &mut CellRowBuffer<'_>,
    out: &mut [&mut [f32]; 3],
) {
    let across = row.across();
    let length = buffer.vectors[0].len();
    let mut vectors: [&mut [f32]; COMPONENTS] = Default::default();
    for (vector, column) in vectors.iter_mut().zip(&mut buffer.vectors) {
        *vector = &mut column[..length];
    }
    for start in (0..across).step_by(S::LANES) {
        evaluate_chunk(s, input, row, start.min(across - S::LANES), contribution, &mut vectors);
    }
    buffer.load_torn(row);
    if buffer.is_torn {
        evaluate_torn(s, input, row, contribution, buffer, out);
    }
}

/// 1 and 0 in alternation.
const ALTERNATING: [f32; LANES + 1] = [1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0];

/// Evaluates `S::LANES` cells as if none were torn.
#[inline(always)]
fn evaluate_chunk<S: Simd, C: TriangleContribution>(
    s: S,
    input: SumInput<'_>,
    row: CellRow<'_>,
    first: usize,
    contribution: C,
    vectors: &mut [&mut [f32]; COMPONENTS],
) {
    let top = row.number * row.cells.columns + first;
    let bottom = top + row.cells.columns;
    let falling =
        s.load(&ALTERNATING, usize::from(!has_falling_diagonal(row.number as u32, first as u32)));
    let rest_area = s.splat(row.cells.rest_area());
    let x = load_cells(s, input.x, [top, bottom], falling);
    let attribute = load_cells(s, input.attribute, [top, bottom], falling);
    for half in 0..2 {
        let vector = contribution.evaluate(s, x[half], attribute[half], rest_area);
        for axis in 0..3 {
            s.store(vectors[3 * half + axis], first + 1, vector[axis]);
        }
    }
}

/// Loads the corners of the first and of the second triangle of `S::LANES` cells. `falling` is 1
/// where the diagonal falls from left to right, else 0.
#[inline(always)]
fn load_cells<S: Simd>(
    s: S,
    of: &Columns,
    [top, bottom]: [usize; 2],
    falling: S::F,
) -> [[LaneVector<S>; 3]; 2] {
    let (left, right) = (load(s, of, top), load(s, of, top + 1));
    let (low_left, low_right) = (load(s, of, bottom), load(s, of, bottom + 1));
    let (end, start) = (select3(s, falling, low_right, right), select3(s, falling, left, low_left));
    [[left, low_left, end], [start, low_right, right]]
}

#[inline(always)]
fn select3<S: Simd>(s: S, mask: S::F, a: LaneVector<S>, b: LaneVector<S>) -> LaneVector<S> {
    [s.select(mask, a[0], b[0]), s.select(mask, a[1], b[1]), s.select(mask, a[2], b[2])]
}

#[inline(always)]
fn load<S: Simd>(s: S, columns: &Columns, first: usize) -> LaneVector<S> {
    [s.load(&columns.x, first), s.load(&columns.y, first), s.load(&columns.z, first)]
}

/// Evaluates the torn triangles of a row again, eight at a time, and scatters them to all their
/// corners.
///
/// Particles that tears split off come behind those of the grid and keep these sums. The grid's own
/// particles overwrite theirs when they gather.
#[inline(always)]
fn evaluate_torn<S: Simd, C: TriangleContribution>(
    s: S,
    input: SumInput<'_>,
    row: CellRow<'_>,
    contribution: C,
    buffer: &mut CellRowBuffer<'_>,
    out: &mut [&mut [f32]; 3],
) {
    let (triangles, corners) = row.cells.torn_triangles(row.number);
    for (chunk, corners) in triangles.chunks(LANES).zip(corners.chunks(LANES)) {
        let mut rest_areas = [row.cells.rest_area(); LANES];
        if buffer.is_divided {
            rest_areas = rest_areas_of(input, chunk);
        }
        let vectors = evaluate_gathered(s, input, corners, &rest_areas, contribution);
        let chunk = [chunk, corners.as_flattened()];
        scatter_torn(input, row, chunk, &vectors, C::WEIGHTED_BY_AREA, buffer, out);
    }
}

/// Stores the contributions of up to eight torn triangles, and adds them to all their corners.
#[inline(never)]
fn scatter_torn(
    input: SumInput<'_>,
    row: CellRow<'_>,
    [triangles, corners]: [&[u32]; 2],
    vectors: &[LaneArray; 3],
    is_weighted_by_area: bool,
    buffer: &mut CellRowBuffer<'_>,
    out: &mut [&mut [f32]; 3],
) {
    for (lane, (at, corners)) in triangles.iter().zip(corners.chunks_exact(3)).enumerate() {
        let at = *at as usize;
        let (cell, half) = row.cell_of(at);
        let areas = if buffer.is_divided { input.areas[at] } else { row.corner_areas(cell, half) };
        for axis in 0..3 {
            let component = vectors[axis][lane];
            buffer.vectors[3 * half + axis][cell + 1] = component;
            for corner in 0..3 {
                out[axis][corners[corner] as usize] +=
                    component * corner_share(areas[corner], is_weighted_by_area);
            }
        }
    }
}

/// Sums the contributions around `S::LANES` particles from column `first` on, and stores the sums
/// from `at` on. With `TORN`, corners that were split off are left out.
#[inline(always)]
fn gather_chunk<S: Simd, const TORN: bool>(
    s: S,
    row: CellRow<'_>,
    first: usize,
    is_weighted_by_area: bool,
    views: &[CellRowView<'_>; 2],
    at: usize,
    out: &mut [&mut [f32]; 3],
) {
    let (area, zero) = (row.cells.corner_area, s.splat(0.0));
    let share = |area: f32| s.splat(corner_share(area, is_weighted_by_area));
    let (quarter, half) = (share(area), share(2.0 * area));
    // If the diagonal of the fourth cell falls, the diagonals of all four cells meet at this
    // particle.
    let meets =
        s.load(&ALTERNATING, usize::from(!has_falling_diagonal(row.number as u32, first as u32)));
    let (shared, own) = (s.select_or_zero(meets, quarter), s.select(meets, quarter, half));
    let ([above, below], mut sums) = (views, [zero; 3]);
    add_corner::<S, TORN>(s, above, first, 2, shared, &mut sums);
    add_corner::<S, TORN>(s, above, first, 4, own, &mut sums);
    add_corner::<S, TORN>(s, above, first + 1, 1, own, &mut sums);
    add_corner::<S, TORN>(s, above, first + 1, 3, shared, &mut sums);
    add_corner::<S, TORN>(s, below, first, 2, shared, &mut sums);
    add_corner::<S, TORN>(s, below, first, 5, own, &mut sums);
    add_corner::<S, TORN>(s, below, first + 1, 0, own, &mut sums);
    add_corner::<S, TORN>(s, below, first + 1, 3, shared, &mut sums);
    for axis in 0..3 {
        s.store(out[axis], at, sums[axis]);
    }
}

/// Adds the contributions of `S::LANES` cells from entry `from` on to one of the six corners of
/// their triangles.
#[inline(always)]
fn add_corner<S: Simd, const TORN: bool>(
    s: S,
    view: &CellRowView<'_>,
    from: usize,
    corner: usize,
    mut share: S::F,
    sums: &mut [S::F; 3],
) {
    if TORN && view.is_torn {
        share = s.select_or_zero(s.load(view.intact[corner], from), share);
    }
    for axis in 0..3 {
        sums[axis] = sums[axis] + s.load(view.vectors[corner / 3 * 3 + axis], from) * share;
    }
}

/// Sums the contributions around one particle: searches the triangles of the cells around it for
/// corners that are this particle.
#[inline(never)]
fn gather_searching(
    input: SumInput<'_>,
    row: CellRow<'_>,
    column: usize,
    is_weighted_by_area: bool,
    [above, below]: [&CellRowBuffer<'_>; 2],
    at: usize,
    out: &mut [&mut [f32]; 3],
) {
    let particle = (row.number * row.cells.columns + column) as u32;
    let mut sums = [0.0; 3];
    for (buffer, number) in [(above, row.number.wrapping_sub(1)), (below, row.number)] {
        for cell in column.saturating_sub(1)..=column {
            if number >= row.cells.rows - 1 || cell >= row.across() {
                continue;
            }
            let first = CellRow { number, ..row }.triangle(cell);
            for half in 0..2 {
                let corners = input.triangles[first + half].into_iter();
                for (corner, area) in corners.zip(input.areas[first + half]) {
                    let share = corner_share(area, is_weighted_by_area);
                    for axis in 0..3 {
                        let component = buffer.vectors[3 * half + axis][cell + 1] * share;
                        sums[axis] += if corner == particle { component } else { 0.0 };
                    }
                }
            }
        }
    }
    for axis in 0..3 {
        out[axis][at] = sums[axis];
    }
}
