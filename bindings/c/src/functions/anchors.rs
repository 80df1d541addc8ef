//! Anchors: maximum distance and backstop around an animated target.

use crate::ffi::pointers::{read_f32s, read_u32s, read_vec3s};
use crate::functions::particles::check_count;
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::value::MuslinCloth;
use core::ffi::c_void;

/// Limits how far `count` particles may be from their anchors [m]. The limit holds after every
/// tick, whatever pulls at the particle.
///
/// - Infinity, the initial value, means no limit; 0 fixes the particle to its anchor.
/// - The anchor of a particle is the position of the last muslin_cloth_set_anchors; before the
///   first one, it is the particle's current position.
/// - Pins and grabs take precedence over the limit.
/// - A limit may stretch the cloth past `max_stretch`; this is reported as for pins, in MuslinStats
///   and by MUSLIN_EVENT_HELD_APART.
/// - muslin_cloth_reset removes all limits.
///
/// With `count` 0 both pointers may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
/// distance is negative or NaN, or `count` exceeds the number of particles
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_max_distances(
    cloth: MuslinCloth,
    particles: *const u32,
    distances: *const f32,
    count: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let (particles, distances) = unsafe {
            (read_u32s("particles", particles, count)?, read_f32s("distances", distances, count)?)
        };
        Ok(cloth.set_max_distances(&particles, &distances)?)
    })
}

/// Gives `count` particles backstops: spheres behind their anchors that the particles cannot enter,
/// so that a garment does not sink into the body that wears it.
///
/// Each sphere has a radius [m], 0 for none. Its surface is the given distance [m] behind the
/// anchor, opposite to the normal of muslin_cloth_set_anchors; a particle without a normal has no
/// backstop. With `count` 0 the pointers may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
/// distance or radius is negative or not finite, or `count` exceeds the number of particles
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_backstops(
    cloth: MuslinCloth,
    particles: *const u32,
    distances: *const f32,
    radii: *const f32,
    count: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let (particles, distances, radii) = unsafe {
            (
                read_u32s("particles", particles, count)?,
                read_f32s("distances", distances, count)?,
                read_f32s("radii", radii, count)?,
            )
        };
        Ok(cloth.set_backstops(&particles, &distances, &radii)?)
    })
}

/// Sets the animated positions [m] and outward normals of `count` particles, for
/// muslin_cloth_set_max_distances and muslin_cloth_set_backstops. Call it once per frame.
///
/// Anchors move to the new positions evenly over the ticks of the next muslin_cloth_advance, or in
/// the next tick of muslin_cloth_step; a particle's first anchor is in place at once. Positions and
/// normals are 3 floats each; consecutive ones start `stride` bytes apart in both lists (0 means
/// 12; a multiple of 4). Normals need not have length 1; NULL keeps the previous normals. With
/// `count` 0 all pointers may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if a
/// number is not finite, a normal has length 0, `stride` is invalid, or `count` exceeds the number
/// of particles
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_anchors(
    cloth: MuslinCloth,
    particles: *const u32,
    positions: *const c_void,
    normals: *const c_void,
    stride: u32,
    count: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        let normal_count = if normals.is_null() { 0 } else { count };
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let (particles, positions, normals) = unsafe {
            (
                read_u32s("particles", particles, count)?,
                read_vec3s("positions", positions, stride, count)?,
                read_vec3s("normals", normals, stride, normal_count)?,
            )
        };
        Ok(cloth.set_anchors(&particles, &positions, &normals)?)
    })
}

/// Removes all anchors, maximum distances and backstops.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_clear_leashes(cloth: MuslinCloth) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        cloth.clear_leashes();
        Ok(())
    })
}
