//! Colliders: what a cloth falls on.

use crate::arena::Arena;
use crate::error::{Result, check_finite};
use crate::geometry::shape::CollisionShape;
use crate::math::max;
use crate::state::collider_desc::ColliderDesc;
use crate::state::pose::{COLLIDER_FIELDS, Pose, check_pose};
use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

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

/// What a cloth did to a collider in the last tick: divided by the tick's length, the force and the torque
/// for an engine that moves what the cloth lies on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Impulse {
    /// Momentum given [kg m/s].
    pub linear: Vec3,
    /// Angular momentum given, about the collider's position [kg m²/s].
    pub angular: Vec3,
}

/// One collider of a cloth.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct ColliderBody {
    pub desc: ColliderDesc,
    /// Where it was at the end of the last tick.
    pub last: Pose,
    /// Where it is at the end of the next tick.
    pub next: Pose,
    /// What the last tick did to it.
    pub impulse: Impulse,
    /// Its shape, made from the descriptor.
    #[serde(skip)]
    collision_shape: Option<Arc<CollisionShape>>,
}

impl ColliderBody {
    pub fn new(desc: ColliderDesc) -> Result<Self> {
        desc.check()?;
        let pose = Pose::new(desc.position, desc.rotation);
        let collision_shape = Some(Arc::new(desc.collision_shape()?));
        Ok(Self { desc, last: pose, next: pose, impulse: Impulse::default(), collision_shape })
    }

    /// Refuses a body that cannot be, and sees to its shape; for bytes from outside.
    pub fn restore(&mut self) -> Result<()> {
        self.desc.check()?;
        check_finite(self.impulse.linear, "collider.impulse")?;
        check_finite(self.impulse.angular, "collider.impulse")?;
        check_pose(self.last.position, self.last.rotation, COLLIDER_FIELDS)?;
        check_pose(self.next.position, self.next.rotation, COLLIDER_FIELDS)?;
        self.collision_shape = Some(Arc::new(self.desc.collision_shape()?));
        Ok(())
    }

    /// Its shape; nothing before it was revived.
    pub fn collision_shape(&self) -> Option<&CollisionShape> {
        self.collision_shape.as_deref()
    }

    /// How far a point of it is at most from the straight way between where the tick finds it and where it leaves
    /// it, because it turns [m].
    pub fn max_arc_deviation(&self, collision_shape: &CollisionShape) -> f32 {
        let bounds = collision_shape.bounds();
        let farthest = bounds.low.abs().max(bounds.high.abs()).length();
        let dot: f32 = {
            let (from, to) = (self.last.rotation.to_array(), self.next.rotation.to_array());
            (0..4).map(|i| from[i] * to[i]).sum()
        };
        // 1 - cos of half the angle is no more than the square of its sine.
        farthest * max(1.0 - dot * dot, 0.0)
    }

    /// Sends the collider on its way; it arrives at the end of the next tick.
    pub fn move_to(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        check_pose(position, rotation, COLLIDER_FIELDS)?;
        self.next = Pose::new(position, rotation);
        Ok(())
    }

    /// Puts the collider somewhere at once.
    pub fn teleport(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        self.move_to(position, rotation)?;
        self.finish_tick();
        Ok(())
    }

    /// The tick is over: it is where it was to be.
    pub fn finish_tick(&mut self) {
        self.last = self.next;
        self.desc.position = self.next.position;
        self.desc.rotation = self.next.rotation;
    }
}

/// How many colliders a cloth may have.
pub(crate) const MAX_COLLIDERS: u16 = 1024;

/// All colliders of a cloth.
pub(crate) type Colliders = Arena<Box<ColliderBody>>;
