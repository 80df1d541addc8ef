//! Descriptor of a cloth that is made from a regular grid.

use super::material::MuslinMaterial;
use super::settings::MuslinSettings;
use super::value::MuslinVec3;
use crate::status::{CallError, Result};
use muslin_core::{AS_MANY_AGAIN, GridDesc, PinMode};

/// No particle is pinned: the cloth falls.
pub const MUSLIN_PIN_NONE: u32 = 0;
/// All particles of the first row are pinned.
pub const MUSLIN_PIN_TOP_EDGE: u32 = 1;
/// The two ends of the first row are pinned.
pub const MUSLIN_PIN_TOP_CORNERS: u32 = 2;
/// All four corners are pinned.
pub const MUSLIN_PIN_CORNERS: u32 = 3;

/// Value of `extra_particles` that reserves as many particles again as the cloth starts with.
pub const MUSLIN_AS_MANY_AGAIN: u32 = u32::MAX;

/// A regular grid of particles. The particle at `row` and `column` has the index `row * columns +
/// column`. Initialise it with muslin_grid_desc_init.
///
/// `material` and `settings` have sizes of their own: replace them only by structs that were
/// initialised with muslin_material_init and muslin_settings_init in the same program.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinGridDesc {
    /// Set by muslin_grid_desc_init.
    pub struct_size: u32,
    /// Particles per row. Default 40. At least 2.
    pub columns: u32,
    /// Number of rows. Default 40. At least 2. A grid has at most 4194304 particles.
    pub rows: u32,
    /// Distance between neighbours [m]. Default 0.05. From 1e-6 to 1e6.
    pub spacing: f32,
    /// Position of particle (0, 0), the top left corner [m]. Default 0, 0, 0. Within 2097152 times
    /// `spacing` of zero along each axis.
    pub origin: MuslinVec3,
    /// Unit direction along a row. Default 1, 0, 0.
    pub right: MuslinVec3,
    /// Unit direction along a column, perpendicular to `right`. Default 0, -1, 0.
    pub down: MuslinVec3,
    /// Particles that are pinned from the start: MUSLIN_PIN_NONE, MUSLIN_PIN_TOP_EDGE (default),
    /// MUSLIN_PIN_TOP_CORNERS or MUSLIN_PIN_CORNERS.
    pub pin_mode: u32,
    /// Particles to reserve for tears and cuts. Default MUSLIN_AS_MANY_AGAIN; 0 if the cloth never
    /// tears.
    pub extra_particles: u32,
    /// Material.
    pub material: MuslinMaterial,
    /// Settings.
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
