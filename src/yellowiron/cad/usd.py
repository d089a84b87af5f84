"""A USD, USDA, USDC or USDZ file to an `Assembly`: a part for every mesh that is drawn. Runs in the guard's child
process.

With or without physics: here it is a tree of parts, with the joints that the file declares.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdShade

from yellowiron.cad import placed, polygons
from yellowiron.cad.naming import decode_name, is_generic
from yellowiron.cad.placed import Occurrence
from yellowiron.cad.usd_joints import usd_joints
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh

_DAMAGED = "Copy or export it again; the file is damaged."
_DRAWN = (UsdGeom.Tokens.default_, UsdGeom.Tokens.render, UsdGeom.Tokens.proxy)
"""Purposes of what is drawn; guides are colliders and helpers."""
_PLAIN = frozenset({"mesh", "geometry", "geom", "visual", "visuals", "shape", "model", "object"})
"""Names that converters give to the mesh below the part's own prim."""


def read_usd(path: str) -> Assembly:
    """The assembly in a USD file, in metres, in the file's own frame. `CadError` if it does not open, or draws
    nothing."""
    stage = _opened(path)
    findings = _unresolved(stage, path)
    unit, remarks = _unit(stage, path)
    findings += remarks
    looks = _Looks()
    meshes: dict[Sdf.Path, tuple[Mesh, Color | None] | None] = {}
    occurrences: list[Occurrence] = []
    declared = _hollow(stage)
    for prim, transform in _drawn(stage):
        declared += 1
        source = prim.GetPrimInPrototype().GetPath() if prim.IsInstanceProxy() else prim.GetPath()
        if source not in meshes:
            meshes[source] = _mesh(prim, unit, looks, findings)
        found = meshes[source]
        if found is not None:
            names = _names(prim)
            occurrences.append(
                Occurrence(names[-1], tuple(names[:-1]), found[0], _in_metres(transform, unit), found[1])
            )
    if looks.textured:
        words = "Textures are not read: parts have the colour that is under them"
        findings.append(Finding("CAD012", "info", path, words))
    root = stage.GetDefaultPrim()
    name = root.GetName() if root and not is_generic(root.GetName()) else Path(path).stem
    read = placed.assemble(
        occurrences, name=name, format="USD", unit=unit, path=path, findings=findings, declared=declared
    )
    return replace(read, joints=tuple(usd_joints(stage, unit, _names)))


def _opened(path: str) -> Usd.Stage:
    try:
        stage = Usd.Stage.Open(path)
    except Tf.ErrorException as error:
        words = " ".join(str(error).split())
        raise CadError(f"The USD file cannot be opened: {words[:200]}", where=path, hint=_DAMAGED) from error
    return stage


def _unresolved(stage: Usd.Stage, path: str) -> list[Finding]:
    """A finding for the files that the stage refers to and that are not there."""
    gone = sorted({" ".join(str(error).split()) for error in stage.GetCompositionErrors()})
    return [
        Finding("CAD008", "error", path, f"A reference cannot be followed: {words[:200]}", "Put the file beside it.")
        for words in gone[:5]
    ]


def _unit(stage: Usd.Stage, path: str) -> tuple[float, list[Finding]]:
    unit = float(UsdGeom.GetStageMetersPerUnit(stage))
    if not np.isfinite(unit) or unit <= 0.0:
        raise CadError(f"The USD file's unit is {unit:g} m", where=path, hint="Set metersPerUnit in it.")
    if UsdGeom.StageHasAuthoredMetersPerUnit(stage):
        return unit, []
    words = "The file says nothing of its unit of length, which in USD means centimetres"
    hint = "Check the machine's size against the sheet's; metersPerUnit in the file settles it."
    return unit, [Finding("CAD009", "warning", path, words, hint)]


def _hollow(stage: Usd.Stage) -> int:
    """How many instances have nothing in them: what they were of is lost, without an error of USD's own."""
    below = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
    return sum(
        prim.IsInstanceable() and prim.GetTypeName() in ("", "Xform") and not prim.GetFilteredChildren(below)
        for prim in stage.Traverse()
    )


