"""Pivots of which neither pin nor bores are drawn: a round end of a part, and what lies right beside it on its axis.

Whoever draws a link rounds its ends about the pins. In a model without holes that is what is left of a pivot.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from yellowiron.alignment.features.contacts import Fit, SharedAxis, shared_axes_of
from yellowiron.alignment.features.cylinders import DrawnCylinder
from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.solids import Cyl, Solid, coaxial
from yellowiron.alignment.tolerances import LEAST_PIVOT, PARALLEL
from yellowiron.model.template import Template

ARC = 1.5
"""Radians that an end is round at least."""
MOST = 0.025
"""An end's radius in machine sizes, at most."""
LONG = 6.0
"""A hole longer than this many radii is a barrel's."""
BESIDE = (0.25, 0.5, 1.0)
"""What is beside an end is at most this share of its radius away, the nearest first; or as far as the end is wide …"""
CORE = 0.3
"""… and on its axis within this share of its radius."""
PIN = 0.5
"""A pin has about this share of the radius of the end around it."""


def has_drilled_pivots(solids: tuple[Solid, ...], template: Template, size: float) -> bool:
    """Whether a model's pivots are drawn with holes: as many stout ones as the template has hinges, or more; those that
    only special machines have do not count."""
    special = template.special()
    hinges = sum(
        1
        for j in template.joints
        if j.type == "revolute" and not any({(n, c) for c in allowed} <= special for n, allowed in j.when.items())
    )
    holes = sum(
        c.inner and c.full and LEAST_PIVOT * size < c.radius < MOST * size and 2 * c.half < LONG * c.radius
        for s in solids
        for c in s.cylinders
    )
    return holes >= hinges


def round_end_fits_of(
    solids: tuple[Solid, ...], fits: Iterable[Fit], cylinders: Iterable[DrawnCylinder], touch: Touch, size: float
) -> list[Fit]:
    """A fit for every part right beside a round end of another, for pairs of parts without one. `inner` is the part
    with the end; the shaft is the pin that is not drawn."""
    cylinders = list(cylinders)
    joined = {frozenset((f.inner, f.outer)) for f in fits}
    of_cylinder = {i: cylinder for cylinder in cylinders for i in cylinder.barrel | cylinder.rod}
    found: dict[tuple[int, int], Fit] = {}
    for solid in solids:
        if (
            solid.axis is not None
            or (solid.shaft is not None and solid.index not in of_cylinder)
            or (solid.slight and solid.shape.closed)
        ):
            continue
        for end in (*solid.cylinders, *solid.knuckles):
            if end.inner or end.arc < ARC or not LEAST_PIVOT * size < end.radius < MOST * size:
                continue
            cylinder = of_cylinder.get(solid.index)
            if cylinder is not None and abs(float(end.direction @ cylinder.direction)) > PARALLEL:
                continue
            for side in (1.0, -1.0):
                for other, bore in _beside(solid, end, side, solids, touch):
                    pair = (solid.index, other)
                    if frozenset(pair) in joined:
                        continue
                    pin = replace(end, radius=PIN * end.radius)
                    if pair not in found or end.radius * end.arc > found[pair].overlap:
                        found[pair] = Fit(solid.index, other, pin, bore, end.radius * end.arc, 0.0)
    return _chained([found[pair] for pair in sorted(found)], joined)


def stay_bars_of(pierced: Iterable[Fit], ended: list[Fit], solids: tuple[Solid, ...], touch: Touch) -> frozenset[int]:
    """Bars through parts that hold them together and are no pins: where few of the round ends have a pin, those between
    whose ends and other parts there is no room."""
    pins = sorted({f.inner for f in pierced if solids[f.inner].shaft is not None})
    axes = shared_axes_of(ended, 0.0)
    bars = {i: shaft for i in pins if (shaft := solids[i].shaft) is not None}
    on = [ln for ln in axes if any(_along(bar, ln) for bar in bars.values())]
    if 2 * len(on) >= len(axes):
        return frozenset()
    return frozenset(i for i, bar in bars.items() if not any(_along(bar, ln) for ln in on) and _held(i, bar, touch))


def _along(bar: Cyl, axis: SharedAxis) -> bool:
    return abs(float(bar.direction @ axis.direction)) > PARALLEL and axis.off(bar.center) < 0.1 * axis.radius


def _held(index: int, bar: Cyl, touch: Touch) -> bool:
    """Whether other parts begin right beyond both ends of a bar."""
    gap = BESIDE[0] * bar.radius
    for side in (1.0, -1.0):
        center = bar.center + side * bar.half * bar.direction
        probe = replace(bar, center=center, half=0.5 * gap)
        near = touch.reaching(center - bar.radius, center + bar.radius)
        if not any(k != index and touch.pierced(k, probe, CORE * bar.radius) for k in near):
            return False
    return True


def _chained(fits: list[Fit], joined: set[frozenset[int]]) -> list[Fit]:
    """The fits, and one for every two parts that are beside a third on one axis: its pin goes through them all."""
    joined = joined | {frozenset((f.inner, f.outer)) for f in fits}
    by_part: dict[int, list[Fit]] = {}
    for fit in fits:
        by_part.setdefault(fit.inner, []).append(fit)
        by_part.setdefault(fit.outer, []).append(fit)
    more = []
    for part in sorted(by_part):
        for k, one in enumerate(by_part[part]):
            for other in by_part[part][k + 1 :]:
                a, b = (f.inner + f.outer - part for f in (one, other))
                if frozenset((a, b)) not in joined and a != b and coaxial(one.shaft, other.shaft, 0.1):
                    joined.add(frozenset((a, b)))
                    more.append(Fit(a, b, one.shaft, other.bore, one.overlap, 0.0))
    return fits + more


def _beside(solid: Solid, end: Cyl, side: float, solids: tuple[Solid, ...], touch: Touch) -> list[tuple[int, Cyl]]:
    """The parts that have material on an end's axis next beyond one of its faces, and where: those that are turned
    about it themselves (hubs, spacers) belong to a neighbour and are none."""
    inward = 0.05 * end.radius
    for gap in sorted((*(share * end.radius for share in BESIDE), 2.0 * end.half)):
        center = end.center + side * (end.half + 0.5 * (gap - inward)) * end.direction
        probe = replace(end, center=center, half=0.5 * (gap + inward))
        reach = probe.half * np.abs(probe.direction) + CORE * end.radius
        found = []
        for k in touch.reaching(center - reach, center + reach):
            other = solids[k]
            if (
                k == solid.index
                or (other.slight and other.shape.closed)
                or (other.line is not None and coaxial(other.line, end, 0.1))
            ):
                continue
            if other.span(end.center, side * end.direction)[1] < end.half + 0.1 * end.radius:
                continue  # it ends here
            if touch.pierced(k, probe, CORE * end.radius):
                found.append((k, replace(probe, radius=PIN * end.radius, inner=True, arc=2 * np.pi)))
        if found:
            return found
    return []
