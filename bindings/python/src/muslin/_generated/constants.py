"""Statuses, numbers and names.

Generated from include/muslin.h. To write it again: MUSLIN_BLESS=1 cargo xtask python
"""

from enum import IntEnum
from typing import Final, Literal


class Status(IntEnum):
    """Why a call was refused."""

    OK = 0
    """The call succeeded."""
    BAD_VALUE = 1
    """An argument or field is missing, out of range, not finite, or inconsistent with another one.
    """
    BAD_INDEX = 2
    """An index is not below the number of particles, vertices or points."""
    BAD_HANDLE = 3
    """A handle of a cloth, grab, attachment or collider is stale, made up or from another cloth."""
    BAD_MESH = 4
    """The mesh cannot be made into cloth, even after repair."""
    BAD_SAVE = 5
    """The bytes are not a saved cloth, come from another format version, or are damaged."""
    FULL = 6
    """A limit on the number of items is reached, or the reserve for tears and cuts
    (`extra_particles`) is used up.
    """
    UNSUPPORTED = 7
    """This version does not support the requested value or struct version."""
    BUSY = 8
    """Another thread is using the cloth. The call did nothing; try again."""
    BUFFER_TOO_SMALL = 9
    """The caller's buffer is too small."""
    NOTHING_HIT = 10
    """The ray hits nothing. Not an error, so it is not logged."""
    NOT_TORN = 11
    """The edge did not tear: both ends are pinned or grabbed, or it is a border edge. Not an error,
    so it is not logged.
    """
    PANICKED = 12
    """A bug in Muslin interrupted the call; please report it. The cloth is unusable: the only call
    that it still accepts is `Cloth.close`.
    """


AS_MANY_AGAIN: Final = 0xffffffff
MAX_STREAMS: Final = 16
ALL_VERTICES: Final = 0xffffffff
STAGE_SLOTS: Final = 31

LogLevel = Literal["error", "warn", "info"]
LOG_LEVELS: Final[dict[LogLevel, int]] = {"error": 1, "warn": 2, "info": 3}

PresetName = Literal["silk", "cotton", "denim", "leather", "paper", "flag-nylon"]
PRESETS: Final[dict[PresetName, int]] = {
    "silk": 0, "cotton": 1, "denim": 2, "leather": 3, "paper": 4, "flag-nylon": 5,
}

MapName = Literal["stretch", "bend", "tear", "friction", "thickness", "drag"]
MAPS: Final[dict[MapName, int]] = {
    "stretch": 0, "bend": 1, "tear": 2, "friction": 3, "thickness": 4, "drag": 5,
}

SelfCollision = Literal["none", "surface", "particles"]
SELF_COLLISIONS: Final[dict[SelfCollision, int]] = {"none": 0, "surface": 1, "particles": 2}

PinMode = Literal["none", "top-edge", "top-corners", "corners"]
PIN_MODES: Final[dict[PinMode, int]] = {"none": 0, "top-edge": 1, "top-corners": 2, "corners": 3}

WindModel = Literal["surface", "sine-field"]
WIND_MODELS: Final[dict[WindModel, int]] = {"surface": 0, "sine-field": 1}

Shape = Literal["plane", "sphere", "capsule", "box", "convex", "mesh", "heightfield"]
SHAPES: Final[dict[Shape, int]] = {
    "plane": 0, "sphere": 1, "capsule": 2, "box": 3, "convex": 4, "mesh": 5, "heightfield": 6,
}

EventKind = Literal[
    "edge-torn", "vertex-split", "piece-detached", "recovered", "reserve-used-up", "held-apart",
    "edge-divided", "held-inside", "free-inside", "layers-cross", "stitch-torn",
]
EVENT_KINDS: Final[dict[EventKind, int]] = {
    "edge-torn": 0, "vertex-split": 1, "piece-detached": 2, "recovered": 3, "reserve-used-up": 4,
    "held-apart": 5, "edge-divided": 6, "held-inside": 7, "free-inside": 8, "layers-cross": 9,
    "stitch-torn": 10,
}

Attribute = Literal["position", "normal", "tangent", "uv", "frayed"]
ATTRIBUTES: Final[dict[Attribute, int]] = {
    "position": 0, "normal": 1, "tangent": 2, "uv": 3, "frayed": 4,
}

VertexFormat = Literal["f32", "f16", "snorm16", "octahedral16"]
VERTEX_FORMATS: Final[dict[VertexFormat, int]] = {
    "f32": 0, "f16": 1, "snorm16": 2, "octahedral16": 3,
}

SewKind = Literal["weld", "stitch"]
SEW_KINDS: Final[dict[SewKind, int]] = {"weld": 0, "stitch": 1}
