"""Lists of a cloth are views of the library's memory: read only, without a copy, safe."""

from __future__ import annotations

import ctypes
import gc
import weakref

import numpy as np
import pytest

import muslin
from shapes import plane

LISTS = {
    "positions": (np.float32, 3),
    "normals": (np.float32, 3),
    "uvs": (np.float32, 2),
    "indices": (np.uint32, 3),
    "source_vertices": (np.uint32, 0),
    "frayed": (np.bool_, 0),
    "vertex_particles": (np.uint32, 0),
}


@pytest.mark.parametrize("name", LISTS)
def test_each_access_gives_a_fresh_array_over_the_same_memory(
    cloth: muslin.Cloth, name: str
) -> None:
    one, other = getattr(cloth, name), getattr(cloth, name)
    kind, width = LISTS[name]
    rows = 2 * 19 * 19 if name == "indices" else 400
    assert one is not other and np.shares_memory(one, other)
    assert one.dtype == kind and one.shape == ((rows, width) if width else (rows,))
    assert one.flags.c_contiguous and one.ctypes.data == other.ctypes.data


def test_a_view_shows_the_numbers_of_the_librarys_memory(cloth: muslin.Cloth) -> None:
    positions = cloth.positions
    numbers = (ctypes.c_float * positions.size).from_address(positions.ctypes.data)
    assert ctypes.addressof(numbers) == positions.ctypes.data
    before = positions.copy()
    assert list(numbers) == before.ravel().tolist()
    cloth.set_position(399, (5, 6, 7))
    assert list(numbers)[-3:] == [5, 6, 7]
    assert np.array_equal(before[:-1], positions[:-1])


@pytest.mark.parametrize("name", LISTS)
def test_a_view_cannot_be_written(cloth: muslin.Cloth, name: str) -> None:
    view = getattr(cloth, name)
    with pytest.raises(ValueError, match="read-only"):
        view[0] = 0
    with pytest.raises(ValueError):
        view.flags.writeable = True
    with pytest.raises(muslin.Error, match=r"`streams\[0\].array` must be an array that can be"):
        cloth.write_vertices([muslin.Stream("position", view)])


def test_views_keep_their_addresses_through_tears_cuts_and_resets() -> None:
    settings = muslin.Settings(tearing=True)
    cloth = muslin.Cloth.grid(30, 30, settings=settings, material=muslin.Material(tear_stretch=1.2))
    old = {name: getattr(cloth, name) for name in LISTS}
    addresses = {name: view.ctypes.data for name, view in old.items()}
    assert cloth.cut((-1, -0.71, -1), (3, -0.73, -1), (0, 0, 2)) > 0
    grab = cloth.grab_particle(895)
    for frame in range(60):
        cloth.move_grab(grab, (0.7 + frame * 0.05, -1.4 - frame * 0.05, 0.2))
        cloth.step()
    assert len(cloth.positions) > 920
    for name, view in old.items():
        now = getattr(cloth, name)
        assert now.ctypes.data == addresses[name], name
        assert np.array_equal(view, now[: len(view)]), name
    cloth.reset()
    assert {name: getattr(cloth, name).ctypes.data for name in LISTS} == addresses
    assert len(cloth.positions) == 900


def test_a_view_outlives_its_cloth() -> None:
    cloth = muslin.Cloth.grid(30, 30)
    cloth.step(30)
    view, copy = cloth.positions, cloth.positions.copy()
    row = view[400]
    cloth.close()
    del cloth
    gc.collect()
    others = [muslin.Cloth.grid(30, 30, origin=(9, 9, 9)) for _ in range(20)]
    assert np.array_equal(view, copy)
    del view
    gc.collect()
    others += [muslin.Cloth.grid(30, 30, origin=(9, 9, 9)) for _ in range(20)]
    assert np.array_equal(row, copy[400])


def test_the_last_view_frees_a_forgotten_cloth() -> None:
    cloth = muslin.Cloth.grid(3, 3)
    handle, view = weakref.ref(cloth._live), cloth.positions
    del cloth
    gc.collect()
    assert handle() is not None
    del view
    gc.collect()
    assert handle() is None


