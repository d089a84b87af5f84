"""The products of an XCAF document to an `Assembly`: every solid and sheet of every occurrence. What the readers of
boundary representations end with; runs in the guard's child process."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher
from OCP.TopAbs import TopAbs_COMPOUND, TopAbs_COMPSOLID, TopAbs_FACE, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Iterator
from OCP.XCAFDoc import XCAFDoc_ShapeTool

from yellowiron.cad.brep import to_shape
from yellowiron.cad.brep.tessellate import MILLIMETRE, compound, mesh_shapes
from yellowiron.cad.brep.xcaf import EXPORT_AGAIN, Leaf, Styles, Tree, label_color, label_entry
from yellowiron.cad.naming import is_generic, unique_ids
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Shape


@dataclass(frozen=True, eq=False)
class Piece:
    """One solid or sheet of a product, in its own frame, with where the product has it and in which colour."""

    name: str
    body: to_shape.Body
    location: Any
    color: Color | None


Missing = Callable[[Sequence[Leaf], Sequence[Sequence[Piece]]], list[Finding]]
"""What a format can say of occurrences that did not arrive."""


def assemble(
    tree: Tree,
    *,
    path: str,
    format: str,
    unit: float,
    findings: Sequence[Finding] = (),
    declared: int | None = None,
    missing: Missing = lambda leaves, pieces: [],
) -> Assembly:
    """The assembly of a document's products; `unit` (metres) is the file's own. `CadError` if nothing is a part."""
    leaves = list(tree.leaves())
    collector = _Bodies(tree)
    pieces = [collector.pieces(leaf) for leaf in leaves]
    remarks = [*findings, *missing(leaves, pieces), *collector.findings]
    shapes, shape_findings = _shapes(collector.bodies)
    remarks += shape_findings
    parts = _parts(leaves, pieces, shapes)
    if not parts:
        for finding in remarks:
            if finding.severity == "error":
                raise CadError(f"Nothing can be read: {finding.message}", where=finding.where, hint=finding.hint)
        raise CadError(f"The {format} file holds no solid and no surface", where=path, hint=EXPORT_AGAIN)
    used = {part.shape for part in parts}
    assembly = Assembly(
        name=tree.name or Path(path).stem,
        format=format,
        unit=unit,
        parts=tuple(parts),
        shapes={key: shape for key, shape in shapes.items() if key in used},
        declared_occurrences=declared,
    )
    return replace(assembly, findings=(*remarks, *_plausibility(assembly, path)))


class _Bodies:
    """The distinct solids and sheets of a document, each measured once, however many products or instances have it."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self.bodies: list[to_shape.Body] = []
        self.findings: list[Finding] = []
        self._known = IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher()
        self._measured: list[to_shape.Body | None] = []
        self._pieces: dict[str, list[Piece]] = {}

    def pieces(self, leaf: Leaf) -> list[Piece]:
        """The solids and sheets of a leaf's product, in the product's frame."""
        shape = XCAFDoc_ShapeTool.GetShape_s(leaf.label)
        if shape is None or shape.IsNull():
            return []
        entry = label_entry(leaf.label)
        if entry not in self._pieces:
            self._pieces[entry] = self._split(leaf, shape)
        return self._pieces[entry]

    def _split(self, leaf: Leaf, shape: Any) -> list[Piece]:
        styles = Styles(self.tree, leaf.label)
        product = self.tree.product_name(leaf.label) or leaf.name
        units = _units(shape)
        pieces = []
        for number, unit in enumerate(units, start=1):
            name, color = styles.of(unit)
            color = color or label_color(leaf.label)
            body_name = name if len(units) > 1 and name else product
            local = unit.Located(TopLoc_Location())
            known = self._known.FindIndex(local)
            if known == 0:
                known = self._known.Add(local)
                self._measured.append(self._measure(body_name, local, color, styles))
            body = self._measured[known - 1]
            if body is None:
                continue
            suffix = f"#{number}" if len(units) > 1 else ""
            own = name if name and not is_generic(name) and len(units) > 1 else ""
            pieces.append(Piece(own or suffix, body, unit.Location(), color))
        return pieces

    def _measure(self, name: str, shape: Any, color: Color | None, styles: Styles) -> to_shape.Body | None:
        face_colors = styles.of_faces(to_shape.subshapes(shape, TopAbs_FACE))
        try:
            body = to_shape.measure(name, shape, color=color, face_colors=face_colors)
        except ValueError as error:
            self.findings.append(Finding("CAD003", "error", name, f"Left out: {error}", EXPORT_AGAIN))
            return None
        self.bodies.append(body)
        return body


