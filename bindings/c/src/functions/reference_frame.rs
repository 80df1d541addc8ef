//! A cloth goes along with a body that jumps, or runs.

use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::value::{MuslinCloth, MuslinCollider, MuslinQuat, MuslinVec3};
use muslin_core::Collider;

/// Says where the body is that wears the cloth, and how it is turned: muslin_cloth_teleport and
/// muslin_cloth_move_frame go from there. At first, and after a reset, that is the origin. It moves nothing.
///
/// @return MUSLIN_STATUS_BAD_VALUE for a position that is not finite or a rotation that is no unit quaternion
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_set_frame(
    cloth: MuslinCloth,
    position: MuslinVec3,
    rotation: MuslinQuat,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.set_frame(position.into(), rotation.into())?))
}

/// Takes the cloth along as the body that wears it jumps from where muslin_cloth_set_frame, muslin_cloth_move_frame
/// or the last teleport had it: at once, as a solid body, and without feeling it. Velocities turn with it. Pins, attachments, grabs
/// and anchors go along; colliders do not, see muslin_cloth_teleport_collider. In a frame it comes before
/// muslin_cloth_move_attachment and muslin_cloth_set_anchors.
///
/// @return MUSLIN_STATUS_BAD_VALUE for a position that is not finite or a rotation that is no unit quaternion, or if
/// something would get farther off than a number can say
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_teleport(
    cloth: MuslinCloth,
    position: MuslinVec3,
    rotation: MuslinQuat,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.teleport(position.into(), rotation.into())?))
}

/// Takes the cloth along as the body that wears it runs and turns on from where muslin_cloth_set_frame,
/// muslin_cloth_teleport or the last muslin_cloth_move_frame had it: over the next tick, and with only a share
/// of its inertia. At 1 it feels all of the body's motion, as if nothing were said; at 0 none, as if the body stood
/// still and the rest of the world moved past; between, so much of it, both of the way and of the turn.
///
/// What is not felt takes particles along at once, as a solid body; over the tick they, pins, attachments and
/// anchors get to where the body has them then. Colliders and grabs stay where they are told to be, and the
/// cloth meets them as one who goes with the body sees them move. Air goes along as far as the motion is not
/// felt. In a frame it comes before muslin_cloth_move_attachment, muslin_cloth_move_collider and
/// muslin_cloth_set_anchors.
///
/// @return MUSLIN_STATUS_BAD_VALUE for a position that is not finite, a rotation that is no unit quaternion, an
/// inertia that is not from 0 to 1, or if something would get farther off than a number can say
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_move_frame(
    cloth: MuslinCloth,
    position: MuslinVec3,
    rotation: MuslinQuat,
    inertia: f32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.move_frame(position.into(), rotation.into(), inertia)?))
}

/// Puts a collider somewhere at once: it does not sweep, and what lay on it does not feel it go.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if it was removed; MUSLIN_STATUS_BAD_VALUE for a position that is not
/// finite or a rotation that is no unit quaternion
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_teleport_collider(
    cloth: MuslinCloth,
    collider: MuslinCollider,
    position: MuslinVec3,
    rotation: MuslinQuat,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        let collider = Collider::from_bits(collider.id);
        Ok(cloth.teleport_collider(collider, position.into(), rotation.into())?)
    })
}
