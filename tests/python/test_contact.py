"""Colliders, layers, rays, grabs, tears, cuts, creases, seams, pressure, events."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import muslin
from muslin import Cloth, Error, Settings, Status
from shapes import plane

SHEET = Settings(self_collision="surface")


def fallen(ticks: int = 90, **collider: Any) -> np.ndarray:
    """Positions of a sheet that fell on a collider, from a height of 0.7 m."""
    cloth = Cloth.grid(
        20, 20, 0.05, origin=(-0.475, 0.7, -0.475), down=(0, 0, 1), pin_mode="none", settings=SHEET
    )
    cloth.add_collider("plane", position=(0, -1, 0))
    cloth.add_collider(**collider)
    cloth.step(ticks)
    return cloth.positions.copy()


def test_a_sheet_falls_on_every_shape() -> None:
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    ground, triangles = plane(9, 9, 0.25, (-1, 0, -1))
    flat: list[dict[str, Any]] = [
        {"shape": "plane"},
        {"shape": "mesh", "positions": ground, "indices": triangles},
        {
            "shape": "heightfield",
            "heights": np.zeros((5, 9)),
            "spacing": 0.5,
            "position": (-2, 0, -1),
        },
    ]
    for collider in flat:
        y = fallen(**collider)[:, 1]
        assert -1e-3 < y.min() and y.max() < 0.05, collider["shape"]
    solid: list[dict[str, Any]] = [
        {"shape": "sphere", "radius": 0.5},
        {"shape": "box"},
        {"shape": "convex", "positions": corners},
        {"shape": "capsule", "half_height": 0.2, "radius": 0.3, "top_radius": 0.35},
    ]
    for collider in solid:
        positions = fallen(**collider)
        assert positions[:, 1].min() > -1.01 and positions[:, 1].max() > 0.3, collider["shape"]
    assert fallen(120, shape="sphere", position=(9, 0, 9))[:, 1].max() < -0.9


def test_a_heightfield_has_rows_along_z_and_columns_along_x() -> None:
    cloth = Cloth.grid(20, 20, 0.05, origin=(0.05, 0.7, 0.05), down=(0, 0, 1), pin_mode="none")
    heights = np.zeros((3, 4))
    heights[:, 3] = 0.3
    cloth.add_collider("heightfield", heights=heights, spacing=0.5)
    cloth.step(120)
    assert cloth.positions[:, 1].max() < 0.05
    with pytest.raises(Error, match="rows"):
        cloth.add_collider("heightfield", heights=np.zeros((1, 9)))


def test_a_moving_collider_carries_the_cloth_and_feels_it() -> None:
    cloth = Cloth.grid(20, 20, 0.05, origin=(-0.5, 0.02, -0.5), down=(0, 0, 1), pin_mode="none")
    ball = cloth.add_collider("sphere", position=(0, -0.3, 0), radius=0.2, friction=0.8)
    cloth.move_collider(ball, (0, 0.5, 0), (0, 0, math.sin(0.5), math.cos(0.5)))
    assert cloth.collider_pose(ball).position == pytest.approx((0, -0.3, 0))
    cloth.step()
    pose = cloth.collider_pose(ball)
    assert pose.position == pytest.approx((0, 0.5, 0))
    assert pose.rotation == pytest.approx((0, 0, math.sin(0.5), math.cos(0.5)))
    assert cloth.positions[:, 1].max() > 0.65
    impulse = cloth.collider_impulse(ball)
    assert impulse.linear[1] < -0.01 and len(impulse.angular) == 3
    cloth.teleport_collider(ball, (0, -5, 0))
    assert cloth.collider_pose(ball).position == pytest.approx((0, -5, 0))
    cloth.remove_collider(ball)
    with pytest.raises(Error) as caught:
        cloth.collider_pose(ball)
    assert (caught.value.status, caught.value.field) == (Status.BAD_HANDLE, "collider")


def test_a_mesh_collider_takes_new_vertices() -> None:
    ground, triangles = plane(9, 9, 0.25, (-1, 0, -1))
    cloth = Cloth.grid(20, 20, 0.05, origin=(-0.475, 0.1, -0.475), down=(0, 0, 1), pin_mode="none")
    body = cloth.add_collider("mesh", positions=ground, indices=triangles)
    cloth.step(60)
    for height in np.linspace(0, 0.3, 20):
        cloth.update_collider(body, ground + (0, height, 0))
        cloth.step()
    assert cloth.positions[:, 1].min() > 0.299
    with pytest.raises(Error) as caught:
        cloth.update_collider(body, ground[:-1])
    assert caught.value.field == "len(positions)"


def test_handles_are_valid_for_restored_cloths() -> None:
    cloth = Cloth.grid(10, 10)
    ball, grab = cloth.add_collider("sphere"), cloth.grab_particle(99)
    other = Cloth.restore(cloth.save())
    other.move_collider(ball, (0, -3, 0))
    other.move_grab(grab, (0, 0, 1))
    other.release(grab)
    with pytest.raises(Error):
        other.release(grab)
    cloth.release(grab)


def test_a_coat_lies_on_its_lining() -> None:
    lining, triangles = plane(21, 21, 0.05, (-0.5, 0, -0.5))
    inner = Cloth.mesh(lining, triangles, pinned=range(441))
    outer = Cloth.mesh(lining + (0, 0.05, 0), triangles)
    layer = None
    for _ in range(60):
        inner.advance(1 / 60)
        layer = outer.collide_with(inner, layer)
        outer.advance(1 / 60)
    assert outer.positions[:, 1].min() > 0
    assert layer is not None
    outer.remove_collider(layer)
    outer.step(30)
    assert outer.positions[:, 1].max() < -0.5
    inner.close()
    with pytest.raises(Error, match="`other` must be open"):
        outer.collide_with(inner)


def test_rays_hit_and_grabs_pull(cloth: Cloth) -> None:
    hit = cloth.raycast((0.5, -0.5, 5), (0, 0, -3))
    assert hit is not None
    assert hit.position == pytest.approx((0.5, -0.5, hit.position[2]), abs=1e-6)
    assert hit.distance == pytest.approx(5 - hit.position[2], abs=1e-5)
    corners = cloth.positions[cloth.indices[hit.triangle]]
    point = corners[0] + hit.u * (corners[1] - corners[0]) + hit.v * (corners[2] - corners[0])
    assert np.allclose(point, hit.position, atol=1e-5)
    assert hit.particle in cloth.indices[hit.triangle]
    assert cloth.raycast((0.5, -0.5, 5), (0, 0, -3), max_distance=1) is None
    assert cloth.raycast((0.5, 0.5, 5), (0, 0, -3)) is None
    assert cloth.grab_ray((0.5, 0.5, 5), (0, 0, -1)) is None
    held = cloth.grab_ray((0.5, 0.02, 5), (0, 0, -1), 0.1)
    assert held is not None and held[1][1] == pytest.approx(0)
    grab = cloth.grab_particle(399)
    x, y, z = cloth.position(399)
    cloth.move_grab(grab, (x, y, z + 0.02))
    cloth.step()
    assert cloth.position(399) == pytest.approx((x, y, z + 0.02), abs=1e-5)
    cloth.release(grab)
    with pytest.raises(Error) as caught:
        cloth.release(grab)
    assert (caught.value.status, caught.value.field) == (Status.BAD_HANDLE, "grab")


def test_a_tear_changes_counts_and_gives_events(cloth: Cloth) -> None:
    assert list(cloth.events()) == []
    assert not cloth.frayed.any()
    assert cloth.tear_edge(210, 211)
    assert len(cloth.positions) == 401 and cloth.indices.max() == 400
    assert cloth.frayed.any() and cloth.source_vertices[400] in (210, 211)
    split, torn = cloth.events()
    assert isinstance(split, muslin.VertexSplit) and isinstance(torn, muslin.EdgeTorn)
    assert split.vertex == 400 and split.source == cloth.source_vertices[400]
    assert {torn.particle_a, torn.particle_b} == {210, 211} and torn.tick == 30
    assert torn.kind == "edge-torn" and len(torn.position) == 3
    assert list(cloth.events()) == []
    assert not cloth.tear_edge(0, 1)
    with pytest.raises(Error):
        cloth.tear_edge(0, 399)


def test_a_cut_through_the_cloth_detaches_a_piece(cloth: Cloth) -> None:
    edges = cloth.cut((-1, -0.51, -1), (3, -0.52, -1), (0, 0, 2))
    assert edges >= 19 and cloth.stats.pieces == 2
    events = list(cloth.events())
    kinds = {event.kind for event in events}
    assert kinds == {"edge-divided", "edge-torn", "vertex-split", "piece-detached"}
    counts = []
    for event in events:
        match event:
            case muslin.PieceDetached(count=count):
                counts.append(count)
    assert len(counts) == 1 and 300 < counts[0] < 500
    assert cloth.cut((5, 5, 5), (6, 5, 5), (0, 0, 1)) == 0


def test_events_that_are_not_read_stay(cloth: Cloth) -> None:
    cloth.tear_edge(210, 211)
    first = next(cloth.events())
    assert isinstance(first, muslin.VertexSplit)
    assert [event.kind for event in cloth.events()] == ["edge-torn"]


def test_every_kind_of_event_has_a_class() -> None:
    from muslin._events import _CLASSES
    from muslin._generated.constants import EVENT_KINDS

    assert {kind.kind: number for number, kind in _CLASSES.items()} == EVENT_KINDS


def test_a_crease_folds_paper() -> None:
    cloth = Cloth.grid(20, 20, 0.02, material="paper", settings=Settings(gravity=(0, 0, 0)))
    cloth.wind = muslin.Wind(air_density=0)
    cloth.crease((-1, -0.19, 0), (3, -0.19, 0), 1.5)
    cloth.step(240)
    assert np.abs(cloth.positions[399][2]) > 0.05


def two_panels() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Two sheets, one above the other, and the pairs of particles along their borders."""
    below, triangles = plane(11, 11, 0.05, (0, 0, 0))
    above = below + (0, 0.02, 0)
    border = np.flatnonzero(np.abs(below[:, [0, 2]] - 0.25).max(axis=1) > 0.2499)
    indices = np.concatenate([triangles[:, ::-1], triangles + 121])
    return np.concatenate([below, above]), indices, np.stack([border, border + 121], axis=1)


