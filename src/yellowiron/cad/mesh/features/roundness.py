"""Cylinders through points: the least-squares fit, and what of a mesh lies on one. Metres."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.cad.mesh.features.soup import Flags, Indices, Soup
from yellowiron.cad.mesh.features.tolerances import FEWEST, LEAST, ROUGH, SMALL, WIDEST
from yellowiron.model.geometry import Floats

LEAN = 0.35
"""Sine of the most by which a triangle on a cylinder may lean from its surface: slivers do."""
_ROUNDS = 12


def across(direction: Floats) -> tuple[Floats, Floats]:
    """Two unit vectors that make a right-handed frame with a unit vector, theirs before it."""
    # Without numpy's cross product, which takes longer than all the rest of a small fit.
    x, y, z = direction.tolist()
    if abs(x) <= abs(y) and abs(x) <= abs(z):
        u = (0.0, z, -y)
    elif abs(y) <= abs(z):
        u = (-z, 0.0, x)
    else:
        u = (y, -x, 0.0)
    length = math.sqrt(u[0] ** 2 + u[1] ** 2 + u[2] ** 2)
    a, b, c = u[0] / length, u[1] / length, u[2] / length
    return np.array([a, b, c]), np.array([y * c - z * b, z * a - x * c, x * b - y * a])


@dataclass(frozen=True, eq=False)
class Round:
    """A cylinder: a point on its axis, the unit direction, the radius; `inner` where the material is outside.
    `triangles` are those of the mesh that lie on it."""

    point: Floats
    direction: Floats
    radius: float
    inner: bool
    triangles: Indices

    @property
    def least(self) -> float:
        """How far from it a point may be however small it is."""
        return min(LEAST, SMALL * self.radius)

    @property
    def slack(self) -> float:
        """How far from it a point may be and still be on it."""
        return max(ROUGH * self.radius, self.least)

    @functools.cached_property
    def frame(self) -> tuple[Floats, Floats]:
        """Two unit vectors across the axis, a right-handed frame with it."""
        return across(self.direction)

    def distances(self, points: Floats) -> Floats:
        """Distances of points (…, 3) from the axis."""
        u, v = self.frame
        offset = points - self.point
        return np.asarray(np.hypot(offset @ u, offset @ v))

    def along(self, points: Floats) -> Floats:
        """Coordinates of points (…, 3) along the axis, from `point`."""
        return np.asarray((points - self.point) @ self.direction)

    def angles(self, points: Floats) -> Floats:
        """Angles of points (…, 3) about the axis."""
        u, v = self.frame
        offset = points - self.point
        return np.arctan2(offset @ v, offset @ u)


def median(values: Floats | Indices) -> float:
    """The median, as `numpy.median`, which takes far longer for few."""
    ordered = np.sort(values)
    return float(0.5 * (ordered[(len(values) - 1) // 2] + ordered[len(values) // 2]))


def least(soup: Soup) -> float:
    """What the corners of a mesh may be off by from a plane."""
    return min(LEAST, 0.2 * SMALL * soup.size)


def fit(start: Round, points: Floats) -> Round | None:
    """The cylinder that points (n, 3) are nearest to, in the least-squares sense of their distances from its surface,
    by Gauss-Newton from `start`; None where that does not settle."""
    middle = points.mean(axis=0)
    point, direction, radius = start.point, start.direction, start.radius
    point = point + float((middle - point) @ direction) * direction
    reach = max(float(np.linalg.norm(points - middle, axis=1).max()), 1e-12)
    ones, ridge = np.ones(len(points)), 1e-12 * len(points) * np.eye(5)
    for _ in range(_ROUNDS):
        u, v = across(direction)
        offset = points - point
        a, b, z = offset @ u, offset @ v, offset @ direction
        radial = np.maximum(np.hypot(a, b), 1e-12)
        cosine, sine = a / radial, b / radial
        matrix = np.array([cosine, sine, cosine * z / reach, sine * z / reach, ones])
        step = np.linalg.solve(matrix @ matrix.T + ridge, matrix @ (radial - radius))
        if not np.isfinite(step).all() or abs(step[4]) > 0.9 * radius:
            return None
        point = point + step[0] * u + step[1] * v
        direction = direction + (step[2] * u + step[3] * v) / reach
        direction = direction / math.sqrt(direction.dot(direction))
        radius = float(radius + step[4])
        if radius <= 0.0:
            return None
        if float(np.abs(step).max()) < 1e-9 * reach:
            break
    return replace(start, point=point, direction=direction, radius=radius)


def lying_on(soup: Soup, cylinder: Round, among: Indices, slack: float) -> Indices:
    """Of the triangles `among`, those on a cylinder: all corners at its radius, within `slack` metres, facing along it,
    no wider than a strip may be."""
    left = among[np.abs(soup.normals[among] @ cylinder.direction) <= LEAN]  # the cheapest test first: few are left
    offset = soup.middles[left] - cylinder.point
    outward = offset - (offset @ cylinder.direction)[:, None] * cylinder.direction
    length = np.maximum(np.linalg.norm(outward, axis=1), 1e-12)
    facing = np.einsum("ij,ij->i", soup.normals[left], outward) / length
    left = left[(-facing if cylinder.inner else facing) > math.cos(0.75 * WIDEST)]
    radial = cylinder.distances(soup.points[soup.corners[left]])
    left = left[(np.abs(radial - cylinder.radius) <= slack).all(axis=1)]
    return left[widths(soup, cylinder, left) <= WIDEST]


def widths(soup: Soup, cylinder: Round, triangles: Indices) -> Floats:
    """The angle about the axis that each triangle covers."""
    angles = cylinder.angles(soup.points[soup.corners[triangles]])
    turned = (angles - angles[:, :1] + math.pi) % (math.tau) - math.pi
    return np.asarray(np.ptp(turned, axis=1))


def grown(soup: Soup, start: Round, seeds: Indices, free: Flags) -> Round | None:
    """The cylinder of the `seeds`, fitted to them, then to all free triangles near them that lie on it; None where
    they do not lie on one."""
    surest = lying_on(soup, start, seeds, start.slack)
    seeds = surest if len(surest) > max(FEWEST, len(seeds) // 4) else seeds
    first = soup.corners_of(seeds)
    current = fit(start, first)
    if current is None or median(np.abs(current.distances(first) - current.radius)) > 3.0 * current.slack:
        return None
    if len(lying_on(soup, current, seeds, current.slack)) < FEWEST:
        return None
    found = np.zeros(0, dtype=np.int64)
    for _ in range(4):
        middles = soup.middles[seeds]
        around = middles.mean(axis=0)
        reach = float(np.linalg.norm(middles - around, axis=1).max()) + current.radius
        near = np.array(soup.tree.query_ball_point(around, 1.5 * reach, return_sorted=True), dtype=np.int64)
        now = lying_on(soup, current, near[free[near]], current.slack)
        if len(now) < FEWEST:
            return None
        if np.array_equal(now, found):
            break
        found = seeds = now
        better = fit(current, soup.corners_of(found))
        if better is None:
            return None
        current = better
    return replace(current, triangles=found)


def trimmed(soup: Soup, cylinder: Round) -> Round | None:
    """The part of a cylinder's triangles that lies on one far better than all of them do (a pipe without the first
    rings of its bends); None where there is none."""
    longest = _long(soup, cylinder)
    current = fit(replace(cylinder, triangles=longest), soup.corners_of(longest))
    if current is None:
        return None
    rows = lying_on(soup, current, cylinder.triangles, max(soup.resolution, 1e-3 * cylinder.slack))
    if len(rows) < FEWEST or len(rows) == len(cylinder.triangles):
        return None
    better = fit(current, soup.corners_of(rows))
    return replace(better, triangles=rows) if better is not None else None


def _long(soup: Soup, cylinder: Round) -> Indices:
    """The triangles of a cylinder that reach farthest along it."""
    reach = np.ptp(cylinder.along(soup.points[soup.corners[cylinder.triangles]]), axis=1)
    return cylinder.triangles[reach > 0.9 * float(reach.max())]
