"""Machines that are drawn to be looked at: pins without holes for them, hydraulic cylinders without a bore.

Such a model shows a pin as a bar that runs through solid plates, and a barrel as a solid bar with a thinner one in line
with it. What a bar runs through, near its axis, it may turn in.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from yellowiron.alignment.features.contacts import Fit
from yellowiron.alignment.features.cylinders import DrawnCylinder, Pair, crossing, grown
from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.solids import Cyl, Solid, coaxial
from yellowiron.alignment.tolerances import (
    LEAST_PIVOT,
    LEAST_SLEWING,
    NEARLY_PARALLEL,
    PARALLEL,
    PARALLEL_BY_EYE,
    ROUND_ARC,
    TWIN,
)
from yellowiron.model.geometry import Floats

CORE = 0.6
"""A bar runs through a part that is within this share of its radius from its axis."""
LEAST = 0.1
"""A bar runs through a part over at least this share of its radius; less is a part that it ends at."""
RIM = 0.12
"""Points of a hole's edge are this near to the bar's surface, as a share of its radius …"""
SECTORS = 6
"""… in all sectors around it but one."""
NEAR = 0.05
"""What stands on a turntable is no further from it than this share of its radius."""
FILLING = 0.85
"""A rod that is not in its barrel fills the bore that it belongs to: it has at least this share of its radius."""
WHOLE = 0.5
"""The pieces of a bar make up at least this share of it."""


def pierced_fits_of(
    solids: tuple[Solid, ...], fits: list[Fit], cylinders: Iterable[DrawnCylinder], touch: Touch, size: float
) -> list[Fit]:
    """A fit for every part that a pin without a single hole runs through; and for two parts that have no pin between
    them, where the bar that one of them has runs through the other. None in a model that has holes for its pins.

    `inner` is the pin, or the part that has the bar.
    """
    taken = {i for cylinder in cylinders for i in cylinder.barrel | cylinder.rod}
    held = {f.inner for f in fits}
    pins = [s for s in solids if s.shaft is not None and s.index not in taken | held]
    found = [fit for pin in pins for fit in _through(pin, _bars(pin, size), solids, touch)]
    # A pin runs through two parts at least; what is in one only is a boss or a knob of it.
    hosts: dict[int, set[int]] = {}
    for fit in found:
        hosts.setdefault(fit.inner, set()).add(fit.outer)
    found = [fit for fit in found if len(hosts[fit.inner]) > 1]
    if _bored(solids, fits) > sum(len(around) > 1 for around in hosts.values()):
        return []
    pinned = {frozenset((a, b)) for around in hosts.values() if len(around) > 1 for a in around for b in around}
    pinned |= {frozenset((f.inner, f.outer)) for f in fits}
    loose = {s.index for s in pins if len(hosts.get(s.index, ())) < 2}
    axes = [cylinder.direction for cylinder in cylinders]
    for solid in solids:
        if solid.index in loose or (solid.shaft is not None and solid.index not in taken):
            continue
        bars = [c for c in _bars(solid, size) if not (solid.index in taken and _along(c, axes))]
        for fit in _through(solid, bars, solids, touch):
            if frozenset((fit.inner, fit.outer)) not in pinned and fit.outer not in hosts:
                found.append(fit)
    apart = {s.index for s in solids if s.index in taken or s.shaft is not None or s.axis is not None}
    joined = pinned | {frozenset((f.inner, f.outer)) for f in found}
    bodies = [s for s in solids if s.index not in apart]
    tables = _turntables(bodies, touch, size)
    found += [fit for fit in tables if frozenset((fit.inner, fit.outer)) not in joined]
    joined |= {frozenset((f.inner, f.outer)) for f in tables}
    eyes = [fit for s in bodies for fit in _through(s, _between_knuckles(s, size), solids, touch)]
    return found + [f for f in eyes if f.outer not in apart and frozenset((f.inner, f.outer)) not in joined]


def interrupted_fits_of(solids: tuple[Solid, ...], fits: list[Fit], tolerance: float) -> list[Fit]:
    """A fit for every empty bore on a bar of which only pieces are drawn: equal ones in line of one part, what is
    between them being inside of that part's other shapes. For pairs of parts without a fit."""
    joined = {frozenset((f.inner, f.outer)) for f in fits}
    filled = {id(f.bore) for f in fits}
    empty = [(s.index, c) for s in solids for c in s.cylinders if c.inner and c.full and id(c) not in filled]
    found: dict[tuple[int, int], Fit] = {}
    for solid in solids:
        pieces = [c for c in solid.cylinders if c.full and not c.inner]
        for k, one in enumerate(pieces):
            bar = _whole_bar(one, pieces[k + 1 :], tolerance)
            if bar is None:
                continue
            for outer, bore in empty:
                pair = frozenset((solid.index, outer))
                if (
                    outer == solid.index
                    or pair in joined
                    or abs(bore.radius - bar.radius) > max(tolerance, 0.03 * bar.radius)
                ):
                    continue
                low, high = bore.interval(bar.center, bar.direction)
                inside = low > -bar.half - tolerance and high < bar.half + tolerance
                if not inside or not coaxial(bar, bore, 0.03, tolerance):
                    continue
                best = found.get((solid.index, outer))
                if best is None or 2 * bore.half > best.overlap:
                    found[solid.index, outer] = Fit(solid.index, outer, bar, bore, 2 * bore.half, bore.off(bar.center))
    return [found[key] for key in sorted(found)]


