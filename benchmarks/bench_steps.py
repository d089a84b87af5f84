"""Steps of a target in PhysX and Newton, by plain calls on the file: how fast a cylinder goes, by its rated speed.

    python benchmarks/bench_steps.py [FILE.usda …] [--engines physx newton] [--each-way | --levers] [--free]

Default: both examples, built into a temporary folder. The machine is referenced into a plain scene with its base fixed
(`bench_defaults.py`); nothing of `yellowiron.simulation` is used. From the drawn pose, and from the one with all
cylinders at their farther ends, every cylinder is told one end of its stroke, and then the other; printed is its
greatest speed each way in per cent of flow over area. With `--each-way` PhysX is told limits before every step
(`yellowiron.each_way`). With `--levers` the file's variant `Actuation` is `hydraulic`, levers are pushed whole instead,
through `yellowiron.hydraulics`, one by one and then all at once, and the most power of all cylinders is printed (by
what their drives give at their positions and speeds). With `--free` the machine stands on the ground, brakes set.
MuJoCo: `bench_physics.py`.
"""

from __future__ import annotations

import argparse
import json
import tempfile
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from bench_slope import TOLD
from plain import HZ, Engine, PhysX, World, built, of_a_process, started
from yellowiron.each_way import EachWay
from yellowiron.hydraulics import Hydraulics
from yellowiron.model.mechanism import Drive as Rated
from yellowiron.model.mechanism import Mechanism
from yellowiron.usd import read_mechanism

