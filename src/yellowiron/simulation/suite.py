"""All that a machine is put to in one engine, as one document: strokes, driving, the template's tests."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, Literal

from yellowiron import usd
from yellowiron.model.errors import YellowironError
from yellowiron.model.finding import Finding
from yellowiron.model.poses import Snapshot, Sweep
from yellowiron.simulation.driving.result import driving_document, driving_findings
from yellowiron.simulation.driving.wheel import driven_wheels
from yellowiron.simulation.driving.wheeled import drive
from yellowiron.simulation.engine import Base, Settings
from yellowiron.simulation.machine_tests.figures import figure_findings, figures_document
from yellowiron.simulation.machine_tests.hydraulics import run_tests
from yellowiron.simulation.payload import RatedPayload
from yellowiron.simulation.registry import find_engine, import_engine, usual_timestep
from yellowiron.simulation.strokes.result import simulation_document
from yellowiron.simulation.strokes.run import check_timestep, simulate
from yellowiron.support.guard import Wording, beat, run_guarded

PATIENCE = "YELLOWIRON_PATIENCE"
_OF_RATE = ("completed", "pin_error_mm", "pin_error_at", "loop_gap_mm", "branches_kept", "steps_per_second")
"""What a row of the table of rates has of a document."""
_PATIENCE = 300.0
"""Seconds. Not for the whole run: how long that takes hangs on steps, machine and computer."""

Suite = Literal["strokes", "drive", "hydraulics", "all"]


def examine(
    usd_path: str | Path,
    *,
    engine: str,
    test: Suite = "all",
    base: Base | None = None,
    payload: RatedPayload | None = None,
    dt: float | None = None,
    settings: Settings = "file",
    progress: Callable[[str], None] = lambda words: None,
) -> tuple[dict[str, Any], tuple[Sweep, ...]]:
    """What `test` names, as a document (docs: simulate), and what the strokes leave to be looked at.

    In a child process, so that an engine which crashes, or takes no step for `patience` seconds, is a
    `YellowironError`. `base`, `payload` and `settings` are for the strokes; driving is empty, the template's tests say
    their own. Errors as in `simulate`, `drive` and `run_tests`; a machine that has nothing to drive on is no error but
    a reason.
    """
    if dt is not None:
        check_timestep(dt)
    if settings == "engine" and test != "strokes":
        raise YellowironError(
            "The engine's own settings are for the strokes alone",
            where=f"--settings engine --test {test}",
            hint="Leave one of the two out.",
        )
    made: tuple[dict[str, Any], tuple[Sweep, ...]] = _apart(
        "suite:examined", engine, usd_path, engine, test, base, payload, dt, settings, progress=progress
    )
    return made


def at_rates(
    usd_path: str | Path,
    *,
    engine: str,
    rates: Sequence[float],
    settings: Sequence[Settings] = ("file", "engine"),
    base: Base | None = None,
    payload: RatedPayload | None = None,
    progress: Callable[[str], None] = lambda words: None,
) -> dict[str, Any]:
    """The strokes again at every rate (steps a second) with every settings, as a document: how far the pins come apart.

    A run that breaks down, or whose engine crashes, is a row that says so. Errors as in `simulate`.
    """
    for rate in rates:
        check_timestep(1.0 / rate if rate > 0.0 else math.inf)
    import_engine(engine)
    usd.read_mechanism(usd_path)  # what cannot be read is no row
    load = payload or RatedPayload(0.0, "none")
    rows = []
    for setting in settings:
        for rate in rates:
            row: dict[str, Any] = {"settings": setting, "hz": rate, "dt_s": 1.0 / rate}
            progress(f"{rate:g} Hz with the {setting}'s settings")
            try:
                found, _ = examine(
                    usd_path, engine=engine, test="strokes", base=base, payload=load, dt=1.0 / rate, settings=setting
                )
            except YellowironError as error:
                rows.append({**row, **dict.fromkeys(_OF_RATE), "completed": False, "reason": error.message})
                continue
            told = {key: found[key] if _is_finite(found[key]) else None for key in _OF_RATE}
            rows.append({**row, **told, "reason": "" if found["completed"] else "the simulation broke down"})
    return {"engine": engine, "payload_kg": load.mass, "payload_source": load.source, "rates": rows, "findings": []}


def _is_finite(value: Any) -> bool:
    return not isinstance(value, float) or math.isfinite(value)


def watch(
    usd_path: str | Path,
    *,
    engine: str,
    actuators: Sequence[str],
    shares: Sequence[float],
    progress: Callable[[str], None] = lambda words: None,
) -> dict[str, tuple[Snapshot, ...]]:
    """`strokes.watched.watched`, as `examine`: in a child process."""
    made: dict[str, tuple[Snapshot, ...]] = _apart(
        "strokes.watched:watched", engine, usd_path, engine, list(actuators), list(shares), progress=progress
    )
    return made


def _apart(target: str, engine: str, usd_path: str | Path, *args: Any, progress: Callable[[str], None]) -> Any:
    return run_guarded(
        f"yellowiron.simulation.{target}", usd_path, *args,
        where=str(usd_path),
        timeout_s=patience(),
        memory_mb=None,  # engines reserve address space that they never use: PhysX 3.8 GB for 0.4
        wording=Wording(
            f"The engine '{engine}'",
            f"The engine '{engine}' took no step for",
            f"Try another engine or a smaller time step; {PATIENCE} allows more seconds without a step.",
        ),
        progress=progress,
    )  # fmt: skip


def patience() -> float:
    """Seconds that an engine may go without a step, from the environment; `YellowironError` where that is no time."""
    given = os.environ.get(PATIENCE, "")
    try:
        seconds = float(given) if given else _PATIENCE
    except ValueError:
        seconds = 0.0
    if not 0.0 < seconds < math.inf:
        raise YellowironError(f"'{given}' is no number of seconds", where=PATIENCE, hint=f"Default: {_PATIENCE:g}.")
    return seconds


def examined(
    usd_path: str | Path,
    engine: str,
    test: Suite,
    base: Base | None,
    payload: RatedPayload | None,
    dt: float | None,
    settings: Settings = "file",
) -> tuple[dict[str, Any], tuple[Sweep, ...]]:
    """`examine` in this process."""
    progress = beat
    step = usual_timestep(find_engine(engine), settings) if dt is None else dt
    import_engine(engine)
    load = payload or RatedPayload(0.0, "none")
    document: dict[str, Any] = {"engine": engine, "dt_s": step, "settings": settings}
    findings: list[Finding] = []
    sweeps: tuple[Sweep, ...] = ()
    if test in ("strokes", "all"):
        result = simulate(
            usd_path, engine=engine, base=base, payload_kg=load.mass, payload_source=load.source, dt=dt,
            settings=settings, progress=progress,
        )  # fmt: skip
        document |= simulation_document(result)
        findings += result.findings
        sweeps = result.sweeps
    if test in ("drive", "all"):
        driving, more = _driven(usd_path, engine, dt, progress)
        document |= driving
        findings += more
    if test in ("hydraulics", "all"):
        figures = run_tests(usd_path, engine=engine, dt=dt, progress=progress)
        document["tests"] = figures_document(figures)
        findings += figure_findings(figures)
    document["findings"] = [asdict(finding) for finding in findings]
    return document, sweeps


def _driven(
    usd_path: str | Path, engine: str, dt: float | None, progress: Callable[[str], None]
) -> tuple[dict[str, Any], Sequence[Finding]]:
    try:
        driven_wheels(usd.read_mechanism(usd_path))
    except YellowironError as error:
        return {"driving": None, "driving_reason": error.message}, ()
    progress(f"Driving in {engine}")
    result = drive(usd_path, engine=engine, dt=dt)
    return {"driving": driving_document(result)}, tuple(driving_findings(result))
