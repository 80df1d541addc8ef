"""Cloths that several tests use."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import muslin


@pytest.fixture
def cloth() -> Iterator[muslin.Cloth]:
    """A grid of 20 x 20 particles that hangs, after half a second."""
    with muslin.Cloth.grid(20, 20, 0.05) as made:
        made.step(30)
        yield made


def plane(columns: int, rows: int, spacing: float, at: tuple[float, float, float]) -> tuple[
    np.ndarray, np.ndarray
]:
    """Positions and triangles of a horizontal sheet with its first corner at `at`. The diagonals of
    its cells alternate, so that it is no grid for the library."""
    row, column = np.mgrid[0:rows, 0:columns]
    offsets = np.stack([column, np.zeros_like(row), row], axis=-1) * spacing
    number = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = (part.ravel() for part in (
        number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:],
    ))
    one = np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)])
    other = np.concatenate([np.stack([a, c, d], 1), np.stack([a, d, b], 1)])
    is_even = np.tile((row + column)[:-1, :-1].ravel() % 2 == 0, 2)
    triangles = np.where(is_even[:, np.newaxis], one, other)
    return offsets.reshape(-1, 3) + np.array(at), triangles
