"""A Blender file to an `Assembly`: a part for every object that is shown. Runs in the guard's child process.

Blender itself (the extra `blender`) opens the file, its scripts left asleep, and evaluates modifiers and instances.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.cad import placed
from yellowiron.cad.looks import Dressed, Look, dress
from yellowiron.cad.naming import decode_name
from yellowiron.cad.pictures import Picture, Pictures, finish
from yellowiron.cad.placed import Occurrence
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.geometry import Color, Mesh

_SOLID = {"MESH", "CURVE", "SURFACE", "META", "FONT"}


def read_blend(path: str) -> Assembly:
    """The assembly in a Blender file, in metres, Z up. `CadError` if it does not open, or shows no surface."""
    try:
        import bpy
    except ImportError as error:
        raise CadError(
            "Blender files are read with the package bpy, which is not here",
            where=path,
            hint='Install it with: pip install "yellowiron[blender]"; or export the model from Blender as GLB.',
        ) from error
    try:
        bpy.ops.wm.open_mainfile(filepath=str(Path(path).absolute()), load_ui=False, use_scripts=False)
    except RuntimeError as error:
        words = " ".join(str(error).split())[:200]
        hint = "Open it in Blender and export it as GLB."
        raise CadError(f"Blender cannot open the file: {words}", where=path, hint=hint) from error
    scene = bpy.context.scene
    unit = float(scene.unit_settings.scale_length) if scene.unit_settings.system != "NONE" else 1.0
    graph = bpy.context.evaluated_depsgraph_get()
    pictures = Pictures(path)
    meshes: dict[str, Dressed | None] = {}
    occurrences = []
    declared = 0
    for instance in graph.object_instances:
        shown = instance.object
        if shown.type not in _SOLID or not instance.show_self:
            continue
        declared += 1
        own = shown.original
        key = own.name_full
        if key not in meshes:
            meshes[key] = _mesh(shown, unit, pictures)
        found = meshes[key]
        if found is None:
            continue
        place = np.array(instance.matrix_world, dtype=np.float64)
        place[:3, 3] *= unit
        above = instance.parent.original if instance.is_instance and instance.parent else None
        name = decode_name(own.name, "utf-8")
        occurrences.append(Occurrence(name, _above(own, above), found.mesh, place, found.color, found.finishes))
    return placed.assemble(
        occurrences, name=Path(path).stem, format="Blender", unit=unit, path=path, findings=pictures.findings(),
        declared=declared,
    )  # fmt: skip


def _above(own: Any, instancer: Any) -> tuple[str, ...]:
    """The names of an object's parents, and of what instances it, outermost first."""
    names: list[str] = []
    parent = own.parent
    while parent is not None:
        names.append(decode_name(parent.name, "utf-8"))
        parent = parent.parent
    if instancer is not None:
        names.append(decode_name(instancer.name, "utf-8"))
    return tuple(reversed(names))


def _mesh(shown: Any, unit: float, pictures: Pictures) -> Dressed | None:
    """An evaluated object's triangles, in metres, with its looks; None without any."""
    data = shown.to_mesh()
    if data is None:
        return None
    data.calc_loop_triangles()
    points = np.empty(3 * len(data.vertices), dtype=np.float64)
    data.vertices.foreach_get("co", points)
    triangles = np.empty(3 * len(data.loop_triangles), dtype=np.int32)
    data.loop_triangles.foreach_get("vertices", triangles)
    rows = np.empty(len(data.loop_triangles), dtype=np.int32)
    data.loop_triangles.foreach_get("material_index", rows)
    uvs = None
    if data.uv_layers.active is not None:
        corners = np.empty(3 * len(data.loop_triangles), dtype=np.int32)
        data.loop_triangles.foreach_get("loops", corners)
        flat = np.empty(2 * len(data.loops), dtype=np.float32)
        data.uv_layers.active.data.foreach_get("uv", flat)
        uvs = flat.astype(np.float64).reshape(-1, 2)[corners].reshape(-1, 3, 2)
    looks = [_look(slot.material, pictures) for slot in shown.original.material_slots]
    shown.to_mesh_clear()
    if not len(triangles):
        return None
    mesh = Mesh(points.reshape(-1, 3) * unit, triangles.reshape(-1, 3))
    return dress(mesh, looks, rows.astype(np.int64), uvs=uvs)


def _look(material: Any, pictures: Pictures) -> Look:
    """The base colour of a material (linear RGB), or the picture that is linked to it; metalness and roughness."""
    if material is None:
        return Look()
    color = _color(material.diffuse_color)
    nodes = material.node_tree.nodes if material.node_tree is not None else []
    surface = next((node for node in nodes if node.type == "BSDF_PRINCIPLED"), None)
    if surface is None:
        return Look(color)
    base = surface.inputs["Base Color"]
    metallic, roughness = (_stated(surface.inputs[key]) for key in ("Metallic", "Roughness"))
    shown = base.links[0].from_node if base.is_linked else None
    picture = _picture(shown.image, pictures) if shown is not None and shown.type == "TEX_IMAGE" else None
    if picture is None:
        return Look(_color(base.default_value), finish(metallic, roughness))
    texture, mean = picture.painted(None)
    return Look(mean, finish(metallic, roughness, texture))


def _stated(entry: Any) -> float | None:
    """A number that stands in a node; None where something else makes it."""
    return None if entry.is_linked else float(entry.default_value)


def _picture(image: Any, pictures: Pictures) -> Picture | None:
    """A picture that is packed into the file, or beside it."""
    if image is None:
        return None
    if image.packed_file is not None:
        return pictures.inside(bytes(image.packed_file.data), image.name)
    return pictures.beside(image.filepath.removeprefix("//")) if image.filepath else None


def _color(value: Any) -> Color:
    r, g, b = (min(max(float(v), 0.0), 1.0) for v in tuple(value)[:3])
    return r, g, b