FINE = 1000.0
"""Steps a second of Newton with `--levers`, its integrator Euler's: by its own, drives do work that is lost."""
REST = 1.0
"""Seconds before a step, and the time that a cylinder has to a pose."""
INTEGRATOR = "mjc:option:integrator"
FLYWHEEL = 0.05
"""Seconds over which an engine's flywheel bears what a blow takes: 6 kJ at 123 kW, of the tens that it holds."""
STANDING = 2.0
"""Seconds to stand still on the ground."""
LONGEST = 12.0
"""Seconds to an end."""
Drive = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
"""One step with targets: where the slides are, and how fast they go."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--engines", nargs="*", choices=HZ, default=list(HZ))
    led = parser.add_mutually_exclusive_group()
    led.add_argument("--each-way", action="store_true")
    led.add_argument("--levers", action="store_true")
    parser.add_argument("--free", action="store_true")
    parser.add_argument("--one", help=argparse.SUPPRESS)
    given = parser.parse_args()
    known = (("--each-way", given.each_way), ("--levers", given.levers), ("--free", given.free))
    options = [option for option, on in known if on]
    if given.one:
        print(json.dumps(steps_in(given.one, given.files[0], options)))
        return
    with tempfile.TemporaryDirectory() as folder:
        for file in given.files or built(Path(folder)):
            print(f"\n{file.parent.name}: greatest speed, of rated\n")
            print("| engine | cylinder | retracts | extends |\n|---|---|---|---|")
            for engine in given.engines:
                try:
                    told = of_a_process(__file__, file, "--one", engine, *options)
                except RuntimeError as why:
                    print(f"| {engine} | {why} | | |")
                    continue
                for name, (back, forth) in told["speeds"].items():
                    print(f"| {engine} | {name} | {back:.0%} | {forth:.0%} |", flush=True)
                if given.levers:
                    most, lasting = (1e-3 * told[kind] for kind in ("power", "taken"))
                    print(f"| {engine} | all at once: {most:.0f} kW, {lasting:.0f} over 50 ms | | |", flush=True)


def steps_in(engine: str, file: Path, options: Sequence[str] = ()) -> dict[str, Any]:
    """`speeds`: slide → the greatest of its speeds each way, by its rated ones. `power`: the most of all, W, and
    `taken`, the most over 50 ms."""
    mechanism, oil = read_mechanism(file), "--levers" in options
    hz = FINE if oil and engine == "newton" else HZ[engine]
    variants: dict[str, str] = {"Actuation": "hydraulic"} if oil else {}
    told: dict[str, str | float] = {INTEGRATOR: "euler"} if oil else {}
    if "--free" in options:
        world = World(hz, "floating", ground=True, variants=variants | {"Brakes": "set"}, told=told | TOLD)
    else:
        world = World(hz, variants=variants, told=told)
    at = started(engine, file, world)
    drive = stepped(at, mechanism if "--each-way" in options else None)
    slides, names = at.slides, [slide.name for slide in at.slides]
    rated = [own for name in names if (own := mechanism.joint(name).drive) is not None]
    low, high = np.array([s.lower for s in slides]), np.array([s.upper for s in slides])
    worst = {name: [0.0, 0.0] for name in names}
    for _ in range(round(STANDING * hz) if world.ground else 0):
        drive(np.zeros(len(slides)))
    if oil:
        return by_levers(mechanism, drive, names, rated, hz, implicit=engine == "physx")

    def go(targets: np.ndarray, seconds: float, watched: int | None = None) -> None:
        for _ in range(round(seconds * hz)):
            at, speeds = drive(targets)
            if watched is None:
                continue
            faster(worst[names[watched]], float(speeds[watched]), rated[watched])
            if abs(float(at[watched] - targets[watched])) < 2e-3:
                return

    out = np.where(high > -low, 0.95 * high, 0.95 * low)
    for pose in (np.zeros(len(slides)), out):
        for number in range(len(slides)):
            go(pose, REST + LONGEST * float(np.abs(pose).max() > 0.0))
            for end in (low, high):
                told = pose.copy()
                told[number] = end[number]
                go(told, LONGEST, number)
    return {"speeds": worst}


def faster(seen: list[float], speed: float, rated: Rated) -> None:
    """Keeps the greatest of the speeds, by the rated one that way."""
    way = int(speed > 0.0)
    seen[way] = max(seen[way], abs(speed) / rated.speeds[way])


def stepped(engine: Engine, mechanism: Mechanism | None) -> Drive:
    """Its step; with a mechanism, PhysX is told its limits each way before."""
    limits = EachWay.of(mechanism, engine.dofs) if mechanism is not None and isinstance(engine, PhysX) else None

    def step(targets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        engine.tell(targets)
        if limits is not None:
            assert isinstance(engine, PhysX)
            engine.limit(limits)
        engine.step()
        return engine.strokes(), engine.speeds()

    return step


def by_levers(
    mechanism: Mechanism, drive: Drive, names: list[str], rated: list[Rated], hz: float, *, implicit: bool
) -> dict[str, Any]:
    """What the same come to with levers pushed whole, to one end and to the other: each alone, and all."""
    oil = Hydraulics(mechanism, implicit=implicit)
    circuits = {name: circuit for name, circuit in oil.circuits.items() if circuit.slide in names}
    worst, power, taken = {name: [0.0, 0.0] for name in names}, 0.0, 0.0
    lately = deque([0.0] * round(FLYWHEEL * hz), maxlen=round(FLYWHEEL * hz))
    at, forces = np.zeros(len(names)), np.zeros(len(names))
    for pushed in [[name] for name in circuits] + [list(circuits)]:
        # The first way begins in mid-stroke; the third is the same from the other end.
        for lever in (1.0, -1.0, 1.0):
            for _ in range(round(LONGEST * hz)):
                known = [dict(zip(names, map(float, each), strict=True)) for each in (at, forces)]
                told = oil.step(dict.fromkeys(pushed, lever), known[0], 1.0 / hz, forces=known[1])
                targets = np.array([told.get(name, 0.0) for name in names])
                before = at
                at, speeds = drive(targets)
                pulled = at if implicit else before
                forces = np.array([given(*each) for each in zip(rated, targets, pulled, speeds, strict=True)])
                lately.append(float(np.maximum(forces * speeds, 0.0).sum()))
                power, taken = max(power, lately[-1]), max(taken, float(np.mean(lately)))
                for number in (names.index(circuits[name].slide) for name in pushed):
                    faster(worst[names[number]], float(speeds[number]), rated[number])
    return {"speeds": worst, "power": power, "taken": taken}


def given(rated: Rated, target: float, at: float, speed: float) -> float:
    """The force (N) of a position drive, its speed that at a step's end: both engines solve for that. Engines' own
    figures are none: Newton's is before that, and PhysX's what goes through the joint."""
    back, forth = rated.forces
    return max(-back, min(forth, rated.stiffness * (target - at) - rated.damping * speed))


if __name__ == "__main__":
    main()
