"""What the levers do: every actuator alone, then all together. Ramped targets, strokes of 2–98 % at rated speed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Actuator, Mechanism, rolling
from yellowiron.simulation.ground import standing_bodies

SHARE = 0.02
"""Of the stroke, left at both ends."""
RAMP = 0.3
"""Seconds in which a target reaches its speed at the soonest."""
HOLD = 1.0
"""Seconds that a target rests at each end."""
SETTLE = 1.5
"""Seconds at the start, for a machine to come to rest on its drives and tyres."""
CRAWL = 0.1
"""Share of its full speed at which a motor turns a wheel while the machine stands on the ground."""
SWING = 0.25
"""Radians to either side by which a driven hinge without limits is turned."""
_CREEPS = 1e-3
"""The least share of the acceleration that `RAMP` allows."""
_GRID = 1001
_SAMPLE = 0.05
"""Seconds between two poses of a path that the kinematics is asked for."""


@dataclass(frozen=True, eq=False)
class Pace:
    """The largest acceleration `limits` (n,) of a target at `places` (n,) along its way, m/s² or rad/s², and the
    largest `speeds` (n, 2), m/s or rad/s, in the negative and in the positive direction. A motor's are the same
    wherever it stands. `masses` (n,): what is moved there, kg or kg·m²: where that changes along the way, a force goes
    into the change too, d(½mv²)/dx = F."""

    places: Floats
    limits: Floats
    speeds: Floats | None = None
    masses: Floats | None = None


@dataclass(frozen=True)
class Motion:
    """What one actuator does: `joint` is the driven one. Cylinders move between `low` and `high` (metres or radians
    from the drawn pose) at `speed`; motors turn at `speed` (rad/s). `drives`: it turns what the machine drives on."""

    actuator: str
    joint: str
    sign: int
    position: bool
    speed: float
    low: float = 0.0
    high: float = 0.0
    stroke: float = 0.0
    drives: bool = False

    def top_speed(self, *, on_ground: bool) -> float:
        """The speed that is asked of it."""
        return self.speed * (CRAWL if on_ground and self.drives else 1.0)


@dataclass(frozen=True, eq=False)
class Phase:
    """A stretch of time: `targets` by joint, one value a step. `holds`: steps at whose end the targets have rested."""

    name: str
    targets: Mapping[str, Floats]
    holds: tuple[int, ...]

    @property
    def steps(self) -> int:
        """How many steps it takes."""
        return max((len(values) for values in self.targets.values()), default=0)


def motions(mechanism: Mechanism, actuators: Sequence[str] | None = None) -> tuple[Motion, ...]:
    """The motions of the named actuators (default: all), one a driven joint.

    `YellowironError` for a name that is no actuator.
    """
    known = {actuator.name: actuator for actuator in mechanism.actuators}
    for name in actuators or ():
        if name not in known:
            raise YellowironError(
                f"There is no actuator '{name}'", where=mechanism.name, hint=f"Known: {', '.join(known)}."
            )
    chosen = [known[name] for name in actuators] if actuators is not None else list(known.values())
    return tuple(motion for actuator in chosen for motion in _motions(mechanism, actuator))


def _motions(mechanism: Mechanism, actuator: Actuator) -> Iterator[Motion]:
    cylinders = {cylinder.slide: cylinder for cylinder in mechanism.cylinders}
    entries = actuator.joints[:1] if actuator.kind == "cylinder" else actuator.joints
    wheels = {*standing_bodies(mechanism), *(rolling(mechanism) - {j.body0 for j in mechanism.joints})}
    for entry in entries:
        joint = mechanism.joint(entry.joint)
        if joint.drive is None or joint.cut:
            continue
        speed = joint.drive.max_velocity if math.isfinite(joint.drive.max_velocity) else 1.0
        if joint.drive.kind == "velocity":
            yield Motion(actuator.name, joint.name, entry.sign, False, speed, drives=joint.body1 in wheels)
        elif joint.lower is None and joint.upper is None and joint.type == "revolute":
            # A hinge that is driven directly, of which nobody says how far it turns.
            yield Motion(actuator.name, joint.name, entry.sign, True, min(speed, 1.0), -SWING, SWING, 2.0 * SWING)
        elif joint.lower is not None and joint.upper is not None:
            if joint.name in cylinders and cylinders[joint.name].speed > 0.0:
                speed = cylinders[joint.name].speed
            stroke = joint.upper - joint.lower
            low, high = joint.lower + SHARE * stroke, joint.upper - SHARE * stroke
            yield Motion(actuator.name, joint.name, entry.sign, True, speed, low, high, stroke)


def phases(
    moves: Sequence[Motion], timestep: float, *, on_ground: bool, paces: Mapping[str, Pace] = MappingProxyType({})
) -> Iterator[Phase]:
    """Settling, each actuator alone, all together. Every phase starts and ends at the drawn pose, motors at rest."""
    still = {motion.joint: np.zeros(1) for motion in moves}
    count = max(1, round(SETTLE / timestep))
    yield Phase("settle", {joint: np.zeros(count) for joint in still}, ())
    names = list(dict.fromkeys(motion.actuator for motion in moves))
    groups = [(name, [m for m in moves if m.actuator == name]) for name in names]
    if len(groups) > 1:
        groups.append(("together", list(moves)))
    for name, group in groups:
        yield _phase(name, group, timestep, on_ground, paces)


def _phase(name: str, group: Sequence[Motion], timestep: float, on_ground: bool, paces: Mapping[str, Pace]) -> Phase:
    """Down, up and back, each at its own speed; who is done waits for the slowest."""
    parts: list[dict[str, Floats]] = []
    place = {motion.joint: 0.0 for motion in group}
    for leg in ("low", "high", "drawn"):
        rows = {}
        for motion in group:
            if motion.position:
                target = {"low": motion.low, "high": motion.high, "drawn": 0.0}[leg]
                rows[motion.joint] = travel(
                    place[motion.joint], target, motion.speed, timestep, paces.get(motion.joint)
                )
                place[motion.joint] = target
            else:
                speed = motion.sign * motion.top_speed(on_ground=on_ground)
                target = {"low": -speed, "high": speed, "drawn": 0.0}[leg]
                rows[motion.joint] = _spin(target, timestep, paces.get(motion.joint))
        length = max(len(row) for row in rows.values()) + round(HOLD / timestep)
        parts.append({joint: _held(row, length) for joint, row in rows.items()})
    targets = {motion.joint: np.concatenate([part[motion.joint] for part in parts]) for motion in group}
    ends = np.cumsum([len(next(iter(part.values()))) for part in parts])
    return Phase(name, targets, tuple(int(end) - 1 for end in ends))


def _held(row: Floats, length: int) -> Floats:
    return np.concatenate([row, np.full(length - len(row), row[-1])])


def _spin(speed: float, timestep: float, pace: Pace | None = None) -> Floats:
    """A motor's targets: up to speed as fast as `RAMP` and pace allow, held, back to rest."""
    time = 2.0 * RAMP if pace is None else max(2.0 * RAMP, abs(speed) / float(pace.limits.min()))
    up = np.linspace(0.0, 1.0, max(2, round(time / timestep)))
    return speed * np.concatenate([up, np.ones(round(HOLD / timestep)), up[::-1]])


