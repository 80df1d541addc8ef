"""Positions, velocities, masses and painted maps of particles."""

from __future__ import annotations

from ctypes import byref, c_float, c_uint32
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._base import ClothBase
from ._convert import (
    Vec3,
    Vec3Like,
    check_length,
    from_vec3,
    to_choice,
    to_floats,
    to_uint,
    to_uints,
    to_vec3,
)
from ._errors import Error, bad_value
from ._generated.constants import MAPS, MapName, Status
from ._generated.structs import MuslinVec3
from ._library import lib
from ._views import lists_of


@dataclass(frozen=True)
class MassProperties:
    """Mass, center of mass and momentum of a whole cloth, pinned particles included."""

    total: float
    """Mass [kg]."""
    center: Vec3
    """Center of mass [m]."""
    momentum: Vec3
    """Sum of mass times velocity [kg m/s]."""


class Particles(ClothBase):
    """Calls that read and set what belongs to particles."""

    @property
    def particle_count(self) -> int:
        """Number of particles. Tears and cuts add some."""
        return int(lists_of(self, "particles").max()) + 1

    def position(self, particle: int) -> Vec3:
        """Returns the position of a particle [m]."""
        index, particles = to_uint(particle, "particle"), lists_of(self, "particles")
        vertices = np.flatnonzero(particles == index)
        if len(vertices) == 0:
            count = int(particles.max()) + 1
            raise Error(Status.BAD_INDEX, f"`particle` must be below {count}, but is {index}")
        x, y, z = lists_of(self, "positions")[vertices[0]].tolist()
        return x, y, z

    def velocity(self, particle: int) -> Vec3:
        """Returns the velocity of a particle [m/s]."""
        index = to_uint(particle, "particle")
        x, y, z = self._vectors(lib.muslin_cloth_get_velocities, index, 1)[0].tolist()
        return x, y, z

    @property
    def velocities(self) -> NDArray[np.float32]:
        """Velocities of all particles [m/s], shape (particles, 3). The array is your own."""
        return self._vectors(lib.muslin_cloth_get_velocities, 0, self.particle_count)

    @property
    def rest_positions(self) -> NDArray[np.float32]:
        """Positions of all particles in the rest shape [m], shape (particles, 3): where they were
        when the cloth was made, whatever moved them since. The array is your own.

        A particle that a tear split off has the position of its source; one that a cut added has
        the point of the rest edge that was cut.
        """
        return self._vectors(lib.muslin_cloth_get_rest_positions, 0, self.particle_count)

    def _vectors(self, read: Any, first: int, count: int) -> NDArray[np.float32]:
        out = np.empty((count, 3), np.float32)
        read(self._live, first, count, out.ctypes.data, 0)
        return out

    def set_position(self, particle: int, position: Vec3Like) -> None:
        """Places a particle at `position` [m] at once. Its velocity stays as it is. A pinned
        particle stays pinned, at the new position."""
        index, at = to_uint(particle, "particle"), to_vec3(position, "position")
        lib.muslin_cloth_set_position(self._live, index, at)

    def set_velocity(self, particle: int, velocity: Vec3Like) -> None:
        """Sets the velocity of a particle [m/s]."""
        index, vector = to_uint(particle, "particle"), to_vec3(velocity, "velocity")
        lib.muslin_cloth_set_velocity(self._live, index, vector)

    def set_positions(self, positions: ArrayLike, first: int = 0) -> None:
        """Places particles at once [m], from `first` on: a whole pose, if there is a row for every
        particle. `positions` has shape (n, 3).

        Velocities stay as they are; call `set_velocities` too to continue from a recorded state.
        Pinned particles stay pinned, at the new positions. Raises `Error` if there are more rows
        than particles from `first` on, or if a position is not finite; the text names it.
        """
        rows = to_floats(positions, "positions", ("n", 3))
        self._set_vectors(lib.muslin_cloth_set_positions, first, rows)

    def set_velocities(self, velocities: ArrayLike, first: int = 0) -> None:
        """Sets the velocities of particles [m/s], from `first` on, as `set_positions` does."""
        rows = to_floats(velocities, "velocities", ("n", 3))
        self._set_vectors(lib.muslin_cloth_set_velocities, first, rows)

    def _set_vectors(self, write: Any, first: int, rows: NDArray[np.float32]) -> None:
        write(self._live, to_uint(first, "first"), len(rows), rows.ctypes.data, 0)

    @property
    def mass_properties(self) -> MassProperties:
        """Mass, center of mass and momentum of the whole cloth, computed on each call."""
        total, center, momentum = c_float(), MuslinVec3(), MuslinVec3()
        lib.muslin_cloth_get_mass(self._live, byref(total), center, momentum)
        return MassProperties(total.value, from_vec3(center), from_vec3(momentum))

    def set_mass_scales(self, particles: ArrayLike, scales: ArrayLike) -> None:
        """Multiplies the masses of particles by factors, from 0.001 to 1000, one for each: 1, the
        initial value, keeps the mass that density and surrounding area give. A hem hangs straight
        at about 5; a coin that is sewn in may be 100.

        Factors stay when the density changes. Neighbours may differ by a factor of 100; at factors
        in the thousands, light particles that carry heavy ones stretch unless `substeps` is raised.
        """
        which = to_uints(particles, "particles", ("n",))
        factors = to_floats(scales, "scales", ("n",))
        check_length(factors, "scales", len(which), "particles")
        data = (which.ctypes.data, factors.ctypes.data, len(which))
        lib.muslin_cloth_set_mass_scales(self._live, *data)

    def set_map(self, map: MapName, scales: ArrayLike | None) -> None:
        """Paints a property: multiplies what the material says by one scale per particle, from 0 to
        1000; 1 is as the material says. None takes the map away.

        - "stretch": stiffness against stretch and shear. Links without compliance (a stiffness of
          0) stay rigid; at scale 0 other links do not resist.
        - "bend": bending rigidity; at scale 0 the cloth is limp. Does not act on a `bend_stiffness`
          from 1 on.
        - "tear": strength, the strain at which an edge tears. At scale 0 an edge tears as soon as
          it is stretched at all; a large scale keeps it from tearing.
        - "friction": coefficient of friction of contacts with colliders and of surface
          self-collision.
        - "thickness": distance from colliders and between layers in self-collision.
        - "drag": drag coefficient; lift stays as it is.

        A link, a hinge or a triangle takes the mean of the scales at its corners; a contact
        interpolates them at its point, and two layers take the mean of both sides. Maps stay when
        the material changes and when the cloth is reset. A particle that a tear splits off takes
        the scale of its source; one that a cut adds to an edge takes the scale between those of its
        ends.
        """
        number = to_choice(map, "map", MAPS)
        if scales is None:
            lib.muslin_cloth_set_map(self._live, number, None, 0)
        else:
            painted, count = to_floats(scales, "scales", ("n",)), self.particle_count
            if len(painted) != count:
                rule = f"have {count} entries, one per particle, but has {len(painted)}"
                raise bad_value("scales", rule)
            lib.muslin_cloth_set_map(self._live, number, painted.ctypes.data, len(painted))

    def map(self, map: MapName) -> NDArray[np.float32] | None:
        """Returns the scales of a painted map, one per particle, in an array of your own; None if
        the map is not set."""
        number, is_set = to_choice(map, "map", MAPS), c_uint32()
        lib.muslin_cloth_get_map(self._live, number, None, 0, byref(is_set))
        if not is_set.value:
            return None
        scales = np.empty(self.particle_count, np.float32)
        lib.muslin_cloth_get_map(self._live, number, scales.ctypes.data, len(scales), None)
        return scales
