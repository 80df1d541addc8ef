//! Vectors, rotations and handles: structs that pass by value and never grow.

use muslin_core::glam::{Quat, Vec3};

/// A point, a direction or a velocity.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MuslinVec3 {
    /// Along x.
    pub x: f32,
    /// Along y.
    pub y: f32,
    /// Along z.
    pub z: f32,
}

/// A rotation: a unit quaternion; { 0, 0, 0, 1 } turns nothing.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MuslinQuat {
    /// Axis along x times the sine of half the angle.
    pub x: f32,
    /// Axis along y times the sine of half the angle.
    pub y: f32,
    /// Axis along z times the sine of half the angle.
    pub z: f32,
    /// Cosine of half the angle.
    pub w: f32,
}

/// A cloth; { 0 } is none. A destroyed or made-up one is refused as MUSLIN_STATUS_BAD_HANDLE.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MuslinCloth {
    /// Says which; it means nothing to you.
    pub id: u64,
}

/// A hold on one particle of one cloth; { 0 } is none. It is of use with the cloth that gave it, and
/// with those restored from it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MuslinGrab {
    /// Says which; it means nothing to you.
    pub id: u32,
}

/// A collider of one cloth; { 0 } is none. It is of use with the cloth that gave it, and with those
/// restored from it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MuslinCollider {
    /// Says which; it means nothing to you.
    pub id: u32,
}

/// A transform that particles of one cloth are attached to; { 0 } is none. It is of use with the cloth that
/// gave it, and with those restored from it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MuslinAttachment {
    /// Says which; it means nothing to you.
    pub id: u32,
}

impl From<Vec3> for MuslinVec3 {
    fn from(v: Vec3) -> Self {
        Self { x: v.x, y: v.y, z: v.z }
    }
}

impl From<MuslinVec3> for Vec3 {
    fn from(v: MuslinVec3) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl From<Quat> for MuslinQuat {
    fn from(q: Quat) -> Self {
        Self { x: q.x, y: q.y, z: q.z, w: q.w }
    }
}

impl From<MuslinQuat> for Quat {
    fn from(q: MuslinQuat) -> Self {
        Self::from_xyzw(q.x, q.y, q.z, q.w)
    }
}
