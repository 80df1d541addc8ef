//! Sums over the cells of a grid: eight cells at a time give, and eight particles at a time take.
//!
//! ```text
//!  ●───────●───────●      Each particle takes from the cells around it in the order of their triangles:
//!  │ first │ next  │      from the two above, then from the two below. Where the diagonals meet it has
//!  ●───────◉───────●      a quarter right angle's share of all eight triangles, elsewhere half a cell's
//!  │ third │ last  │      of the four whose right angle it is.
//!  ●───────●───────●
//! ```
//! What was split off a cell takes for itself. Where a cut divided a cell, particles look for what is
//! theirs one by one.

use super::surface::{Band, Give, Surface, V, given_by, rest_areas_of};
use crate::fabric::cells::Cells;
use crate::math::columns::Columns;
use crate::math::simd::{LANES, Simd};
use crate::mesh::grid::falls;

/// Grids with more particles across are summed up triangle by triangle.
pub(crate) const MOST_ACROSS: usize = 512;

/// The cells of a row, one beyond each end, and what chunks read beyond that.
const ROOM: usize = MOST_ACROSS + 1 + LANES;

/// What the cells of a row give; the first is none.
struct Given {
    /// Of their first and of their second triangles.
    by: [[[f32; ROOM]; 3]; 2],
    /// See `Cells`; …
    torn: [u8; ROOM],
    /// … where any is torn, 1 for corners that are as they were made and 0 for others.
    kept: [[f32; ROOM]; 6],
    is_torn: bool,
    is_divided: bool,
}

impl Given {
    fn nothing() -> Self {
        let by = [[[0.0; ROOM]; 3]; 2];
        let kept = [[0.0; ROOM]; 6];
        Self { by, torn: [0; ROOM], kept, is_torn: false, is_divided: false }
    }

    /// Leaves nothing in a row of so many cells.
    fn clear(&mut self, across: usize) {
        self.by.as_flattened_mut().iter_mut().for_each(|column| column[..=across].fill(0.0));
        self.torn[..=across].fill(0);
        (self.is_torn, self.is_divided) = (false, false);
    }

    /// Takes over what is torn of a row.
    fn tear(&mut self, row: Row<'_>) {
        let own = row.number * row.across()..(row.number + 1) * row.across();
        let (triangles, _) = row.cells.torn_triangles(row.number);
        self.is_torn = !triangles.is_empty();
        self.is_divided = self.is_torn && row.cells.divided[own.clone()].contains(&true);
        self.torn[1..=row.across()].copy_from_slice(&row.cells.torn[own]);
        if self.is_torn {
            self.kept.iter_mut().for_each(|kept| kept[..=row.across() + 1].fill(1.0));
        }
        for at in triangles {
            let (cell, half) = row.place(*at as usize);
            let mut torn = row.cells.torn_corners(*at as usize);
            while torn != 0 {
                self.kept[3 * half + torn.trailing_zeros() as usize][cell + 1] = 0.0;
                torn &= torn - 1;
            }
        }
    }

    /// Whether anything is torn of the cells that particles from `first` on take from.
    #[inline(always)]
    fn is_torn_at(&self, first: usize) -> bool {
        let mut bytes = [0; LANES];
        bytes.copy_from_slice(&self.torn[first..first + LANES]);
        self.is_torn && (u64::from_le_bytes(bytes) != 0 || self.torn[first + LANES] != 0)
    }
}

/// A row of cells.
#[derive(Clone, Copy)]
struct Row<'a> {
    cells: &'a Cells,
    number: usize,
}

impl Row<'_> {
    fn across(&self) -> usize {
        self.cells.columns - 1
    }

    /// The first of the triangles of a cell.
    #[inline(always)]
    fn triangle(&self, cell: usize) -> usize {
        2 * (self.number * self.across() + cell)
    }

    /// The cell of a triangle, and which half of it that is.
    #[inline(always)]
    fn place(&self, triangle: usize) -> (usize, usize) {
        (triangle / 2 - self.number * self.across(), triangle % 2)
    }
}

