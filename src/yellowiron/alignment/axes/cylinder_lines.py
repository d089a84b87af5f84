"""The line of a hydraulic cylinder, from what is round along it in its barrel and its rod, else from their length."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from yellowiron.alignment.axes.bodies import Body, rounds_of, surface_points
from yellowiron.alignment.axes.values import Line, plane_of
from yellowiron.alignment.features.solids import Cyl
from yellowiron.model.geometry import Floats

RADII = (0.001, 0.05)
"""Radii of barrels and rods, in machine sizes."""
LONG = 1.0
"""A bar or a bore along a cylinder is at least this many radii long."""
ALONG = math.cos(math.radians(12.0))
"""Cosine up to which something round is along the cylinder's length."""
SAME_WAY = math.cos(math.radians(2.0))
SHORT, MIDDLE = 0.4, 0.2
"""A ring about a barrel is no longer than this share of the barrel, and its middle is no nearer to either end: rings
there are an eye's boss and the rod's gland."""
SECTORS, YOKE = 8, 5
"""A ring is all the way round: it has surface in each of so many sectors; the carrier's may be a yoke, which has some
in so many …"""
WITHIN, WITHOUT, WIDE = 0.7, 1.1, 4.0
"""… none nearer to the line than this share of the barrel's radius, some farther than this, and none than this."""

BY_LENGTH = "the length of its parts"
"""How a line is told that nothing round says."""


def cylinder_line(barrel: Body | None, rod: Body | None) -> Line | None:
    """The line of a cylinder of which both bodies or one of them is drawn; None for neither."""
    drawn = [body for body in (barrel, rod) if body is not None]
    if not drawn:
        return None
    guess = _long_way(drawn)
    faces = [(k, c) for k, body in enumerate(drawn) for c in _bars(_faces(body), guess)]
    line = _fitted(faces, guess, len(drawn))
    if line is None:
        direction = _wall_direction(drawn, guess)
        circles = [(k, c) for k, body in enumerate(drawn) for c in _bars(_circles(body, direction), direction)]
        line = _fitted(circles, direction, len(drawn))
        how = "round faces of few sides along it"
    else:
        how = "round faces along it"
    if line is None:
        line = _by_length(drawn, guess)
        how = BY_LENGTH
    origin, direction, across, angle = line
    if barrel is not None and rod is not None:
        ahead = float((np.median(rod.samples, axis=0) - np.median(barrel.samples, axis=0)) @ direction)
        direction = direction if ahead > 0 else -direction
    widest = barrel or rod
    assert widest is not None
    off = widest.samples - origin
    off = off - np.outer(off @ direction, direction)
    width = float(np.percentile(np.linalg.norm(off, axis=1), 60))
    return Line(origin, direction, across, angle, width, how)


def trunnion_of(line: Line, barrel: Body, carrier: Body) -> tuple[float, float] | None:
    """Where along a cylinder's line the ring is that holds its barrel between its ends, and half its length (metres):
    a trunnion, of the carrier or of the barrel itself. None where there is no such ring, or several."""
    own = line.along(barrel.samples)
    low, high = float(own.min()), float(own.max())
    plane = plane_of(line.direction)
    found = []
    for solid, least in (*((s, YOKE) for s in carrier.solids), *((s, SECTORS) for s in barrel.solids)):
        along = line.along(solid.points)
        start, end = float(along.min()), float(along.max())
        inner = low + MIDDLE * (high - low) < 0.5 * (start + end) < high - MIDDLE * (high - low)
        if not inner or end - start > SHORT * (high - low):
            continue
        flat = (surface_points(solid, 0.5 * line.width) - line.origin) @ plane.T
        radius = np.linalg.norm(flat, axis=1)
        sectors = np.floor(SECTORS * (np.arctan2(flat[:, 1], flat[:, 0]) / math.tau + 0.5)).astype(int) % SECTORS
        around = len(np.unique(sectors)) >= least
        if around and radius.min() > WITHIN * line.width and WITHOUT * line.width < radius.max() < WIDE * line.width:
            found.append((0.5 * (start + end), 0.5 * (end - start)))
    return found[0] if len(found) == 1 else None


def _long_way(bodies: list[Body]) -> Floats:
    """The principal direction of all their points; of long round faces the one nearest to it."""
    points = np.concatenate([b.samples for b in bodies])
    way = np.linalg.eigh(np.cov((points - points.mean(axis=0)).T))[1][:, -1]
    faces = [c for b in bodies for c in _faces(b) if 2 * c.half > 2 * c.radius]
    near = [c for c in faces if abs(float(c.direction @ way)) > math.cos(math.radians(25.0))]
    if near:
        weights: dict[int, float] = {
            k: sum(o.half * o.radius for o in near if abs(float(o.direction @ c.direction)) > SAME_WAY)
            for k, c in enumerate(near)
        }
        best = near[max(weights, key=lambda k: (round(weights[k], 9), -k))].direction
        way = best if float(best @ way) > 0 else -best
    return np.asarray(way, dtype=np.float64)


def _faces(body: Body) -> Iterable[Cyl]:
    low, high = RADII[0] * body.size, RADII[1] * body.size
    return [c for s in body.solids for c in s.cylinders if c.arc > 2.0 and low < c.radius < high]


