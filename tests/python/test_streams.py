"""Vertices and indices written into arrays of the caller; skins."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import muslin
from muslin import Cloth, Error, Skin, Status, Stream
from shapes import plane


def test_interleaved_vertices_are_fields_of_one_array(cloth: Cloth) -> None:
    kinds = [("position", "f4", 3), ("normal", "f4", 3), ("uv", "f4", 2), ("frayed", "f4")]
    vertices = np.full(cloth.vertex_capacity, 7, np.dtype(kinds))
    names = ["position", "normal", "uv", "frayed"]
    streams = [Stream(name, vertices[name]) for name in names]  # type: ignore[arg-type]
    cloth.write_vertices(streams)
    assert np.array_equal(vertices["position"][:400], cloth.positions)
    assert np.allclose(vertices["normal"][:400], cloth.normals, atol=1e-6)
    assert np.array_equal(vertices["uv"][:400], cloth.uvs)
    assert not vertices["frayed"][:400].any() and (vertices["frayed"][400:] == 7).all()


def test_formats_follow_the_type_of_the_array(cloth: Cloth) -> None:
    half = np.zeros((400, 4), np.float16)
    short = np.zeros((400, 4), np.int16)
    octahedral = np.zeros((400, 2), np.int16)
    cloth.write_vertices(
        [
            Stream("position", half),
            Stream("normal", short),
            Stream("normal", octahedral, format="octahedral16"),
        ]
    )
    assert np.allclose(half[:, :3], cloth.positions, atol=1e-3) and (half[:, 3] == 1).all()
    assert np.allclose(short[:, :3] / 32767, cloth.normals, atol=1e-4)
    folded = octahedral / 32767
    z = 1 - np.abs(folded).sum(axis=1)
    is_front = z >= 0
    assert is_front.any()
    normals = np.column_stack([folded, z])[is_front]
    normals /= np.linalg.norm(normals, axis=1)[:, np.newaxis]
    assert np.allclose(normals, cloth.normals[is_front], atol=1e-3)


def test_vertices_are_transformed_blended_and_selected(cloth: Cloth) -> None:
    out = np.zeros((3, 3), np.float32)
    transform = np.array([[0, 1, 0, 5], [1, 0, 0, 6], [0, 0, 1, 7]])
    cloth.write_vertices(
        [Stream("position", out)], first_vertex=200, vertex_count=3, transform=transform
    )
    x, y, z = cloth.positions[200:203].T
    assert np.allclose(out, np.stack([y + 5, x + 6, z + 7], axis=1), atol=1e-6)
    cloth.wind = muslin.Wind(velocity=(0, 0, 9))
    cloth.step(10)
    last = cloth.positions.copy()
    cloth.step()
    assert np.abs(cloth.positions - last).max() > 0.01
    middle = np.zeros((400, 3), np.float32)
    cloth.write_vertices([Stream("position", middle)], blend=0.5)
    assert np.allclose(middle, (last + cloth.positions) / 2, atol=1e-6)
    normals, moved = np.zeros((400, 3), np.float32), np.zeros((400, 3), np.float32)
    streams = [Stream("normal", normals), Stream("position", moved)]
    cloth.write_vertices(streams, flip_normals=True, offset=0.5)
    assert np.allclose(normals, -cloth.normals, atol=1e-6)
    assert np.allclose(moved, cloth.positions - 0.5 * cloth.normals, atol=1e-5)


def test_a_wrong_selection_is_refused_by_name(cloth: Cloth) -> None:
    out = np.zeros((400, 3), np.float32)
    wrong: list[tuple[str, dict[str, Any]]] = [
        ("first_vertex", {"first_vertex": 401}),
        ("vertex_count", {"first_vertex": 390, "vertex_count": 11}),
        ("blend", {"blend": 1.5}),
        ("offset", {"offset": np.nan}),
        ("transform", {"transform": np.zeros((3, 4))}),
        ("transform", {"transform": np.eye(4)}),
        ("relative", {"relative": 1}),
    ]
    for field, choice in wrong:
        with pytest.raises(Error) as caught:
            cloth.write_vertices([Stream("normal", out)], **choice)
        assert caught.value.field == field and not out.any()


@pytest.mark.parametrize(
    ("stream", "field"),
    [
        (Stream("position", np.zeros((400, 4), np.float32)), "streams[0].array"),
        (Stream("position", np.zeros((400, 3), np.float64)), "streams[0].array"),
        (Stream("position", np.zeros((400, 3), np.int16)), "streams[0].format"),
        (Stream("normal", np.zeros((400, 3), np.float32), format="f16"), "streams[0].array"),
        (Stream("colour", np.zeros((400, 3), np.float32)), "streams[0].attribute"),  # type: ignore[arg-type]
        (Stream("normal", np.zeros((400, 3), np.float32)[::-1]), "streams[0].array"),
        (Stream("normal", np.zeros((400, 6), np.float32)[:, ::2]), "streams[0].array"),
        (Stream("normal", [[0.0] * 3]), "streams[0].array"),  # type: ignore[arg-type]
        (Stream("uv", np.zeros((399, 2), np.float32)), "streams[0].size"),
        (7, "streams[0]"),
    ],
)
def test_a_wrong_stream_is_refused_and_nothing_is_written(
    cloth: Cloth, stream: Stream, field: str
) -> None:
    with pytest.raises(Error) as caught:
        cloth.write_vertices([stream])
    assert caught.value.field == field, str(caught.value)
    if isinstance(stream, Stream):
        assert not np.any(stream.array)


def test_streams_are_one_to_sixteen_and_may_not_overlap(cloth: Cloth) -> None:
    array = np.zeros((400, 3), np.float32)
    with pytest.raises(Error, match="`streams` must have 1 to 16 entries"):
        cloth.write_vertices([])
    with pytest.raises(Error) as caught:
        cloth.write_vertices([Stream("position", array), Stream("normal", array)])
    assert caught.value.status == Status.BAD_VALUE and not array.any()


def test_indices_are_written_in_both_widths(cloth: Cloth) -> None:
    for kind in (np.uint16, np.uint32):
        out = np.full(cloth.index_capacity, 9, kind)
        cloth.write_indices(out, base_vertex=100)
        count = cloth.indices.size
        assert np.array_equal(out[:count], cloth.indices.ravel() + 100)
        cloth.write_indices(out, flip=True)
        a, b, c = cloth.indices[0].tolist()
        assert out[:3].tolist() in ([a, c, b], [c, b, a], [b, a, c])
    with pytest.raises(Error, match="`buffer` must hold uint16 or uint32, but holds int64"):
        cloth.write_indices(np.zeros(9999, np.int64))
    with pytest.raises(Error) as caught:
        cloth.write_indices(np.zeros(3, np.uint32))
    assert caught.value.status == Status.BUFFER_TOO_SMALL


def fine_mesh() -> tuple[np.ndarray, np.ndarray]:
    positions, triangles = plane(58, 58, 0.95 / 57, (0, 0, 0))
    return positions[:, [0, 2, 1]] * (1, -1, 1), triangles


def test_a_skin_follows_its_cloth_through_tears() -> None:
    cloth = Cloth.grid(20, 20, 0.05, pin_mode="top-corners")
    cloth.wind = muslin.Wind(velocity=(0, 0, 3))
    positions, triangles = fine_mesh()
    with cloth.skin(positions, triangles, uvs=positions[:, :2], smoothness=0.5) as skin:
        assert np.allclose(skin.positions, positions, atol=1e-5)
        assert np.allclose(skin.uvs, positions[:, :2]) and np.array_equal(skin.indices, triangles)
        cloth.step(60)
        now = skin.positions
        assert np.abs(now - positions).max() > 0.01
        distance = np.linalg.norm(now[:, np.newaxis] - cloth.positions, axis=2).min(axis=1)
        assert distance.max() < 0.05
        old, revision = skin.indices, skin.topology_revision
        assert cloth.cut((-1, -0.51, -1), (3, -0.52, -1), (0, 0, 2)) > 0
        assert len(skin.positions) > len(positions) and skin.frayed.any()
        assert skin.topology_revision != revision and skin.vertex_capacity > len(skin.positions)
        assert np.array_equal(skin.source_vertices[: len(positions)], np.arange(len(positions)))
        assert np.array_equal(skin.source_vertices[skin.indices], triangles)
        assert np.array_equal(old, triangles)
        assert np.allclose(np.linalg.norm(skin.normals, axis=1), 1, atol=1e-3)
        out = np.zeros((len(skin.positions), 3), np.float32)
        skin.write_vertices([Stream("position", out)])
        assert np.allclose(out, skin.positions, atol=1e-6)
    assert isinstance(skin, Skin) and skin.closed


def test_a_smooth_skin_bulges_over_the_triangles_of_a_coarse_cloth() -> None:
    angle = np.linspace(0, np.pi, 7)
    arc = np.stack([np.cos(angle), np.sin(angle), np.zeros(7)], axis=1)
    positions = np.concatenate([arc, arc + (0, 0, 0.5)])
    indices = [[[i, i + 1, i + 8], [i, i + 8, i + 7]] for i in range(6)]
    cloth = Cloth.mesh(positions, np.reshape(indices, (-1, 3)))
    middle = np.pi / 12 + np.array([-0.05, 0.0, 0.05])
    strip = 0.97 * np.stack([np.cos(middle), np.sin(middle), [0.2, 0.3, 0.2]], axis=1)
    skins = [cloth.skin(strip, [[0, 1, 2]], smoothness=s) for s in (0.0, 1.0)]
    cloth.set_positions(2 * positions)
    radii = [np.linalg.norm(skin.positions[1, :2]) for skin in skins]
    assert abs(radii[0] - radii[1]) > 0.01


def test_a_skin_far_from_its_cloth_is_refused(cloth: Cloth) -> None:
    positions, triangles = fine_mesh()
    with pytest.raises(Error) as caught:
        cloth.skin(positions + 50, triangles)
    assert (caught.value.status, caught.value.field) == (Status.BAD_VALUE, "positions")
    with pytest.raises(muslin.Error, match="`uvs` must have 3364 entries"):
        cloth.skin(positions, triangles, uvs=[[0, 0]])
