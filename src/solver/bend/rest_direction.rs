//! Directions of the rest curvature of folded grid elements.
//!
//! ```text
//! flat      direction = normal of the grid at the particle
//! folded    direction = direction of the element's own curvature, which may have rotated
//! between   linear blend of both, normalised
//! ```
//! Method: a fold acts along the curvature that the element shows, so it exerts no torque on itself
//! or on the sheet. While the element is nearly flat that direction is undefined and the normal
//! replaces it.
//!
//! Reads positions and fold offsets; writes unit normals and unit directions.
//! Invariant: the direction of an element without a fold is zero.

use crate::math::columns::Columns;
use crate::math::simd::{Level, leveled};
use crate::math::{TINY, max, min};
use crate::model::plate_elements::{PerKind, PlateElements};

/// Ratio of curvature to rest curvature at which the blend from the normal to the direction of the
/// curvature starts.
const BLEND_START: f32 = 0.25;
/// Width of the blend, in the same ratio; beyond it only the direction of the curvature counts.
const BLEND_WIDTH: f32 = 0.5;

/// Computes the unit normal at each particle of a grid: the cross product of the differences of its
/// neighbours down and across.
pub(crate) fn compute_normals(
    level: Level,
    plates: &PlateElements,
    x: &Columns,
    normal: &mut Columns,
) {
    let (columns, rows) = (plates.columns, plates.rows);
    for row in 0..rows {
        let (above, below) = (row.saturating_sub(1), (row + 1).min(rows - 1));
        let of = |row: usize| x.slices().map(|x| &x[row * columns..(row + 1) * columns]);
        let out = normal.slices_mut().map(|n| &mut n[row * columns..(row + 1) * columns]);
        compute_row_normals(level, out, [of(above), of(row), of(below)]);
    }
}

leveled! {
    /// Computes the normals of a row from this row, the one above and the one below.
    fn compute_row_normals(normal: [&mut [f32]; 3], rows: [[&[f32]; 3]; 3])
        = compute_row_normals_lanes
}

#[inline(always)]
fn compute_row_normals_lanes(normal: [&mut [f32]; 3], [above, row, below]: [[&[f32]; 3]; 3]) {
    let ([nx, ny, nz], [x, y, z]) = (normal, row);
    let ([ax, ay, az], [bx, by, bz]) = (above, below);
    let count = x.len();
    let (nx, ny, nz) = (&mut nx[..count], &mut ny[..count], &mut nz[..count]);
    let (y, z) = (&y[..count], &z[..count]);
    let (ax, ay, az) = (&ax[..count], &ay[..count], &az[..count]);
    let (bx, by, bz) = (&bx[..count], &by[..count], &bz[..count]);
    let last = count - 1;
    for i in 1..last {
        let down = [bx[i] - ax[i], by[i] - ay[i], bz[i] - az[i]];
        let across = [x[i + 1] - x[i - 1], y[i + 1] - y[i - 1], z[i + 1] - z[i - 1]];
        [nx[i], ny[i], nz[i]] = unit_normal(down, across);
    }
    for (i, left, right) in [(0, 0, last.min(1)), (last, last.max(1) - 1, last)] {
        let down = [bx[i] - ax[i], by[i] - ay[i], bz[i] - az[i]];
        let across = [x[right] - x[left], y[right] - y[left], z[right] - z[left]];
        [nx[i], ny[i], nz[i]] = unit_normal(down, across);
    }
}

/// Unit vector normal to both; zero if they are parallel.
#[inline(always)]
fn unit_normal([ax, ay, az]: [f32; 3], [bx, by, bz]: [f32; 3]) -> [f32; 3] {
    let (x, y, z) = (ay * bz - by * az, az * bx - bz * ax, ax * by - bx * ay);
    let length = (x * x + y * y + z * z).sqrt();
    let share = if length > TINY { 1.0 / length } else { 0.0 };
    [x * share, y * share, z * share]
}

/// Computes the direction of the rest curvature of each grid element: weft, warp and twist.
pub(crate) fn compute(
    level: Level,
    plates: &PlateElements,
    offset: &PerKind<Vec<f32>>,
    x: &Columns,
    normal: &Columns,
    [weft, warp, cell]: &mut PerKind<Columns>,
) {
    let (columns, count) = (plates.columns, plates.count());
    for axis in 0..3 {
        let x = &x.slices()[axis][..count];
        second_differences(level, &mut weft.slices_mut()[axis][1..count - 1], x, 1);
        second_differences(
            level,
            &mut warp.slices_mut()[axis][columns..count - columns],
            x,
            columns,
        );
        twist(level, &mut cell.slices_mut()[axis][..count - columns - 1], x, columns);
    }
    for (direction, offset) in [weft, warp, cell].into_iter().zip(offset) {
        select_directions(level, direction.slices_mut(), offset, normal.slices());
    }
}

leveled! {
    /// Second differences a − 2 m + b of particles `step` apart [m].
    fn second_differences(out: &mut [f32], x: &[f32], step: usize) = second_differences_lanes
}

