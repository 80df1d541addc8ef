//! A rigid frame: position and rotation, with the rotation as three axes so that many points can be
//! transformed cheaply.
//!
//! ```text
//! to local:  p = Rᵀ (x − origin)        to world:  x = origin + R p        R = [axes₀ axes₁ axes₂]
//! ```
//! Reads only its own fields and writes nothing.
//! Invariant: the axes are orthonormal, so the transpose is the inverse.

use glam::Vec3;

/// A rigid frame in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Transform {
    /// The origin of the frame [m].
    pub origin: Vec3,
    /// The axes of the frame, of length one.
    pub axes: [Vec3; 3],
}

impl Transform {
    /// Transforms a point from world space to local space [m].
    #[inline(always)]
    pub fn point_to_local(&self, x: Vec3) -> Vec3 {
        let r = x - self.origin;
        Vec3::new(r.dot(self.axes[0]), r.dot(self.axes[1]), r.dot(self.axes[2]))
    }

    /// Rotates a vector from world space to local space.
    #[inline(always)]
    pub fn vector_to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.axes[0]), v.dot(self.axes[1]), v.dot(self.axes[2]))
    }

    /// Transforms a point from local space to world space [m].
    #[inline(always)]
    pub fn point_to_world(&self, p: Vec3) -> Vec3 {
        self.origin + self.vector_to_world(p)
    }

    /// Rotates a vector from local space to world space.
    #[inline(always)]
    pub fn vector_to_world(&self, v: Vec3) -> Vec3 {
        self.axes[0] * v.x + self.axes[1] * v.y + self.axes[2] * v.z
    }
}
