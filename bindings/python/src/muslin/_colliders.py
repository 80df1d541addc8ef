"""Colliders of a cloth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from ._base import ClothBase
from ._convert import (
    NO_ROTATION,
    Quat,
    QuatLike,
    Vec3,
    Vec3Like,
    from_quat,
    from_vec3,
    to_choice,
    to_floats,
    to_number,
    to_quat,
    to_uints,
    to_vec3,
)
from ._errors import bad_value
from ._generated.constants import SHAPES, Shape
from ._generated.structs import MuslinCollider, MuslinColliderDesc, MuslinQuat, MuslinVec3
from ._library import init, lib


@dataclass(frozen=True)
class Collider:
    """Handle of a collider. Valid for the cloth that returned it and for cloths restored from
    it."""

    id: int


@dataclass(frozen=True)
class Pose:
    """Where something is."""

    position: Vec3
    """Position [m]."""
    rotation: Quat
    """Rotation as a unit quaternion x, y, z, w."""


@dataclass(frozen=True)
class Impulse:
    """What a cloth did to a collider in one tick. Divided by the length of a tick they are force
    [N] and torque [N m]."""

    linear: Vec3
    """Linear impulse [kg m/s]."""
    angular: Vec3
    """Angular impulse about the collider's position [kg m^2/s]."""


def _collider(collider: Any) -> MuslinCollider:
    if not isinstance(collider, Collider):
        raise bad_value("collider", "be a Collider")
    return MuslinCollider(collider.id)


