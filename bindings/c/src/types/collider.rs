//! What a cloth falls on.

use super::value::{MuslinQuat, MuslinVec3};
use crate::status::{Refusal, Result};
use muslin_core::{ColliderDesc, Shape};

/// All that is below `position` along the turned y axis.
pub const MUSLIN_SHAPE_PLANE: u32 = 0;

/// A collider: its shape, where it is and how it feels. Begin with muslin_collider_desc_init: a floor
/// at height 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinColliderDesc {
    /// Set by muslin_collider_desc_init.
    pub struct_size: u32,
    /// What it is: MUSLIN_SHAPE_PLANE. Nothing else is supported yet.
    pub shape: u32,
    /// Where it is [m]; 0, 0, 0. A point of the surface of a plane.
    pub position: MuslinVec3,
    /// How it is turned; not at all. A plane's normal is the turned y axis.
    pub rotation: MuslinQuat,
    /// Coulomb coefficient; -1, which takes the material's. Else at least 0.
    pub friction: f32,
    /// Share of the normal speed that a bounce gives back; -1, which takes the material's. Else from
    /// 0 to 1.
    pub restitution: f32,
    /// Share of the sliding speed that every substep of touching leaves, beside Coulomb friction; 1,
    /// all of it. From 0 to 1.
    pub tangential_restitution: f32,
}

impl Default for MuslinColliderDesc {
    fn default() -> Self {
        let desc = ColliderDesc::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            shape: desc.shape as u32,
            position: desc.position.into(),
            rotation: desc.rotation.into(),
            friction: desc.friction,
            restitution: desc.restitution,
            tangential_restitution: desc.tangential_restitution,
        }
    }
}

impl TryFrom<MuslinColliderDesc> for ColliderDesc {
    type Error = Refusal;

    fn try_from(desc: MuslinColliderDesc) -> Result<Self> {
        Ok(Self {
            shape: Shape::from_number(desc.shape)?,
            position: desc.position.into(),
            rotation: desc.rotation.into(),
            friction: desc.friction,
            restitution: desc.restitution,
            tangential_restitution: desc.tangential_restitution,
        })
    }
}

const _: () = assert!(MUSLIN_SHAPE_PLANE == Shape::Plane as u32);