def sampled(count: int, timestep: float) -> NDArray[np.int64]:
    """The steps (n,) of a path of `count` steps at which its pose is solved: every `_SAMPLE` seconds, and the last."""
    return np.unique(np.append(np.arange(0, count, max(1, round(_SAMPLE / timestep))), count - 1))


def travel(start: float, end: float, speed: float, timestep: float, pace: Pace | None = None) -> Floats:
    """Targets from one place to another, as fast as speed, `RAMP` and pace allow, from rest to rest.

    On a fine grid along the way, from both ends, the squared speed grows by no more than twice the acceleration allowed
    there, and the energy by no more than the work of the force that this acceleration takes.
    """
    way = abs(end - start)
    if way == 0.0:
        return np.array([end])
    places = np.linspace(start, end, _GRID)
    step = way / (_GRID - 1)
    limits, masses = np.full(_GRID, speed / RAMP), np.ones(_GRID)
    if pace is not None:
        limits = np.minimum(limits, np.interp(places, pace.places, pace.limits))
        if pace.masses is not None:
            masses = np.interp(places, pace.places, pace.masses)
    # At a dead point, where no force moves it, it creeps on.
    limits = np.maximum(limits, _CREEPS * speed / RAMP)
    gain = step * (limits[1:] + limits[:-1])
    work = step * ((masses * limits)[1:] + (masses * limits)[:-1])
    speeds = np.full(_GRID, speed)
    if pace is not None and pace.speeds is not None:
        speeds = np.minimum(speeds, np.interp(places, pace.places, pace.speeds[:, int(end > start)]))
    squared = speeds**2
    squared[0] = squared[-1] = 0.0
    for i in range(1, _GRID):
        reached = (masses[i - 1] * squared[i - 1] + work[i - 1]) / masses[i]
        squared[i] = min(squared[i], squared[i - 1] + gain[i - 1], reached)
    for i in range(_GRID - 2, -1, -1):
        reached = (masses[i + 1] * squared[i + 1] + work[i]) / masses[i]
        squared[i] = min(squared[i], squared[i + 1] + gain[i], reached)
    speeds = np.sqrt(squared)
    time = np.concatenate([[0.0], np.cumsum(2.0 * step / (speeds[1:] + speeds[:-1]))])
    now = np.minimum(np.arange(1, math.ceil(float(time[-1]) / timestep) + 1) * timestep, time[-1])
    cell = np.clip(np.searchsorted(time, now, side="right") - 1, 0, _GRID - 2)
    within, gained = now - time[cell], np.diff(squared)[cell] / (2.0 * step)
    gone = cell * step + speeds[cell] * within + 0.5 * gained * within**2
    gone[-1] = way
    return np.asarray(start + math.copysign(1.0, end - start) * gone, dtype=np.float64)
