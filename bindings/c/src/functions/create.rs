//! Cloths come and go, and what they are made of changes.

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

/// Makes a cloth through `make`, writes its handle, and tells the log.
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
        let desc = unsafe { read_desc("desc", desc)? };
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
        let desc = unsafe { read_desc("desc", desc)?.read()? };
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
