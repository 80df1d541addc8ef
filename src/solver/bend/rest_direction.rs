//! Which way the elements of a grid are bent where they are bent at rest.

use crate::math::columns::Columns;
use crate::math::simd::{Level, leveled};
use crate::math::{TINY, max, min};
use crate::model::plate_elements::{PerKind, PlateElements};

/// From this share of its curvature at rest on an element is bent the way that it is, …
const IS_BENT: f32 = 0.25;
/// … wholly so from so much more on.
const BENDS_OVER: f32 = 0.5;

/// The unit normals of a grid: square to the ways from neighbour to neighbour, along and across.
pub(crate) fn compute_normals(
    level: Level,
    plates: &PlateElements,
    x: &Columns,
    normal: &mut Columns,
) {
    let (columns, rows) = (plates.columns, plates.rows);
    for row in 0..rows {
        let (above, below) = (row.saturating_sub(1), (row + 1).min(rows - 1));
        let of = |row: usize| x.all().map(|x| &x[row * columns..(row + 1) * columns]);
        let out = normal.all_mut().map(|n| &mut n[row * columns..(row + 1) * columns]);
        find_row(level, out, [of(above), of(row), of(below)]);
    }
}

leveled! {
    /// The normals of a row, from it, the one above and the one below.
    fn find_row(normal: [&mut [f32]; 3], rows: [[&[f32]; 3]; 3]) = find_row_lanes
}

#[inline(always)]
fn find_row_lanes(normal: [&mut [f32]; 3], [above, row, below]: [[&[f32]; 3]; 3]) {
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
        [nx[i], ny[i], nz[i]] = square(down, across);
    }
    for (i, left, right) in [(0, 0, last.min(1)), (last, last.max(1) - 1, last)] {
        let down = [bx[i] - ax[i], by[i] - ay[i], bz[i] - az[i]];
        let across = [x[right] - x[left], y[right] - y[left], z[right] - z[left]];
        [nx[i], ny[i], nz[i]] = square(down, across);
    }
}

/// What is square to both, of length 1; naught if nothing is.
#[inline(always)]
fn square([ax, ay, az]: [f32; 3], [bx, by, bz]: [f32; 3]) -> [f32; 3] {
    let (x, y, z) = (ay * bz - by * az, az * bx - bz * ax, ax * by - bx * ay);
    let length = (x * x + y * y + z * z).sqrt();
    let share = if length > TINY { 1.0 / length } else { 0.0 };
    [x * share, y * share, z * share]
}

/// The way that each element of a grid is bent if it is bent at rest: along the normal while it is about flat, along
/// its own curvature when it is folded, whichever way that has turned. So a fold pushes along what it shows, and turns
/// neither itself nor the sheet.
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
        let x = &x.all()[axis][..count];
        curve(level, &mut weft.all_mut()[axis][1..count - 1], x, 1);
        curve(level, &mut warp.all_mut()[axis][columns..count - columns], x, columns);
        twist(level, &mut cell.all_mut()[axis][..count - columns - 1], x, columns);
    }
    for (way, offset) in [weft, warp, cell].into_iter().zip(offset) {
        turn(level, way.all_mut(), offset, normal.all());
    }
}

leveled! {
    /// What elements are curved by, along ways of so many particles.
    fn curve(out: &mut [f32], x: &[f32], step: usize) = curve_lanes
}

#[inline(always)]
fn curve_lanes(out: &mut [f32], x: &[f32], step: usize) {
    for ((out, middle), (a, b)) in out.iter_mut().zip(&x[step..]).zip(x.iter().zip(&x[2 * step..]))
    {
        *out = (a + b) - middle * 2.0;
    }
}

leveled! {
    /// What cells are twisted by.
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
    /// Makes ways of what elements are curved by; naught where they are flat at rest.
    fn turn(way: [&mut [f32]; 3], rest: &[f32], normal: [&[f32]; 3]) = turn_lanes
}

