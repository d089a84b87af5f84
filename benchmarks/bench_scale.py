"""Builds one machine at several sizes, and prints each stage's time and memory against the parts.

    python benchmarks/bench_scale.py [--example examples/wheel_loader] [--parts 150 1500 5000]

The machine is the example's; it grows by bolts that stand on its plates (three shapes, at random places) and shrinks
by leaving its own hardware out. Every size is built in a process of its own. `growth` is a stage's time per part
against that of the size before: above 1, it grows faster than the parts. Times are the processor's, of the build and
the children that read files for it: other work on the machine changes them little. Memory is the largest resident size
during a stage; the CAD reader's is that of its child process.
"""

from __future__ import annotations

import argparse
import itertools
import json
import random
import resource
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from yellowiron import pipeline

ROOT = Path(__file__).resolve().parent.parent
STAGES = ("convert", "extract", "align", "mechanism", "measure", "write", "check", "report")
BOLTS = ((8.0, 8.0), (10.0, 10.0), (12.0, 12.0))
"""Radius and length of the shanks, mm: no longer than plates are thick."""
CLEAR, GRAIN = 0.06, 0.02
"""Metres: from a bolt to other parts and bolts; between the points that stand for a surface."""
MOST = 60_000
"""Places that are tried."""
MANY = 8
"""A shape that is used so often in one assembly is hardware."""


def resize(source: Path, target: Path, parts: int) -> Path:
    """The STEP assembly with about so many parts: bolts added to its largest faces, or its smallest shapes left out."""
    from OCP.collections import Sequence_TDF_Label
    from OCP.Message import Message
    from OCP.STEPCAFControl import STEPCAFControl_Reader, STEPCAFControl_Writer
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name
    from OCP.TDF import TDF_Label
    from OCP.TDocStd import TDocStd_Document
    from OCP.TopLoc import TopLoc_Location
    from OCP.XCAFApp import XCAFApp_Application
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    from yellowiron.cad import read_cad

    Message.DefaultMessenger_s().ChangePrinters().Clear()
    assembly = read_cad(source)
    document = TDocStd_Document(TCollection_ExtendedString("scale"))
    XCAFApp_Application.GetApplication_s().NewDocument(TCollection_ExtendedString("BinXCAF"), document)
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    reader.ReadFile(str(source))
    reader.Transfer(document)
    shapes, roots = XCAFDoc_DocumentTool.ShapeTool_s(document.Main()), Sequence_TDF_Label()
    shapes.GetFreeShapes(roots)
    machine, missing = roots.Value(1), parts - len(assembly.parts)
    if missing < 0:
        drop_hardware(shapes, machine, -missing)
    else:
        labels: list[TDF_Label] = []
        for number, (radius, length) in enumerate(BOLTS):
            labels.append(shapes.AddShape(bolt(radius, length), False))
            TDataStd_Name.Set_s(labels[-1], TCollection_ExtendedString(f"BOLT {number}"))
        for place, number in zip(places(assembly), range(missing), strict=False):
            shapes.AddComponent(machine, labels[number % len(labels)], TopLoc_Location(place))
    shapes.UpdateAssemblies()
    writer = STEPCAFControl_Writer()
    writer.SetNameMode(True)
    writer.SetColorMode(True)
    writer.Transfer(document)
    writer.Write(str(target))
    return target


