//! Sums over triangles: what each gives to its corners, for wind and for normals alike.
//!
//! Every corner is added to in the order of the triangles. On a grid eight cells go at once where
//! a cut divided none; the additions come in that order still, so the bits are the same. So
//! they do where several threads each add to rows of their own: the cells between two of them are
//! looked at by both, and each adds its half.

use crate::fabric::cells::Cells;
use crate::math::columns::Columns;
use crate::math::simd::{LANES, Lanes};
use crate::math::threads::Threads;
use crate::mesh::grid::falls;

type V = [f32; 3];

/// What a triangle gives.
pub(crate) trait Give: Copy {
    /// From its corners' positions and the air's velocities against them, and its area at rest:
    /// without a branch.
    fn give(self, x: [V; 3], air: [V; 3], rest_area: f32) -> V;

    /// A corner's part of it, where so much of the area at rest is the corner's.
    fn part(self, area: f32) -> f32;
}

/// What is summed over.
#[derive(Clone, Copy)]
pub(crate) struct Surface<'a> {
    pub triangles: &'a [[u32; 3]],
    /// Of each triangle's area at rest what falls to each corner [m²].
    pub areas: &'a [[f32; 3]],
    pub cells: Option<&'a Cells>,
    pub x: &'a Columns,
    pub air: &'a Columns,
}

/// Rows of a grid's particles that are added to, from `first` on.
#[derive(Clone, Copy)]
pub(crate) struct Band {
    first: usize,
    end: usize,
}

impl Band {
    /// All that there is, on a grid or not.
    const ALL: Self = Self { first: 0, end: usize::MAX };
}

/// Cells that one thread sums up at least.
#[cfg(feature = "parallel")]
const CELLS: usize = 8192;

/// Has `sum` add up all, in bands of a grid that is not torn where there are threads for that. It is
/// given the band, and what to add to from the first of its particles on.
pub(crate) fn in_bands(
    threads: Threads,
    surface: Surface<'_>,
    out: &mut Columns,
    sum: impl Fn(Band, [&mut [f32]; 3]) + Sync,
) {
    #[cfg(feature = "parallel")]
    if let Some(cells) = surface.cells {
        let Cells { columns, rows, .. } = *cells;
        let parts = threads.parts(columns * rows, CELLS).min(rows);
        if parts > 1 && columns > LANES && surface.x.x.len() == columns * rows {
            let row = |part: usize| rows * part / parts;
            let add = |part: usize, out: [&mut [f32]; 3]| {
                sum(Band { first: row(part), end: row(part + 1) }, out);
            };
            return threads.parted(parts, out.all_mut(), |part| columns * row(part), add);
        }
    }
    let _ = (threads, surface);
    sum(Band::ALL, out.all_mut());
}

/// Adds what every triangle gives.
#[inline(always)]
pub(crate) fn sum<G: Give>(surface: Surface<'_>, give: G, band: Band, mut out: [&mut [f32]; 3]) {
    let out = &mut out;
    let Some(cells) = surface.cells.filter(|cells| cells.columns > LANES) else {
        let count = surface.triangles.len();
        let whole = count / LANES * LANES;
        (0..whole).step_by(LANES).for_each(|first| add_triangles(surface, first, give, out));
        return (whole..count).for_each(|at| add_triangle(surface, at, give, out));
    };
    let across = cells.columns - 1;
    for row in band.first.saturating_sub(1)..band.end.min(cells.rows - 1) {
        for start in (0..across).step_by(LANES) {
            // The last chunk reaches back over cells that are done, so as to be whole.
            let first = start.min(across - LANES);
            let cell = row * across + first;
            let torn = &cells.torn[cell..cell + LANES];
            let place = Place { row, first, done: start - first, columns: cells.columns, torn };
            if cells.divided[cell..cell + LANES].contains(&true) {
                let from = 2 * (row * across + start);
                let end = 2 * (row * across + (start + LANES).min(across));
                let whole = from + (end - from) / LANES * LANES;
                (from..whole)
                    .step_by(LANES)
                    .for_each(|first| add_triangles(surface, first, give, out));
                (whole..end).for_each(|at| add_triangle(surface, at, give, out));
            } else if torn.contains(&true) {
                add_cells::<G, true>(surface, place, band, give, out);
            } else {
                add_cells::<G, false>(surface, place, band, give, out);
            }
        }
    }
    // What cuts divided off follows behind the cells.
    let woven = 2 * across * (cells.rows - 1);
    (woven..surface.triangles.len()).for_each(|at| add_triangle(surface, at, give, out));
}