#[inline(always)]
fn second_differences_lanes(out: &mut [f32], x: &[f32], step: usize) {
    for ((out, middle), (a, b)) in out.iter_mut().zip(&x[step..]).zip(x.iter().zip(&x[2 * step..]))
    {
        *out = (a + b) - middle * 2.0;
    }
}

leveled! {
    /// Twist a − b − c + d of each cell [m].
    fn twist(out: &mut [f32], x: &[f32], columns: usize) = twist_lanes
}

#[inline(always)]
fn twist_lanes(out: &mut [f32], x: &[f32], columns: usize) {
    let corners = x.iter().zip(&x[1..]).zip(x[columns..].iter().zip(&x[columns + 1..]));
    for (out, ((a, b), (c, d))) in out.iter_mut().zip(corners) {
        *out = (a - b) - (c - d);
    }
}

leveled! {
    /// Replaces curvatures by their directions; zero for elements that are flat at rest.
    fn select_directions(direction: [&mut [f32]; 3], rest: &[f32], normal: [&[f32]; 3])
        = select_directions_lanes
}

#[inline(always)]
fn select_directions_lanes([x, y, z]: [&mut [f32]; 3], rest: &[f32], [nx, ny, nz]: [&[f32]; 3]) {
    let count = rest.len();
    let (x, y, z) = (&mut x[..count], &mut y[..count], &mut z[..count]);
    let (nx, ny, nz) = (&nx[..count], &ny[..count], &nz[..count]);
    for i in 0..count {
        let ([cx, cy, cz], [nx, ny, nz]) = ([x[i], y[i], z[i]], [nx[i], ny[i], nz[i]]);
        let inverse_rest = 1.0 / rest[i];
        let ratio = ((cx * nx + cy * ny + cz * nz) * inverse_rest - BLEND_START) / BLEND_WIDTH;
        let share = max(min(ratio, 1.0), 0.0);
        let own =
            if inverse_rest > 0.0 { 1.0 } else { -1.0 } / (cx * cx + cy * cy + cz * cz).sqrt();
        let wx = nx + (cx * own - nx) * share;
        let wy = ny + (cy * own - ny) * share;
        let wz = nz + (cz * own - nz) * share;
        let unit = 1.0 / max((wx * wx + wy * wy + wz * wz).sqrt(), TINY);
        let (is_flat, is_blended) = (rest[i] == 0.0, share > 0.0);
        let blended = [wx * unit, wy * unit, wz * unit];
        let direction = if is_blended { blended } else { [nx, ny, nz] };
        [x[i], y[i], z[i]] = if is_flat { [0.0; 3] } else { direction };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn normals_are_orthogonal_to_the_differences_of_neighbours() {
        let (columns, rows) = (7, 5);
        let place = |i: usize| {
            let (column, row) = ((i % columns) as f32, (i / columns) as f32);
            Vec3::new(column, -row, 0.1 * column * row - 0.05 * row * row)
        };
        let (mut x, mut normal) = (Columns::default(), Columns::default());
        normal.resize(columns * rows);
        x.set_all((0..columns * rows).map(place));
        let level = Level::best();
        for row in 0..rows {
            let of = |row: usize| x.slices().map(|x| &x[row * columns..(row + 1) * columns]);
            let out = normal.slices_mut().map(|n| &mut n[row * columns..(row + 1) * columns]);
            compute_row_normals(
                level,
                out,
                [of(row.max(1) - 1), of(row), of((row + 1).min(rows - 1))],
            );
            for column in 0..columns {
                let (left, right) = (column.max(1) - 1, (column + 1).min(columns - 1));
                let across = x.get(row * columns + right) - x.get(row * columns + left);
                let (above, below) = (row.max(1) - 1, (row + 1).min(rows - 1));
                let down = x.get(below * columns + column) - x.get(above * columns + column);
                let n = down.cross(across).normalize();
                assert!(n.distance(normal.get(row * columns + column)) < 1.0e-6);
            }
        }
    }

    #[test]
    fn the_direction_blends_from_the_normal_to_the_own_curvature() {
        // Flat at rest; curved less than at rest; as much, to each side; not curved.
        let rest = [0.0, 0.1, 0.1, -0.1, 0.1];
        let second_differences = [
            Vec3::X,
            Vec3::Z * 0.01,
            Vec3::new(0.03, 0.0, 0.1),
            Vec3::new(0.03, 0.0, -0.1),
            Vec3::ZERO,
        ];
        let (mut direction, mut normal) = (Columns::default(), Columns::default());
        direction.set_all(second_differences.into_iter());
        normal.set_all([Vec3::Z; 5].into_iter());
        select_directions(Level::best(), direction.slices_mut(), &rest, normal.slices());
        assert_eq!(direction.get(0), Vec3::ZERO);
        assert_eq!(direction.get(1), Vec3::Z);
        assert!(direction.get(2).distance(second_differences[2].normalize()) < 1.0e-6);
        assert!(direction.get(3).distance(-second_differences[3].normalize()) < 1.0e-6);
        assert_eq!(direction.get(4), Vec3::Z);
    }
}
