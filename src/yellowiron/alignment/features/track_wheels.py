"""The wheels inside a track's row of shoes: round things that turn about lines across it, and their bolts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.alignment.features.solids import Solid, coaxial
from yellowiron.alignment.tolerances import PARALLEL_TWINS
from yellowiron.model.geometry import Floats

Rings = list[tuple[Floats, list[int]]]
"""Round things by their places (2,) in the loop: the solids about one line."""


@dataclass(frozen=True, eq=False)
class TrackWheel:
    """A wheel inside a track: its solids, a point of its axis, its radius in metres, and the radius of its rim as a
    share of it: 1 for a smooth one, less for teeth."""

    members: tuple[int, ...]
    center: Floats
    radius: float
    rim: float


@dataclass(frozen=True, eq=False)
class _Loop:
    """A row of shoes seen from the side: the unit `axis` across it, its `middle` (3,), the `plane` (2, 3) that it is
    drawn on, the shoes' places there in order (`outline`, (n, 2)), their `width` across and their pitch. Metres."""

    axis: Floats
    middle: Floats
    plane: Floats
    outline: Floats
    width: float
    pitch: float


def track_wheels_of(row: list[int], axis: Floats, solids: Sequence[Solid], taken: set[int]) -> list[TrackWheel]:
    """The round hollow things inside a loop that turn about lines across it, those on one line together; where nothing
    there is hollow, as in models drawn to be looked at, the widest solid one on each line. `row`: the shoes' main
    parts; `taken` solids are no wheels."""
    loop = _loop(row, axis, solids)
    rings = _rings(loop, solids, taken)
    hollow = [(place, [i for i in members if solids[i].hole > 0.0]) for place, members in rings]
    if any(members for _, members in hollow):
        rings = [(place, members) for place, members in hollow if members]
    else:
        rings = [(place, [_widest(members, solids)]) for place, members in rings]
    wheels = []
    for place, members in rings:
        main = _widest(members, solids)
        radius = solids[main].reach
        gap = float(np.linalg.norm(loop.outline - place, axis=1).min()) - radius
        if gap < 1.2 * loop.pitch and radius > 0.15 * loop.pitch:
            bolts = _bolts(place, radius, loop, solids, taken | set(members))
            center = loop.middle + place @ loop.plane
            others = (i for i in members if i != main)
            wheels.append(TrackWheel((main, *others, *bolts), center, radius, _rim(solids[main])))
    return wheels


def _loop(row: list[int], axis: Floats, solids: Sequence[Solid]) -> _Loop:
    centers = np.array([solids[i].center for i in row])
    middle = centers.mean(axis=0)
    plane = np.linalg.svd(axis[None, :])[2][1:]
    outline = (centers - middle) @ plane.T
    width = max(float(np.ptp(solids[i].points @ axis)) for i in row[:3])
    pitch = float(np.median(np.linalg.norm(np.roll(outline, -1, axis=0) - outline, axis=1)))
    return _Loop(axis, middle, plane, outline, width, pitch)


def _rings(loop: _Loop, solids: Sequence[Solid], taken: set[int]) -> Rings:
    """The round things inside a loop, mostly between its sides."""
    rings: Rings = []
    for s in solids:
        if s.index in taken or s.axis is None or abs(float(s.axis.direction @ loop.axis)) < PARALLEL_TWINS:
            continue
        place = loop.plane @ (s.axis.center - loop.middle)
        low, high = s.span(loop.middle, loop.axis)
        across = min(high, 0.5 * loop.width) - max(low, -0.5 * loop.width)
        if across < 0.5 * (high - low) or not _inside(place, loop.outline):
            continue
        for at, members in rings:
            if float(np.linalg.norm(at - place)) < 0.05 * loop.pitch:
                members.append(s.index)
                break
        else:
            rings.append((place, [s.index]))
    return rings


def _widest(members: list[int], solids: Sequence[Solid]) -> int:
    return max(members, key=lambda i: (round(solids[i].reach, 5), -i))


def _inside(point: Floats, loop: Floats) -> bool:
    """Whether a point (2,) is inside a closed polygon (n, 2)."""
    a, b = loop, np.roll(loop, -1, axis=0)
    crosses = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        at = a[:, 0] + (point[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    return bool(np.count_nonzero(crosses & (point[0] < at)) % 2)


def _bolts(place: Floats, radius: float, loop: _Loop, solids: Sequence[Solid], others: set[int]) -> list[int]:
    """Bolts of a wheel: three or more equal bars along its axis, at one distance from it and within its rim."""
    circles: dict[tuple[float, float, float], list[int]] = {}
    for s in solids:
        if s.index in others or s.shaft is None or abs(float(s.shaft.direction @ loop.axis)) < PARALLEL_TWINS:
            continue
        away = float(np.linalg.norm(loop.plane @ (s.shaft.center - loop.middle) - place))
        low, high = s.span(loop.middle, loop.axis)
        if 0.05 * radius < away < radius and abs(0.5 * (low + high)) < 0.5 * loop.width:
            circles.setdefault((round(s.volume, 8), round(away, 3), round(s.shaft.radius, 4)), []).append(s.index)
    return [i for members in circles.values() if len(members) >= 3 for i in members]


def _rim(solid: Solid) -> float:
    """Radius of the outermost whole cylinder about its axis, as a share of its reach."""
    assert solid.axis is not None
    outer = [c.radius for c in solid.cylinders if not c.inner and c.full and coaxial(c, solid.axis, 0.05)]
    return max(outer, default=0.0) / solid.reach
