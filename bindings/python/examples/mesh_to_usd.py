"""Drops a cloth on a ball, cuts it, and writes the motion as a USD file with time samples.

    pip install muslin usd-core
    python mesh_to_usd.py OUT.usda [MESH.obj] [--frames 72]

Without a mesh a round cloth of 1.6 m is made. Blender, Houdini, Maya and usdview open the file. Its
triangles are time samples too, since a cut changes them.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom, Vt

import muslin

Floats = NDArray[np.floating]
Ints = NDArray[np.integer]

FRAMES_PER_SECOND = 24
CUT_AT = 48
RADIUS = 0.4


def round_cloth(rings: int = 30, radius: float = 0.8) -> tuple[Floats, Ints]:
    """Positions and triangles of a horizontal disc, 1 m above the floor."""
    positions, triangles = [(0.0, 1.0, 0.0)], []
    for ring in range(1, rings + 1):
        count, first = 6 * ring, len(positions)
        inner, inner_first = 6 * (ring - 1), first - max(1, 6 * (ring - 1))
        for at in range(count):
            angle = 2 * np.pi * at / count
            length = radius * ring / rings
            positions.append((length * np.cos(angle), 1.0, -length * np.sin(angle)))
            sector, step = divmod(at, ring)
            below = inner_first + ((ring - 1) * sector + step) % max(1, inner)
            following = first + (at + 1) % count
            triangles.append((below, first + at, following))
            if step < ring - 1:
                next_below = inner_first + ((ring - 1) * sector + step + 1) % inner
                triangles.append((below, following, next_below))
    return np.array(positions), np.array(triangles)


def read_obj(path: Path) -> tuple[Floats, Ints]:
    """Positions and triangles of an OBJ file; polygons become fans of triangles."""
    positions, triangles = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        kind, *words = line.split() or [""]
        if kind == "v":
            positions.append([float(word) for word in words[:3]])
        elif kind == "f":
            numbers = [int(word.split("/")[0]) for word in words]
            corners = [n - 1 if n > 0 else len(positions) + n for n in numbers]
            triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
    return np.array(positions), np.array(triangles)


class Writer:
    """A USD stage with a mesh that follows a cloth."""

    def __init__(self, path: Path, frames: int) -> None:
        self.stage = Usd.Stage.CreateNew(str(path))
        UsdGeom.SetStageUpAxis(self.stage, UsdGeom.Tokens.y)
        UsdGeom.SetStageMetersPerUnit(self.stage, 1.0)
        self.stage.SetTimeCodesPerSecond(FRAMES_PER_SECOND)
        self.stage.SetStartTimeCode(1)
        self.stage.SetEndTimeCode(frames)
        root = UsdGeom.Xform.Define(self.stage, "/World")
        self.stage.SetDefaultPrim(root.GetPrim())
        ball = UsdGeom.Sphere.Define(self.stage, "/World/Ball")
        ball.CreateRadiusAttr(RADIUS)
        ball.AddTranslateOp().Set(Gf.Vec3d(0, RADIUS, 0))
        self.mesh = UsdGeom.Mesh.Define(self.stage, "/World/Cloth")
        self.mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        self.mesh.CreateDoubleSidedAttr(True)
        self.mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
        self.revision: int | None = None

    def write(self, frame: int, cloth: muslin.Cloth) -> None:
        """Writes the cloth as it is as the samples of a frame."""
        time, positions = Usd.TimeCode(frame), cloth.positions
        self.mesh.CreatePointsAttr().Set(Vt.Vec3fArray.FromNumpy(positions), time)
        self.mesh.CreateNormalsAttr().Set(Vt.Vec3fArray.FromNumpy(cloth.normals), time)
        box = [Gf.Vec3f(*map(float, corner)) for corner in (positions.min(0), positions.max(0))]
        self.mesh.CreateExtentAttr().Set(Vt.Vec3fArray(box), time)
        if cloth.topology_revision != self.revision:
            self.revision = cloth.topology_revision
            triangles = cloth.indices.astype(np.int32)
            counts = np.full(len(triangles), 3, np.int32)
            self.mesh.CreateFaceVertexCountsAttr().Set(Vt.IntArray.FromNumpy(counts), time)
            corners = Vt.IntArray.FromNumpy(triangles.ravel())
            self.mesh.CreateFaceVertexIndicesAttr().Set(corners, time)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("out", type=Path)
    parser.add_argument("mesh", type=Path, nargs="?")
    parser.add_argument("--frames", type=int, default=72)
    arguments = parser.parse_args()
    positions, triangles = read_obj(arguments.mesh) if arguments.mesh else round_cloth()
    cloth = muslin.Cloth.mesh(
        positions,
        triangles,
        weld_distance=0,
        material="silk",
        settings=muslin.Settings(self_collision="surface"),
    )
    print(f"{cloth}; the mesh had {cloth.mesh_report.welded_vertices} vertices too many")
    cloth.add_collider("plane")
    cloth.add_collider("sphere", position=(0, RADIUS, 0), radius=RADIUS, friction=0.5)
    arguments.out.unlink(missing_ok=True)
    writer = Writer(arguments.out, arguments.frames)
    for frame in range(1, arguments.frames + 1):
        if frame == CUT_AT:
            edges = cloth.cut((0.05, 2, -2), (0.05, -1, -2), (0, 0, 4))
            print(f"frame {frame}: the cut opened {edges} edges")
        cloth.advance(1 / FRAMES_PER_SECOND)
        writer.write(frame, cloth)
    writer.stage.GetRootLayer().Save()
    print(f"{arguments.out}: {arguments.frames} frames of {len(cloth.positions)} vertices")


if __name__ == "__main__":
    main()
