//! Cloths come and go, and what they are made of changes.

use crate::boundary::{self, Out, Report, guard};
use crate::log::{self, MUSLIN_LOG_INFO};
use crate::registry::{self, with_cloth};
use crate::status::{MuslinStatus, Result};
use crate::types::grid::MuslinGridDesc;
use crate::types::material::{MuslinMaterial, preset as preset_of};
use crate::types::mesh::MuslinMeshDesc;
use crate::types::settings::MuslinSettings;
use crate::types::value::MuslinCloth;
use crate::types::wind::MuslinWind;
use muslin_core::{Cloth, Material};

/// Makes a cloth through `make`, writes its handle, and tells the log.
pub fn create(
    out_cloth: Result<Out<MuslinCloth>>,
    make: impl FnOnce() -> Result<Cloth>,
) -> MuslinStatus {
    let mut made = None;
    let status = guard(|| {
        let out_cloth = out_cloth?;
        let cloth = make()?;
        let (particles, bytes) = (cloth.particle_count(), cloth.stats().bytes);
        let handle = registry::insert(cloth)?;
        out_cloth.write(handle);
        made = Some((handle, particles, bytes));
        Ok(())
    });
    if let Some((handle, particles, bytes)) = made {
        log::tell(MUSLIN_LOG_INFO, || {
            format!("cloth {:#x} is made: {particles} particles, {bytes} bytes", handle.id)
        });
    }
    status
}

/// Makes a cloth from a regular grid. Destroy it with muslin_cloth_destroy.
///
/// @return MUSLIN_STATUS_BAD_VALUE names the field of `desc` that cannot be, and the rule;
/// MUSLIN_STATUS_UNSUPPORTED what this version does not do yet
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_create_grid(
    desc: *const MuslinGridDesc,
    out_cloth: *mut MuslinCloth,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out_cloth = unsafe { Out::new("out_cloth", out_cloth) };
    create(out_cloth, || {
        // SAFETY: the caller's promise above.
        let desc = unsafe { boundary::read_nested("desc", desc)? };
        Ok(Cloth::grid(&desc.try_into()?)?)
    })
}

/// Makes a cloth from any triangle mesh; its lists are copied. What cannot be cloth in it is repaired, see
/// muslin_cloth_get_mesh_report. Destroy it with muslin_cloth_destroy.
///
/// @return MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX names the field of `desc` that cannot be,
/// and the rule; MUSLIN_STATUS_BAD_MESH what is beyond repair: a triangle whose area is not finite, or that none
/// has an area; MUSLIN_STATUS_UNSUPPORTED what this version does not do yet
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_create_mesh(
    desc: *const MuslinMeshDesc,
    out_cloth: *mut MuslinCloth,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out_cloth = unsafe { Out::new("out_cloth", out_cloth) };
    create(out_cloth, || {
        // SAFETY: the caller's promise above, for the lists too.
        let desc = unsafe { boundary::read_nested("desc", desc)?.read()? };
        Ok(Cloth::mesh(&desc)?)
    })
}

/// Destroys a cloth: its handle is stale from then on, and what was borrowed from it is gone.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_destroy(cloth: MuslinCloth) -> MuslinStatus {
    registry::destroy(cloth)
}

/// Back to the start: rest shape, untorn, at rest, pinned as it was made, at time zero, no grabs and no
/// events. Settings, material, wind and colliders stay as they are.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_reset(cloth: MuslinCloth) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        cloth.reset();
        Ok(())
    })
}

/// Fills in the figures of a fabric: MUSLIN_PRESET_SILK, MUSLIN_PRESET_COTTON, MUSLIN_PRESET_DENIM,
/// MUSLIN_PRESET_LEATHER, MUSLIN_PRESET_PAPER or MUSLIN_PRESET_FLAG_NYLON. `material` has begun with
/// muslin_material_init, or is part of a descriptor that has begun.
///
/// @return MUSLIN_STATUS_BAD_VALUE for any other `preset`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_material_preset(
    material: *mut MuslinMaterial,
    preset: u32,
) -> MuslinStatus {
    guard(|| {
        // SAFETY: the caller's promise above.
        let out = unsafe { Report::new("material", material)? };
        out.write(&(&Material::preset(preset_of(preset)?)).into());
        Ok(())
    })
}

/// How time runs. `out_settings` has begun with muslin_settings_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_settings(
    cloth: MuslinCloth,
    out_settings: *mut MuslinSettings,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out = unsafe { Report::new("out_settings", out_settings) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.settings().into());
        Ok(())
    })
}

/// Changes how time runs, from the next tick on. Velocities stay as they are.
///
/// @return MUSLIN_STATUS_BAD_VALUE names the field and the rule; MUSLIN_STATUS_UNSUPPORTED what this
/// version does not do yet
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_settings(
    cloth: MuslinCloth,
    settings: *const MuslinSettings,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let settings = unsafe { boundary::read("settings", settings) };
    with_cloth(cloth, |cloth| Ok(cloth.set_settings(settings?.try_into()?)?))
}

/// What it is made of. `out_material` has begun with muslin_material_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_material(
    cloth: MuslinCloth,
    out_material: *mut MuslinMaterial,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out = unsafe { Report::new("out_material", out_material) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.material().into());
        Ok(())
    })
}

/// Changes what it is made of, from the next tick on. Velocities stay as they are.
///
/// @return MUSLIN_STATUS_BAD_VALUE names the field and the rule
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_material(
    cloth: MuslinCloth,
    material: *const MuslinMaterial,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let material = unsafe { boundary::read("material", material) };
    with_cloth(cloth, |cloth| Ok(cloth.set_material(material?.into())?))
}

/// Changes the air around it, from the next tick on.
///
/// @return MUSLIN_STATUS_BAD_VALUE names the field and the rule
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_wind(
    cloth: MuslinCloth,
    wind: *const MuslinWind,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let wind = unsafe { boundary::read("wind", wind) };
    with_cloth(cloth, |cloth| Ok(cloth.set_wind(wind?.try_into()?)?))
}