def _whole_bar(one: Cyl, others: list[Cyl], tolerance: float) -> Cyl | None:
    """The bar that a piece and the equal pieces in line with it are of; None for a piece alone."""
    equal = [c for c in others if abs(c.radius - one.radius) < 0.01 * one.radius and coaxial(c, one, 0.02, tolerance)]
    spans = [c.interval(one.center, one.direction) for c in (one, *equal)]
    low, high = min(a for a, _ in spans), max(b for _, b in spans)
    drawn = sum(b - a for a, b in spans)
    if not equal or drawn < WHOLE * (high - low):
        return None
    return replace(one, center=one.center + 0.5 * (low + high) * one.direction, half=0.5 * (high - low))


def _between_knuckles(solid: Solid, size: float) -> list[Cyl]:
    """Bars between two like knuckles of a part that are in line, as of a fork: from one's outer end to the other's."""
    stout = [k for k in solid.knuckles if LEAST_PIVOT * size < k.radius < LEAST_SLEWING * size]
    bars = []
    for i, one in enumerate(stout):
        for other in stout[i + 1 :]:
            delta = other.center - one.center
            apart = float(np.linalg.norm(delta))
            alike = abs(one.radius - other.radius) < 0.1 * one.radius and apart > one.half + other.half
            if not alike or abs(float(one.direction @ other.direction)) < PARALLEL_BY_EYE:
                continue
            if one.off(other.center) > 0.3 * one.radius:
                continue
            middle = one.center + 0.5 * delta
            bars.append(replace(one, center=middle, direction=delta / apart, half=0.5 * apart + one.half))
    return bars


def _turntables(solids: list[Solid], touch: Touch, size: float) -> list[Fit]:
    """A fit for two parts of which one has a wide round base that ends at the other: the widest for each pair."""
    best: dict[frozenset[int], Fit] = {}
    for solid in solids:
        for base in solid.cylinders:
            if base.inner or not base.full or base.radius < LEAST_SLEWING * size:
                continue
            gap = NEAR * base.radius
            reach = base.half * np.abs(base.direction) + gap
            for other in solids:
                if other.index == solid.index or (other.low > base.center + reach).any():
                    continue
                if (other.high < base.center - reach).any():
                    continue
                low, high = other.span(base.center, base.direction)
                ends_above = low > base.half - LEAST * base.radius
                ends_below = high < LEAST * base.radius - base.half
                longer = replace(base, half=base.half + gap)
                if not (ends_above or ends_below) or not touch.pierced(other.index, longer, CORE * base.radius):
                    continue
                pair = frozenset((solid.index, other.index))
                if pair not in best or base.radius > best[pair].shaft.radius:
                    best[pair] = Fit(solid.index, other.index, base, base, 0.0, 0.0)
    return [best[pair] for pair in sorted(best, key=sorted)]


def _bored(solids: tuple[Solid, ...], fits: list[Fit]) -> int:
    """How many pins there are that run through holes of two parts or more."""
    hosts: dict[int, set[int]] = {}
    for fit in fits:
        if solids[fit.inner].shaft is not None:
            hosts.setdefault(fit.inner, set()).add(fit.outer)
    return sum(len(around) > 1 for around in hosts.values())


