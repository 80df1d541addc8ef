"""What a cloth returns: lists, events, statistics; and vertices in arrays of the caller."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from ctypes import byref, c_size_t, c_uint32, c_uint64, create_string_buffer, sizeof
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._base import ClothBase
from ._convert import Vec3, from_vec3, to_flag, to_uint
from ._events import AnyEvent, from_c
from ._generated.records import Changes, MeshReport, Stats
from ._generated.structs import MuslinEvent, MuslinVec3
from ._library import lib
from ._streams import Stream, check_index_buffer, write_vertices
from ._views import lists_of


class Outputs(ClothBase):
    """Calls that read.

    Properties with a list per vertex or triangle are views of the library's memory: read-only
    arrays without a copy, fresh at each access. A view is valid until the next call that changes
    the cloth, and out of date from then on: it may hold new numbers, and of a cloth that has torn
    it has the old length. So get it anew in each frame; `.copy()` keeps it. Its memory lives as
    long as it does. Do not read it on one thread while another one changes the cloth.
    """

    @property
    def positions(self) -> NDArray[np.float32]:
        """Positions [m], shape (vertices, 3). A view."""
        return lists_of(self, "positions")

    @property
    def normals(self) -> NDArray[np.float32]:
        """Unit normals, weighted by triangle area, shape (vertices, 3); zeros for a vertex that no
        triangle uses. Vertices of the same particle share its normal. A view."""
        return lists_of(self, "normals")

    @property
    def uvs(self) -> NDArray[np.float32]:
        """Texture coordinates, shape (vertices, 2). A view."""
        return lists_of(self, "uvs")

    @property
    def indices(self) -> NDArray[np.uint32]:
        """Vertices of the triangles, shape (triangles, 3), counter-clockwise seen from the front. A
        view."""
        return lists_of(self, "indices")

    @property
    def source_vertices(self) -> NDArray[np.uint32]:
        """Vertex of the given mesh that each vertex came from; for a vertex that a cut added on an
        edge, that of the nearer end. A view."""
        return lists_of(self, "source_vertices")

    @property
    def frayed(self) -> NDArray[np.bool_]:
        """Whether each vertex is on a border that a tear or cut made, e.g. to draw fringes; false
        on borders of the original cloth. A view."""
        return lists_of(self, "frayed")

    @property
    def vertex_particles(self) -> NDArray[np.uint32]:
        """Particle of each vertex. A mesh that was welded, or whose sheets were separated, has
        several vertices per particle; otherwise vertex i is particle i. A view.

        Calls that act on the cloth (pins, grabs, tears, positions and velocities) take particles,
        and a ray hit returns one. Triangles have the same numbers in both.
        """
        return lists_of(self, "particles")

    @property
    def origin(self) -> Vec3:
        """The point that the cloth is simulated relative to [m], a whole number of metres along
        each axis.

        It is zero while most of the cloth stays within 16 m of zero along each axis. Beyond, it
        follows the cloth, so that positions far from zero are as exact as near it. All positions
        that you pass or read are absolute, except for `relative_positions` and for what
        `write_vertices` writes with `relative`. Only ticks and calls that place particles move the
        origin.
        """
        origin = MuslinVec3()
        lib.muslin_cloth_get_origin(self._live, origin)
        return from_vec3(origin)

    @property
    def relative_positions(self) -> NDArray[np.float32]:
        """Positions relative to `origin` [m], shape (vertices, 3). They are exact where `positions`
        are rounded: by up to 0.25 mm at 5 km. The array is your own."""
        positions = np.empty((self._view()[0].vertex_count, 3), np.float32)
        self.write_vertices([Stream("position", positions)], relative=True)
        return positions

    @property
    def vertex_capacity(self) -> int:
        """Largest number of vertices that the cloth may ever have."""
        return self._view()[0].vertex_capacity

    @property
    def index_capacity(self) -> int:
        """Largest number of indices that the cloth may ever have, three per triangle."""
        return self._view()[0].index_capacity

    @property
    def topology_revision(self) -> int:
        """A number that changes whenever the triangles change."""
        return self._view()[0].topology_revision

    @property
    def state_revision(self) -> int:
        """A number that changes whenever positions change."""
        return self._view()[0].state_revision

    def changes(self, since_topology_revision: int) -> Changes:
        """Returns the vertex and index ranges that changed after `topology_revision` was
        `since_topology_revision`: what a renderer must upload again, besides positions and normals.

        Returns everything if that revision is more than 64 changes old or never existed; pass 0 for
        the first upload.
        """
        changes = Changes._empty()
        since = to_uint(since_topology_revision, "since_topology_revision")
        lib.muslin_cloth_changes(self._live, since, changes)
        return Changes._from_c(changes)

    @property
    def mesh_report(self) -> MeshReport:
        """What was repaired in the mesh that the cloth was made from. A grid needs no repair."""
        report = MeshReport._empty()
        lib.muslin_cloth_get_mesh_report(self._live, report)
        return MeshReport._from_c(report)

    @property
    def mesh_warnings(self) -> tuple[str, ...]:
        """A sentence for each property of the mesh that its author should know of: what was removed
        or split, and what makes the cloth slow or uneven. Empty for a good mesh."""
        handle, needed = self._live, c_size_t()
        lib.muslin_cloth_get_mesh_warnings(handle, None, 0, byref(needed))
        text = create_string_buffer(needed.value)
        lib.muslin_cloth_get_mesh_warnings(handle, text, needed.value, byref(needed))
        return tuple(text.value.decode().splitlines())

    @property
    def stats(self) -> Stats:
        """Statistics of the current state, computed in time proportional to the size of the
        cloth."""
        stats = Stats._empty()
        lib.muslin_cloth_get_stats(self._live, stats)
        return Stats._from_c(stats)

    def state_hash(self) -> int:
        """Returns a hash of all state that the next tick depends on. Equal calls give equal hashes
        on every platform, also in Rust, C and JavaScript."""
        value = c_uint64()
        lib.muslin_cloth_state_hash(self._live, byref(value))
        return value.value

    def events(self) -> Iterator[AnyEvent]:
        """Returns an iterator over the unread events, oldest first; each is removed as it is
        returned. The newest 1024 are kept.

            for event in cloth.events():
                match event:
                    case EdgeTorn(position=at):
                        print("torn at", at)
                    case PieceDetached(count=triangles):
                        print(triangles, "triangles came off")

        Events are ordered by tick, and within a tick: recoveries; tears, the most stretched edge
        first: for each, its split vertices, then the torn edge; the exhausted reserve; detached
        pieces, ordered by their first triangle; links that pins or grabs hold past `max_stretch`. A
        cut adds the edges that it divided, in its order, then the edges that it opened, the
        vertices that it split, and the detached pieces.
        """
        event, some = MuslinEvent(struct_size=sizeof(MuslinEvent)), c_uint32()
        while True:
            lib.muslin_cloth_next_event(self._live, event, byref(some))
            if not some.value:
                return
            yield from_c(event)

    def write_vertices(
        self,
        streams: Sequence[Stream],
        *,
        first_vertex: int = 0,
        vertex_count: int | None = None,
        blend: float = 1.0,
        transform: ArrayLike | None = None,
        flip_normals: bool = False,
        offset: float = 0.0,
        relative: bool = False,
    ) -> None:
        """Writes vertices into your own arrays, each attribute as its stream says. Rows for
        `vertex_capacity` vertices are always enough.

        - `first_vertex`, `vertex_count`: vertices to write, the first one to row 0; None: all from
          `first_vertex` on.
        - `blend`: time to draw, from 0 (last tick) to 1 (current tick). Pass the cloth's `blend`
          for smooth motion. Normals and tangents belong to the interpolated surface.
        - `transform`: applied to positions after the offset, shape (3, 4): x becomes
          t[0] x + t[1] y + t[2] z + t[3] of its first row. None: identity. Normals stay
          perpendicular to the surface and on their side of it; tangents stay in the surface.
        - `flip_normals`: whether normals point to the other side, e.g. for the back of the cloth.
        - `offset`: distance by which positions are moved along the written normals [m].
        - `relative`: whether positions are relative to `origin`, also those that `transform`
          applies to; otherwise they are absolute.

        Raises `Error` if the vertices do not fit an array, if a field is invalid, two streams
        overlap, or normals or tangents are written with a transform that cannot be inverted; the
        arrays are untouched then.
        """
        handle = self._live

        def write(structs: Any, count: int, desc: Any) -> int:
            return int(lib.muslin_cloth_write_vertices(handle, structs, count, desc))

        choice = (first_vertex, vertex_count, blend, transform, flip_normals, offset, relative)
        write_vertices(write, streams, *choice)

    def write_indices(
        self, buffer: NDArray[Any], *, flip: bool = False, base_vertex: int = 0
    ) -> None:
        """Writes the indices of all triangles to the start of `buffer`, an array of uint16 or
        uint32 without gaps. One with `index_capacity` entries is always large enough.

        `base_vertex` is added to each index; with `flip` the winding of every triangle is reversed.
        Raises `Error` if the indices do not fit, or if one is above 65534 in 16 bits; the array is
        untouched then.
        """
        bits, handle = check_index_buffer(buffer), self._live
        rest = (bits, to_flag(flip, "flip"), to_uint(base_vertex, "base_vertex"))
        lib.muslin_cloth_write_indices(handle, buffer.ctypes.data, buffer.nbytes, *rest)
