//! The vector that a triangle contributes to its corners, and its evaluation for eight triangles.
//!
//! ```text
//! out_v = Σ over corners (t, k) at vertex v of  share(t, k) · contribution(t)
//! share = rest area of corner k [m²] if WEIGHTED_BY_AREA, else 1
//! ```
//! Reads positions and one more attribute per particle (the relative wind, or texture coordinates);
//! writes nothing, callers add the result.
//! Invariant: a lane has the bits of the scalar evaluation of its triangle.

use crate::math::columns::Columns;
use crate::math::simd::{LANES, LaneArray, Simd};
use crate::model::grid_cells::GridCells;

/// A vector in each lane.
pub(crate) type LaneVector<S> = [<S as Simd>::F; 3];

/// The contribution of a triangle to a sum.
pub(crate) trait TriangleContribution: Copy {
    /// Whether it depends on the second attribute.
    const USES_ATTRIBUTE: bool = true;

    /// Whether a corner gets the contribution times its share of the rest area, rather than all of
    /// it.
    const WEIGHTED_BY_AREA: bool;

    /// Evaluates the contribution from the positions [m] and attributes of the corners and the rest
    /// area [m²].
    fn evaluate<S: Simd>(
        self,
        s: S,
        x: [LaneVector<S>; 3],
        attribute: [LaneVector<S>; 3],
        rest_area: S::F,
    ) -> LaneVector<S>;
}

/// The factor for a corner with this share of the rest area [m²].
#[inline(always)]
pub(crate) fn corner_share(area: f32, is_weighted_by_area: bool) -> f32 {
    if is_weighted_by_area { area } else { 1.0 }
}

/// The triangles and particles that a sum reads.
#[derive(Clone, Copy)]
pub(crate) struct SumInput<'a> {
    pub triangles: &'a [[u32; 3]],
    /// The share of its triangle's rest area that belongs to each corner [m²].
    pub areas: &'a [[f32; 3]],
    /// The cells of a grid, which are the first triangles; none for other meshes.
    pub cells: Option<&'a GridCells>,
    /// Positions [m].
    pub x: &'a Columns,
    /// The second attribute of each particle; any columns of that length if it is not used.
    pub attribute: &'a Columns,
}

/// The rows of a grid's particles that one thread adds to.
#[derive(Clone, Copy)]
pub(crate) struct RowBand {
    pub first: usize,
    pub end: usize,
}

impl RowBand {
    /// All rows; also the band of a mesh that is not a grid.
    pub const ALL: Self = Self { first: 0, end: usize::MAX };
}

/// The rest areas of up to eight triangles, given by index [m²].
pub(crate) fn rest_areas_of(input: SumInput<'_>, triangles: &[u32]) -> LaneArray {
    let mut rest_areas = [0.0; LANES];
    for (rest, at) in rest_areas.iter_mut().zip(triangles) {
        let [a, b, c] = input.areas[*at as usize];
        *rest = a + b + c;
    }
    rest_areas
}

/// Evaluates the contributions of up to eight triangles, given by their corners and rest areas.
///
/// Not inlined in wasm, which has one instruction set: two callers share it.
#[cfg_attr(target_arch = "wasm32", inline(never))]
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(crate) fn evaluate_gathered<S: Simd, C: TriangleContribution>(
    s: S,
    input: SumInput<'_>,
    triangles: &[[u32; 3]],
    rest_areas: &LaneArray,
    contribution: C,
) -> [LaneArray; 3] {
    let x = gather_corners(input.x, triangles);
    let attribute = if C::USES_ATTRIBUTE { gather_corners(input.attribute, triangles) } else { x };
    let mut result = [[0.0; LANES]; 3];
    for first in (0..LANES).step_by(S::LANES) {
        let (x, attribute) = (load_corners(s, &x, first), load_corners(s, &attribute, first));
        let vector = contribution.evaluate(s, x, attribute, s.load(rest_areas, first));
        for axis in 0..3 {
            s.store(&mut result[axis], first, vector[axis]);
        }
    }
    result
}

/// Gathers the vectors at the corners of up to eight triangles; the last one fills unused lanes.
///
/// Never inlined: it is long, and the same for all instruction sets.
#[inline(never)]
fn gather_corners(of: &Columns, triangles: &[[u32; 3]]) -> [[LaneArray; 3]; 3] {
    // Equal lengths let the compiler drop all bounds checks but one.
    let count = of.x.len();
    let of = [&of.x[..count], &of.y[..count], &of.z[..count]];
    let mut gathered = [[[0.0; LANES]; 3]; 3];
    for corner in 0..3 {
        for lane in 0..LANES {
            let v = triangles[lane.min(triangles.len() - 1)][corner] as usize;
            for axis in 0..3 {
                gathered[corner][axis][lane] = of[axis][v];
            }
        }
    }
    gathered
}

#[inline(always)]
fn load_corners<S: Simd>(s: S, of: &[[LaneArray; 3]; 3], first: usize) -> [LaneVector<S>; 3] {
    let mut corners = [[s.splat(0.0); 3]; 3];
    for corner in 0..3 {
        for axis in 0..3 {
            corners[corner][axis] = s.load(&of[corner][axis], first);
        }
    }
    corners
}
