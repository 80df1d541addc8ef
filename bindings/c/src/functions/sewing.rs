//! Sewing: pairs of particles that are drawn together and joined.

use crate::ffi::pointers::read_u32s;
use crate::ffi::versioned_struct::read_struct;
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus};
use crate::types::sewing::MuslinSewDesc;
use crate::types::value::MuslinCloth;
use muslin_core::SewDesc;

/// Sews `pair_count` pairs of particles together: draws each pair together at `speed` of `desc`, and
/// joins it when its distance is zero. `pairs` has two particles per pair.
///
/// Joined particles have one position and one velocity after every tick, and move as one particle
/// with the mass of both.
///
/// - Particles may be in several pairs, as where three panels meet.
/// - Pairs do not collide with each other. A held particle draws the other one to it.
/// - Two held particles stay where they are; `over_stretched` of MuslinStats counts the pair and
///   MUSLIN_EVENT_HELD_APART reports it.
/// - Particles, vertices and triangles stay as they are. A weld is invisible, since normals are
///   smooth across it.
/// - A stitch that tears gives MUSLIN_EVENT_STITCH_TORN.
/// - muslin_cloth_reset keeps the pairs and draws them together again from the rest shape.
///
/// With `pair_count` 0, `pairs` may be NULL. With `desc` NULL the defaults apply.
///
/// @return MUSLIN_STATUS_BAD_VALUE if two particles of a pair are equal, do not exist or have no
/// triangle, if `pair_count` exceeds the number of particles, or for an invalid field of `desc`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_sew(
    cloth: MuslinCloth,
    pairs: *const u32,
    pair_count: u32,
    desc: *const MuslinSewDesc,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        if pair_count > cloth.particle_count() {
            return Err(CallError::bad_value("pair_count", "be at most the number of particles"));
        }
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call; the product
        // fits, since there are fewer particles than half of its range.
        let pairs = unsafe { read_u32s("pairs", pairs, 2 * pair_count)? };
        let desc = if desc.is_null() {
            SewDesc::default()
        } else {
            // SAFETY: as above.
            unsafe { read_struct("desc", desc)? }.try_into()?
        };
        Ok(cloth.sew(pairs.as_chunks().0, &desc)?)
    })
}