#[inline(always)]
fn turn_lanes([x, y, z]: [&mut [f32]; 3], rest: &[f32], [nx, ny, nz]: [&[f32]; 3]) {
    let count = rest.len();
    let (x, y, z) = (&mut x[..count], &mut y[..count], &mut z[..count]);
    let (nx, ny, nz) = (&nx[..count], &ny[..count], &nz[..count]);
    for i in 0..count {
        let ([cx, cy, cz], [nx, ny, nz]) = ([x[i], y[i], z[i]], [nx[i], ny[i], nz[i]]);
        let over = 1.0 / rest[i];
        let folded = ((cx * nx + cy * ny + cz * nz) * over - IS_BENT) / BENDS_OVER;
        let share = max(min(folded, 1.0), 0.0);
        let own = if over > 0.0 { 1.0 } else { -1.0 } / (cx * cx + cy * cy + cz * cz).sqrt();
        let wx = nx + (cx * own - nx) * share;
        let wy = ny + (cy * own - ny) * share;
        let wz = nz + (cz * own - nz) * share;
        let unit = 1.0 / max((wx * wx + wy * wy + wz * wz).sqrt(), TINY);
        let (is_flat, is_turned) = (rest[i] == 0.0, share > 0.0);
        let turned = [wx * unit, wy * unit, wz * unit];
        let way = if is_turned { turned } else { [nx, ny, nz] };
        [x[i], y[i], z[i]] = if is_flat { [0.0; 3] } else { way };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn rows_have_the_normals_of_their_surroundings() {
        let (columns, rows) = (7, 5);
        let place = |i: usize| {
            let (column, row) = ((i % columns) as f32, (i / columns) as f32);
            Vec3::new(column, -row, 0.1 * column * row - 0.05 * row * row)
        };
        let (mut x, mut normal) = (Columns::default(), Columns::zeros(columns * rows));
        x.set_all((0..columns * rows).map(place));
        let level = Level::best();
        for row in 0..rows {
            let of = |row: usize| x.all().map(|x| &x[row * columns..(row + 1) * columns]);
            let out = normal.all_mut().map(|n| &mut n[row * columns..(row + 1) * columns]);
            find_row(level, out, [of(row.max(1) - 1), of(row), of((row + 1).min(rows - 1))]);
            for column in 0..columns {
                let (left, right) = (column.max(1) - 1, (column + 1).min(columns - 1));
                let across = x.at(row * columns + right) - x.at(row * columns + left);
                let (above, below) = (row.max(1) - 1, (row + 1).min(rows - 1));
                let down = x.at(below * columns + column) - x.at(above * columns + column);
                let n = down.cross(across).normalize();
                assert!(n.distance(normal.at(row * columns + column)) < 1.0e-6);
            }
        }
    }

    #[test]
    fn a_way_leads_from_the_normal_to_what_an_element_shows() {
        // Flat at rest; curved much less than at rest; as much as that, each way; not at all.
        let rest = [0.0, 0.1, 0.1, -0.1, 0.1];
        let curve = [
            Vec3::X,
            Vec3::Z * 0.01,
            Vec3::new(0.03, 0.0, 0.1),
            Vec3::new(0.03, 0.0, -0.1),
            Vec3::ZERO,
        ];
        let (mut way, mut normal) = (Columns::default(), Columns::default());
        way.set_all(curve.into_iter());
        normal.set_all([Vec3::Z; 5].into_iter());
        turn(Level::best(), way.all_mut(), &rest, normal.all());
        assert_eq!(way.at(0), Vec3::ZERO);
        assert_eq!(way.at(1), Vec3::Z);
        assert!(way.at(2).distance(curve[2].normalize()) < 1.0e-6);
        assert!(way.at(3).distance(-curve[3].normalize()) < 1.0e-6);
        assert_eq!(way.at(4), Vec3::Z);
    }
}
