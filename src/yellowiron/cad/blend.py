"""A Blender file to an `Assembly`: a part for every object that is shown. Runs in the guard's child process.

Blender itself (the extra `blender`) opens the file, its scripts left asleep, and evaluates modifiers and instances.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.cad import placed
from yellowiron.cad.naming import decode_name
from yellowiron.cad.placed import Occurrence
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh

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
    meshes: dict[str, tuple[Mesh, Color | None] | None] = {}
    occurrences = []
    declared = 0
    textured = False
    for instance in graph.object_instances:
        shown = instance.object
        if shown.type not in _SOLID or not instance.show_self:
            continue
        declared += 1
        own = shown.original
        key = own.name_full
        if key not in meshes:
            meshes[key] = _mesh(shown, unit)
            textured |= any(_pictured(slot.material) for slot in own.material_slots)
        found = meshes[key]
        if found is None:
            continue
        place = np.array(instance.matrix_world, dtype=np.float64)
        place[:3, 3] *= unit
        above = instance.parent.original if instance.is_instance and instance.parent else None
        occurrences.append(Occurrence(decode_name(own.name, "utf-8"), _above(own, above), found[0], place, found[1]))
    findings = []
    if textured:
        words = "Textures are not read: parts have the colour that is under them"
        findings.append(Finding("CAD012", "info", path, words))
    return placed.assemble(
        occurrences, name=Path(path).stem, format="Blender", unit=unit, path=path, findings=findings, declared=declared,
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


def _mesh(shown: Any, unit: float) -> tuple[Mesh, Color | None] | None:
    """An evaluated object's triangles, in metres, and colour; None without any."""
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
    colors = [_color(slot.material) for slot in shown.original.material_slots]
    shown.to_mesh_clear()
    if not len(triangles):
        return None
    used = {int(r) for r in np.unique(rows)}
    paint = {r: colors[r] if 0 <= r < len(colors) else None for r in used}
    painted: Floats | None = None
    if len(set(paint.values())) > 1:
        painted = np.array([paint[int(r)] or (0.5, 0.5, 0.5) for r in rows])
    one = None if painted is not None else next(iter(paint.values()))
    return Mesh(points.reshape(-1, 3) * unit, triangles.reshape(-1, 3), None, painted), one


def _color(material: Any) -> Color | None:
    """The base colour of a material (linear RGB)."""
    if material is None:
        return None
    value = material.diffuse_color
    if material.node_tree is not None:
        for node in material.node_tree.nodes:
            if node.type == "BSDF_PRINCIPLED":
                value = node.inputs["Base Color"].default_value
    r, g, b = (min(max(float(v), 0.0), 1.0) for v in tuple(value)[:3])
    return r, g, b


def _pictured(material: Any) -> bool:
    nodes = material.node_tree.nodes if material is not None and material.node_tree is not None else []
    return any(node.type == "TEX_IMAGE" for node in nodes)
