//! A place and a turn, ready to be used on many points.

use glam::Vec3;

/// Where something is, and where its own axes point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Transform {
    pub origin: Vec3,
    pub axes: [Vec3; 3],
}

impl Transform {
    /// A point of the world as the frame sees it.
    #[inline(always)]
    pub fn inward(&self, x: Vec3) -> Vec3 {
        let r = x - self.origin;
        Vec3::new(r.dot(self.axes[0]), r.dot(self.axes[1]), r.dot(self.axes[2]))
    }

    /// A direction of the world as the frame sees it.
    #[inline(always)]
    pub fn turn_inward(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.axes[0]), v.dot(self.axes[1]), v.dot(self.axes[2]))
    }

    /// A point of the frame as the world sees it.
    #[inline(always)]
    pub fn outward(&self, p: Vec3) -> Vec3 {
        self.origin + self.turn(p)
    }

    /// A direction of the frame as the world sees it.
    #[inline(always)]
    pub fn turn(&self, v: Vec3) -> Vec3 {
        self.axes[0] * v.x + self.axes[1] * v.y + self.axes[2] * v.z
    }
}
