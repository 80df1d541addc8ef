"""The examples run, and their files hold what they should."""

from __future__ import annotations

import re
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom

PACKAGE = Path(__file__).parents[2] / "bindings/python"
EXAMPLES = PACKAGE / "examples"


def run(example: str, *arguments: object) -> str:
    """Runs an example and returns what it prints."""
    command = [sys.executable, str(EXAMPLES / example), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_code_of_the_readme_runs() -> None:
    blocks = re.findall(r"```py\n(.*?)```", (PACKAGE / "README.md").read_text(), re.S)
    assert len(blocks) == 1
    for block in blocks:
        done = subprocess.run([sys.executable, "-c", block], capture_output=True, text=True)
        assert done.returncode == 0 and "1600 vertices" in done.stdout, done.stderr


def test_a_pattern_is_sewn_and_written_as_obj_files(tmp_path: Path) -> None:
    printed = run("pattern_to_obj.py", tmp_path / "frames", "--frames", 24)
    files = sorted((tmp_path / "frames").iterdir())
    assert [file.name for file in files[:2]] == ["tunic_0001.obj", "tunic_0002.obj"]
    assert len(files) == 24 and "66 of 66 pairs are closed" in printed
    rows: dict[str, list[list[str]]] = {"v": [], "vt": [], "f": []}
    for line in files[-1].read_text().splitlines():
        kind, *words = line.split()
        rows[kind].append(words)
    positions = np.array(rows["v"], float)
    corners = np.array([[corner.split("/") for corner in face] for face in rows["f"]], int)
    assert len(positions) == len(rows["vt"]) == 2 * 25 * 37 and len(corners) == 4 * 24 * 36
    assert corners.min() == 1 and corners.max() == len(positions)
    assert np.array_equal(corners[..., 0], corners[..., 1])
    # It hangs on the shoulders, around the torso.
    x, y, z = positions.T
    assert 1.4 < y.max() < 1.6 and 0.5 < y.min() < 0.9
    inside = (np.abs(y - 1.05) < 0.25) & (np.hypot(x, z) < 0.13)
    assert not inside.any()


@pytest.mark.parametrize("ending", ["usda", "usdc"])
def test_a_mesh_falls_is_cut_and_written_as_usd(tmp_path: Path, ending: str) -> None:
    out = tmp_path / f"cloth.{ending}"
    mesh: list[Path] = []
    if ending == "usda":  # a mesh of one's own: a square of quads
        side = range(21)
        lines = [f"v {x / 20 - 0.5} 0.85 {z / 20 - 0.5}" for z in side for x in side]
        for z in side[:-1]:
            for x in side[:-1]:
                a = 21 * z + x + 1
                lines.append(f"f {a}/1/1 {a + 21}/1/1 {a + 22}/1/1 {a + 1}/1/1")
        mesh = [tmp_path / "square.obj"]
        mesh[0].write_text("# a square\n" + "\n".join(lines) + "\n")
    printed = run("mesh_to_usd.py", out, *mesh, "--frames", 50)
    assert "the cut opened" in printed and "50 frames" in printed
    stage = Usd.Stage.Open(str(out))
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1, 50)
    assert UsdGeom.GetStageUpAxis(stage) == "Y" and UsdGeom.GetStageMetersPerUnit(stage) == 1
    cloth = UsdGeom.Mesh(stage.GetPrimAtPath("/World/Cloth"))
    points = cloth.GetPointsAttr()
    assert points.GetTimeSamples() == list(range(1, 51))
    indices = cloth.GetFaceVertexIndicesAttr()
    assert indices.GetTimeSamples() == [1, 48]
    for frame in (1, 47, 48, 50):
        positions, corners = np.array(points.Get(frame)), np.array(indices.Get(frame))
        counts = np.array(cloth.GetFaceVertexCountsAttr().Get(frame))
        assert (counts == 3).all() and counts.sum() == len(corners)
        assert corners.max() == len(positions) - 1 == len(cloth.GetNormalsAttr().Get(frame)) - 1
    assert len(points.Get(48)) > len(points.Get(47)) == len(points.Get(1))
    assert positions[:, 1].min() > -1e-3 and 0.7 < positions[:, 1].max() < 0.85
    assert np.linalg.norm(positions - (0, 0.4, 0), axis=1).min() > 0.399


def test_a_mesh_of_blender_is_baked_into_a_cache(tmp_path: Path) -> None:
    pytest.importorskip("bpy", reason="Blender as a module is large: pip install bpy")
    run("blender_bake.py", tmp_path / "drape.blend", "--frames", 30)
    assert (tmp_path / "drape.blend").exists()
    data = (tmp_path / "drape.pc2").read_bytes()
    assert struct.unpack("<12siiffi", data[:32]) == (b"POINTCACHE2\0", 1, 51 * 51, 1, 1, 30)
    frames = np.frombuffer(data[32:], "<f4").reshape(30, 51 * 51, 3)
    assert not frames[0, :, 2].any()  # in the space of the object, which is 0.8 m above zero
    assert np.linalg.norm(frames[-1] + (0, 0, 0.8), axis=1).min() > 0.499 - 0.005
