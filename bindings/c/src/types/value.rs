//! Vectors, rotations and handles: structs that are passed by value and never grow.

use muslin_core::glam::{Quat, Vec3};

/// A point, direction or velocity.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MuslinVec3 {
    /// x component.
    pub x: f32,
    /// y component.
    pub y: f32,
    /// z component.
    pub z: f32,
}

/// A rotation as a unit quaternion. { 0, 0, 0, 1 } is no rotation.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MuslinQuat {
    /// Axis x times the sine of half the angle.
    pub x: f32,
    /// Axis y times the sine of half the angle.
    pub y: f32,
    /// Axis z times the sine of half the angle.
    pub z: f32,
    /// Cosine of half the angle.
    pub w: f32,
}

/// Handle of a cloth. { 0 } is none. A stale or made-up handle gives MUSLIN_STATUS_BAD_HANDLE.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MuslinCloth {
    /// Identifies the cloth; opaque.
    pub id: u64,
}

/// Handle of a grab of one particle. { 0 } is none. Valid for the cloth that returned it and for
/// cloths restored from it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MuslinGrab {
    /// Identifies the grab; opaque.
    pub id: u32,
}

/// Handle of a collider. { 0 } is none. Valid for the cloth that returned it and for cloths
/// restored from it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MuslinCollider {
    /// Identifies the collider; opaque.
    pub id: u32,
}

/// Handle of an attachment: a transform that carries particles. { 0 } is none. Valid for the cloth
/// that returned it and for cloths restored from it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MuslinAttachment {
    /// Identifies the attachment; opaque.
    pub id: u32,
}

/// Handle of a skin. { 0 } is none. Stale once the skin or its cloth is destroyed.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MuslinSkin {
    /// Identifies the skin; opaque.
    pub id: u64,
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
