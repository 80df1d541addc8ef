//! Ray casts and grabs.

use crate::ffi::pointers::Out;
use crate::ffi::versioned_struct::OutStruct;
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus};
use crate::types::hit::MuslinHit;
use crate::types::value::{MuslinCloth, MuslinGrab, MuslinVec3};
use muslin_core::Grab;

fn nothing_hit() -> CallError {
    CallError::new(MuslinStatus::NothingHit, "the ray hits nothing")
}

/// Finds the first triangle that a ray hits within `max_distance` [m], from either side.
///
/// `direction` need not have length 1; `max_distance` may be infinite. Initialise `out_hit` with
/// muslin_hit_init.
///
/// @return MUSLIN_STATUS_NOTHING_HIT if the ray hits nothing; MUSLIN_STATUS_BAD_VALUE if `origin`
/// or `direction` is not finite, `direction` is zero, or `max_distance` is negative or NaN
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_raycast(
    cloth: MuslinCloth,
    origin: MuslinVec3,
    direction: MuslinVec3,
    max_distance: f32,
    out_hit: *mut MuslinHit,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out = unsafe { OutStruct::new("out_hit", out_hit) };
    with_cloth(cloth, |cloth| {
        let out = out?;
        let hit = cloth.raycast(origin.into(), direction.into(), max_distance)?;
        out.write(&hit.ok_or_else(nothing_hit)?.into());
        Ok(())
    })
}

/// Grabs the particle that a ray points at: the nearest corner of the first triangle that the ray
/// hits; if it hits none, the particle nearest to the ray within `radius` [m].
///
/// `out_at` (may be NULL) receives the position of the particle [m]. See
/// muslin_cloth_grab_particle.
///
/// @return MUSLIN_STATUS_NOTHING_HIT if there is no such particle; MUSLIN_STATUS_BAD_VALUE if
/// `origin` or `direction` is not finite, `direction` is zero, or `radius` is negative or not
/// finite; MUSLIN_STATUS_FULL if there are 64 grabs already
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_grab_ray(
    cloth: MuslinCloth,
    origin: MuslinVec3,
    direction: MuslinVec3,
    radius: f32,
    out_grab: *mut MuslinGrab,
    out_at: *mut MuslinVec3,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let (out_grab, out_at) = unsafe { (Out::new("out_grab", out_grab), Out::new_optional(out_at)) };
    with_cloth(cloth, |cloth| {
        let out_grab = out_grab?;
        let grabbed = cloth.grab_ray(origin.into(), direction.into(), radius)?;
        let (grab, at) = grabbed.ok_or_else(nothing_hit)?;
        out_grab.write(MuslinGrab { id: grab.to_bits() });
        if let Some(out_at) = out_at {
            out_at.write(at.into());
        }
        Ok(())
    })
}

/// Grabs a particle at its current position.
///
/// The particle then follows the target of muslin_cloth_move_grab exactly, at most
/// `max_displacement` per substep, and pulls the cloth along.
///
/// @return MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_FULL if there are
/// 64 grabs already
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_grab_particle(
    cloth: MuslinCloth,
    particle: u32,
    out_grab: *mut MuslinGrab,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_grab = unsafe { Out::new("out_grab", out_grab) };
    with_cloth(cloth, |cloth| {
        let out_grab = out_grab?;
        out_grab.write(MuslinGrab { id: cloth.grab_particle(particle)?.to_bits() });
        Ok(())
    })
}

/// Sets the target of a grab [m]. Within the speed limit the particle reaches it evenly over the
/// ticks of the next muslin_cloth_advance, or in the next tick of muslin_cloth_step.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if the grab was released; MUSLIN_STATUS_BAD_VALUE if the target
/// is not finite
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_move_grab(
    cloth: MuslinCloth,
    grab: MuslinGrab,
    target: MuslinVec3,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.move_grab(Grab::from_bits(grab.id), target.into())?))
}

/// Releases a grabbed particle, which keeps its velocity. A pinned particle stays pinned and
/// returns to its pin evenly over the ticks of the next muslin_cloth_advance, or in the next tick of
/// muslin_cloth_step.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if the grab was released before
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_release(cloth: MuslinCloth, grab: MuslinGrab) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.release(Grab::from_bits(grab.id))?))
}
