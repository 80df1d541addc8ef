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

use crate::math::columns::Columns;
use crate::math::simd::{LANES, LaneArray, Simd};
use crate::mesh::grid::has_falling_diagonal;
use crate::model::grid_cells::GridCells;
use crate::solver::vertex_sums::triangles::{
    Band, Give, Surface, V, given_by, part, rest_areas_of,
};

/// Grids with more particles across are summed up triangle by triangle.
pub(crate) const MOST_ACROSS: usize = 512;

/// Columns of a row: what its first and its second triangles give, and …
const GIVEN: usize = 6;
/// … what is left of each of their corners.
const CORNERS: usize = 6;

/// What chunks read beyond the cells of a row, of which the first is none.
const BEYOND: usize = 1 + LANES;

/// Room for two rows, of the first size that will do: it is cleared each time.
const SIZES: [usize; 3] = [1024, 4096, 2 * (GIVEN + CORNERS) * (MOST_ACROSS + BEYOND)];

/// What the cells of a row give; the first is none.
struct Given<'a> {
    /// Three numbers of the first triangles, then three of the second.
    by: [&'a mut [f32]; GIVEN],
    /// While anything of the grid is torn, 1 for corners that are as they were made and 0 for others.
    kept: [&'a mut [f32]; CORNERS],
    /// See `GridCells`.
    torn: [u8; MOST_ACROSS + BEYOND],
    is_torn: bool,
    is_divided: bool,
}

/// The same to take from.
#[derive(Clone, Copy)]
struct Seen<'a> {
    by: [&'a [f32]; GIVEN],
    kept: [&'a [f32]; CORNERS],
    is_torn: bool,
}

impl<'a> Given<'a> {
    /// Nothing, in room that is clear: columns of such a length, with those for corners or without.
    #[inline(never)]
    fn new(room: &'a mut [f32], length: usize) -> Self {
        let mut columns = room.chunks_exact_mut(length);
        let mut next = || columns.next().unwrap_or_default();
        Self {
            by: core::array::from_fn(|_| next()),
            kept: core::array::from_fn(|_| next()),
            torn: [0; MOST_ACROSS + BEYOND],
            is_torn: false,
            is_divided: false,
        }
    }

    /// All columns are as long as each other, so that one check does for all.
    #[inline(always)]
    fn seen(&self) -> Seen<'_> {
        let length = self.by[0].len();
        let mut seen = Seen { by: [&[]; GIVEN], kept: [&[]; CORNERS], is_torn: self.is_torn };
        for (seen, by) in seen.by.iter_mut().zip(&self.by) {
            *seen = &by[..length];
        }
        if self.is_torn {
            for (seen, kept) in seen.kept.iter_mut().zip(&self.kept) {
                *seen = &kept[..length];
            }
        }
        seen
    }

    /// Leaves nothing in a row.
    fn clear(&mut self) {
        self.by.iter_mut().for_each(|column| column.fill(0.0));
        self.torn.fill(0);
        (self.is_torn, self.is_divided) = (false, false);
    }

    /// Takes over what is torn of a row.
    #[inline(never)]
    fn tear(&mut self, row: Row<'_>) {
        let own = row.number * row.across()..(row.number + 1) * row.across();
        let (triangles, _) = row.cells.torn_triangles(row.number);
        self.is_torn = !triangles.is_empty();
        self.is_divided = self.is_torn && row.cells.is_cut[own.clone()].contains(&true);
        self.torn[1..=row.across()].copy_from_slice(&row.cells.moved_corners[own]);
        if self.is_torn {
            self.kept.iter_mut().for_each(|column| column.fill(1.0));
        }
        for at in triangles {
            let (cell, half) = row.place(*at as usize);
            let torn = row.cells.moved_corners_of(*at as usize);
            for corner in 0..3 {
                self.kept[3 * half + corner][cell + 1] = f32::from(!torn >> corner & 1);
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
    cells: &'a GridCells,
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

    /// What falls to the corners of half a cell that no cut divided, see `grid::corner_areas`.
    #[inline(always)]
    fn corner_areas(&self, cell: usize, half: usize) -> [f32; 3] {
        let mut areas = [self.cells.corner_area; 3];
        areas[half + usize::from(has_falling_diagonal(self.number as u32, cell as u32))] *= 2.0;
        areas
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
    cells: &GridCells,
    give: G,
    band: Band,
    out: &mut [&mut [f32]; 3],
) {
    let columns = cells.columns;
    let length = columns - 1 + BEYOND;
    let size = (GIVEN + if cells.is_torn() { CORNERS } else { 0 }) * length;
    let (mut little, mut some, mut much);
    let room: &mut [f32] = if 2 * size <= SIZES[0] {
        little = [0.0; SIZES[0]];
        &mut little
    } else if 2 * size <= SIZES[1] {
        some = [0.0; SIZES[1]];
        &mut some
    } else {
        much = [0.0; SIZES[2]];
        &mut much
    };
    let (upper, lower) = room.split_at_mut(size);
    let (mut above, mut below) =
        (&mut Given::new(upper, length), &mut Given::new(&mut lower[..size], length));
    // Particles take from the row of cells above theirs too, so that one comes first.
    for number in band.first.saturating_sub(1)..band.end.min(cells.rows) {
        let row = Row { cells, number };
        if number + 1 < cells.rows {
            fill(s, surface, row, give, below, out);
        } else {
            below.clear();
        }
        let seen = [above.seen(), below.seen()];
        let count = if number < band.first { 0 } else { columns };
        for start in (0..count).step_by(S::LANES) {
            // The last chunk reaches back over particles that are done, and gives them the same.
            let first = start.min(columns - S::LANES);
            let at = (number - band.first) * columns + first;
            if !(above.is_torn_at(first) || below.is_torn_at(first)) {
                take::<S, G, false>(s, row, first, &seen, at, out);
            } else if !(above.is_divided || below.is_divided) {
                take::<S, G, true>(s, row, first, &seen, at, out);
            } else {
                (0..S::LANES).for_each(|lane| {
                    let at = at + lane;
                    take_apart(surface, row, first + lane, G::BY_AREA, [above, below], at, out);
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
    given: &mut Given<'_>,
    out: &mut [&mut [f32]; 3],
) {
    let across = row.across();
    let length = given.by[0].len();
    let mut by: [&mut [f32]; GIVEN] = Default::default();
    for (by, column) in by.iter_mut().zip(&mut given.by) {
        *by = &mut column[..length];
    }
    for start in (0..across).step_by(S::LANES) {
        fill_chunk(s, surface, row, start.min(across - S::LANES), give, &mut by);
    }
    given.tear(row);
    if given.is_torn {
        fill_torn(s, surface, row, give, given, out);
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
    by: &mut [&mut [f32]; GIVEN],
) {
    let top = row.number * row.cells.columns + first;
    let bottom = top + row.cells.columns;
    let falling =
        s.load(&BY_TURNS, usize::from(!has_falling_diagonal(row.number as u32, first as u32)));
    let rest_area = s.splat(row.cells.rest_area());
    let x = corners(s, surface.x, [top, bottom], falling);
    let air = corners(s, surface.air, [top, bottom], falling);
    for half in 0..2 {
        let gives = give.give(s, x[half], air[half], rest_area);
        for axis in 0..3 {
            s.store(by[3 * half + axis], first + 1, gives[axis]);
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
    [s.select(keep, a[0], b[0]), s.select(keep, a[1], b[1]), s.select(keep, a[2], b[2])]
}

#[inline(always)]
fn load<S: Simd>(s: S, columns: &Columns, first: usize) -> V<S> {
    [s.load(&columns.x, first), s.load(&columns.y, first), s.load(&columns.z, first)]
}

/// The triangles of a row that are not as they were made, eight at a time. They give to all their corners at
/// once: what was split off lies beyond the grid's own particles, and these forget it when they take.
#[inline(always)]
fn fill_torn<S: Simd, G: Give>(
    s: S,
    surface: Surface<'_>,
    row: Row<'_>,
    give: G,
    given: &mut Given<'_>,
    out: &mut [&mut [f32]; 3],
) {
    let (triangles, corners) = row.cells.torn_triangles(row.number);
    for (some, corners) in triangles.chunks(LANES).zip(corners.chunks(LANES)) {
        let mut rest_areas = [row.cells.rest_area(); LANES];
        if given.is_divided {
            rest_areas = rest_areas_of(surface, some);
        }
        let found = given_by(s, surface, corners, &rest_areas, give);
        give_torn(surface, row, [some, corners.as_flattened()], &found, G::BY_AREA, given, out);
    }
}

/// Hands out what up to eight torn triangles give.
#[inline(never)]
fn give_torn(
    surface: Surface<'_>,
    row: Row<'_>,
    [triangles, corners]: [&[u32]; 2],
    found: &[LaneArray; 3],
    by_area: bool,
    given: &mut Given<'_>,
    out: &mut [&mut [f32]; 3],
) {
    for (lane, (at, corners)) in triangles.iter().zip(corners.chunks_exact(3)).enumerate() {
        let at = *at as usize;
        let (cell, half) = row.place(at);
        let areas = if given.is_divided { surface.areas[at] } else { row.corner_areas(cell, half) };
        for axis in 0..3 {
            let found = found[axis][lane];
            given.by[3 * half + axis][cell + 1] = found;
            for corner in 0..3 {
                out[axis][corners[corner] as usize] += found * part(areas[corner], by_area);
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
    seen: &[Seen<'_>; 2],
    at: usize,
    out: &mut [&mut [f32]; 3],
) {
    let (area, zero) = (row.cells.corner_area, s.splat(0.0));
    let (quarter, half) = (s.splat(G::part(area)), s.splat(G::part(2.0 * area)));
    // Where the cell below falls, all diagonals around meet here.
    let meets =
        s.load(&BY_TURNS, usize::from(!has_falling_diagonal(row.number as u32, first as u32)));
    let (shared, own) = (s.select_or_zero(meets, quarter), s.select(meets, quarter, half));
    let ([above, below], mut sums) = (seen, [zero; 3]);
    add::<S, TORN>(s, above, first, 2, shared, &mut sums);
    add::<S, TORN>(s, above, first, 4, own, &mut sums);
    add::<S, TORN>(s, above, first + 1, 1, own, &mut sums);
    add::<S, TORN>(s, above, first + 1, 3, shared, &mut sums);
    add::<S, TORN>(s, below, first, 2, shared, &mut sums);
    add::<S, TORN>(s, below, first, 5, own, &mut sums);
    add::<S, TORN>(s, below, first + 1, 0, own, &mut sums);
    add::<S, TORN>(s, below, first + 1, 3, shared, &mut sums);
    for axis in 0..3 {
        s.store(out[axis], at, sums[axis]);
    }
}

/// Adds what cells from some on give to one of the six corners of their triangles, as far as that is left.
#[inline(always)]
fn add<S: Simd, const TORN: bool>(
    s: S,
    seen: &Seen<'_>,
    from: usize,
    corner: usize,
    mut part: S::F,
    sums: &mut [S::F; 3],
) {
    if TORN && seen.is_torn {
        part = s.select_or_zero(s.load(seen.kept[corner], from), part);
    }
    for axis in 0..3 {
        sums[axis] = sums[axis] + s.load(seen.by[corner / 3 * 3 + axis], from) * part;
    }
}

/// One particle takes what is its own of the cells around, wherever in them it is.
#[inline(never)]
fn take_apart(
    surface: Surface<'_>,
    row: Row<'_>,
    column: usize,
    by_area: bool,
    [above, below]: [&Given<'_>; 2],
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
            for half in 0..2 {
                let corners = surface.triangles[first + half].into_iter();
                for (corner, area) in corners.zip(surface.areas[first + half]) {
                    let part = part(area, by_area);
                    for axis in 0..3 {
                        let given = given.by[3 * half + axis][cell + 1] * part;
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
