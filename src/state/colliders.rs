//! Colliders: what a cloth falls on. A plane for now.

use crate::arena::Arena;
use crate::error::{Error, Result, check, check_finite};
use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};

/// A handle to one collider of one cloth; stale once removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Collider(pub(crate) u32);

impl Collider {
    /// The handle as a number, for a face that speaks in numbers. Never 0.
    pub fn to_bits(self) -> u32 {
        self.0
    }

    /// The handle that [`Collider::to_bits`] gave. A made-up number is refused where it is used.
    pub fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

/// The shapes of colliders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
#[non_exhaustive]
pub enum Shape {
    /// All that is below `position` along the turned y axis.
    #[default]
    Plane = 0,
}

/// A collider: its shape, where it is and how it feels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ColliderDesc {
    /// What it is; a plane.
    pub shape: Shape,
    /// Where it is [m]; the origin. A point of the surface of a plane.
    pub position: Vec3,
    /// How it is turned; not at all. A plane's normal is the turned y axis.
    pub rotation: Quat,
    /// Coulomb coefficient; −1 takes the material's.
    pub friction: f32,
    /// Share of the normal speed that a bounce gives back, 0 to 1; −1 takes the material's.
    pub restitution: f32,
    /// Share of the sliding speed that every substep of touching leaves, beside Coulomb friction;
    /// 1 (all of it). The receipt's floor is 0.8, with `friction` 0 and `restitution` 0.2.
    pub tangential_restitution: f32,
}

impl Default for ColliderDesc {
    fn default() -> Self {
        Self {
            shape: Shape::Plane,
            position: Vec3::ZERO,
            rotation: Quat::IDENTITY,
            friction: -1.0,
            restitution: -1.0,
            tangential_restitution: 1.0,
        }
    }
}

impl ColliderDesc {
    /// Refuses a collider that cannot be.
    pub(crate) fn check(&self) -> Result<()> {
        check_pose(self.position, self.rotation)?;
        check(
            self.friction == -1.0 || (self.friction.is_finite() && self.friction >= 0.0),
            "collider.friction",
            "be at least 0 and finite, or -1",
        )?;
        let share = |v: f32| (0.0..=1.0).contains(&v);
        check(
            self.restitution == -1.0 || share(self.restitution),
            "collider.restitution",
            "be from 0 to 1, or -1",
        )?;
        check(
            share(self.tangential_restitution),
            "collider.tangential_restitution",
            "be from 0 to 1",
        )
    }
}

fn check_pose(position: Vec3, rotation: Quat) -> Result<()> {
    check_finite(position, "collider.position")?;
    let length = rotation.length_squared();
    check(
        rotation.is_finite() && (length - 1.0).abs() < 1.0e-2,
        "collider.rotation",
        "be a unit quaternion",
    )
}

/// Where a collider is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pose {
    pub position: Vec3,
    pub rotation: Quat,
}

impl Pose {
    fn new(position: Vec3, rotation: Quat) -> Self {
        let [x, y, z, w] = rotation.to_array();
        let scale = 1.0 / (x * x + y * y + z * z + w * w).sqrt();
        Self { position, rotation: Quat::from_xyzw(x * scale, y * scale, z * scale, w * scale) }
    }

    /// `v` turned as the collider is. Written out, so that every target computes the same.
    pub fn turn(&self, v: Vec3) -> Vec3 {
        let [x, y, z, w] = self.rotation.to_array();
        let axis = Vec3::new(x, y, z);
        let twice = axis.cross(v) * 2.0;
        v + twice * w + axis.cross(twice)
    }

    /// `v` turned back.
    pub fn turn_back(&self, v: Vec3) -> Vec3 {
        let [x, y, z, w] = self.rotation.to_array();
        Self { position: self.position, rotation: Quat::from_xyzw(-x, -y, -z, w) }.turn(v)
    }

    /// The pose a `share` of the way to `next`.
    pub fn toward(&self, next: &Self, share: f32) -> Self {
        let (from, to) = (self.rotation.to_array(), next.rotation.to_array());
        let dot: f32 = (0..4).map(|i| from[i] * to[i]).sum();
        let sign = if dot < 0.0 { -1.0 } else { 1.0 };
        let blend = |i: usize| from[i] + (to[i] * sign - from[i]) * share;
        Self::new(
            self.position + (next.position - self.position) * share,
            Quat::from_xyzw(blend(0), blend(1), blend(2), blend(3)),
        )
    }
}

/// One collider of a cloth.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Body {
    pub desc: ColliderDesc,
    /// Where it was at the end of the last tick.
    pub last: Pose,
    /// Where it is at the end of the next tick.
    pub next: Pose,
}

impl Body {
    pub fn new(desc: ColliderDesc) -> Result<Self> {
        desc.check()?;
        let pose = Pose::new(desc.position, desc.rotation);
        Ok(Self { desc, last: pose, next: pose })
    }

    /// Refuses a body that cannot be; for bytes from outside.
    pub fn check(&self) -> Result<()> {
        self.desc.check()?;
        check_pose(self.last.position, self.last.rotation)?;
        check_pose(self.next.position, self.next.rotation)
    }

    /// Sends the collider on its way; it arrives at the end of the next tick.
    pub fn move_to(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        check_pose(position, rotation)?;
        self.next = Pose::new(position, rotation);
        Ok(())
    }
}

/// How many colliders a cloth may have.
pub(crate) const MAX_COLLIDERS: u16 = 1024;

/// All colliders of a cloth.
pub(crate) type Colliders = Arena<Body>;

impl Shape {
    /// The shape that a face calls `number`.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a number that names no shape of this version.
    pub fn from_number(number: u32) -> Result<Self> {
        match number {
            0 => Ok(Self::Plane),
            _ => Err(Error::Unsupported { what: "a collider of this shape" }),
        }
    }
}
