//! Stage `Outputs`: transforms vertices for the renderer, one block at a time.
//!
//! ```text
//! position   p' = M (p ± offset · n) + t
//! normal     n' = normalise(cof(M) sign(det M) · n)        tangent   t' = normalise(M · t)
//! ```
//! Method: normals use the cofactor matrix, which is the inverse transpose up to a factor, so that
//! non-uniform scale keeps them normal. Blocks of `BLOCK` vertices stay in the cache and vectorise.
//! They are compiled once, for the vectors that every CPU has: a second copy would be larger.
//!
//! Reads columns of positions, normals and tangent sums; writes blocks (`VertexBlock`).
//! Invariant: an identity transform without offset keeps the bits of its input.

use crate::math::pack::{BLOCK, FloatBlock};
use glam::{Affine3, DMat3, Mat3, Vec3};

/// One vector per vertex of a block, as columns x, y, z.
pub(crate) type VertexBlock = [FloatBlock; 3];

/// Transform of vertices from the cloth to the renderer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VertexTransform {
    /// Blend between the previous tick (0) and the last (1).
    pub share: f32,
    /// Offset along the written normals [m].
    pub offset: f32,
    /// Whether normals point to the other side of the surface.
    pub flip: bool,
    /// Transform of positions; `None` for the identity.
    transform: Option<Affine3>,
    /// Matrices for normals and tangents, scaled so that nothing overflows.
    directions: Option<DirectionMatrices>,
}

/// Matrices that transform directions.
#[derive(Clone, Copy, Debug)]
struct DirectionMatrices {
    normals: Mat3,
    tangents: Mat3,
    is_mirror: bool,
}

impl DirectionMatrices {
    /// Computes the matrices; `None` if `matrix` is singular.
    fn of(matrix: Mat3) -> Option<Self> {
        let unit = |m: DMat3| {
            let largest = m.to_cols_array().into_iter().fold(0.0, |most: f64, x| x.abs().max(most));
            (m * (1.0 / largest)).as_mat3()
        };
        let m = matrix.as_dmat3();
        let determinant = m.determinant();
        let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
        // The inverse transpose times |det|; the sign keeps normals on their side of the surface.
        let cofactor = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * determinant.signum();
        (determinant != 0.0 && determinant.is_finite()).then(|| Self {
            normals: unit(cofactor),
            tangents: unit(m),
            is_mirror: determinant < 0.0,
        })
    }
}

impl VertexTransform {
    /// Skips every step that has no effect, so that its input keeps its bits.
    pub fn new(share: f32, offset: f32, flip: bool, transform: Affine3) -> Self {
        let is_identity = transform == Affine3::IDENTITY;
        let directions = if transform.matrix3 == Mat3::IDENTITY {
            None
        } else {
            DirectionMatrices::of(transform.matrix3)
        };
        Self { share, offset, flip, transform: (!is_identity).then_some(transform), directions }
    }

    /// Whether normals and tangents can be transformed: whether the matrix is invertible.
    pub fn can_transform_directions(&self) -> bool {
        self.directions.is_some() || self.transform.is_none_or(|t| t.matrix3 == Mat3::IDENTITY)
    }

    /// Whether positions are offset along normals.
    pub fn is_offset(&self) -> bool {
        self.offset != 0.0
    }

    /// Transforms positions `x` in place; `normals` are those of the cloth, used for the offset.
    pub fn transform_positions(&self, x: &mut VertexBlock, normals: &VertexBlock) {
        if self.is_offset() {
            let distance = if self.flip { -self.offset } else { self.offset };
            add(x, normals, distance);
        }
        if let Some(transform) = &self.transform {
            transform_points(x, transform);
        }
    }

    /// Transforms normals of the cloth in place.
    pub fn transform_normals(&self, normals: &mut VertexBlock) {
        if self.flip {
            negate(normals);
        }
        if let Some(matrices) = &self.directions {
            transform_directions(normals, &matrices.normals);
        }
    }

    /// Transforms tangent sums to unit tangents in place; `normals` are those of the cloth.
    pub fn transform_tangents(
        &self,
        sums: &mut VertexBlock,
        normals: &VertexBlock,
        handedness: &mut FloatBlock,
    ) {
        orthogonalize(sums, normals);
        if let Some(matrices) = &self.directions {
            transform_directions(sums, &matrices.tangents);
        }
        if self.flip != self.directions.is_some_and(|matrices| matrices.is_mirror) {
            handedness.iter_mut().for_each(|sign| *sign = -*sign);
        }
    }
}

/// Returns the transform that takes positions relative to `origin` to where `transform` takes the
/// absolute ones.
pub(crate) fn from_origin(transform: Affine3, origin: Vec3) -> Affine3 {
    if origin == Vec3::ZERO {
        return transform;
    }
    let at_origin = transform.matrix3.as_dmat3() * origin.as_dvec3();
    let translation = (at_origin + transform.translation.as_dvec3()).as_vec3();
    Affine3 { translation, ..transform }
}

/// Copies `count` entries of each column from `first` on to a block; entries beyond stay.
pub(crate) fn load(to: &mut [FloatBlock], columns: &[&[f32]], first: usize, count: usize) {
    for (numbers, column) in to.iter_mut().zip(columns) {
        numbers[..count].copy_from_slice(&column[first..first + count]);
    }
}

/// Gathers the entries `at` of each column to a block.
pub(crate) fn gather(to: &mut [FloatBlock], columns: &[&[f32]], at: &[u32]) {
    for (numbers, column) in to.iter_mut().zip(columns) {
        for (number, at) in numbers.iter_mut().zip(at) {
            *number = column[*at as usize];
        }
    }
}

#[inline(never)]
fn add(x: &mut VertexBlock, along: &VertexBlock, distance: f32) {
    for (x, along) in x.as_flattened_mut().iter_mut().zip(along.as_flattened()) {
        *x += *along * distance;
    }
}

#[inline(never)]
fn negate(v: &mut VertexBlock) {
    v.as_flattened_mut().iter_mut().for_each(|x| *x = -*x);
}

#[inline(never)]
fn transform_points([x, y, z]: &mut VertexBlock, by: &Affine3) {
    let [a, b, c] = [by.matrix3.x_axis, by.matrix3.y_axis, by.matrix3.z_axis];
    let t = by.translation;
    for k in 0..BLOCK {
        let (px, py, pz) = (x[k], y[k], z[k]);
        x[k] = a.x * px + b.x * py + c.x * pz + t.x;
        y[k] = a.y * px + b.y * py + c.y * pz + t.y;
        z[k] = a.z * px + b.z * py + c.z * pz + t.z;
    }
}

#[inline(never)]
fn transform_directions([x, y, z]: &mut VertexBlock, by: &Mat3) {
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

/// Makes directions orthogonal to the normals and of unit length (Gram–Schmidt). If nothing of a
/// direction remains, the x or z axis replaces it, whichever is less parallel to the normal.
#[inline(never)]
fn orthogonalize([x, y, z]: &mut VertexBlock, [nx, ny, nz]: &VertexBlock) {
    /// Share of the squared length below which the orthogonal part is rounding error.
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