def bolt(radius: float, length: float) -> Any:
    """A shank along −z and its head above z = 0."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Fuse
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    shank = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, -1)), radius, length).Shape()
    head = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 1.8 * radius, 1.3 * radius).Shape()
    return BRepAlgoAPI_Fuse(shank, head).Shape()


def places(assembly: Any) -> Iterator[Any]:
    """Frames on flat spots of large parts, z out of the surface, millimetres; the same every time. A bolt is clear of
    other parts and of earlier bolts, as on a real machine: what touches two bodies would hold them together."""
    from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt, gp_Trsf
    from scipy.spatial import cKDTree

    rng, spots, skins, owners = random.Random(1), [], [], []
    dice = np.random.default_rng(1)
    room = 3e-3 * max(b[0] for b in BOLTS)
    uses = Counter(part.shape for part in assembly.parts)
    for number, part in enumerate(assembly.parts):
        mesh, points = assembly.shape_of(part).mesh, assembly.points_of(part)
        corners = points[mesh.triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        areas = 0.5 * np.linalg.norm(normals, axis=1)
        copies = np.repeat(np.arange(len(areas)), np.ceil(areas / GRAIN**2).astype(int))
        weights = dice.dirichlet((1.0, 1.0, 1.0), len(copies))
        skins.append(np.einsum("ij,ijk->ik", weights, corners[copies]))
        owners += [number] * len(copies)
        if np.ptp(points, axis=0).max() < 0.5 or uses[part.shape] >= MANY:
            continue  # shoes of a track are alike: one with bolts on it would be none of them
        around = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).sum(axis=1)
        wide = np.flatnonzero(2.0 * areas / np.maximum(around, 1e-9) > room)  # the inscribed circle's radius
        spots += [(number, areas[i], corners[i], normals[i] / np.linalg.norm(normals[i])) for i in wide]
    skin, owner, taken = cKDTree(np.concatenate(skins)), np.array(owners), []
    sizes = [area for _, area, _, _ in spots]
    for _ in range(MOST):
        number, _, corners, normal = rng.choices(spots, sizes)[0]
        weights = np.array([rng.uniform(0.1, 1.0) for _ in range(3)])
        spot = (weights / weights.sum()) @ corners
        if (owner[skin.query_ball_point(spot, CLEAR)] != number).any():
            continue
        if taken and np.min(np.linalg.norm(np.array(taken) - spot, axis=1)) < CLEAR:
            continue
        taken.append(spot)
        frame = gp_Trsf()
        frame.SetTransformation(gp_Ax3(gp_Pnt(*(1000.0 * spot).tolist()), gp_Dir(*normal.tolist())), gp_Ax3())
        yield frame


def drop_hardware(shapes: Any, machine: Any, count: int) -> None:
    """Removes hardware, the shapes that are there most often first, until `count` are gone or none is left."""
    from OCP.collections import Sequence_TDF_Label
    from OCP.TDF import TDF_Label

    uses: dict[str, list[Any]] = {}
    queue = [machine]
    while queue:
        children = Sequence_TDF_Label()
        shapes.GetComponents_s(queue.pop(), children)
        for index in range(1, children.Length() + 1):
            referred = TDF_Label()
            shapes.GetReferredShape_s(children.Value(index), referred)
            if shapes.IsAssembly_s(referred):
                queue.append(referred)
            else:
                uses.setdefault(str(referred.Tag()), []).append(children.Value(index))
    for group in sorted(uses.values(), key=len, reverse=True):
        for label in group[: max(0, count)] if len(group) >= MANY else ():
            shapes.RemoveComponent(label)
        count -= len(group)


class Stages:
    """By stage of a build the processor time, seconds, and the largest resident memory of this process, MB."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self.memory: dict[str, float] = {}

    @contextmanager
    def stage(self, _: Any, name: str, words: str) -> Iterator[None]:
        """Stands in for the build's clock."""
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
        before = self._now()
        yield
        self.seconds[name] = self._now() - before
        self.memory[name] = self._high()

    @staticmethod
    def _now() -> float:
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return time.process_time() + used.ru_utime + used.ru_stime

    @staticmethod
    def _high() -> float:
        status = Path("/proc/self/status").read_text(encoding="ascii")
        return float(status.split("VmHWM:")[1].split()[0]) / 1024.0


def one(equipment_type: str, cad: Path, sheets: list[Path], out: Path) -> dict[str, Any]:
    """Builds a machine and returns its parts, seconds and megabytes by stage."""
    stages = Stages()
    pipeline._Clock.stage = lambda clock, name, words: stages.stage(clock, name, words)  # type: ignore[method-assign]
    machine = pipeline.build(equipment_type, cad, out, sheets=sheets)
    seconds, memory = stages.seconds, stages.memory
    seconds["total"] = sum(seconds.values())
    memory["convert"] = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024.0
    parts = machine.document["alignment"]
    return {
        "parts": parts["parts"], "to_review": len(parts["to_review"]), "seconds": seconds, "memory": memory,
    }  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--example", type=Path, default=ROOT / "examples" / "wheel_loader")
    parser.add_argument("--parts", type=int, nargs="*", default=[150, 1500, 5000])
    parser.add_argument("--one", type=Path, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    sheets = sorted(arguments.example.glob("*.pdf"))
    if arguments.one:
        with tempfile.TemporaryDirectory() as folder:
            print(json.dumps(one(arguments.example.name, arguments.one, sheets, Path(folder, "out"))))
        return
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for parts in arguments.parts:
            source = next(arguments.example.glob("*.step"))
            cad = resize(source, Path(folder, f"{parts}.step"), parts)
            command = [sys.executable, __file__, "--example", str(arguments.example), "--one", str(cad)]
            done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
            rows.append(json.loads(done.stdout.splitlines()[-1]))
    table = Table("stage", *(f"{row['parts']} parts" for row in rows), *(["growth"] * (len(rows) - 1)))
    for stage in (*STAGES, "total"):
        cells = [
            f"{row['seconds'][stage]:.2f} s" + (f"  {row['memory'][stage]:.0f} MB" if stage in row["memory"] else "")
            for row in rows
        ]
        per_part = [row["seconds"][stage] / row["parts"] for row in rows]
        growth = [f"{b / a:.2f}" for a, b in itertools.pairwise(per_part)]
        table.add_row(stage, *cells, *growth)
    table.add_row("to review", *(str(row["to_review"]) for row in rows))
    Console(width=140).print(table)


if __name__ == "__main__":
    main()
