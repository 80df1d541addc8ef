"""Meshes that several tests use."""

from __future__ import annotations

import numpy as np


def plane(
    columns: int, rows: int, spacing: float, at: tuple[float, float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Positions and triangles of a horizontal sheet with its first corner at `at`. The diagonals of
    its cells alternate, so that it is no grid for the library."""
    row, column = np.mgrid[0:rows, 0:columns]
    offsets = np.stack([column, np.zeros_like(row), row], axis=-1) * spacing
    number = np.arange(rows * columns).reshape(rows, columns)
    corners = number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:]
    a, b, c, d = (corner.ravel() for corner in corners)
    one = np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)])
    other = np.concatenate([np.stack([a, c, d], 1), np.stack([a, d, b], 1)])
    is_even = np.tile((row + column)[:-1, :-1].ravel() % 2 == 0, 2)
    triangles = np.where(is_even[:, np.newaxis], one, other)
    return offsets.reshape(-1, 3) + np.array(at), triangles
