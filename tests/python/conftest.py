"""The cloth of many tests."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

import muslin


@pytest.fixture
def cloth() -> Iterator[muslin.Cloth]:
    """A grid of 20 x 20 particles that hangs, after half a second."""
    with muslin.Cloth.grid(20, 20, 0.05) as made:
        made.step(30)
        yield made
