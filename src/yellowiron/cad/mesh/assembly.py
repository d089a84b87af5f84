"""Meshes at their places to an `Assembly`: what every reader of a triangle format ends with."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.cad.mesh import copies, measures, mending, shells
from yellowiron.cad.mesh.features import facets
from yellowiron.cad.naming import listed, unique_ids
from yellowiron.cad.tolerances import FINEST, LARGEST, SMALLEST
from yellowiron.model.assembly import Assembly, Node, Part
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Finish, Floats, Mesh, Shape

_AGAIN = "Export the file again."
FARTHER = 100.0
"""A part that reaches so many times as far as most parts is damaged."""


@dataclass(frozen=True, eq=False)
class Occurrence:
    """A mesh at a place: its name, those of the assemblies above, the mesh (shared by all occurrences of it), the
    (4, 4) transform into the file's frame (metres), the colour and the finish (or those that its triangles number), the
    number of its node where the file has a tree of them."""

    name: str
    path: tuple[str, ...]
    mesh: Mesh
    transform: Floats
    color: Color | None = None
    finishes: tuple[Finish, ...] = ()
    node: int | None = None


def assemble(
    occurrences: Sequence[Occurrence],
    *,
    name: str,
    format: str,
    unit: float,
    path: str,
    findings: Sequence[Finding] = (),
    declared: int | None = None,
    nodes: Sequence[Node] = (),
) -> Assembly:
    """The assembly of placed meshes; those that cannot be parts are left out, with a finding. `CadError` if none can.

    Shapes of equal meshes are one, whatever the file calls them, and wherever it has written them out.
    """
    occurrences = _shared(occurrences)
    remarks = list(findings)
    shapes: dict[str, Shape] = {}
    known: dict[tuple[int, Color | None, tuple[Finish, ...]], Shape | None] = {}
    found: list[tuple[Occurrence, Shape]] = []
    drawn: list[tuple[Occurrence, Shape]] = []
    empty: list[str] = []
    for item in occurrences:
        key = (id(item.mesh), item.color, item.finishes)
        if key not in known:
            known[key] = _shape(item, remarks)
        shape = known[key]
        if shape is None:
            empty.append("/".join((*item.path, item.name)))
        else:
            drawn.append((item, shape))
    # What is far beyond most others is damaged; where more than half are far, the unit is another one, which the
    # machine will tell.
    reached = sorted(_reach(s, i.transform) for i, s in drawn)
    usual = reached[(len(reached) - 1) // 2] if reached else 0.0
    most = min(max(LARGEST, FARTHER * usual), LARGEST / FINEST)
    for item, shape in drawn:
        fault = _misplaced(shape, item.transform, most)
        if fault:
            remarks.append(Finding("CAD003", "error", item.name, f"Left out: {fault}", _AGAIN))
            continue
        found.append((item, shapes.setdefault(shape.key, shape)))
    if declared is not None and len(found) < declared:
        words = f"The file declares {declared} occurrences of parts and {len(found)} were read"
        remarks.append(Finding("CAD001", "warning", path, words, "Open the file in its own program and compare."))
    if not found:
        for finding in remarks:
            if finding.severity == "error":
                raise CadError(f"Nothing can be read: {finding.message}", where=finding.where, hint=finding.hint)
        raise CadError("The file holds no triangles", where=path, hint="Export the machine's parts with it.")
    if empty:
        remarks.append(Finding("CAD002", "info", path, f"Without usable geometry: {listed(empty)}"))
    ids = unique_ids((*item.path, item.name) for item, _ in found)
    parts = tuple(
        Part(id, item.name, item.path, shape.key, item.transform, item.color, item.node)
        for id, (item, shape) in zip(ids, found, strict=True)
    )
    remarks += _plausibility(parts, shapes, path)
    return Assembly(name, format, unit, parts, shapes, tuple(remarks), declared, nodes=sound(nodes))


def sound(nodes: Sequence[Node]) -> tuple[Node, ...]:
    """Nodes as they are; one whose place is not finite is where its parent is."""
    found: list[Node] = []
    for node in nodes:
        if not np.isfinite(node.transform).all():
            place = np.eye(4) if node.parent is None else found[node.parent].transform
            node = replace(node, transform=place)
        found.append(node)
    return tuple(found)


def _shared(occurrences: Sequence[Occurrence]) -> list[Occurrence]:
    """The occurrences, those of a mesh that is another's copy with that other's."""
    meshes = list({id(item.mesh): item.mesh for item in occurrences}.values())
    found = dict(zip(map(id, meshes), copies.originals(meshes), strict=True))
    shared = []
    for item in occurrences:
        first, moved = found[id(item.mesh)]
        place = item.transform if moved is None else item.transform @ moved
        shared.append(replace(item, mesh=meshes[first], transform=place))
    return shared


def shape_of(mesh: Mesh, name: str, color: Color | None = None, finishes: tuple[Finish, ...] = ()) -> Shape:
    """The shape of a mesh of triangles: measured, turned right side out, with the cylinders and planes that fit it.

    A mesh that is open anywhere has the volume, centre and inertia that it would have with its openings closed; one
    that encloses nothing then (a flat sheet) the centre of its area. Triangles that are there twice count once. `mesh`
    has no triangle without an area.
    """
    whole = mending.mended(mesh)
    mesh, closed = _dressed(whole.mesh, mesh), whole.closed
    area, middle = measures.area_properties(whole.once)
    volume, centroid, inertia = measures.volume_properties(whole.filled)
    if volume <= 0.0:
        volume, centroid, inertia = 0.0, middle, np.zeros((3, 3))
    found = facets.find(whole.once, whole.number)
    return Shape(
        key=_painted(measures.content_key(mesh), mesh, color, finishes),
        name=name,
        mesh=mesh,
        volume=volume,
        area=area,
        centroid=centroid,
        inertia=inertia,
        closed=closed,
        exact=False,
        color=color,
        cylinders=found.cylinders,
        planes=found.planes,
        bounds=measures.bounds(mesh),
        knuckles=found.knuckles,
        spheres=found.spheres,
        finishes=finishes,
    )


def _dressed(turned: Mesh, mesh: Mesh) -> Mesh:
    """A mesh, some triangles of which were turned over, with what belongs to the corners and triangles."""
    uvs = mesh.uvs
    if uvs is not None:
        over = (turned.triangles != mesh.triangles).any(axis=1)
        uvs = np.where(over[:, None, None], uvs[:, ::-1], uvs)
    return replace(turned, uvs=uvs, triangle_finishes=mesh.triangle_finishes)


def _shape(item: Occurrence, remarks: list[Finding]) -> Shape | None:
    """The shape of an occurrence's mesh; None where nothing is left of it, which is a finding unless it is empty."""
    mesh = item.mesh
    if not len(mesh.triangles):
        return None
    used = np.unique(mesh.triangles)
    if not np.isfinite(mesh.points[used]).all():
        words = "Left out: its coordinates are not finite numbers"
        remarks.append(Finding("CAD003", "error", item.name, words, _AGAIN))
        return None
    size = float(np.abs(mesh.points[used]).max())
    if size > 1e9:
        remarks.append(Finding("CAD003", "error", item.name, f"Left out: it would be {size:.3g} large", _AGAIN))
        return None
    mesh = measures.compacted(mesh)
    return shape_of(mesh, item.name, item.color, item.finishes) if len(mesh.triangles) else None


