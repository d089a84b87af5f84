"""Driving: the machine stands on its wheels, drives straight, turns at full lock, and climbs a block with one wheel.

Every wheel with a motor turns at the speed of its own circle, as differentials let it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.kinematics import ClosedChain
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Joint, Mechanism, scrubbing
from yellowiron.simulation.commands import SHARE, Motion, motions, travel
from yellowiron.simulation.driving import tracked
from yellowiron.simulation.driving.raised import raised
from yellowiron.simulation.driving.result import BLOCK_HEIGHT, DISTANCE, DrivingResult
from yellowiron.simulation.driving.sliding import center_of_mass, least_sliding, standing
from yellowiron.simulation.driving.turning import crabs, turning_centre
from yellowiron.simulation.driving.wheel import GroundWheel, driven_wheels, free_wheels, sides, top_speed
from yellowiron.simulation.engine import Engine, Setup, coordinates, poses, tell
from yellowiron.simulation.ground import Block, standing_bodies
from yellowiron.simulation.loads import paces
from yellowiron.simulation.payload import with_payload
from yellowiron.simulation.registry import find_engine, load_engine
from yellowiron.usd import read_mechanism

SPEED = 1.0
"""m/s at the machine's middle."""
_SETTLE = 2.0
_RAMP = 1.0
_TURN = math.radians(120.0)
_RUN = 2.0
"""Length of the block's ramps by its height: 27°."""
_LOCK = 0.998
"""Share of the steering stroke that is full lock."""
_ROOM = 0.05
_STILL, _MOVES, _PATIENCE = 1.0, 1e-3, 30.0
"""A lever's joint is at rest if its mean of so many seconds is that of as many before to this share of its stroke; so
many seconds are waited for it."""
_DRAGS = 0.1
"""A wheel slides across by this share of its way in a turn, …"""
_STRAIGHT = 0.999
"""… and is not steered if its axis lies as drawn by this cosine."""


def drive(usd_path: str | Path, *, engine: str, payload_kg: float = 0.0, dt: float | None = None) -> DrivingResult:
    """Lets a wheeled machine raise what else stands on the ground (jacks, a blade, a bucket), settle, drive 5 m forward
    and back, turn at full lock, and climb a 150 mm block with one wheel of its free axle, where it has one. One that
    steers by its two sides' speeds drives 2 m, turns on the spot by 45° and swings by 90°.

    Raises `YellowironError` for an unknown engine, one that is not installed, and a machine without driven wheels.
    """
    entry = find_engine(engine)
    read = read_mechanism(usd_path)
    mechanism = with_payload(read, payload_kg)
    heavier = tuple(b for b, old in zip(mechanism.bodies, read.bodies, strict=True) if b is not old)
    trip = _Trip(engine, Path(usd_path), mechanism, heavier, entry.timestep if dt is None else dt)
    values: dict[str, Any] = {**trip.straight(), **trip.over_block()}
    return DrivingResult(engine=engine, dt=trip.timestep, payload=payload_kg, **values)


