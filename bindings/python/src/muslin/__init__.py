"""Muslin: deterministic cloth simulation.

    import muslin

    cloth = muslin.Cloth.grid(40, 40, 0.05, pin_mode="top-corners", material="denim")
    cloth.wind = muslin.Wind(velocity=(0, 0, 2), gust=0.5)
    for frame in range(60):
        cloth.advance(1 / 60)
        cloth.positions  # a NumPy view, shape (vertices, 3): read it anew in each frame

Units are metres, kilograms, seconds and radians; right-handed, y up by default. The same calls give
the same bits on every platform.
"""

from ._cloth import Cloth
from ._colliders import Collider, Impulse, Pose
from ._convert import Quat, QuatLike, Vec3, Vec3Like
from ._errors import Error
from ._events import (
    AnyEvent,
    EdgeDivided,
    EdgeTorn,
    Event,
    FreeInside,
    HeldApart,
    HeldInside,
    LayersCross,
    PieceDetached,
    Recovered,
    ReserveUsedUp,
    StitchTorn,
    VertexSplit,
)
from ._generated.constants import (
    Attribute,
    EventKind,
    LogLevel,
    MapName,
    PinMode,
    PresetName,
    SelfCollision,
    SewKind,
    Shape,
    Status,
    VertexFormat,
    WindModel,
)
from ._generated.records import Changes, Hit, MeshReport, Settings, Stats, Wind
from ._library import set_log, version
from ._parameters import Material, MaterialLike
from ._particles import MassProperties
from ._pins import Attachment
from ._skin import Skin
from ._streams import Stream
from ._topology import Grab

__version__ = version

__all__ = [
    "AnyEvent",
    "Attachment",
    "Attribute",
    "Changes",
    "Cloth",
    "Collider",
    "EdgeDivided",
    "EdgeTorn",
    "Error",
    "Event",
    "EventKind",
    "FreeInside",
    "Grab",
    "HeldApart",
    "HeldInside",
    "Hit",
    "Impulse",
    "LayersCross",
    "LogLevel",
    "MapName",
    "MassProperties",
    "Material",
    "MaterialLike",
    "MeshReport",
    "PieceDetached",
    "PinMode",
    "Pose",
    "PresetName",
    "Quat",
    "QuatLike",
    "Recovered",
    "ReserveUsedUp",
    "SelfCollision",
    "Settings",
    "SewKind",
    "Shape",
    "Skin",
    "Stats",
    "Status",
    "StitchTorn",
    "Stream",
    "Vec3",
    "Vec3Like",
    "VertexFormat",
    "VertexSplit",
    "Wind",
    "WindModel",
    "set_log",
    "version",
]
