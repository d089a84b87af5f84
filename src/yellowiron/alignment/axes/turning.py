"""What turns about its own axis: wheels, sprockets, idlers, and the machine on its slewing bearing."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from yellowiron.alignment.axes.bodies import Body
from yellowiron.alignment.axes.directions import LEAST_WHEEL, wheel_direction
from yellowiron.alignment.axes.hinges import meeting_of
from yellowiron.alignment.axes.outlines import fitted_circle
from yellowiron.alignment.axes.values import Candidate, Frame, Round, plane_of
from yellowiron.alignment.features.solids import Cyl
from yellowiron.model.geometry import Floats

WHEEL = (LEAST_WHEEL, 0.2)
"""Radii of what is round in a wheel, in machine sizes."""
RING = 0.06
"""What is larger is no more likely to be one, in machine sizes."""
PIVOT_SPREAD = 0.002
"""How well a pivot of the scene's tree tells a slewing axis, in machine sizes, …"""
PIVOT_REACH = 0.05
"""… if it is this near to where the axis is guessed."""
BEARING = (0.012, 0.25)
"""… and in a slewing bearing."""


def wheel_candidate(wheel: Body, frame: Frame) -> Candidate:
    """The axis that a wheel is round about."""
    way = wheel_direction(wheel, frame.left)
    rounds = wheel.rounds(way.vector, WHEEL)
    plane = plane_of(way.vector)
    middle = 0.5 * (wheel.samples.min(axis=0) + wheel.samples.max(axis=0))
    height = float(middle @ way.vector)
    outline, off, radius = _outer_circle(wheel.samples @ plane.T)
    if rounds:
        center, score, spread = _commonest(rounds, plane, outline)
        if score > 0.0 and float(np.linalg.norm(center - outline)) < max(0.1 * radius, 3.0 * off):
            across = max(spread, 1e-4 * wheel.size)
            return Candidate(
                center @ plane + height * way.vector, way.vector, across, way.angle, 1.0, "what is round in it"
            )
    across = max(off, 0.001 * wheel.size)
    return Candidate(outline @ plane + height * way.vector, way.vector, across, way.angle, 0.5, "its outline")


def _outer_circle(flat: Floats) -> tuple[Floats, float, float]:
    """The circle through the outermost of points (n, 2) all around: centre, how well it is known, and radius."""
    center = 0.5 * (flat.min(axis=0) + flat.max(axis=0))
    rms = radius = float(np.ptp(flat, axis=0).max()) / 2
    for _ in range(3):
        delta = flat - center
        sector = np.floor((np.arctan2(delta[:, 1], delta[:, 0]) + math.pi) / (2 * math.pi) * 36).astype(np.int64)
        away = np.linalg.norm(delta, axis=1)
        rim = np.array([np.flatnonzero(sector == k)[np.argmax(away[sector == k])] for k in np.unique(sector)])
        rim = rim[away[rim] > 0.8 * float(np.median(away[rim]))]
        if len(rim) < 6:
            break
        center, radius = fitted_circle(flat[rim])
        rms = float(np.sqrt(((np.linalg.norm(flat[rim] - center, axis=1) - radius) ** 2).mean()))
    return center, 0.3 * rms + 0.005 * radius, radius


def _commonest(rounds: Sequence[Round], plane: Floats, near: Floats) -> tuple[Floats, float, float]:
    """The centre that most round things share, weighted by their size and how much of a circle they are, those near a
    place first: (centre, weight, spread)."""
    center = np.array([plane @ r.face.center for r in rounds])
    radius = np.array([r.face.radius for r in rounds])
    spread = np.array([r.spread for r in rounds])
    weight = radius * np.array([min(r.face.arc, 2 * math.pi) * r.quality for r in rounds])
    weight *= np.exp(-0.5 * (np.linalg.norm(center - near, axis=1) / (0.5 * radius.max())) ** 2)
    apart = np.linalg.norm(center[:, None] - center[None], axis=2)
    alike = apart < np.maximum(0.05 * np.minimum(radius[:, None], radius[None]), spread[:, None])
    total = alike @ weight
    best = int(np.argmax(np.round(total, 12)))
    kept = alike[best]
    share = weight[kept] / spread[kept] ** 2
    middle = share @ center[kept] / share.sum()
    scatter = float(np.sqrt((share * ((center[kept] - middle) ** 2).sum(axis=1)).sum() / share.sum()))
    return middle, float(total[best]), math.hypot(float(spread[kept].min()), scatter)


