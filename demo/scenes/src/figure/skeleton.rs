//! Skeleton of the figure: fifteen bones, their rest positions, and the pose of all of them.
//!
//! Method: every bone has a rigid transform from the rest pose to the present one; vertices blend
//! the transforms of two bones (linear blend skinning).
//!
//! Reads rest positions; writes nothing.
//!
//! Invariant: in the rest pose the figure stands on y = 0, faces +z, has its left side at +x, and
//! arms and legs hang straight down.

use glam::{Quat, Vec3};

/// A bone of the figure. Of the limbs, `0` is the left one and `1` the right one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bone {
    /// Hips, up to the waist.
    Pelvis,
    /// Trunk above the waist.
    Chest,
    /// Neck and head.
    Head,
    /// Upper leg.
    Thigh(usize),
    /// Lower leg.
    Shin(usize),
    /// Foot.
    Foot(usize),
    /// Toes.
    Toes(usize),
    /// Upper arm.
    UpperArm(usize),
    /// Lower arm and hand.
    Forearm(usize),
}

/// Number of bones.
const BONES: usize = 15;

/// Sign of x on the left and on the right side.
pub const SIDES: [f32; 2] = [1.0, -1.0];
/// Length of an upper leg, and of a lower leg [m].
pub const LEG_BONE: f32 = 0.41;
/// Height of the ankle above the sole [m].
pub const ANKLE: f32 = 0.08;
/// Distance of the hip joints from the middle [m].
const HIP: f32 = 0.088;
/// Distance of the shoulder joints from the middle [m].
pub const SHOULDER: f32 = 0.165;

impl Bone {
    fn index(self) -> usize {
        match self {
            Self::Pelvis => 0,
            Self::Chest => 1,
            Self::Head => 2,
            Self::Thigh(side) => 3 + side,
            Self::Shin(side) => 5 + side,
            Self::Foot(side) => 7 + side,
            Self::Toes(side) => 9 + side,
            Self::UpperArm(side) => 11 + side,
            Self::Forearm(side) => 13 + side,
        }
    }

    /// Returns the position of the joint at which the bone begins, in the rest pose [m].
    pub fn joint(self) -> Vec3 {
        let at = |side: usize, x: f32, y: f32| Vec3::new(SIDES[side] * x, y, 0.0);
        match self {
            Self::Pelvis => Vec3::new(0.0, 0.93, 0.0),
            Self::Chest => Vec3::new(0.0, 1.11, 0.0),
            Self::Head => Vec3::new(0.0, 1.47, -0.01),
            Self::Thigh(side) => at(side, HIP, ANKLE + 2.0 * LEG_BONE),
            Self::Shin(side) => at(side, HIP, ANKLE + LEG_BONE),
            Self::Foot(side) => at(side, HIP, ANKLE),
            Self::Toes(side) => at(side, HIP, 0.012).with_z(0.105),
            Self::UpperArm(side) => at(side, SHOULDER, 1.385),
            Self::Forearm(side) => at(side, SHOULDER, 1.105),
        }
    }
}

/// The pose of a bone: the position of its joint, and its rotation from the rest pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BonePose {
    /// Position of the joint [m].
    pub position: Vec3,
    /// Rotation from the rest pose.
    pub rotation: Quat,
}

/// The poses of all bones.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose([BonePose; BONES]);

impl Default for Pose {
    /// Returns a pose with every bone at the origin; set all of them.
    fn default() -> Self {
        Self([BonePose { position: Vec3::ZERO, rotation: Quat::IDENTITY }; BONES])
    }
}

impl Pose {
    /// Sets the pose of a bone.
    pub fn set(&mut self, bone: Bone, position: Vec3, rotation: Quat) {
        self.0[bone.index()] = BonePose { position, rotation };
    }

    /// Returns the pose of a bone.
    pub fn bone(&self, bone: Bone) -> BonePose {
        self.0[bone.index()]
    }

    /// Returns where a bone carries a point of the rest pose [m].
    pub fn carry(&self, bone: Bone, point: Vec3) -> Vec3 {
        let pose = self.bone(bone);
        pose.position + pose.rotation * (point - bone.joint())
    }
}
