"""Vertices and indices written into arrays of the caller."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._convert import to_choice, to_flag, to_floats, to_number, to_uint
from ._errors import bad_value
from ._generated.constants import (
    ALL_VERTICES,
    ATTRIBUTES,
    MAX_STREAMS,
    VERTEX_FORMATS,
    Attribute,
    VertexFormat,
)
from ._generated.structs import MuslinStream, MuslinWriteDesc
from ._library import init

# Numbers of an attribute, by format.
_WIDTHS: Final[dict[str, dict[str, int]]] = {
    "f32": {"position": 3, "normal": 3, "tangent": 4, "uv": 2, "frayed": 1},
    "f16": {"position": 4, "normal": 4, "tangent": 4, "uv": 2, "frayed": 2},
    "snorm16": {"normal": 4, "tangent": 4, "frayed": 2},
    "octahedral16": {"normal": 2, "tangent": 4},
}
_TYPES: Final = {
    "f32": np.float32,
    "f16": np.float16,
    "snorm16": np.int16,
    "octahedral16": np.int16,
}


@dataclass(frozen=True)
class Stream:
    """A destination for one vertex attribute.

    Fields of one structured array make interleaved vertices:

        vertices = np.zeros(cloth.vertex_capacity, [("position", "f4", 3), ("normal", "f4", 3)])
        streams = [Stream(name, vertices[name]) for name in ("position", "normal")]
        cloth.write_vertices(streams, blend=cloth.blend)
    """

    attribute: Attribute
    """What is written.

    - "position": x y z [m]; in 16-bit formats x y z 1.
    - "normal": unit normal x y z; in 16-bit formats x y z 0.
    - "tangent": x y z w, the unit vector perpendicular to the normal in which texture coordinate u
      grows; w is 1 or -1, and v grows along cross(normal, tangent) times w.
    - "uv": texture coordinates u v.
    - "frayed": 1 on a border that a tear or cut made, else 0; in 16-bit formats followed by 0.
    """
    array: NDArray[Any]
    """Your own array, with one row per vertex and a column per number: float32 for "f32", float16
    for "f16", int16 for the others. Rows may be apart, numbers of a row may not. It may have more
    rows than vertices."""
    format: VertexFormat | None = None
    """How numbers are written; None: as the type of `array` says.

    - "f32": 32-bit floats.
    - "f16": 16-bit floats. Values beyond 65504 are clamped.
    - "snorm16": signed 16-bit integers; -32767 to 32767 stand for -1 to 1. Not for positions and
      texture coordinates.
    - "octahedral16": unit vectors in octahedral encoding, as two such integers; a tangent has w and
      0 after them. For normals and tangents.
    """

    def _to_c(self, name: str) -> MuslinStream:
        stream = MuslinStream()
        init(stream, "muslin_stream_init_sized")
        stream.attribute = to_choice(self.attribute, f"{name}.attribute", ATTRIBUTES)
        array = self.array
        if not isinstance(array, np.ndarray) or not array.flags.writeable:
            raise bad_value(f"{name}.array", "be an array that can be written")
        by_type = {np.dtype(kind): form for form, kind in reversed(_TYPES.items())}
        form = self.format or by_type.get(array.dtype)
        if form is None:
            raise bad_value(f"{name}.array", "hold float32, float16 or int16")
        stream.format = to_choice(form, f"{name}.format", VERTEX_FORMATS)
        if array.dtype != _TYPES[form]:
            raise bad_value(f"{name}.array", f"hold {_TYPES[form].__name__} for {form!r}")
        width = _WIDTHS[form].get(self.attribute)
        if width is None:
            raise bad_value(f"{name}.format", f"be one that can write {self.attribute!r}")
        rows = array[:, np.newaxis] if array.ndim == 1 and width == 1 else array
        if rows.ndim != 2 or rows.shape[1] != width:
            raise bad_value(f"{name}.array", f"have shape (n, {width}), but has {array.shape}")
        size = array.itemsize * width
        stride = rows.strides[0] if len(rows) > 1 else size
        if stride < size or (width > 1 and rows.strides[1] != array.itemsize):
            raise bad_value(f"{name}.array", "have rows without gaps, one after the other")
        stream.buffer, stream.stride = array.ctypes.data, to_uint(stride, f"{name}.stride")
        stream.size = stride * (len(rows) - 1) + size if len(rows) else 0
        return stream


def write_vertices(
    write: Callable[[Any, int, Any], int],
    streams: Sequence[Stream],
    first_vertex: int,
    vertex_count: int | None,
    blend: float,
    transform: ArrayLike | None,
    flip_normals: bool,
    offset: float,
    relative: bool,
) -> None:
    """Calls `write` with the structs of these arguments."""
    if not 1 <= len(streams) <= MAX_STREAMS:
        raise bad_value("streams", f"have 1 to {MAX_STREAMS} entries")
    structs = (MuslinStream * len(streams))()
    for at, stream in enumerate(streams):
        if not isinstance(stream, Stream):
            raise bad_value(f"streams[{at}]", "be a Stream")
        structs[at] = stream._to_c(f"streams[{at}]")
    desc = MuslinWriteDesc()
    init(desc, "muslin_write_desc_init_sized")
    desc.first_vertex = to_uint(first_vertex, "first_vertex")
    count = ALL_VERTICES if vertex_count is None else to_uint(vertex_count, "vertex_count")
    desc.vertex_count = count
    desc.blend = to_number(blend, "blend")
    if transform is not None:
        rows = to_floats(transform, "transform", (3, 4))
        desc.transform = type(desc.transform)(*rows.ravel().tolist())
    desc.flip_normals = to_flag(flip_normals, "flip_normals")
    desc.offset = to_number(offset, "offset")
    desc.relative = to_flag(relative, "relative")
    write(structs, len(structs), ctypes.byref(desc))


def check_index_buffer(buffer: NDArray[Any]) -> int:
    """Returns the bits of an index of `buffer`, an array of the caller."""
    is_array = isinstance(buffer, np.ndarray) and buffer.flags.writeable
    if not is_array or not buffer.flags.c_contiguous:
        raise bad_value("buffer", "be an array that can be written, without gaps")
    if buffer.dtype not in (np.uint16, np.uint32):
        raise bad_value("buffer", f"hold uint16 or uint32, but holds {buffer.dtype}")
    return 8 * buffer.itemsize