class Colliders(ClothBase):
    """Calls that add, move and read colliders."""

    def add_collider(
        self,
        shape: Shape = "plane",
        *,
        position: Vec3Like = (0.0, 0.0, 0.0),
        rotation: QuatLike = NO_ROTATION,
        friction: float | None = None,
        restitution: float | None = None,
        tangential_restitution: float = 1.0,
        thickness: float | None = None,
        radius: float = 0.5,
        top_radius: float | None = None,
        half_height: float = 0.5,
        half_extents: Vec3Like = (0.5, 0.5, 0.5),
        spacing: float = 1.0,
        solid: float = 0.0,
        positions: ArrayLike | None = None,
        indices: ArrayLike | None = None,
        heights: ArrayLike | None = None,
    ) -> Collider:
        """Adds a collider, by default a floor at height 0. It acts from the next tick on.

        - "plane": half-space below `position` along the rotated y axis; infinite in extent.
        - "sphere": sphere of `radius` [m] around `position`.
        - "capsule": along the rotated y axis, spheres of `radius` at -`half_height` and of
          `top_radius` (None: `radius`) at +`half_height` [m], and all between them.
        - "box": extends by `half_extents` [m] to either side of `position` along each rotated axis.
        - "convex": convex hull of `positions` [m], shape (n, 3), from 4 to 1024 points.
        - "mesh": the triangles `indices`, shape (n, 3), over `positions` [m], shape (n, 3). The
          cloth stays on the side where it is: both sides are outside. So the mesh need not be
          closed or consistently wound. The gap is at least 0.1 mm.
        - "heightfield": terrain, all below a surface over a grid of `heights` [m], shape (rows
          along z, columns along x). The heights are `spacing` [m] apart along the rotated x and z
          axes, starting at `position`. The terrain is as deep as it is wide, and has no side walls.

        Fields that the shape does not use are ignored. All arrays are copied.

        `position` is in metres, `rotation` a unit quaternion x, y, z, w. `friction` is a Coulomb
        coefficient, `restitution` the share of the normal velocity that a bounce returns,
        `thickness` the gap between cloth and surface [m]; None: as the material says.
        `tangential_restitution` is the share of the tangential velocity that remains after each
        substep in contact, in addition to Coulomb friction.

        `solid` is the largest depth from which a mesh pushes out particles inside it [m]; 0: both
        sides of its triangles are outside. Above 0 the mesh must be closed and consistently wound.

        Raises `Error` for an invalid field, and if there are 1024 colliders already.
        """
        desc = MuslinColliderDesc()
        init(desc, "muslin_collider_desc_init_sized")
        desc.shape = to_choice(shape, "shape", SHAPES)
        desc.position = to_vec3(position, "position")
        desc.rotation = to_quat(rotation, "rotation")
        desc.half_extents = to_vec3(half_extents, "half_extents")
        numbers = {
            "friction": friction,
            "restitution": restitution,
            "thickness": thickness,
            "tangential_restitution": tangential_restitution,
            "radius": radius,
            "top_radius": top_radius,
            "half_height": half_height,
            "spacing": spacing,
            "solid": solid,
        }
        for name, number in numbers.items():
            if number is not None:
                setattr(desc, name, to_number(number, name))
        lists: list[Any] = []  # alive until the library has copied them
        if positions is not None:
            points = to_floats(positions, "positions", ("n", 3))
            desc.positions, desc.vertex_count = points.ctypes.data, len(points)
            lists.append(points)
        if indices is not None:
            triangles = to_uints(indices, "indices", ("n", 3))
            desc.indices, desc.index_count = triangles.ctypes.data, triangles.size
            lists.append(triangles)
        if heights is not None:
            terrain = to_floats(heights, "heights", ("rows", "columns"))
            desc.heights = terrain.ctypes.data
            desc.rows, desc.columns = terrain.shape
            lists.append(terrain)
        handle = MuslinCollider()
        lib.muslin_cloth_add_collider(self._live, desc, handle)
        return Collider(handle.id)

    def move_collider(
        self, collider: Collider, position: Vec3Like, rotation: QuatLike = NO_ROTATION
    ) -> None:
        """Moves a collider to a new pose, which it reaches evenly over the ticks of the next
        `advance`, or in the next tick of `step`. The motion is swept, so a fast collider does not
        jump through the cloth."""
        pose = (to_vec3(position, "position"), to_quat(rotation, "rotation"))
        lib.muslin_cloth_move_collider(self._live, _collider(collider), *pose)

    def teleport_collider(
        self, collider: Collider, position: Vec3Like, rotation: QuatLike = NO_ROTATION
    ) -> None:
        """Places a collider at a new pose at once, without a sweep and without dragging the cloth
        along."""
        pose = (to_vec3(position, "position"), to_quat(rotation, "rotation"))
        lib.muslin_cloth_teleport_collider(self._live, _collider(collider), *pose)

    def update_collider(self, collider: Collider, positions: ArrayLike) -> None:
        """Gives a mesh collider new vertices, of the same number and with the same triangles: the
        body of a character in its next pose. `positions` has shape (n, 3), in the frame of the
        collider [m].

        Its surface reaches them evenly over the ticks of the next `advance`, or in the next tick of
        `step`, and is swept on its way: it carries cloth along. `move_collider` moves that frame as
        before. The first call prepares the mesh for that, which takes as long as adding it.

        Raises `Error` if the collider is no mesh, the number of vertices differs, or a position is
        not between -1e6 and 1e6 (the text names its index).
        """
        rows = to_floats(positions, "positions", ("n", 3))
        data = (_collider(collider), rows.ctypes.data, 0, len(rows))
        lib.muslin_cloth_update_collider(self._live, *data)

    def collide_with(self, other: ClothBase, collider: Collider | None = None) -> Collider:
        """Makes the surface of another cloth a collider of this one, or updates it: clothes in
        layers, the inner one first.

        Call it in each frame between the `advance` of the inner cloth, `other`, and that of the
        outer one. Without `collider` one is added, where `other` is now. With that of an earlier
        call, it reaches the present positions of `other` evenly over the ticks of the next
        `advance`, or in the next tick of `step`, and is swept on its way. Returns the collider.

            layer = None
            for frame in range(60):
                shirt.advance(1 / 60)
                layer = coat.collide_with(shirt, layer)
                coat.advance(1 / 60)

        It has two sides: this cloth stays on the side where it is. It keeps the mean of both
        thicknesses away, half of each, and has the mean of both coefficients of friction, as in the
        call; maps of `other` do not count. Where `other` has torn or been cut since, the collider
        takes its new triangles, which takes as long as adding it; the handle stays.

        The effect is one-way: `other` does not feel this cloth. Several pieces in one mesh, with
        self-collision "surface", bear on each other, and nothing passes through; a layer gives no
        such guarantee where both cloths crumple or are squeezed. After a reset or teleport of both
        cloths, remove the collider and start without one again.
        """
        if not isinstance(other, ClothBase):
            raise bad_value("other", "be a Cloth")
        if other.closed:
            raise bad_value("other", "be open, but was closed")
        handle = MuslinCollider() if collider is None else _collider(collider)
        lib.muslin_cloth_collide_with(self._live, other._live, handle)
        return Collider(handle.id)

    def remove_collider(self, collider: Collider) -> None:
        """Removes a collider. Its handle becomes stale."""
        lib.muslin_cloth_remove_collider(self._live, _collider(collider))

    def collider_pose(self, collider: Collider) -> Pose:
        """Returns where a collider is now: after the last tick, or where it was added or teleported
        to since. A pose of `move_collider` counts once a tick has reached it."""
        position, rotation = MuslinVec3(), MuslinQuat()
        handle = _collider(collider)
        lib.muslin_cloth_get_collider_pose(self._live, handle, position, rotation)
        return Pose(from_vec3(position), from_quat(rotation))

    def collider_impulse(self, collider: Collider) -> Impulse:
        """Returns the impulse that the cloth applied to a collider in the last tick."""
        linear, angular = MuslinVec3(), MuslinVec3()
        handle = _collider(collider)
        lib.muslin_cloth_get_collider_impulse(self._live, handle, linear, angular)
        return Impulse(from_vec3(linear), from_vec3(angular))
