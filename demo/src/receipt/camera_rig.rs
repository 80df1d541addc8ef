//! The camera of the receipt scene: target, distance and angles that its specification gives.
//!
//! Reads nothing and writes nothing; all lengths are in units of the scene.
//!
//! Invariant: the start lies within the limits of the rig.

use glam::Vec3;

use crate::camera::CameraRig;

/// Target of the camera, in units.
pub const TARGET: Vec3 = Vec3::new(0.0, -1.0, 0.0);

/// Returns the specified camera, in units.
pub fn rig() -> CameraRig {
    CameraRig {
        target: TARGET,
        polar: 0.15..=1.56,
        radius: 4.0..=30.0,
        start: [0.26, 1.43, 17.4],
        half_width: 2.9,
        upright: None,
    }
}
