"""The skid steer's planar linkage: lift arms on a pivot (radial lift) or on two links (vertical lift), and the bucket's
carrier at their end; solved so that the machine meets its published values.

Millimetres, in the plane y = 0: x forward from the middle of the wheelbase, z up from the ground; angles are radians,
a raised arm and a bucket rolled back positive. The arms' pins are given with the arms lowered, `turn` of them 0.

Pins: B bucket on the arms, C and D lift cylinder (chassis, arms), E tilt cylinder on the arms, J its rod on the bucket;
P and Q rear link (chassis, arms), R and S front link, A the arms' pivot of the radial lift. T is the cutting edge. J
and T are in the level bucket's frame, from B.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.optimize import brentq, least_squares

from drawing.planar import Point, direction, meet, rot, sine, vec

from . import values as v

LiftPath = Literal["vertical", "radial"]
RADIUS = v.TYRE_DIAMETER.value / 2
AXLE_X = v.WHEELBASE.value / 2
DEPTH, FOOT = 200.0, 75.0
"""B above the floor's underside; radius of the arms' ends about B."""
ROLLBACK, DUMP = math.radians(v.ROLLBACK.value), math.radians(v.DUMP_ANGLE.value)
LOW = DEPTH - v.DIG_DEPTH.value
"""Height of B with the arms lowered."""
CORNER_X = math.sqrt(v.TURNING_RADIUS.value**2 - (v.BUCKET_WIDTH.value / 2) ** 2)
"""x of the cutting edge with the arms lowered and the bucket rolled back: what the published turning radius takes."""
PIVOT = vec(-1000.0, 1500.0)
"""The arms' pivot of the radial lift."""


@dataclass(frozen=True, slots=True, eq=False)
class Linkage:
    """Pins, millimetres. `links`: chassis' and arms' pin of the rear and the front link; of one pivot both are the
    same. `turn`: how far the arms turn from lowered to raised."""

    links: tuple[tuple[Point, Point], ...]
    B: Point
    C: Point
    D: Point
    E: Point
    J: Point
    T: Point
    turn: float

    @property
    def tail(self) -> float:
        """x of the rearmost point."""
        return float(self.B[0]) + FOOT - v.BARE_LENGTH.value

    def carry(self, turn: float, point: Point) -> Point:
        """Where a point of the lowered arms is when they have turned."""
        (p, q), (r, s) = self.links[0], self.links[-1]
        if len(self.links) == 1:
            return q + rot(turn, point - q)
        length, other = float(np.hypot(*(q - p))), float(np.hypot(*(s - r)))
        start = r - (s - q)
        side = 1.0 if sine(q, p, start) < 0.0 else -1.0
        return meet(p, length, r - rot(turn, s - q), other, side) + rot(turn, point - q)

    def lift(self, turn: float) -> float:
        """Length of the lift cylinders."""
        return float(np.hypot(*(self.carry(turn, self.D) - self.C)))

    def turned(self, lift: float) -> float:
        """How far the arms have turned at a length of the lift cylinders."""
        return float(brentq(lambda a: self.lift(a) - lift, -0.01, self.turn + 0.01, xtol=1e-14))

    def tilt(self, angle: float) -> float:
        """Length of the tilt cylinders at an angle of the bucket to the lowered arms."""
        return float(np.hypot(*(self.B + rot(angle, self.J) - self.E)))

    def angle(self, tilt: float) -> float:
        """Angle of the bucket to the lowered arms at a length of the tilt cylinders."""
        dead = direction(self.E - self.B) - math.pi - direction(self.J)  # rod pin, B and barrel pin in line
        return float(brentq(lambda a: self.tilt(a) - tilt, dead, dead + math.pi, xtol=1e-14))

    def level(self) -> float:
        """How far the arms have turned when the level bucket's edge is on the ground."""
        return float(brentq(lambda a: float(self.carry(a, self.B)[1]) - DEPTH, 0.0, 0.3, xtol=1e-14))


def hinge_x(edge: float, back: float) -> float:
    """x of B with the arms lowered, for an edge so far ahead of it and the bucket rolled back by an angle."""
    return CORNER_X - edge * math.cos(back) - DEPTH * math.sin(back)


