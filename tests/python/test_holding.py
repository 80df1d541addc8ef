"""Pins, attachments, anchors, the frame, positions, masses, maps."""

from __future__ import annotations

import math

import numpy as np
import pytest

import muslin
from muslin import Cloth, Error, Status

HALF_TURN = (0.0, 1.0, 0.0, 0.0)


def test_pins_hold_particles_at_their_targets(cloth: Cloth) -> None:
    cloth.pin(399)
    cloth.pin(210, (0.5, -0.4, 0.3))
    assert cloth.pinned.tolist() == [*range(20), 210, 399]
    cloth.step(2)
    assert np.allclose(cloth.positions[210], (0.5, -0.4, 0.3), atol=1e-6)
    cloth.set_pin_targets(np.array([0, 210]), [[0, 0.1, 0], (0.5, -0.4, 0.2)])
    assert cloth.pin_targets([210]).tolist() == [pytest.approx([0.5, -0.4, 0.2])]
    targets = cloth.pin_targets()
    assert targets.shape == (22, 3) and np.allclose(targets[0], (0, 0.1, 0))
    cloth.unpin(210)
    cloth.unpin(210)
    assert len(cloth.pinned) == 21
    cloth.unpin_all()
    assert len(cloth.pinned) == 0 and cloth.pin_targets().shape == (0, 3)
    with pytest.raises(Error) as caught:
        cloth.pin_targets([3])
    assert caught.value.status == Status.BAD_VALUE


def test_a_soft_pin_yields(cloth: Cloth) -> None:
    corners = [0, 19]
    cloth.unpin_all()
    for corner in corners:
        cloth.pin(corner)
    cloth.set_pin_stiffness(corners, 10)
    targets = cloth.pin_targets()
    cloth.step(120)
    assert (targets[:, 1] - cloth.positions[corners][:, 1] > 0.02).all()


def test_attachments_carry_their_particles(cloth: Cloth) -> None:
    edge = np.arange(20)
    before = cloth.positions[:20].copy()
    pole = cloth.attach(edge, (0, 0, 0))
    cloth.move_attachment(pole, (0, 1, 0), HALF_TURN)
    cloth.step(1)
    expected = before * (-1, 1, -1) + (0, 1, 0)
    assert np.allclose(cloth.positions[:20], expected, atol=1e-5)
    cloth.detach(pole)
    assert len(cloth.pinned) == 0
    with pytest.raises(Error) as caught:
        cloth.move_attachment(pole, (0, 0, 0))
    assert (caught.value.status, caught.value.field) == (Status.BAD_HANDLE, "attachment")


def test_anchors_limit_distances_and_backstops_keep_particles_out(cloth: Cloth) -> None:
    particles = np.arange(20, 400)
    anchors = cloth.positions[particles].copy()
    cloth.set_anchors(particles, anchors, np.tile([0.0, 0, 1], (380, 1)))
    cloth.set_max_distances(particles, np.full(380, 0.05))
    cloth.set_backstops(particles, np.zeros(380), np.full(380, 10))
    cloth.wind = muslin.Wind(velocity=(0, 0, -8))
    cloth.step(60)
    moved = cloth.positions[particles] - anchors
    assert np.linalg.norm(moved, axis=1).max() < 0.0501
    assert moved[:, 2].min() > -1e-3
    cloth.set_anchors(particles, anchors)
    cloth.clear_leashes()
    cloth.step(60)
    assert (cloth.positions[particles] - anchors)[:, 2].min() < -0.05


def test_the_frame_carries_the_cloth(cloth: Cloth) -> None:
    before = cloth.positions.copy()
    cloth.set_frame((0, 0, 0))
    cloth.teleport((3, 0, 0), HALF_TURN)
    assert np.allclose(cloth.positions, before * (-1, 1, -1) + (3, 0, 0), atol=1e-5)
    still = Cloth.restore(cloth.save())
    cloth.move_frame((3, 0, 5), HALF_TURN)
    cloth.step()
    still.step()
    assert np.allclose(cloth.positions, still.positions + (0, 0, 5), atol=1e-4)
    felt = Cloth.restore(still.save())
    felt.move_frame((3, 0, 0.1), HALF_TURN, inertia=1)
    felt.step()
    assert np.abs(felt.positions[399] - still.positions[399])[2] < 0.05


