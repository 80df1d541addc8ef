"""Drapes a mesh of Blender over another one, and bakes the motion into a Mesh Cache modifier.

    blender --background --python blender_bake.py -- OUT.blend [--frames 60]

or without Blender, where `pip install bpy` has a wheel: `python blender_bake.py OUT.blend`. Install
Muslin into the Python of Blender: `BLENDER/5.0/python/bin/python3.11 -m pip install muslin`.

`bake` works on any two mesh objects of your own scene. Positions of a PC2 file are in the space of
the object, and one frame of it is one frame of the scene.
"""

from __future__ import annotations

import argparse
import struct
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

import muslin

Array = NDArray[Any]


def mesh_of(item: Any) -> tuple[Array, Array]:
    """Positions in the world and triangles of an object, with its modifiers applied."""
    mesh = item.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    mesh.calc_loop_triangles()
    positions = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", positions)
    triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    world = np.array(item.matrix_world)
    item.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh_clear()
    return positions.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3], triangles.reshape(-1, 3)


def bake(item: Any, body: Any, cache: Path, frames: int) -> muslin.Cloth:
    """Simulates `item` as cloth over `body`, which may be animated; writes the PC2 file `cache` and
    adds the modifier that plays it."""
    scene = bpy.context.scene
    scene.frame_set(scene.frame_start)
    positions, triangles = mesh_of(item)
    # Blender's z is up.
    settings = muslin.Settings(gravity=(0, 0, -9.81), self_collision="surface")
    cloth = muslin.Cloth.mesh(
        positions, triangles, extra_particles=0, material="cotton", settings=settings
    )
    vertices, faces = mesh_of(body)
    collider = cloth.add_collider("mesh", positions=vertices, indices=faces)
    to_object = np.array(item.matrix_world.inverted())
    with cache.open("wb") as file:
        file.write(struct.pack("<12siiffi", b"POINTCACHE2\0", 1, len(positions), 1, 1, frames))
        for frame in range(frames):
            scene.frame_set(scene.frame_start + frame)
            if frame > 0:
                cloth.update_collider(collider, mesh_of(body)[0])
                cloth.advance(scene.render.fps_base / scene.render.fps)
            local = cloth.positions @ to_object[:3, :3].T + to_object[:3, 3]
            file.write(local.astype("<f4").tobytes())
    modifier = item.modifiers.new("Muslin", "MESH_CACHE")
    modifier.cache_format = "PC2"
    modifier.filepath = str(cache)
    modifier.frame_start = scene.frame_start
    return cloth


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("out", type=Path)
    parser.add_argument("--frames", type=int, default=60)
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    arguments = parser.parse_args(given)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=0.5)
    ball = bpy.context.active_object
    for frame, turn in [(1, 0.0), (arguments.frames, 3.0)]:
        ball.rotation_euler = (0, 0, turn)
        ball.keyframe_insert("rotation_euler", frame=frame)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=50, y_subdivisions=50, size=1.6)
    sheet = bpy.context.active_object
    sheet.location = (0, 0, 0.8)
    bpy.context.view_layer.update()
    cache = arguments.out.with_suffix(".pc2").absolute()
    cloth = bake(sheet, ball, cache, arguments.frames)
    bpy.context.scene.frame_end = arguments.frames
    bpy.ops.wm.save_as_mainfile(filepath=str(arguments.out.absolute()))
    print(f"{arguments.out}: {arguments.frames} frames of {cloth}")


if __name__ == "__main__":
    main()
