"""Wheels by shape: the largest equal rings, and what turns with each."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.features.solids import Cyl, Solid, coaxial, size_of
from yellowiron.alignment.tolerances import SAME_DIRECTION
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template
from yellowiron.support.vectors import unit


@dataclass(frozen=True, eq=False)
class Wheel:
    """One wheel: its solids, the outermost ring among them, its axis and radius (metres, CAD frame), and whether it is
    a drum."""

    members: frozenset[int]
    tyre: int
    center: Floats
    direction: Floats
    radius: float
    width: float
    drum: bool = False


LEAST = 0.025
"""The least radius of a wheel, in sizes of the whole."""
CENTRED = 0.2
"""The middle of a rim or a tyre is this near to the wheel's axis, in radii of its ring, …"""
SQUARE = 0.1
"""… and its height and length differ by no more than this share."""
ROLLING = 0.5
"""Wheels of one size are steered against each other by less than this cosine says (60°)."""
TREAD = 2.2
"""A tyre is no more than so much larger than the ring of its rim."""
WIDER = 1.3
"""What is of a wheel is no more than so much wider than its ring."""
FLAT = 2.2
"""A wheel is no wider than so many of its radii."""
ROUND, CORNERS = 0.96, 24
"""What no round face is of is a ring if it is no narrower, seen from one side or another, than this share of its width
from others, and has so many corners (a dodecagon is 0.966, an octagon 0.92)."""
ASIDE, BESIDE = 0.02, 1.6
"""Twin tyres are this near to one axis, in radii, and this near to each other, in widths between their middles."""

LUGS, OUTER = 8, 0.8
"""So many equal solids or more, all round a wheel, their middles this far out at least, in its radii, are its lugs."""

BOGIE, IN_LINE = (1.8, 3.2), 0.5
"""The axles of a bogie are so many radii apart, its wheels so many widths out of line at most."""
DRUM = (1.5, 6.0)
"""A drum is so many of its radii wide, at least and at most, …"""
LIKE = 0.5
"""… and its radius is at least this share of the largest drum's."""


def rolling_of(solids: tuple[Solid, ...], template: Template, taken: set[int], tolerance: float) -> list[Wheel]:
    """The drums and wheels of a template, as many as it has at most; what is in a drum is no wheel."""
    rolling = [r for r in template.roles if r.kind == "wheel" and r.rigid and not r.many]
    drums = drums_of(solids, sum(r.drum for r in rolling), taken, tolerance)
    inside = taken.union(*(d.members for d in drums))
    return [*drums, *wheels_of(solids, sum(not r.drum for r in rolling), inside, tolerance)]


@dataclass(frozen=True, eq=False)
class SpareWheel:
    """A wheel of an axle that a type does not have: its solids, its tyre or twin tyres among them, its middle (metres,
    CAD frame) on its unit axis `direction`, and the tyre of the wheel `beside` it that the type has."""

    members: frozenset[int]
    tyres: frozenset[int]
    center: Floats
    direction: Floats
    beside: int


def spare_wheels(solids: tuple[Solid, ...], template: Template, tolerance: float) -> list[SpareWheel]:
    """The wheels of axles that a type does not have: of a bogie's axles all but one, else, of more than two axles in a
    row, those between the first and the last. None where neither leaves as many wheels as the type has."""
    count = sum(r.kind == "wheel" and r.rigid and not r.drum and not r.many for r in template.roles)
    rings = _equal_rings(solids, set()) if count else []
    if len(rings) <= count or len(equal := _twin_tyres(rings)) <= count:
        return []
    ways = (_bogies(equal), _inner_axles(equal))
    spare = next((spare for kept, spare in ways if len(kept) == count), [])
    # All that is about a spare wheel, its twin tyre too; what it stands beside is the tyre of one that is kept.
    whole = [(_with_all_about(w, solids, set(), tolerance, rings), w.members, beside) for w, beside in spare]
    return [SpareWheel(_all_within(w, solids), tyres, w.center, w.direction, beside) for w, tyres, beside in whole]