def test_far_from_zero_relative_positions_are_exact() -> None:
    near, far = Cloth.grid(20, 20), Cloth.grid(20, 20)
    far.teleport((5000, 0, 0))
    near.step(30)
    far.step(30)
    assert near.origin == (0, 0, 0) and far.origin[0] == pytest.approx(5000, abs=16)
    assert np.array_equal(near.relative_positions, near.positions)
    offset = far.relative_positions + np.float32(far.origin[0] - 5000) * np.array([1, 0, 0])
    assert np.abs(offset - near.positions).max() < 1e-4
    assert np.allclose(far.positions, far.relative_positions + far.origin, atol=1e-3)


def test_poses_are_recorded_and_played_back(cloth: Cloth) -> None:
    pose, velocities = cloth.positions.copy(), cloth.velocities
    assert cloth.velocity(399) == pytest.approx(velocities[399].tolist())
    cloth.step(10)
    cloth.set_positions(pose)
    cloth.set_velocities(velocities.astype(np.float64))
    assert np.array_equal(cloth.positions, pose) and np.array_equal(cloth.velocities, velocities)
    cloth.set_positions(pose[:2] + 1, first=398)
    cloth.set_position(0, (7, 8, 9))
    cloth.set_velocity(397, np.array([1, 2, 3]))
    assert cloth.position(0) == (7, 8, 9) and cloth.velocity(397) == (1, 2, 3)
    assert np.allclose(cloth.positions[398:], pose[:2] + 1)
    rest = cloth.rest_positions
    assert np.allclose(rest[399], (0.95, -0.95, 0)) and rest.flags.writeable


def test_lists_that_are_not_contiguous_are_read_by_their_strides(cloth: Cloth) -> None:
    pose = cloth.positions.copy()
    wide = np.zeros((400, 8), np.float32)
    wide[:, 2:5] = pose + 0.5
    cloth.set_positions(wide[:, 2:5])
    assert np.array_equal(cloth.positions, pose + np.float32(0.5))
    cloth.set_positions(np.asfortranarray(pose))
    assert np.array_equal(cloth.positions, pose)


def test_mass_follows_density_area_and_scales(cloth: Cloth) -> None:
    mass = cloth.mass_properties
    assert mass.total == pytest.approx(0.18 * 0.95**2, rel=1e-4)
    assert np.allclose(mass.center, (0.475, -0.475, 0), atol=0.02)
    cloth.set_mass_scales([0, 1, 2], [1, 1, 100])
    added = cloth.mass_properties.total - mass.total
    assert added == pytest.approx(99 * 0.18 * 0.05**2 / 2, rel=1e-3)
    with pytest.raises(Error, match="scales"):
        cloth.set_mass_scales([0], [1e4])


def test_maps_are_painted_read_and_taken_away(cloth: Cloth) -> None:
    assert cloth.map("bend") is None
    scales = np.linspace(0, 2, 400)
    cloth.set_map("bend", scales)
    painted = cloth.map("bend")
    assert painted is not None and np.array_equal(painted, scales.astype(np.float32))
    assert cloth.tear_edge(210, 211)
    painted = cloth.map("bend")
    assert painted is not None and len(painted) == 401
    cloth.set_map("bend", None)
    assert cloth.map("bend") is None and cloth.map("tear") is None


def test_infinite_max_distances_are_allowed(cloth: Cloth) -> None:
    cloth.set_max_distances([5], [math.inf])
    with pytest.raises(Error):
        cloth.set_max_distances([5], [math.nan])
