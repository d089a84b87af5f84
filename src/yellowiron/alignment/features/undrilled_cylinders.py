"""Hydraulic cylinders of machines that are drawn to be looked at: without a bore, or with the rod out of its place.

A barrel may be a solid bar, with a thinner one in line with it. Those that are drawn as they are made: `cylinders`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from yellowiron.alignment.features.cylinders import DrawnCylinder, Pair, crossing, with_coaxial_parts
from yellowiron.alignment.features.solids import Cyl, Solid, coaxial
from yellowiron.alignment.tolerances import NEARLY_PARALLEL, PARALLEL, ROUND_ARC, TWIN

FILLING = 0.85
"""A rod that is not in its barrel fills the bore that it belongs to: it has at least this share of its radius."""


def solid_cylinders_of(
    solids: tuple[Solid, ...], cylinders: list[DrawnCylinder], tolerance: float
) -> list[DrawnCylinder]:
    """Hydraulic cylinders drawn without a bore: a bar, and in line with it a thinner one that comes out of its end.
    `cylinders` are those found so far.

    Twins that share their two parts are one cylinder, in the middle between them. `bore` is the barrel's outer radius.
    """
    taken = {i for cylinder in cylinders for i in cylinder.barrel | cylinder.rod}
    pairs = list(_bars_in_line([s for s in solids if s.index not in taken], solids, tolerance))
    found: list[DrawnCylinder] = []
    for best in sorted(pairs, key=lambda p: (-round(p.score, 6), p.tube.index, p.bar.index)):
        if best.tube.index in taken or best.bar.index in taken:
            continue
        taken |= {best.tube.index, best.bar.index}
        twins = [replace(p, direction=best.direction) for p in pairs if _is_twin(p, best)]
        halves = [with_coaxial_parts(p, solids, taken, tolerance) for p in twins]
        rod = frozenset().union(*(h.rod for h in halves))
        barrel = frozenset().union(*(h.barrel for h in halves)) - rod
        taken |= barrel | rod
        origin = np.asarray(np.mean([p.bore.center for p in twins], axis=0))
        radii = best.bore.radius, best.shaft.radius
        found.append(DrawnCylinder(barrel, rod, origin, best.direction, *radii, hollow=False, count=len(twins)))
    return found


def _bars_in_line(free: list[Solid], solids: tuple[Solid, ...], tolerance: float) -> Iterator[Pair]:
    """Every bar of a part, and a thinner one of another part that comes out of its end."""
    bars = [(s, c) for s in free for c in s.cylinders if c.full and not c.inner and c.half > c.radius]
    eyes = [c for s in solids for c in s.cylinders if c.arc > ROUND_ARC]
    centers = np.array([c.center for _, c in bars]).reshape(-1, 3)
    directions = np.array([c.direction for _, c in bars]).reshape(-1, 3)
    radii = np.array([c.radius for _, c in bars])
    for tube, thick in bars:
        if thick.half <= 2 * thick.radius:
            continue
        delta = centers - thick.center
        off = np.linalg.norm(delta - np.outer(delta @ thick.direction, thick.direction), axis=1)
        parallel = np.abs(directions @ thick.direction) > NEARLY_PARALLEL
        in_line = (off <= max(tolerance, 0.05 * thick.radius)) & parallel
        for k in np.flatnonzero(in_line & (radii < thick.radius)).tolist():
            bar, thin = bars[k]
            if tube.index != bar.index and (score := _score(thick, thin, eyes, tolerance)) > 0.0:
                ahead = float((thin.center - thick.center) @ thick.direction) > 0
                yield Pair(tube, thick, bar, thin, thick.direction if ahead else -thick.direction, score)


def _is_twin(pair: Pair, best: Pair) -> bool:
    """True for a pair itself, and for its twin beside it in the same two parts."""
    return (
        (pair.tube.index, pair.bar.index) == (best.tube.index, best.bar.index)
        and pair.score > 0.5 * best.score
        and abs(float(pair.bore.direction @ best.bore.direction)) > PARALLEL
        and abs(pair.bore.radius - best.bore.radius) < TWIN * best.bore.radius
        and abs(pair.shaft.radius - best.shaft.radius) < TWIN * best.shaft.radius
    )


def apart_cylinders_of(
    solids: tuple[Solid, ...], cylinders: list[DrawnCylinder], tolerance: float
) -> list[DrawnCylinder]:
    """Hydraulic cylinders whose rod is not drawn in its place: a long bore, and in line with it a long bar of another
    part that fills it, beside it or in it, each part with an eye across. `cylinders` are those found so far.

    The barrel's eye says which end is closed: the direction is from it through the bore.
    """
    taken = {i for cylinder in cylinders for i in cylinder.barrel | cylinder.rod}
    pairs = _rods_apart([s for s in solids if s.index not in taken], tolerance)
    found: list[DrawnCylinder] = []
    for pair in sorted(pairs, key=lambda p: (-round(p.score, 9), p.tube.index, p.bar.index)):
        if {pair.tube.index, pair.bar.index} & taken:
            continue
        taken |= {pair.tube.index, pair.bar.index}
        bore, shaft = pair.bore, pair.shaft
        ends = frozenset({pair.tube.index}), frozenset({pair.bar.index})
        reach = shaft.interval(bore.center, pair.direction)
        inside = min(reach[1], bore.half) - max(reach[0], -bore.half) > bore.radius and reach[1] > bore.half
        found.append(DrawnCylinder(*ends, bore.center, pair.direction, bore.radius, shaft.radius, apart=not inside))
    return found


def _rods_apart(free: list[Solid], tolerance: float) -> Iterator[Pair]:
    """Every long bore, and a long bar in line with it that would fill it, at most a barrel's length away."""
    tubes = [(s, c) for s in free for c in s.cylinders if c.inner and c.full and 2 * c.half > 3.5 * c.radius]
    shafts = [
        (s, c)
        for s in free
        if s.shaft is not None
        for c in [s.shaft]
        if 2 * c.half > 4 * c.radius and 2 * c.half > 0.4 * s.size
    ]
    for tube, bore in tubes:
        for bar, shaft in shafts:
            fills = FILLING * bore.radius < shaft.radius < 1.004 * bore.radius + 0.2 * tolerance
            if bar.index == tube.index or not fills or not coaxial(bore, shaft, 0.02, tolerance):
                continue
            low, high = bar.span(bore.center, bore.direction)
            near, far = tube.span(bore.center, bore.direction)
            own = _eye(tube, bore)
            if own is None or _eye(bar, bore) is None or max(low - far, near - high) > far - near:
                continue
            direction = bore.direction if own < 0 else -bore.direction
            yield Pair(tube, bore, bar, shaft, direction, min(bore.half, shaft.half) * bore.radius)


