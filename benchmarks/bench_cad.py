"""Times STEP to USD against Open CASCADE's own read, transfer and mesh of the same STEP file, in the same run.

    python benchmarks/bench_cad.py [--parts 150 1500 5000] [--file machine.step] [--repeat 3]

The assemblies are generated: for every three parts one drilled block and one pin, the pin twice. Every measurement is a
process of its own that has read a small file before the clock starts; they take turns, so that a busy machine is as
busy for all, and the best of the repeats counts. Given are wall-clock and processor seconds (all threads) and the most
memory.
`ours` is `read_step` and `write_assembly`, the USD file with all it holds; `read` the first of them alone. `cascadio`,
where it is installed, goes from STEP to GLB with Open CASCADE, its instances written out.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import random
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests")]


def generate(path: Path, parts: int) -> Path:
    """A STEP assembly of drilled blocks and pins."""
    from kit.cadfiles.step import Node, Use, cut, cylinder, translation, write_step
    from kit.cadfiles.step import box as block

    rng, uses = random.Random(1), []
    for index in range(parts // 3):
        r, length = rng.uniform(10, 60), rng.uniform(50, 300)
        holes = cylinder(r, length, (2 * r, 2 * r, 0)), cylinder(r / 4, 4 * r, (0, 2 * r, length / 2), (1, 0, 0))
        drilled = Node(f"BLOCK {index}", cut(block(4 * r, 4 * r, length), *holes))
        pin = Node(f"PIN {index}", cylinder(r, length + 20))
        uses.append(Use(drilled, translation(index * 300, 0, 0)))
        uses += [Use(pin, translation(index * 300, y, 0)) for y in (500, 1000)]
    return write_step(path, Node("MACHINE", children=uses))


def occ(path: Path) -> Callable[[], object]:
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

    from yellowiron.cad.brep.tessellate import ANGLE

    def run() -> None:
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

    return run


def read(path: Path) -> Callable[[], object]:
    """Our reader alone."""
    from yellowiron.cad.readers.exact.step import read_step

    return lambda: read_step(str(path))


def ours(path: Path) -> Callable[[], object]:
    """STEP to USD, in one process."""
    from pxr import Usd, UsdGeom, UsdShade  # noqa: F401 - loaded before the clock starts

    from yellowiron.cad.readers.exact.step import read_step
    from yellowiron.usd import write_assembly

    return lambda: write_assembly(read_step(str(path)), path.with_suffix(".usdc"))


def cascadio(path: Path) -> Callable[[], object]:
    """STEP to GLB by cascadio, at our tolerances."""
    import cascadio as library

    from yellowiron.cad.brep.tessellate import ANGLE

    return lambda: library.step_to_glb(str(path), str(path.with_suffix(".glb")), 1.0, ANGLE)


def measured(what: str, path: Path, small: Path) -> dict[str, float]:
    """One run in a process of its own: wall-clock and processor seconds, MB."""
    command = [sys.executable, __file__, "--one", what, str(path), str(small)]
    outcome = subprocess.run(command, capture_output=True, text=True, check=True)
    values: dict[str, float] = json.loads(outcome.stdout.splitlines()[-1])
    return values


def once(what: str, path: Path, small: Path) -> None:
    """In that process: the run, and what it took."""
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    kind = {"occ": occ, "read": read, "ours": ours, "cascadio": cascadio}[what]
    kind(small)()
    run = kind(path)
    wall, cpu = time.perf_counter(), time.process_time()
    run()
    taken = {"wall": time.perf_counter() - wall, "cpu": time.process_time() - cpu}
    taken["mb"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    out.write(json.dumps(taken) + "\n")
    out.flush()
    os._exit(0)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", type=int, nargs="*", default=[150, 1500], help="sizes of generated assemblies")
    parser.add_argument("--file", type=Path, nargs="*", default=[], help="STEP files to time as well")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one:
        once(arguments.one[0], Path(arguments.one[1]), Path(arguments.one[2]))
    kinds = ["occ", "read", "ours", *(["cascadio"] if importlib.util.find_spec("cascadio") else [])]
    print("| file | " + " | ".join(kinds) + " | ours / occ, wall | processor |\n|" + "---|" * (len(kinds) + 3))
    with tempfile.TemporaryDirectory() as folder:
        small = generate(Path(folder) / "small.step", 6)
        files = [generate(Path(folder) / f"{parts}_parts.step", parts) for parts in arguments.parts]
        for path in [*files, *arguments.file]:
            best: dict[str, dict[str, float]] = {}
            for _ in range(arguments.repeat):
                for kind in kinds:
                    taken = measured(kind, path, small)
                    best[kind] = {key: min(value, best.get(kind, taken)[key]) for key, value in taken.items()}
            cells = [f"{b['wall']:.2f} s, {b['cpu']:.2f} s, {b['mb']:.0f} MB" for b in best.values()]
            ratios = [f"{best['ours'][key] / best['occ'][key]:.2f}" for key in ("wall", "cpu")]
            print(f"| {path.name} | " + " | ".join([*cells, *ratios]) + " |", flush=True)


if __name__ == "__main__":
    main()
