"""The page's simulation figures: a row a figure, a column an engine, each against its bar."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from yellowiron.report.words import shown, signed

DISTANCE_BAR, RADIUS_BAR = 3.0, 5.0
"""Percent, as finding SIM009 has them."""
NAMES = {"mujoco": "MuJoCo", "newton": "Newton", "physx": "PhysX"}
"""How the engines' makers write them."""

Run = Mapping[str, Any]


def engine_name(engine: str) -> str:
    """`mujoco` → `MuJoCo`."""
    return NAMES.get(engine, engine)


def simulation_tables(simulation: Mapping[str, Run]) -> dict[str, Any]:
    """Everything the page says of the runs, by engine in the document's order."""
    runs = list(simulation.values())
    return {
        "engines": [_engine(name, run) for name, run in simulation.items()],
        "strokes": _rows(_STROKES, runs),
        "driving": _rows(_DRIVING, [run.get("driving") or {} for run in runs]),
        "driving_reason": next((run["driving_reason"] for run in runs if run.get("driving_reason")), ""),
        "tests": _tests(runs),
        "inputs": _inputs(runs),
    }


def in_a_sentence(simulation: Mapping[str, Run]) -> str:
    """What the runs say, for the top of the page; empty where there were none."""
    if not simulation:
        return ""
    names = [f"{engine_name(name)} {run['version']}" for name, run in simulation.items()]
    worst = max(run["pin_error_mm"] for run in simulation.values())
    found = sum(f.get("severity") != "info" for run in simulation.values() for f in run["findings"])
    kept = "every bar held" if not found else f"{found} {'finding' if found == 1 else 'findings'}"
    listed = " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
    return f"Driven in {listed}: worst pin {worst:.3f} mm from its place, {kept}."


def _cell(text: str, note: str = "", *, held: bool | None = None) -> dict[str, Any]:
    return {"text": text, "note": note, "mark": {True: "ok", False: "error", None: ""}[held]}


_NOTHING = _cell("–")


def _engine(name: str, run: Run) -> dict[str, str]:
    load = f"{run['payload_kg']:.0f} kg" if run["payload_kg"] else "empty"
    base = "held in the air" if run["base"] == "fixed" else "on the ground"
    return {
        "name": engine_name(name),
        "version": run["version"],
        "how": f"{1e3 * run['dt_s']:.3g} ms steps, {load}, {base}",
    }


def _rows(figures: Sequence[tuple[str, Callable[[Run], dict[str, Any] | None]]], runs: Sequence[Run]) -> list[Any]:
    """The figures that at least one engine has."""
    made = []
    for what, figure in figures:
        cells = [figure(run) if run else None for run in runs]
        if any(cells):
            made.append({"what": what, "cells": [cell or _NOTHING for cell in cells]})
    return made


def _against(key: str, bar_key: str, digits: int, unit: str) -> Callable[[Run], dict[str, Any] | None]:
    def figure(run: Run) -> dict[str, Any] | None:
        value, bar = run.get(key), run.get(bar_key)
        if value is None:
            return None
        note = f"at most {bar:g}{unit}" if bar is not None else ""
        return _cell(f"{value:.{digits}f}{unit}", note, held=None if bar is None else value <= bar)

    return figure


def _branches(run: Run) -> dict[str, Any]:
    flipped = [branch["cut"] for branch in run["branches"] if not branch["kept"]]
    return _cell("flipped" if flipped else "kept", ", ".join(flipped) or "at every step", held=not flipped)


def _ends(run: Run) -> dict[str, Any] | None:
    slides = [a for a in run["actuators"] if a["kind"] == "position"]
    if not slides:
        return None
    worst = max(slides, key=lambda a: a["final_error_percent"])
    value = worst["final_error_percent"]
    return _cell(f"{value:.2f} % of stroke", "at most 1 %", held=value <= 1.0)


def _whole(run: Run) -> dict[str, Any]:
    seconds = run["steps"] * run["dt_s"]
    return _cell("to the end" if run["completed"] else "broke down", f"{seconds:.0f} s, {run['steps']} steps, all "
                 "compared", held=bool(run["completed"]))  # fmt: skip


_STROKES = (
    ("Ran", _whole),
    ("Worst pin, from where the linkage has it", _against("pin_error_mm", "pin_bar_mm", 3, " mm")),
    ("Worst angle of a body", _against("angle_error_deg", "angle_bar_deg", 4, "°")),
    ("Branch of every loop", _branches),
    ("Where cylinders came to rest", _ends),
)


def _distance(key: str) -> Callable[[Run], dict[str, Any] | None]:
    def figure(run: Run) -> dict[str, Any] | None:
        if run.get(f"{key}_m") is None:
            return None
        error = run[f"{key}_error_percent"]
        note = f"of {run['distance_m']:g} m: {signed(error, 2, ' %')}, within {DISTANCE_BAR:g} %"
        return _cell(f"{run[f'{key}_m']:.3f} m", note, held=abs(error) <= DISTANCE_BAR)

    return figure


