"""The products of an XCAF document to an `Assembly`: every solid and open shell of every occurrence. What the readers
of boundary representations end with; runs in the guard's child process."""

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
from yellowiron.cad.brep.xcaf import EXPORT_AGAIN, Leaf, ProductTree, Styles, label_color, label_entry
from yellowiron.cad.mesh import measures
from yellowiron.cad.naming import is_generic, listed, unique_ids
from yellowiron.cad.tolerances import LARGEST, SMALLEST
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Shape


@dataclass(frozen=True, eq=False)
class Piece:
    """One solid or open shell of a product, in its own frame, with where the product has it and in which colour."""

    name: str
    solid: to_shape.MeasuredSolid
    location: Any
    color: Color | None


Missing = Callable[[Sequence[Leaf], Sequence[Sequence[Piece]]], list[Finding]]
"""What a format can say of occurrences that did not arrive."""


def assemble(
    tree: ProductTree,
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
    collector = _MeasuredSolids(tree)
    pieces = [collector.pieces(leaf) for leaf in leaves]
    remarks = [*findings, *missing(leaves, pieces), *collector.findings]
    shapes, shape_findings = _shapes(collector.solids)
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


class _MeasuredSolids:
    """The distinct solids and open shells of a document, each measured once, however many products have it."""

    def __init__(self, tree: ProductTree) -> None:
        self.tree = tree
        self.solids: list[to_shape.MeasuredSolid] = []
        self.findings: list[Finding] = []
        self._known = IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher()
        self._measured: list[to_shape.MeasuredSolid | None] = []
        self._pieces: dict[str, list[Piece]] = {}

    def pieces(self, leaf: Leaf) -> list[Piece]:
        """The solids and open shells of a leaf's product, in the product's frame."""
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
            title = name if len(units) > 1 and name else product
            local = unit.Located(TopLoc_Location())
            known = self._known.FindIndex(local)
            if known == 0:
                known = self._known.Add(local)
                self._measured.append(self._measure(title, local, color, styles))
            solid = self._measured[known - 1]
            if solid is None:
                continue
            suffix = f"#{number}" if len(units) > 1 else ""
            own = name if name and not is_generic(name) and len(units) > 1 else ""
            pieces.append(Piece(own or suffix, solid, unit.Location(), color))
        return pieces

    def _measure(self, name: str, shape: Any, color: Color | None, styles: Styles) -> to_shape.MeasuredSolid | None:
        face_colors = styles.of_faces(to_shape.subshapes(shape, TopAbs_FACE))
        try:
            solid = to_shape.measure(name, shape, color=color, face_colors=face_colors)
        except ValueError as error:
            self.findings.append(Finding("CAD003", "error", name, f"Left out: {error}", EXPORT_AGAIN))
            return None
        self.solids.append(solid)
        return solid


def _units(shape: Any) -> list[Any]:
    """What becomes a part each: every solid, compsolid and closed shell, and all open shells as one."""
    solids = [part for part in _members(shape) if not to_shape.is_open_shell(part)]
    shells = [part for part in _members(shape) if to_shape.is_open_shell(part)]
    return [*solids, *([compound(shells)] if len(shells) > 1 else shells)]


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


def _shapes(solids: Sequence[to_shape.MeasuredSolid]) -> tuple[dict[str, Shape], list[Finding]]:
    """Distinct sound solids by key, meshed; equal ones are meshed once."""
    distinct: dict[str, to_shape.MeasuredSolid] = {}
    for solid in solids:
        distinct.setdefault(solid.key, solid)
    mesh_shapes((solid.shape, solid.diagonal) for solid in distinct.values() if not solid.tessellated)
    shapes, findings = {}, []
    for key, solid in distinct.items():
        shape, missing = to_shape.finish(solid)
        if missing:
            findings.append(
                Finding("CAD006", "warning", solid.name, f"{missing} of {len(solid.faces)} faces could not be meshed")
            )
        if solid.tessellated:
            findings.append(
                Finding("CAD011", "info", solid.name, "Triangles without surfaces: its cylinders are fitted to them")
            )
        elif not shape.exact:
            findings.append(
                Finding("CAD007", "warning", solid.name, "The solid's exact volume is not usable; its mesh's was taken")
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
            key = piece.solid.key
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
                    leaf.color or piece.color or piece.solid.color or leaf.inherited,
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
    shells = list(dict.fromkeys(p.name for p in assembly.parts if not assembly.shapes[p.shape].closed))
    if shells:
        findings.append(Finding("CAD005", "info", path, f"Not closed, so without a volume: {listed(shells)}"))
    size = measures.extent((assembly.shapes[p.shape].bounds, p.transform) for p in assembly.parts)
    if not SMALLEST < size < LARGEST:
        findings.append(
            Finding("CAD004", "warning", path, f"The model is {size:.3g} m large: check the unit it was exported in")
        )
    return findings
