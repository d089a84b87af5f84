"""A USD, USDA, USDC or USDZ file to an `Assembly`: a part for every mesh that is drawn. Runs in the guard's child
process.

With or without physics: here it is a tree of parts, with the joints that the file declares.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdSkel

from yellowiron.cad.appearance.looks import Dressed
from yellowiron.cad.bounds import limited, require_polygon
from yellowiron.cad.mesh import assembly, polygons
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name, is_generic
from yellowiron.cad.readers.usd.joints import usd_joints
from yellowiron.cad.readers.usd.looks import Looks
from yellowiron.model.assembly import Assembly, Node
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Mesh

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
    looks = Looks(path)
    everything = Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate))
    deque(limited(everything, path), maxlen=0)
    tree, numbers = _tree(stage, unit)
    meshes: dict[Sdf.Path, Dressed | None] = {}
    occurrences: list[Occurrence] = []
    declared = _hollow(stage)
    for prim, transform in limited(_drawn(stage), path):
        declared += 1
        source = prim.GetPrimInPrototype().GetPath() if prim.IsInstanceProxy() else prim.GetPath()
        if source not in meshes:
            meshes[source] = _mesh(prim, unit, looks, findings)
        found = meshes[source]
        if found is not None:
            names = _names(prim)
            place = _in_metres(transform, unit)
            node = numbers.get(_named(prim, len(names)).GetPath())
            occurrences.append(
                Occurrence(names[-1], tuple(names[:-1]), found.mesh, place, found.color, found.finishes, node)
            )
    findings += looks.findings()
    root = stage.GetDefaultPrim()
    name = root.GetName() if root and not is_generic(root.GetName()) else Path(path).stem
    read = assembly.assemble(
        occurrences, name=name, format="USD", unit=unit, path=path, findings=findings, declared=declared, nodes=tree
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
    """How many instances and references have nothing in them: what they were of is lost, without an error of USD's
    own."""
    below = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
    return sum(
        (prim.IsInstanceable() or _refers(prim))
        and prim.GetTypeName() in ("", "Xform")
        and not prim.GetFilteredChildren(below)
        for prim in stage.Traverse()
    )


def _refers(prim: Usd.Prim) -> bool:
    """Whether a prim says what it refers to, and has not been made to refer to nothing."""
    stated = [prim.GetMetadata(key) for key in ("references", "payload") if prim.HasAuthoredMetadata(key)]
    return any(not listed.isExplicit or listed.explicitItems for listed in stated)


def _tree(stage: Usd.Stage, unit: float) -> tuple[list[Node], dict[Sdf.Path, int]]:
    """The stage's transformable prims as nodes, metres, with the joints of its skeletons at rest below them; and the
    number of each prim's."""
    cache = UsdGeom.XformCache()
    nodes: list[Node] = []
    numbers: dict[Sdf.Path, int] = {}
    prims = iter(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)))
    for prim in prims:
        if not prim.IsA(UsdGeom.Xformable):
            continue
        if prim.IsA(UsdGeom.PointInstancer):
            # Its prototypes are not where their copies are.
            prims.PruneChildren()
        above = prim.GetPath().GetParentPath()
        while above not in numbers and not above.isEmpty and above != Sdf.Path.absoluteRootPath:
            above = above.GetParentPath()
        place = _matrix(cache.GetLocalToWorldTransform(prim))
        place[:3, 3] = _pivot(prim, place, cache)
        title = decode_name(prim.GetDisplayName() or prim.GetName(), "utf-8")
        numbers[prim.GetPath()] = len(nodes)
        nodes.append(Node(title, numbers.get(above), _in_metres(place, unit)))
        if prim.IsA(UsdSkel.Skeleton):
            nodes += _bones(UsdSkel.Skeleton(prim), len(nodes) - 1, unit)
    return nodes, numbers


def _pivot(prim: Usd.Prim, place: Floats, cache: UsdGeom.XformCache) -> Floats:
    """(3,) the point that a prim turns about: its origin, or where its pivot is."""
    ops = UsdGeom.Xformable(prim).GetOrderedXformOps()
    at = next((k for k, op in enumerate(ops) if op.GetOpName().endswith(":pivot") and not op.IsInverseOp()), None)
    if at is None:
        return place[:3, 3].copy()
    inner = np.eye(4)
    for op in ops[: at + 1]:
        inner = inner @ _matrix(op.GetOpTransform(Usd.TimeCode.Default()))
    reset = UsdGeom.Xformable(prim).GetResetXformStack()
    outer = np.eye(4) if reset else _matrix(cache.GetParentToWorldTransform(prim))
    return np.asarray((outer @ inner)[:3, 3])


def _bones(skeleton: UsdSkel.Skeleton, above: int, unit: float) -> list[Node]:
    """The joints of a skeleton as it was bound, in the order of its topology."""
    names = [Sdf.Path(name) for name in skeleton.GetJointsAttr().Get() or []]
    places = skeleton.GetBindTransformsAttr().Get() or []
    number = {name: above + 1 + k for k, name in enumerate(names)}
    if len(number) != len(names) or len(places) != len(names):
        return []
    return [
        Node(decode_name(name.name, "utf-8"), _before(name, number, above), _in_metres(_matrix(place), unit), bone=True)
        for name, place in zip(names, places, strict=True)
    ]


def _before(name: Sdf.Path, number: dict[Sdf.Path, int], above: int) -> int:
    """The number of a joint's parent, where it stands before it."""
    found = number.get(name.GetParentPath(), above)
    return found if found < number[name] else above


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


def _named(prim: Usd.Prim, depth: int) -> Usd.Prim:
    """The prim, or the one above it, that is so many below the root: the one that a part's name is of."""
    while prim.GetPath().pathElementCount > depth:
        prim = prim.GetParent()
    return prim


def _mesh(prim: Usd.Prim, unit: float, looks: Looks, findings: list[Finding]) -> Dressed | None:
    """A prim's triangles in its own frame, in metres, with its looks; None for what has no surface."""
    solid = _solid(prim)
    if solid is not None:
        return looks.dressed(prim, Mesh(solid.points * unit, solid.triangles))
    if not prim.IsA(UsdGeom.Mesh):
        return None
    mesh = UsdGeom.Mesh(prim)
    points = np.asarray(mesh.GetPointsAttr().Get() or [], dtype=np.float64).reshape(-1, 3)
    counts = np.asarray(mesh.GetFaceVertexCountsAttr().Get() or [], dtype=np.int64)
    corners = np.asarray(mesh.GetFaceVertexIndicesAttr().Get() or [], dtype=np.int64)
    name = str(prim.GetPath())
    sound = (counts >= 0).all() and counts.sum() == len(corners)
    if not sound or (len(corners) and not 0 <= corners.min() <= corners.max() < len(points)):
        findings.append(
            Finding("CAD003", "error", name, "Left out: its faces name points that are not there", _DAMAGED)
        )
        return None
    require_polygon(int(counts.max(initial=0)), name)
    numbers, polygon = polygons.fans(counts, np.arange(len(corners)))
    if mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
        numbers = numbers[:, ::-1]
    triangles = corners[numbers].reshape(-1, 3).astype(np.int32)
    return looks.dressed(prim, Mesh(points * unit, triangles), polygon, numbers.astype(np.int64))


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
