//! Colliders: add, move, remove, and read the impulse.

use crate::ffi::pointers::{Out, read_optional, read_vec3s};
use crate::ffi::versioned_struct::read_struct;
use crate::registry::{with_cloth, with_two_cloths};
use crate::status::MuslinStatus;
use crate::types::collider::MuslinColliderDesc;
use crate::types::value::{MuslinCloth, MuslinCollider, MuslinQuat, MuslinVec3};
use muslin_core::Collider;

/// Adds a collider to a cloth. It acts from the next tick on.
///
/// @return MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX for an invalid field of `desc`;
/// MUSLIN_STATUS_UNSUPPORTED for a shape that this version does not have; MUSLIN_STATUS_FULL if
/// there are 1024 colliders already
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_add_collider(
    cloth: MuslinCloth,
    desc: *const MuslinColliderDesc,
    out_collider: *mut MuslinCollider,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let (desc, out_collider) =
        unsafe { (read_struct("desc", desc), Out::new("out_collider", out_collider)) };
    with_cloth(cloth, |cloth| {
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let (desc, out_collider) = (unsafe { desc?.read()? }, out_collider?);
        out_collider.write(MuslinCollider { id: cloth.add_collider(&desc)?.to_bits() });
        Ok(())
    })
}

/// Moves a collider to a new pose, which it reaches evenly over the ticks of the next
/// muslin_cloth_advance, or in the next tick of muslin_cloth_step. The motion is swept, so a fast
/// collider does not jump through the cloth.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if it was removed; MUSLIN_STATUS_BAD_VALUE if `position` is not
/// finite or `rotation` is not a unit quaternion
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_move_collider(
    cloth: MuslinCloth,
    collider: MuslinCollider,
    position: MuslinVec3,
    rotation: MuslinQuat,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        let collider = Collider::from_bits(collider.id);
        Ok(cloth.move_collider(collider, position.into(), rotation.into())?)
    })
}

/// Gives a mesh collider new vertices, of the same number and with the same triangles: the body of a
/// character in its next pose.
///
/// Its surface reaches them evenly over the ticks of the next muslin_cloth_advance, or in the next
/// tick of muslin_cloth_step, and is swept on its way: it carries cloth along. Positions are 3 floats
/// each, in the frame of the collider [m]; consecutive ones start `stride` bytes apart (0 means 12; a
/// multiple of 4). muslin_cloth_move_collider moves that frame as before. The first call prepares the
/// mesh for that, which takes as long as adding it.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if the collider was removed; MUSLIN_STATUS_BAD_VALUE if it is no
/// mesh, `count` is not the number of its vertices, a position is not between -1e6 and 1e6 (the
/// message names its index) or `stride` is invalid
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_update_collider(
    cloth: MuslinCloth,
    collider: MuslinCollider,
    positions: *const f32,
    stride: u32,
    count: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        let collider = Collider::from_bits(collider.id);
        // Before the positions are read, so that a wrong count reads no memory.
        cloth.check_collider_vertices(collider, count as usize)?;
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let positions = unsafe { read_vec3s("positions", positions.cast(), stride, count)? };
        Ok(cloth.update_collider(collider, &positions)?)
    })
}

/// Makes the surface of another cloth a collider of this one, or updates it: clothes in layers, the
/// inner one first.
///
/// Call it in each frame between the muslin_cloth_advance of the inner cloth, `other`, and that of the
/// outer one. `inout_collider` starts as {0}: then the collider is added, where `other` is now, and its
/// handle written. With the handle of an earlier call, the collider reaches the present positions of
/// `other` evenly over the ticks of the next muslin_cloth_advance, or in the next tick of
/// muslin_cloth_step, and is swept on its way. It has two sides: this cloth stays on the side where it
/// is. It keeps the mean of both thicknesses away, half of each, and has the mean of both coefficients
/// of friction, as in the call; maps of `other` do not count. Where `other` has torn or been cut
/// since, the collider takes its new triangles, which takes as long as adding it; the handle stays.
///
/// The effect is one-way: `other` does not feel this cloth. Several pieces in one mesh, with
/// MUSLIN_SELF_COLLISION_SURFACE, bear on each other, and nothing passes through; a layer gives no
/// such guarantee where both cloths crumple or are squeezed. The motion since the last call is swept:
/// after a reset or teleport of both cloths, remove the collider and start with {0} again. A save
/// contains the collider, and the handle is valid for the restored cloth too.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if a cloth is not live, or the collider was removed;
/// MUSLIN_STATUS_BAD_VALUE if `other` is the cloth itself, this call did not return the collider, no triangle of
/// `other` has an area, or a particle of it is 1e6 m or more from its origin; MUSLIN_STATUS_FULL if
/// there are 1024 colliders already; MUSLIN_STATUS_BUSY if either cloth is in use on another thread
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_collide_with(
    cloth: MuslinCloth,
    other: MuslinCloth,
    inout_collider: *mut MuslinCollider,
) -> MuslinStatus {
    with_two_cloths(cloth, other, |cloth, other| {
        // SAFETY: by the header's rules, the pointer is NULL or valid for the call.
        let (out, known) =
            unsafe { (Out::new("inout_collider", inout_collider)?, read_optional(inout_collider)) };
        let known = known.filter(|known| known.id != 0);
        let known = known.map(|known| Collider::from_bits(known.id));
        out.write(MuslinCollider { id: cloth.collide_with(other, known)?.to_bits() });
        Ok(())
    })
}

/// Removes a collider. Its handle becomes stale.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if it was removed before
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_remove_collider(
    cloth: MuslinCloth,
    collider: MuslinCollider,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.remove_collider(Collider::from_bits(collider.id))?))
}

/// Reads where a collider is now: after the last tick, or where it was added or teleported to since.
/// A pose of muslin_cloth_move_collider counts once a tick has reached it.
///
/// `out_position` (may be NULL) receives the position [m], `out_rotation` (may be NULL) the
/// rotation.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if it was removed
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_collider_pose(
    cloth: MuslinCloth,
    collider: MuslinCollider,
    out_position: *mut MuslinVec3,
    out_rotation: *mut MuslinQuat,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let (out_position, out_rotation) =
        unsafe { (Out::new_optional(out_position), Out::new_optional(out_rotation)) };
    with_cloth(cloth, |cloth| {
        let (position, rotation) = cloth.collider_pose(Collider::from_bits(collider.id))?;
        out_position.into_iter().for_each(|out| out.write(position.into()));
        out_rotation.into_iter().for_each(|out| out.write(rotation.into()));
        Ok(())
    })
}

/// Reads the impulse that the cloth applied to a collider in the last tick.
///
/// `out_linear` (may be NULL) receives the linear impulse [kg m/s], `out_angular` (may be NULL) the
/// angular impulse about the collider's position [kg m^2/s]. Divided by the length of a tick they
/// are force and torque, for an engine that simulates the collider as a rigid body.
///
/// @return MUSLIN_STATUS_BAD_HANDLE if it was removed
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_collider_impulse(
    cloth: MuslinCloth,
    collider: MuslinCollider,
    out_linear: *mut MuslinVec3,
    out_angular: *mut MuslinVec3,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let (linear, angular) =
        unsafe { (Out::new_optional(out_linear), Out::new_optional(out_angular)) };
    with_cloth(cloth, |cloth| {
        let impulse = cloth.collider_impulse(Collider::from_bits(collider.id))?;
        linear.into_iter().for_each(|out| out.write(impulse.linear.into()));
        angular.into_iter().for_each(|out| out.write(impulse.angular.into()));
        Ok(())
    })
}