def _bogies(wheels: list[Wheel]) -> tuple[list[Wheel], list[tuple[Wheel, int]]]:
    """Of wheels close behind each other one, and the others, each with the tyre of that one."""
    middle = np.mean([w.center for w in wheels], axis=0)
    # A bogie's wheel nearest to the middle of the machine stays: its axle is the one that carries the most.
    left = sorted(wheels, key=lambda w: (round(float(np.linalg.norm(w.center - middle)), 4), w.tyre))
    kept: list[Wheel] = []
    spare: list[tuple[Wheel, int]] = []
    while left:
        first, *left = left
        kept.append(first)
        row = [first]
        for wheel in row:
            beside = [w for w in left if _of_one_bogie(wheel, w)]
            row += beside
            left = [w for w in left if not any(w is other for other in beside)]
        spare += [(w, first.tyre) for w in row[1:]]
    return kept, spare


def _inner_axles(wheels: list[Wheel]) -> tuple[list[Wheel], list[tuple[Wheel, int]]]:
    """The wheels of the first and the last axle of a row of axles, and those between, each with the tyre of the wheel
    on its side of the nearer of the two. All are kept where they are no row of axles of two wheels each."""
    axle = unit(np.sum([w.direction * np.sign(w.direction @ wheels[0].direction) for w in wheels], axis=0))
    centers = np.array([w.center for w in wheels])
    flat = centers - centers.mean(axis=0)
    flat = flat - np.outer(flat @ axle, axle)
    along = flat @ np.linalg.svd(flat)[2][0]
    order = sorted(range(len(wheels)), key=lambda k: (round(float(along[k]), 4), round(float(centers[k] @ axle), 4)))
    rows = [order[k : k + 2] for k in range(0, len(order), 2)]
    radius = wheels[0].radius
    paired = all(len(row) == 2 and abs(along[row[0]] - along[row[1]]) < 0.5 * radius for row in rows)
    apart = all(along[b[0]] - along[a[0]] > radius for a, b in itertools.pairwise(rows))
    if len(rows) < 3 or not (paired and apart):
        return wheels, []
    ends = [wheels[k] for row in (rows[0], rows[-1]) for k in row]
    spare = []
    for k in (k for row in rows[1:-1] for k in row):
        beside = min(ends, key=lambda w: (round(float(np.linalg.norm(w.center - wheels[k].center)), 4), w.tyre))
        spare.append((wheels[k], beside.tyre))
    return ends, spare


def _all_within(wheel: Wheel, solids: tuple[Solid, ...]) -> frozenset[int]:
    """A wheel's solids and all that is wholly inside its outline: bolts, hubs, brakes."""

    def inside(s: Solid) -> bool:
        low, high = s.span(wheel.center, wheel.direction)
        if max(high, -low) > WIDER * 0.5 * wheel.width:
            return False
        delta = s.points - wheel.center
        across = delta - np.outer(delta @ wheel.direction, wheel.direction)
        return float(np.linalg.norm(across, axis=1).max()) < 1.01 * wheel.radius

    return wheel.members | {s.index for s in solids if inside(s)}


def _of_one_bogie(one: Wheel, other: Wheel) -> bool:
    """Whether two wheels roll one close behind the other."""
    along = float((other.center - one.center) @ one.direction)
    apart = float(np.linalg.norm(other.center - one.center - along * one.direction)) / one.radius
    level = abs(float(one.direction @ other.direction)) > SAME_DIRECTION
    return level and abs(along) < IN_LINE * one.width and BOGIE[0] < apart < BOGIE[1]


def drums_of(solids: tuple[Solid, ...], count: int, taken: set[int], tolerance: float) -> list[Wheel]:
    """Up to `count` steel drums: the largest round things that are about as wide as they are high, with what is about
    their axes between their ends: heads, journals, exciters. `taken` solids are left alone."""
    found: list[Wheel] = []
    least = LEAST * size_of(solids) if count else 0.0
    for s in sorted(solids, key=lambda s: (-round(s.reach, 5), s.index)) if count else ():
        if s.axis is None or s.index in taken or s.reach < max(least, LIKE * found[0].radius if found else 0.0):
            continue
        width = s.end - s.start
        centre = s.axis.center + 0.5 * (s.start + s.end) * s.axis.direction
        if DRUM[0] * s.reach <= width <= DRUM[1] * s.reach and not any(
            _same_place(w, s.axis.direction, centre) for w in found
        ):
            found.append(Wheel(frozenset({s.index}), s.index, centre, s.axis.direction, s.reach, width, True))
    return [_with_all_about(w, solids, taken, tolerance) for w in found[:count]]