@dataclass
class _Trip:
    """One machine to drive, in one engine."""

    engine: str
    usd_path: Path
    mechanism: Mechanism
    heavier: tuple[Body, ...]
    timestep: float
    chain: ClosedChain = field(init=False)
    wheels: tuple[GroundWheel, ...] = field(init=False)

    def __post_init__(self) -> None:
        driven = driven_wheels(self.mechanism)
        self.wheels = (*driven, *free_wheels(self.mechanism))
        self.chain = ClosedChain(self.mechanism)
        names = [body.name for body in self.mechanism.bodies]
        self._root = names.index(self.mechanism.root)
        self._steer = self._steering()
        self._sides = () if self._steer is not None else sides(driven)
        self._raised = raised(self.mechanism, self.chain, self.wheels)
        self._origin = np.asarray(self.mechanism.body(self.mechanism.root).origin)

    def _load(self, *blocks: Block) -> Engine:
        return load_engine(
            self.engine,
            Setup(
                usd_path=self.usd_path,
                mechanism=self.mechanism,
                base="floating",
                timestep=self.timestep,
                measured=self.chain.independent,
                heavier=self.heavier,
                standing=standing_bodies(self.mechanism),
                blocks=blocks,
            ),
        )

    # ---- driving ----------------------------------------------------------------------------------------------------
    def _steps(self, seconds: float) -> int:
        return max(1, math.ceil(seconds / self.timestep))

    def _speeds(self, speed: float, factors: Mapping[str, float] | None = None) -> dict[str, float]:
        """Wheel targets, rad/s, for a speed of the machine's middle in m/s."""
        share = factors or {}
        return {
            w.joint.name: w.sign * speed * share.get(w.joint.name, 1.0) / w.radius for w in self.wheels if w.actuator
        }

    def _middles(self, poses: tuple[Floats, Floats]) -> Floats:
        """The wheels' middles (n, 3) in the world."""
        rotations, origins = poses
        return np.array(
            [
                origins[w.body] + rotations[w.body] @ (w.middle - np.asarray(self.mechanism.bodies[w.body].origin))
                for w in self.wheels
            ]
        )

    def _places(self, poses: tuple[Floats, Floats]) -> Floats:
        """The wheels' middles and how far a unit along their axes rises (n, 4)."""
        rises = [abs(float(poses[0][w.body][2] @ w.axis)) for w in self.wheels]
        return np.column_stack([self._middles(poses), rises])

    def _go(self, engine: Engine, distance: float, *, speed: float = SPEED, record: list[Floats] | None = None) -> None:
        """Drives a distance (negative: backwards) and comes to rest; `record` takes the wheels' places."""
        ahead = np.copysign(tracked.course(abs(distance), speed, math.inf, self.timestep), distance)
        for told in (*ahead.tolist(), *[0.0] * self._steps(1.0)):
            tell(engine, self._speeds(told))
            engine.step()
            if record is not None:
                record.append(self._places(poses(engine)))

    def _rest(self, engine: Engine, seconds: float) -> float:
        """Waits; returns the root's speed at the end."""
        tell(engine, self._speeds(0.0))
        before = np.zeros(3)
        for _ in range(self._steps(seconds)):
            before = poses(engine)[1][self._root]
            engine.step()
        return float(np.linalg.norm(poses(engine)[1][self._root] - before)) / self.timestep

    def _raise(self, engine: Engine) -> None:
        """Brings up what stands on the ground beside the wheels."""
        rows = []
        for motion, target in self._raised.items():
            pace = paces(self.chain, (motion,))[motion.joint]
            rows.append((motion.joint, travel(0.0, target, motion.speed, self.timestep, pace)))
        for number in range(max((len(path) for _, path in rows), default=0)):
            tell(engine, {joint: float(path[min(number, len(path) - 1)]) for joint, path in rows})
            engine.step()

    def straight(self) -> dict[str, float | None]:
        """Settling, forward, back, and the turn."""
        engine = self._load()
        distance, speed = DISTANCE, SPEED
        if self._sides and not scrubbing(self.mechanism):
            distance, speed = tracked.DISTANCE, top_speed(self.wheels, SPEED)
        try:
            self._raise(engine)
            creep = self._rest(engine, _SETTLE)
            rest = poses(engine)[1][self._root]
            self._go(engine, distance, speed=speed)
            ahead = poses(engine)[1][self._root]
            self._go(engine, -distance, speed=speed)
            back = poses(engine)[1][self._root]
            turn = self._turn(engine)
            if self._sides:
                turn |= tracked.spin(engine, self.chain, self.mechanism, self._sides, speed, self.timestep)
                turn |= tracked.swing(engine, self.chain, self.mechanism, self.wheels, self.timestep)
        finally:
            engine.close()
        return {
            "sunk": float(self._origin[2] - rest[2]),
            "creep": creep,
            "forward": float(np.linalg.norm((ahead - rest)[:2])),
            "backward": float(np.linalg.norm((back - ahead)[:2])),
            "sideways": float(max(abs(ahead[1] - rest[1]), abs(back[1] - rest[1]))),
            "distance": distance,
            **turn,
        }

    # ---- turning ----------------------------------------------------------------------------------------------------
    def _steering(self) -> Motion | None:
        """The actuator that turns wheels' axes about the vertical."""
        for motion in motions(self.mechanism):
            if motion.position:
                state, _ = self.chain.reach({motion.joint: motion.high})
                turned = [
                    abs(a[0] * w.axis[1] - a[1] * w.axis[0])
                    for a, w in zip(self._axes(state), self.wheels, strict=True)
                ]
                if max(turned) > 0.1:
                    return motion
        return None

    def _axes(self, state: Any) -> list[Floats]:
        return [self._apply(state, w)[:3, :3] @ w.axis for w in self.wheels]

    def _apply(self, state: Any, wheel: GroundWheel) -> Floats:
        return self.chain.displacement(state, wheel.joint.body0)

    def _posed(self, coordinates: Mapping[str, float]) -> tuple[Any, Floats, Floats]:
        """The state at coordinates, and the wheels' middles and unit axes there (n, 2) seen from above."""
        given = {n: v for n, v in coordinates.items() if not any(n == w.joint.name for w in self.wheels)}
        state, _ = self.chain.reach(given)
        places = np.array([(self._apply(state, w) @ np.append(w.middle, 1.0))[:2] for w in self.wheels])
        return state, places, np.array([a[:2] / np.linalg.norm(a[:2]) for a in self._axes(state)])

    def _circles(self, coordinates: Mapping[str, float]) -> Floats:
        """Radius of each wheel's middle about the middle of the turn, seen from above."""
        _, places, axes = self._posed(coordinates)
        return np.asarray(np.linalg.norm(places - turning_centre(places, axes), axis=1))

    def _slid(self, coordinates: Mapping[str, float], circles: Floats) -> Floats:
        """These circles, but of a machine with a drum those that it comes to by dry friction: a drum turns at one speed
        over its width, so that all of it but one place slides, and holds the machine back in its turn."""
        if all(w.half_width <= w.radius for w in self.wheels):
            return circles
        state, places, axes = self._posed(coordinates)
        under = standing(self.wheels, places, axes, center_of_mass(self.chain, self.mechanism, state)[:2])
        x, y, turn = least_sliding(under, circles)
        return np.asarray(np.linalg.norm(places - np.array([-y, x]) / turn, axis=1))

    def _drags(self, coordinates: Mapping[str, float]) -> bool:
        """Whether an axle too many drags in a turn, neither driven nor steered: by dry friction it takes as much to
        turn about one straight axle as about the other, and which it is depends on what each happens to bear."""
        _, places, axes = self._posed(coordinates)
        centre = turning_centre(places, axes)
        ahead = np.column_stack([-axes[:, 1], axes[:, 0]])
        across = np.abs(np.sum(ahead * (places - centre), axis=1)) / np.linalg.norm(places - centre, axis=1)
        straight = [abs(float(a @ w.axis[:2])) > _STRAIGHT for a, w in zip(axes, self.wheels, strict=True)]
        idle = any(s and not w.actuator for s, w in zip(straight, self.wheels, strict=True))
        return idle and float(across.max()) > _DRAGS

    def _turn(self, engine: Engine) -> dict[str, float | None]:
        motion = self._steer
        if motion is None:
            return {}
        measured = self.chain.independent
        pace = paces(self.chain, (motion,))[motion.joint]
        lock = motion.high + (_LOCK - 1.0 + SHARE) * motion.stroke
        for target in travel(0.0, lock, motion.speed, self.timestep, pace).tolist():
            turns = abs(target) > 0.1 * lock and not crabs(self._headings({motion.joint: target}))
            circles = self._circles({motion.joint: target}) if turns else None
            tell(engine, {motion.joint: target, **self._speeds(0.5 * SPEED, self._factors(circles))})
            engine.step()
        circles = self._circles({motion.joint: lock})
        factors, mean = self._factors(circles), float(circles.mean())
        headings = self._headings({motion.joint: lock})
        if crabs(headings):
            share = self._steered(engine, motion, {}) / lock
            return {"steered": share, "crab": self._crab(engine), "crab_geometry": float(headings.mean())}
        share = self._steered(engine, motion, factors) / lock
        path, locks = [], []
        for _ in range(self._steps(_TURN * mean / SPEED)):
            tell(engine, self._speeds(SPEED, factors))
            engine.step()
            path.append(self._middles(poses(engine)))
            locks.append(coordinates(engine))
        outer = int(np.argmax(circles))
        held = dict(zip(measured, np.mean(locks, axis=0).tolist(), strict=True))
        meeting = self._circles(held)
        geometry = None if self._drags(held) else float(self._slid(held, meeting)[outer])
        self._rest(engine, 1.0)
        return {
            "steered": share,
            "lock": self._lock(held),
            "turning_radius": circle_radius(np.array(path)[:, outer, :2]),
            "geometry_radius": geometry,
            "axes_radius": float(meeting[outer]),
        }

    def _steered(self, engine: Engine, motion: Motion, factors: Mapping[str, float]) -> float:
        """Gains speed in the turn, and rolls on until the steering has come to rest: tyres that scrub hold it back, and
        it goes on for seconds after it was told where to. Where it stands then, metres."""
        place = self.chain.independent.index(motion.joint)
        window = self._steps(_STILL)
        means = []
        for second in range(round((_RAMP + _PATIENCE) / _STILL)):
            were = []
            for number in range(window):
                share = 0.5 + 0.5 * min(1.0, (second * window + number + 1) * self.timestep / _RAMP)
                tell(engine, self._speeds(share * SPEED, factors))
                engine.step()
                were.append(float(coordinates(engine)[place]))
            means.append(float(np.mean(were)))
            if len(means) > 1 and abs(means[-1] - means[-2]) < _MOVES * motion.stroke:
                break
        return means[-1]

    def _crab(self, engine: Engine) -> float:
        """Drives as far as it drove ahead, all wheels turned one way: how far to the left the middle between them goes
        of where its root points, radians. Not all are turned as far, so that the machine turns a little, and each of
        its places goes another way."""
        way = np.zeros(2)
        standing = poses(engine)
        for _ in range(self._steps(DISTANCE / SPEED)):
            tell(engine, self._speeds(SPEED))
            engine.step()
            before, standing = standing, poses(engine)
            moved = self._middles(standing).mean(axis=0) - self._middles(before).mean(axis=0)
            way += (before[0][self._root].T @ moved)[:2]
        self._rest(engine, 1.0)
        return math.atan2(way[1], way[0])

    def _headings(self, coordinates: Mapping[str, float]) -> Floats:
        """How far each wheel is turned to the left seen from above, radians."""
        given = {n: v for n, v in coordinates.items() if not any(n == w.joint.name for w in self.wheels)}
        axes = np.array(self._axes(self.chain.reach(given)[0]))
        return np.asarray(np.arctan2(-axes[:, 0], axes[:, 1]))

    def _lock(self, coordinates: Mapping[str, float]) -> float:
        """The largest angle between two wheels' axes seen from above."""
        return float(np.ptp(self._headings(coordinates)))

    def _factors(self, circles: Floats | None) -> dict[str, float]:
        if circles is None:
            return {}
        shares = circles / circles.mean()
        return {w.joint.name: float(share) for w, share in zip(self.wheels, shares, strict=True)}

    # ---- the block --------------------------------------------------------------------------------------------------
    def _axle(self) -> tuple[Joint, list[int]] | None:
        """A free joint without drive or spring whose body carries a pair of wheels (an axle, a beam of a bogie), and
        their places in `wheels`."""
        for joint in self.mechanism.joints:
            if joint.swings:
                pair = [i for i, w in enumerate(self.wheels) if w.joint.body0 == joint.body1]
                if len(pair) == 2:
                    return joint, pair
        return None

    def over_block(self) -> dict[str, float | None]:
        """One wheel of the free axle onto a block: how the axle turns, and whether every wheel stays down."""
        found = self._axle()
        if found is None:
            return {}
        joint, pair = found
        climbing = max((self.wheels[i] for i in pair), key=lambda w: (round(float(w.middle[1]), 3), float(w.middle[0])))
        run = _RUN * BLOCK_HEIGHT
        start = float(climbing.middle[0]) + climbing.radius + _ROOM
        ahead = [w for w in self.wheels if w.middle[0] > climbing.middle[0] and w.middle[1] * climbing.middle[1] > 0]
        end = min((float(w.middle[0]) - w.radius - _ROOM for w in ahead), default=start + 1.0 + 2.0 * run)
        length = min(1.0, end - start - 2.0 * run)
        if length <= 0.0:
            return {}
        middle = start + run + 0.5 * length
        block = Block((middle, float(climbing.middle[1])), length, 1.2, BLOCK_HEIGHT, run)
        engine = self._load(block)
        record: list[Floats] = []
        try:
            self._raise(engine)
            self._rest(engine, _SETTLE)
            self._go(engine, middle - float(climbing.middle[0]), speed=0.5 * SPEED, record=record)
            axle = float(coordinates(engine)[self.chain.independent.index(joint.name)])
        finally:
            engine.close()
        one, other = (self.wheels[i].middle for i in pair)
        tread = float(np.linalg.norm(np.cross(one - other, joint.axis)))
        return {
            "axle_angle": abs(axle),
            "axle_geometry": math.asin(BLOCK_HEIGHT / tread) + self._pitch(joint, pair),
            "highest_wheel": max(0.0, float(self._lift(np.array(record), block).max())),
        }

    def _pitch(self, joint: Joint, pair: list[int]) -> float:
        """How far what carries a beam of a bogie pitches when one of the beam's wheels stands on the block: the beam's
        pivot rises by half of its height, the middle between the beams by a quarter, the other wheels not at all."""
        spread = float(np.ptp([self.wheels[i].middle[0] for i in pair]))
        away = [abs(float(w.middle[0]) - joint.anchor[0]) for w in self.wheels]
        others = [distance for distance in away if distance > spread]
        return 0.25 * BLOCK_HEIGHT / float(np.mean(others)) if spread > 0.0 and others else 0.0

    def _lift(self, record: Floats, block: Block) -> Floats:
        """Height (steps, wheels) of every wheel, a leaning cylinder, over the place where it would just stand."""
        lifts = []
        for number, wheel in enumerate(self.wheels):
            x, y, z, rise = record[:, number].T
            along = np.linspace(-wheel.radius, wheel.radius, 61)
            under = block.surface(x[:, None] + along, y[:, None]) + np.sqrt(wheel.radius**2 - along**2)
            lean = np.sqrt(np.maximum(0.0, 1.0 - rise**2))
            lifts.append(z - under.max(axis=1) + wheel.radius * (1.0 - lean) - wheel.half_width * rise)
        return np.array(lifts).T


def circle_radius(points: Floats) -> float:
    """Radius of the circle through points (n, 2), least squares (Kåsa 1976)."""
    rows = np.column_stack([2.0 * points, np.ones(len(points))])
    x, y, rest = np.linalg.lstsq(rows, np.sum(points**2, axis=1), rcond=None)[0]
    return float(math.sqrt(rest + x * x + y * y))
