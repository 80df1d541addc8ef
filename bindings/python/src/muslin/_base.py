"""The handle of a cloth, and when it is destroyed."""

from __future__ import annotations

import weakref
from typing import Any

from ._errors import Error
from ._generated.constants import Status
from ._generated.structs import MuslinCloth, MuslinView
from ._library import lib
from ._views import empty_view


def _destroy(cloth_id: int) -> None:
    lib.muslin_cloth_destroy(MuslinCloth(cloth_id))


class ClothBase:
    """A cloth of the library.

    Its handle is an object that calls, and arrays over the memory of the cloth, refer to. When
    nothing refers to it any more, the library's cloth is destroyed.
    """

    _handle: MuslinCloth | None

    def _own(self, handle: MuslinCloth) -> None:
        """Makes this object the owner of a cloth of the library."""
        finalizer = weakref.finalize(handle, _destroy, handle.id)
        finalizer.atexit = False  # memory of a process that ends is freed anyway
        self._handle = handle

    @property
    def _live(self) -> MuslinCloth:
        """The handle. Raises an error if the cloth was closed."""
        handle = self._handle
        if handle is None:
            raise Error(Status.BAD_HANDLE, "`cloth` must be open, but was closed")
        return handle

    def _view(self) -> tuple[MuslinView, Any]:
        view, handle = empty_view(), self._live
        lib.muslin_cloth_view(handle, view)
        return view, handle

    @property
    def closed(self) -> bool:
        """Whether `close` was called."""
        return self._handle is None

    def close(self) -> None:
        """Destroys the cloth at once. Every call but `close` and `closed` is refused from then on.

        Arrays over the memory of the cloth, such as `positions`, stay readable: the memory is freed
        with the last of them. A cloth that is not closed is destroyed when nothing refers to it any
        more. `with` closes a cloth at its end.
        """
        self._handle = None
