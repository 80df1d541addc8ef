//! The library's part of the header's inline `..._init` functions, which pass the struct sizes that
//! the caller's compiler knows.

use crate::ffi::panic_guard::run_guarded;
use crate::ffi::versioned_struct::{init_desc, init_struct};
use crate::status::MuslinStatus;
use crate::types::collider::MuslinColliderDesc;
use crate::types::grid::MuslinGridDesc;
use crate::types::material::MuslinMaterial;
use crate::types::mesh::MuslinMeshDesc;
use crate::types::settings::MuslinSettings;
use crate::types::sewing::MuslinSewDesc;
use crate::types::skin::MuslinSkinDesc;
use crate::types::stream::{MuslinStream, MuslinWriteDesc};
use crate::types::wind::MuslinWind;

/// Called by muslin_settings_init with the sizeof of MuslinSettings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_settings_init_sized(
    settings: *mut MuslinSettings,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    run_guarded(|| unsafe { init_struct("settings", settings, struct_size) })
}

/// Called by muslin_material_init with the sizeof of MuslinMaterial.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_material_init_sized(
    material: *mut MuslinMaterial,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    run_guarded(|| unsafe { init_struct("material", material, struct_size) })
}

/// Called by muslin_wind_init with the sizeof of MuslinWind.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_wind_init_sized(
    wind: *mut MuslinWind,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    run_guarded(|| unsafe { init_struct("wind", wind, struct_size) })
}

/// Called by muslin_collider_desc_init with the sizeof of MuslinColliderDesc.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_collider_desc_init_sized(
    desc: *mut MuslinColliderDesc,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    run_guarded(|| unsafe { init_struct("desc", desc, struct_size) })
}

/// Called by muslin_stream_init with the sizeof of MuslinStream.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_stream_init_sized(
    stream: *mut MuslinStream,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    run_guarded(|| unsafe { init_struct("stream", stream, struct_size) })
}

/// Called by muslin_write_desc_init with the sizeof of MuslinWriteDesc.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_write_desc_init_sized(
    desc: *mut MuslinWriteDesc,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    run_guarded(|| unsafe { init_struct("desc", desc, struct_size) })
}

/// Called by muslin_sew_desc_init with the sizeof of MuslinSewDesc.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_sew_desc_init_sized(
    desc: *mut MuslinSewDesc,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    run_guarded(|| unsafe { init_struct("desc", desc, struct_size) })
}

/// Called by muslin_skin_desc_init with the sizeof of MuslinSkinDesc.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_skin_desc_init_sized(
    desc: *mut MuslinSkinDesc,
    struct_size: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    run_guarded(|| unsafe { init_struct("desc", desc, struct_size) })
}

/// Called by muslin_grid_desc_init with the sizeof of MuslinGridDesc, MuslinMaterial and
/// MuslinSettings, all of the same header.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_grid_desc_init_sized(
    desc: *mut MuslinGridDesc,
    struct_size: u32,
    material_size: u32,
    settings_size: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    run_guarded(|| unsafe { init_desc("desc", desc, struct_size, material_size, settings_size) })
}

/// Called by muslin_mesh_desc_init with the sizeof of MuslinMeshDesc, MuslinMaterial and
/// MuslinSettings, all of the same header.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_mesh_desc_init_sized(
    desc: *mut MuslinMeshDesc,
    struct_size: u32,
    material_size: u32,
    settings_size: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    run_guarded(|| unsafe { init_desc("desc", desc, struct_size, material_size, settings_size) })
}