def _bars(solid: Solid, size: float) -> list[Cyl]:
    """The solid round bars of a part that are stout enough for a pivot."""
    bars = [c for c in solid.cylinders if c.full and not c.inner and c.radius > LEAST_PIVOT * size]
    holes = [c for c in solid.cylinders if c.inner and c.full]
    return [c for c in bars if not any(h.radius > 0.4 * c.radius and coaxial(h, c, 0.1) for h in holes)]


def _along(bar: Cyl, axes: list[Floats]) -> bool:
    return any(abs(float(bar.direction @ d)) > PARALLEL for d in axes)


def _through(solid: Solid, bars: list[Cyl], solids: tuple[Solid, ...], touch: Touch) -> list[Fit]:
    """One fit for each part that bars of a solid run through: the longest."""
    best: dict[int, Fit] = {}
    for bar in bars:
        reach = bar.half * np.abs(bar.direction) + bar.radius
        for other in (solids[i] for i in touch.reaching(bar.center - reach, bar.center + reach)):
            if other.index == solid.index or (other.slight and other.shape.closed):
                continue
            low, high = other.span(bar.center, bar.direction)
            low, high = max(low, -bar.half), min(high, bar.half)
            if high - low < LEAST * bar.radius:
                continue
            if not (_rimmed(other, bar) or touch.pierced(other.index, bar, CORE * bar.radius)):
                continue
            middle = bar.center + 0.5 * (low + high) * bar.direction
            hole = replace(bar, center=middle, half=0.5 * (high - low), inner=True)
            fit = Fit(solid.index, other.index, bar, hole, high - low, 0.0)
            if other.index not in best or fit.overlap > best[other.index].overlap:
                best[other.index] = fit
    return [best[k] for k in sorted(best)]


def _rimmed(solid: Solid, bar: Cyl) -> bool:
    """True if a part has a hole for a bar that was not recognised as one: points all around it, right outside."""
    if any(c.inner and c.full and coaxial(c, bar, 0.1) for c in solid.cylinders):
        return False
    delta = solid.points - bar.center
    along = delta @ bar.direction
    across = delta - along[:, None] * bar.direction
    radial = np.linalg.norm(across, axis=1)
    rim = (np.abs(along) < bar.half) & (radial > (1 - RIM) * bar.radius) & (radial < (1 + RIM) * bar.radius)
    if rim.sum() < SECTORS:
        return False
    u, v = np.linalg.svd(bar.direction[None, :])[2][1:]
    turn = np.arctan2(across[rim] @ v, across[rim] @ u)
    return len(set(np.floor((turn + np.pi) / (2 * np.pi) * SECTORS).astype(int) % SECTORS)) >= SECTORS - 1


