//! The other half of the header's inline `..._init` functions: they pass the sizes that the caller's
//! compiler knew.

use crate::ffi::panic_guard::run_guarded;
use crate::ffi::versioned_struct::{init_desc, init_struct};
use crate::status::MuslinStatus;
use crate::types::collider::MuslinColliderDesc;
use crate::types::grid::MuslinGridDesc;
use crate::types::material::MuslinMaterial;
use crate::types::mesh::MuslinMeshDesc;
use crate::types::settings::MuslinSettings;
use crate::types::stream::{MuslinStream, MuslinWriteDesc};
use crate::types::wind::MuslinWind;

/// What muslin_settings_init calls: pass the sizeof of MuslinSettings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_settings_init_sized(
    settings: *mut MuslinSettings,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    run_guarded(|| unsafe { init_struct("settings", settings, struct_size) })
}

/// What muslin_material_init calls: pass the sizeof of MuslinMaterial.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_material_init_sized(
    material: *mut MuslinMaterial,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    run_guarded(|| unsafe { init_struct("material", material, struct_size) })
}

/// What muslin_wind_init calls: pass the sizeof of MuslinWind.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_wind_init_sized(
    wind: *mut MuslinWind,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    run_guarded(|| unsafe { init_struct("wind", wind, struct_size) })
}

/// What muslin_collider_desc_init calls: pass the sizeof of MuslinColliderDesc.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_collider_desc_init_sized(
    desc: *mut MuslinColliderDesc,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    run_guarded(|| unsafe { init_struct("desc", desc, struct_size) })
}

/// What muslin_stream_init calls: pass the sizeof of MuslinStream.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_stream_init_sized(
    stream: *mut MuslinStream,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    run_guarded(|| unsafe { init_struct("stream", stream, struct_size) })
}

/// What muslin_write_desc_init calls: pass the sizeof of MuslinWriteDesc.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_write_desc_init_sized(
    desc: *mut MuslinWriteDesc,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    run_guarded(|| unsafe { init_struct("desc", desc, struct_size) })
}

/// What muslin_grid_desc_init calls: pass the sizeof of MuslinGridDesc, MuslinMaterial and
/// MuslinSettings, all of the same header.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_grid_desc_init_sized(
    desc: *mut MuslinGridDesc,
    struct_size: u32,
    material_size: u32,
    settings_size: u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    run_guarded(|| unsafe { init_desc("desc", desc, struct_size, material_size, settings_size) })
}

/// What muslin_mesh_desc_init calls: pass the sizeof of MuslinMeshDesc, MuslinMaterial and
/// MuslinSettings, all of the same header.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_mesh_desc_init_sized(
    desc: *mut MuslinMeshDesc,
    struct_size: u32,
    material_size: u32,
    settings_size: u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    run_guarded(|| unsafe { init_desc("desc", desc, struct_size, material_size, settings_size) })
}