def _drawn(stage: Usd.Stage) -> Iterator[tuple[Usd.Prim, Floats]]:
    """Every drawn geometry with its (4, 4) transform in the stage's unit, in the tree's order."""
    cache = UsdGeom.XformCache()
    prims = iter(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)))
    for prim in prims:
        image = UsdGeom.Imageable(prim)
        if not image:
            continue
        if image.ComputeVisibility() == UsdGeom.Tokens.invisible or image.ComputePurpose() not in _DRAWN:
            prims.PruneChildren()
        elif prim.IsA(UsdGeom.PointInstancer):
            prims.PruneChildren()
            yield from _instanced(UsdGeom.PointInstancer(prim), cache)
        elif prim.IsA(UsdGeom.Gprim):
            yield prim, _matrix(cache.GetLocalToWorldTransform(prim))


def _instanced(instancer: UsdGeom.PointInstancer, cache: UsdGeom.XformCache) -> Iterator[tuple[Usd.Prim, Floats]]:
    """The geometry of a point instancer: every prototype's at every place of it."""
    stage = instancer.GetPrim().GetStage()
    prototypes = [stage.GetPrimAtPath(p) for p in instancer.GetPrototypesRel().GetForwardedTargets()]
    indices = instancer.GetProtoIndicesAttr().Get() or []
    time = Usd.TimeCode.Default()
    places = instancer.ComputeInstanceTransformsAtTime(time, time) or []
    outer = _matrix(cache.GetLocalToWorldTransform(instancer.GetPrim()))
    for index, place in zip(indices, places, strict=False):
        prototype = prototypes[index] if 0 <= index < len(prototypes) else None
        if not prototype:
            continue
        inverse = np.linalg.inv(_matrix(cache.GetLocalToWorldTransform(prototype)))
        for prim in Usd.PrimRange(prototype, Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)):
            if prim.IsA(UsdGeom.Gprim):
                # An instance's transform holds the prototype's own.
                own = inverse @ _matrix(cache.GetLocalToWorldTransform(prim))
                yield prim, outer @ _matrix(place) @ own


def _matrix(matrix: Gf.Matrix4d) -> Floats:
    """USD writes row vectors: its matrix is the transpose of ours."""
    return np.asarray(matrix, dtype=np.float64).T


def _in_metres(transform: Floats, unit: float) -> Floats:
    scaled = transform.copy()
    scaled[:3, 3] *= unit
    return scaled


def _names(prim: Usd.Prim) -> list[str]:
    """What the prims from the root to this one are called; a mesh that only its converter named has its parent's."""
    names: list[str] = []
    above = prim
    while above and not above.IsPseudoRoot():
        names.append(decode_name(above.GetDisplayName() or above.GetName(), "utf-8"))
        above = above.GetParent()
    names.reverse()
    while len(names) > 1 and (is_generic(names[-1]) or names[-1].casefold().rstrip("_0123456789") in _PLAIN):
        names.pop()
    return names


def _mesh(prim: Usd.Prim, unit: float, looks: _Looks, findings: list[Finding]) -> tuple[Mesh, Color | None] | None:
    """A prim's triangles in its own frame, in metres, and its colour; None for what has no surface."""
    solid = _solid(prim)
    if solid is not None:
        return Mesh(solid.points * unit, solid.triangles), looks.of(prim)
    if not prim.IsA(UsdGeom.Mesh):
        return None
    mesh = UsdGeom.Mesh(prim)
    points = np.asarray(mesh.GetPointsAttr().Get() or [], dtype=np.float64).reshape(-1, 3)
    counts = np.asarray(mesh.GetFaceVertexCountsAttr().Get() or [], dtype=np.int64)
    corners = np.asarray(mesh.GetFaceVertexIndicesAttr().Get() or [], dtype=np.int64)
    sound = (counts >= 0).all() and counts.sum() == len(corners)
    if not sound or (len(corners) and not 0 <= corners.min() <= corners.max() < len(points)):
        name = str(prim.GetPath())
        findings.append(
            Finding("CAD003", "error", name, "Left out: its faces name points that are not there", _DAMAGED)
        )
        return None
    triangles, polygon = polygons.fans(counts, corners)
    if mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
        triangles = triangles[:, ::-1]
    color, faces = looks.of(prim), looks.of_faces(prim, len(counts))
    return Mesh(points * unit, triangles, None, None if faces is None else faces[polygon]), color


