"""A crane's load chart beside the machine: at what load it tips at every radius and boom length, by statics, and the
tests that haul the chart's loads in in an engine. SI."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron import usd
from yellowiron.kinematics import attached
from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.kinematics.measuring.quantities import Unmeasurable
from yellowiron.model.errors import YellowironError
from yellowiron.model.machine_tests import MachineTest
from yellowiron.model.mechanism import GRAVITY, Mechanism
from yellowiron.simulation.machine_tests.statics import place, tipping_force
from yellowiron.simulation.payload import rated_payload

FOOT, HEAD, SLEW = "boom_foot", "boom_head", "slew"
"""The sites that a boom's length is between, and the actuator that turns what it is on."""


SAME_BOOM = 0.01
"""Share by which a boom that does not telescope may differ from a chart's: makers round its length."""


@dataclass(frozen=True)
class ChartLoad:
    """What a chart allows: a mass (kg), hook and slings in it, at a boom's length and a radius, metres."""

    boom_length: float
    radius: float
    load: float


_AT_HEAD = 0.01
"""Metres from the head's site to a ball that is there."""
_DIRECTIONS = 24
"""In how many directions the weakest is looked for. A crane tips first over the middle of one of its sides; 15° from
there it bears 4 to 9 % more."""


@dataclass(frozen=True)
class ChartFigure:
    """A load of the chart and the mass (kg) under the boom's head, hook in it, at which the machine tips by statics,
    `slewed` radians to the left of how it is drawn, or `reason`, why there is none."""

    row: ChartLoad
    tips_at: float | None
    reason: str = ""
    slewed: float = 0.0


def read_load_chart(path: str | Path) -> tuple[ChartLoad, ...]:
    """The loads of a CSV file: in its first row the boom's lengths in metres behind one cell of any words, below them
    the radius in metres and the loads in kilograms; a cell without a load is empty. `YellowironError` for anything
    else."""
    try:
        rows = [row for row in csv.reader(Path(path).read_text(encoding="utf-8").splitlines()) if any(row)]
        lengths = [float(cell) for cell in rows[0][1:]]
        found = [
            ChartLoad(length, float(row[0]), float(cell))
            for row in rows[1:]
            for length, cell in zip(lengths, row[1:], strict=True)
            if cell.strip()
        ]
    except (OSError, UnicodeDecodeError, ValueError, IndexError) as error:
        hint = "First row: a word, then boom lengths in m; each further row: radius in m, then loads in kg."
        raise YellowironError(f"The load chart cannot be read: {error}", where=str(path), hint=hint) from error
    return tuple(found)


def chart_stability(
    usd_path: str | Path, chart: Iterable[ChartLoad], *, slewed: float | None = 0.0
) -> tuple[ChartFigure, ...]:
    """Where the machine in a file tips beside its chart, standing as it is drawn, `slewed` radians to the left of that:
    drawn facing ahead, over its front, at ±π/2 over its sides; None: in its weakest direction, which bounds a chart
    that has one load for all of them. `YellowironError` for a machine without a boom that slews and luffs."""
    mechanism = attached(usd.read_mechanism(usd_path))
    return tuple(_stability(mechanism, row, slewed) for row in chart)


def chart_tipping(
    usd_path: str | Path, chart: Iterable[ChartLoad], *, slewed: float | None = 0.0
) -> tuple[MachineTest, ...]:
    """For `run_tests`: at each row of the chart a load grows under the boom's head until the machine tips, on the
    ground, `slewed` radians to the left of how it is drawn (None: in the direction that is the weakest by statics).
    What tips it does not have the hook in it. Errors as of `chart_stability`."""
    mechanism = attached(usd.read_mechanism(usd_path))
    rows = [(row, _stability(mechanism, row, None).slewed if slewed is None else slewed) for row in chart]
    return tuple(
        MachineTest(
            f"Tipping at {row.radius:g} m, boom {row.boom_length:g} m, {math.degrees(turned):g}°", "tipping",
            steps=_steps(mechanism, row, turned), site=HEAD,
        )
        for row, turned in rows
    )  # fmt: skip


