"""What opens a machine with an engine's own settings: how far its pins come apart at the engine's usual time steps.

    python benchmarks/bench_defaults.py [FILE.usda …] [--engines physx newton mujoco] [--full]

Default: both examples, built into a temporary folder, and with `--data FOLDER` the ZX120 that it holds. Each engine is
called by its own documentation and nothing of `yellowiron.simulation` is used: the machine is referenced into a plain
scene (MuJoCo opens the exported MJCF), its base is fixed, every cylinder goes slowly to 2 and to 98 % of its stroke and
back, alone and then all together. A gap is the distance of the two halves of a cut pin, in mm; the worst of all loops
and instants counts. One engine a process: what has burst may not be let go by the engine.
"""

from __future__ import annotations

import argparse
import json
import math
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from plain import Pin, Slide, World, built, of_a_process, started, turned

LEG = 3.0
"""Seconds of a leg at least: drawn to low, low to high, high to drawn."""
SLOW = 0.12
"""m/s that no cylinder exceeds: less than the slowest's rated speed."""
REST = 1.0
"""Seconds before the first leg."""
GONE = 1e3
"""Metres: what is farther apart has burst."""

CASES: dict[str, dict[str, tuple[float, int, dict[str, Any]]]] = {
    "physx": {
        "60 Hz": (60.0, 1, {}),
        "120 Hz": (120.0, 1, {}),
        "240 Hz": (240.0, 1, {}),
        "1 kHz": (1000.0, 1, {}),
        "60 Hz, 4 iterations": (60.0, 1, {"iterations": 4}),
        "120 Hz, 4 iterations": (120.0, 1, {"iterations": 4}),
    },
    "newton": {
        "60 Hz": (60.0, 1, {}),
        "120 Hz": (120.0, 1, {}),
        "240 Hz": (240.0, 1, {}),
        "1 kHz": (1000.0, 1, {}),
        "60 Hz x 4": (60.0, 4, {}),
        "60 Hz x 10": (60.0, 10, {}),
        "60 Hz x 4, Euler": (60.0, 4, {"options": {"integrator": "euler", "cone": "elliptic"}}),
        "60 Hz x 10, Euler": (60.0, 10, {"options": {"integrator": "euler", "cone": "elliptic"}}),
    },
    "mujoco": {
        name: (hz, 1, {}) for name, hz in (("60 Hz", 60.0), ("120 Hz", 120.0), ("240 Hz", 240.0), ("1 kHz", 1e3))
    },
}
"""Targets a second, the engine's steps to each, and what else the scene says."""
LONG = ("1 kHz",)
"""Left out without `--full`, in PhysX."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--engines", nargs="*", choices=CASES, default=list(CASES))
    parser.add_argument("--cases", nargs="*", help="only those settings, by their names in the table")
    parser.add_argument("--data", type=Path, help="a folder with zx120/zx120.glb")
    parser.add_argument("--full", action="store_true", help="PhysX at 1 kHz as well, which takes minutes")
    parser.add_argument("--one", nargs=2, metavar=("ENGINE", "CASE"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        engine, case = given.one
        print(json.dumps(widest(engine, given.files[0], case)))
        return
    with tempfile.TemporaryDirectory() as folder:
        files = given.files or built(Path(folder), given.data)
        for engine in given.engines:
            names = [n for n in CASES[engine] if n in (given.cases or CASES[engine])]
            if engine == "physx" and not (given.full or given.cases):
                names = [name for name in names if name not in LONG]
            table(engine, names, files)


def table(engine: str, cases: list[str], files: list[Path]) -> None:
    print(f"\n{engine}: pins' gaps, mm\n\n| | {' | '.join(f.parent.name for f in files)} |\n|---|{'---|' * len(files)}")
    for case in cases:
        found = [apart(engine, case, file) for file in files]
        print(f"| {case} | {' | '.join(found)} |", flush=True)


def apart(engine: str, case: str, file: Path) -> str:
    """The worst gap and where, by a process of its own."""
    try:
        found = of_a_process(__file__, file, "--one", engine, case)
    except RuntimeError as why:
        return str(why)
    gap = found["gap"]
    return f"{gap:.3g} ({found['pin']}; {found['rate']:.0f} steps/s)" if gap < GONE * 1e3 else "bursts"


# ---- what is done ----------------------------------------------------------------------------------------------------
def targets(slides: Sequence[Slide], hz: float) -> Iterator[np.ndarray]:
    """A row of targets a step, metres from the drawn pose."""
    now = np.zeros(len(slides))
    for _ in range(round(REST * hz)):
        yield now
    ways = [[i] for i in range(len(slides))]
    for moved in [*ways, list(range(len(slides)))] if len(slides) > 1 else ways:
        for share in (0.02, 0.98, None):
            end = now.copy()
            for i in moved:
                low, high = slides[i].lower, slides[i].upper
                end[i] = 0.0 if share is None else low + share * (high - low)
            steps = math.ceil(hz * max(LEG, 0.5 * math.pi * float(np.abs(end - now).max()) / SLOW))
            for step in range(1, steps + 1):
                yield now + (end - now) * (0.5 - 0.5 * math.cos(math.pi * step / steps))
            now = end
        for _ in range(round(0.5 * hz)):
            yield now


class Worst:
    """Of pins, the widest gap so far. Poses come as positions and quaternions (x y z w) of numbered bodies."""

    def __init__(self, pins: Sequence[Pin], numbers: Mapping[str, int]) -> None:
        self._names = [pin.name for pin in pins]
        self._bodies = [np.array([numbers[pin.bodies[side]] for pin in pins]) for side in (0, 1)]
        self._places = [np.array([pin.places[side] for pin in pins]) for side in (0, 1)]
        self.gap, self.pin = 0.0, ""

    def see(self, positions: np.ndarray, quaternions: np.ndarray) -> bool:
        """Whether all are still somewhere."""
        one, other = (positions[b] + turned(quaternions[b], p) for b, p in zip(self._bodies, self._places, strict=True))
        gaps = np.linalg.norm(one - other, axis=1)
        if not np.isfinite(gaps).all():
            self.gap = math.inf
            return False
        if gaps.max() > self.gap:
            self.gap, self.pin = float(gaps.max()), self._names[int(gaps.argmax())]
        return self.gap < GONE

    def told(self, steps: int, seconds: float) -> dict[str, Any]:
        return {"gap": min(1e3 * self.gap, 1e9), "pin": self.pin, "rate": steps / max(seconds, 1e-9)}


def widest(engine: str, machine: Path, case: str) -> dict[str, Any]:
    """`gap` (mm) of the worst pin and instant, its `pin`, and the `rate` in steps a second."""
    hz, substeps, more = CASES[engine][case]
    at = started(engine, machine, World(hz * substeps, **more))
    worst, begun, steps = Worst(at.pins, at.bodies), time.process_time(), 0
    for wanted in targets(at.slides, hz):
        at.tell(wanted)
        for _ in range(substeps):
            at.step()
            steps += 1
        poses = at.poses()
        if not worst.see(poses[:, :3], poses[:, 3:]):
            break
    return worst.told(steps, time.process_time() - begun)


if __name__ == "__main__":
    main()
