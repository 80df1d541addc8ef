//! Pins, mass scales, positions and velocities of particles.

use crate::ffi::pointers::{read_f32s, read_optional, read_u32s, read_vec3s};
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus, Result};
use crate::types::value::{MuslinCloth, MuslinVec3};
use core::ffi::c_void;
use muslin_core::{Cloth, Error};

/// Pins a particle at `target` [m], or at its current position if `target` is NULL.
///
/// The particle reaches the target evenly over the ticks of the next muslin_cloth_advance, or in
/// the next tick of muslin_cloth_step. If it is already pinned, the target changes and the
/// stiffness stays; an attached particle leaves its attachment.
///
/// @return MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_BAD_VALUE if the
/// target is not finite
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_pin(
    cloth: MuslinCloth,
    particle: u32,
    target: *const MuslinVec3,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let target = unsafe { read_optional(target) };
    with_cloth(cloth, |cloth| Ok(cloth.pin(particle, target.map(Into::into))?))
}

/// Releases a pinned particle, which keeps its velocity. Has no effect on a particle that is not
/// pinned.
///
/// @return MUSLIN_STATUS_BAD_INDEX if the particle does not exist
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_unpin(cloth: MuslinCloth, particle: u32) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.unpin(particle)?))
}

/// Releases all pinned particles.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_unpin_all(cloth: MuslinCloth) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        cloth.unpin_all();
        Ok(())
    })
}

/// Sets the targets [m] of `count` pins at once, e.g. every frame for an animated edge. Particles
/// that are not pinned yet become pinned. They reach their targets as those of muslin_cloth_pin.
///
/// Targets are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a multiple
/// of 4). With `count` 0 both pointers may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
/// target is not finite, `stride` is invalid, or `count` exceeds the number of particles
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
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
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

/// Sets the stiffness [N/m] with which `count` pins pull particles towards their targets. 0, the
/// initial value, holds them exactly; above 0 the pin is a spring.
///
/// - A load of 1 N moves a soft pin's particle 1/`stiffness` metres from its target: 1e3 N/m feels
///   firm, 10 N/m lets a sheet of cotton sag by a few centimetres.
/// - For tears and `max_stretch` the cloth counts as free at a soft pin, and it is not tethered to
///   it.
/// - A tear through a soft pin divides its stiffness in proportion to mass.
///
/// With `count` 0 the pointer may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
/// particle is not pinned, `stiffness` is negative or not finite, or `count` exceeds the number of
/// particles
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_pin_stiffness(
    cloth: MuslinCloth,
    particles: *const u32,
    count: u32,
    stiffness: f32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let particles = unsafe { read_u32s("particles", particles, count)? };
        Ok(cloth.set_pin_stiffness(&particles, stiffness)?)
    })
}

/// Multiplies the masses of `count` particles by factors: 1, the initial value, keeps the mass that
/// density and surrounding area give. A hem hangs straight at about 5; a coin that is sewn in may
/// be 100.
///
/// Factors stay when the density changes. Neighbours may differ by a factor of 100; at factors in
/// the thousands, light particles that carry heavy ones stretch unless `substeps` is raised. With
/// `count` 0 both pointers may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
/// factor is not from 0.001 to 1000, or `count` exceeds the number of particles
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_mass_scales(
    cloth: MuslinCloth,
    particles: *const u32,
    scales: *const f32,
    count: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let (particles, scales) = unsafe {
            (read_u32s("particles", particles, count)?, read_f32s("scales", scales, count)?)
        };
        Ok(cloth.set_mass_scales(&particles, &scales)?)
    })
}

/// Places a particle at `position` [m] at once. Its velocity stays as it is. A pinned particle
/// stays pinned, at the new position.
///
/// @return MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_BAD_VALUE if the
/// position is not finite
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_set_position(
    cloth: MuslinCloth,
    particle: u32,
    position: MuslinVec3,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.set_position(particle, position.into())?))
}

/// Sets the velocity of a particle [m/s].
///
/// @return MUSLIN_STATUS_BAD_INDEX if the particle does not exist; MUSLIN_STATUS_BAD_VALUE if the
/// velocity is not finite
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_set_velocity(
    cloth: MuslinCloth,
    particle: u32,
    velocity: MuslinVec3,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.set_velocity(particle, velocity.into())?))
}

/// Refuses a count that exceeds the number of particles.
pub(super) fn check_count(cloth: &Cloth, count: u32) -> Result {
    let fits = count as usize <= cloth.positions().len();
    if fits {
        Ok(())
    } else {
        Err(CallError::bad_value("count", "be at most the number of particles"))
    }
}
