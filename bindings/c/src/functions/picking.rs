//! Pointing at a cloth, and taking hold of it.

use crate::ffi::pointers::Out;
use crate::ffi::versioned_struct::OutStruct;
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus};
use crate::types::hit::MuslinHit;
use crate::types::value::{MuslinCloth, MuslinGrab, MuslinVec3};
use muslin_core::Grab;

fn nothing_hit() -> CallError {
    CallError::new(MuslinStatus::NothingHit, "the ray meets nothing")
}

/// The first triangle along a ray, within `max_distance` [m] (which may be infinite), hit from either
/// side. `direction` need not have length one. `out_hit` has begun with muslin_hit_init.
///
/// @return MUSLIN_STATUS_NOTHING_HIT if there is none; MUSLIN_STATUS_BAD_VALUE unless `origin` and
/// `direction` are finite, `direction` is not zero, and `max_distance` is at least 0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_raycast(
    cloth: MuslinCloth,
    origin: MuslinVec3,
    direction: MuslinVec3,
    max_distance: f32,
    out_hit: *mut MuslinHit,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out = unsafe { OutStruct::new("out_hit", out_hit) };
    with_cloth(cloth, |cloth| {
        let out = out?;
        let hit = cloth.raycast(origin.into(), direction.into(), max_distance)?;
        out.write(&hit.ok_or_else(nothing_hit)?.into());
        Ok(())
    })
}

/// Takes hold of the particle that a ray points at: the nearest one of the triangle that it hits, or
/// else the nearest one within `radius` [m] of it. `out_at` (may be NULL) gets where that particle is
/// [m].
///
/// @return MUSLIN_STATUS_NOTHING_HIT if there is none; MUSLIN_STATUS_BAD_VALUE unless `origin` and
/// `direction` are finite, `direction` is not zero, and `radius` is at least 0 and finite;
/// MUSLIN_STATUS_FULL if 64 grabs are held already
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_grab_ray(
    cloth: MuslinCloth,
    origin: MuslinVec3,
    direction: MuslinVec3,
    radius: f32,
    out_grab: *mut MuslinGrab,
    out_at: *mut MuslinVec3,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let (out_grab, out_at) = unsafe { (Out::new("out_grab", out_grab), Out::new_optional(out_at)) };
    with_cloth(cloth, |cloth| {
        let out_grab = out_grab?;
        let held = cloth.grab_ray(origin.into(), direction.into(), radius)?;
        let (grab, at) = held.ok_or_else(nothing_hit)?;
        out_grab.write(MuslinGrab { id: grab.to_bits() });
        if let Some(out_at) = out_at {
            out_at.write(at.into());
        }
        Ok(())
    })
}

/// Takes hold of a particle where it is. It follows muslin_cloth_move_grab exactly, but for a limit of
/// `max_displacement` a substep, and carries the cloth along.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_FULL if 64 grabs are held
/// already
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_grab_particle(
    cloth: MuslinCloth,
    particle: u32,
    out_grab: *mut MuslinGrab,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out_grab = unsafe { Out::new("out_grab", out_grab) };
    with_cloth(cloth, |cloth| {
        let out_grab = out_grab?;
        out_grab.write(MuslinGrab { id: cloth.grab_particle(particle)?.to_bits() });
        Ok(())
    })
}

/// Gives a grab a new target [m].
///
/// @return MUSLIN_STATUS_BAD_HANDLE if the grab was released; MUSLIN_STATUS_BAD_VALUE for a target that
/// is not finite
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_move_grab(
    cloth: MuslinCloth,
    grab: MuslinGrab,
    target: MuslinVec3,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.move_grab(Grab::from_bits(grab.id), target.into())?))
}

/// Lets a grabbed particle go, with the velocity it has. One that is pinned stays pinned, and returns to
/// its pin over the next tick.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if the grab was released before
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_release(cloth: MuslinCloth, grab: MuslinGrab) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.release(Grab::from_bits(grab.id))?))
}
