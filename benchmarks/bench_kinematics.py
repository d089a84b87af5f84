"""Closed-chain kinematics, timed on a Z-bar loader with twin lift cylinders and articulated steering: 6 loops.

    python benchmarks/bench_kinematics.py

Prints the median wall time of five runs: building the chain, sweeping 1000 points with all cylinders moving, completing
(mobility, limits, branches, gains) and measuring; and the largest error of the sweep against the planar solution.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "kinematics"))

from planar_zbar import sketch, strokes, with_measurements, wrapped, zbar_mechanism
from test_kinematics_measure import TEMPLATES

from yellowiron.kinematics import ClosedChain, complete, measure

POINTS = 1000


def timed(what: Callable[[], Any]) -> tuple[float, Any]:
    times = []
    for _ in range(5):
        start = time.perf_counter()
        result = what()
        times.append(time.perf_counter() - start)
    return statistics.median(times), result


def main() -> None:
    z = sketch()
    travel = strokes(z)
    mechanism = with_measurements(zbar_mechanism(z, travel), TEMPLATES, {})
    (l0, l1), (t0, t1) = travel
    lift = np.linspace(l0, l1, POINTS)
    tilt = t0 + (t1 - t0) * (0.5 - 0.5 * np.cos(np.linspace(0.0, 20.0, POINTS)))
    steer = 0.15 * np.sin(np.linspace(0.0, 9.0, POINTS))
    paths = {"lift_l": lift, "tilt": tilt, "steering_l": steer}

    built, chain = timed(lambda: ClosedChain(mechanism))
    swept, states = timed(lambda: chain.sweep(paths))
    completed, _ = timed(lambda: complete(mechanism))
    measured, _ = timed(lambda: measure(mechanism))
    worst = 0.0
    for state, a, b in zip(states, lift, tilt, strict=True):
        p = z.pose(z.lift + a, z.tilt + b)
        for joint, angle in (("boom_pin", -p["boom"]), ("bucket_pin", p["boom"] - p["bucket"])):
            worst = max(worst, abs(wrapped(chain.coordinate(state, joint) - angle)))
    print(f"chain built            {1e3 * built:8.1f} ms")
    print(f"sweep, {POINTS} points     {1e3 * swept:8.1f} ms   worst angle {worst:.1e} rad")
    print(f"complete               {1e3 * completed:8.1f} ms")
    print(f"measure, {len(TEMPLATES)} quantities {1e3 * measured:8.1f} ms")


if __name__ == "__main__":
    main()