def _solid(prim: Usd.Prim) -> Mesh | None:
    """The triangles of a cube, ball, cylinder, cone or capsule."""
    if prim.IsA(UsdGeom.Cube):
        return polygons.box([UsdGeom.Cube(prim).GetSizeAttr().Get()] * 3)
    if prim.IsA(UsdGeom.Sphere):
        return polygons.ball(UsdGeom.Sphere(prim).GetRadiusAttr().Get())
    for kind, make in (
        (UsdGeom.Cylinder, polygons.cylinder),
        (UsdGeom.Cone, polygons.cone),
        (UsdGeom.Capsule, polygons.capsule),
    ):
        if prim.IsA(kind):
            solid = kind(prim)
            mesh = make(solid.GetRadiusAttr().Get(), solid.GetHeightAttr().Get())
            axis = {"X": [2, 0, 1], "Y": [1, 2, 0], "Z": [0, 1, 2]}[solid.GetAxisAttr().Get()]
            return Mesh(mesh.points[:, axis], mesh.triangles)
    return None


class _Looks:
    """Colours (linear RGB) of prims: the bound material's, else the prim's own. `textured` once a picture was met."""

    def __init__(self) -> None:
        self.textured = False
        self._known: dict[Sdf.Path, Color | None] = {}

    def of(self, prim: Usd.Prim) -> Color | None:
        """A prim's one colour."""
        material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
        color = self._of_material(material) if material else None
        if color is not None:
            return color
        shown = UsdGeom.Gprim(prim).GetDisplayColorPrimvar()
        values = shown.ComputeFlattened() if shown and shown.HasAuthoredValue() else None
        return _color(values[0]) if values is not None and len(values) == 1 else None

    def of_faces(self, prim: Usd.Prim, count: int) -> Floats | None:
        """(count, 3) colours of a mesh's faces; None where it has one for all."""
        shown = UsdGeom.Gprim(prim).GetDisplayColorPrimvar()
        colors: Floats | None = None
        if shown and shown.HasAuthoredValue() and shown.GetInterpolation() == UsdGeom.Tokens.uniform:
            values = np.asarray(shown.ComputeFlattened(), dtype=np.float64).reshape(-1, 3)
            colors = np.clip(values, 0.0, 1.0) if len(values) == count else None
        base = self.of(prim)
        for subset in UsdShade.MaterialBindingAPI(prim).GetMaterialBindSubsets():
            material = UsdShade.MaterialBindingAPI(subset.GetPrim()).ComputeBoundMaterial()[0]
            color = self._of_material(material) if material else None
            rows = np.asarray(subset.GetIndicesAttr().Get() or [], dtype=np.int64)
            if color is not None and len(rows) and 0 <= rows.min() <= rows.max() < count:
                colors = np.tile(base or (0.5, 0.5, 0.5), (count, 1)).astype(float) if colors is None else colors
                colors[rows] = color
        return colors

    def _of_material(self, material: UsdShade.Material) -> Color | None:
        path = material.GetPath()
        if path not in self._known:
            self._known[path] = self._read(material)
        return self._known[path]

    def _read(self, material: UsdShade.Material) -> Color | None:
        """The diffuse colour of a material's surface, under whichever name its shader has it."""
        for prim in Usd.PrimRange(material.GetPrim()):
            shader = UsdShade.Shader(prim)
            for name in ("diffuseColor", "diffuse_color_constant", "base_color"):
                entry: Any = shader.GetInput(name) if shader else None
                if not entry:
                    continue
                self.textured |= entry.HasConnectedSource()
                value = entry.Get()
                if value is not None:
                    return _color(value)
        return None


def _color(value: Sequence[float]) -> Color | None:
    rgb = np.asarray(value, dtype=np.float64).reshape(-1)[:3]
    if len(rgb) != 3 or not np.isfinite(rgb).all():
        return None
    r, g, b = (float(v) for v in np.clip(rgb, 0.0, 1.0))
    return r, g, b
