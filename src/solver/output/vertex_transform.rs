//! Stage `Outputs`: vertices as a renderer wants them placed, a block of them at a time.

use crate::math::pack::{BLOCK, FloatBlock};
use crate::math::simd::{Level, leveled};
use glam::{Affine3, DMat3, Mat3};

/// A vector of each vertex of a block.
pub(crate) type Vectors = [FloatBlock; 3];

/// How vertices are placed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placing {
    /// How far from the last tick to this one.
    pub share: f32,
    /// Along the normals, as they are written [m].
    pub offset: f32,
    /// To the other side of the surface.
    pub flip: bool,
    /// For positions; none leaves them where they are.
    transform: Option<Affine3>,
    /// For normals and for tangents, so scaled that nothing overflows.
    turn: Option<Turn>,
}

/// How directions are turned.
#[derive(Clone, Copy, Debug)]
struct Turn {
    normals: Mat3,
    tangents: Mat3,
    is_mirror: bool,
}

impl Turn {
    /// None if the matrix cannot be inverted.
    fn of(matrix: Mat3) -> Option<Self> {
        let unit = |m: DMat3| {
            let largest = m.to_cols_array().into_iter().fold(0.0, |most: f64, x| x.abs().max(most));
            (m * (1.0 / largest)).as_mat3()
        };
        let m = matrix.as_dmat3();
        let determinant = m.determinant();
        let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
        // The inverse transpose but for the determinant's size, which keeps normals on their side.
        let turned = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * determinant.signum();
        (determinant != 0.0 && determinant.is_finite()).then(|| Self {
            normals: unit(turned),
            tangents: unit(m),
            is_mirror: determinant < 0.0,
        })
    }
}

impl Placing {
    /// Nothing of what is left alone is computed, so that it keeps its bits.
    pub fn new(share: f32, offset: f32, flip: bool, transform: Affine3) -> Self {
        let is_still = transform == Affine3::IDENTITY;
        let turn =
            if transform.matrix3 == Mat3::IDENTITY { None } else { Turn::of(transform.matrix3) };
        Self { share, offset, flip, transform: (!is_still).then_some(transform), turn }
    }

    /// Whether directions can go with positions: whether the transform can be inverted.
    pub fn can_turn(&self) -> bool {
        self.turn.is_some() || self.transform.is_none_or(|t| t.matrix3 == Mat3::IDENTITY)
    }

    /// Whether positions go along normals.
    pub fn is_offset(&self) -> bool {
        self.offset != 0.0
    }

    /// Positions from where they are at `x`, with the cloth's normals if they are offset.
    pub fn positions(&self, level: Level, x: &mut Vectors, normals: &Vectors) {
        if self.is_offset() {
            let distance = if self.flip { -self.offset } else { self.offset };
            add(level, x, normals, distance);
        }
        if let Some(transform) = &self.transform {
            place(level, x, transform);
        }
    }

    /// Normals from the cloth's.
    pub fn normals(&self, level: Level, normals: &mut Vectors) {
        if self.flip {
            negate(level, normals);
        }
        if let Some(turn) = &self.turn {
            self::turn(level, normals, &turn.normals);
        }
    }

    /// Tangents from their sums and the cloth's normals; `hands` say on which side v grows.
    pub fn tangents(
        &self,
        level: Level,
        sums: &mut Vectors,
        normals: &Vectors,
        hands: &mut FloatBlock,
    ) {
        square(level, sums, normals);
        if let Some(turn) = &self.turn {
            self::turn(level, sums, &turn.tangents);
        }
        if self.flip != self.turn.is_some_and(|turn| turn.is_mirror) {
            hands.iter_mut().for_each(|hand| *hand = -*hand);
        }
    }
}

/// Takes the numbers of a block from columns; what is beyond `count` stays as it is.
pub(crate) fn load(to: &mut [FloatBlock], columns: &[&[f32]], first: usize, count: usize) {
    for (numbers, column) in to.iter_mut().zip(columns) {
        numbers[..count].copy_from_slice(&column[first..first + count]);
    }
}