def slewing_candidate(a: Body, b: Body, frame: Frame, pivots: Floats | None = None) -> Candidate:
    """The upright axis on which one frame turns on the other: what is round about one upright line in both, most of
    all the bearing between them; else a pivot of the scene's tree (`pivots`, (n, 3)) near it, or the middle of where
    they meet, with much doubt."""
    up = frame.up if frame.up is not None else _flat_way([a, b])
    plane = plane_of(up)
    meeting = meeting_of(a, b)
    flat = meeting.points @ plane.T
    middle = 0.5 * (np.percentile(flat, 5, axis=0) + np.percentile(flat, 95, axis=0))
    height = float(meeting.center @ up)
    rounds = [(s, r) for s, body in enumerate((a, b)) for r in body.rounds(up, BEARING, box=meeting.box(0.02 * a.size))]
    best: tuple[float, Floats, float, str] | None = None
    if rounds:
        center = np.array([plane @ r.face.center for _, r in rounds])
        radius = np.array([r.face.radius for _, r in rounds])
        side = np.array([s for s, _ in rounds])
        arc = np.array([min(1.0, r.face.arc / (2 * math.pi)) for _, r in rounds])
        ends = np.array([[float((r.face.center - meeting.center) @ up), r.face.half] for _, r in rounds])
        gap = np.maximum(0.0, np.abs(ends[:, 0]) - ends[:, 1])
        # A counterweight's round back is larger than any bearing, and often about another line.
        weight = np.minimum(radius, RING * a.size) * arc**2 * np.exp(-gap / (0.03 * a.size))
        if frame.left is not None:
            sides = [body.samples @ frame.left for body in (a, b)]
            middles = np.array([0.5 * (side.min() + side.max()) for side in sides])
            off = np.abs((center @ plane @ frame.left)[:, None] - middles).min(axis=1)
            weight *= 0.4 + 0.6 * np.exp(-0.5 * (off / (0.01 * a.size)) ** 2)
        weight *= np.exp(-0.5 * (np.linalg.norm(center - middle, axis=1) / (0.08 * a.size)) ** 2)
        apart = np.linalg.norm(center[:, None] - center[None], axis=2)
        alike = apart < 0.06 * np.minimum(radius[:, None], radius[None])
        per_side = [np.where(alike & (side == s)[None], weight[None], 0.0).max(axis=1) for s in (0, 1)]
        score = np.maximum(*per_side) + np.minimum(*per_side)
        k = int(np.argmax(np.round(score, 12)))
        kept = alike[k] & (weight > 0.1 * weight[k])
        spread = np.array([r.spread for _, r in rounds])[kept]
        share = weight[kept] / spread**2
        place = share @ center[kept] / share.sum()
        scatter = float(np.sqrt((share * ((center[kept] - place) ** 2).sum(axis=1)).sum() / share.sum()))
        both = min(per_side[0][k], per_side[1][k]) > 0.2 * max(per_side[0][k], per_side[1][k])
        rivals = score[np.linalg.norm(center - place, axis=1) > 0.3 * radius[k]]
        doubt = float(rivals.max() / score[k]) if len(rivals) and score[k] > 0 else 0.0
        across = math.hypot(float(spread.min()), scatter) + (0.0 if both else 0.01 * a.size * doubt)
        if score[k] > 0.003 * a.size:
            best = (float(min(1.0, score[k] / (0.05 * a.size))), place, max(across, 2e-4 * a.size),
                    f"upright round faces of {'both bodies' if both else 'one body'}")  # fmt: skip
    if best is None:
        reach = float(np.linalg.norm(np.ptp(flat, axis=0))) / 2
        best = (0.1, middle, max(0.2 * reach, 0.01 * a.size), "the middle of where the bodies meet")
    if pivots is not None and best[2] > PIVOT_SPREAD * a.size:
        places = pivots @ plane.T
        away = np.linalg.norm(places - best[1], axis=1)
        k = int(np.argmin(np.round(away, 9)))
        if away[k] < PIVOT_REACH * a.size:
            best = (0.5, places[k], PIVOT_SPREAD * a.size, "a pivot of the scene's tree")
    lean = math.radians(0.3 if frame.up is not None else 2.0)
    return Candidate(best[1] @ plane + height * up, up, best[2], lean, best[0], best[3])


def _flat_way(bodies: Sequence[Body]) -> Floats:
    """The direction in which most of the flat surface faces among the three of least extent: a guess at the upright."""
    face = np.zeros((3, 3))
    for body in bodies:
        for s in body.solids:
            big: list[Cyl] = [c for c in s.cylinders if c.full and c.radius > BEARING[0] * body.size]
            for c in big:
                face += c.radius**2 * np.outer(c.direction, c.direction)
    if face.any():
        return np.asarray(np.linalg.eigh(face)[1][:, -1], dtype=np.float64)
    points = np.concatenate([b.samples for b in bodies])
    return np.asarray(np.linalg.eigh(np.cov((points - points.mean(axis=0)).T))[1][:, 0], dtype=np.float64)
