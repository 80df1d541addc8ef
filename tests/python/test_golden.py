"""The script of tests/c/script.c: Python must end in the hash of tests/script.hash."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import muslin

GOLDEN = int(Path(__file__).parents[1].joinpath("script.hash").read_text(), 16)


def hang_in_the_wind() -> muslin.Cloth:
    cloth = muslin.Cloth.grid(
        material=muslin.Material(tear_stretch=1.5), settings=muslin.Settings(tearing=True)
    )
    cloth.wind = muslin.Wind(
        velocity=(0.25, 0.0, 1.0), gust=0.5, wander=0.25, turbulence=0.25, seed=7
    )
    assert cloth.add_collider("plane", position=(0, -2.5, 0)).id != 0
    cloth.step(120)
    return cloth


def play_script() -> muslin.Cloth:
    cloth = hang_in_the_wind()
    held = cloth.grab_ray((1, -1, 5), (0, 0, -1), 0.1)
    assert held is not None
    grab, (x, y, z) = held
    for i in range(1, 121):
        cloth.move_grab(grab, (x + 0.015625 * i, y, z + 0.03125 * i))
        cloth.step()
    assert cloth.tear_edge(820, 860)
    cloth.release(grab)
    cloth.step(180)
    assert cloth.cut((-1, -0.59375, -9), (3, -0.78125, -9), (0, 0, 18)) > 40
    cloth.step(30)
    cloth.unpin_all()
    cloth.step(120)
    cloth.pin(0, (0, 0, 0.5))
    cloth.step(59)
    assert cloth.advance(1 / 60) == 1
    return cloth


def test_the_script_ends_in_the_golden_hash() -> None:
    cloth = play_script()
    assert sum(isinstance(event, muslin.EdgeTorn) for event in cloth.events()) >= 10
    assert hex(cloth.state_hash()) == hex(GOLDEN)


def test_restored_and_copied_cloths_continue_with_the_same_bits() -> None:
    straight = play_script()
    others = [
        muslin.Cloth.restore(straight.save()),
        muslin.Cloth.restore(memoryview(bytearray(straight.save()))),
        copy.deepcopy(straight),
        pickle.loads(pickle.dumps(straight)),
    ]
    assert {cloth.state_hash() for cloth in others} == {GOLDEN}
    for cloth in [straight, *others]:
        cloth.step(60)
        assert cloth.tear_edge(400, 401)
        cloth.step(60)
    assert len({cloth.state_hash() for cloth in [straight, *others]}) == 1
    assert straight.state_hash() != GOLDEN
