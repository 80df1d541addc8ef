//! A cloth from a regular grid.

use super::material::MuslinMaterial;
use super::settings::MuslinSettings;
use super::value::MuslinVec3;
use crate::status::{CallError, Result};
use muslin_core::{AS_MANY_AGAIN, GridDesc, PinMode};

/// Nothing is pinned: it falls.
pub const MUSLIN_PIN_NONE: u32 = 0;
/// The whole first row is pinned.
pub const MUSLIN_PIN_TOP_EDGE: u32 = 1;
/// The two ends of the first row are pinned.
pub const MUSLIN_PIN_TOP_CORNERS: u32 = 2;
/// All four corners are pinned.
pub const MUSLIN_PIN_CORNERS: u32 = 3;

/// For `extra_particles`: room for as many particles again as the cloth starts with.
pub const MUSLIN_AS_MANY_AGAIN: u32 = u32::MAX;

/// A regular grid of particles; particle = row * columns + column. Begin with muslin_grid_desc_init.
///
/// `material` and `settings` carry sizes of their own: replace them by structs that began with
/// muslin_material_init and muslin_settings_init in the same program.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinGridDesc {
    /// Set by muslin_grid_desc_init.
    pub struct_size: u32,
    /// Particles across; 40. At least 2.
    pub columns: u32,
    /// Particles down; 40. At least 2.
    pub rows: u32,
    /// Distance between neighbours [m]; 0.05. From 1e-6 to 1e6.
    pub spacing: f32,
    /// Where particle (0, 0), the top left, is [m]; 0, 0, 0. Within 2097152 `spacing` of zero along each axis.
    pub origin: MuslinVec3,
    /// Unit direction of a row; 1, 0, 0.
    pub right: MuslinVec3,
    /// Unit direction of a column, square to `right`; 0, -1, 0.
    pub down: MuslinVec3,
    /// What is pinned from the start: MUSLIN_PIN_NONE, MUSLIN_PIN_TOP_EDGE (this at first),
    /// MUSLIN_PIN_TOP_CORNERS or MUSLIN_PIN_CORNERS.
    pub pin_mode: u32,
    /// Particles that tears may add; MUSLIN_AS_MANY_AGAIN.
    pub extra_particles: u32,
    /// What it is made of.
    pub material: MuslinMaterial,
    /// How its time runs.
    pub settings: MuslinSettings,
}

impl Default for MuslinGridDesc {
    fn default() -> Self {
        let desc = GridDesc::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            columns: desc.columns,
            rows: desc.rows,
            spacing: desc.spacing,
            origin: desc.origin.into(),
            right: desc.right.into(),
            down: desc.down.into(),
            pin_mode: desc.pin_mode as u32,
            extra_particles: desc.extra_particles,
            material: MuslinMaterial::default(),
            settings: MuslinSettings::default(),
        }
    }
}

impl TryFrom<MuslinGridDesc> for GridDesc {
    type Error = CallError;

    fn try_from(desc: MuslinGridDesc) -> Result<Self> {
        Ok(Self {
            columns: desc.columns,
            rows: desc.rows,
            spacing: desc.spacing,
            origin: desc.origin.into(),
            right: desc.right.into(),
            down: desc.down.into(),
            pin_mode: pin_mode(desc.pin_mode)?,
            extra_particles: desc.extra_particles,
            material: desc.material.into(),
            settings: desc.settings.try_into()?,
        })
    }
}

const _: () = assert!(MUSLIN_AS_MANY_AGAIN == AS_MANY_AGAIN);

fn pin_mode(number: u32) -> Result<PinMode> {
    match number {
        MUSLIN_PIN_NONE => Ok(PinMode::None),
        MUSLIN_PIN_TOP_EDGE => Ok(PinMode::TopEdge),
        MUSLIN_PIN_TOP_CORNERS => Ok(PinMode::TopCorners),
        MUSLIN_PIN_CORNERS => Ok(PinMode::Corners),
        _ => Err(CallError::bad_value("pin_mode", "be one of MUSLIN_PIN_...")),
    }
}
