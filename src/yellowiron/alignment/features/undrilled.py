"""Pivots of machines that are drawn to be looked at, without holes for their pins.

Such a model shows a pin as a bar that runs through solid plates. What a bar runs through, near its axis, it may turn
in. Hydraulic cylinders of such models: `undrilled_cylinders`.
"""

from __future__ import annotations

import weakref
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.features.contacts import Fit
from yellowiron.alignment.features.cylinders import DrawnCylinder
from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.solids import Cyl, Solid, coaxial
from yellowiron.alignment.tolerances import (
    LEAST_PIVOT,
    LEAST_SLEWING,
    PARALLEL,
    PARALLEL_BY_EYE,
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
WHOLE = 0.5
"""The pieces of a bar make up at least this share of it."""


@dataclass(frozen=True, eq=False)
class _Model:
    """What is looked at: the solids, what tells which of them a line pierces, the machine's size in metres, and of the
    hydraulic cylinders the solids (`taken`) and directions."""

    solids: tuple[Solid, ...]
    touch: Touch
    size: float
    taken: frozenset[int]
    directions: tuple[Floats, ...]


def pierced_fits_of(
    solids: tuple[Solid, ...], fits: list[Fit], cylinders: Collection[DrawnCylinder], touch: Touch, size: float
) -> list[Fit]:
    """A fit for every part that a pin without a single hole runs through; and for two parts that have no pin between
    them, where the bar that one of them has runs through the other. None in a model that has holes for its pins.

    `inner` is the pin, or the part that has the bar.
    """
    taken = frozenset(i for cylinder in cylinders for i in cylinder.barrel | cylinder.rod)
    model = _Model(solids, touch, size, taken, tuple(cylinder.direction for cylinder in cylinders))
    held = {f.inner for f in fits}
    pins = [s for s in solids if s.shaft is not None and s.index not in taken | held]
    through = [fit for pin in pins for fit in _through(pin, _bars(pin, size), solids, touch)]
    hosts: dict[int, set[int]] = {}
    for fit in through:
        hosts.setdefault(fit.inner, set()).add(fit.outer)
    # A pin runs through two parts at least; what is in one only is a boss or a knob of it.
    hosted = {pin: around for pin, around in hosts.items() if len(around) > 1}
    if _pins_in_holes(solids, fits) > len(hosted):
        return []
    found = [fit for fit in through if fit.inner in hosted]
    pinned = {frozenset((a, b)) for around in hosted.values() for a in around for b in around} | _pairs(fits)
    loose = {s.index for s in pins} - set(hosted)
    found += [fit for fit in _on_own_bars(model, loose) if _ends(fit) not in pinned and fit.outer not in hosts]
    return found + _without_a_pin(model, pinned | _pairs(found))


def _on_own_bars(model: _Model, loose: Collection[int]) -> Iterator[Fit]:
    """What the bars run through that parts have which are no pins; not those along a hydraulic cylinder of one."""
    for solid in model.solids:
        of_cylinder = solid.index in model.taken
        if solid.index in loose or (solid.shaft is not None and not of_cylinder):
            continue
        bars = [c for c in _bars(solid, model.size) if not (of_cylinder and _along(c, model.directions))]
        yield from _through(solid, bars, model.solids, model.touch)


def _without_a_pin(model: _Model, joined: set[frozenset[int]]) -> list[Fit]:
    """Turntables, and forks around another part, between parts that are not `joined` yet."""
    apart = {s.index for s in model.solids if s.index in model.taken or s.shaft is not None or s.axis is not None}
    bodies = [s for s in model.solids if s.index not in apart]
    tables = _turntables(bodies, model.touch, model.size)
    found = [fit for fit in tables if _ends(fit) not in joined]
    joined = joined | _pairs(tables)
    for solid in bodies:
        forks = _through(solid, _between_knuckles(solid, model.size), model.solids, model.touch)
        found += [f for f in forks if f.outer not in apart and _ends(f) not in joined]
    return found


def _ends(fit: Fit) -> frozenset[int]:
    return frozenset((fit.inner, fit.outer))


def _pairs(fits: Iterable[Fit]) -> set[frozenset[int]]:
    return {_ends(fit) for fit in fits}


def rimmed_fits_of(solids: tuple[Solid, ...], fits: list[Fit], touch: Touch) -> list[Fit]:
    """A fit for every part with a hole that was not recognised as a bore (too coarse, broken, or too rough to be round)
    around a pin that is in the bores of others."""
    joined = _pairs(fits)
    pins = [solids[i] for i in sorted({f.inner for f in fits}) if solids[i].shaft is not None]
    found = []
    for pin in pins:
        bar = pin.shaft
        assert bar is not None
        reach = bar.half * np.abs(bar.direction) + bar.radius
        for other in (solids[i] for i in touch.reaching(bar.center - reach, bar.center + reach)):
            if other.index == pin.index or other.shaft is not None or frozenset((pin.index, other.index)) in joined:
                continue
            low, high = other.span(bar.center, bar.direction)
            low, high = max(low, -bar.half), min(high, bar.half)
            if high - low >= LEAST * bar.radius and _rimmed(other, bar):
                middle = bar.center + 0.5 * (low + high) * bar.direction
                hole = replace(bar, center=middle, half=0.5 * (high - low), inner=True)
                found.append(Fit(pin.index, other.index, bar, hole, high - low, 0.0))
    return found


def interrupted_fits_of(solids: tuple[Solid, ...], fits: list[Fit], tolerance: float) -> list[Fit]:
    """A fit for every empty bore on a bar of which only pieces are drawn: equal ones in line of one part, what is
    between them being inside of that part's other shapes. For pairs of parts without a fit."""
    joined = _pairs(fits)
    filled = {id(f.bore) for f in fits}
    empty = [(s.index, c) for s in solids for c in s.cylinders if c.inner and c.full and id(c) not in filled]
    found: dict[tuple[int, int], Fit] = {}
    for solid in solids:
        for bar in _whole_bars(solid, tolerance):
            for outer, bore in empty:
                pair = (solid.index, outer)
                if outer == solid.index or frozenset(pair) in joined or not _on_bar(bore, bar, tolerance):
                    continue
                if pair not in found or 2 * bore.half > found[pair].overlap:
                    found[pair] = Fit(solid.index, outer, bar, bore, 2 * bore.half, bore.off(bar.center))
    return [found[key] for key in sorted(found)]


def _on_bar(bore: Cyl, bar: Cyl, tolerance: float) -> bool:
    """True for a bore as wide as a bar, about its axis and between its ends."""
    if abs(bore.radius - bar.radius) > max(tolerance, 0.03 * bar.radius):
        return False
    low, high = bore.interval(bar.center, bar.direction)
    inside = low > -bar.half - tolerance and high < bar.half + tolerance
    return inside and coaxial(bar, bore, 0.03, tolerance)


def _whole_bars(solid: Solid, tolerance: float) -> Iterator[Cyl]:
    """The bars of which a part shows several pieces."""
    pieces = [c for c in solid.cylinders if c.full and not c.inner]
    for k, one in enumerate(pieces):
        bar = _whole_bar(one, pieces[k + 1 :], tolerance)
        if bar is not None:
            yield bar


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


def _pins_in_holes(solids: tuple[Solid, ...], fits: list[Fit]) -> int:
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


def _along(bar: Cyl, directions: Iterable[Floats]) -> bool:
    return any(abs(float(bar.direction @ d)) > PARALLEL for d in directions)


def _through(solid: Solid, bars: list[Cyl], solids: tuple[Solid, ...], touch: Touch) -> list[Fit]:
    """One fit for each part that bars of a solid run through: the longest."""
    best: dict[int, Fit] = {}
    for bar in bars:
        reach = bar.half * np.abs(bar.direction) + bar.radius
        for other in (solids[i] for i in touch.reaching(bar.center - reach, bar.center + reach)):
            if other.index == solid.index or (other.slight and other.shape.closed):
                continue
            known = _holes.setdefault(bar, weakref.WeakKeyDictionary())
            if other not in known:
                known[other] = _hole(other, bar, touch)
            hole = known[other]
            if hole is None:
                continue
            fit = Fit(solid.index, other.index, bar, hole, 2 * hole.half, 0.0)
            if other.index not in best or fit.overlap > best[other.index].overlap:
                best[other.index] = fit
    return [best[k] for k in sorted(best)]


_holes: weakref.WeakKeyDictionary[Cyl, weakref.WeakKeyDictionary[Solid, Cyl | None]] = weakref.WeakKeyDictionary()
"""What bars that are still in use run through: it is the same with every contact tolerance."""


def _hole(other: Solid, bar: Cyl, touch: Touch) -> Cyl | None:
    """Where a bar runs through a part, whether that has a hole for it or not."""
    low, high = other.span(bar.center, bar.direction)
    low, high = max(low, -bar.half), min(high, bar.half)
    if high - low < LEAST * bar.radius:
        return None
    if not (_rimmed(other, bar) or touch.pierced(other.index, bar, CORE * bar.radius)):
        return None
    middle = bar.center + 0.5 * (low + high) * bar.direction
    return replace(bar, center=middle, half=0.5 * (high - low), inner=True)


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