#[inline(always)]
fn add_triangle<G: Give>(surface: Surface<'_>, at: usize, give: G, out: &mut [&mut [f32]; 3]) {
    let corners = surface.triangles[at].map(|v| v as usize);
    let areas = surface.areas[at];
    let of = |columns: &Columns| corners.map(|v| columns.at(v).to_array());
    let [gx, gy, gz] = give.give(of(surface.x), of(surface.air), areas[0] + areas[1] + areas[2]);
    for (v, area) in corners.into_iter().zip(areas) {
        let part = give.part(area);
        out[0][v] += gx * part;
        out[1][v] += gy * part;
        out[2][v] += gz * part;
    }
}

/// Eight triangles from anywhere: what they give is found in lanes, and added one by one.
#[inline(always)]
fn add_triangles<G: Give>(surface: Surface<'_>, first: usize, give: G, out: &mut [&mut [f32]; 3]) {
    let zero = Vectors { x: [0.0; LANES], y: [0.0; LANES], z: [0.0; LANES] };
    let (mut xa, mut xb, mut xc) = (zero, zero, zero);
    let (mut ua, mut ub, mut uc) = (zero, zero, zero);
    let mut area = [0.0; LANES];
    for lane in 0..LANES {
        let [a, b, c] = surface.triangles[first + lane].map(|v| v as usize);
        xa.set(lane, surface.x.at(a).to_array());
        xb.set(lane, surface.x.at(b).to_array());
        xc.set(lane, surface.x.at(c).to_array());
        ua.set(lane, surface.air.at(a).to_array());
        ub.set(lane, surface.air.at(b).to_array());
        uc.set(lane, surface.air.at(c).to_array());
        let areas = surface.areas[first + lane];
        area[lane] = areas[0] + areas[1] + areas[2];
    }
    let mut given = zero;
    for lane in 0..LANES {
        let x = [xa.at(lane), xb.at(lane), xc.at(lane)];
        given.set(lane, give.give(x, [ua.at(lane), ub.at(lane), uc.at(lane)], area[lane]));
    }
    for lane in 0..LANES {
        let [gx, gy, gz] = given.at(lane);
        let at = first + lane;
        for (v, area) in surface.triangles[at].into_iter().zip(surface.areas[at]) {
            let part = give.part(area);
            out[0][v as usize] += gx * part;
            out[1][v as usize] += gy * part;
            out[2][v as usize] += gz * part;
        }
    }
}

/// Eight cells next to each other, of which the first ones are done.
#[derive(Clone, Copy)]
struct Place<'a> {
    row: usize,
    first: usize,
    done: usize,
    columns: usize,
    /// Which of them have a corner that has been split off.
    torn: &'a [bool],
}

/// A vector in each lane.
#[derive(Clone, Copy)]
struct Vectors {
    x: Lanes,
    y: Lanes,
    z: Lanes,
}

impl Vectors {
    #[inline(always)]
    fn load(columns: &Columns, first: usize) -> Self {
        let lanes = |column: &[f32]| {
            let mut lanes = [0.0; LANES];
            lanes.copy_from_slice(&column[first..first + LANES]);
            lanes
        };
        Self { x: lanes(&columns.x), y: lanes(&columns.y), z: lanes(&columns.z) }
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, v: V) {
        (self.x[lane], self.y[lane], self.z[lane]) = (v[0], v[1], v[2]);
    }

    #[inline(always)]
    fn at(&self, lane: usize) -> V {
        [self.x[lane], self.y[lane], self.z[lane]]
    }
}

/// `a` where `first` holds, else `b`.
#[inline(always)]
fn pick(first: bool, a: V, b: V) -> V {
    let one = |a: f32, b: f32| if first { a } else { b };
    [one(a[0], b[0]), one(a[1], b[1]), one(a[2], b[2])]
}

