//! Particles are pinned, put and pushed.

use crate::boundary;
use crate::registry::with_cloth;
use crate::status::{MuslinStatus, Refusal};
use crate::types::value::{MuslinCloth, MuslinVec3};
use core::ffi::c_void;
use muslin_core::Error;

/// Holds a particle at `target` [m], or where it is if that is NULL. The target is reached over the
/// next tick; a particle that is pinned already gets a new target.
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
    let target = unsafe { boundary::optional(target) };
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
        if count as usize > cloth.positions().len() {
            return Err(Refusal::bad_value("count", "be at most the number of particles"));
        }
        // SAFETY: the caller's promise above.
        let (particles, targets) = unsafe {
            (
                boundary::list("particles", particles, count)?,
                boundary::points("positions", positions, stride, count)?,
            )
        };
        cloth.set_pin_targets(&particles, &targets).map_err(|error| match error {
            Error::BadValue { must, .. } => Refusal::bad_value("positions", must),
            error => error.into(),
        })
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