def _units(shape: Any) -> list[Any]:
    """What becomes a part each: every solid, compsolid and closed shell, and all open sheets as one."""
    bodies = [part for part in _members(shape) if not to_shape.is_sheet(part)]
    sheets = [part for part in _members(shape) if to_shape.is_sheet(part)]
    return [*bodies, *([compound(sheets)] if len(sheets) > 1 else sheets)]


def _members(shape: Any) -> Iterator[Any]:
    """The solids, shells and loose faces of nested compounds."""
    kind = shape.ShapeType()
    if kind in (TopAbs_SOLID, TopAbs_COMPSOLID, TopAbs_SHELL, TopAbs_FACE):
        yield shape
    elif kind == TopAbs_COMPOUND:
        children = TopoDS_Iterator(shape)
        while children.More():
            yield from _members(children.Value())
            children.Next()


def listed(names: Sequence[str], most: int = 5) -> str:
    """The first few names, and how many more there are."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def _shapes(bodies: Sequence[to_shape.Body]) -> tuple[dict[str, Shape], list[Finding]]:
    """Distinct sound bodies by key, meshed; equal ones are meshed once."""
    distinct: dict[str, to_shape.Body] = {}
    for body in bodies:
        distinct.setdefault(body.key, body)
    mesh_shapes((body.shape, body.diagonal) for body in distinct.values() if not body.tessellated)
    shapes, findings = {}, []
    for key, body in distinct.items():
        shape, missing = to_shape.finish(body)
        if missing:
            findings.append(
                Finding("CAD006", "warning", body.name, f"{missing} of {len(body.faces)} faces could not be meshed")
            )
        if body.tessellated:
            findings.append(
                Finding("CAD011", "info", body.name, "Triangles without surfaces: its cylinders are fitted to them")
            )
        elif not shape.exact:
            findings.append(
                Finding("CAD007", "warning", body.name, "The solid's exact volume is not usable; its mesh's was taken")
            )
        if len(shape.mesh.triangles):
            shapes[key] = shape
    return shapes, findings


def _parts(
    leaves: Sequence[Leaf],
    pieces: Sequence[Sequence[Piece]],
    shapes: dict[str, Shape],
) -> list[Part]:
    found: list[tuple[str, tuple[str, ...], str, Floats, Color | None]] = []
    for leaf, own in zip(leaves, pieces, strict=True):
        for piece in own:
            key = piece.body.key
            if key not in shapes:
                continue
            path, name = leaf.path, leaf.name
            if piece.name.startswith("#"):
                name += piece.name
            elif piece.name:
                path, name = (*path, name), piece.name
            found.append(
                (
                    name,
                    path,
                    key,
                    _matrix(leaf.location * piece.location),
                    leaf.color or piece.color or piece.body.color or leaf.inherited,
                )
            )
    ids = unique_ids((*path, name) for name, path, *_ in found)
    return [Part(id, *fields) for id, fields in zip(ids, found, strict=True)]


def _matrix(location: Any) -> Floats:
    """(4, 4) of a location, translation in metres."""
    trsf = location.Transformation()
    matrix = np.eye(4)
    matrix[:3] = [[trsf.Value(i, j) for j in (1, 2, 3, 4)] for i in (1, 2, 3)]
    matrix[:3, 3] *= MILLIMETRE
    return matrix


def _plausibility(assembly: Assembly, path: str) -> list[Finding]:
    findings = []
    sheets = [part.name for part in assembly.parts if not assembly.shapes[part.shape].closed]
    if sheets:
        findings.append(
            Finding("CAD005", "info", path, f"Not closed, so without a volume: {listed(list(dict.fromkeys(sheets)))}")
        )
    corners = np.concatenate([_corners(assembly, part) for part in assembly.parts])
    size = float(np.linalg.norm(np.ptp(corners, axis=0)))
    if not 1e-3 < size < to_shape.LARGEST * MILLIMETRE:
        findings.append(
            Finding("CAD004", "warning", path, f"The model is {size:.3g} m large: check the unit it was exported in")
        )
    return findings


def _corners(assembly: Assembly, part: Part) -> Floats:
    low, high = assembly.shapes[part.shape].bounds
    corners = np.array(
        [[(low, high)[i][0], (low, high)[j][1], (low, high)[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    )
    return np.asarray(corners @ part.transform[:3, :3].T + part.transform[:3, 3])
