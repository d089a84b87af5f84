"""What an axis estimate is made of. Metres and radians, CAD frame."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.alignment.features.solids import Cyl
from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import angle_between_lines, distance_from_line

SURE_QUALITY = 0.35
"""What an axis is more than a guess from: with 0.35 to 0.5, 19 of 22 of eighteen models of strangers were right, and
the others known to 7 % of the height and worse; with 0.1 to 0.2, 3 of 12."""
RIVAL_QUALITY = 1.5
"""So many times as much must speak for a line as for another before it goes before what was found otherwise."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """A line that a joint's axis may be: through `origin` (3,) along the unit `direction`, `across` and `angle` as of
    an `AxisEstimate`, `quality` in [0, 1] for how much speaks for it, `how` in words; whether it `rests_on_round`
    things or on nothing but where bodies meet."""

    origin: Floats
    direction: Floats
    across: float
    angle: float
    quality: float
    how: str
    rests_on_round: bool = True


@dataclass(frozen=True, eq=False)
class AxisEstimate:
    """A joint's axis as far as the drawing tells: the line through `origin` (3,) along the unit `direction`.

    The true axis is within `across` metres of it, measured across, with a probability of about two thirds, and within
    twice that with one of about 95 %; the same for `angle`, radians. `how` says in words what it rests on, `quality` in
    [0, 1] how much speaks for it; `candidates` are other lines that could be it, the best first.
    """

    joint: str
    origin: Floats
    direction: Floats
    across: float
    angle: float
    how: str
    candidates: tuple[Candidate, ...] = ()
    quality: float = 1.0

    def beats(self, origin: Sequence[float], direction: Sequence[float]) -> bool:
        """Whether another line can not be this axis and much less speaks for it, if anything."""
        if self.holds(origin, direction):
            return False
        point, way = np.asarray(origin, dtype=np.float64), np.asarray(direction, dtype=np.float64)
        rivals = [
            c.quality
            for c in self.candidates
            if distance_from_line(c.origin, point, way) < max(c.across, self.across)
            and angle_between_lines(c.direction, way) < math.radians(2.0)
        ]
        return self.quality > max([SURE_QUALITY, *(RIVAL_QUALITY * q for q in rivals)])

    def holds(self, origin: Sequence[float], direction: Sequence[float]) -> bool:
        """Whether another line could be the same axis: within three sigma across it, and of its angle or 2°."""
        way = np.asarray(direction, dtype=np.float64)
        apart = distance_from_line(self.origin, np.asarray(origin, dtype=np.float64), way)
        return apart < 3.0 * self.across and angle_between_lines(self.direction, way) < max(
            3.0 * self.angle, math.radians(2.0)
        )


@dataclass(frozen=True, eq=False)
class Round:
    """Something round about an axis: `face` has its place, `spread` the one-sigma uncertainty of its centre across it
    (metres), `quality` in [0, 1] how much a thing of its kind speaks for a pivot, `what` its name in words."""

    face: Cyl
    spread: float
    quality: float
    what: str
    solid: int


@dataclass(frozen=True, eq=False)
class Line:
    """The line of a hydraulic cylinder: `direction` from the barrel's foot towards the rod's end; `width` is its outer
    radius."""

    origin: Floats
    direction: Floats
    across: float
    angle: float
    width: float
    how: str

    def along(self, points: Floats) -> Floats:
        """(n,) coordinates of points (n, 3) along the line, from `origin`."""
        return np.asarray((points - self.origin) @ self.direction, dtype=np.float64)


@dataclass(frozen=True, eq=False)
class Frame:
    """The machine's unit directions in the CAD frame, as far as they are known."""

    forward: Floats | None = None
    left: Floats | None = None
    up: Floats | None = None

    def along(self, direction: str | None) -> Floats | None:
        """(3,) what a template calls `lateral`, `vertical` or `lengthwise`; None where that is not known."""
        return {"lateral": self.left, "vertical": self.up, "lengthwise": self.forward}.get(direction or "")


def plane_of(direction: Floats) -> Floats:
    """(2, 3) two unit vectors across a direction and each other, the same for the same direction."""
    first = np.eye(3)[int(np.argmin(np.abs(direction)))]
    u = np.cross(direction, first)
    u = u / np.linalg.norm(u)
    return np.stack([u, np.cross(direction, u)])