def _eye(solid: Solid, tube: Cyl) -> float | None:
    """Where along a cylinder's axis a part has a round eye across it: the outermost, from the cylinder's middle."""
    places = [
        place
        for c in solid.cylinders
        if c.full and (place := crossing(c, tube.center, tube.direction, tube.radius)) is not None
    ]
    return max(places, key=abs, default=None)


def _score(thick: Cyl, thin: Cyl, eyes: list[Cyl], tolerance: float) -> float:
    """How much speaks for a barrel and its rod: the shorter one's length; 0 where they are none."""
    if not 0.2 * thick.radius < thin.radius < 0.95 * thick.radius or not coaxial(thick, thin, 0.05, tolerance):
        return 0.0
    direction = thick.direction
    low, high = thin.interval(thick.center, direction)
    if low + high < 0:
        direction, low, high = -direction, -high, -low
    end = thick.half
    # The rod starts in the barrel, or right before it, and comes out.
    if low > end + 1.5 * thick.radius or high < end + thin.radius or low < -end - thick.radius:
        return 0.0
    reach = 6.0 * thick.radius
    places = [p for e in eyes if (p := crossing(e, thick.center, direction, thick.radius)) is not None]
    behind = any(-end - reach < p < 0.0 for p in places)
    ahead = any(max(end, high - reach) < p < high + reach for p in places)
    return 2.0 * min(thick.half, thin.half) if behind and ahead else 0.0
