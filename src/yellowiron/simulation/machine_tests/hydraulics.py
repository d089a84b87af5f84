"""The tests of a template's `tests.json` in an engine: tipping loads, forces, times, lifts (docs: simulate). SI."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from yellowiron import usd
from yellowiron.kinematics import State, attached, weight
from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.kinematics.measuring.quantities import Unmeasurable
from yellowiron.kinematics.measuring.sheet import specified
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.machine_tests import MachineTest
from yellowiron.model.mechanism import GRAVITY, Drive, Mechanism, Site
from yellowiron.simulation.commands import SHARE, travel
from yellowiron.simulation.loads import carried, paces
from yellowiron.simulation.machine_tests.figures import Figure, beside_sheet
from yellowiron.simulation.machine_tests.rig import Rig, locked
from yellowiron.simulation.machine_tests.statics import (
    actuator_area,
    actuator_force,
    motion,
    place,
    stands,
    tipping_force,
)
from yellowiron.simulation.payload import rated_payload, with_payload
from yellowiron.simulation.registry import find_engine, import_engine

LEAN, OVER = math.radians(0.1), math.radians(1.0)
"""Radians: a machine that leans by more than the first since the load came on is looked at under the same force, and
tips if it goes on to the second. It need not: it may swing back (a crane on its outriggers rocks once in three
seconds), or stand with a lean (on its jacks, or on the other ends of its tracks); on its tyres it gives a hundredth of
a degree."""
_WATCHED, _STILL = 8.0, 1.0
"""Seconds that it is looked at, and in which it must lean by no more than a tenth of `LEAN` to be at rest."""
TIPPED = math.radians(5.0)
GIVEN = 0.005
"""Metres: a cylinder that went back by this has given way."""
_QUICK, _QUICK_SHARE, _SLOW, _MOST = 2.0, 0.75, 0.015, 1.3
"""A load grows in so many seconds to this share of what statics says, then by this share a second, to no more than
that. To nine tenths in two seconds it set a crane rocking that it tipped at 0.93 of what tips it slowly."""
_LOOK = 0.01
"""Seconds between two looks at the machine."""
_PROGRESS, _PATIENCE = 0.002, 1.0
"""Metres and seconds: a cylinder that gets no farther in this time has stalled."""
_SAMPLES = 51
_DOWN: Floats = np.array([0.0, 0.0, -1.0])


def run_tests(
    usd_path: str | Path,
    *,
    engine: str,
    dt: float | None = None,
    names: Sequence[str] | None = None,
    tests: Sequence[MachineTest] | None = None,
    progress: Callable[[str], None] = lambda words: None,
) -> tuple[Figure, ...]:
    """The tests that the machine's template states, or those of the given names, in an engine, beside the sheet; with
    `tests` those instead (`chart_tests`).

    `YellowironError` for an unknown engine or test, an engine that is not installed, and an unusable file.
    """
    step = find_engine(engine).timestep if dt is None else dt
    import_engine(engine)
    mechanism = attached(usd.read_mechanism(usd_path))
    stated = mechanism.tests if tests is None else tests
    known = [test.name for test in stated]
    for name in names or ():
        if name not in known:
            raise YellowironError(
                f"There is no test '{name}'", where=mechanism.name, hint=f"Known: {', '.join(known)}."
            )
    figures = []
    for test in stated:
        if names is None or test.name in names:
            progress(f"Testing in {engine}: {test.name}")
            figures.append(_tested(_Trial(engine, Path(usd_path), mechanism, test, step)))
    return tuple(figures)


def _tested(trial: _Trial) -> Figure:
    made = {"tipping": _tipping, "force": _force, "time": _time, "lift": _lift}[trial.test.kind]
    try:
        if trial.test.payload and not trial.payload:
            raise Unmeasurable("the machine's rated payload is not known")
        figure = made(trial)
    except Unmeasurable as why:
        figure = Figure(trial.test, None, None, reason=str(why))
    return beside_sheet(figure, trial.read, calibrated=trial.test.kind == "time" and trial.flow is None)


@dataclass
class _Trial:
    """One test of one machine: what all kinds need. `read` is the machine as in the file."""

    engine: str
    usd_path: Path
    read: Mechanism
    test: MachineTest
    timestep: float

    def __post_init__(self) -> None:
        self.payload = self.test.payload * rated_payload(self.read).mass
        self.mechanism = with_payload(self.read, self.payload)
        self.heavier = tuple(b for b, old in zip(self.mechanism.bodies, self.read.bodies, strict=True) if b is not old)
        flow, _, _ = specified(self.read, self.test.flow) if self.test.flow else (None, False, "")
        self.flow = flow if flow is not None and flow > 0.0 else None

    def pose(self) -> tuple[Bench, State]:
        """The kinematics, and the state that the test begins in."""
        bench = Bench(self.mechanism)
        return bench, bench.pose(self.test.steps)

    def site(self) -> Site:
        for site in self.mechanism.sites:
            if site.name == self.test.site:
                return site
        raise Unmeasurable(f"the machine has no site '{self.test.site}'")

    @property
    def driven(self) -> str:
        """The tested actuator's driven slide."""
        for actuator in self.mechanism.actuators:
            if actuator.name == self.test.actuator and actuator.kind == "cylinder":
                return actuator.joints[0].joint
        raise Unmeasurable(f"the machine has no cylinder actuator '{self.test.actuator}'")

    @property
    def sense(self) -> float:
        """Sign of the driven slide's coordinate as the actuator moves to the test's end."""
        actuator = next(a for a in self.mechanism.actuators if a.name == self.test.actuator)
        return float(actuator.joints[0].sign) * (1.0 if self.test.to == "max" else -1.0)

    @property
    def force(self) -> float:
        """The tested actuator's force in that sense."""
        return actuator_force(self.mechanism, self.test.actuator, positive=self.test.to == "max")

    def speed(self) -> float:
        """Of the tested slide, m/s: the flow over the area it fills, else the cylinder's own."""
        area = actuator_area(self.mechanism, self.test.actuator, positive=self.test.to == "max")
        if self.flow is not None and area > 0.0:
            return self.flow / area
        own = [c.speed for c in self.mechanism.cylinders if c.slide == self.driven and c.speed > 0.0]
        drive = self.mechanism.joint(self.driven).drive
        if not own and area == 0.0 and drive is not None and math.isfinite(drive.max_velocity):
            return drive.max_velocity  # a winch's
        if not own:
            raise Unmeasurable("neither a flow nor a speed is known")
        return own[0]

    def drives(self, **own: Drive) -> dict[str, Drive]:
        """Every position drive locked but those given by joint."""
        held = {
            j.name: locked(j.drive)
            for j in self.mechanism.joints
            if j.drive is not None and j.drive.kind == "position" and not j.cut
        }
        return {**held, **own}

    def drive(self) -> Drive:
        """The tested slide's."""
        drive = self.mechanism.joint(self.driven).drive
        if drive is None:
            raise Unmeasurable(f"'{self.driven}' has no drive")
        return drive

    def rig(self, drives: dict[str, Drive]) -> Rig:
        return Rig(
            self.engine, self.usd_path, self.mechanism, heavier=self.heavier, drives=drives, base=self.test.base,
            timestep=self.timestep,
        )  # fmt: skip