/// As `load`, from the entries `at`.
pub(crate) fn gather(to: &mut [FloatBlock], columns: &[&[f32]], at: &[u32]) {
    for (numbers, column) in to.iter_mut().zip(columns) {
        for (number, at) in numbers.iter_mut().zip(at) {
            *number = column[*at as usize];
        }
    }
}

leveled! {
    fn add(x: &mut Vectors, along: &Vectors, distance: f32) = add_lanes
}

#[inline(always)]
fn add_lanes(x: &mut Vectors, along: &Vectors, distance: f32) {
    for (x, along) in x.as_flattened_mut().iter_mut().zip(along.as_flattened()) {
        *x += *along * distance;
    }
}

leveled! {
    fn negate(v: &mut Vectors) = negate_lanes
}

#[inline(always)]
fn negate_lanes(v: &mut Vectors) {
    v.as_flattened_mut().iter_mut().for_each(|x| *x = -*x);
}

leveled! {
    fn place(v: &mut Vectors, by: &Affine3) = place_lanes
}

#[inline(always)]
fn place_lanes([x, y, z]: &mut Vectors, by: &Affine3) {
    let [a, b, c] = [by.matrix3.x_axis, by.matrix3.y_axis, by.matrix3.z_axis];
    let t = by.translation;
    for k in 0..BLOCK {
        let (px, py, pz) = (x[k], y[k], z[k]);
        x[k] = a.x * px + b.x * py + c.x * pz + t.x;
        y[k] = a.y * px + b.y * py + c.y * pz + t.y;
        z[k] = a.z * px + b.z * py + c.z * pz + t.z;
    }
}

leveled! {
    fn turn(v: &mut Vectors, by: &Mat3) = turn_lanes
}

#[inline(always)]
fn turn_lanes([x, y, z]: &mut Vectors, by: &Mat3) {
    let [a, b, c] = [by.x_axis, by.y_axis, by.z_axis];
    for k in 0..BLOCK {
        let (px, py, pz) = (x[k], y[k], z[k]);
        let tx = a.x * px + b.x * py + c.x * pz;
        let ty = a.y * px + b.y * py + c.y * pz;
        let tz = a.z * px + b.z * py + c.z * pz;
        let length = (tx * tx + ty * ty + tz * tz).sqrt();
        let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
        (x[k], y[k], z[k]) = (tx * inverse, ty * inverse, tz * inverse);
    }
}

leveled! {
    fn square(t: &mut Vectors, normals: &Vectors) = square_lanes
}

/// Directions square to the normals, at unit length. Where nothing of one is left, the x or z axis stands
/// in, whichever is less along the normal.
#[inline(always)]
fn square_lanes([x, y, z]: &mut Vectors, [nx, ny, nz]: &Vectors) {
    /// Of the square of a direction's length, below which the rest of it is rounding.
    const ROUNDING: f32 = 1.0e-10;
    for k in 0..BLOCK {
        let (nx, ny, nz) = (nx[k], ny[k], nz[k]);
        let (x, y, z) = (&mut x[k], &mut y[k], &mut z[k]);
        let along = *x * nx + *y * ny + *z * nz;
        let (tx, ty, tz) = (*x - nx * along, *y - ny * along, *z - nz * along);
        let (whole, left) = (*x * *x + *y * *y + *z * *z, tx * tx + ty * ty + tz * tz);
        let (ax, az) = if nx * nx < 0.5 { (1.0, 0.0) } else { (0.0, 1.0) };
        let along = ax * nx + az * nz;
        let (ax, ay, az) = (ax - nx * along, -ny * along, az - nz * along);
        let is_known = left > whole * ROUNDING;
        let (tx, ty, tz) = if is_known { (tx, ty, tz) } else { (ax, ay, az) };
        let inverse = 1.0 / (tx * tx + ty * ty + tz * tz).sqrt();
        (*x, *y, *z) = (tx * inverse, ty * inverse, tz * inverse);
    }
}
