//! Pins: particles that are held at targets.

use crate::ffi::pointers::{Out, OutVec3s, check, read_optional, read_u32s, read_vec3s};
use crate::functions::particles::check_count;
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus};
use crate::types::value::{MuslinCloth, MuslinVec3};
use core::ffi::c_void;
use core::ptr::NonNull;
use muslin_core::Error;

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

/// Returns the pinned particles, in ascending order. `out_count` receives their number.
///
/// If `capacity` is 0, only the number is returned, and `out_particles` may be NULL.
///
/// @return MUSLIN_STATUS_BUFFER_TOO_SMALL if `capacity` is neither 0 nor at least that number:
/// nothing is written, and muslin_last_error() states the number
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_pins(
    cloth: MuslinCloth,
    out_particles: *mut u32,
    capacity: u32,
    out_count: *mut u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_count = unsafe { Out::new("out_count", out_count) };
    with_cloth(cloth, |cloth| {
        let (out_count, count) = (out_count?, cloth.pinned().count());
        if capacity > 0 {
            let at = NonNull::new(out_particles)
                .ok_or_else(|| CallError::bad_value("out_particles", "not be NULL"))?;
            if (capacity as usize) < count {
                let rule = format!("`capacity` must be 0 or at least {count}, but is {capacity}");
                return Err(CallError::new(MuslinStatus::BufferTooSmall, rule));
            }
            for (i, particle) in cloth.pinned().enumerate() {
                // SAFETY: by the header's rules, `capacity` numbers are writable there, and `i` is
                // below it.
                unsafe { at.add(i).write_unaligned(particle) };
            }
        }
        out_count.write(count as u32);
        Ok(())
    })
}

/// Reads the targets of `count` pins [m], which their particles reach with the next ticks. Those of
/// attached particles follow from the pose of their attachment.
///
/// Targets are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a multiple
/// of 4), and the bytes between them do not change. With `count` 0 both pointers may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
/// particle is not pinned, `stride` is invalid, or `count` exceeds the number of particles
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_pin_targets(
    cloth: MuslinCloth,
    particles: *const u32,
    out_positions: *mut f32,
    stride: u32,
    count: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let (particles, out) = unsafe {
            (
                read_u32s("particles", particles, count)?,
                OutVec3s::new("out_positions", out_positions, stride, count)?,
            )
        };
        let mut targets = Vec::with_capacity(particles.len());
        for particle in particles {
            let target = cloth.pin_target(particle).map_err(|error| match error {
                Error::BadIndex { index, count, .. } => {
                    Error::BadIndex { field: "particles", index, count }
                }
                error => error,
            })?;
            check(target.is_some(), "particles", "be pinned")?;
            targets.extend(target);
        }
        out.write(targets.into_iter());
        Ok(())
    })
}
