"""Events of a cloth: one class per kind, with the fields of that kind."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import ClassVar, Union, get_args

from ._convert import Vec3, from_vec3
from ._generated.constants import EVENT_KINDS, EventKind
from ._generated.structs import MuslinEvent


@dataclass(frozen=True)
class Event:
    """Something that happened to a cloth.

    `particle_a` and `particle_b` are particles, `vertex` and `source` are vertices; see
    `Cloth.vertex_particles`.
    """

    kind: ClassVar[EventKind]

    tick: int
    """Tick of the event, counted from creation or reset."""
    position: Vec3
    """Position of the event [m]."""


@dataclass(frozen=True)
class EdgeTorn(Event):
    """The edge between two particles tore."""

    kind = "edge-torn"
    particle_a: int
    particle_b: int


@dataclass(frozen=True)
class VertexSplit(Event):
    """`vertex` was split off from `source`.

    If a particle with several vertices was split between these vertices, no vertex had to be
    split: then both are the lowest vertex that moved to the new particle.
    """

    kind = "vertex-split"
    vertex: int
    source: int


@dataclass(frozen=True)
class PieceDetached(Event):
    """A piece of `count` triangles came off; `vertex` belongs to one of them."""

    kind = "piece-detached"
    vertex: int
    count: int


@dataclass(frozen=True)
class Recovered(Event):
    """`count` particles had positions or velocities that were not finite, and were put back to
    their last valid positions."""

    kind = "recovered"
    count: int


@dataclass(frozen=True)
class ReserveUsedUp(Event):
    """Tearing stopped: the particles that `extra_particles` reserved are used up. Reported
    once."""

    kind = "reserve-used-up"


@dataclass(frozen=True)
class HeldApart(Event):
    """Pins, grabs or anchors stretch the cloth past `max_stretch`: `count` links exceed it, one of
    them between the two particles. Reported once, until the limit holds again. Also for `count`
    sewn pairs whose particles are both held apart."""

    kind = "held-apart"
    particle_a: int
    particle_b: int
    count: int


@dataclass(frozen=True)
class EdgeDivided(Event):
    """A cut added `vertex` on the edge between two particles.

    If the two sides of that edge have different vertices there, the next vertex belongs to the
    other side.
    """

    kind = "edge-divided"
    particle_a: int
    particle_b: int
    vertex: int


@dataclass(frozen=True)
class HeldInside(Event):
    """Pins, attachments or grabs hold `count` particles inside a collider; `particle_a` is the
    first of them. Reported once, until none is inside."""

    kind = "held-inside"
    particle_a: int
    count: int


@dataclass(frozen=True)
class FreeInside(Event):
    """`count` particles that nothing holds are inside a collider; `particle_a` is the first of
    them. Reported once, until none is inside.

    Other colliders or held cloth leave them no room, or they were placed there.
    """

    kind = "free-inside"
    particle_a: int
    count: int


@dataclass(frozen=True)
class LayersCross(Event):
    """With surface collision, edges of the cloth pass through triangles of it: `count` pairs of
    both. One of the edges is between the two particles. Reported once, until none does."""

    kind = "layers-cross"
    particle_a: int
    particle_b: int
    count: int


@dataclass(frozen=True)
class StitchTorn(Event):
    """The stitch between two particles tore, see `Cloth.sew`."""

    kind = "stitch-torn"
    particle_a: int
    particle_b: int


AnyEvent = Union[
    EdgeTorn,
    VertexSplit,
    PieceDetached,
    Recovered,
    ReserveUsedUp,
    HeldApart,
    EdgeDivided,
    HeldInside,
    FreeInside,
    LayersCross,
    StitchTorn,
]
"""An event of any kind, for `match` and `isinstance`."""

_CLASSES: dict[int, type[AnyEvent]] = {EVENT_KINDS[one.kind]: one for one in get_args(AnyEvent)}


def from_c(event: MuslinEvent) -> AnyEvent:
    """Returns an event of the library as an object of its class."""
    kind = _CLASSES[event.kind]
    names = [field.name for field in fields(kind) if field.name != "position"]
    return kind(
        position=from_vec3(event.position), **{name: getattr(event, name) for name in names}
    )
