//! Attachments: groups of pins that a moving transform carries.

use crate::ffi::pointers::{Out, read_u32s};
use crate::functions::particles::check_count;
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::value::{MuslinAttachment, MuslinCloth, MuslinQuat, MuslinVec3};
use muslin_core::Attachment;

/// Attaches `count` particles to a transform at `position` [m] with `rotation`, e.g. a bone, a pole
/// or a car body. The particles are pinned at their current positions; muslin_cloth_move_attachment
/// moves them.
///
/// - A particle that is already pinned, or attached to another transform, keeps its stiffness and
///   moves to this attachment.
/// - A particle leaves the attachment when it gets a pin target of its own or is unpinned.
/// - A tear or cut through attached particles attaches the new particles too.
/// - muslin_cloth_reset removes all attachments.
///
/// With `count` 0 the pointer may be NULL.
///
/// @return MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE if
/// `position` is not finite, `rotation` is not a unit quaternion, or `count` exceeds the number of
/// particles; MUSLIN_STATUS_FULL if there are 64 attachments already
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_attach(
    cloth: MuslinCloth,
    particles: *const u32,
    count: u32,
    position: MuslinVec3,
    rotation: MuslinQuat,
    out_attachment: *mut MuslinAttachment,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_attachment = unsafe { Out::new("out_attachment", out_attachment) };
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        let out_attachment = out_attachment?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let particles = unsafe { read_u32s("particles", particles, count)? };
        let attachment = cloth.attach(&particles, position.into(), rotation.into())?;
        out_attachment.write(MuslinAttachment { id: attachment.to_bits() });
        Ok(())
    })
}

/// Moves an attachment: its particles reach the new pose evenly over the ticks of the next
/// muslin_cloth_advance, or in the next tick of muslin_cloth_step. They rotate with the transform
/// on the way, and are exactly there at the end.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if it was detached; MUSLIN_STATUS_BAD_VALUE if `position` is
/// not finite or `rotation` is not a unit quaternion
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_move_attachment(
    cloth: MuslinCloth,
    attachment: MuslinAttachment,
    position: MuslinVec3,
    rotation: MuslinQuat,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        let attachment = Attachment::from_bits(attachment.id);
        Ok(cloth.move_attachment(attachment, position.into(), rotation.into())?)
    })
}

/// Removes an attachment and unpins the particles that it still carries; they keep their
/// velocities.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if it was detached before
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_detach(
    cloth: MuslinCloth,
    attachment: MuslinAttachment,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.detach(Attachment::from_bits(attachment.id))?))
}
