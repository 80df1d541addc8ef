"""The class Cloth: how a cloth is made and saved. Its other calls are in its base classes."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import POINTER, byref, c_size_t, create_string_buffer, sizeof
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._colliders import Colliders
from ._convert import (
    Vec3Like,
    set_triangles,
    to_choice,
    to_number,
    to_uint,
    to_uints,
    to_vec3,
)
from ._errors import Error, bad_value
from ._generated.constants import AS_MANY_AGAIN, PIN_MODES, PinMode
from ._generated.records import Settings
from ._generated.structs import (
    MuslinCloth,
    MuslinGridDesc,
    MuslinMaterial,
    MuslinMeshDesc,
    MuslinSettings,
)
from ._library import lib
from ._outputs import Outputs
from ._parameters import MaterialLike, Parameters, material_to_c, record_to_c
from ._particles import Particles
from ._pins import Pins
from ._skin import Skin
from ._topology import Topology


class Cloth(Parameters, Particles, Pins, Topology, Colliders, Outputs):
    """A cloth: particles joined by links, made by `Cloth.grid`, `Cloth.mesh` or `Cloth.restore`.

    Units are metres, kilograms, seconds and radians; right-handed, y up by default. A refused call
    raises `Error` and changes nothing.

    A cloth simulates particles and draws vertices. On grids and on clean meshes both have the same
    numbers; on a mesh that was welded or split, `vertex_particles` gives the particle of each
    vertex.

    Different cloths may be used on different threads at once; ticks of both run at the same time.
    A call on a cloth that another thread is using is refused with `Status.BUSY`. `copy.deepcopy`
    and `pickle` copy a cloth by `save` and `restore`.
    """

    def __init__(self) -> None:
        raise TypeError("a cloth is made by Cloth.grid(), Cloth.mesh() or Cloth.restore()")

    @classmethod
    def _of(cls, handle: MuslinCloth) -> Cloth:
        cloth = cls.__new__(cls)
        cloth._own(handle)
        return cloth

    @classmethod
    def grid(
        cls,
        columns: int = 40,
        rows: int = 40,
        spacing: float = 0.05,
        *,
        origin: Vec3Like = (0.0, 0.0, 0.0),
        right: Vec3Like = (1.0, 0.0, 0.0),
        down: Vec3Like = (0.0, -1.0, 0.0),
        pin_mode: PinMode = "top-edge",
        extra_particles: int | None = None,
        material: MaterialLike | None = None,
        settings: Settings | None = None,
    ) -> Cloth:
        """Makes a cloth from a regular grid. The particle at row r and column c has the number
        r * columns + c.

        - `columns`, `rows`: particles per row, and rows; at least 2, at most 4194304 particles.
        - `spacing`: distance between neighbours [m], from 1e-6 to 1e6.
        - `origin`: position of particle 0, the top left corner [m].
        - `right`, `down`: unit directions along a row and along a column, perpendicular.
        - `pin_mode`: particles that are pinned from the start: "none", "top-edge", "top-corners" or
          "corners".
        - `extra_particles`: particles to reserve for tears and cuts; None: as many again, 0 if the
          cloth never tears.
        - `material`: a `Material` or the name of a preset; None: the defaults of `Material`.
        - `settings`: None: the defaults of `Settings`.

        Raises `Error` for an invalid field.
        """
        desc = MuslinGridDesc()
        sizes = (sizeof(desc), sizeof(MuslinMaterial), sizeof(MuslinSettings))
        lib.muslin_grid_desc_init_sized(desc, *sizes)
        desc.columns = to_uint(columns, "columns")
        desc.rows = to_uint(rows, "rows")
        desc.spacing = to_number(spacing, "spacing")
        desc.origin = to_vec3(origin, "origin")
        desc.right = to_vec3(right, "right")
        desc.down = to_vec3(down, "down")
        desc.pin_mode = to_choice(pin_mode, "pin_mode", PIN_MODES)
        _set_common(desc, extra_particles, material, settings)
        handle = MuslinCloth()
        lib.muslin_cloth_create_grid(desc, handle)
        return cls._of(handle)

    @classmethod
    def mesh(
        cls,
        positions: ArrayLike,
        indices: ArrayLike,
        *,
        uvs: ArrayLike | None = None,
        pinned: ArrayLike | None = None,
        weld_distance: float | None = None,
        simplify_below: float = 0.0,
        extra_particles: int | None = None,
        material: MaterialLike | None = None,
        settings: Settings | None = None,
    ) -> Cloth:
        """Makes a cloth from any triangle mesh, as modelling tools export them. Its arrays are
        copied. Defects of the mesh are repaired, see `mesh_report`.

        - `positions`: rest positions of the vertices [m], shape (n, 3).
        - `indices`: vertices of the triangles, shape (n, 3), counter-clockwise seen from the front.
        - `uvs`: texture coordinates, shape (vertices, 2); None: zeros.
        - `pinned`: vertices whose particles are pinned from the start.
        - `weld_distance`: vertices at most this far apart share one particle [m]; 0 welds vertices
          at exactly the same position, None welds nothing. Choose a value well below the shortest
          edge.
        - `simplify_below`: edges shorter than this are collapsed [m]; 0 collapses none. At most the
          mean length of the edges. One end of such an edge moves to the other, with its vertices;
          triangles that are lower than this get another diagonal where that makes them higher.
          Borders, seams of texture coordinates and their corners stay, and so does the topology;
          `short_edges` of `mesh_report` counts the edges that are short nevertheless. A tenth to a
          third of the mean edge removes the slivers of most meshes.
        - `extra_particles`, `material`, `settings`: as in `grid`.

        Vertices that no triangle uses stay where they are. A mesh that is a regular grid, with
        vertices and triangles in the order of `grid`, is simulated as that grid, with identical
        bits.

        Raises `Error` for an invalid field, and if the mesh cannot be repaired: a triangle has an
        area that is not finite, or no triangle has an area.
        """
        desc = MuslinMeshDesc()
        sizes = (sizeof(desc), sizeof(MuslinMaterial), sizeof(MuslinSettings))
        lib.muslin_mesh_desc_init_sized(desc, *sizes)
        _kept = set_triangles(desc, positions, indices, uvs)
        held = None if pinned is None else to_uints(pinned, "pinned", ("n",))
        if held is not None:
            desc.pinned, desc.pinned_count = held.ctypes.data, len(held)
        if weld_distance is not None:
            desc.weld_distance = to_number(weld_distance, "weld_distance")
        desc.simplify_below = to_number(simplify_below, "simplify_below")
        _set_common(desc, extra_particles, material, settings)
        handle = MuslinCloth()
        lib.muslin_cloth_create_mesh(desc, handle)
        return cls._of(handle)

    @classmethod
    def restore(cls, buffer: bytes | bytearray | memoryview) -> Cloth:
        """Makes a cloth from the bytes of `save`, perhaps of another platform. It continues with
        the same bits.

        Handles of grabs, attachments and colliders are valid for the new cloth too. Untrusted bytes
        are safe. Raises `Error` if the bytes are not a save, come from another format version, or
        are damaged.
        """
        try:
            data = np.frombuffer(buffer, np.uint8)
        except (TypeError, ValueError, BufferError):
            raise bad_value("buffer", "be bytes, at least one") from None
        handle = MuslinCloth()
        lib.muslin_cloth_restore(data.ctypes.data, data.size, handle)
        return cls._of(handle)

    def duplicate(self) -> Cloth:
        """Returns an independent copy in the same state.

        Both continue with the same bits as long as they get the same calls. Handles of grabs,
        attachments and colliders are valid for both; skins stay with this cloth.
        """
        handle = MuslinCloth()
        lib.muslin_cloth_duplicate(self._live, handle)
        return self._of(handle)

    @staticmethod
    def advance_many(cloths: Sequence[Cloth], seconds: float) -> NDArray[np.uint32]:
        """Advances many cloths by `seconds` [s] of frame time, each as `advance` does and with the
        same bits, and returns how many ticks each of them ran.

        One call for a crowd costs less than one per cloth: a cloth that sleeps costs next to
        nothing. Other threads of the interpreter run meanwhile. Raises `Error` that names the index
        if an element is not an open cloth, occurs twice or is in use on another thread, and if
        `seconds` is negative or not finite; then no cloth advances.
        """
        handles = [_handle_in_list(cloth, index) for index, cloth in enumerate(cloths)]
        ids = np.array([handle.id for handle in handles], np.uint64)
        ticks = np.zeros(len(ids), np.uint32)
        rest = (len(ids), to_number(seconds, "seconds"), ticks.ctypes.data)
        lib.muslin_cloths_advance(ids.ctypes.data_as(POINTER(MuslinCloth)), *rest)
        return ticks

    def save(self) -> bytes:
        """Returns the complete state as bytes for `restore`. They are the same on every
        platform."""
        handle, needed = self._live, c_size_t()
        lib.muslin_cloth_save(handle, None, 0, byref(needed))
        buffer = create_string_buffer(needed.value)
        lib.muslin_cloth_save(handle, buffer, needed.value, byref(needed))
        return buffer.raw

    def skin(
        self,
        positions: ArrayLike,
        indices: ArrayLike,
        *,
        uvs: ArrayLike | None = None,
        smoothness: float = 1.0,
    ) -> Skin:
        """Binds a render mesh, usually finer than the cloth, to the cloth as it is now; its arrays
        are copied.

        Each vertex is bound to the nearest point of the cloth, at its distance from it, and moves
        along with the cloth on a surface that is curved over each triangle. Make the skin while the
        cloth has the shape that the mesh was modelled in, usually before the first tick: on a
        folded cloth the nearest layer may be another one.

        - `positions`: vertices [m], shape (n, 3), where the cloth is now. None may be farther from
          the cloth than half the diagonal of the cloth's bounding box.
        - `indices`: triangles, shape (n, 3). `uvs`: shape (vertices, 2).
        - `smoothness`: curvature over each triangle of the cloth, from 0 (flat) to 1. At 1 a skin
          lies on a circle between particles that lie on one.

        A triangle of the skin that a tear or cut would stretch goes with one side, that of its
        center. Its corners on the other side are copied, so the number of vertices may grow; the
        number of triangles never changes. `reset` restores the given mesh. `save` contains no
        skins.
        """
        return Skin(self, positions, indices, uvs=uvs, smoothness=smoothness)

    def __enter__(self) -> Cloth:
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).restore, (self.save(),)

    def __repr__(self) -> str:
        if self.closed:
            return "<muslin.Cloth, closed>"
        try:
            view, _ = self._view()
        except Error:
            return "<muslin.Cloth, busy on another thread>"
        triangles = view.index_count // 3
        return f"<muslin.Cloth of {view.vertex_count} vertices and {triangles} triangles>"


def _handle_in_list(cloth: Any, index: int) -> MuslinCloth:
    """Returns the handle of an element of `cloths`."""
    handle = cloth._handle if isinstance(cloth, Cloth) else None
    if handle is None:
        raise bad_value(f"cloths[{index}]", "be an open cloth")
    return handle


def _set_common(
    desc: MuslinGridDesc | MuslinMeshDesc, extra_particles: Any, material: Any, settings: Any
) -> None:
    """Sets what grids and meshes have in common."""
    reserve = AS_MANY_AGAIN
    if extra_particles is not None:
        reserve = to_uint(extra_particles, "extra_particles")
    desc.extra_particles = reserve
    if material is not None:
        desc.material = material_to_c(material, "material")
    if settings is not None:
        desc.settings = record_to_c(settings, Settings, "settings")
