"""A Blender file to an `Assembly`: a part for every object that is shown. Runs in the guard's child process.

Blender itself (the extra `blender`) opens the file, its scripts left asleep, and evaluates modifiers and instances.
"""

from __future__ import annotations

import ctypes
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any

import numpy as np

from yellowiron.cad.appearance.looks import Dressed, Look, dress
from yellowiron.cad.appearance.textures import Picture, Pictures, finish
from yellowiron.cad.mesh import assembly
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name
from yellowiron.model.assembly import Assembly, Node
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh

_HINT = "Open it in Blender and export it as GLB."
_PASSED = re.compile(r"\bERROR\b\s+(.*)")
"""A line of Blender's about what it passes over."""
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
        with TemporaryFile() as log:
            with _written_to(log):
                bpy.ops.wm.open_mainfile(filepath=str(Path(path).absolute()), load_ui=False, use_scripts=False)
            log.seek(0)
            findings = _damage(log.read().decode(errors="replace"), path)
    except RuntimeError as error:
        words = " ".join(str(error).split())[:200]
        raise CadError(f"Blender cannot open the file: {words}", where=path, hint=_HINT) from error
    findings += _missing(path)
    scene = bpy.context.scene
    unit = float(scene.unit_settings.scale_length) if scene.unit_settings.system != "NONE" else 1.0
    graph = bpy.context.evaluated_depsgraph_get()
    pictures = Pictures(path)
    meshes: dict[str, Dressed | None] = {}
    occurrences = []
    declared = 0
    tree = _Tree(unit)
    for instance in graph.object_instances:
        shown = instance.object
        node = tree.instance(instance)
        if shown.type not in _SOLID or not instance.show_self:
            continue
        declared += 1
        own = shown.original
        key = own.name_full
        if key not in meshes:
            meshes[key] = _mesh(shown, unit, pictures, findings)
        found = meshes[key]
        if found is None:
            continue
        place = _in_metres(instance.matrix_world, unit)
        above = instance.parent.original if instance.is_instance and instance.parent else None
        name = decode_name(own.name, "utf-8")
        occurrences.append(Occurrence(name, _above(own, above), found.mesh, place, found.color, found.finishes, node))
    return assembly.assemble(
        occurrences, name=Path(path).stem, format="Blender", unit=unit, path=path,
        findings=[*findings, *pictures.findings()], declared=declared, nodes=tree.nodes,
    )  # fmt: skip


@contextmanager
def _written_to(log: IO[bytes]) -> Iterator[None]:
    """What the process writes to its outputs goes to a file: Blender says only there what it passes over."""
    kept = [os.dup(stream) for stream in (1, 2)]
    try:
        for stream in (1, 2):
            os.dup2(log.fileno(), stream)
        yield
    finally:
        # What the C library holds back belongs to the log, too.
        ctypes.CDLL(None).fflush(None)
        for stream, own in zip((1, 2), kept, strict=True):
            os.dup2(own, stream)
            os.close(own)


def _damage(log: str, path: str) -> list[Finding]:
    """A finding for the errors that Blender passed over while it opened the file."""
    said = list(dict.fromkeys(" ".join(line.split()) for line in _PASSED.findall(log)))
    if not said:
        return []
    words = f"Blender has passed over damage ({said[0][:120]}): parts may be missing"
    return [Finding("CAD001", "warning", path, words, _HINT)]


def _missing(path: str) -> list[Finding]:
    """A finding for libraries, and what is linked from them, that are not there."""
    import bpy

    gone = [entry.filepath for entry in bpy.data.libraries if not Path(bpy.path.abspath(entry.filepath)).is_file()]
    gone += [entry.name for entry in bpy.data.objects if getattr(entry, "is_missing", False)]
    if not gone:
        return []
    words = f"What the file links to is missing: {', '.join(sorted(gone)[:5])}"
    return [Finding("CAD008", "error", path, words, "Put the libraries where the file names them.")]


def _in_metres(matrix: Any, unit: float) -> Floats:
    place = np.array(matrix, dtype=np.float64)
    place[:3, 3] *= unit
    return place


class _Tree:
    """The scene tree: a node for every object, every bone of an armature, and every instance of an object."""

    def __init__(self, unit: float) -> None:
        self.nodes: list[Node] = []
        self._unit = unit
        self._known: dict[tuple[str, ...], int] = {}

    def instance(self, instance: Any) -> int:
        """The number of an instance's node, which is its object's where it is none of another."""
        if not instance.is_instance or instance.parent is None:
            return self._object(instance.object.original)
        above = self._object(instance.parent.original)
        return self._add(instance.object.original.name, above, instance.matrix_world)

    def _object(self, own: Any) -> int:
        if (own.name_full,) in self._known:
            return self._known[own.name_full,]
        above = None
        if own.parent is not None:
            above = self._object(own.parent)
            if own.parent_type == "BONE":
                above = self._known.get((own.parent.name_full, own.parent_bone), above)
        number = self._known[own.name_full,] = self._add(own.name, above, own.matrix_world)
        for bone in own.pose.bones if own.type == "ARMATURE" and own.pose is not None else ():
            self._bone(own, bone)
        return number

    def _bone(self, armature: Any, bone: Any) -> int:
        key = (armature.name_full, bone.name)
        if key not in self._known:
            above = self._known[armature.name_full,] if bone.parent is None else self._bone(armature, bone.parent)
            self._known[key] = self._add(bone.name, above, armature.matrix_world @ bone.matrix, bone=True)
        return self._known[key]

    def _add(self, name: str, above: int | None, matrix: Any, *, bone: bool = False) -> int:
        self.nodes.append(Node(decode_name(name, "utf-8"), above, _in_metres(matrix, self._unit), bone))
        return len(self.nodes) - 1


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


def _mesh(shown: Any, unit: float, pictures: Pictures, findings: list[Finding]) -> Dressed | None:
    """An evaluated object's triangles, in metres, with its looks; None without any, or where they are damaged."""
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
        sound = 0 <= corners.min(initial=0) <= corners.max(initial=0) < len(data.loops)
        uvs = flat.astype(np.float64).reshape(-1, 2)[corners].reshape(-1, 3, 2) if sound else None
    looks = [_look(slot.material, pictures) for slot in shown.original.material_slots]
    shown.to_mesh_clear()
    if not len(triangles):
        return None
    if not 0 <= triangles.min() <= triangles.max() < len(points) // 3:
        name = decode_name(shown.original.name, "utf-8")
        findings.append(Finding("CAD003", "error", name, "Left out: its faces name points that are not there", _HINT))
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