/// Adds what the triangles of all cells give to particles that have nothing yet.
#[inline(always)]
pub(crate) fn sum<S: Simd, G: Give>(
    s: S,
    surface: Surface<'_>,
    cells: &Cells,
    give: G,
    band: Band,
    out: &mut [&mut [f32]; 3],
) {
    let (columns, across) = (cells.columns, cells.columns - 1);
    let (mut above, mut below) = (&mut Given::nothing(), &mut Given::nothing());
    let rows = band.first..band.end.min(cells.rows);
    if let Some(number) = rows.start.checked_sub(1) {
        fill(s, surface, Row { cells, number }, give, above, out);
    }
    for number in rows {
        let row = Row { cells, number };
        if number + 1 < cells.rows {
            fill(s, surface, row, give, below, out);
        } else {
            below.clear(across);
        }
        for start in (0..columns).step_by(S::LANES) {
            // The last chunk reaches back over particles that are done, and gives them the same.
            let first = start.min(columns - S::LANES);
            let at = (number - band.first) * columns + first;
            if !(above.is_torn_at(first) || below.is_torn_at(first)) {
                take::<S, G, false>(s, row, first, give, [above, below], at, out);
            } else if !(above.is_divided || below.is_divided) {
                take::<S, G, true>(s, row, first, give, [above, below], at, out);
            } else {
                (0..S::LANES).for_each(|lane| {
                    take_apart(surface, row, first + lane, give, [above, below], at + lane, out);
                });
            }
        }
        (above, below) = (below, above);
    }
}

/// What the cells of a row give; what was split off gets its part at once.
#[inline(always)]
fn fill<S: Simd, G: Give>(
    s: S,
    surface: Surface<'_>,
    row: Row<'_>,
    give: G,
    given: &mut Given,
    out: &mut [&mut [f32]; 3],
) {
    let across = row.across();
    for start in (0..across).step_by(S::LANES) {
        fill_chunk(s, surface, row, start.min(across - S::LANES), give, given);
    }
    given.tear(row);
    if given.is_torn {
        fill_torn(s, surface, row, give, given);
        add_split_off(surface, row, give, given, out);
    }
}

/// 1 and 0 by turns.
const BY_TURNS: [f32; LANES + 1] = [1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0];

/// Some cells, as if none were torn.
#[inline(always)]
fn fill_chunk<S: Simd, G: Give>(
    s: S,
    surface: Surface<'_>,
    row: Row<'_>,
    first: usize,
    give: G,
    given: &mut Given,
) {
    let top = row.number * row.cells.columns + first;
    let bottom = top + row.cells.columns;
    let falling = s.load(&BY_TURNS, usize::from(!falls(row.number as u32, first as u32)));
    let rest_area = s.splat(row.cells.rest_area());
    let x = corners(s, surface.x, [top, bottom], falling);
    let air = corners(s, surface.air, [top, bottom], falling);
    for (number, by) in given.by.iter_mut().enumerate() {
        let given = give.give(s, x[number], air[number], rest_area);
        for (column, given) in by.iter_mut().zip(given) {
            s.store(column, first + 1, given);
        }
    }
}

/// The corners of the first and of the second triangle of some cells.
#[inline(always)]
fn corners<S: Simd>(
    s: S,
    of: &Columns,
    [top, bottom]: [usize; 2],
    falling: S::F,
) -> [[V<S>; 3]; 2] {
    let (left, right) = (load(s, of, top), load(s, of, top + 1));
    let (low_left, low_right) = (load(s, of, bottom), load(s, of, bottom + 1));
    let (end, start) = (pick(s, falling, low_right, right), pick(s, falling, left, low_left));
    [[left, low_left, end], [start, low_right, right]]
}

#[inline(always)]
fn pick<S: Simd>(s: S, keep: S::F, a: V<S>, b: V<S>) -> V<S> {
    [s.pick(keep, a[0], b[0]), s.pick(keep, a[1], b[1]), s.pick(keep, a[2], b[2])]
}

#[inline(always)]
fn load<S: Simd>(s: S, columns: &Columns, first: usize) -> V<S> {
    [s.load(&columns.x, first), s.load(&columns.y, first), s.load(&columns.z, first)]
}

