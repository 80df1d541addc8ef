"""Time, settings, material and wind of a cloth."""

from __future__ import annotations

from ctypes import byref, c_double, c_float, c_uint32, c_uint64
from dataclasses import dataclass
from typing import Any, TypeVar, Union

from ._base import ClothBase
from ._convert import to_choice, to_number, to_uint
from ._errors import bad_value
from ._generated.constants import PRESETS, PresetName
from ._generated.records import MaterialFields, Settings, Wind
from ._library import lib
from ._record import Record

R = TypeVar("R", bound=Record)


@dataclass(frozen=True, kw_only=True)
class Material(MaterialFields):
    __doc__ = MaterialFields.__doc__

    @classmethod
    def preset(cls, name: PresetName) -> Material:
        """Returns the material of a fabric.

        - "silk": light and fluid, 100 g/m^2.
        - "cotton": cotton shirting, 180 g/m^2.
        - "denim": heavy twill, 380 g/m^2.
        - "leather": garment leather, 700 g/m^2.
        - "paper": office paper, 80 g/m^2; keeps folds.
        - "flag-nylon": flag nylon of 200 denier, 105 g/m^2.
        """
        return cls._from_c(_preset(name, "name"))


MaterialLike = Union[Material, PresetName]
"""A material as an argument: a `Material` or the name of a preset."""


def material_to_c(material: Any, name: str) -> Any:
    """Returns the struct of a material or of a preset."""
    is_preset = isinstance(material, str)
    return _preset(material, name) if is_preset else record_to_c(material, Material, name)


def _preset(preset: Any, field: str) -> Any:
    struct = Material._empty()
    lib.muslin_material_preset(struct, to_choice(preset, field, PRESETS))
    return struct


def record_to_c(record: Any, kind: type[Record], name: str) -> Any:
    """Returns the struct of a record that must be of a class."""
    if not isinstance(record, kind):
        raise bad_value(name, f"be a {kind.__name__}")
    return record._to_c(name)


class Parameters(ClothBase):
    """Calls that run ticks, and what the simulation depends on."""

    def _read(self, function: Any, kind: type[R]) -> R:
        struct = kind._empty()
        function(self._live, struct)
        return kind._from_c(struct)

    def advance(self, seconds: float) -> int:
        """Runs the ticks that are due after `seconds` [s] of frame time, and returns how many ran.

        The remainder, less than one tick, is kept for the next call; `blend` returns it as a share
        of a tick. At most `max_ticks_per_advance` ticks run; the rest of the backlog is dropped, so
        a slow program shows slow motion instead of falling further behind. Zero seconds change
        nothing.

        Poses that were given since the last tick (targets of pins and grabs, attachments, anchors,
        colliders, the frame of `move_frame`) are reached evenly over the ticks of this call, and
        exactly at the end of the last one. If no tick runs, they wait for the next call.

        Other threads of the interpreter run meanwhile. Raises `Error` if `seconds` is negative or
        not finite.
        """
        ticks = c_uint32()
        lib.muslin_cloth_advance(self._live, to_number(seconds, "seconds"), byref(ticks))
        return ticks.value

    def step(self, ticks: int = 1) -> None:
        """Runs exactly `ticks` ticks. The time that `advance` keeps for the next frame does not
        change. Poses that were given before the call are reached in the first of these ticks. Other
        threads of the interpreter run meanwhile."""
        lib.muslin_cloth_step(self._live, to_uint(ticks, "ticks"))

    def reset(self) -> None:
        """Restores the initial state: rest shape, no tears or cuts, zero velocities, the first
        pins, time zero, all mass scales 1. Removes all grabs, attachments, anchors, creases and
        events.

        Settings, material, wind and colliders stay as they are now. Handles of grabs and
        attachments become stale; handles of colliders stay valid.
        """
        lib.muslin_cloth_reset(self._live)

    @property
    def time(self) -> float:
        """Simulated time since the cloth was made or reset [s]."""
        seconds = c_double()
        lib.muslin_cloth_get_time(self._live, byref(seconds), None)
        return seconds.value

    @property
    def ticks(self) -> int:
        """Ticks since the cloth was made or reset."""
        ticks = c_uint64()
        lib.muslin_cloth_get_time(self._live, None, byref(ticks))
        return ticks.value

    @property
    def blend(self) -> float:
        """Share of a tick that `advance` has not simulated yet, from 0 to 1: the `blend` of
        `write_vertices` for smooth motion at any frame rate."""
        blend = c_float()
        lib.muslin_cloth_get_blend(self._live, byref(blend))
        return blend.value

    @property
    def is_asleep(self) -> bool:
        """Whether the cloth sleeps, see `sleep_speed` of `Settings`: ticks then move nothing until
        something wakes it."""
        asleep = c_uint32()
        lib.muslin_cloth_is_asleep(self._live, byref(asleep))
        return asleep.value != 0

    @property
    def settings(self) -> Settings:
        """How time and the solver run. Assign others to replace them from the next tick on:

            cloth.settings = dataclasses.replace(cloth.settings, iterations=6)

        Velocities stay as they are. Raises `Error` for an invalid field; nothing changes then.
        """
        return self._read(lib.muslin_cloth_get_settings, Settings)

    @settings.setter
    def settings(self, settings: Settings) -> None:
        struct = record_to_c(settings, Settings, "settings")
        lib.muslin_cloth_set_settings(self._live, struct)

    @property
    def material(self) -> Material:
        """What the cloth is made of. Assign another one, or the name of a preset, to replace it
        from the next tick on:

            cloth.material = "silk"
            cloth.material = dataclasses.replace(Material.preset("denim"), friction=0.2)

        Velocities stay as they are. Raises `Error` for an invalid field; nothing changes then.
        """
        return self._read(lib.muslin_cloth_get_material, Material)

    @material.setter
    def material(self, material: MaterialLike) -> None:
        lib.muslin_cloth_set_material(self._live, material_to_c(material, "material"))

    @property
    def wind(self) -> Wind:
        """The air around the cloth. Assign another one to replace it from the next tick on.

        Raises `Error` for an invalid field; nothing changes then.
        """
        return self._read(lib.muslin_cloth_get_wind, Wind)

    @wind.setter
    def wind(self, wind: Wind) -> None:
        lib.muslin_cloth_set_wind(self._live, record_to_c(wind, Wind, "wind"))
