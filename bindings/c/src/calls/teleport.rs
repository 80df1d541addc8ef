//! A cloth goes along with a body that jumps.

use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::value::{MuslinCloth, MuslinCollider, MuslinQuat, MuslinVec3};
use muslin_core::Collider;

/// Says where the body is that wears the cloth, and how it is turned: muslin_cloth_teleport goes from there. At
/// first, and after a reset, that is the origin. It moves nothing.
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

/// Takes the cloth along as the body that wears it jumps from where muslin_cloth_set_frame or the last teleport
/// had it: at once, as a solid body, and without feeling it. Velocities turn with it. Pins, attachments, grabs
/// and anchors go along; colliders do not, see muslin_cloth_teleport_collider. In a frame it comes before
/// muslin_cloth_move_attachment and muslin_cloth_set_anchors.
///
/// @return MUSLIN_STATUS_BAD_VALUE for a position that is not finite or a rotation that is no unit quaternion
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_teleport(
    cloth: MuslinCloth,
    position: MuslinVec3,
    rotation: MuslinQuat,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.teleport(position.into(), rotation.into())?))
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
