"""Arrays over memory of the library."""

from __future__ import annotations

import ctypes
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from ._generated.structs import MuslinView

# Type of the numbers of a list, and how many there are in a row; 0 for a list of single numbers.
_FLOAT, _UINT, _BOOL = (np.dtype(kind).str for kind in (np.float32, np.uint32, np.bool_))
_LISTS: Final = {
    "positions": (_FLOAT, 3),
    "normals": (_FLOAT, 3),
    "uvs": (_FLOAT, 2),
    "indices": (_UINT, 3),
    "source_vertices": (_UINT, 0),
    "frayed": (_BOOL, 0),
    "particles": (_UINT, 0),
}


class HasView(Protocol):
    """Anything whose lists the library lends: a cloth or a skin."""

    def _view(self) -> tuple[MuslinView, object]:
        """Returns the present lists, and the object that keeps them alive."""


class _Borrowed:
    """Memory of the library as NumPy reads it, with the object that keeps it alive.

    An array that is made from it refers to it as its base. So the library's cloth lives as long as
    an array over its memory does.
    """

    __slots__ = ("__array_interface__", "_owner")

    def __init__(
        self, address: int | None, shape: tuple[int, ...], kind: str, owner: object
    ) -> None:
        self._owner = owner
        self.__array_interface__ = {
            "data": (address or 0, True),  # read only
            "shape": shape,
            "typestr": kind,
            "version": 3,
        }


def borrow(address: int | None, shape: tuple[int, ...], kind: str, owner: object) -> NDArray[Any]:
    """Returns a read-only array over memory of the library, which `owner` keeps alive."""
    return np.asarray(_Borrowed(address, shape, kind, owner))


def lists_of(source: HasView, name: str) -> NDArray[Any]:
    """Returns the array of one list of a view."""
    view, owner = source._view()
    kind, width = _LISTS[name]
    count = view.index_count // 3 if name == "indices" else view.vertex_count
    shape = (count, width) if width else (count,)
    return borrow(getattr(view, name), shape, kind, owner)


def empty_view() -> MuslinView:
    """Returns a view whose size is set."""
    return MuslinView(struct_size=ctypes.sizeof(MuslinView))
