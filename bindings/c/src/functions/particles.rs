//! Particles are pinned, put, pushed and weighed.

use crate::ffi::pointers::{read_f32s, read_optional, read_u32s, read_vec3s};
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus, Result};
use crate::types::value::{MuslinCloth, MuslinVec3};
use core::ffi::c_void;
use muslin_core::{Cloth, Error};

/// Holds a particle at `target` [m], or where it is if that is NULL. The target is reached over the
/// next tick; a particle that is pinned already gets a new target, which nothing carries, and keeps its
/// stiffness.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a target that
/// is not finite
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_pin(
    cloth: MuslinCloth,
    particle: u32,
    target: *const MuslinVec3,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let target = unsafe { read_optional(target) };
    with_cloth(cloth, |cloth| Ok(cloth.pin(particle, target.map(Into::into))?))
}

/// Lets a particle go. One that is not pinned stays as it is.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_unpin(cloth: MuslinCloth, particle: u32) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.unpin(particle)?))
}

/// Lets every particle go.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_unpin_all(cloth: MuslinCloth) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        cloth.unpin_all();
        Ok(())
    })
}

/// Gives `count` pins their targets at once; particles that are not pinned yet are from now on. The
/// targets [m] are 3 floats each at `positions`, and begin `stride` bytes apart: 0 is 12, else a multiple
/// of 4. No more than there are particles; with 0 both pointers may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a target that
/// is not finite, or a rule above
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_pin_targets(
    cloth: MuslinCloth,
    particles: *const u32,
    positions: *const c_void,
    stride: u32,
    count: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        // SAFETY: the caller's promise above.
        let (particles, targets) = unsafe {
            (
                read_u32s("particles", particles, count)?,
                read_vec3s("positions", positions, stride, count)?,
            )
        };
        cloth.set_pin_targets(&particles, &targets).map_err(|error| match error {
            Error::BadValue { must, .. } => CallError::bad_value("positions", must),
            error => error.into(),
        })
    })
}

/// Says how hard `count` pins pull towards their targets [N/m]: as springs, or exactly if `stiffness` is 0,
/// as they do at first. A soft pin holds a load of 1 N 1/`stiffness` from its target; the cloth counts as free
/// there, for tears and for max_stretch, and is not tethered to it. 1e3 N/m feels firm, 10 N/m lets a sheet of
/// cotton sag by a few centimetres. A tear through a soft pin shares its stiffness out by mass. With 0
/// particles the pointer may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for one that is
/// not pinned, a stiffness that is below 0 or not finite, or more than there are particles
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_pin_stiffness(
    cloth: MuslinCloth,
    particles: *const u32,
    count: u32,
    stiffness: f32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        // SAFETY: the caller's promise above.
        let particles = unsafe { read_u32s("particles", particles, count)? };
        Ok(cloth.set_pin_stiffness(&particles, stiffness)?)
    })
}

/// Makes `count` particles heavier or lighter than their material, by a factor each: 1, as at first, is what
/// its density and the area about them give. A hem of 5 hangs straight; a coin sewn in may be 100. Factors
/// stay when the density changes. Neighbours may well be a hundredfold apart; where it is thousands, what
/// hangs by the light ones stretches them until there are more substeps. With 0 particles both pointers may
/// be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a factor that is
/// not from 0.001 to 1000, or more than there are particles
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_mass_scales(
    cloth: MuslinCloth,
    particles: *const u32,
    scales: *const f32,
    count: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        // SAFETY: the caller's promise above.
        let (particles, scales) = unsafe {
            (read_u32s("particles", particles, count)?, read_f32s("scales", scales, count)?)
        };
        Ok(cloth.set_mass_scales(&particles, &scales)?)
    })
}

/// Puts a particle somewhere [m], at once; it keeps its velocity. A pin goes with it.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a position
/// that is not finite
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_set_position(
    cloth: MuslinCloth,
    particle: u32,
    position: MuslinVec3,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.set_position(particle, position.into())?))
}

/// Gives a particle a velocity [m/s].
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a velocity
/// that is not finite
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_set_velocity(
    cloth: MuslinCloth,
    particle: u32,
    velocity: MuslinVec3,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.set_velocity(particle, velocity.into())?))
}

/// Refuses a list of more particles than there are.
pub(super) fn check_count(cloth: &Cloth, count: u32) -> Result {
    let fits = count as usize <= cloth.positions().len();
    if fits {
        Ok(())
    } else {
        Err(CallError::bad_value("count", "be at most the number of particles"))
    }
}