def _circles(body: Body, direction: Floats) -> Iterable[Cyl]:
    low, high = RADII[0] * body.size, RADII[1] * body.size
    return [r.face for s in body.solids for r in rounds_of(s, direction, low, high) if r.face.arc > 2.0]


def _bars(faces: Iterable[Cyl], direction: Floats) -> list[Cyl]:
    return [c for c in faces if abs(float(c.direction @ direction)) > ALONG and 2 * c.half > LONG * c.radius]


def _wall_direction(bodies: list[Body], guess: Floats) -> Floats:
    """The direction that the walls along a cylinder have in common: across their normals."""
    second = np.zeros((3, 3))
    for body in bodies:
        for solid in body.solids:
            corners = solid.points[solid.shape.mesh.triangles]
            cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            double = np.linalg.norm(cross, axis=1)
            walls = cross[(np.abs(cross @ guess) < 0.25 * double) & (double > 1e-14)]
            # Weighted by area, times the cosine's square that length gives.
            second += (walls / np.maximum(np.linalg.norm(walls, axis=1), 1e-300)[:, None] ** 0.5).T @ (
                walls / np.maximum(np.linalg.norm(walls, axis=1), 1e-300)[:, None] ** 0.5
            )
    way = np.linalg.eigh(second)[1][:, 0]
    way = way if float(way @ guess) > 0 else -way
    return np.asarray(way if float(way @ guess) > ALONG else guess, dtype=np.float64)


def _fitted(faces: list[tuple[int, Cyl]], guess: Floats, bodies: int) -> tuple[Floats, Floats, float, float] | None:
    """The least-squares line through the axes of the faces that most of them share: (point, direction, across, angle);
    of twins side by side in the same two bodies the one midway. None without a face of every body."""
    if not faces:
        return None
    plane = plane_of(guess)
    flat = np.array([plane @ c.center for _, c in faces])
    radius = np.array([c.radius for _, c in faces])
    weight = np.array([c.radius * c.half * c.arc for _, c in faces])
    of = np.array([k for k, _ in faces])
    near = np.linalg.norm(flat[:, None] - flat[None], axis=2) < 0.35 * np.maximum(radius[:, None], radius[None])
    total = near @ weight * np.array([len(np.unique(of[row])) for row in near])
    best = int(np.argmax(np.round(total, 12)))
    groups = [near[best]]
    for k in np.argsort(-np.round(total, 12), kind="stable"):
        alike = total[k] > 0.6 * total[best] and abs(radius[k] - radius[best]) < 0.05 * radius[best]
        if alike and not any((near[k] & g).any() for g in groups):
            groups.append(near[k])
    lines = [_line([faces[k][1] for k in np.flatnonzero(g)], guess) for g in groups]
    direction = np.mean([d for _, d, _ in lines], axis=0)
    direction = direction / np.linalg.norm(direction)
    points = np.array([p for p, _, _ in lines])
    middle = points.mean(axis=0)
    length = max(s for _, _, s in lines)
    width = float(radius[groups[0]].max())
    across = 0.04 * width if len(np.unique(of[groups[0]])) == bodies else 0.1 * width
    return middle, direction, across, max(math.radians(0.2), across / max(length, 1e-9))


def _line(faces: list[Cyl], guess: Floats) -> tuple[Floats, Floats, float]:
    """(point, direction, length) of the total least-squares line through axis segments."""
    weight = np.array([c.radius * c.half * c.arc for c in faces])
    share = weight / weight.sum()
    center = np.array([c.center for c in faces])
    ways = np.array([c.direction if float(c.direction @ guess) > 0 else -c.direction for c in faces])
    half = np.array([c.half for c in faces])
    middle = share @ center
    arm = center - middle
    spread = (arm * share[:, None]).T @ arm + (ways * (share * half**2 / 3.0)[:, None]).T @ ways
    way = np.linalg.eigh(spread)[1][:, -1]
    way = way if float(way @ guess) > 0 else -way
    if float(way @ guess) < ALONG:
        way = share @ ways
        way = way / np.linalg.norm(way)
    reach = (center - middle) @ way
    return middle, way, float((reach + half).max() - (reach - half).min())


def _by_length(bodies: list[Body], guess: Floats) -> tuple[Floats, Floats, float, float]:
    """The principal direction, through the middle of the middle slices."""
    points = np.concatenate([b.samples for b in bodies])
    along = points @ guess
    low, high = np.percentile(along, [10, 90])
    plane = plane_of(guess)
    middles, widths = [], []
    for k in range(8):
        a, b = low + (high - low) * k / 8, low + (high - low) * (k + 1) / 8
        slice_ = points[(along >= a) & (along <= b)]
        if len(slice_) < 4:
            continue
        flat = slice_ @ plane.T
        box = np.array([flat.min(axis=0), flat.max(axis=0)])
        middles.append(box.mean(axis=0) @ plane + 0.5 * (a + b) * guess)
        widths.append(float(np.ptp(box, axis=0).max()))
    if len(middles) < 3:
        return points.mean(axis=0), guess, 0.5 * float(np.ptp(points @ plane.T, axis=0).max()), 0.2
    found = np.array(middles)
    middle = np.median(found, axis=0)
    width = float(np.median(widths))
    return middle, guess, 0.1 * width, max(0.01, 0.2 * width / max(high - low, 1e-9))
