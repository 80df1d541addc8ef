//! X

use crate::ffi::panic_guard::run_guarded;
use crate::ffi::versioned_struct::{OutStruct, read_struct};
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::material::{MuslinMaterial, preset as preset_of};
use crate::types::settings::MuslinSettings;
use crate::types::value::MuslinCloth;
use crate::types::wind::MuslinWind;
use muslin_core::Material;

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
    run_guarded(|| {
        // SAFETY: the caller's promise above.
        let out = unsafe { OutStruct::new("material", material)? };
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
    let out = unsafe { OutStruct::new("out_settings", out_settings) };
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
    let settings = unsafe { read_struct("settings", settings) };
    with_cloth(cloth, |cloth| Ok(cloth.set_settings(settings?.try_into()?)?))
}

/// What it is made of. `out_material` has begun with muslin_material_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_material(
    cloth: MuslinCloth,
    out_material: *mut MuslinMaterial,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out = unsafe { OutStruct::new("out_material", out_material) };
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
    let material = unsafe { read_struct("material", material) };
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
    let wind = unsafe { read_struct("wind", wind) };
    with_cloth(cloth, |cloth| Ok(cloth.set_wind(wind?.try_into()?)?))
}
