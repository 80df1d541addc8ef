"""Wrong arguments are refused with the field and the rule, and change nothing."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import muslin
from muslin import Cloth, Error, Status

Call = Callable[[Any], Any]

NAN = float("nan")
CASES: list[tuple[str, str | None, str, Call]] = [
    ("BAD_VALUE", "seconds", "be", lambda c: c.advance(-1)),
    ("BAD_VALUE", "seconds", "be a number", lambda c: c.advance("1")),
    ("BAD_VALUE", "seconds", "be a number", lambda c: c.advance(None)),
    ("BAD_VALUE", "handler", "be a function or None", lambda c: muslin.set_log(7)),  # type: ignore[arg-type]
    ("BAD_VALUE", "max_level", 'be one of "error"', lambda c: muslin.set_log(None, "all")),  # type: ignore[arg-type]
    (
        "BAD_VALUE",
        "buffer",
        "be an array that can be written, without gaps",
        lambda c: c.write_indices(np.zeros(9999, np.uint32)[::2]),
    ),
    ("BAD_VALUE", "ticks", "be from 0 to 4294967295", lambda c: c.step(-1)),
    ("BAD_VALUE", "ticks", "be a whole number", lambda c: c.step(1.5)),
    (
        "BAD_VALUE",
        "len(positions)",
        "be at most the number of particles from `first` on",
        lambda c: c.set_positions(np.zeros((2, 3)), first=399),
    ),
    ("BAD_VALUE", "len(velocities)", "be at most", lambda c: c.set_velocities(np.zeros((401, 3)))),
    (
        "BAD_VALUE",
        "len(particles)",
        "be at most the number of particles",
        lambda c: c.set_pin_stiffness(np.zeros(401, int), 1),
    ),
    ("BAD_VALUE", "len(positions)", "be at least 3", lambda c: Cloth.mesh([], [[0, 1, 2]])),
    ("BAD_VALUE", "indices.size", "be at least 3", lambda c: Cloth.mesh(np.eye(3), [])),
    (
        "BAD_VALUE",
        "len(pinned)",
        "be at most `len(positions)`",
        lambda c: Cloth.mesh(np.eye(3), [[0, 1, 2]], pinned=[0, 1, 2, 0]),
    ),
    (
        "BAD_VALUE",
        "simplify_below",
        "be at most the mean length of the edges",
        lambda c: Cloth.mesh(np.eye(3), [[0, 1, 2]], simplify_below=1.5),
    ),
    ("BAD_VALUE", "target", "be finite", lambda c: c.pin(0, (0, NAN, 0))),
    ("BAD_VALUE", "target", "hold 3 numbers: x, y, z", lambda c: c.pin(0, (0, 0))),
    ("BAD_VALUE", "target", "hold 3 numbers: x, y, z", lambda c: c.pin(0, "abc")),
    ("BAD_INDEX", "particle", "be below 400, but is 400", lambda c: c.pin(400)),
    ("BAD_INDEX", "particle", "be below 400, but is 401", lambda c: c.position(401)),
    (
        "BAD_VALUE",
        "positions",
        "have shape (n, 3), but has (4, 2)",
        lambda c: c.set_positions(np.zeros((4, 2))),
    ),
    (
        "BAD_VALUE",
        "positions",
        "have shape (n, 3), but has (3,)",
        lambda c: c.set_positions([1, 2, 3]),
    ),
    ("BAD_VALUE", "positions", "have shape (n, 3)", lambda c: c.set_positions([[1, 2, 3], [1]])),
    (
        "BAD_VALUE",
        "positions",
        "hold numbers, but holds <U1",
        lambda c: c.set_positions([["a", "b", "c"]]),
    ),
    (
        "BAD_VALUE",
        "positions",
        "hold numbers, but holds complex128",
        lambda c: c.set_positions(np.zeros((2, 3), complex)),
    ),
    (
        "BAD_VALUE",
        "positions[1]",
        "be finite",
        lambda c: c.set_positions([[0, 0, 0], [0, 0, 1e39]]),
    ),
    (
        "BAD_VALUE",
        "particles",
        "hold whole numbers, but holds float64",
        lambda c: c.set_pin_targets([0.0], [[0, 0, 0]]),
    ),
    (
        "BAD_VALUE",
        "particles",
        "hold numbers from 0 to 4294967295",
        lambda c: c.set_pin_targets([-1], [[0, 0, 0]]),
    ),
    (
        "BAD_VALUE",
        "targets",
        "have 2 entries, one per entry of `particles`, but has 1",
        lambda c: c.set_pin_targets([0, 1], [[0, 0, 0]]),
    ),
    (
        "BAD_VALUE",
        "distances",
        "have 1 entries, one per entry of `particles`, but has 2",
        lambda c: c.set_max_distances([0], [1, 2]),
    ),
    (
        "BAD_VALUE",
        "radii",
        "have 1 entries, one per entry of `particles`, but has 0",
        lambda c: c.set_backstops([0], [1], []),
    ),
    (
        "BAD_VALUE",
        "rotation",
        "hold 4 numbers: x, y, z, w",
        lambda c: c.attach([0], (0, 0, 0), (0, 0, 1)),
    ),
    ("BAD_VALUE", "rotation", "be", lambda c: c.attach([0], (0, 0, 0), (0, 0, 1, 1))),
    ("BAD_HANDLE", "collider", "be", lambda c: c.remove_collider(muslin.Collider(7))),
    ("BAD_VALUE", "collider", "be a Collider", lambda c: c.remove_collider(7)),
    ("BAD_VALUE", "grab", "be a Grab", lambda c: c.release(muslin.Collider(7))),
    ("BAD_VALUE", "attachment", "be an Attachment", lambda c: c.detach(None)),
    ("BAD_VALUE", "shape", 'be one of "plane", "sphere"', lambda c: c.add_collider("ball")),
    (
        "BAD_VALUE",
        "heights",
        "have shape (rows, columns), but has (4,)",
        lambda c: c.add_collider("heightfield", heights=[0, 0, 0, 0]),
    ),
    ("BAD_VALUE", "other", "be another cloth", lambda c: c.collide_with(c)),
    ("BAD_VALUE", "other", "be a Cloth", lambda c: c.collide_with(7)),
    ("BAD_VALUE", "map", 'be one of "stretch"', lambda c: c.set_map("color", [])),
    ("BAD_VALUE", "scales", "have 400 entries", lambda c: c.set_map("bend", [1, 1])),
    ("BAD_VALUE", "pairs", "have shape (n, 2), but has (3,)", lambda c: c.sew([0, 1, 2])),
    ("BAD_VALUE", "kind", 'be one of "weld", "stitch"', lambda c: c.sew([[0, 1]], kind="glue")),
    ("BAD_VALUE", "sweep", "", lambda c: c.cut((0, 0, 0), (1, 0, 0), (0, 0, 0))),
    ("BAD_VALUE", "wind", "be a Wind", lambda c: setattr(c, "wind", {})),
    ("BAD_VALUE", "wind.gust", "be", lambda c: setattr(c, "wind", muslin.Wind(gust=2))),
    (
        "BAD_VALUE",
        "wind.model",
        'be one of "surface"',
        lambda c: setattr(c, "wind", muslin.Wind(model="breeze")),  # type: ignore[arg-type]
    ),
    (
        "BAD_VALUE",
        "settings.tick",
        "be above 0",
        lambda c: setattr(c, "settings", muslin.Settings(tick=0)),
    ),
    (
        "BAD_VALUE",
        "settings.tearing",
        "be True or False",
        lambda c: setattr(c, "settings", muslin.Settings(tearing=1)),  # type: ignore[arg-type]
    ),
    ("BAD_VALUE", "settings", "be a Settings", lambda c: setattr(c, "settings", muslin.Material())),
    ("BAD_VALUE", "material", 'be one of "silk"', lambda c: setattr(c, "material", "wool")),
    (
        "BAD_VALUE",
        "material.density",
        "be",
        lambda c: setattr(c, "material", muslin.Material(density=0)),
    ),
    ("BAD_VALUE", "buffer", "be bytes", lambda c: c.restore("text")),
    ("BAD_SAVE", "buffer", "hold a saved cloth", lambda c: Cloth.restore(b"text")),
    ("BAD_SAVE", "buffer", "hold a saved cloth", lambda c: Cloth.restore(c.save()[:-1])),
    ("BAD_MESH", "indices", "", lambda c: Cloth.mesh(np.zeros((3, 3)), [[0, 1, 2]])),
    ("BAD_INDEX", None, "", lambda c: Cloth.mesh(np.eye(3), [[0, 1, 3]])),
    (
        "BAD_VALUE",
        "uvs",
        "have 3 entries, one per entry of `positions`, but has 1",
        lambda c: Cloth.mesh(np.eye(3), [[0, 1, 2]], uvs=[[0, 0]]),
    ),
    ("BAD_VALUE", None, "", lambda c: Cloth.grid(1, 2)),
]


@pytest.mark.parametrize(
    ("status", "field", "rule", "call"), CASES, ids=[f"{i}-{c[1]}" for i, c in enumerate(CASES)]
)
def test_a_wrong_argument_is_refused_and_changes_nothing(
    cloth: Cloth, status: str, field: str | None, rule: str, call: Call
) -> None:
    before = cloth.state_hash()
    with pytest.raises(Error) as caught:
        call(cloth)
    error = caught.value
    assert error.status == Status[status], str(error)
    if field is not None:
        assert error.field == field, str(error)
    assert error.rule.startswith(rule), str(error)
    assert str(error) == (f"`{error.field}` must {error.rule}" if error.field else error.rule)
    assert cloth.state_hash() == before


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda c: muslin.Settings(iteration=3), "iteration"),  # type: ignore[call-arg]
        (lambda c: muslin.Material(densty=3), "densty"),  # type: ignore[call-arg]
        (lambda c: muslin.Wind(gusts=3), "gusts"),  # type: ignore[call-arg]
        (lambda c: Cloth.grid(colums=3), "colums"),  # type: ignore[call-arg]
        (lambda c: Cloth.mesh(np.eye(3), [[0, 1, 2]], weld=0), "weld"),  # type: ignore[call-arg]
        (lambda c: c.add_collider("sphere", radious=3), "radious"),
        (lambda c: c.sew([], sped=3), "sped"),
        (lambda c: c.write_vertices([], blnd=1), "blnd"),
    ],
)
def test_an_unknown_keyword_is_a_type_error_that_names_it(
    cloth: Cloth, call: Call, name: str
) -> None:
    with pytest.raises(TypeError, match=f"unexpected keyword argument '{name}'"):
        call(cloth)


def test_a_cloth_is_made_by_its_class_methods() -> None:
    with pytest.raises(TypeError, match=r"Cloth.grid\(\)"):
        Cloth()


def test_errors_can_be_sent_to_other_processes() -> None:
    error = pickle.loads(pickle.dumps(Error(Status.FULL, "no room is left for another grab")))
    assert (error.status, error.field) == (Status.FULL, None)
    assert error.rule == str(error) == "no room is left for another grab"


def test_records_cannot_be_changed_in_place(cloth: Cloth) -> None:
    with pytest.raises(AttributeError):
        cloth.settings.iterations = 6  # type: ignore[misc]
