//! Mass scales, painted maps, positions and velocities of particles.

use crate::ffi::pointers::{Out, OutVec3s, check, read_f32s, read_u32s, read_vec3s};
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus, Result};
use crate::types::material::map as map_of;
use crate::types::value::{MuslinCloth, MuslinVec3};
use muslin_core::{Cloth, Error};

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

/// Paints a property (MUSLIN_MAP_STRETCH, MUSLIN_MAP_BEND, MUSLIN_MAP_TEAR, MUSLIN_MAP_FRICTION,
/// MUSLIN_MAP_THICKNESS or MUSLIN_MAP_DRAG): multiplies what the material says by one scale per
/// particle, from 0 to 1000; 1 is as the material says. NULL takes the map away, whatever `count`.
///
/// A link, a hinge or a triangle takes the mean of the scales at its corners; a contact interpolates
/// them at its point, and two layers take the mean of both sides. Own values of a collider are
/// scaled too.
///
/// Maps stay when the material changes and when the cloth is reset. A particle that a tear splits
/// off takes the scale of its source; one that a cut adds to an edge takes the scale between those of
/// its ends. Scales take effect with the next tick. A map takes memory only while it is set.
///
/// @return MUSLIN_STATUS_BAD_VALUE for any other `map`, if `count` is not the number of particles, or
/// if a scale is not from 0 to 1000 (the message names its index)
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_map(
    cloth: MuslinCloth,
    map: u32,
    scales: *const f32,
    count: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        let map = map_of(map)?;
        if scales.is_null() {
            return Ok(cloth.set_map(map, None)?);
        }
        check_is_count(cloth, count)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let scales = unsafe { read_f32s("scales", scales, count)? };
        Ok(cloth.set_map(map, Some(&scales))?)
    })
}

/// Reads a painted map: one scale per particle, also of those that tears and cuts added; 1 for all if
/// the map is not set.
///
/// `map` is a MUSLIN_MAP_ value. `out_scales` (may be NULL) receives `count` scales, `out_is_set` (may
/// be NULL) 1 if the map is set, else 0.
///
/// @return MUSLIN_STATUS_BAD_VALUE for any other `map`, or if `count` is not the number of particles;
/// without `out_scales`, `count` is ignored
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_map(
    cloth: MuslinCloth,
    map: u32,
    out_scales: *mut f32,
    count: u32,
    out_is_set: *mut u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_is_set = unsafe { Out::new_optional(out_is_set) };
    with_cloth(cloth, |cloth| {
        let scales = cloth.map(map_of(map)?);
        if !out_scales.is_null() {
            check_is_count(cloth, count)?;
            for i in 0..count as usize {
                let scale = scales.map_or(1.0, |scales| scales[i]);
                // SAFETY: by the header's rules, there are `count` writable numbers.
                unsafe { out_scales.add(i).write_unaligned(scale) };
            }
        }
        out_is_set.into_iter().for_each(|out| out.write(u32::from(scales.is_some())));
        Ok(())
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

/// Places `count` particles, from `first` on, at once [m]: a whole pose, if `first` is 0 and `count`
/// the number of particles.
///
/// Velocities stay as they are; call muslin_cloth_set_velocities too to continue from a recorded
/// state. Pinned particles stay pinned, at the new positions. Positions are 3 floats each;
/// consecutive ones start `stride` bytes apart (0 means 12; a multiple of 4). With `count` 0 the
/// pointer may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if a
/// position is not finite (the message names its index), `stride` is invalid, or `count` exceeds
/// the number of particles from `first` on
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_positions(
    cloth: MuslinCloth,
    first: u32,
    count: u32,
    positions: *const f32,
    stride: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_range(cloth, first, count)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let positions = unsafe { read_vec3s("positions", positions.cast(), stride, count)? };
        Ok(cloth.set_positions(first, &positions)?)
    })
}

/// Sets the velocities of `count` particles, from `first` on [m/s].
///
/// Velocities are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a
/// multiple of 4). With `count` 0 the pointer may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if a
/// velocity is not finite (the message names its index), `stride` is invalid, or `count` exceeds
/// the number of particles from `first` on
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_velocities(
    cloth: MuslinCloth,
    first: u32,
    count: u32,
    velocities: *const f32,
    stride: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_range(cloth, first, count)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let velocities = unsafe { read_vec3s("velocities", velocities.cast(), stride, count)? };
        Ok(cloth.set_velocities(first, &velocities)?)
    })
}

/// Reads the velocities of `count` particles, from `first` on [m/s].
///
/// Velocities are 3 floats each; consecutive ones start `stride` bytes apart (0 means 12; a
/// multiple of 4), and the bytes between them do not change. With `count` 0 the pointer may be
/// NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if
/// `stride` is invalid, or `count` exceeds the number of particles from `first` on
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_velocities(
    cloth: MuslinCloth,
    first: u32,
    count: u32,
    out_velocities: *mut f32,
    stride: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_range(cloth, first, count)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let out = unsafe { OutVec3s::new("out_velocities", out_velocities, stride, count)? };
        out.write(cloth.velocities().skip(first as usize));
        Ok(())
    })
}

/// Reads the positions that `count` particles, from `first` on, have in the rest shape [m]: where
/// the descriptor placed them, whatever moved them since.
///
/// A particle that a tear split off has the position of its source; one that a cut added has the
/// point of the rest edge that was cut. Strides are as in muslin_cloth_get_velocities. With `count`
/// 0 the pointer may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if particle `first` does not exist; MUSLIN_STATUS_BAD_VALUE if
/// `stride` is invalid, or `count` exceeds the number of particles from `first` on
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_rest_positions(
    cloth: MuslinCloth,
    first: u32,
    count: u32,
    out_positions: *mut f32,
    stride: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_range(cloth, first, count)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let out = unsafe { OutVec3s::new("out_positions", out_positions, stride, count)? };
        out.write(cloth.rest_positions().skip(first as usize));
        Ok(())
    })
}

/// Refuses a count other than the number of particles.
fn check_is_count(cloth: &Cloth, count: u32) -> Result {
    let particles = cloth.particle_count();
    if count == particles {
        return Ok(());
    }
    let must = format!("be {particles}, the number of particles, but is {count}");
    Err(CallError::bad_value("count", must))
}

/// Refuses a range of particles that is not part of the cloth.
fn check_range(cloth: &Cloth, first: u32, count: u32) -> Result {
    let particles = cloth.particle_count();
    let Some(left) = particles.checked_sub(first).filter(|left| *left > 0 || count == 0) else {
        return Err(Error::BadIndex { field: "first", index: first, count: particles }.into());
    };
    check(count <= left, "count", "be at most the number of particles from `first` on")
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
