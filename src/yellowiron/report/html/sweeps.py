"""The page's sweeps: what an engine did with each actuator, as a strip of pictures and as curves over time."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.poses import Snapshot, Sweep
from yellowiron.report.html.drawing import Picture
from yellowiron.report.html.pictures import look_at, outline
from yellowiron.report.html.plots import Chart, Curve, plot
from yellowiron.report.html.simulation import engine_name
from yellowiron.report.words import sentence

Sweeps = Mapping[str, Sequence[Sweep]]
"""Engine → its sweeps, in order."""
WIDTH, HEIGHT = 336, 252
"""Pixels of a strip's picture."""
SEEN = 0.01
"""Share of the machine's size by which a body's middle must move for pictures to show anything."""


def sweep_pictures(sweeps: Sweeps, mechanism: Mechanism) -> dict[str, Picture]:
    """The pictures of the strips, by the names under which `sweep_entries` looks for them: the first engine's, of what
    moves."""
    pictures: dict[str, Picture] = {}
    for number, sweep in enumerate(next(iter(sweeps.values()), ())):
        if _moves(sweep.snapshots, mechanism):
            # One camera for all of a strip: what moves is the machine.
            points = np.concatenate([outline(mechanism, snapshot.poses) for snapshot in sweep.snapshots])
            camera = look_at(points, azimuth=-1.1, elevation=0.2, width=WIDTH, height=HEIGHT)
            pictures |= {_name(number, k): Picture(camera, s.poses) for k, s in enumerate(sweep.snapshots)}
    return pictures


def _name(sweep: int, snapshot: int) -> str:
    return f"sweep {sweep} {snapshot}"


def sweep_entries(sweeps: Sweeps, document: Mapping[str, Any], pictures: Mapping[str, str]) -> list[dict[str, Any]]:
    """One entry a sweep: the pictures are the first engine's, the curves every engine's that made the same sweep."""
    if not sweeps:
        return []
    engine, first = next(iter(sweeps.items()))
    runs = document["simulation"]
    return [
        {
            "name": sentence(sweep.name) if sweep.name != "together" else "All together",
            "engine": engine,
            "frames": _frames(number, sweep, pictures),
            "position": _positions(sweep, document),
            "errors": _errors([(e, s) for e, each in sweeps.items() for s in each if s.name == sweep.name], runs),
        }
        for number, sweep in enumerate(first)
    ]


def _frames(number: int, sweep: Sweep, pictures: Mapping[str, str]) -> list[dict[str, Any]]:
    return [
        {
            "picture": pictures[_name(number, k)],
            "share": "" if snapshot.share is None else f"{100.0 * snapshot.share:.0f} %",
            "time": f"{snapshot.time:.1f} s",
        }
        for k, snapshot in enumerate(sweep.snapshots)
        if _name(number, k) in pictures
    ]


def _moves(snapshots: Sequence[Snapshot], mechanism: Mechanism) -> bool:
    """Whether anything leaves its place: a wheel that turns on the spot looks the same in every picture."""
    hulls = {b.name: np.asarray(b.hull, dtype=np.float64) for b in mechanism.bodies if len(b.hull)}
    if not snapshots or not hulls:
        return False
    size = float(np.linalg.norm(np.ptp(np.concatenate(list(hulls.values())), axis=0)))
    for name, hull in hulls.items():
        middle = np.append(0.5 * (hull.min(axis=0) + hull.max(axis=0)), 1.0)
        places = np.array([(snapshot.poses[name] @ middle)[:3] for snapshot in snapshots if name in snapshot.poses])
        if len(places) and float(np.linalg.norm(np.ptp(places, axis=0))) > SEEN * size:
            return True
    return False


def _positions(sweep: Sweep, document: Mapping[str, Any]) -> dict[str, Any]:
    """Where each driven joint was, against where it was told to be."""
    names = {j["joint"]: a["name"] for a in document["actuators"] for j in a["joints"]}
    traces = [trace for trace in sweep.traces if trace.kind == "position"] or list(sweep.traces)
    # The joints of a motor turn alike: one curve says it.
    first = {names.get(trace.joint, trace.joint): trace for trace in reversed(traces)}
    curves, legend = [], []
    for number, (name, trace) in enumerate(reversed(first.items())):
        scale = 100.0 if trace.kind == "position" else 1.0
        curves.append(Curve(sweep.times, scale * trace.wanted, f"{name}, wanted", number, wanted=True))
        curves.append(Curve(sweep.times, scale * trace.measured, name, number))
        legend.append((number, sentence(name)))
    moments = [snapshot.time for snapshot in sweep.snapshots]
    if traces and traces[0].kind == "position":
        chart = Chart("Stroke: wanted (dashed) and measured", " %", 0.0, 100.0, moments=moments)
    else:
        most = max((float(np.abs(curve.values).max(initial=0.0)) for curve in curves), default=0.0) or 1.0
        chart = Chart("Speed, rad/s: wanted (dashed) and measured", "", -most, most)
    return {"svg": plot(curves, chart), "legend": legend if len(legend) > 1 else []}


def _errors(runs: Sequence[tuple[str, Sweep]], documents: Mapping[str, Any]) -> dict[str, Any]:
    """Every engine's worst pin over time: against its own bar where all have one, else in millimetres."""
    bars = [documents.get(engine, {}).get("pin_bar_mm") for engine, _ in runs]
    curves, legend = [], []
    relative = all(bars) and len(set(bars)) > 1
    for number, ((engine, sweep), bar) in enumerate(zip(runs, bars, strict=True)):
        values: Floats = 1e3 * sweep.pin_error
        legend.append(
            (number, f"{engine_name(engine)}: {values.max(initial=0.0):.3f} mm" + (f", bar {bar:g} mm" if bar else ""))
        )
        curves.append(Curve(sweep.times, 100.0 * values / bar if relative and bar else values, engine, number))
    worst = max((float(curve.values.max(initial=0.0)) for curve in curves), default=0.0)
    if relative:
        high = max(110.0, 1.05 * worst)
        shares = (0.0, 50.0, 100.0) if high < 200.0 else ()
        chart = Chart("Worst pin, share of the engine's bar", " %", 0.0, high, 100.0, "bar", shares)
    else:
        bar = bars[0] if bars else None
        ticks = (0.0, 0.5 * bar, bar) if bar and worst <= bar else (0.0, _round_up(max(worst, 1e-6)))
        label = f"bar {bar:g} mm" if bar else ""
        chart = Chart("Worst pin, mm", "", 0.0, 1.12 * ticks[-1], bar, label, ticks)
    return {"svg": plot(curves, chart), "legend": legend}


def _round_up(value: float) -> float:
    """To two digits."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return round(math.ceil(value / step - 1e-9) * step, 12)