# Where the search starts and what it stays near: P, Q, R, S, the arms' turn, the edge ahead of B, the arms' turn with
# the bucket on the ground.
_PINS = [-977.0, 758.0, -1168.0, 1621.0, -258.0, 850.0, -964.0, 1244.0]
_SKETCH = np.array([*_PINS, math.radians(70.0), v.LENGTH.value - v.BARE_LENGTH.value + FOOT, 0.0])
_LOOSE = np.array([*[30.0] * 8, 0.05, 10.0, 0.01])


def _on_links(x: Point) -> Linkage:
    pins = x[:8].reshape(4, 2)
    nowhere, edge, level = vec(0.0, 0.0), float(x[9]), float(x[10])
    links = ((pins[0], pins[1]), (pins[2], pins[3]))
    hinge, tip = vec(hinge_x(edge, ROLLBACK - level), LOW), vec(edge, -DEPTH)
    return Linkage(links, hinge, nowhere, nowhere, nowhere, nowhere, tip, float(x[8]))


def _required(x: Point) -> Point:
    """What must be zero, millimetres and radians times 1000: hinge height, reach, length with the bucket on the ground,
    and how far the arms have turned then, by which the bucket rolls back less when they are lowered."""
    k = _on_links(x)
    level = k.level()
    high, ground = k.carry(k.turn, k.B), k.carry(level, k.B)
    reach = high[0] + rot(-DUMP, k.T)[0] - AXLE_X - RADIUS
    return np.array([
        high[1] - v.HINGE_HEIGHT.value, reach - v.REACH.value, ground[0] + k.T[0] - k.tail - v.LENGTH.value,
        1000.0 * (level - x[10]),
    ])  # fmt: skip


def _wished(x: Point) -> Point:
    return np.concatenate([_required(x), 0.1 * (x - _SKETCH) / _LOOSE])


def _arms(path: LiftPath) -> Linkage:
    """The arms on the chassis, without cylinders."""
    near = least_squares(_wished, _SKETCH, x_scale=_LOOSE, xtol=1e-12, ftol=1e-12, gtol=1e-12).x
    exact = least_squares(_required, near, x_scale=_LOOSE, method="trf", xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    k = _on_links(np.round(exact, 9))
    if path == "vertical":
        return k
    arm = k.B - PIVOT
    far = float(np.hypot(*arm))
    turn = math.asin((v.HINGE_HEIGHT.value - PIVOT[1]) / far) - direction(arm)
    return Linkage(((PIVOT, PIVOT),), k.B, k.C, k.D, k.E, k.J, k.T, turn)


@functools.cache
def solve(path: LiftPath = "vertical") -> Linkage:
    """The linkage; the same on every call. With radial lift it meets every value but the reach."""
    k = _arms(path)
    base = vec(-1350.0, 700.0) if path == "vertical" else vec(-1000.0, 560.0)
    along = -300.0 if path == "vertical" else 60.0

    def lifting(height: float) -> Linkage:
        return Linkage(k.links, k.B, base, vec(along, height), k.E, k.J, k.T, k.turn)

    def stroke(height: float) -> float:
        arms = lifting(height)
        return arms.lift(k.turn) - arms.lift(0.0) - v.LIFT_STROKE.value

    d = vec(along, float(brentq(stroke, 900.0, 1500.0, xtol=1e-12)))
    j = rot(math.radians(80.0), vec(205.0, 0.0))
    ends = ((ROLLBACK - k.level(), 0.0), (-DUMP - _arms("vertical").turn, v.TILT_STROKE.value))

    def tilting(x: Point) -> Linkage:
        return Linkage(k.links, k.B, base, d, k.B + rot(x[1], vec(x[0], 0.0)), j, k.T, k.turn)

    def missed(x: Point) -> Point:
        return np.array([tilting(x).tilt(angle) - v.TILT_CLOSED.value - out for angle, out in ends])

    x = least_squares(missed, [800.0, math.radians(128.0)], x_scale=[100.0, 1.0], xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    return tilting(x)
