//! Conversions between the vectors, poses and transforms of Godot and of Muslin.
//!
//! Both are right-handed, with y up, in metres.

use godot::builtin::{Basis, Transform3D, Vector3};
use muslin::glam::{Affine3, Mat3, Quat, Vec3};

/// Largest relative difference of lengths, and cosine between axes, that count as rounding.
const ROUNDING: f32 = 1.0e-3;

/// Converts a vector of Godot.
pub fn to_muslin(v: Vector3) -> Vec3 {
    Vec3::new(v.x, v.y, v.z)
}

/// Converts a vector of Muslin.
pub fn to_godot(v: Vec3) -> Vector3 {
    Vector3::new(v.x, v.y, v.z)
}

/// Converts a transform of Godot.
pub fn to_affine(transform: Transform3D) -> Affine3 {
    let columns = columns(transform.basis).map(to_muslin);
    Affine3::from_mat3_translation(
        Mat3::from_cols_array_2d(&columns.map(|c| c.to_array())),
        to_muslin(transform.origin),
    )
}

fn columns(basis: Basis) -> [Vector3; 3] {
    [basis.col_a(), basis.col_b(), basis.col_c()]
}

/// Least scale along an axis that is not zero.
const LEAST_SCALE: f32 = 1.0e-6;

/// A transform as a rigid pose, after what it does to shapes: scale, mirroring, shear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Position [m].
    pub position: Vec3,
    /// Rotation.
    pub rotation: Quat,
    /// The linear map that comes before the rotation, by columns.
    pub linear: [Vec3; 3],
}

impl Placement {
    /// Splits a transform; `None` if it is not finite or flattens space.
    pub fn new(transform: Transform3D) -> Option<Self> {
        let basis = transform.basis;
        let lengths = columns(basis).map(|axis| axis.length());
        let volume: f32 = lengths.iter().product();
        let is_flat = basis.determinant().abs() < LEAST_SCALE * volume;
        if !transform.is_finite() || is_flat || lengths.iter().any(|l| *l < LEAST_SCALE) {
            return None;
        }
        let right = basis.orthonormalized();
        let rigid = if right.determinant() < 0.0 { right * -1.0 } else { right };
        let q = rigid.get_quaternion().normalized();
        let linear = columns(rigid.transposed() * basis).map(to_muslin);
        let rotation = Quat::from_xyzw(q.x, q.y, q.z, q.w).normalize();
        Some(Self { position: to_muslin(transform.origin), rotation, linear })
    }

    /// Returns the position and the rotation.
    pub fn pose(&self) -> (Vec3, Quat) {
        (self.position, self.rotation)
    }

    /// Maps a point of the shape to the rigid frame.
    pub fn map(&self, point: Vec3) -> Vec3 {
        let [x, y, z] = self.linear;
        x * point.x + y * point.y + z * point.z
    }

    /// Returns the factors along the axes; `None` if axes are sheared or swapped.
    pub fn scale(&self) -> Option<Vec3> {
        let [x, y, z] = self.linear;
        let scale = Vec3::new(x.x, y.y, z.z);
        let rest = [x.with_x(0.0), y.with_y(0.0), z.with_z(0.0)];
        let most = scale.abs().max_element() * ROUNDING;
        rest.iter().all(|v| v.length() <= most).then_some(scale.abs())
    }

    /// Returns the one factor along all axes; `None` if there are several.
    pub fn uniform_scale(&self) -> Option<f32> {
        let scale = self.scale()?;
        let (least, most) = (scale.min_element(), scale.max_element());
        (most - least <= most * ROUNDING).then_some(most)
    }

    /// Returns whether the scale, mirroring and shear are those of `other`, up to rounding.
    pub fn has_shape_of(&self, other: &Self) -> bool {
        let most = self.linear.iter().fold(0.0_f32, |most, v| most.max(v.length())) * ROUNDING;
        self.linear.iter().zip(other.linear).all(|(a, b)| (*a - b).length() <= most)
    }
}
