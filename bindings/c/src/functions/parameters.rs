//! Settings, material and wind of a cloth.

use crate::ffi::panic_guard::run_guarded;
use crate::ffi::versioned_struct::{OutStruct, read_struct};
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::material::{MuslinMaterial, preset as preset_of};
use crate::types::settings::MuslinSettings;
use crate::types::value::MuslinCloth;
use crate::types::wind::MuslinWind;
use muslin_core::Material;

/// Sets the values of a fabric: MUSLIN_PRESET_SILK, MUSLIN_PRESET_COTTON, MUSLIN_PRESET_DENIM,
/// MUSLIN_PRESET_LEATHER, MUSLIN_PRESET_PAPER or MUSLIN_PRESET_FLAG_NYLON.
///
/// `material` must be initialised with muslin_material_init, or be part of an initialised
/// descriptor.
///
/// @return MUSLIN_STATUS_BAD_VALUE for any other `preset`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_material_preset(
    material: *mut MuslinMaterial,
    preset: u32,
) -> MuslinStatus {
    run_guarded(|| {
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let out = unsafe { OutStruct::new("material", material)? };
        out.write(&(&Material::preset(preset_of(preset)?)).into());
        Ok(())
    })
}

/// Reads the current settings. Initialise `out_settings` with muslin_settings_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_settings(
    cloth: MuslinCloth,
    out_settings: *mut MuslinSettings,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out = unsafe { OutStruct::new("out_settings", out_settings) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.settings().into());
        Ok(())
    })
}

/// Replaces the settings; they take effect with the next tick. Velocities stay as they are.
///
/// @return MUSLIN_STATUS_BAD_VALUE for an invalid field; MUSLIN_STATUS_UNSUPPORTED if `settings` is
/// of a newer version and uses fields that this library does not have
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_settings(
    cloth: MuslinCloth,
    settings: *const MuslinSettings,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let settings = unsafe { read_struct("settings", settings) };
    with_cloth(cloth, |cloth| Ok(cloth.set_settings(settings?.try_into()?)?))
}

/// Reads the current material. Initialise `out_material` with muslin_material_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_material(
    cloth: MuslinCloth,
    out_material: *mut MuslinMaterial,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out = unsafe { OutStruct::new("out_material", out_material) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.material().into());
        Ok(())
    })
}

/// Replaces the material; it takes effect with the next tick. Velocities stay as they are.
///
/// @return MUSLIN_STATUS_BAD_VALUE for an invalid field; MUSLIN_STATUS_UNSUPPORTED if `material` is
/// of a newer version and uses fields that this library does not have
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_material(
    cloth: MuslinCloth,
    material: *const MuslinMaterial,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let material = unsafe { read_struct("material", material) };
    with_cloth(cloth, |cloth| Ok(cloth.set_material(material?.into())?))
}

/// Replaces the wind; it takes effect with the next tick.
///
/// @return MUSLIN_STATUS_BAD_VALUE for an invalid field; MUSLIN_STATUS_UNSUPPORTED if `wind` is of
/// a newer version and uses fields that this library does not have
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_wind(
    cloth: MuslinCloth,
    wind: *const MuslinWind,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let wind = unsafe { read_struct("wind", wind) };
    with_cloth(cloth, |cloth| Ok(cloth.set_wind(wind?.try_into()?)?))
}
