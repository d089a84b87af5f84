"""The small machine of `cad_exports` as a Blender file, where bpy (the extra blender) is importable."""

from __future__ import annotations

import importlib.util
import os
import pickle
import subprocess
import sys
from pathlib import Path

from kit.cadfiles.exports import ITEMS, Meshes


def is_here() -> bool:
    """Whether Blender files can be written, and read."""
    return importlib.util.find_spec("bpy") is not None


def blend(path: Path, meshes: Meshes) -> None:
    """Metres; an object for every item below empties for the tree, one mesh for the two pins."""
    # Blender prints, and changes its process: it has one of its own.
    subprocess.run(
        [sys.executable, __file__, str(path)],
        input=pickle.dumps({key: (points.tolist(), triangles.tolist()) for key, (points, triangles) in meshes.items()}),
        check=True,
        capture_output=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
    )


def _write(path: str, meshes: dict[str, tuple[list[list[float]], list[list[int]]]]) -> None:
    import bpy
    from mathutils import Matrix

    bpy.ops.wm.read_factory_settings(use_empty=True)
    made, empties = {}, {}
    for item in ITEMS:
        above = None
        for depth, name in enumerate(item.path):
            key = item.path[: depth + 1]
            if key not in empties:
                empties[key] = bpy.data.objects.new(name, None)
                empties[key].parent = above
                bpy.context.scene.collection.objects.link(empties[key])
            above = empties[key]
        if item.shape not in made:
            points, triangles = meshes[item.shape]
            mesh = made[item.shape] = bpy.data.meshes.new(item.shape)
            mesh.from_pydata(points, [], triangles)
            material = bpy.data.materials.new(item.shape)
            material.use_nodes = True
            surface = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
            surface.inputs["Base Color"].default_value = (*item.color, 1.0)
            mesh.materials.append(material)
        one = bpy.data.objects.new(item.name, made[item.shape])
        one.parent = above
        one.matrix_local = Matrix(item.matrix.tolist())
        bpy.context.scene.collection.objects.link(one)
    bpy.ops.wm.save_as_mainfile(filepath=path, compress=False)


if __name__ == "__main__":
    _write(sys.argv[1], pickle.loads(sys.stdin.buffer.read()))
