//! Creating, destroying and resetting cloths.

use crate::ffi::panic_guard::run_guarded;
use crate::ffi::pointers::Out;
use crate::ffi::versioned_struct::read_desc;
use crate::log::{self, MUSLIN_LOG_INFO};
use crate::registry::{self, with_cloth};
use crate::status::{MuslinStatus, Result};
use crate::types::grid::MuslinGridDesc;
use crate::types::mesh::MuslinMeshDesc;
use crate::types::value::MuslinCloth;
use muslin_core::Cloth;

/// Makes a cloth with `make`, writes its handle, and logs it.
pub fn create(
    out_cloth: Result<Out<MuslinCloth>>,
    make: impl FnOnce() -> Result<Cloth>,
) -> MuslinStatus {
    let mut made = None;
    let status = run_guarded(|| {
        let out_cloth = out_cloth?;
        let cloth = make()?;
        let (particles, bytes) = (cloth.particle_count(), cloth.stats().bytes);
        let handle = registry::insert(cloth)?;
        out_cloth.write(handle);
        made = Some((handle, particles, bytes));
        Ok(())
    });
    if let Some((handle, particles, bytes)) = made {
        log::emit(MUSLIN_LOG_INFO, || {
            format!("cloth {:#x} was created: {particles} particles, {bytes} bytes", handle.id)
        });
    }
    status
}

/// Makes a cloth from a regular grid. Destroy it with muslin_cloth_destroy.
///
/// @return MUSLIN_STATUS_BAD_VALUE for an invalid field of `desc`; MUSLIN_STATUS_UNSUPPORTED if
/// `desc` is of a newer version and uses fields that this library does not have
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_create_grid(
    desc: *const MuslinGridDesc,
    out_cloth: *mut MuslinCloth,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_cloth = unsafe { Out::new("out_cloth", out_cloth) };
    create(out_cloth, || {
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let desc = unsafe { read_desc("desc", desc)? };
        Ok(Cloth::grid(&desc.try_into()?)?)
    })
}

/// Makes a cloth from any triangle mesh; its lists are copied. Defects of the mesh are repaired,
/// see muslin_cloth_get_mesh_report. Destroy the cloth with muslin_cloth_destroy.
///
/// @return MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX for an invalid field of `desc`;
/// MUSLIN_STATUS_BAD_MESH if the mesh cannot be repaired: a triangle has an area that is not
/// finite, or no triangle has an area; MUSLIN_STATUS_UNSUPPORTED if `desc` is of a newer version
/// and uses fields that this library does not have
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_create_mesh(
    desc: *const MuslinMeshDesc,
    out_cloth: *mut MuslinCloth,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_cloth = unsafe { Out::new("out_cloth", out_cloth) };
    create(out_cloth, || {
        // SAFETY: by the header's rules, the lists of `desc` are as long as its counts say.
        let desc = unsafe { read_desc("desc", desc)?.read()? };
        Ok(Cloth::mesh(&desc)?)
    })
}

/// Makes an independent copy of a cloth, in the same state. Destroy it with muslin_cloth_destroy.
///
/// Both continue with the same bits as long as they get the same calls. Handles of grabs,
/// attachments and colliders are valid for both; skins stay with `cloth`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_duplicate(
    cloth: MuslinCloth,
    out_cloth: *mut MuslinCloth,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_cloth = unsafe { Out::new("out_cloth", out_cloth) };
    create(out_cloth, || registry::duplicate(cloth))
}

/// Destroys a cloth. Its handle becomes stale; memory borrowed from it must no longer be read.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_destroy(cloth: MuslinCloth) -> MuslinStatus {
    registry::destroy(cloth)
}

/// Restores the initial state: rest shape, no tears or cuts, zero velocities, the pins of the
/// descriptor, time zero, all mass scales 1. Removes all grabs, attachments, anchors, creases and
/// events.
///
/// Settings, material, wind and colliders stay as they are now. Handles of grabs and attachments
/// become stale; handles of colliders stay valid.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_reset(cloth: MuslinCloth) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        cloth.reset();
        Ok(())
    })
}