/// Eight numbers by the cells' diagonals: one where they fall, another where they rise.
#[inline(always)]
fn alternate(first_falls: bool, falling: f32, rising: f32) -> Lanes {
    let (even, odd) = if first_falls { (falling, rising) } else { (rising, falling) };
    [even, odd, even, odd, even, odd, even, odd]
}

#[inline(always)]
fn add_cells<G: Give, const TORN: bool>(
    surface: Surface<'_>,
    place: Place<'_>,
    band: Band,
    give: G,
    out: &mut [&mut [f32]; 3],
) {
    let top = place.row * place.columns + place.first;
    let bottom = top + place.columns;
    let load = Vectors::load;
    let (tl, tr) = (load(surface.x, top), load(surface.x, top + 1));
    let (bl, br) = (load(surface.x, bottom), load(surface.x, bottom + 1));
    let (utl, utr) = (load(surface.air, top), load(surface.air, top + 1));
    let (ubl, ubr) = (load(surface.air, bottom), load(surface.air, bottom + 1));
    // One area for all: half a triangle's for its right angle, a quarter for the others.
    let areas = surface.areas[0];
    let rest_area = areas[0] + areas[1] + areas[2];
    let first_falls = falls(place.row as u32, place.first as u32);
    let falling = alternate(first_falls, 1.0, 0.0);
    let zero = Vectors { x: [0.0; LANES], y: [0.0; LANES], z: [0.0; LANES] };
    let (mut one, mut two) = (zero, zero);
    for lane in 0..LANES {
        let falls = falling[lane] > 0.0;
        let x = [tl.at(lane), tr.at(lane), bl.at(lane), br.at(lane)];
        let u = [utl.at(lane), utr.at(lane), ubl.at(lane), ubr.at(lane)];
        let given = give.give(
            [x[0], x[2], pick(falls, x[3], x[1])],
            [u[0], u[2], pick(falls, u[3], u[1])],
            rest_area,
        );
        one.set(lane, given);
        let given = give.give(
            [pick(falls, x[0], x[2]), x[3], x[1]],
            [pick(falls, u[0], u[2]), u[3], u[1]],
            rest_area,
        );
        two.set(lane, given);
    }
    let (quarter, half) = (give.part(areas[0]), give.part(2.0 * areas[0]));
    // Which part of the first and of the second triangle a corner gets. The right corners go first:
    // to them the cell on their left gives before the one on their right. Torn cells give in between.
    let before = band.first * place.columns;
    let corners = [
        (top + 1, [0.0, half], [quarter, quarter]),
        (bottom + 1, [quarter, quarter], [0.0, half]),
        (top, [quarter, quarter], [half, 0.0]),
        (bottom, [half, 0.0], [quarter, quarter]),
    ];
    for (number, (first, falling, rising)) in corners.into_iter().enumerate() {
        if TORN && number == 2 {
            for lane in (place.done..LANES).filter(|lane| place.torn[*lane]) {
                let at = 2 * (place.row * (place.columns - 1) + place.first + lane);
                add_triangle(surface, at, give, out);
                add_triangle(surface, at + 1, give, out);
            }
        }
        let row = place.row + usize::from(first >= bottom);
        if row < band.first || row >= band.end {
            continue;
        }
        let first = first - before;
        let mut of_one = alternate(first_falls, falling[0], rising[0]);
        let mut of_two = alternate(first_falls, falling[1], rising[1]);
        for lane in 0..LANES {
            let counts = lane >= place.done && !(TORN && place.torn[lane]);
            of_one[lane] = if counts { of_one[lane] } else { 0.0 };
            of_two[lane] = if counts { of_two[lane] } else { 0.0 };
        }
        add(out[0], first, (&one.x, &of_one), (&two.x, &of_two));
        add(out[1], first, (&one.y, &of_one), (&two.y, &of_two));
        add(out[2], first, (&one.z, &of_one), (&two.z, &of_two));
    }
}

#[inline(always)]
fn add(column: &mut [f32], first: usize, one: (&Lanes, &Lanes), two: (&Lanes, &Lanes)) {
    let column = &mut column[first..first + LANES];
    for lane in 0..LANES {
        let with_one = column[lane] + one.0[lane] * one.1[lane];
        column[lane] = with_one + two.0[lane] * two.1[lane];
    }
}
