"""The run: load, command, step, compare."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from yellowiron.model.errors import YellowironError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.poses import Sweep
from yellowiron.simulation.commands import Motion, Phase, motions, phases
from yellowiron.simulation.driving.rolling import rolling
from yellowiron.simulation.driving.wheel import GroundWheel, driven_wheels
from yellowiron.simulation.engine import Base, Engine, Readings, Settings, Setup
from yellowiron.simulation.ground import standing_bodies, usual_base
from yellowiron.simulation.loads import carried, paces
from yellowiron.simulation.payload import with_payload
from yellowiron.simulation.registry import find_engine, import_engine, load_engine, usual_timestep
from yellowiron.simulation.strokes.comparison import Agreement, Comparison, Worst
from yellowiron.simulation.strokes.held import held_machine
from yellowiron.simulation.strokes.recording import record
from yellowiron.simulation.strokes.result import ActuatorResult, BranchResult, PhaseResult, SimulationResult
from yellowiron.simulation.strokes.standing import falls_over
from yellowiron.usd import read_mechanism

FINAL_BAR = 0.01
"""A cylinder ends within this share of its stroke from its target; a motor within ten times that of its speed."""
_SOLVED = 0.016
"""Seconds from one solved pose of the kinematics to the next; those of the steps between are led over."""
_CHUNK = 50
"""Steps that are read at once: enough to make it quick, few enough for their states to stay in the processor's cache
(MuJoCo, fixed base: 12.0 µs a step, with 250 at once 13.0)."""


def check_timestep(seconds: float) -> None:
    """`YellowironError` for a time step that is none, or longer than 0.1 s."""
    if not 0.0 < seconds <= 0.1:
        raise YellowironError(
            "The time step must be above 0 and at most 0.1 s",
            where=f"--dt {seconds:g}",
            hint="Leave it out: engines have their own.",
        )


def simulate(
    usd_path: str | Path,
    *,
    engine: str,
    base: Base | None = None,
    payload_kg: float = 0.0,
    payload_source: str = "",
    dt: float | None = None,
    settings: Settings = "file",
    actuators: Sequence[str] | None = None,
    progress: Callable[[str], None] = lambda words: None,
) -> SimulationResult:
    """Drives every actuator of a machine alone and all together in an engine, and holds every body's pose at every
    step against the closed-chain kinematics at the strokes the engine measures.

    `base`: `fixed` (in the air) or `floating` (on the ground, on its wheels or tracks), by default `usual_base`; `dt`
    in seconds (default: the engine's); `settings`: what a build writes, or each engine's own defaults; `actuators`:
    only these. Findings SIM001 … SIM005 say what fell short of the engine's bars, SIM011 what was not driven because
    the machine falls over there.
    Raises `YellowironError` for an unknown engine or actuator, an engine that is not installed, and an unusable file.
    """
    entry = find_engine(engine)
    if base not in (None, "fixed", "floating"):
        raise YellowironError(f"There is no base '{base}'", where="--base", hint="A base is fixed or floating.")
    step = usual_timestep(entry, settings) if dt is None else dt
    check_timestep(step)
    base = base or usual_base(read_mechanism(usd_path))
    if not 0.0 <= payload_kg < math.inf:
        raise YellowironError(
            "The payload must be 0 kg or more", where=f"--payload {payload_kg:g}", hint="Write 5000, 5.5 t, or rated."
        )
    import_engine(engine)
    read, changed = held_machine(usd_path, base)
    mechanism = with_payload(read, payload_kg)
    moves = motions(mechanism, actuators)
    if not moves:
        raise YellowironError(
            "The machine has nothing to drive", where=mechanism.name, hint="Name its actuators in the template."
        )
    comparison = Comparison(mechanism, stride=max(1, round(_SOLVED / step)))
    heavier = tuple(b for b, old in zip(mechanism.bodies, read.bodies, strict=True) if b is not old or b in changed)
    progress(f"Loading the machine into {engine}")
    setup = Setup(
        usd_path=Path(usd_path),
        mechanism=mechanism,
        base=base,
        timestep=step,
        measured=comparison.measured,
        heavier=heavier,
        standing=standing_bodies(mechanism),
        settings=settings,
    )
    loaded = load_engine(engine, setup)
    run = _Run(loaded, comparison, moves, step, _wheels(mechanism) if base == "floating" else ())
    commands = phases(moves, step, on_ground=base == "floating", paces=paces(comparison.chain, moves))
    try:
        for phase in commands:
            fallen = falls_over(mechanism, comparison.chain, phase) if base == "floating" else None
            if fallen is not None:
                run.left_out.append(fallen)
                continue
            progress(f"Simulating in {engine}: {phase.name}")
            if not run.phase(phase):
                break
        version = loaded.version
    finally:
        loaded.close()
    return run.result(
        engine, version, base, payload_kg, payload_source, entry.pin_bars.get(base, math.inf), entry.angle_bar
    )


def play(engine: Engine, joints: Sequence[str], rows: Floats) -> Readings:
    """A step for each row of the joints' targets: what is read after every step."""
    states = []
    for _ in engine.targets(joints, rows):
        engine.step()
        states.append(engine.state())
    return engine.read(states)


def _wheels(mechanism: Mechanism) -> tuple[GroundWheel, ...]:
    with contextlib.suppress(YellowironError):  # tracks, feet
        return driven_wheels(mechanism)
    return ()


@dataclass
class _DriveRecord:
    """What one driven joint did."""

    final_error: float = 0.0
    sag: float = 0.0
    lag: float = 0.0
    fastest: float = 0.0
    low: float = math.inf
    high: float = -math.inf


@dataclass
class _Run:
    engine: Engine
    comparison: Comparison
    moves: tuple[Motion, ...]
    timestep: float
    wheels: tuple[GroundWheel, ...] = ()
    seen: dict[str, _DriveRecord] = field(default_factory=dict)
    done: list[tuple[Phase, Agreement]] = field(default_factory=list)
    sweeps: list[Sweep] = field(default_factory=list)
    left_out: list[Finding] = field(default_factory=list)
    steps: int = 0
    seconds: float = 0.0

    def phase(self, phase: Phase) -> bool:
        """Runs one phase; false where the simulation broke down."""
        count, bodies = phase.steps, len(self.comparison.chain.mechanism.bodies)
        measured = np.empty((count, len(self.comparison.measured)))
        rotations, origins = np.empty((count, bodies, 3, 3)), np.empty((count, bodies, 3))
        told = carried(self.comparison.chain, self.moves, phase.targets, self.timestep)
        chain = self.comparison.chain
        for joint, speeds in rolling(chain, self.wheels, self.moves, phase.targets, self.timestep).items():
            told[joint] = told.get(joint, 0.0) + speeds
        joints, rows = tuple(told), np.column_stack(list(told.values()))
        for start in range(0, count, _CHUNK):
            chunk = slice(start, start + _CHUNK)
            begun = time.perf_counter()
            measured[chunk], rotations[chunk], origins[chunk] = play(self.engine, joints, rows[chunk])
            self.seconds += time.perf_counter() - begun
        self.steps += count
        self._track(phase, measured, told)
        agreement = self.comparison.compare(measured, rotations, origins)
        self.done.append((phase, agreement))
        if phase.holds:
            columns = [self.comparison.measured.index(motion.joint) for motion in self.moves]
            errors = (agreement.pins, agreement.angles)
            mechanism = self.comparison.chain.mechanism
            self.sweeps.append(
                record(phase, self.moves, mechanism, self.timestep, measured[:, columns], rotations, origins, errors)
            )
        return agreement.followed

    def _track(self, phase: Phase, measured: Floats, told: Mapping[str, Floats]) -> None:
        if phase.name == "settle":
            return
        for motion in self.moves:
            if motion.joint not in phase.targets or not len(phase.holds):
                continue
            values, targets = measured[:, self.comparison.measured.index(motion.joint)], phase.targets[motion.joint]
            if not np.isfinite(values).all():
                continue
            seen = self.seen.setdefault(motion.joint, _DriveRecord())
            change = np.abs(np.diff(targets)) / self.timestep if motion.position else np.abs(targets)
            seen.fastest = max(seen.fastest, float(change.max(initial=0.0)))
            if motion.position:
                seen.lag = max(seen.lag, float(np.abs(values - targets).max()))
                seen.final_error = max(seen.final_error, *(abs(float(values[h] - targets[h])) for h in phase.holds))
                seen.sag = max(seen.sag, float(np.abs(told[motion.joint] - targets).max()))
                seen.low, seen.high = min(seen.low, float(values.min())), max(seen.high, float(values.max()))
            else:
                error = np.abs(np.diff(values, prepend=values[:1]) / self.timestep - targets)
                seen.lag = max(seen.lag, float(error[1:].max()))
                if phase.name == motion.actuator:  # together, steering drags wheels of equal speed over the ground
                    full = np.abs(targets) >= np.abs(targets).max()
                    seen.final_error = max(seen.final_error, *error[full & ~np.roll(full, -1)].tolist())

    def result(
        self,
        engine: str,
        version: str,
        base: Base,
        payload: float,
        payload_source: str,
        pin_bar: float,
        angle_bar: float,
    ) -> SimulationResult:
        """Everything put together, with its findings."""
        pin, gap, angle = (self._worst(kind) for kind in ("pin", "gap", "angle"))
        cuts = dict.fromkeys(cut for _, agreement in self.done for cut in agreement.sines)
        made = SimulationResult(
            engine=engine,
            version=version,
            dt=self.timestep,
            base=base,
            payload=payload,
            payload_source=payload_source or ("as given" if payload else "none"),
            steps=self.steps,
            steps_per_second=self.steps / self.seconds if self.seconds else 0.0,
            pin_error=pin[0].value,
            pin_error_at=self._place(*pin),
            gap=gap[0].value,
            angle_error=angle[0].value,
            angle_error_at=self._place(*angle),
            completed=all(agreement.followed for _, agreement in self.done),
            branches=tuple(
                BranchResult(cut, min(a.sines[cut] for _, a in self.done if cut in a.sines)) for cut in cuts
            ),
            actuators=tuple(
                _actuator(motion, self.seen[motion.joint], base, self._unit(motion))
                for motion in self.moves
                if motion.joint in self.seen
            ),
            phases=tuple(PhaseResult(p.name, p.steps, a.pin.value, a.angle.value) for p, a in self.done),
            sweeps=tuple(self.sweeps),
            pin_bar=pin_bar,
            angle_bar=angle_bar,
        )
        return replace(made, findings=(*_findings(made), *self.left_out))

    def _unit(self, motion: Motion) -> str:
        return "m" if self.comparison.chain.mechanism.joint(motion.joint).type == "prismatic" else "rad"

    def _worst(self, kind: str) -> tuple[Worst, Phase]:
        return max(((getattr(a, kind), p) for p, a in self.done), key=lambda pair: pair[0].value)

    def _place(self, worst: Worst, phase: Phase) -> str:
        return f"{worst.where}, {phase.name}, {worst.step * self.timestep:.2f} s" if worst.where else ""


def _actuator(motion: Motion, seen: _DriveRecord, base: Base, unit: str) -> ActuatorResult:
    speed = motion.top_speed(on_ground=base == "floating")
    return ActuatorResult(
        actuator=motion.actuator,
        joint=motion.joint,
        kind="position" if motion.position else "velocity",
        stroke=motion.stroke,
        speed=speed,
        fastest=seen.fastest,
        low=motion.low,
        high=motion.high,
        reached_low=seen.low if motion.position else 0.0,
        reached_high=seen.high if motion.position else 0.0,
        final_error=seen.final_error,
        sag=seen.sag,
        lag=seen.lag,
        unit=unit,
    )


def _findings(result: SimulationResult) -> Iterator[Finding]:
    if not result.completed:
        yield Finding(
            "SIM001",
            "error",
            result.phases[-1].name,
            "the simulation broke down: the linkage left every pose that its measured strokes allow",
            "Try a smaller time step, and check gains, masses and limits.",
        )
    if result.pin_error > result.pin_bar:
        message = f"a pin stood {1e3 * result.pin_error:.3g} mm from its place, more than {1e3 * result.pin_bar:g} mm"
        yield Finding("SIM002", "warning", result.pin_error_at, message, "Try a smaller time step.")
    if result.angle_error > result.angle_bar:
        message = (
            f"a body was turned {math.degrees(result.angle_error):.3g}° from its pose, more than "
            f"{math.degrees(result.angle_bar):.3g}°"
        )
        yield Finding("SIM003", "warning", result.angle_error_at, message, "Try a smaller time step.")
    for branch in result.branches:
        if not branch.kept:
            message = "its loop flipped to its other branch"
            yield Finding("SIM004", "error", branch.cut, message, "Check the limits of its loop's pivots.")
    for each in result.actuators:
        bar = FINAL_BAR if each.kind == "position" else 10.0 * FINAL_BAR
        if each.final_error_percent > 100.0 * bar:
            what = "stroke" if each.kind == "position" else "speed"
            message = f"it ended {each.final_error_percent:.2g} % of its {what} away from its target"
            hint = "Its drive is too weak or too soft for the load: check pressure, bore and gains."
            yield Finding("SIM005", "warning", each.joint, message, hint)