# ---- loads and forces that grow -------------------------------------------------------------------------------------
def _tipping(trial: _Trial) -> Figure:
    bench, state = trial.pose()
    site = trial.site()
    statics = tipping_force(trial.mechanism, bench.chain, state, place(bench.chain, state, site), _DOWN)
    rig = trial.rig(trial.drives())
    try:
        force, why = _grow(rig, state, site, 0.0, _DOWN, statics, slide=None)
    finally:
        rig.close()
    value = None if force is None else force / GRAVITY
    return Figure(trial.test, value, statics / GRAVITY, reason=why)


def _force(trial: _Trial) -> Figure:
    bench, state = trial.pose()
    site, offset = trial.site(), trial.test.offset
    for name in trial.test.best:
        state = _strongest(trial, bench, state, name)
    statics, along = _pushed(trial, bench, state, trial.test.actuator)
    if statics <= 0.0:
        raise Unmeasurable(
            f"{trial.test.actuator} does not push '{site.name}' that way, or bears no more than its weight"
        )
    limit = ""
    if trial.test.base == "floating":
        tips = tipping_force(trial.mechanism, bench.chain, state, place(bench.chain, state, site, offset), -along)
        if tips < statics:
            limit = f"statics: the machine tips; {trial.test.actuator} alone would give {statics / 1e3:.0f} kN"
            statics = tips
    rig = trial.rig(trial.drives(**{trial.driven: replace(locked(trial.drive()), max_force=trial.force)}))
    try:
        value, why = _grow(rig, state, site, offset, -along, statics, slide=(trial.driven, trial.sense))
    finally:
        rig.close()
    added, words = 0.0, ""
    if trial.test.unweighted and not limit:
        added = statics - _pushed(trial, bench, state, trial.test.actuator, carried=False)[0]
        words = f"{added / 1e3:.1f} kN of it come of weights, which the sheet leaves out"
    return Figure(
        trial.test, value, statics, weights=added, reason="; ".join(text for text in (why, limit, words) if text)
    )


