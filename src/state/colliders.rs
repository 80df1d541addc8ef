//! Colliders: kinematic bodies that a cloth collides with.
//!
//! A collider moves from its pose at the end of the last tick to the pose that the host has set,
//! evenly over the ticks of an `advance` and their substeps, so that contacts are swept.

use crate::arena::Arena;
use crate::error::{Result, check_finite};
use crate::geometry::collision_shape::CollisionShape;
use crate::math::max;
use crate::state::collider_desc::ColliderDesc;
use crate::state::pose::{COLLIDER_FIELDS, Pose, check_pose};
use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A handle to a collider of one cloth. It becomes stale when the collider is removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Collider(pub(crate) u32);

impl Collider {
    /// Converts the handle to a number, for language bindings. Never 0.
    pub fn to_bits(self) -> u32 {
        self.0
    }

    /// Converts a number from [`Collider::to_bits`] back. Functions that use an unknown handle
    /// return an error.
    pub fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

/// Impulse of the cloth on a collider during the last tick. Divide by the tick length to get the
/// mean force and torque, for coupling with a rigid body engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Impulse {
    /// Linear impulse [kg m/s].
    pub linear: Vec3,
    /// Angular impulse about the position of the collider [kg m²/s].
    pub angular: Vec3,
}

/// One collider of a cloth. Field order is part of the save format.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct ColliderBody {
    pub desc: ColliderDesc,
    /// Pose at the end of the last tick.
    pub last: Pose,
    /// Pose at the end of the next tick.
    pub next: Pose,
    /// Impulse received during the last tick.
    pub impulse: Impulse,
    /// Pose at the end of an `advance`, while its ticks run; see `solver::kinematic::tick_targets`.
    #[serde(skip)]
    pub final_pose: Pose,
    /// Shape built from the descriptor; `None` between reading a save and `restore`.
    #[serde(skip)]
    collision_shape: Option<Arc<CollisionShape>>,
}

impl ColliderBody {
    pub fn new(desc: ColliderDesc) -> Result<Self> {
        desc.check()?;
        let pose = Pose::new(desc.position, desc.rotation);
        let collision_shape = Some(Arc::new(desc.collision_shape()?));
        let impulse = Impulse::default();
        Ok(Self { desc, last: pose, next: pose, impulse, final_pose: pose, collision_shape })
    }

    /// Validates a collider from a save and builds its shape.
    pub fn restore(&mut self) -> Result<()> {
        self.desc.check()?;
        check_finite(self.impulse.linear, "collider.impulse")?;
        check_finite(self.impulse.angular, "collider.impulse")?;
        check_pose(self.last.position, self.last.rotation, COLLIDER_FIELDS)?;
        check_pose(self.next.position, self.next.rotation, COLLIDER_FIELDS)?;
        self.collision_shape = Some(Arc::new(self.desc.collision_shape()?));
        Ok(())
    }

    /// The shape; `None` before `restore`.
    pub fn collision_shape(&self) -> Option<&CollisionShape> {
        self.collision_shape.as_deref()
    }

    /// Upper bound of how far the rotation of a tick takes any point of the collider from the
    /// straight line between its start and its end [m].
    pub fn max_arc_deviation(&self, collision_shape: &CollisionShape) -> f32 {
        let bounds = collision_shape.bounds();
        let farthest = bounds.low.abs().max(bounds.high.abs()).length();
        let dot: f32 = {
            let (from, to) = (self.last.rotation.to_array(), self.next.rotation.to_array());
            (0..4).map(|i| from[i] * to[i]).sum()
        };
        // 1 − cos(θ/2) ≤ sin²(θ/2), where θ is the rotation and `dot` = cos(θ/2).
        farthest * max(1.0 - dot * dot, 0.0)
    }

    /// Sets the pose that the collider reaches at the end of the next tick.
    pub fn move_to(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        check_pose(position, rotation, COLLIDER_FIELDS)?;
        self.next = Pose::new(position, rotation);
        Ok(())
    }

    /// Sets the pose immediately, without motion in between.
    pub fn teleport(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        self.move_to(position, rotation)?;
        self.finish_tick();
        Ok(())
    }

    /// Completes the motion of a tick: the collider has arrived at its next pose.
    pub fn finish_tick(&mut self) {
        self.last = self.next;
        self.desc.position = self.next.position;
        self.desc.rotation = self.next.rotation;
    }
}

/// Maximum number of colliders of a cloth.
pub(crate) const MAX_COLLIDERS: u16 = 1024;

/// All colliders of a cloth.
pub(crate) type Colliders = Arena<Box<ColliderBody>>;