/// The triangles of a row that are not as they were made, eight at a time.
#[inline(always)]
fn fill_torn<S: Simd, G: Give>(
    s: S,
    surface: Surface<'_>,
    row: Row<'_>,
    give: G,
    given: &mut Given,
) {
    let (triangles, corners) = row.cells.torn_triangles(row.number);
    for (some, corners) in triangles.chunks(LANES).zip(corners.chunks(LANES)) {
        let mut rest_areas = [row.cells.rest_area(); LANES];
        if given.is_divided {
            rest_areas = rest_areas_of(surface, some);
        }
        let found = given_by(s, surface, corners, &rest_areas, give);
        for (lane, at) in some.iter().enumerate() {
            let (cell, half) = row.place(*at as usize);
            for (column, found) in given.by[half].iter_mut().zip(&found) {
                column[cell + 1] = found[lane];
            }
        }
    }
}

/// Gives to what was split off the cells of a row, which lies beyond the grid's own particles.
#[inline(always)]
fn add_split_off<G: Give>(
    surface: Surface<'_>,
    row: Row<'_>,
    give: G,
    given: &Given,
    out: &mut [&mut [f32]; 3],
) {
    let woven = row.cells.columns * row.cells.rows;
    let (triangles, corners) = row.cells.torn_triangles(row.number);
    for (at, corners) in triangles.iter().zip(corners) {
        let at = *at as usize;
        let ((cell, half), mut torn) = (row.place(at), row.cells.torn_corners(at));
        while torn != 0 {
            let corner = torn.trailing_zeros() as usize;
            torn &= torn - 1;
            let particle = corners[corner] as usize;
            if particle >= woven {
                let area = if given.is_divided {
                    surface.areas[at][corner]
                } else {
                    row.cells.corner_area(at, corner)
                };
                let part = give.part(area);
                for axis in 0..3 {
                    out[axis][particle] += given.by[half][axis][cell + 1] * part;
                }
            }
        }
    }
}

/// Some particles take what is theirs.
#[inline(always)]
fn take<S: Simd, G: Give, const TORN: bool>(
    s: S,
    row: Row<'_>,
    first: usize,
    give: G,
    [above, below]: [&Given; 2],
    at: usize,
    out: &mut [&mut [f32]; 3],
) {
    let (area, zero) = (row.cells.quarter, s.splat(0.0));
    let (quarter, half) = (s.splat(give.part(area)), s.splat(give.part(2.0 * area)));
    // Where the cell below falls, all diagonals around meet here.
    let meets = s.load(&BY_TURNS, usize::from(!falls(row.number as u32, first as u32)));
    let (shared, own) = (s.pick(meets, quarter, zero), s.pick(meets, quarter, half));
    // Whose, from where on, and of the two triangles each: which part, and as which of the corners.
    let around = [
        (above, first, [(shared, 2), (own, 4)]),
        (above, first + 1, [(own, 1), (shared, 3)]),
        (below, first, [(shared, 2), (own, 5)]),
        (below, first + 1, [(own, 0), (shared, 3)]),
    ];
    let mut sums = [zero; 3];
    for (given, from, parts) in around {
        for (by, (mut part, corner)) in given.by.iter().zip(parts) {
            if TORN && given.is_torn {
                part = s.pick(s.load(&given.kept[corner], from), part, zero);
            }
            for (sum, by) in sums.iter_mut().zip(by) {
                *sum = *sum + s.load(by, from) * part;
            }
        }
    }
    for (out, sum) in out.iter_mut().zip(sums) {
        s.store(out, at, sum);
    }
}

/// One particle takes what is its own of the cells around, wherever in them it is.
fn take_apart<G: Give>(
    surface: Surface<'_>,
    row: Row<'_>,
    column: usize,
    give: G,
    [above, below]: [&Given; 2],
    at: usize,
    out: &mut [&mut [f32]; 3],
) {
    let particle = (row.number * row.cells.columns + column) as u32;
    let mut sums = [0.0; 3];
    for (given, number) in [(above, row.number.wrapping_sub(1)), (below, row.number)] {
        for cell in column.saturating_sub(1)..=column {
            if number >= row.cells.rows - 1 || cell >= row.across() {
                continue;
            }
            let first = Row { number, ..row }.triangle(cell);
            for (half, by) in given.by.iter().enumerate() {
                let corners = surface.triangles[first + half].into_iter();
                for (corner, area) in corners.zip(surface.areas[first + half]) {
                    let part = give.part(area);
                    for axis in 0..3 {
                        let given = by[axis][cell + 1] * part;
                        sums[axis] += if corner == particle { given } else { 0.0 };
                    }
                }
            }
        }
    }
    for axis in 0..3 {
        out[axis][at] = sums[axis];
    }
}
