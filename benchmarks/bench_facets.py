"""Cylinders on triangles against those of the B-rep: the examples' shapes are meshed, the surfaces forgotten, the
cylinders fitted again.

Run from the repository's root: `python benchmarks/bench_facets.py [NOISE_MM] [STEP …]` (default: no noise, all
examples). A cylinder of the B-rep counts if it goes at least 1.9 rad around; it is found if a fitted one lies within
5 % of its radius. A fitted one is right if any of the B-rep's does. The fitting was tuned on the wheel loader.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "src"))

from yellowiron.cad import facets, meshed, read_cad  # noqa: E402
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


def main() -> None:
    noise = float(sys.argv[1]) * 1e-3 if len(sys.argv) > 1 else 0.0
    files = [Path(p) for p in sys.argv[2:]] or sorted(ROOT.glob("examples/*/*.step"))
    for file in files:
        random = np.random.default_rng(0)
        wanted = hit = fitted = right = triangles = 0
        angles, offs = [0.0], [0.0]
        seconds = 0.0
        for shape in (s for _, s in sorted(read_cad(file).shapes.items())):
            number = meshed.welded(shape.mesh)
            moved = random.normal(size=(int(number.max()) + 1, 3))[number] * noise
            mesh = meshed.compacted(Mesh(shape.mesh.points + moved, shape.mesh.triangles))
            triangles += len(mesh.triangles)
            start = time.process_time()
            found = facets.find(mesh).cylinders
            seconds += time.process_time() - start
            both = [(i, k, match(f, t)) for i, f in enumerate(found) for k, t in enumerate(shape.cylinders)]
            pairs = {(i, k): m for i, k, m in both if m is not None}
            fitted += len(found)
            right += len({i for i, _ in pairs})
            for k, true in enumerate(shape.cylinders):
                if true.arc >= AROUND:
                    wanted += 1
                    mine = [m for (_, j), m in pairs.items() if j == k]
                    hit += bool(mine)
                    if mine:
                        angles.append(min(mine)[0])
                        offs.append(min(mine)[1])
        print(
            f"{file.name}: {triangles} triangles, noise {1e3 * noise:g} mm: found {hit} of {wanted}, right {right} of "
            f"{fitted}; axis off by {max(angles):.4f}° and {max(offs):.5f} mm at most; {seconds:.1f} s (CPU)"
        )


if __name__ == "__main__":
    main()
