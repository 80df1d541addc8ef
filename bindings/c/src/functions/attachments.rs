//! Particles are carried by moving transforms.

use crate::ffi::pointers::{Out, read_u32s};
use crate::functions::particles::check_count;
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::value::{MuslinAttachment, MuslinCloth, MuslinQuat, MuslinVec3};
use muslin_core::Attachment;

/// Attaches `count` particles to a transform at `position` [m], turned by `rotation`: a bone, a pole, the body
/// of a car. They are pinned where they are now, and from then on muslin_cloth_move_attachment carries them.
/// Those that are pinned already, or attached to something else, keep their stiffness. One that gets a target
/// of its own later, or is unpinned, leaves the attachment. Vertices that a tear or a cut makes of attached
/// ones are attached too. With 0 particles the pointer may be NULL. No attachment outlives a reset.
///
/// @return MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE for a position that is
/// not finite, a rotation that is no unit quaternion, or more than there are particles; MUSLIN_STATUS_FULL if
/// there are 64 attachments already
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_attach(
    cloth: MuslinCloth,
    particles: *const u32,
    count: u32,
    position: MuslinVec3,
    rotation: MuslinQuat,
    out_attachment: *mut MuslinAttachment,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out_attachment = unsafe { Out::new("out_attachment", out_attachment) };
    with_cloth(cloth, |cloth| {
        check_count(cloth, count)?;
        let out_attachment = out_attachment?;
        // SAFETY: the caller's promise above.
        let particles = unsafe { read_u32s("particles", particles, count)? };
        let attachment = cloth.attach(&particles, position.into(), rotation.into())?;
        out_attachment.write(MuslinAttachment { id: attachment.to_bits() });
        Ok(())
    })
}

/// Moves a transform that particles are attached to: they get there over the next tick, turning on the way
/// as it turns, and are exactly there when it ends.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if it was detached; MUSLIN_STATUS_BAD_VALUE for a position that is not
/// finite or a rotation that is no unit quaternion
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

/// Lets all go that an attachment still carries, with the velocity that they have.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if it was detached before
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_detach(
    cloth: MuslinCloth,
    attachment: MuslinAttachment,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.detach(Attachment::from_bits(attachment.id))?))
}