def chart_tests(usd_path: str | Path, chart: Iterable[ChartLoad]) -> tuple[MachineTest, ...]:
    """For `run_tests`: each load of the chart is hauled in by the winch at its radius, on the ground.
    `YellowironError` for a machine whose rated load is not known, or that is no crane."""
    mechanism = attached(usd.read_mechanism(usd_path))
    rated = rated_payload(mechanism).mass
    if rated <= 0.0:
        raise YellowironError("The machine's rated load is not known", where=mechanism.name, hint="Give it with --set.")
    hook = _hanging(mechanism)
    return tuple(
        MachineTest(
            f"{row.load:g} kg at {row.radius:g} m, boom {row.boom_length:g} m", "lift",
            steps=(*_steps(mechanism, row), {"set": {"hoist": "min"}}), actuator="hoist",
            payload=(row.load - hook) / rated,
        )
        for row in chart
    )  # fmt: skip


def _stability(mechanism: Mechanism, row: ChartLoad, slewed: float | None) -> ChartFigure:
    if slewed is None:
        turns = (2.0 * math.pi * number / _DIRECTIONS for number in range(_DIRECTIONS))
        found = [_stability(mechanism, row, math.remainder(turn, 2.0 * math.pi)) for turn in turns]
        return min(found, key=lambda figure: math.inf if figure.tips_at is None else figure.tips_at)
    bench = Bench(mechanism)
    site = next(s for s in mechanism.sites if s.name == HEAD)
    if why := _other_boom(bench, row):
        return ChartFigure(row, None, why, slewed)
    try:
        state = bench.pose(_steps(mechanism, row, slewed))
        head = place(bench.chain, state, site)
        force = tipping_force(mechanism, bench.chain, state, head, np.array([0.0, 0.0, -1.0]))
    except Unmeasurable as why:
        return ChartFigure(row, None, str(why), slewed)
    return ChartFigure(row, force / GRAVITY + _hanging(mechanism), slewed=slewed)


def _slewing(mechanism: Mechanism) -> str | None:
    return next((a.joints[0].joint for a in mechanism.actuators if a.name == SLEW), None)


def _steps(mechanism: Mechanism, row: ChartLoad, slewed: float = 0.0) -> tuple[Mapping[str, Any], ...]:
    """The pose at a boom's length and a radius, slewed so far to the left, as a measurement's steps."""
    joint = _slewing(mechanism)
    actuators, sites = {a.name for a in mechanism.actuators}, {s.name for s in mechanism.sites}
    if joint is None or not {"luffing", "hoist"} <= actuators or not {FOOT, HEAD} <= sites:
        raise YellowironError(
            "A load chart is for a crane: its boom slews and luffs, and a hook hangs on it",
            where=mechanism.name,
            hint="Build it with a crane's type (`yellowiron templates list`).",
        )
    length = {"kind": "distance", "sites": [FOOT, HEAD]}
    radius = {"kind": "radius", "joint": joint, "site": HEAD}
    luffed = {"solve": [{"actuator": "luffing", "quantity": radius, "value": row.radius}]}
    turned: tuple[Mapping[str, Any], ...] = ({"set": {SLEW: f"{slewed!r} rad"}},) if slewed else ()
    if "telescope" not in actuators:
        return (luffed, *turned)
    return ({"solve": [{"actuator": "telescope", "quantity": length, "value": row.boom_length}]}, luffed, *turned)


def _other_boom(bench: Bench, row: ChartLoad) -> str:
    """Why a row is not this machine's: its boom is as long as it is drawn, and the row's is not; else nothing."""
    if any(a.name == "telescope" for a in bench.mechanism.actuators):
        return ""
    foot, head = (
        place(bench.chain, bench.pose(()), next(s for s in bench.mechanism.sites if s.name == name))[:3]
        for name in (FOOT, HEAD)
    )
    drawn = float(np.linalg.norm(np.asarray(head) - np.asarray(foot)))
    if abs(drawn - row.boom_length) <= SAME_BOOM * drawn:
        return ""
    return f"its boom is {drawn:.2f} m long, not {row.boom_length:g} m"


def _hanging(mechanism: Mechanism) -> float:
    """Mass of what hangs on the boom's head (not on a jib's): a chart's loads have it in them."""
    head = next(site.position for site in mechanism.sites if site.name == HEAD)
    below = {
        j.body1 for j in mechanism.joints if j.free and j.type == "spherical" and math.dist(j.anchor, head) < _AT_HEAD
    }
    for joint in mechanism.joints:
        below |= {joint.body1} if joint.body0 in below else set()
    return sum(b.mass for b in mechanism.bodies if b.name in below)
