"""Rays and grabs; tears, cuts, creases and seams."""

from __future__ import annotations

import math
from ctypes import byref, c_uint32
from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from ._base import ClothBase
from ._convert import (
    Vec3,
    Vec3Like,
    from_vec3,
    to_choice,
    to_number,
    to_uint,
    to_uints,
    to_vec3,
)
from ._errors import bad_value
from ._generated.constants import SEW_KINDS, SewKind, Status
from ._generated.records import Hit
from ._generated.structs import MuslinGrab, MuslinSewDesc, MuslinVec3
from ._library import init, lib


@dataclass(frozen=True)
class Grab:
    """Handle of a grab of one particle. Valid for the cloth that returned it and for cloths
    restored from it."""

    id: int


def _grab(grab: Any) -> MuslinGrab:
    if not isinstance(grab, Grab):
        raise bad_value("grab", "be a Grab")
    return MuslinGrab(grab.id)


class Topology(ClothBase):
    """Calls that pick, pull, tear, cut, fold and sew."""

    def raycast(
        self, origin: Vec3Like, direction: Vec3Like, max_distance: float = math.inf
    ) -> Hit | None:
        """Returns the first triangle that a ray hits within `max_distance` [m], from either side;
        None if it hits none. `direction` need not have length 1."""
        ray = (to_vec3(origin, "origin"), to_vec3(direction, "direction"))
        hit, limit = Hit._empty(), to_number(max_distance, "max_distance")
        if lib.muslin_cloth_raycast(self._live, *ray, limit, hit) == Status.NOTHING_HIT:
            return None
        return Hit._from_c(hit)

    def grab_ray(
        self, origin: Vec3Like, direction: Vec3Like, radius: float = 0.0
    ) -> tuple[Grab, Vec3] | None:
        """Grabs the particle that a ray points at: the nearest corner of the first triangle that
        the ray hits; if it hits none, the particle nearest to the ray within `radius` [m]. Returns
        the grab and the position of the particle [m], or None if there is no such particle. See
        `grab_particle`.

        Raises `Error` if there are 64 grabs already.
        """
        ray = (to_vec3(origin, "origin"), to_vec3(direction, "direction"))
        grab, at, reach = MuslinGrab(), MuslinVec3(), to_number(radius, "radius")
        status = lib.muslin_cloth_grab_ray(self._live, *ray, reach, grab, at)
        return None if status == Status.NOTHING_HIT else (Grab(grab.id), from_vec3(at))

    def grab_particle(self, particle: int) -> Grab:
        """Grabs a particle at its current position.

        The particle then follows the target of `move_grab` exactly, at most `max_displacement` per
        substep, and pulls the cloth along. Raises `Error` if there are 64 grabs already.
        """
        grab = MuslinGrab()
        lib.muslin_cloth_grab_particle(self._live, to_uint(particle, "particle"), grab)
        return Grab(grab.id)

    def move_grab(self, grab: Grab, target: Vec3Like) -> None:
        """Sets the target of a grab [m]. Within the speed limit the particle reaches it evenly over
        the ticks of the next `advance`, or in the next tick of `step`."""
        lib.muslin_cloth_move_grab(self._live, _grab(grab), to_vec3(target, "target"))

    def release(self, grab: Grab) -> None:
        """Releases a grabbed particle, which keeps its velocity. A pinned particle stays pinned and
        returns to its pin evenly over the ticks of the next `advance`, or in the next tick of
        `step`."""
        lib.muslin_cloth_release(self._live, _grab(grab))

    def tear_edge(self, particle_a: int, particle_b: int) -> bool:
        """Tears the cloth between two neighbouring particles, as over-stretching does, and returns
        whether it tore. It does not if both ends are pinned or grabbed, or the edge is already a
        border.

        The particle under the higher load is split by the plane that is perpendicular to the edge.
        If neither particle has triangles on its other side, the edge itself opens, provided that it
        starts at a border. Raises `Error` unless the two are the ends of an edge, and if the
        reserve for tears (`extra_particles`) is used up.
        """
        edge = (to_uint(particle_a, "particle_a"), to_uint(particle_b, "particle_b"))
        return bool(lib.muslin_cloth_tear_edge(self._live, *edge) == Status.OK)

    def cut(self, from_: Vec3Like, to: Vec3Like, sweep: Vec3Like) -> int:
        """Cuts the cloth with a blade: the segment from `from_` to `to` [m], swept along `sweep`
        [m]. Returns the number of opened edges; 0 means that the blade missed and nothing changed.

        - Triangles that the blade crosses are divided along it: new vertices lie on the crossed
          edges, with attributes interpolated between the edge's ends, and the mesh opens along
          them.
        - The cut goes through an existing vertex instead if it would pass closer than an eighth of
          an edge, or would leave a triangle with an angle below 5 degrees or with less than 1/200
          of the area of a square of the mean edge. It does not snap to a pinned vertex; it passes
          it at an eighth of the edge.
        - Where the blade ends inside a triangle, the cut ends at the edge before it.
        - New vertices are free; a pinned vertex that the cut goes through is pinned on both sides.
        - Mass and rest area are conserved.
        - Each crossed edge uses one particle of the reserve (`extra_particles`), and one more if it
          opens.

        Raises `Error` if `to` equals `from_`, if `sweep` is zero or parallel to the segment, or if
        the reserve cannot hold the whole cut; the cloth is unchanged then.
        """
        edges = c_uint32()
        blade = (to_vec3(from_, "from"), to_vec3(to, "to"), to_vec3(sweep, "sweep"))
        lib.muslin_cloth_cut(self._live, *blade, byref(edges))
        return edges.value

    def crease(self, from_: Vec3Like, to: Vec3Like, angle: float) -> None:
        """Adds a fold of `angle` [rad] to the rest shape, along the line from `from_` to `to` [m].
        Both points are given on the cloth as it was made.

        - A positive angle folds towards the front of the cloth (the side from which triangles are
          counter-clockwise), a negative one away from it.
        - The line need not follow the mesh: the fold is distributed over the cells beside it. A
          line that misses the cloth has no effect.
        - The cloth bends only as far as `bend_stiffness` can turn it.
        - The fold lasts until `reset`; a second crease of -`angle` along the same line removes it.

        Raises `Error` if `to` equals `from_`, or if `angle` is not from -3 to 3.
        """
        line = (to_vec3(from_, "from"), to_vec3(to, "to"))
        lib.muslin_cloth_crease(self._live, *line, to_number(angle, "angle"))

    def sew(
        self,
        pairs: ArrayLike,
        *,
        speed: float = 0.5,
        kind: SewKind = "weld",
        tear_force: float = 0.0,
    ) -> None:
        """Sews pairs of particles together: draws each pair together at `speed` [m/s], and joins it
        when its distance is zero. `pairs` has shape (n, 2).

        Joined particles have one position and one velocity after every tick, and move as one
        particle with the mass of both.

        - `kind` "weld": as if woven in one piece. It never tears, and normals are smooth across.
          "stitch": a thread. It tears under more than `tear_force` [N] on one pair, as the mean
          over a tick (0: never), and keeps the normals of both sides apart.
        - Particles may be in several pairs, as where three panels meet.
        - Pairs do not collide with each other. A held particle draws the other one to it.
        - Two held particles stay where they are; `over_stretched` of `Stats` counts the pair and
          `HeldApart` reports it.
        - Particles, vertices and triangles stay as they are. A weld is invisible.
        - A stitch that tears gives `StitchTorn`.
        - `reset` keeps the pairs and draws them together again from the rest shape.

        Raises `Error` if two particles of a pair are equal, do not exist or have no triangle.
        """
        rows, desc = to_uints(pairs, "pairs", ("n", 2)), MuslinSewDesc()
        init(desc, "muslin_sew_desc_init_sized")
        desc.speed = to_number(speed, "speed")
        desc.kind = to_choice(kind, "kind", SEW_KINDS)
        desc.tear_force = to_number(tear_force, "tear_force")
        lib.muslin_cloth_sew(self._live, rows.ctypes.data, len(rows), desc)