def test_sewn_panels_are_a_cushion_under_pressure() -> None:
    positions, indices, pairs = two_panels()
    settings = Settings(gravity=(0, 0, 0), max_stretch=0.02)
    cloth = Cloth.mesh(positions, indices, settings=settings)
    cloth.sew(pairs, speed=1)
    cloth.step(30)
    assert np.array_equal(cloth.positions[pairs[:, 0]], cloth.positions[pairs[:, 1]])
    flat = np.ptp(cloth.positions[:, 1])
    cloth.settings = Settings(gravity=(0, 0, 0), max_stretch=0.02, pressure=50)
    cloth.step(120)
    assert np.ptp(cloth.positions[:, 1]) > flat + 0.05


def test_a_stitch_tears_under_its_force() -> None:
    positions, indices, pairs = two_panels()
    cloth = Cloth.mesh(positions, indices, settings=Settings(gravity=(0, 0, 0)))
    cloth.sew(pairs, kind="stitch", speed=1, tear_force=0.01)
    cloth.step(30)
    grab = cloth.grab_particle(121)
    for frame in range(60):
        cloth.move_grab(grab, (0, 0.02 + 0.02 * frame, 0))
        cloth.step()
    torn = [event for event in cloth.events() if isinstance(event, muslin.StitchTorn)]
    assert torn and all(
        [e.particle_a, e.particle_b] in pairs.tolist()
        or [e.particle_b, e.particle_a] in pairs.tolist()
        for e in torn
    )