def _radius(run: Run) -> dict[str, Any] | None:
    if run.get("turning_radius_m") is None:
        return None
    error = run["radius_error_percent"]
    at = f"at {run['lock_deg']:.1f}°"
    note = f"geometry {run['geometry_radius_m']:.2f} m {at}" if run["geometry_radius_m"] else f"{at}; an axle drags"
    held = None if error is None else abs(error) <= RADIUS_BAR
    if error is not None:
        note += f": {signed(error, 1, ' %')}, within {RADIUS_BAR:g} %"
    return _cell(f"{run['turning_radius_m']:.2f} m", note, held=held)


def _axle(run: Run) -> dict[str, Any] | None:
    if run.get("axle_angle_deg") is None:
        return None
    note = f"block and tread make {run['axle_geometry_deg']:.2f}°" if run.get("axle_geometry_deg") is not None else ""
    return _cell(f"{run['axle_angle_deg']:.2f}°", note)


def _crab(run: Run) -> dict[str, Any] | None:
    if run.get("crab_deg") is None:
        return None
    return _cell(f"{run['crab_deg']:.1f}°", f"wheels point {run['crab_geometry_deg']:.1f}°")


def _spin(run: Run) -> dict[str, Any] | None:
    if run.get("spin_deg") is None:
        return None
    geometry = run.get("spin_geometry_deg")
    return _cell(f"{run['spin_deg']:.1f}°", f"geometry {geometry:.1f}°" if geometry is not None else "")


def _swung(run: Run) -> dict[str, Any] | None:
    if run.get("swing_deg") is None:
        return None
    geometry = run.get("swing_geometry_deg")
    return _cell(f"{run['swing_deg']:.1f}°", f"told {geometry:.1f}°" if geometry is not None else "")


def _wheels(run: Run) -> dict[str, Any] | None:
    return None if run.get("highest_wheel_mm") is None else _cell(f"{run['highest_wheel_mm']:.0f} mm")


_DRIVING = (
    ("Driven forward", _distance("forward")),
    ("Driven back", _distance("backward")),
    ("Turning radius at full lock", _radius),
    ("Went crabwise, to the left", _crab),
    ("Turned on the spot", _spin),
    ("Swung", _swung),
    ("Free axle, one wheel on a block", _axle),
    ("Most that a wheel rose from what it stood on", _wheels),
)


def _tests(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """A row a test: what the sheet and statics say, what each engine did."""
    names = dict.fromkeys(test["name"] for run in runs for test in run.get("tests") or ())
    rows = []
    for name in names:
        found = [next((t for t in run.get("tests") or () if t["name"] == name), None) for run in runs]
        first = next(test for test in found if test is not None)
        bar = first.get("bar_percent")
        # Where engines differ in what they met, each says it in its own cell.
        reasons = {test.get("reason", "") for test in found if test is not None}
        rows.append(
            {
                "name": name,
                "definition": first.get("definition", ""),
                "rig": first.get("rig", ""),
                "role": first.get("role", ""),
                "sheet": _expected(first) if first["kind"] == "lift" else _amount(first["spec"], first),
                "statics": _amount(first.get("statics_value"), first),
                "bar": f"within {bar:g} %" if bar is not None and first["kind"] != "lift" else "",
                "cells": [_test(test, alone=len(reasons) > 1) if test is not None else _NOTHING for test in found],
                "reason": reasons.pop() if len(reasons) == 1 else "",
            }
        )
    return rows


def _test(test: Mapping[str, Any], *, alone: bool) -> dict[str, Any]:
    error = test.get("error_percent")
    notes = [signed(error, 1, " %")] if error is not None else []
    if alone and test.get("reason"):
        notes.append(test["reason"])
    return _cell(_amount(test.get("engine_value"), test), ", ".join(notes), held=test.get("passed"))


def _expected(test: Mapping[str, Any]) -> str:
    expected = test.get("expected")
    return "–" if expected is None else ("must arrive" if expected else "must not arrive")


def _amount(value: float | None, test: Mapping[str, Any]) -> str:
    if value is None:
        return "–"
    if test["unit"] == "1":
        return f"{100.0 * value:.0f} % of the way"
    return shown(value, test["unit"], digits=4)


def _inputs(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """What the tests' figures hang on and no sheet publishes, once each."""
    found: dict[str, dict[str, Any]] = {}
    for run in runs:
        for test in run.get("tests") or ():
            for entry in test.get("inputs") or ():
                if not entry["published"]:
                    found.setdefault(entry["name"], {**entry, "text": shown(entry["value"], entry["unit"])})
    return list(found.values())