def _reach(shape: Shape, transform: Floats) -> float:
    """How far from the origin a shape reaches along any axis, metres."""
    return float(np.abs(shape.bounds @ transform[:3, :3].T + transform[:3, 3]).max())


def _misplaced(shape: Shape, transform: Floats, most: float) -> str:
    """Why a shape cannot be where a transform puts it; '' if it can, and reaches no farther than `most`."""
    if not np.isfinite(transform).all():
        return "its place is not a finite number"
    if abs(float(np.linalg.det(transform[:3, :3]))) < 1e-30:
        return "it is squeezed flat"
    size = _reach(shape, transform)
    return f"it would be {size:.3g} m large, or away" if size > most else ""


def _painted(key: str, mesh: Mesh, color: Color | None, finishes: tuple[Finish, ...]) -> str:
    """A key with the colours and finishes, if there are any: one key is one look."""
    if color is None and mesh.triangle_colors is None and not finishes:
        return key
    paint = "" if color is None else repr(tuple(round(v, 4) for v in color))
    digest = hashlib.sha256(paint.encode())
    if mesh.triangle_colors is not None:
        digest.update(np.round(mesh.triangle_colors * 1e4).astype("<i4").tobytes())
    if finishes:
        digest.update(repr(finishes).encode())
    if mesh.uvs is not None:
        digest.update(mesh.uvs.astype("<f4").tobytes())
    if mesh.triangle_finishes is not None:
        digest.update(mesh.triangle_finishes.astype("<i4").tobytes())
    return f"{key}-{digest.hexdigest()[:8]}"


def _plausibility(parts: Sequence[Part], shapes: dict[str, Shape], path: str) -> list[Finding]:
    findings = []
    open_shells = list(dict.fromkeys(p.name for p in parts if not shapes[p.shape].closed))
    if open_shells:
        words = f"Not closed, so they weigh as sheets: {listed(open_shells)}"
        findings.append(Finding("CAD005", "info", path, words))
    size = measures.extent((shapes[p.shape].bounds, p.transform) for p in parts)
    if not SMALLEST <= size <= LARGEST:
        words = f"The model is {size:.3g} m large: check the unit it was exported in"
        findings.append(Finding("CAD004", "warning", path, words))
    return findings


MILLIMETRES = 60.0
"""A model without a unit that is larger than this is in millimetres: no machine is 60 m long, nor 60 mm."""


def guessed_unit(points: Sequence[Floats], path: str) -> tuple[float, list[Finding]]:
    """The unit, in metres, of a format that states none, by the model's size; and the remark that it was guessed."""
    finite = [p[np.isfinite(p).all(axis=1)] for p in points]
    stacked = np.concatenate([np.zeros((0, 3)), *finite])
    size = float(np.ptp(stacked, axis=0).max()) if len(stacked) else 0.0
    unit, name = (1e-3, "millimetres") if size > MILLIMETRES else (1.0, "metres")
    words = f"The format has no unit of length: {size:.4g} units long, so {name} assumed"
    hint = "Check the machine's size against the sheet's; else export it as GLB or STEP, which have units."
    return unit, [Finding("CAD009", "warning", path, words, hint)]


def pieces(mesh: Mesh) -> list[Mesh]:
    """The solids and open shells of a mesh, in the order of their first triangles."""
    if not len(mesh.triangles):
        return []
    label = shells.solids(mesh)
    order = np.argsort(label, kind="stable")
    found = []
    for rows in np.split(order, np.flatnonzero(np.diff(label[order])) + 1):
        found.append(measures.chosen(mesh, rows))
    return found