def test_revisions_and_changes_tell_what_to_upload(cloth: muslin.Cloth) -> None:
    seen, state = cloth.topology_revision, cloth.state_revision
    everything = cloth.changes(0)
    assert (everything.first_vertex, everything.vertex_count) == (0, 400)
    assert (everything.first_index, everything.index_count) == (0, cloth.indices.size)
    before, uvs = cloth.indices.copy(), cloth.uvs.copy()
    cloth.step()
    assert cloth.topology_revision == seen and cloth.state_revision != state
    assert cloth.changes(seen) == muslin.Changes(
        first_vertex=0, vertex_count=0, first_index=0, index_count=0
    )
    assert cloth.tear_edge(210, 211)
    assert cloth.topology_revision != seen
    changes, after = cloth.changes(seen), cloth.indices.ravel()
    differs = np.flatnonzero(before.ravel() != after)
    assert changes.first_index <= differs[0]
    assert differs[-1] < changes.first_index + changes.index_count < after.size
    assert changes.first_vertex + changes.vertex_count == len(cloth.uvs) == len(uvs) + 1


def test_a_welded_mesh_has_several_vertices_per_particle() -> None:
    (left, triangles), (right, _) = plane(5, 5, 0.1, (0, 0, 0)), plane(5, 5, 0.1, (0.4, 0, 0))
    positions = np.concatenate([left, right])
    indices = np.concatenate([triangles, triangles + 25])
    uvs = positions[:, [0, 2]]
    cloth = muslin.Cloth.mesh(positions, indices, uvs=uvs, weld_distance=1e-4, pinned=[0])
    assert np.allclose(cloth.uvs, uvs)
    assert cloth.mesh_report.welded_vertices == 5 and not cloth.mesh_report.is_grid
    assert len(cloth.positions) == 50 and cloth.particle_count == 45 == cloth.stats.particles
    particles = cloth.vertex_particles
    assert particles[4] == particles[25] and len(cloth.velocities) == 45
    cloth.step(10)
    assert np.array_equal(cloth.positions[4], cloth.positions[25])
    assert cloth.position(int(particles[25])) == tuple(cloth.positions[25].tolist())
    assert cloth.pinned.tolist() == [0]


def test_short_edges_are_collapsed_and_their_vertices_share_a_particle() -> None:
    positions, triangles = plane(5, 5, 0.1, (0, 0, 0))
    positions[13] = positions[12] + (0.001, 0, 0)
    cloth = muslin.Cloth.mesh(positions, triangles, simplify_below=0.02)
    report = cloth.mesh_report
    assert (report.collapsed_edges, report.collapsed_triangles, report.short_edges) == (1, 2, 0)
    assert cloth.particle_count == 24 and report.shortest_edge > 0.02
    assert len(cloth.positions) == 25
    assert cloth.vertex_particles[12] == cloth.vertex_particles[13]


def test_particle_counts_include_those_of_tears(cloth: muslin.Cloth) -> None:
    assert cloth.tear_edge(210, 211)
    assert cloth.particle_count == cloth.stats.particles == 401
    assert cloth.velocities.shape == cloth.rest_positions.shape == (401, 3)
    assert cloth.mesh_report.particles == 400
    assert cloth.vertex_capacity >= 800 and cloth.index_capacity >= cloth.indices.size


def test_the_mesh_report_measures_the_mesh_and_warns() -> None:
    # A right triangle of 1 m and 2 m, and a thin one with a height of 2 mm on an edge of 1 m.
    positions = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0.5, -0.002, 0]])
    cloth = muslin.Cloth.mesh(positions, [[0, 1, 2], [1, 0, 3]])
    report = cloth.mesh_report
    assert report.worst_aspect == pytest.approx(500, rel=1e-4)
    assert (report.thin_triangles, report.thinnest_triangle) == (1, 1)
    assert report.shortest_edge == pytest.approx(0.5, abs=1e-4)
    assert report.mean_edge == pytest.approx((1 + 2 + 5**0.5 + 1.000008) / 5, rel=1e-5)
    (warning,) = cloth.mesh_warnings
    assert warning.endswith("of the longest edge; the thinnest is triangle 1")
    assert muslin.Cloth.grid(3, 3).mesh_warnings == ()