def wheels_of(solids: tuple[Solid, ...], count: int, taken: set[int], tolerance: float) -> list[Wheel]:
    """Up to `count` wheels: the largest round things of at least half the largest's radius, equal ones together.

    `taken` solids (hydraulics) are left alone. Nothing is returned where no two equal rings are found.
    """
    if count == 0:
        return []
    equal = rings = _equal_rings(solids, taken)
    if len(equal) > count:
        equal = _twin_tyres(equal)
    return [_with_all_about(w, solids, taken, tolerance, rings) for w in equal[:count]] if len(equal) >= 2 else []


def _equal_rings(solids: tuple[Solid, ...], taken: set[int]) -> list[Wheel]:
    """The rings that are at least half as large as the largest and have an equal one, largest first."""
    least = LEAST * size_of(solids)
    rings = [ring for s in solids if s.index not in taken and (ring := _ring(s, least)) is not None]
    rings.sort(key=lambda w: (-round(w.radius, 5), w.tyre))
    found: list[Wheel] = []
    for ring in rings:
        if any(_same_place(w, ring.direction, ring.center) for w in found):
            continue
        if found and ring.radius < 0.45 * found[0].radius:
            break
        found.append(ring)
    return [w for w in found if any(v is not w and _alike(v, w) for v in found)]


def _ring(solid: Solid, least: float) -> Wheel | None:
    """A solid that is round and flat, of more than the `least` radius, as a wheel of its own: about its axis of
    symmetry, or, where no face of it is round (a tyre that is all lugs), about the one that its outline is round
    about."""
    if solid.axis is not None:
        center = solid.axis.center + 0.5 * (solid.start + solid.end) * solid.axis.direction
        direction, radius, width = solid.axis.direction, solid.reach, solid.end - solid.start
    elif (outline := _round_outline(solid, least)) is not None:
        center, direction, radius, width = outline
    else:
        return None
    flat = radius > least and width < FLAT * radius
    return Wheel(frozenset({solid.index}), solid.index, center, direction, radius, width) if flat else None


def _round_outline(solid: Solid, least: float) -> tuple[Floats, Floats, float, float] | None:
    """Centre, axis, radius and width of what reaches equally far to all sides of an axis through its middle."""
    points = solid.points
    if len(points) < CORNERS or np.linalg.norm(solid.high - solid.low) < 2.0 * least:
        return None
    spread, axes = np.linalg.eigh(np.cov(points.T))
    # Two of the three spreads are equal: the axis is the third's. It is the least of a ring, not of a drum.
    direction = axes[:, 0] if spread[2] - spread[1] < spread[1] - spread[0] else axes[:, 2]
    across = np.linalg.svd(direction[None, :])[2][1:]
    flat, along = points @ across.T, points @ direction
    turn = np.linspace(0.0, np.pi, 24, endpoint=False)
    seen = flat @ np.array([np.cos(turn), np.sin(turn)])
    low, high = seen.min(axis=0), seen.max(axis=0)
    width = high - low
    middle = 0.5 * np.array([low[0] + high[0], low[12] + high[12]])
    if width.min() < ROUND * width.max():
        return None
    center = middle @ across + 0.5 * (along.min() + along.max()) * direction
    return center, direction, 0.5 * float(width.max()), float(np.ptp(along))


def _alike(one: Wheel, other: Wheel) -> bool:
    """Whether two rings are as large, and roll much the same way: a slewing bearing as large as the wheels lies across
    them, however these are steered."""
    return (
        abs(one.radius - other.radius) < 0.02 * other.radius and abs(float(one.direction @ other.direction)) > ROLLING
    )


def _twin_tyres(wheels: list[Wheel]) -> list[Wheel]:
    """Two tyres side by side on one axle are one wheel, where there are more of them than wheels."""
    joined: list[Wheel] = []
    for wheel in wheels:
        for k, other in enumerate(joined):
            along = float((wheel.center - other.center) @ other.direction)
            across = float(np.linalg.norm(wheel.center - other.center - along * other.direction))
            if across < ASIDE * other.radius and abs(along) < BESIDE * other.width and len(other.members) == 1:
                centre, width = 0.5 * (wheel.center + other.center), abs(along) + 0.5 * (wheel.width + other.width)
                both = wheel.members | other.members
                joined[k] = Wheel(both, other.tyre, centre, other.direction, other.radius, width)
                break
        else:
            joined.append(wheel)
    return joined


