"""An IFC file to an `Assembly`: a part for every product with a shape. Runs in the guard's child process.

IfcOpenShell (the extra `ifc`) tessellates; it delivers metres, whatever the file's unit.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.cad.naming import decode_name
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Mesh

_DAMAGED = "Copy or export it again; the file is damaged."
_NOT_PARTS = ("IfcOpeningElement", "IfcSpace", "IfcVirtualElement", "IfcAnnotation", "IfcGrid", "IfcSite")
_DEEPEST = 50


def read_ifc(path: str) -> Assembly:
    """The assembly in an IFC file, in metres. `CadError` if it is damaged, cut short, or holds no shape."""
    try:
        import ifcopenshell
        import ifcopenshell.geom
        import ifcopenshell.util.unit
    except ImportError as error:
        raise CadError(
            "IFC files are read with the package ifcopenshell, which is not here",
            where=path,
            hint='Install it with: pip install "yellowiron[ifc]"; or export the model as STEP.',
        ) from error
    text = Path(path).read_bytes()
    if b"END-ISO-10303-21" not in text[-4096:]:
        raise CadError("The IFC file is truncated: its end is missing", where=path, hint=_DAMAGED)
    try:
        model = ifcopenshell.open(path)
        unit = float(ifcopenshell.util.unit.calculate_unit_scale(model))
        products = [p for p in model.by_type("IfcProduct") if p.Representation and not _left_out(p)]
    except (RuntimeError, ValueError, AttributeError, OSError, ifcopenshell.Error) as error:
        raise CadError(f"The IFC file cannot be read: {error}", where=path, hint=_DAMAGED) from error
    settings = ifcopenshell.geom.settings()
    shapes: dict[str, tuple[Mesh, Color | None]] = {}
    occurrences = []
    for product in products:
        try:
            made: Any = ifcopenshell.geom.create_shape(settings, product)
        except RuntimeError:
            continue  # counted as declared: the shortfall is a finding
        key = made.geometry.id
        if key not in shapes:
            shapes[key] = _mesh(made.geometry)
        mesh, color = shapes[key]
        place = np.array(made.transformation.matrix, dtype=np.float64).reshape(4, 4).T
        names = _names(product)
        occurrences.append(Occurrence(names[-1], names[:-1], mesh, place, color))
    assembly = assemble(
        occurrences, name=Path(path).stem, format="IFC", unit=unit, path=path, declared=len(products),
    )  # fmt: skip
    return replace(assembly, findings=(*assembly.findings, *_damage(text, model, path)))


def _damage(text: bytes, model: Any, path: str) -> list[Finding]:
    """Entities that the file numbers or refers to and that could not be read: IfcOpenShell says nothing of them."""
    numbered = {int(n) for n in re.findall(rb"#(\d{1,18})", re.sub(rb"'(?:[^']|'')*'", b"", text))}
    lost = len(numbered - {entity.id() for entity in model})
    if not lost:
        return []
    words = f"{lost} entities of the file cannot be read: parts may be missing or incomplete"
    return [Finding("CAD001", "warning", path, words, _DAMAGED)]


def _left_out(product: Any) -> bool:
    return any(product.is_a(kind) for kind in _NOT_PARTS)


def _names(product: Any) -> tuple[str, ...]:
    """What a product and the wholes it is part of are called, outermost first."""
    from ifcopenshell.util.element import get_aggregate, get_container

    names: list[str] = []
    above = product
    while above is not None and len(names) < _DEEPEST:
        names.append(decode_name(above.Name or "", "utf-8") or above.is_a().removeprefix("Ifc"))
        above = get_aggregate(above) or (get_container(above) if above is product else None)
    return tuple(reversed(names))


def _mesh(geometry: Any) -> tuple[Mesh, Color | None]:
    points = np.array(geometry.verts, dtype=np.float64).reshape(-1, 3)
    triangles = np.array(geometry.faces, dtype=np.int32).reshape(-1, 3)
    colors = [_color(m) for m in geometry.materials]
    rows = np.array(geometry.material_ids, dtype=np.int64)
    if not colors or len(rows) != len(triangles):
        return Mesh(points, triangles), None
    if len({colors[r] for r in set(rows.tolist()) if 0 <= r < len(colors)}) == 1:
        return Mesh(points, triangles), colors[int(rows[0])]
    painted = np.array([colors[r] if 0 <= r < len(colors) else (0.5, 0.5, 0.5) for r in rows])
    return Mesh(points, triangles, None, painted), None


def _color(material: Any) -> Color:
    diffuse = material.diffuse
    values = diffuse.components if hasattr(diffuse, "components") else (diffuse.r(), diffuse.g(), diffuse.b())
    r, g, b = (min(max(float(v), 0.0), 1.0) for v in tuple(values)[:3])
    return r, g, b
