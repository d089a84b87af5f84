"""A BREP file, text or binary, to an `Assembly`: one shape of Open CASCADE, without names. Runs in the guard's child
process."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from OCP.BinTools import BinTools
from OCP.BRep import BRep_Builder
from OCP.BRepTools import BRepTools
from OCP.TopoDS import TopoDS_Shape

from yellowiron.cad.brep import products
from yellowiron.cad.brep.xcaf import ProductTree, add_product, new_document
from yellowiron.cad.readers.exact import brep_text
from yellowiron.cad.readers.exact.patience import file_must_end, text_must_end
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding

_DAMAGED = "Copy or save it again; the file is damaged."


def read_brep(path: str) -> Assembly:
    """The assembly in a BREP file, text or binary, taken to be in millimetres. `CadError` if it is damaged."""
    shape = shape_in(path, path)
    words = "The format has no unit of length: millimetres assumed, as Open CASCADE's programs have it"
    unit = Finding("CAD009", "info", path, words)
    with file_must_end(Path(path).stat().st_size):
        document = new_document()
        add_product(document, Path(path).stem, shape)
        tree = ProductTree(document, "utf-8", path)
        return products.assemble(tree, path=path, format="BREP", unit=1e-3, findings=[unit])


def shape_in(file: str, path: str) -> Any:
    """The shape in a text or binary file of Open CASCADE, millimetres. `CadError` about `path` if it is damaged."""
    shape = TopoDS_Shape()
    data = Path(file).read_bytes()
    binary = data[:64].lstrip(b"\n").startswith(b"Open CASCADE Topology V")
    if not binary and (fault := brep_text.fault(data)):
        raise CadError(f"The shape {fault}", where=path, hint=_DAMAGED)
    # Some damage is read on for ever.
    with text_must_end(len(data)):
        read = BinTools.Read_s(shape, file) if binary else BRepTools.Read_s(shape, file, BRep_Builder())
    if not read or shape.IsNull():
        raise CadError("The shape cannot be read: it is damaged or cut short", where=path, hint=_DAMAGED)
    return shape
