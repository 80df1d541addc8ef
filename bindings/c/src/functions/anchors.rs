//! Particles stay near where animation has them.

use crate::ffi::pointers::{read_f32s, read_u32s, read_vec3s};
use crate::functions::particles::check_count;
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::value::MuslinCloth;
use core::ffi::c_void;

/// Says how far `count` particles may be from their anchors [m]: after every tick none is farther, whatever
/// pulls at it. Infinity, as at first, is as far as they like; 0 holds them there. The anchor of a particle is
/// where muslin_cloth_set_anchors has it, and until that was called where the particle is now. A pinned or
/// grabbed particle goes by that alone. What keeps a cloth apart so may stretch it past max_stretch, which is
/// told as if pins did. With 0 particles both pointers may be NULL. None outlives a reset.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a distance that is
/// not at least 0, or more than there are particles
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_set_max_distances(
    cloth: MuslinCloth,
    particles: *const u32,
    distances: *const f32,
    count: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        // SAFETY: the caller's promise above.
        let (particles, distances) = unsafe {
            (read_u32s("particles", particles, count)?, read_f32s("distances", distances, count)?)
        };
        Ok(cloth.set_max_distances(&particles, &distances)?)
    })
}

/// Gives `count` particles backstops: spheres behind their anchors that they stay out of, so that a garment
/// does not sink into the body that wears it. Each has a radius [m], 0 for none, and begins a distance [m]
/// behind its anchor, against the normal that muslin_cloth_set_anchors gave: without one there is no
/// backstop. With 0 particles the pointers may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a distance or
/// radius that is below 0 or not finite, or more than there are particles
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
        // SAFETY: the caller's promise above.
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

/// Says where animation has `count` particles [m], and which way is out of the body there, for
/// muslin_cloth_set_max_distances and muslin_cloth_set_backstops. Call it each frame: anchors get there over
/// the next tick, and those of particles that had none are there at once. Positions and normals are 3 floats
/// each, and begin `stride` bytes apart in both: 0 is 12, else a multiple of 4. Normals need not be of length
/// 1; with NULL those of before stay. With 0 particles all pointers may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a number that is not
/// finite, a normal of no length, more than there are particles, or a rule above
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
        // SAFETY: the caller's promise above.
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

/// Takes away all anchors, maximum distances and backstops.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_clear_leashes(cloth: MuslinCloth) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        cloth.clear_leashes();
        Ok(())
    })
}