def _pushed(trial: _Trial, bench: Bench, state: State, name: str, *, carried: bool = True) -> tuple[float, Floats]:
    """Force (N) of an actuator at the test's site, less the weight it carries (`carried` false: of that nothing), and
    its unit direction (3,); 0 where the site does not move that way."""
    entry = bench.actuator(name).joints[0]
    positive = name != trial.test.actuator or trial.test.to == "max"
    sense = float(entry.sign) * (1.0 if positive else -1.0)
    moved = sense * motion(bench.chain, state, entry.joint, trial.site(), trial.test.offset)
    speed = float(np.linalg.norm(moved))
    along = -_DOWN if trial.test.direction == "up" or speed == 0.0 else moved / speed
    rate = float(moved @ along)
    if rate <= 1e-6:
        return 0.0, along
    force = actuator_force(trial.mechanism, name, positive=positive)
    return (force - (sense * weight(bench.chain, state, entry.joint) if carried else 0.0)) / rate, along


def _strongest(trial: _Trial, bench: Bench, state: State, name: str) -> State:
    """The state in which an actuator stands where, over its stroke, its force at the site is greatest."""
    joint, (low, high) = bench.actuator(name).joints[0].joint, sorted(bench.range(name))
    start, _ = bench.chain.reach({joint: low}, start=state)
    # Not at the very ends: there the site's motion is not defined on both sides.
    inner = np.linspace(low, high, _SAMPLES)[1:-1]
    states = bench.chain.sweep({joint: inner}, start=start)
    if not states:
        raise Unmeasurable(f"the linkage locks on the way of {name}")
    return max(states, key=lambda each: _pushed(trial, bench, each, name)[0])


def _grow(
    rig: Rig,
    state: State,
    site: Site,
    offset: float,
    direction: Floats,
    scale: float,
    *,
    slide: tuple[str, float] | None,
) -> tuple[float | None, str]:
    """A force on a site grows until the machine tips, or the slide (joint, sense) goes back: (its size, what gave).

    `scale` only says how fast it grows.
    """
    rig.pose(state)
    own, more = rig.bearing(state, site, offset, direction)
    upright, heights = rig.upright(), rig.heights()
    start = rig.coordinate(slide[0]) if slide else 0.0
    look, point, force = max(1, round(_LOOK / rig.timestep)), rig.place(site, offset), 0.0

    def press(newtons: float) -> None:
        rig.engine.push(site.body, newtons * direction, point)
        rig.step(rig.pressed(own, more, newtons))

    for number in range(rig.steps(_QUICK + (_MOST - _QUICK_SHARE) / _SLOW)):
        now = (number + 1) * rig.timestep
        share = _QUICK_SHARE * now / _QUICK if now < _QUICK else _QUICK_SHARE + _SLOW * (now - _QUICK)
        force = share * scale
        press(force)
        if number % look:
            continue
        point = rig.place(site, offset)
        if not np.isfinite(point).all():
            return None, "the simulation broke down"
        if _lean(rig, upright) > LEAN:
            risen = [name for name, height in rig.heights().items() if height > heights[name] + 0.5 * LEAN]
            ends = _watched(rig, upright, force, press)
            if ends == "over":
                return force, f"{', '.join(risen)} left the ground" if risen else "the machine tipped"
            if ends == "stands":
                upright, heights = rig.upright(), rig.heights()
            continue
        if slide and slide[1] * (rig.coordinate(slide[0]) - start) < -GIVEN:
            return force, "the cylinder gave way at its relief pressure"
    return None, f"nothing gave up to {100.0 * _MOST:.0f} % of what statics says"


def _lean(rig: Rig, upright: Floats) -> float:
    """Radians between the machine's upright and what it was."""
    return math.acos(min(1.0, float(rig.upright() @ upright)))


def _watched(
    rig: Rig, upright: Floats, force: float, press: Callable[[float], None]
) -> Literal["over", "back", "stands"]:
    """What becomes of a leaning machine while a force is held: it goes over, swings back upright, or stands with a
    lean."""
    leans: list[float] = []
    look = max(1, round(_LOOK / rig.timestep))
    still = max(1, round(_STILL / (look * rig.timestep)))
    for number in range(rig.steps(_WATCHED)):
        press(force)
        if number % look:
            continue
        leans.append(_lean(rig, upright))
        if leans[-1] > OVER:
            return "over"
        if leans[-1] < 0.5 * LEAN:
            return "back"
        last = leans[-still:]
        if len(last) == still and max(last) - min(last) < 0.1 * LEAN:
            return "stands"
    return "stands"


