"""Dataclasses that mirror structs of the C library."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

from ._convert import from_vec3, shortest, to_choice, to_flag, to_number, to_uint, to_vec3
from ._library import init, lib


@dataclass(frozen=True)
class Kind:
    """How a field is converted from C and to C."""

    read: Callable[[Any], Any]
    write: Callable[[Any, str], Any]


def _read_stages(seconds: Any) -> dict[str, float]:
    names = (lib.muslin_stage_name(stage) for stage in range(len(seconds)))
    return {name.decode(): time for name, time in zip(names, seconds) if name is not None}


def _no_input(_value: Any, field: str) -> Any:
    raise TypeError(f"{field} is a result only")


def choice(choices: Mapping[Any, int]) -> Kind:
    """A field that has one of these names."""
    names = {number: name for name, number in choices.items()}
    return Kind(names.__getitem__, lambda value, field: to_choice(value, field, choices))


NUMBER = Kind(shortest, to_number)
WHOLE = Kind(int, to_uint)
FLAG = Kind(bool, to_flag)
VECTOR = Kind(lambda v: tuple(map(shortest, from_vec3(v))), to_vec3)
STAGES = Kind(_read_stages, _no_input)

Self = TypeVar("Self", bound="Record")


@dataclass(frozen=True, kw_only=True)
class Record:
    """A dataclass with the fields of a struct. It cannot be changed: `dataclasses.replace` returns
    a changed copy."""

    _struct: ClassVar[type[ctypes.Structure]]
    _init: ClassVar[str | None] = None
    _kinds: ClassVar[dict[str, Kind]]

    @classmethod
    def _empty(cls) -> Any:
        """Returns a struct with its size, and its defaults where it has some."""
        struct = cls._struct()
        if cls._init is None:
            struct.struct_size = ctypes.sizeof(struct)
        else:
            init(struct, cls._init)
        return struct

    @classmethod
    def _from_c(cls: type[Self], struct: Any) -> Self:
        """Returns the record of a struct."""
        fields = {name: kind.read(getattr(struct, name)) for name, kind in cls._kinds.items()}
        return cls(**fields)

    def _to_c(self, name: str) -> Any:
        """Returns the struct of a record that the caller knows as `name`."""
        struct = self._empty()
        for field, kind in self._kinds.items():
            setattr(struct, field, kind.write(getattr(self, field), f"{name}.{field}"))
        return struct