def _same_place(wheel: Wheel, direction: Floats, centre: Floats) -> bool:
    if abs(float(direction @ wheel.direction)) < SAME_DIRECTION:
        return False
    delta = centre - wheel.center
    along = abs(float(delta @ wheel.direction))
    off = float(np.linalg.norm(delta - (delta @ wheel.direction) * wheel.direction))
    return off < 0.1 * wheel.radius and along < wheel.width


def _with_all_about(
    wheel: Wheel, solids: tuple[Solid, ...], taken: set[int], tolerance: float, rings: Sequence[Wheel] = ()
) -> Wheel:
    """Everything round about the wheel's axis that is mostly between its sides; and what is about it, as high as it is
    long, and wholly between them: rims of spokes, hubs with their bolts, a tyre whose tread is not round; and a tread's
    lugs, each by itself, that are nearer to it than to another of the `rings`."""
    axis = solids[wheel.tyre].axis or Cyl(
        wheel.center, wheel.direction, wheel.radius, 0.5 * wheel.width, 2.0 * np.pi, inner=False
    )
    members = set(wheel.members)
    half, radius = 0.5 * wheel.width, wheel.radius
    aside: dict[str, list[Solid]] = {}
    for s in solids:
        if s.index in taken or s.index in members:
            continue
        low, high = s.span(wheel.center, wheel.direction)
        if s.axis is not None and s.reach <= 1.01 * wheel.radius and coaxial(s.axis, axis, 0.05, tolerance):
            if min(high, 1.15 * half) - max(low, -1.15 * half) > 0.5 * (high - low):
                members.add(s.index)
        elif max(high, -low) <= WIDER * half and (reach := _reach_about(wheel, s)) is not None:
            members.add(s.index)
            radius = max(radius, reach)
        elif max(high, -low) <= WIDER * half:
            aside.setdefault(s.part.shape, []).append(s)
    for equal in aside.values():
        lugs, reach = _lugs(wheel, equal, [w for w in rings if not w.members & wheel.members])
        members |= lugs
        radius = max(radius, reach)
    return replace(wheel, members=frozenset(members), radius=radius)


def _lugs(wheel: Wheel, equal: list[Solid], others: list[Wheel]) -> tuple[set[int], float]:
    """Those of equal solids that are lugs of a wheel's tread: all round it, with no gap of a quarter, and nearer to it
    than to the `others`; and how far they reach from its axis, metres."""
    equal = [s for s in equal if _nearest(s.center, wheel, others)] if len(equal) >= LUGS else []
    if len(equal) < LUGS:
        return set(), 0.0
    first = unit(np.cross(wheel.direction, np.eye(3)[int(np.argmin(np.abs(wheel.direction)))]))
    plane = np.array([first, np.cross(wheel.direction, first)])
    middles = np.array([s.center - wheel.center for s in equal]) @ plane.T
    reach = np.array([np.linalg.norm((s.points - wheel.center) @ plane.T, axis=1).max() for s in equal])
    out = (np.linalg.norm(middles, axis=1) > OUTER * wheel.radius) & (reach < TREAD * wheel.radius)
    turn = np.sort(np.arctan2(middles[out, 1], middles[out, 0]))
    if len(turn) < LUGS or np.diff(turn, append=turn[:1] + 2.0 * np.pi).max() > 0.5 * np.pi:
        return set(), 0.0
    return {s.index for s, lug in zip(equal, out, strict=True) if lug}, float(np.median(reach[out]))


def _nearest(point: Floats, wheel: Wheel, others: list[Wheel]) -> bool:
    own = float(np.linalg.norm(point - wheel.center))
    return all(own < float(np.linalg.norm(point - w.center)) for w in others)


def _reach_about(wheel: Wheel, solid: Solid) -> float | None:
    """How far a solid reaches from a wheel's axis, metres; None where it is not about it, or farther than a tyre."""
    delta = solid.points - wheel.center
    across = delta - np.outer(delta @ wheel.direction, wheel.direction)
    first = unit(np.cross(wheel.direction, np.eye(3)[int(np.argmin(np.abs(wheel.direction)))]))
    flat = across @ np.array([first, np.cross(wheel.direction, first)]).T
    low, high = flat.min(axis=0), flat.max(axis=0)
    about = np.abs(0.5 * (low + high)).max() < CENTRED * wheel.radius
    square = np.ptp(high - low) < SQUARE * (high - low).max()
    reach = float(np.linalg.norm(flat, axis=1).max())
    return reach if about and square and reach < TREAD * wheel.radius else None
