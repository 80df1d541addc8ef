//! Sums over triangles: what each gives to its corners, for wind and for normals alike.
//!
//! Every corner is added to in the order of the triangles. On a grid eight cells go at once (see `cells`);
//! the additions come in that order still, so the bits are the same. So they do where several threads each
//! add to rows of their own: the cells between two of them are looked at by both, and each adds its half.

use crate::math::columns::Columns;
use crate::math::simd::{LANES, LaneArray, Scalar, Simd};
use crate::math::threads::Threads;
use crate::model::grid_cells::GridCells;
use crate::solver::vertex_sums::grid_cells;
use core::ops::Range;

/// A vector in each lane.
pub(crate) type V<S> = [<S as Simd>::F; 3];

/// What a triangle gives.
pub(crate) trait Give: Copy {
    /// Whether it depends on the air.
    const FEELS_AIR: bool = true;

    /// Whether a corner takes its part of the area at rest of what is given, rather than all of it.
    const BY_AREA: bool;

    /// From its corners' positions and the air's velocities against them, and its area at rest.
    fn give<S: Simd>(self, s: S, x: [V<S>; 3], air: [V<S>; 3], rest_area: S::F) -> V<S>;

    /// A corner's part of it, where so much of the area at rest is the corner's.
    #[inline(always)]
    fn part(area: f32) -> f32 {
        part(area, Self::BY_AREA)
    }
}

/// See `Give::part`.
#[inline(always)]
pub(crate) fn part(area: f32, by_area: bool) -> f32 {
    if by_area { area } else { 1.0 }
}

/// What is summed over.
#[derive(Clone, Copy)]
pub(crate) struct Surface<'a> {
    pub triangles: &'a [[u32; 3]],
    /// Of each triangle's area at rest what falls to each corner [m²].
    pub areas: &'a [[f32; 3]],
    pub cells: Option<&'a GridCells>,
    pub x: &'a Columns,
    pub air: &'a Columns,
}

/// Rows of a grid's particles that are added to, from `first` on.
#[derive(Clone, Copy)]
pub(crate) struct Band {
    pub first: usize,
    pub end: usize,
}

impl Band {
    /// All that there is, on a grid or not.
    const ALL: Self = Self { first: 0, end: usize::MAX };
}

/// GridCells that one thread sums up at least.
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
        let GridCells { columns, rows, .. } = *cells;
        let parts = threads.parts(columns * rows, CELLS).min(rows);
        if parts > 1 && columns > LANES && surface.x.x.len() == columns * rows {
            let row = |part: usize| rows * part / parts;
            let add = |part: usize, out: [&mut [f32]; 3]| {
                sum(Band { first: row(part), end: row(part + 1) }, out);
            };
            return threads.parallel_for_parts(
                parts,
                out.all_mut(),
                |part| columns * row(part),
                add,
            );
        }
    }
    let _ = (threads, surface);
    sum(Band::ALL, out.all_mut());
}

/// Adds what every triangle gives to particles that have nothing yet.
#[inline(always)]
pub(crate) fn sum<S: Simd, G: Give>(
    s: S,
    surface: Surface<'_>,
    give: G,
    band: Band,
    mut out: [&mut [f32]; 3],
) {
    let (out, count) = (&mut out, surface.triangles.len());
    let fits = |cells: &&GridCells| (LANES + 1..=grid_cells::MOST_ACROSS).contains(&cells.columns);
    let mut first = 0;
    if let Some(cells) = surface.cells.filter(fits) {
        grid_cells::sum(s, surface, cells, give, band, out);
        // What cuts divided off follows behind the cells.
        first = 2 * (cells.columns - 1) * (cells.rows - 1);
    }
    for first in (first..count).step_by(LANES) {
        add_triangles(s, surface, first..(first + LANES).min(count), give, out);
    }
}

/// The same number by number.
pub(crate) fn sum_apart<G: Give>(surface: Surface<'_>, give: G, band: Band, out: [&mut [f32]; 3]) {
    sum(Scalar, surface, give, band, out);
}

/// Up to eight triangles: what they give is found in lanes, and added one by one.
#[inline(always)]
fn add_triangles<S: Simd, G: Give>(
    s: S,
    surface: Surface<'_>,
    own: Range<usize>,
    give: G,
    out: &mut [&mut [f32]; 3],
) {
    let (corners, areas) = (&surface.triangles[own.clone()], &surface.areas[own]);
    let mut rest_areas = [0.0; LANES];
    rest_areas.iter_mut().zip(areas).for_each(|(rest, [a, b, c])| *rest = a + b + c);
    let given = given_by(s, surface, corners, &rest_areas, give);
    add_apart(&given, corners, areas, G::BY_AREA, out);
}

/// Adds what up to eight triangles give to their corners, one by one.
#[inline(never)]
fn add_apart(
    given: &[LaneArray; 3],
    corners: &[[u32; 3]],
    areas: &[[f32; 3]],
    by_area: bool,
    out: &mut [&mut [f32]; 3],
) {
    for (lane, (corners, areas)) in corners.iter().zip(areas).enumerate() {
        for (v, area) in corners.iter().zip(areas) {
            let part = part(*area, by_area);
            for axis in 0..3 {
                out[axis][*v as usize] += given[axis][lane % LANES] * part;
            }
        }
    }
}

/// The areas at rest of up to eight triangles [m²].
pub(crate) fn rest_areas_of(surface: Surface<'_>, triangles: &[u32]) -> LaneArray {
    let mut rest_areas = [0.0; LANES];
    for (rest, at) in rest_areas.iter_mut().zip(triangles) {
        let [a, b, c] = surface.areas[*at as usize];
        *rest = a + b + c;
    }
    rest_areas
}

/// What up to eight triangles from anywhere give, of which there are the corners and the areas at rest.
#[inline(always)]
pub(crate) fn given_by<S: Simd, G: Give>(
    s: S,
    surface: Surface<'_>,
    triangles: &[[u32; 3]],
    rest_areas: &LaneArray,
    give: G,
) -> [LaneArray; 3] {
    let x = gather(surface.x, triangles);
    let air = if G::FEELS_AIR { gather(surface.air, triangles) } else { x };
    let mut given = [[0.0; LANES]; 3];
    for first in (0..LANES).step_by(S::LANES) {
        let (x, air) = (corners(s, &x, first), corners(s, &air, first));
        let some = give.give(s, x, air, s.load(rest_areas, first));
        for axis in 0..3 {
            s.store(&mut given[axis], first, some[axis]);
        }
    }
    given
}

/// What is known of the corners of up to eight triangles. Once for all kernels: it is long and the same at
/// every level.
#[inline(never)]
fn gather(of: &Columns, triangles: &[[u32; 3]]) -> [[LaneArray; 3]; 3] {
    // All as long as each other, so that one check does for all.
    let count = of.x.len();
    let of = [&of.x[..count], &of.y[..count], &of.z[..count]];
    let mut found = [[[0.0; LANES]; 3]; 3];
    for corner in 0..3 {
        for lane in 0..LANES {
            // Where there are fewer, the last one fills up.
            let v = triangles[lane.min(triangles.len() - 1)][corner] as usize;
            for axis in 0..3 {
                found[corner][axis][lane] = of[axis][v];
            }
        }
    }
    found
}

#[inline(always)]
fn corners<S: Simd>(s: S, of: &[[LaneArray; 3]; 3], first: usize) -> [V<S>; 3] {
    let mut corners = [[s.splat(0.0); 3]; 3];
    for corner in 0..3 {
        for axis in 0..3 {
            corners[corner][axis] = s.load(&of[corner][axis], first);
        }
    }
    corners
}
