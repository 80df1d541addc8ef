"""What holds particles: pins, attachments, anchors; the frame of the body that wears the cloth."""

from __future__ import annotations

from ctypes import byref, c_uint32
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._base import ClothBase
from ._convert import (
    NO_ROTATION,
    QuatLike,
    Vec3Like,
    check_length,
    to_floats,
    to_number,
    to_quat,
    to_uint,
    to_uints,
    to_vec3,
)
from ._errors import bad_value
from ._generated.structs import MuslinAttachment
from ._library import lib


@dataclass(frozen=True)
class Attachment:
    """Handle of an attachment: a transform that carries particles. Valid for the cloth that
    returned it and for cloths restored from it."""

    id: int


def _attachment(attachment: Any) -> MuslinAttachment:
    if not isinstance(attachment, Attachment):
        raise bad_value("attachment", "be an Attachment")
    return MuslinAttachment(attachment.id)


class Pins(ClothBase):
    """Calls that hold particles."""

    @property
    def pinned(self) -> NDArray[np.uint32]:
        """The pinned particles, in ascending order. The array is your own."""
        count = c_uint32()
        lib.muslin_cloth_get_pins(self._live, None, 0, byref(count))
        particles = np.empty(count.value, np.uint32)
        lib.muslin_cloth_get_pins(self._live, particles.ctypes.data, count.value, byref(count))
        return particles

    def pin(self, particle: int, target: Vec3Like | None = None) -> None:
        """Pins a particle at `target` [m], or at its current position.

        The particle reaches the target evenly over the ticks of the next `advance`, or in the next
        tick of `step`. If it is already pinned, the target changes and the stiffness stays; an
        attached particle leaves its attachment.
        """
        index = to_uint(particle, "particle")
        at = None if target is None else to_vec3(target, "target")
        lib.muslin_cloth_pin(self._live, index, at)

    def unpin(self, particle: int) -> None:
        """Releases a pinned particle, which keeps its velocity. Has no effect on a particle that is
        not pinned."""
        lib.muslin_cloth_unpin(self._live, to_uint(particle, "particle"))

    def unpin_all(self) -> None:
        """Releases all pinned particles."""
        lib.muslin_cloth_unpin_all(self._live)

    def set_pin_targets(self, particles: ArrayLike, targets: ArrayLike) -> None:
        """Sets the targets of many pins at once [m], e.g. every frame for an animated edge.
        Particles that are not pinned yet become pinned. They reach their targets as those of `pin`.

        `particles` has shape (n,), `targets` (n, 3).
        """
        which = to_uints(particles, "particles", ("n",))
        rows = to_floats(targets, "targets", ("n", 3))
        check_length(rows, "targets", len(which), "particles")
        data = (which.ctypes.data, rows.ctypes.data, 0, len(which))
        lib.muslin_cloth_set_pin_targets(self._live, *data)

    def pin_targets(self, particles: ArrayLike | None = None) -> NDArray[np.float32]:
        """Returns the targets of pins [m], shape (n, 3), in an array of your own; by default those
        of `pinned`. Targets of attached particles follow from the pose of their attachment."""
        which = self.pinned if particles is None else to_uints(particles, "particles", ("n",))
        out = np.empty((len(which), 3), np.float32)
        data = (which.ctypes.data, out.ctypes.data, 0, len(which))
        lib.muslin_cloth_get_pin_targets(self._live, *data)
        return out

    def set_pin_stiffness(self, particles: ArrayLike, stiffness: float) -> None:
        """Sets the stiffness [N/m] with which pins pull particles towards their targets. 0, the
        initial value, holds them exactly; above 0 the pin is a spring.

        - A load of 1 N moves a soft pin's particle 1/`stiffness` metres from its target: 1e3 N/m
          feels firm, 10 N/m lets a sheet of cotton sag by a few centimetres.
        - For tears and `max_stretch` the cloth counts as free at a soft pin, and it is not tethered
          to it.
        - A tear through a soft pin divides its stiffness in proportion to mass.
        """
        which = to_uints(particles, "particles", ("n",))
        value = to_number(stiffness, "stiffness")
        lib.muslin_cloth_set_pin_stiffness(self._live, which.ctypes.data, len(which), value)

    def attach(
        self, particles: ArrayLike, position: Vec3Like, rotation: QuatLike = NO_ROTATION
    ) -> Attachment:
        """Attaches particles to a transform, e.g. a bone, a pole or a car body. They are pinned at
        their current positions; `move_attachment` moves them.

        - A particle that is already pinned, or attached to another transform, keeps its stiffness
          and moves to this attachment.
        - A particle leaves the attachment when it gets a pin target of its own or is unpinned.
        - A tear or cut through attached particles attaches the new particles too.
        - `reset` removes all attachments.

        `position` is in metres, `rotation` a unit quaternion x, y, z, w. Raises `Error` if there
        are 64 attachments already.
        """
        which, handle = to_uints(particles, "particles", ("n",)), MuslinAttachment()
        pose = (to_vec3(position, "position"), to_quat(rotation, "rotation"))
        lib.muslin_cloth_attach(self._live, which.ctypes.data, len(which), *pose, handle)
        return Attachment(handle.id)

    def move_attachment(
        self, attachment: Attachment, position: Vec3Like, rotation: QuatLike = NO_ROTATION
    ) -> None:
        """Moves an attachment: its particles reach the new pose evenly over the ticks of the next
        `advance`, or in the next tick of `step`. They rotate with the transform on the way, and are
        exactly there at the end."""
        pose = (to_vec3(position, "position"), to_quat(rotation, "rotation"))
        lib.muslin_cloth_move_attachment(self._live, _attachment(attachment), *pose)

    def detach(self, attachment: Attachment) -> None:
        """Removes an attachment and unpins the particles that it still carries; they keep their
        velocities."""
        lib.muslin_cloth_detach(self._live, _attachment(attachment))

    def set_max_distances(self, particles: ArrayLike, distances: ArrayLike) -> None:
        """Limits how far particles may be from their anchors [m]. The limit holds after every tick,
        whatever pulls at the particle.

        - Infinity, the initial value, means no limit; 0 fixes the particle to its anchor.
        - The anchor of a particle is the position of the last `set_anchors`; before the first one,
          it is the particle's current position.
        - Pins and grabs take precedence over the limit.
        - A limit may stretch the cloth past `max_stretch`; this is reported as for pins, in `Stats`
          and by `HeldApart`.
        - `reset` removes all limits.
        """
        which = to_uints(particles, "particles", ("n",))
        limits = to_floats(distances, "distances", ("n",))
        check_length(limits, "distances", len(which), "particles")
        data = (which.ctypes.data, limits.ctypes.data, len(which))
        lib.muslin_cloth_set_max_distances(self._live, *data)

    def set_backstops(self, particles: ArrayLike, distances: ArrayLike, radii: ArrayLike) -> None:
        """Gives particles backstops: spheres behind their anchors that the particles cannot enter,
        so that a garment does not sink into the body that wears it.

        Each sphere has a radius [m], 0 for none. Its surface is the given distance [m] behind the
        anchor, opposite to the normal of `set_anchors`; a particle without a normal has no
        backstop.
        """
        which = to_uints(particles, "particles", ("n",))
        behind = to_floats(distances, "distances", ("n",))
        sizes = to_floats(radii, "radii", ("n",))
        check_length(behind, "distances", len(which), "particles")
        check_length(sizes, "radii", len(which), "particles")
        data = (which.ctypes.data, behind.ctypes.data, sizes.ctypes.data, len(which))
        lib.muslin_cloth_set_backstops(self._live, *data)

    def set_anchors(
        self, particles: ArrayLike, positions: ArrayLike, normals: ArrayLike | None = None
    ) -> None:
        """Sets the animated positions [m] and outward normals of particles, for
        `set_max_distances` and `set_backstops`. Call it once per frame.

        Anchors move to the new positions evenly over the ticks of the next `advance`, or in the
        next tick of `step`; a particle's first anchor is in place at once. `positions` and
        `normals` have shape (n, 3). Normals need not have length 1; None keeps the previous ones.
        """
        which = to_uints(particles, "particles", ("n",))
        rows = to_floats(positions, "positions", ("n", 3))
        check_length(rows, "positions", len(which), "particles")
        outward = None if normals is None else to_floats(normals, "normals", ("n", 3))
        if outward is not None:
            check_length(outward, "normals", len(which), "particles")
        address = None if outward is None else outward.ctypes.data
        data = (which.ctypes.data, rows.ctypes.data, address, 0, len(which))
        lib.muslin_cloth_set_anchors(self._live, *data)

    def clear_leashes(self) -> None:
        """Removes all anchors, maximum distances and backstops."""
        lib.muslin_cloth_clear_leashes(self._live)

    def set_frame(self, position: Vec3Like, rotation: QuatLike = NO_ROTATION) -> None:
        """Sets the pose of the body that wears the cloth, the start for `teleport` and
        `move_frame`. Moves nothing.

        The initial pose, also after `reset`, is the origin without rotation.
        """
        pose = (to_vec3(position, "position"), to_quat(rotation, "rotation"))
        lib.muslin_cloth_set_frame(self._live, *pose)

    def teleport(self, position: Vec3Like, rotation: QuatLike = NO_ROTATION) -> None:
        """Moves the cloth with the body that wears it to a new pose at once, as a rigid body and
        without inertia. Velocities rotate with it.

        The motion starts at the pose of the last `set_frame`, `move_frame` or `teleport`. Pins,
        attachments, grabs and anchors move too; colliders do not, see `teleport_collider`. In a
        frame, call this before `move_attachment` and `set_anchors`.
        """
        pose = (to_vec3(position, "position"), to_quat(rotation, "rotation"))
        lib.muslin_cloth_teleport(self._live, *pose)

    def move_frame(
        self, position: Vec3Like, rotation: QuatLike = NO_ROTATION, inertia: float = 0.0
    ) -> None:
        """Moves the cloth with the body that wears it to a new pose over the ticks of the next
        `advance`, or in the next tick of `step`; the cloth feels only the share `inertia` of the
        motion, from 0 to 1.

        - 1: the cloth feels the whole motion, as without this call.
        - 0: the cloth feels nothing, as if the body stood still and the world moved.
        - Between: it feels this share of the translation and of the rotation.

        The motion starts at the pose of the last `set_frame`, `teleport` or `move_frame`. The part
        that is not felt moves particles at once, as a rigid body. Pins, attachments and anchors
        reach the body's new pose evenly over these ticks. Colliders and grabs stay at the poses
        that you give; the cloth meets them with the velocity that they have relative to the body.
        The air moves with the body by the share that is not felt.

        In a frame, call this before `move_attachment`, `move_collider` and `set_anchors`.
        """
        pose = (to_vec3(position, "position"), to_quat(rotation, "rotation"))
        lib.muslin_cloth_move_frame(self._live, *pose, to_number(inertia, "inertia"))
