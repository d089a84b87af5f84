"""Times `read_cad` against Open CASCADE's own read, transfer and mesh of the same STEP file, in the same run.

    python benchmarks/bench_cad.py [--parts 150 1500] [--file machine.step] [--repeat 3]

The assemblies are generated: for every three parts one drilled block and one pin, the pin twice. The best of the
repeats counts. `guarded` is `read_cad` with its child process, so with the start of Python and Open CASCADE's import.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests" / "cad")]


def generate(path: Path, parts: int) -> Path:
    """A STEP assembly of drilled blocks and pins."""
    from cad_stepfiles import Node, Use, cut, cylinder, translation, write_step
    from cad_stepfiles import box as block

    rng, uses = random.Random(1), []
    for index in range(parts // 3):
        r, length = rng.uniform(10, 60), rng.uniform(50, 300)
        holes = cylinder(r, length, (2 * r, 2 * r, 0)), cylinder(r / 4, 4 * r, (0, 2 * r, length / 2), (1, 0, 0))
        drilled = Node(f"BLOCK {index}", cut(block(4 * r, 4 * r, length), *holes))
        pin = Node(f"PIN {index}", cylinder(r, length + 20))
        uses.append(Use(drilled, translation(index * 300, 0, 0)))
        uses += [Use(pin, translation(index * 300, y, 0)) for y in (500, 1000)]
    return write_step(path, Node("MACHINE", children=uses))


def occ(path: Path) -> None:
    """What Open CASCADE itself takes: read, transfer, and one mesh at 1 mm and our angle over all shapes."""
    from OCP.BRep import BRep_Builder
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.collections import Sequence_TDF_Label
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.TopoDS import TopoDS_Compound
    from OCP.XCAFApp import XCAFApp_Application
    from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

    from yellowiron.cad.tessellate import ANGLE

    reader = STEPCAFControl_Reader()
    reader.ReadFile(str(path))
    document = TDocStd_Document(TCollection_ExtendedString("bench"))
    XCAFApp_Application.GetApplication_s().NewDocument(TCollection_ExtendedString("BinXCAF"), document)
    reader.Transfer(document)
    roots, compound, builder = Sequence_TDF_Label(), TopoDS_Compound(), BRep_Builder()
    XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).GetFreeShapes(roots)
    builder.MakeCompound(compound)
    for index in range(1, roots.Length() + 1):
        builder.Add(compound, XCAFDoc_ShapeTool.GetShape_s(roots.Value(index)))
    BRepMesh_IncrementalMesh(compound, 1.0, False, ANGLE, True)


def best(repeat: int, function: Callable[[], Any]) -> tuple[float, Any]:
    """The shortest of a few runs, seconds, and the last result."""
    times, result = [], None
    for _ in range(repeat):
        start = time.perf_counter()
        result = function()
        times.append(time.perf_counter() - start)
    return min(times), result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", type=int, nargs="*", default=[150, 1500], help="sizes of generated assemblies")
    parser.add_argument("--file", type=Path, nargs="*", default=[], help="STEP files to time as well")
    parser.add_argument("--repeat", type=int, default=3)
    arguments = parser.parse_args()

    from yellowiron.cad import read_cad
    from yellowiron.cad.step import read_step

    print(f"{'file':24} {'parts':>6} {'shapes':>6} {'OCC':>8} {'ours':>8} {'ratio':>6} {'guarded':>8}")
    with tempfile.TemporaryDirectory() as folder:
        files = [generate(Path(folder) / f"{parts}_parts.step", parts) for parts in arguments.parts]
        for path in [*files, *arguments.file]:
            theirs, _ = best(arguments.repeat, lambda path=path: occ(path))
            ours, assembly = best(arguments.repeat, lambda path=path: read_step(str(path)))
            guarded, _ = best(1, lambda path=path: read_cad(path))
            print(
                f"{path.name:24} {len(assembly.parts):6} {len(assembly.shapes):6} {theirs:7.2f}s {ours:7.2f}s "
                f"{ours / theirs:6.2f} {guarded:7.2f}s"
            )


if __name__ == "__main__":
    main()
