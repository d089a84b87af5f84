"""Parking brakes on a slope of 20 degrees, on the ground, by each engine's own calls: how fast the machine goes down.

    python benchmarks/bench_slope.py FILE.usda … [--engines physx newton mujoco]

The machine is referenced into a scene (`plain.py`) with gravity, turned instead of the ground, and a plane of friction
0.7, its variant `Brakes` released or set. PhysX at 120 Hz, Newton at 240 Hz with its own settings and with those that a
build writes into `scene.usda`, MuJoCo at 1 kHz on the exported MJCF. Printed: mm/s of the root between two and seven
seconds.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import numpy as np

from plain import HZ, World, of_a_process, started

SLOPE = math.radians(20.0)
SEEN = (2.0, 7.0)
"""Seconds between which it is looked at."""
TOLD = {"mjc:option:cone": "elliptic", "mjc:option:impratio": 1000.0}
CASES = ("physx", "newton", "newton, told", "mujoco")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--engines", nargs="*", choices=("physx", "newton", "mujoco"))
    parser.add_argument("--one", nargs=2, metavar=("CASE", "BRAKES"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        case, brakes = given.one
        print(1e3 * downhill(given.files[0], case, brakes))
        return
    print("| engine | machine | released, mm/s | set, mm/s |\n|---|---|---|---|")
    for case in (c for c in CASES if not given.engines or c.split(",")[0] in given.engines):
        for file in given.files:
            cells = " | ".join(_cell(file, case, brakes) for brakes in ("released", "set"))
            print(f"| {case} | {file.stem} | {cells} |", flush=True)


def _cell(file: Path, case: str, brakes: str) -> str:
    try:
        return f"{of_a_process(__file__, file, '--one', case, brakes):.3g}"
    except RuntimeError as why:
        return str(why)


def downhill(machine: Path, case: str, brakes: str) -> float:
    """Speed (m/s) of the root between the two instants."""
    engine, _, told = case.partition(", ")
    world = World(
        HZ[engine], base="floating", ground=True, down=(math.sin(SLOPE), 0.0, -math.cos(SLOPE)),
        variants={"Brakes": brakes}, told=TOLD if told else {},
    )  # fmt: skip
    at = started(engine, machine, world)
    root = at.bodies[at.root]
    seen = []
    for number in range(round(SEEN[1] * at.hz)):
        at.step()
        if number in (round(SEEN[0] * at.hz), round(SEEN[1] * at.hz) - 1):
            seen.append(at.poses()[root, :3])
    return float(np.linalg.norm(seen[1] - seen[0])) / (SEEN[1] - SEEN[0])


if __name__ == "__main__":
    main()
