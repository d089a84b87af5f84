"""What a machine stands on: the ground plane z = 0, blocks on it, and the bodies that touch them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism, chained, rolling

TOUCHING = 0.02
"""Metres: a body that comes this near to the ground as drawn stands on it."""
UPRIGHT = 0.9
"""Least vertical part of a unit axis about which a body slews."""

ALONG = 0.9
"""Least part along x of a unit axis about which a body rolls."""

GROUND_FRICTION = 0.7
"""Of ground and blocks; the ground in the exported MJCF has the same."""


@dataclass(frozen=True, eq=False)
class Block:
    """A block on the ground, fixed to the world, with a ramp at both ends in x: its `middle` on the ground (x, y), the
    `length` of its top, its `width`, `height` and the length `run` of each ramp, metres. Engines differ in what a wheel
    does at a sharp edge, and agree on a ramp."""

    middle: tuple[float, float]
    length: float
    width: float
    height: float
    run: float

    @property
    def corners(self) -> Floats:
        """(8, 3), world frame: the convex hull is the block."""
        x, y = self.middle
        low, high = 0.5 * self.length + self.run, 0.5 * self.length
        rows = [
            (x + sx * half, y + sy * 0.5 * self.width, z)
            for half, z in ((low, 0.0), (high, self.height))
            for sx in (-1.0, 1.0)
            for sy in (-1.0, 1.0)
        ]
        return np.array(rows, dtype=np.float64)

    def surface(self, x: Floats, y: Floats) -> Floats:
        """Height of ground and block at points."""
        ramp = (0.5 * self.length + self.run - np.abs(x - self.middle[0])) / self.run
        inside = np.abs(y - self.middle[1]) <= 0.5 * self.width
        return np.asarray(np.where(inside, self.height * np.clip(ramp, 0.0, 1.0), 0.0), dtype=np.float64)


def usual_base(mechanism: Mechanism) -> Literal["fixed", "floating"]:
    """In the air, or on the ground for a machine of which a part rolls freely about its long axis, as an articulated
    truck's trailer does: with nothing under its wheels it would turn over."""
    rolls = any(j.swings and j.lower is None and abs(j.axis[0]) > ALONG for j in mechanism.joints)
    return "floating" if rolls else "fixed"


def standing_bodies(mechanism: Mechanism) -> tuple[str, ...]:
    """The bodies whose lowest point is on the ground (z = 0) in the drawn pose: wheels, tracks, feet. Of a machine that
    lies in rings of track shoes every shoe, and the wheels that they run on."""
    down = {b.name for b in mechanism.bodies if len(b.hull) and float(np.asarray(b.hull)[:, 2].min()) < TOUCHING}
    if mechanism.floating:
        slewing = {j.body1 for j in mechanism.joints if abs(j.axis[2]) > UPRIGHT}
        down |= chained(mechanism) | (rolling(mechanism) - slewing)
    return tuple(b.name for b in mechanism.bodies if b.name in down)
