//! Moving reference frame: the body that wears the cloth teleports or moves.

use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::value::{MuslinCloth, MuslinCollider, MuslinQuat, MuslinVec3};
use muslin_core::Collider;

/// Sets the pose of the body that wears the cloth, the start for muslin_cloth_teleport and
/// muslin_cloth_move_frame. Moves nothing.
///
/// The initial pose, also after muslin_cloth_reset, is the origin without rotation.
///
/// @return MUSLIN_STATUS_BAD_VALUE if `position` is not finite or `rotation` is not a unit
/// quaternion
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_set_frame(
    cloth: MuslinCloth,
    position: MuslinVec3,
    rotation: MuslinQuat,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.set_frame(position.into(), rotation.into())?))
}

/// Moves the cloth with the body that wears it to a new pose at once, as a rigid body and without
/// inertia. Velocities rotate with it.
///
/// The motion starts at the pose of the last muslin_cloth_set_frame, muslin_cloth_move_frame or
/// muslin_cloth_teleport. Pins, attachments, grabs and anchors move too; colliders do not, see
/// muslin_cloth_teleport_collider. In a frame, call this before muslin_cloth_move_attachment and
/// muslin_cloth_set_anchors.
///
/// @return MUSLIN_STATUS_BAD_VALUE if `position` is not finite, `rotation` is not a unit
/// quaternion, or a moved value would not be finite; the cloth is unchanged then
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_teleport(
    cloth: MuslinCloth,
    position: MuslinVec3,
    rotation: MuslinQuat,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.teleport(position.into(), rotation.into())?))
}

/// Moves the cloth with the body that wears it to a new pose over the ticks of the next
/// muslin_cloth_advance, or in the next tick of muslin_cloth_step; the cloth feels only the share
/// `inertia` of the motion.
///
/// - 1: the cloth feels the whole motion, as without this call.
/// - 0: the cloth feels nothing, as if the body stood still and the world moved.
/// - Between: it feels this share of the translation and of the rotation.
///
/// The motion starts at the pose of the last muslin_cloth_set_frame, muslin_cloth_teleport or
/// muslin_cloth_move_frame. The part that is not felt moves particles at once, as a rigid body.
/// Pins, attachments and anchors reach the body's new pose evenly over these ticks. Colliders and
/// grabs stay at the poses that you give; the cloth meets them with the velocity that they have
/// relative to the body. The air moves with the body by the share that is not felt.
///
/// In a frame, call this before muslin_cloth_move_attachment, muslin_cloth_move_collider and
/// muslin_cloth_set_anchors.
///
/// @return MUSLIN_STATUS_BAD_VALUE if `position` is not finite, `rotation` is not a unit
/// quaternion, `inertia` is not from 0 to 1, or a moved value would not be finite; the cloth is
/// unchanged then
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_move_frame(
    cloth: MuslinCloth,
    position: MuslinVec3,
    rotation: MuslinQuat,
    inertia: f32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.move_frame(position.into(), rotation.into(), inertia)?))
}

/// Places a collider at a new pose at once, without a sweep and without dragging the cloth along.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if it was removed; MUSLIN_STATUS_BAD_VALUE if `position` is not
/// finite or `rotation` is not a unit quaternion
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
