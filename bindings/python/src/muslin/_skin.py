"""Skins: render meshes that follow a cloth."""

from __future__ import annotations

import weakref
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._base import ClothBase
from ._convert import set_triangles, to_number
from ._errors import Error
from ._generated.constants import Status
from ._generated.structs import MuslinSkin, MuslinSkinDesc, MuslinView
from ._library import init, lib
from ._streams import Stream, write_vertices
from ._views import empty_view, lists_of


def _destroy(skin_id: int, _cloth: object) -> None:
    lib.muslin_skin_destroy(MuslinSkin(skin_id))


class Skin:
    """A render mesh that follows a cloth, usually a finer one. `Cloth.skin` makes it.

    Its lists are computed when they are read. They are copies: a tear gives the lists of a skin a
    new length, and so another place in memory. `write_vertices` writes into your own arrays.

    A skin keeps its cloth alive. It ends with `close`, or when its cloth is closed.
    """

    def __init__(
        self,
        cloth: ClothBase,
        positions: ArrayLike,
        indices: ArrayLike,
        *,
        uvs: ArrayLike | None = None,
        smoothness: float = 1.0,
    ) -> None:
        """See `Cloth.skin`."""
        desc = MuslinSkinDesc()
        init(desc, "muslin_skin_desc_init_sized")
        _kept = set_triangles(desc, positions, indices, uvs)
        desc.smoothness = to_number(smoothness, "smoothness")
        handle, live = MuslinSkin(), cloth._live
        lib.muslin_skin_create(live, desc, handle)
        # The arguments of the finalizer keep the cloth until the skin is destroyed.
        weakref.finalize(handle, _destroy, handle.id, live).atexit = False
        self._cloth = cloth
        self._handle: MuslinSkin | None = handle

    @property
    def _live(self) -> MuslinSkin:
        handle = self._handle
        if handle is None or self._cloth.closed:
            raise Error(Status.BAD_HANDLE, "`skin` must be open, as its cloth, but was closed")
        return handle

    def _view(self) -> tuple[MuslinView, Any]:
        view, handle = empty_view(), self._live
        lib.muslin_skin_view(handle, view)
        return view, handle

    @property
    def closed(self) -> bool:
        """Whether the skin or its cloth was closed."""
        return self._handle is None or self._cloth.closed

    def close(self) -> None:
        """Destroys the skin at once. Calls are refused from then on. Its cloth stays."""
        self._handle = None

    def __enter__(self) -> Skin:
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()

    @property
    def positions(self) -> NDArray[np.float32]:
        """Positions [m] where the cloth is now, shape (vertices, 3)."""
        return lists_of(self, "positions").copy()

    @property
    def normals(self) -> NDArray[np.float32]:
        """Unit normals, shape (vertices, 3)."""
        return lists_of(self, "normals").copy()

    @property
    def uvs(self) -> NDArray[np.float32]:
        """Texture coordinates, shape (vertices, 2); zeros if none were given."""
        return lists_of(self, "uvs").copy()

    @property
    def indices(self) -> NDArray[np.uint32]:
        """Vertices of the triangles, shape (triangles, 3). Triangles keep their numbers."""
        return lists_of(self, "indices").copy()

    @property
    def source_vertices(self) -> NDArray[np.uint32]:
        """The given vertex that each vertex came from. Given vertices keep their numbers; copies
        that tears and cuts need follow."""
        return lists_of(self, "source_vertices").copy()

    @property
    def frayed(self) -> NDArray[np.bool_]:
        """Whether each vertex is on an edge that a tear or cut opened."""
        return lists_of(self, "frayed").copy()

    @property
    def vertex_capacity(self) -> int:
        """Largest number of vertices that the skin may ever have."""
        return self._view()[0].vertex_capacity

    @property
    def topology_revision(self) -> int:
        """A number that changes whenever the indices or the number of vertices change."""
        return self._view()[0].topology_revision

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
        """Writes vertices into your own arrays, as `Cloth.write_vertices` does.

        Tears and cuts come first, so read `topology_revision` and the number of vertices before.
        """
        handle = self._live

        def write(structs: Any, count: int, desc: Any) -> int:
            return int(lib.muslin_skin_write_vertices(handle, structs, count, desc))

        choice = (first_vertex, vertex_count, blend, transform, flip_normals, offset, relative)
        write_vertices(write, streams, *choice)
