"""Sews two panels to a tunic on a body, and writes one OBJ file per frame.

    python pattern_to_obj.py OUT_FOLDER [--frames 60]

The panels start flat, in front of the body and behind it. Sides and shoulders are sewn, without
gravity until they are closed; the neck, the arms and the hem stay open.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import muslin

Floats = NDArray[np.floating]
Ints = NDArray[np.integer]

COLUMNS, ROWS = 25, 37
HEIGHT, CHEST, HEM = 0.75, 0.50, 0.62  # of a panel [m]
SHOULDER = 7  # sewn particles of the top edge, on either side
ARM = 11  # open rows below the shoulder

SETTINGS = muslin.Settings(self_collision="surface", max_stretch=0.03)


def panel(z: float) -> tuple[Floats, Floats, Ints]:
    """Positions, uvs and triangles of a panel at this z, facing along z."""
    row, column = np.mgrid[0:ROWS, 0:COLUMNS]
    down, across = row / (ROWS - 1), column / (COLUMNS - 1)
    width = CHEST + (HEM - CHEST) * down
    positions = np.stack([(across - 0.5) * width, 1.46 - HEIGHT * down, np.full(row.shape, z)], -1)
    number = np.arange(ROWS * COLUMNS).reshape(ROWS, COLUMNS)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:]
    triangles = np.stack([np.stack([a, c, b], -1), np.stack([b, c, d], -1)], axis=2)
    return (
        positions.reshape(-1, 3),
        np.stack([across, 1 - down], -1).reshape(-1, 2),
        (triangles.reshape(-1, 3)),
    )


def tunic() -> tuple[muslin.Cloth, Ints]:
    """The cloth of both panels, which are being sewn, and the pairs of particles."""
    front, uvs, triangles = panel(0.17)
    back, _, _ = panel(-0.17)
    count = len(front)
    positions = np.concatenate([front, back])
    # The back faces the other way.
    indices = np.concatenate([triangles, triangles[:, ::-1] + count])
    cloth = muslin.Cloth.mesh(
        positions,
        indices,
        uvs=np.concatenate([uvs, uvs]),
        extra_particles=0,
        material="cotton",
        settings=replace(SETTINGS, gravity=(0, 0, 0)),
    )
    number = np.arange(count).reshape(ROWS, COLUMNS)
    shoulders = np.concatenate([number[0, :SHOULDER], number[0, -SHOULDER:]])
    sides = np.concatenate([number[ARM:, 0], number[ARM:, -1]])
    seam = np.unique(np.concatenate([shoulders, sides]))
    pairs = np.stack([seam, seam + count], axis=1)
    cloth.sew(pairs, speed=0.6)
    return cloth, pairs


def add_body(cloth: muslin.Cloth) -> None:
    """Adds a torso, shoulders and a neck as capsules, and a floor."""
    quarter_turn = (0.0, 0.0, 0.5**0.5, 0.5**0.5)  # the axis of a capsule to x
    cloth.add_collider("capsule", position=(0, 1.05, 0), half_height=0.25, radius=0.13)
    cloth.add_collider(
        "capsule", position=(0, 1.38, 0), rotation=quarter_turn, half_height=0.19, radius=0.06
    )
    cloth.add_collider("capsule", position=(0, 1.5, 0), half_height=0.08, radius=0.05)
    cloth.add_collider("plane")


def count_closed(cloth: muslin.Cloth, pairs: Ints) -> int:
    """Number of pairs whose particles are at one place."""
    one, other = cloth.positions[pairs[:, 0]], cloth.positions[pairs[:, 1]]
    return int((one == other).all(axis=1).sum())


def write_obj(path: Path, cloth: muslin.Cloth) -> None:
    """Writes the present vertices, texture coordinates and triangles."""
    with path.open("w", encoding="ascii") as file:
        np.savetxt(file, cloth.positions, "v %.6f %.6f %.6f")
        np.savetxt(file, cloth.uvs, "vt %.6f %.6f")
        corners = np.repeat(cloth.indices + 1, 2, axis=1)  # counted from 1
        np.savetxt(file, corners, "f %d/%d %d/%d %d/%d")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--frames", type=int, default=60)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    cloth, pairs = tunic()
    add_body(cloth)
    for frame in range(arguments.frames):
        cloth.advance(1 / 30)
        write_obj(arguments.folder / f"tunic_{frame + 1:04}.obj", cloth)
        closed = count_closed(cloth, pairs)
        if closed == len(pairs):
            cloth.settings = SETTINGS
    print(f"{arguments.frames} files; {closed} of {len(pairs)} pairs are closed")


if __name__ == "__main__":
    main()
