"""Lines in space: the axis of several coaxial cylinders, and which cylinders share one. Metres, any one frame."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from yellowiron.mechanism.placement import Features
from yellowiron.mechanism.tolerances import SAME_ANGLE, SAME_OFFSET
from yellowiron.model.geometry import Floats

_FITTED_WEIGHT = 0.01
"""Weight of a feature fitted to triangles beside an exact one."""
_FITTED_LEAN = 1e-3
"""How much a fitted axis may lean, radians: what it may miss by grows with the distance."""


@dataclass(frozen=True, eq=False)
class Axis:
    """A line through `point` along the unit vector `direction`."""

    point: Floats
    direction: Floats

    def along(self, points: Floats) -> Floats:
        """(n,) coordinates of points along the line, from `point`."""
        return (points - self.point) @ self.direction

    def distance(self, points: Floats) -> Floats:
        """(n,) distances of points from the line."""
        offset = points - self.point
        return np.linalg.norm(offset - np.outer(offset @ self.direction, self.direction), axis=1)

    def foot(self, point: Floats) -> Floats:
        """The line's point nearest to a point."""
        return self.at(float((point - self.point) @ self.direction))

    def at(self, coordinate: float) -> Floats:
        """The point at a coordinate along the line."""
        return self.point + coordinate * self.direction

    def flipped(self) -> Axis:
        """The same line, the other way round."""
        return Axis(self.point, -self.direction)


def fit_axis(center: Floats, direction: Floats, length: Floats, weight: Floats) -> Axis:
    """The least-squares line through axis segments: the total least-squares line of points spread evenly over them.

    `center` (n, 3), `direction` (n, 3) unit, `length` (n,), `weight` (n,) > 0. Minimises Σ wᵢ · mean squared distance
    of segment i from the line, in closed form: the line passes through the weighted mean of the middles, along the
    first principal axis of Σ wᵢ [(mᵢ − m̄)(mᵢ − m̄)ᵀ + (lᵢ²/12) dᵢdᵢᵀ]. Exact segments of one axis give it exactly;
    a pin's left and right half steady each other by their distance.
    """
    share = weight / weight.sum()
    middle = share @ center
    arm = center - middle
    spread = (arm * share[:, None]).T @ arm + (direction * (share * length**2 / 12.0)[:, None]).T @ direction
    axis = np.linalg.eigh(spread)[1][:, -1]
    sense = direction[int(np.argmax(weight))]
    return Axis(middle, axis if axis @ sense >= 0.0 else -axis)


def axis_of(features: Features) -> Axis:
    """The joint axis of coaxial features, weighted by area, exact ones a hundredfold."""
    weight = features.area * np.where(features.exact, 1.0, _FITTED_WEIGHT)
    return fit_axis(features.center, features.direction, features.length, weight)


def on_axis(features: Features, line: Axis) -> NDArray[np.bool_]:
    """(n,) which features lie on a line, within `SAME_ANGLE` and `SAME_OFFSET` (fitted ones: more, with the
    distance)."""
    sine = np.linalg.norm(np.cross(features.direction, line.direction), axis=1)
    lean = np.where(features.exact, 0.0, _FITTED_LEAN * np.abs(line.along(features.center)))
    result: NDArray[np.bool_] = (sine < math.sin(SAME_ANGLE)) & (line.distance(features.center) < SAME_OFFSET + lean)
    return result


def coaxial_groups(features: Features) -> list[NDArray[np.int64]]:
    """Rows of features by axis, the group with the largest feature first. Each row is in one group."""
    left = np.lexsort((np.arange(len(features)), -features.area))
    groups = []
    while len(left):
        seed = left[0]
        rest = features.take(left)
        same = on_axis(rest, Axis(features.center[seed], features.direction[seed]))
        same[0] = True
        groups.append(left[same])
        left = left[~same]
    return groups


def residuals(features: Features, line: Axis) -> tuple[float, float]:
    """How far features are out of line: (largest angle in radians, largest offset in metres); exact ones where there
    are any."""
    judged = features.take(features.exact) if features.exact.any() else features
    sine = np.linalg.norm(np.cross(judged.direction, line.direction), axis=1)
    return float(np.arcsin(np.minimum(1.0, sine)).max()), float(line.distance(judged.center).max())


def span(features: Features, line: Axis) -> tuple[float, float]:
    """From where to where coaxial features reach along their line."""
    middle = line.along(features.center)
    return float((middle - features.length / 2).min()), float((middle + features.length / 2).max())


def symmetry_axis(points: Floats) -> Axis:
    """A guess at the axis of a round part without features: the principal axis whose spread differs most from the
    others'."""
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    values, vectors = np.linalg.eigh(np.cov((points - middle).T))
    odd = 0 if values[1] - values[0] > values[2] - values[1] else 2
    return Axis(middle, vectors[:, odd])


def machine_sense(direction: Floats) -> Floats:
    """A pivot's axis as all of ours point: pitch to +Y, vertical to +Z, lengthwise to +X; round-off becomes zero."""
    size = np.abs(direction)
    # Near a tie the vertical wins, then the lateral: the order must not hang on round-off.
    main = next(i for i in (2, 1, 0) if size[i] > size.max() - 1e-3)
    signed = direction if direction[main] > 0.0 else -direction
    cleaned = np.where(np.abs(signed) < 1e-13, 0.0, signed)
    return np.asarray(cleaned / np.linalg.norm(cleaned), dtype=np.float64)
