"""Checks and converts arguments. Every refusal names the field and the rule."""

from __future__ import annotations

import math
import operator
from collections.abc import Mapping, Sequence
from typing import Any, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import bad_value
from ._generated.structs import MuslinQuat, MuslinVec3

Vec3 = tuple[float, float, float]
"""A point [m], direction or velocity [m/s]: x, y, z."""

Quat = tuple[float, float, float, float]
"""A rotation as a unit quaternion: x, y, z, w."""

Vec3Like = Union[Sequence[float], NDArray[Any]]
"""A vector as an argument: a sequence or an array of three numbers."""

QuatLike = Union[Sequence[float], NDArray[Any]]
"""A unit quaternion as an argument: a sequence or an array of four numbers x, y, z, w."""

NO_ROTATION: Quat = (0.0, 0.0, 0.0, 1.0)

_MAX_UINT = 0xFFFF_FFFF

T = TypeVar("T")
Name = TypeVar("Name", bound=str)


def to_number(value: Any, field: str) -> float:
    """Returns a number as a float."""
    if isinstance(value, (str, bytes)):
        raise bad_value(field, "be a number")
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise bad_value(field, "be a number") from None


def to_uint(value: Any, field: str) -> int:
    """Returns a whole number that fits 32 bits."""
    try:
        number = operator.index(value)
    except TypeError:
        raise bad_value(field, "be a whole number") from None
    if not 0 <= number <= _MAX_UINT:
        raise bad_value(field, f"be from 0 to {_MAX_UINT}")
    return number


def to_flag(value: Any, field: str) -> bool:
    """Returns a truth value."""
    if not isinstance(value, (bool, np.bool_)):
        raise bad_value(field, "be True or False")
    return bool(value)


def to_choice(value: Any, field: str, choices: Mapping[Name, int]) -> int:
    """Returns the number of a name."""
    try:
        return choices[value]
    except (KeyError, TypeError):
        names = ", ".join(f'"{name}"' for name in choices)
        raise bad_value(field, f"be one of {names}") from None


def _numbers(value: Any, field: str, count: int, names: str) -> list[float]:
    try:
        numbers = [float(one) for one in value]
    except (TypeError, ValueError, OverflowError):
        numbers = []
    if len(numbers) != count or isinstance(value, (str, bytes)):
        raise bad_value(field, f"hold {count} numbers: {names}")
    return numbers


def to_vec3(value: Any, field: str) -> MuslinVec3:
    """Returns a vector as a struct."""
    return MuslinVec3(*_numbers(value, field, 3, "x, y, z"))


def to_quat(value: Any, field: str) -> MuslinQuat:
    """Returns a rotation as a struct."""
    return MuslinQuat(*_numbers(value, field, 4, "x, y, z, w"))


def from_vec3(vector: MuslinVec3) -> Vec3:
    """Returns a vector as a tuple."""
    return vector.x, vector.y, vector.z


def from_quat(quat: MuslinQuat) -> Quat:
    """Returns a rotation as a tuple."""
    return quat.x, quat.y, quat.z, quat.w


def _array(value: ArrayLike, field: str, shape: tuple[str | int, ...]) -> NDArray[Any]:
    """Returns an array of numbers of this shape; names stand for any length."""
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different lengths
        raise bad_value(field, f"have shape {_shown(shape)}") from None
    if array.size == 0 and array.ndim == 1:
        array = array.reshape([0 if isinstance(n, str) else n for n in shape])
    fits = array.ndim == len(shape) and all(
        isinstance(n, str) or n == length for n, length in zip(shape, array.shape)
    )
    if not fits:
        given = _shown(array.shape)
        raise bad_value(field, f"have shape {_shown(shape)}, but has {given}")
    return array


def _shown(shape: Sequence[str | int]) -> str:
    return "(" + ", ".join(map(str, shape)) + (",)" if len(shape) == 1 else ")")


def to_floats(value: ArrayLike, field: str, shape: tuple[str | int, ...]) -> NDArray[np.float32]:
    """Returns an array of 32-bit floats of this shape, without a copy where it is one already."""
    array = _array(value, field, shape)
    if array.dtype.kind not in "fiu":
        raise bad_value(field, f"hold numbers, but holds {array.dtype}")
    # A number that is too large becomes infinite, which the library refuses by its index.
    with np.errstate(over="ignore"):
        return np.ascontiguousarray(array, dtype=np.float32)


def to_uints(value: ArrayLike, field: str, shape: tuple[str | int, ...]) -> NDArray[np.uint32]:
    """Returns an array of 32-bit whole numbers of this shape, without a copy where it is one
    already."""
    array = _array(value, field, shape)
    if array.dtype.kind not in "iu" and array.size > 0:
        raise bad_value(field, f"hold whole numbers, but holds {array.dtype}")
    if array.dtype != np.uint32 and array.size > 0:
        low, high = int(array.min()), int(array.max())
        if low < 0 or high > _MAX_UINT:
            raise bad_value(field, f"hold numbers from 0 to {_MAX_UINT}")
    return np.ascontiguousarray(array, dtype=np.uint32)


def set_triangles(
    desc: Any, positions: ArrayLike, indices: ArrayLike, uvs: ArrayLike | None
) -> tuple[NDArray[Any], ...]:
    """Points a descriptor to the triangles of a mesh. Keep the returned arrays while it is used."""
    points = to_floats(positions, "positions", ("n", 3))
    triangles = to_uints(indices, "indices", ("n", 3))
    desc.positions, desc.vertex_count = points.ctypes.data, len(points)
    desc.indices, desc.index_count = triangles.ctypes.data, triangles.size
    if uvs is None:
        return points, triangles
    texture = to_floats(uvs, "uvs", ("n", 2))
    check_length(texture, "uvs", len(points), "positions")
    desc.uvs = texture.ctypes.data
    return points, triangles, texture


def check_length(array: NDArray[Any], field: str, count: int, of: str) -> None:
    """Raises an error unless an array has `count` rows, one per entry of the list `of`."""
    if len(array) != count:
        rule = f"have {count} entries, one per entry of `{of}`, but has {len(array)}"
        raise bad_value(field, rule)


def shortest(value: float) -> float:
    """Returns the number with the fewest digits that is the same 32-bit float, such as 0.2."""
    short = float(str(np.float32(value)))
    return short if math.isfinite(short) and np.float32(short) == value else value
