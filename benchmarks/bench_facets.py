"""Cylinders on triangles against those of the B-rep: the examples' shapes are meshed, the surfaces forgotten, the
cylinders fitted again.

Run from the repository's root: `python benchmarks/bench_facets.py [--noise MM] [--segments N …] [STEP …]` (default: no
noise, the meshes that USD gets, all examples; N is the number of strips to a circle). A cylinder of the B-rep counts if
it goes at least 1.9 rad around; it is found if a fitted one lies within 5 % of its radius. A fitted one is right if any
of the B-rep's does. Those of joints, by which machines are aligned, are bores and shafts of two parts that fit into
each other. The fitting was tuned on the wheel loader. Coordinates are in single precision.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "src"))

from yellowiron.alignment.features.contacts import fits_of  # noqa: E402
from yellowiron.alignment.features.solids import solids_of  # noqa: E402
from yellowiron.cad.brep import tessellate  # noqa: E402
from yellowiron.cad.mesh import measures  # noqa: E402
from yellowiron.cad.mesh.features import facets  # noqa: E402
from yellowiron.cad.readers.exact.step import read_step  # noqa: E402
from yellowiron.model.assembly import Assembly  # noqa: E402
from yellowiron.model.geometry import CylinderFeature, Mesh  # noqa: E402

AROUND = 1.9
"""Radians."""


def match(found: CylinderFeature, true: CylinderFeature) -> tuple[float, float] | None:
    """Degrees and mm between the axes of two cylinders that are the same one; None for two."""
    cosine = abs(float(np.dot(found.direction, true.direction)))
    delta = np.subtract(found.center, true.center)
    along = float(delta @ np.asarray(true.direction))
    off = float(np.linalg.norm(delta - along * np.asarray(true.direction)))
    same = found.inner == true.inner and cosine > 0.999 and off < 0.05 * true.radius + 1e-4
    close = abs(found.radius - true.radius) < 0.05 * true.radius and abs(along) < 0.5 * (found.length + true.length)
    return (float(np.degrees(np.arccos(min(1.0, cosine)))), 1e3 * off) if same and close else None


def read(file: Path, segments: int | None) -> Assembly:
    """The assembly in a STEP file, its circles cut into so many strips."""
    if segments is not None:
        # Open CASCADE halves the angle on circles.
        tessellate.ANGLE = 4.0 * math.pi / segments * (1.0 + 1e-6)
        tessellate.RELATIVE_DEFLECTION = 0.55 * (1.0 - math.cos(math.pi / segments))
        tessellate.DEFLECTION_RANGE = (1e-3, 1e4)
    return read_step(str(file))


def in_joints(assembly: Assembly) -> Iterator[tuple[str, int]]:
    """Shape and number of the cylinders that fit into each other."""
    solids = solids_of(assembly)
    size = float(np.linalg.norm(np.ptp(np.concatenate([s.points for s in solids]), axis=0)))
    for fit in fits_of(solids, 4e-5 * size):
        for index, one in ((fit.inner, fit.shaft), (fit.outer, fit.bore)):
            for k, other in enumerate(solids[index].cylinders):
                if other.inner == one.inner and abs(other.radius - one.radius) < 1e-9 and other.off(one.center) < 1e-9:
                    yield solids[index].part.shape, k


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--noise", type=float, default=0.0, help="of every corner, mm")
    parser.add_argument("--segments", type=int, nargs="*", help="strips to a circle")
    parser.add_argument("steps", type=Path, nargs="*", metavar="STEP")
    options = parser.parse_args()
    for file in options.steps or sorted(ROOT.glob("examples/*/*.step")):
        for segments in options.segments or [None]:
            measure(file, segments, options.noise * 1e-3)


def measure(file: Path, segments: int | None, noise: float) -> None:
    """One line: what was found, how much of it was right, and how far off."""
    assembly = read(file, segments)
    joints = set(in_joints(assembly))
    random = np.random.default_rng(0)
    wanted = hit = jointed = held = fitted = right = triangles = 0
    angles, offs = [0.0], [0.0]
    seconds = 0.0
    for key, shape in sorted(assembly.shapes.items()):
        number = measures.welded(shape.mesh)
        moved = random.normal(size=(int(number.max()) + 1, 3))[number] * noise
        points = (shape.mesh.points + moved).astype(np.float32).astype(np.float64)
        mesh = measures.compacted(Mesh(points, shape.mesh.triangles))
        triangles += len(mesh.triangles)
        start = time.process_time()
        found = facets.find(mesh).cylinders
        seconds += time.process_time() - start
        both = [(i, k, match(f, t)) for i, f in enumerate(found) for k, t in enumerate(shape.cylinders)]
        pairs = {(i, k): m for i, k, m in both if m is not None}
        fitted += len(found)
        right += len({i for i, _ in pairs})
        for k, true in enumerate(shape.cylinders):
            if true.arc < AROUND:
                continue
            mine = [m for (_, j), m in pairs.items() if j == k]
            wanted += 1
            hit += bool(mine)
            jointed += (key, k) in joints
            held += bool(mine) and (key, k) in joints
            if mine:
                angles.append(min(mine)[0])
                offs.append(min(mine)[1])
    cut = "default" if segments is None else f"{segments} to a circle"
    print(
        f"{file.name}, {cut}, noise {1e3 * noise:g} mm: {triangles} triangles, found {hit} of {wanted}, of joints "
        f"{held} of {jointed}, right {right} of {fitted}; axis off by {np.percentile(angles, 99):.4f}° and "
        f"{np.percentile(offs, 99):.4f} mm (99 %), {max(angles):.4f}° and {max(offs):.4f} mm at most; "
        f"{seconds:.1f} s (CPU)",
        flush=True,
    )


if __name__ == "__main__":
    main()
