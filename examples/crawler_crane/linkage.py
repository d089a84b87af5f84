"""The crane's boom and what holds it: boom, ropes from the gantry's head to a bail, pendants from there to the boom's
head, all in the plane y = 0.

Machine frame, millimetres: the slewing axis is x = y = 0, x forward over the boom, z up from the ground. The boom's own
frame has its foot pin as origin and x to the pin of its head's sheaves. Angles are radians.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from drawing.planar import Point, direction, rot, vec

from . import values as v

HIGH, LOW = math.radians(v.HIGH.value), math.radians(v.LOW.value)
P = vec(v.FOOT_AHEAD.value, v.FOOT.value)
"""The boom's foot pin."""
D = vec(9_450.0, 420.0)
"""The pendants' pin, in the boom's frame."""
G = vec(-2_600.0, 4_600.0)
"""The pin of the sheaves in the gantry's head."""
CLOSE = 1_500.0
"""Length of the ropes, from gantry to bail, where the boom is highest."""
HAUL = 1_000.0
"""How far the hook can be hauled in from where it is drawn."""


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """How the crane stands: the boom's angle."""

    boom: float

    @property
    def head(self) -> Point:
        """The pin of the head's sheaves."""
        return P + rot(self.boom, vec(v.BOOM.value, 0.0))

    @property
    def pendant(self) -> Point:
        """The pendants' pin."""
        return P + rot(self.boom, D)

    @property
    def span(self) -> float:
        """From the gantry's pin to the pendants'."""
        return float(np.hypot(*(self.pendant - G)))

    @property
    def rope(self) -> float:
        """Length of the ropes, from the gantry's pin to the bail's sheaves."""
        return self.span - Pose(HIGH).span + CLOSE

    @property
    def line(self) -> float:
        """Direction of ropes and pendants."""
        return direction(self.pendant - G)


RAISED = float(Pose(HIGH).head[1]) - v.LIFT_HEIGHT.value
"""From the pin of the head's sheaves down to the hook's middle, hauled in: it is then at the height that is printed."""


def boom_at(radius: float) -> float:
    """The boom's angle at which the hook hangs at a radius, millimetres."""
    return math.acos((radius - float(P[0])) / v.BOOM.value)


def values() -> dict[str, float]:
    """What the linkage gives, by the value's name; millimetres, kilopascals."""
    area = 2e-6 * v.SHOE.value * v.ON_GROUND.value
    return {
        v.FOOT.name: float(P[1]),
        v.LIFT_HEIGHT.name: float(Pose(HIGH).head[1]) - RAISED,
        v.PRESSURE.name: v.WEIGHT.value * 9.80665e-3 / area,
    }
