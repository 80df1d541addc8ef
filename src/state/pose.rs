//! Rigid pose: position and rotation of a collider, an attachment or a reference body.
//!
//! Quaternion products are written out in scalar operations, so that every platform computes the
//! same bits.

use crate::error::{Result, check, check_finite};
use crate::geometry::transform::Transform;
use crate::math::{saturate, trig};
use glam::{DVec3, Quat, Vec3};
use serde::{Deserialize, Serialize};

/// Position [m] and unit rotation. The default is the origin, not rotated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pose {
    pub position: Vec3,
    pub rotation: Quat,
}

/// Smallest angle between two quaternions that needs slerp [rad]; below, nlerp differs from it by
/// less than rounding.
const MIN_SLERP_ANGLE: f64 = 1.0e-3;

/// Field names of a collider's pose for error messages.
pub(crate) const COLLIDER_FIELDS: [&str; 2] = ["collider.position", "collider.rotation"];

/// Refuses a pose that is not finite or whose rotation is not a unit quaternion (to 1 %). `names`
/// are the field names of position and rotation.
pub(crate) fn check_pose(position: Vec3, rotation: Quat, names: [&'static str; 2]) -> Result<()> {
    check_finite(position, names[0])?;
    let length = rotation.length_squared();
    let is_unit = rotation.is_finite() && (length - 1.0).abs() < 1.0e-2;
    check(is_unit, names[1], "be a unit quaternion")
}

impl Pose {
    /// The identity: at the origin, not rotated.
    pub const ORIGIN: Self = Self { position: Vec3::ZERO, rotation: Quat::IDENTITY };

    /// Creates a pose and normalises the rotation, which must be near unit length.
    pub fn new(position: Vec3, rotation: Quat) -> Self {
        let [x, y, z, w] = rotation.to_array();
        let scale = 1.0 / (x * x + y * y + z * z + w * w).sqrt();
        Self { position, rotation: Quat::from_xyzw(x * scale, y * scale, z * scale, w * scale) }
    }

    /// Returns the pose moved by `shift` [m].
    pub fn translated(self, shift: Vec3) -> Self {
        Self { position: self.position + shift, ..self }
    }

    /// Adds a vector of the local frame [m] to `position`, in f64.
    pub fn offset(&self, position: DVec3, local: Vec3) -> Vec3 {
        if local == Vec3::ZERO {
            return position.as_vec3();
        }
        let [x, y, z] = self.to_transform().axes.map(Vec3::as_dvec3);
        let [a, b, c] = local.to_array().map(f64::from);
        (position + x * a + y * b + z * c).as_vec3()
    }

    /// Rotates `v`, with the formula v + 2 w (a × v) + 2 a × (a × v) for a quaternion (a, w).
    fn rotate(&self, v: Vec3) -> Vec3 {
        let [x, y, z, w] = self.rotation.to_array();
        let axis = Vec3::new(x, y, z);
        let twice = axis.cross(v) * 2.0;
        v + twice * w + axis.cross(twice)
    }

    /// Interpolates towards `next`: the position linearly, the rotation by normalised linear
    /// interpolation (nlerp). `t` is 0 to 1.
    pub fn interpolate(&self, next: &Self, t: f32) -> Self {
        let (from, to) = (self.rotation.to_array(), next.rotation.to_array());
        let dot: f32 = (0..4).map(|i| from[i] * to[i]).sum();
        let sign = if dot < 0.0 { -1.0 } else { 1.0 };
        let blend = |i: usize| from[i] + (to[i] * sign - from[i]) * t;
        Self::new(
            self.position + (next.position - self.position) * t,
            Quat::from_xyzw(blend(0), blend(1), blend(2), blend(3)),
        )
    }

    /// The pose after `substep` of `count` equal steps towards `next`: exactly `self` at 0, exactly
    /// `next` at `count`.
    pub fn at_substep(&self, next: &Self, substep: u32, count: u32) -> Self {
        match substep {
            0 => *self,
            end if end == count => *next,
            _ => self.interpolate(next, substep as f32 / count as f32),
        }
    }

    /// The pose after the first of `count` equal steps towards `end`: the position moves linearly,
    /// the rotation at constant angular velocity (spherical linear interpolation, slerp; Shoemake,
    /// SIGGRAPH 1985). Exactly `end` if `count` is 1 or the poses are equal.
    pub fn first_step(&self, end: &Self, count: u32) -> Self {
        if count == 1 || self == end {
            return *end;
        }
        let share = 1.0 / count as f32;
        let position = saturate(self.position + (end.position - self.position) * share);
        Self { position, rotation: self.slerp(end, share) }
    }

    /// Rotation at `t` (0 to 1) of the way to that of `end`, by slerp. Exactly the rotation if both
    /// are equal.
    fn slerp(&self, end: &Self, t: f32) -> Quat {
        if self.rotation == end.rotation {
            return end.rotation;
        }
        let (from, to) = (self.rotation.to_array(), end.rotation.to_array());
        let dot: f32 = (0..4).map(|i| from[i] * to[i]).sum();
        let to = if dot < 0.0 { to.map(|v| -v) } else { to };
        let chord2: f32 = (0..4).map(|i| (to[i] - from[i]) * (to[i] - from[i])).sum();
        let angle = 2.0 * f64::from(trig::asin(0.5 * chord2.sqrt()));
        if angle < MIN_SLERP_ANGLE {
            return self.interpolate(end, t).rotation;
        }
        let t = f64::from(t);
        let (a, b) = (trig::sin((1.0 - t) * angle), trig::sin(t * angle));
        let blend = |i: usize| from[i] * a + to[i] * b;
        // `new` divides by the length, sin(angle).
        let blended = Quat::from_xyzw(blend(0), blend(1), blend(2), blend(3));
        Self::new(Vec3::ZERO, blended).rotation
    }

    /// The pose after moving rigidly with a body that goes from pose `from` to pose `to`.
    pub fn moved_with(&self, from: &Self, to: &Self) -> Self {
        let position =
            to.to_transform().point_to_world(from.to_transform().point_to_local(self.position));
        let [x, y, z, w] = from.rotation.to_array();
        let turn = quat_product(to.rotation, Quat::from_xyzw(-x, -y, -z, w));
        Self::new(position, quat_product(turn, self.rotation))
    }

    /// Converts to a transform with axes, for use on many points.
    ///
    /// `#[inline(never)]`: many cold callers would contain it.
    #[inline(never)]
    pub fn to_transform(self) -> Transform {
        Transform {
            origin: self.position,
            axes: [Vec3::X, Vec3::Y, Vec3::Z].map(|v| self.rotate(v)),
        }
    }
}

/// Quaternion product: rotates by `b`, then by `a`.
fn quat_product(a: Quat, b: Quat) -> Quat {
    let ([ax, ay, az, aw], [bx, by, bz, bw]) = (a.to_array(), b.to_array());
    Quat::from_xyzw(
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_steps_divide_a_motion_into_equal_parts_and_end_exactly() {
        // About a half turn the quaternions are nearly perpendicular.
        for degrees in [0.01_f32, 1.0, 30.0, 120.0, 179.0] {
            let start = Pose::new(Vec3::new(1.0, 2.0, 3.0), Quat::from_rotation_y(0.4));
            let turn = Quat::from_rotation_x(degrees.to_radians());
            let end = Pose::new(Vec3::new(2.0, 0.0, -1.0), turn * start.rotation);
            let mut now = start;
            for count in (1..=5).rev() {
                let next = now.first_step(&end, count);
                let angle = now.rotation.angle_between(next.rotation).to_degrees();
                assert!((angle - degrees / 5.0).abs() < 0.02 + degrees * 1.0e-4, "{angle}°");
                let step = next.position - now.position;
                assert!(step.distance((end.position - start.position) / 5.0) < 1.0e-6);
                now = next;
            }
            assert_eq!(now, end);
        }
    }

    #[test]
    fn first_steps_take_the_shorter_way_and_keep_poses_at_rest() {
        let start = Pose::new(Vec3::ONE, Quat::from_rotation_z(0.7));
        assert_eq!(start.first_step(&start, 3), start);
        let end = Pose::new(Vec3::ONE, -Quat::from_rotation_z(1.0));
        let third = start.first_step(&end, 3).rotation;
        let right = Quat::from_rotation_z(0.8);
        assert!(third.dot(right).abs() > 1.0 - 1.0e-6, "{third}");
        let moved = Pose { position: Vec3::ZERO, ..start };
        assert_eq!(
            start.first_step(&moved, 3).rotation,
            start.rotation,
            "no rounding of rotations"
        );
        let far = Pose { position: Vec3::splat(f32::MAX), ..start };
        let start = Pose { position: Vec3::splat(-f32::MAX), ..start };
        assert!(start.first_step(&far, 3).position.is_finite());
    }
}