# ---- motion ---------------------------------------------------------------------------------------------------------
def _time(trial: _Trial) -> Figure:
    _, state = trial.pose()
    drive, speed = trial.drive(), trial.speed()
    quick = _quick(drive, speed)
    way, seconds, share, why = _run(trial, state, speed, {trial.driven: quick}, watch=False)
    if share < 1.0 - SHARE:
        return Figure(trial.test, None, way / speed, reason=f"it came {100.0 * share:.0f} % of the way: {why}")
    source = (
        f"at {trial.test.flow}"
        if trial.flow is not None
        else "at the cylinder's own speed, which the sheet's time gave"
    )
    return Figure(trial.test, seconds, way / speed, reason=source)


def _lift(trial: _Trial) -> Figure:
    bench, state = trial.pose()
    statics = _lifted(trial, bench, state)
    drive, speed = trial.drive(), trial.speed()
    strong = replace(_quick(drive, speed), max_force=trial.force, reverse_force=None)
    _, _, share, why = _run(trial, state, speed, trial.drives(**{trial.driven: strong}), watch=True)
    arrived = share >= 1.0 - SHARE
    return Figure(
        trial.test, 1.0 if arrived else share, statics, reason=f"{trial.payload:.0f} kg; {why}", arrived=arrived
    )


def _ends(trial: _Trial, bench: Bench, state: State) -> tuple[float, float]:
    """The tested slide's coordinate in the test's first pose, and where it is sent."""
    low, high = bench.range(trial.test.actuator)
    return bench.chain.coordinate(state, trial.driven), high if trial.test.to == "max" else low


def _lifted(trial: _Trial, bench: Bench, state: State) -> float:
    """Share of the way along which, by statics, the actuator bears the weight and the machine stands."""
    start, end = _ends(trial, bench, state)
    states = bench.chain.sweep({trial.driven: np.linspace(start, end, _SAMPLES)}, start=state)
    for number, each in enumerate(states):
        bears = trial.sense * weight(bench.chain, each, trial.driven) <= trial.force
        if not bears or (trial.test.base == "floating" and not stands(trial.mechanism, bench.chain, each)):
            return max(0, number - 1) / (_SAMPLES - 1)
    return (len(states) - 1) / (_SAMPLES - 1)


def _quick(drive: Drive, speed: float) -> Drive:
    """The drive, fast enough to follow a target of that speed either way."""
    return replace(drive, max_velocity=max(*drive.speeds, 1.2 * speed), reverse_velocity=None)


def _run(
    trial: _Trial, state: State, speed: float, drives: dict[str, Drive], *, watch: bool
) -> tuple[float, float, float, str]:
    """The tested actuator sent to its end at a speed: (length of the way, seconds until it was there, share of the way
    that it made, what ended it). `watch`: a machine that tips has not lifted."""
    rig = trial.rig(drives)
    try:
        rig.pose(state)
        bench = Bench(rig.mechanism, chain=rig.chain)
        start, end = _ends(trial, bench, state)
        way = abs(end - start)
        if way == 0.0:
            raise Unmeasurable("the actuator is at its end already")
        pace = paces(rig.chain, tuple(m for m in rig.moves if m.joint == trial.driven))[trial.driven]
        # The lever stays open to the end of the stroke: no slowing down before it.
        path = np.clip(travel(start, 2.0 * end - start, speed, rig.timestep, pace), min(start, end), max(start, end))
        path = np.append(path, np.full(rig.steps(way / speed + 2.0), end))
        targets = {m.joint: np.full(len(path), rig.chain.coordinate(state, m.joint)) for m in rig.moves}
        told = carried(rig.chain, rig.moves, {**targets, trial.driven: path}, rig.timestep)
        upright, share, best, since = rig.upright(), 0.0, 0.0, 0.0
        look = max(1, round(_LOOK / rig.timestep))
        for number in range(len(path)):
            rig.step({joint: float(values[number]) for joint, values in told.items()})
            if number % look:
                continue
            now = (number + 1) * rig.timestep
            share = (rig.coordinate(trial.driven) - start) / (end - start)
            if not math.isfinite(share):
                raise Unmeasurable("the simulation broke down")
            if share >= 1.0 - SHARE:
                return way, now, share, "it arrived"
            if (share - best) * way > _PROGRESS:
                best, since = share, now
            if watch and math.acos(min(1.0, float(rig.upright() @ upright))) > TIPPED:
                return way, now, best, f"the machine tipped after {100.0 * best:.0f} % of the way"
            if now - since > _PATIENCE:
                return way, now, best, f"the cylinder stalled after {100.0 * best:.0f} % of the way"
        return way, now, best, f"it was not there after {now:.1f} s"
    finally:
        rig.close()