def solid_cylinders_of(
    solids: tuple[Solid, ...], cylinders: list[DrawnCylinder], tolerance: float
) -> list[DrawnCylinder]:
    """Hydraulic cylinders drawn without a bore: a bar, and in line with it a thinner one that comes out of its end.

    Twins that share their two parts are one cylinder, in the middle between them. `bore` is the barrel's outer radius.
    """
    taken = {i for cylinder in cylinders for i in cylinder.barrel | cylinder.rod}
    bars = [
        (s, c)
        for s in solids
        if s.index not in taken
        for c in s.cylinders
        if c.full and not c.inner and c.half > c.radius
    ]
    eyes = [c for s in solids for c in s.cylinders if c.arc > ROUND_ARC]
    centers = np.array([c.center for _, c in bars]).reshape(-1, 3)
    directions = np.array([c.direction for _, c in bars]).reshape(-1, 3)
    radii = np.array([c.radius for _, c in bars])
    pairs = []
    for tube, thick in bars:
        if thick.half <= 2 * thick.radius:
            continue
        delta = centers - thick.center
        off = np.linalg.norm(delta - np.outer(delta @ thick.direction, thick.direction), axis=1)
        in_line = (off <= max(tolerance, 0.05 * thick.radius)) & (
            np.abs(directions @ thick.direction) > NEARLY_PARALLEL
        )
        for k in np.flatnonzero(in_line & (radii < thick.radius)).tolist():
            bar, thin = bars[k]
            if tube.index != bar.index and (score := _pair(thick, thin, eyes, tolerance)) > 0.0:
                pairs.append((score, tube, thick, bar, thin))
    found: list[DrawnCylinder] = []
    for score, tube, thick, bar, thin in sorted(pairs, key=lambda p: (-round(p[0], 6), p[1].index, p[3].index)):
        if tube.index in taken or bar.index in taken:
            continue
        taken |= {tube.index, bar.index}
        twins = [
            (t, b)
            for value, one, t, other, b in pairs
            if (one.index, other.index) == (tube.index, bar.index)
            and value > 0.5 * score
            and abs(float(t.direction @ thick.direction)) > PARALLEL
            and abs(t.radius - thick.radius) < TWIN * thick.radius
            and abs(b.radius - thin.radius) < TWIN * thin.radius
        ]
        direction = thick.direction if float((thin.center - thick.center) @ thick.direction) > 0 else -thick.direction
        halves = [grown(Pair(tube, t, bar, b, direction, 0.0), solids, taken, tolerance) for t, b in twins]
        rod = frozenset().union(*(h.rod for h in halves))
        barrel = frozenset().union(*(h.barrel for h in halves)) - rod
        taken |= barrel | rod
        origin = np.mean([t.center for t, _ in twins], axis=0)
        found.append(
            DrawnCylinder(
                barrel, rod, np.asarray(origin), direction, thick.radius, thin.radius, hollow=False, count=len(twins)
            )
        )  # fmt: skip
    return found


def apart_cylinders_of(
    solids: tuple[Solid, ...], cylinders: list[DrawnCylinder], tolerance: float
) -> list[DrawnCylinder]:
    """Hydraulic cylinders whose rod is not drawn in its place: a long bore, and in line with it a long bar of another
    part that fills it, beside it or in it, each part with an eye across.

    The barrel's eye says which end is closed: the direction is from it through the bore.
    """
    taken = {i for cylinder in cylinders for i in cylinder.barrel | cylinder.rod}
    free = [s for s in solids if s.index not in taken]
    tubes = [(s, c) for s in free for c in s.cylinders if c.inner and c.full and 2 * c.half > 3.5 * c.radius]
    shafts = [
        (s, c)
        for s in free
        if s.shaft is not None
        for c in [s.shaft]
        if 2 * c.half > 4 * c.radius and 2 * c.half > 0.4 * s.size
    ]
    pairs = []
    for tube, bore in tubes:
        for bar, shaft in shafts:
            if (
                bar.index == tube.index
                or not FILLING * bore.radius < shaft.radius < 1.004 * bore.radius + 0.2 * tolerance
            ):
                continue
            if not coaxial(bore, shaft, 0.02, tolerance):
                continue
            low, high = bar.span(bore.center, bore.direction)
            near, far = tube.span(bore.center, bore.direction)
            own = _eye(tube, bore)
            if own is None or _eye(bar, bore) is None or max(low - far, near - high) > far - near:
                continue
            direction = bore.direction if own < 0 else -bore.direction
            pairs.append((min(bore.half, shaft.half) * bore.radius, tube, bore, bar, shaft, direction))
    found: list[DrawnCylinder] = []
    for _, tube, bore, bar, shaft, direction in sorted(pairs, key=lambda p: (-round(p[0], 9), p[1].index, p[3].index)):
        if {tube.index, bar.index} & taken:
            continue
        taken |= {tube.index, bar.index}
        ends = frozenset({tube.index}), frozenset({bar.index})
        reach = shaft.interval(bore.center, direction)
        inside = min(reach[1], bore.half) - max(reach[0], -bore.half) > bore.radius and reach[1] > bore.half
        found.append(DrawnCylinder(*ends, bore.center, direction, bore.radius, shaft.radius, apart=not inside))
    return found


def _eye(solid: Solid, line: Cyl) -> float | None:
    """Where along a cylinder's axis a part has a round eye across it: the outermost, from the cylinder's middle."""
    places = [
        place
        for c in solid.cylinders
        if c.full and (place := crossing(c, line.center, line.direction, line.radius)) is not None
    ]
    return max(places, key=abs, default=None)


def _pair(thick: Cyl, thin: Cyl, eyes: list[Cyl], tolerance: float) -> float:
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
