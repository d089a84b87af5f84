"""What a simulation found, as values and as a JSON document. SI inside; millimetres and degrees in the document, as
the names say."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from yellowiron.model.finding import Finding
from yellowiron.model.poses import Sweep


@dataclass(frozen=True)
class ActuatorResult:
    """One driven joint. `low`, `high`: the ends it was sent to, `reached_low`, `reached_high` how far it came (metres
    or radians; 0 for motors); `speed` its rated one, `fastest` the fastest that it was told to move.

    `final_error`: the worst distance from a target that has come to rest (m, rad; of a motor alone: rad/s); `lag`: the
    worst while moving; `sag`: the most that the weight on the drive's spring takes, by which it is told to go further.
    `unit`: m of slides, rad of pivots.
    """

    actuator: str
    joint: str
    kind: str
    stroke: float
    speed: float
    fastest: float
    low: float
    high: float
    reached_low: float
    reached_high: float
    final_error: float
    sag: float
    lag: float
    unit: str = "m"

    @property
    def final_error_percent(self) -> float:
        """Of the stroke (cylinders) or the commanded speed (motors)."""
        whole = self.stroke or self.speed
        return 100.0 * self.final_error / whole if whole else 0.0


@dataclass(frozen=True)
class BranchResult:
    """A loop by its cut joint: `least_sine` at its triangle of pivots over all steps, positive on the drawn branch."""

    cut: str
    least_sine: float

    @property
    def kept(self) -> bool:
        """Whether the loop never flipped."""
        return self.least_sine > 0.0


@dataclass(frozen=True)
class PhaseResult:
    """One phase: metres and radians."""

    name: str
    steps: int
    pin_error: float
    angle_error: float


@dataclass(frozen=True)
class SimulationResult:
    """A whole run. Seconds, kilograms, metres, radians. `pin_error` is a pin's worst distance from where the
    closed-chain kinematics has it at the measured strokes, `gap` that between a cut pin's two halves, `angle_error` a
    body's worst turn from its pose; `*_at` says where and in which phase. `steps_per_second` counts the time in
    which the engine steps and is read. `sweeps`: a few poses and the errors over time of each phase, for pictures.
    `pin_bar`, `angle_bar`: the engine's bars."""

    engine: str
    version: str
    dt: float
    base: str
    payload: float
    payload_source: str
    steps: int
    steps_per_second: float
    pin_error: float
    pin_error_at: str
    gap: float
    angle_error: float
    angle_error_at: str
    completed: bool
    branches: tuple[BranchResult, ...]
    actuators: tuple[ActuatorResult, ...]
    phases: tuple[PhaseResult, ...]
    findings: tuple[Finding, ...] = ()
    sweeps: tuple[Sweep, ...] = ()
    pin_bar: float = math.inf
    angle_bar: float = math.inf

    @property
    def branches_kept(self) -> bool:
        """Whether no loop flipped to its other branch."""
        return all(branch.kept for branch in self.branches)


def simulation_document(result: SimulationResult) -> dict[str, Any]:
    """The result for `simulate --json` and for `report.json`'s `simulation`. It differs between two runs in
    `steps_per_second` alone."""
    return {
        "engine": result.engine,
        "version": result.version,
        "dt_s": result.dt,
        "base": result.base,
        "payload_kg": result.payload,
        "payload_source": result.payload_source,
        "steps": result.steps,
        "steps_per_second": round(result.steps_per_second),
        "completed": result.completed,
        "pin_error_mm": 1e3 * result.pin_error,
        "pin_bar_mm": _bar(1e3 * result.pin_bar),
        "pin_error_at": result.pin_error_at,
        "loop_gap_mm": 1e3 * result.gap,
        "angle_error_deg": math.degrees(result.angle_error),
        "angle_bar_deg": _bar(math.degrees(result.angle_bar)),
        "angle_error_at": result.angle_error_at,
        "branches_kept": result.branches_kept,
        "branches": [{"cut": b.cut, "least_sine": b.least_sine, "kept": b.kept} for b in result.branches],
        "actuators": [
            {
                "actuator": a.actuator,
                "joint": a.joint,
                "kind": a.kind,
                "unit": a.unit,
                "stroke": a.stroke,
                "speed": a.speed,
                "fastest": a.fastest,
                "low": a.low,
                "high": a.high,
                "reached_low": a.reached_low,
                "reached_high": a.reached_high,
                "final_error": a.final_error,
                "final_error_percent": a.final_error_percent,
                "sag": a.sag,
                "lag": a.lag,
            }
            for a in result.actuators
        ],
        "phases": [
            {
                "name": p.name,
                "steps": p.steps,
                "pin_error_mm": 1e3 * p.pin_error,
                "angle_error_deg": math.degrees(p.angle_error),
            }
            for p in result.phases
        ],
        "findings": [asdict(finding) for finding in result.findings],
    }


def _bar(value: float) -> float | None:
    """A bar without the last digits of its conversion; None where there is none."""
    return round(value, 9) if math.isfinite(value) else None
