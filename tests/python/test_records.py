"""Settings, materials, wind and reports as dataclasses."""

from __future__ import annotations

import ctypes
import inspect
import pickle
from dataclasses import fields, replace

import pytest

import muslin
from muslin import Cloth, Material, Settings, Wind
from muslin._convert import to_vec3
from muslin._generated.constants import PRESETS, SHAPES
from muslin._generated.structs import MuslinColliderDesc, MuslinGridDesc
from muslin._library import init
from muslin._record import Record


@pytest.mark.parametrize("kind", [Material, Settings, Wind])
def test_defaults_are_those_of_the_library(kind: type[Record]) -> None:
    assert bytes(kind()._to_c("it")) == bytes(kind._empty())
    assert kind._from_c(kind._empty()) == kind()
    assert [field.name for field in fields(kind)] == list(kind._kinds)


def test_defaults_of_colliders_are_those_of_the_library() -> None:
    desc = MuslinColliderDesc()
    init(desc, "muslin_collider_desc_init_sized")
    parameters = inspect.signature(Cloth.add_collider).parameters
    assert set(parameters) >= {name for name, *_ in desc._fields_} - {
        "struct_size",
        "columns",
        "rows",
        "position_stride",
        "vertex_count",
        "index_count",
        "reserved",
    }
    for name in ["tangential_restitution", "radius", "half_height", "spacing", "solid"]:
        assert parameters[name].default == getattr(desc, name)
    for name in ["friction", "restitution", "thickness", "top_radius"]:
        assert parameters[name].default is None and getattr(desc, name) == -1
    for name in ["position", "half_extents"]:
        assert bytes(to_vec3(parameters[name].default, name)) == bytes(getattr(desc, name))
    assert desc.shape == SHAPES[parameters["shape"].default]


def test_defaults_of_grids_are_those_of_the_library() -> None:
    desc = MuslinGridDesc()
    sizes = [ctypes.sizeof(kind) for kind in (desc, Material._struct, Settings._struct)]
    muslin._library.lib.muslin_grid_desc_init_sized(desc, *sizes)
    parameters = inspect.signature(Cloth.grid).parameters
    for name in ["columns", "rows"]:
        assert parameters[name].default == getattr(desc, name)
    assert ctypes.c_float(parameters["spacing"].default).value == desc.spacing
    for name in ["origin", "right", "down"]:
        assert bytes(to_vec3(parameters[name].default, name)) == bytes(getattr(desc, name))
    cloth = Cloth.grid()
    assert (cloth.material, cloth.settings, cloth.wind) == (Material(), Settings(), Wind())
    assert cloth.pinned.tolist() == list(range(40)) and cloth.vertex_capacity == 2 * 1600
    assert Cloth.grid(extra_particles=0).vertex_capacity == 1600


def test_presets_differ_and_may_be_given_by_name() -> None:
    presets = [Material.preset(name) for name in PRESETS]
    assert len({preset.density for preset in presets}) == len(PRESETS)
    cloth = Cloth.grid(3, 3, material="denim")
    assert cloth.material == Material.preset("denim") and cloth.material.density == 0.38
    cloth.material = "paper"
    assert cloth.material == Material.preset("paper") and cloth.material.yield_angle > 0


def test_a_changed_copy_replaces_settings_material_and_wind() -> None:
    cloth = Cloth.grid(3, 3, settings=Settings(self_collision="surface", gravity=(0, 0, -9.81)))
    assert cloth.settings == Settings(self_collision="surface", gravity=(0.0, 0.0, -9.81))
    cloth.settings = replace(cloth.settings, iterations=6, tethers=False)
    assert (cloth.settings.iterations, cloth.settings.tethers) == (6, False)
    assert cloth.settings.self_collision == "surface"
    cloth.material = replace(cloth.material, friction=0.1)
    assert cloth.material == Material(friction=0.1)
    cloth.wind = Wind(model="sine-field", velocity=[1, 2, 3], seed=5)  # type: ignore[arg-type]
    assert cloth.wind == Wind(model="sine-field", velocity=(1.0, 2.0, 3.0), seed=5)


def test_every_field_reaches_the_library_and_comes_back() -> None:
    odd = {"tick": 0.01, "model": "sine-field", "self_collision": "particles", "tethers": False}
    odd |= {"tearing": True, "gravity": (1.0, 2.0, 3.0), "velocity": (1.0, 2.0, 3.0)}
    odd |= {"tear_stretch": 1.5}
    cloth = Cloth.grid(3, 3)
    for kind, name in [(Settings, "settings"), (Material, "material"), (Wind, "wind")]:
        for field in fields(kind):
            value = odd.get(field.name, 7 if field.type is int else 0.75)
            changed = replace(kind(), **{field.name: value})
            setattr(cloth, name, changed)
            assert getattr(cloth, name) == changed != kind(), field.name


def test_records_can_be_pickled_and_compared() -> None:
    for record in [Settings(tick=0.01), Material.preset("silk"), Wind(gust=0.5)]:
        assert pickle.loads(pickle.dumps(record)) == record != type(record)()
        assert "=" in repr(record)


def test_time_runs_in_ticks() -> None:
    cloth = Cloth.grid(3, 3)
    assert cloth.advance(0.04) == 2 and cloth.ticks == 2
    assert cloth.blend == pytest.approx(0.4, abs=1e-5) == cloth.stats.blend
    assert cloth.time == pytest.approx(2 / 60)
    assert cloth.advance(1) == cloth.settings.max_ticks_per_advance == 5
    cloth.step(3)
    assert cloth.ticks == 10
    cloth.reset()
    assert (cloth.ticks, cloth.time) == (0, 0)
    assert not cloth.is_asleep
    cloth.settings = replace(cloth.settings, sleep_speed=1000)
    cloth.step(60)
    assert cloth.is_asleep and cloth.stats.asleep


def test_a_cloth_shows_its_size() -> None:
    assert repr(Cloth.grid(3, 3)) == "<muslin.Cloth of 9 vertices and 8 triangles>"


def test_stats_name_the_stages() -> None:
    cloth = Cloth.grid()
    assert set(cloth.stats.seconds.values()) == {0}
    cloth.step()
    stats = cloth.stats
    assert stats.seconds["stretch"] > 0 and len(stats.seconds) >= 15
    assert (stats.particles, stats.triangles, stats.pieces) == (1600, 2 * 39 * 39, 1)
    assert stats.bytes > 1_000_000 and stats.max_speed > 0
