"""Hydraulic cylinders by shape: a long bore, a thinner long shaft that sticks out at one end, an eye across each or a
ball, which may go round the barrel."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.features.solids import Ball, Cyl, Solid, coaxial
from yellowiron.alignment.tolerances import ACROSS, PARALLEL_TWINS, TWIN
from yellowiron.model.geometry import Floats


@dataclass(frozen=True, eq=False)
class DrawnCylinder:
    """One cylinder: indices of the solids of its barrel and of its rod (those about its own axis; eyes come later), the
    axis from the closed end towards the rod's eye, and the two radii. Where the barrel is not `hollow`, `bore` is its
    outer radius. `count` twins side by side are one. A rod that is drawn `apart`, in line with its barrel but not in
    its place, holds nothing and hangs on nothing; one that is `fixed` hangs on no pins: each half is of what carries
    it."""

    barrel: frozenset[int]
    rod: frozenset[int]
    origin: Floats
    direction: Floats
    bore: float
    rod_radius: float
    hollow: bool = True
    count: int = 1
    apart: bool = False
    fixed: bool = False


@dataclass(frozen=True, eq=False)
class Pair:
    """A part with a bore (or a bar, where none is drawn) and one with a bar that comes out of its end."""

    tube: Solid
    bore: Cyl
    bar: Solid
    shaft: Cyl
    direction: Floats
    score: float
    fixed: bool = False


FIXED = 5.0
"""The bore of a cylinder without eyes is at least so many times its radius long, and the rod its own: else it may be a
pin in its boss."""
THROUGH = 1.7
"""A rod that comes out at both ends is at least so many times as long as its bore, which is a stroke long: shorter, it
is a pin, in a boss between whose bushes the bore is wider."""
BEHIND = 1.0
"""… and it comes out behind by at least so many times the bore's radius, more than the play of a piston in its end."""


def cylinders_of(solids: tuple[Solid, ...], tolerance: float, *, fixed: bool = False) -> list[DrawnCylinder]:
    """Every hydraulic cylinder, longest first; no solid belongs to two. Twins that share their two parts are one, in
    the middle between them. With `fixed` those without eyes, and those whose rod comes out at both ends, are too."""
    pairs = _rods_in_bores(solids, tolerance, fixed=fixed)
    cylinders: list[DrawnCylinder] = []
    used: set[int] = set()
    for pair in sorted(pairs, key=lambda p: (p.fixed, -round(p.score, 6), p.tube.index, p.bar.index)):
        if pair.tube.index in used or pair.bar.index in used:
            continue
        twins = [p for p in pairs if p.tube is pair.tube and p.bar is pair.bar and _alike(p, pair)]
        halves = [with_coaxial_parts(p, solids, used, tolerance) for p in twins]
        rod = frozenset().union(*(r.rod for r in halves))
        cylinder = replace(
            halves[0], barrel=frozenset().union(*(r.barrel for r in halves)) - rod, rod=rod,
            origin=np.asarray(np.mean([r.origin for r in halves], axis=0)), count=len(halves),
        )  # fmt: skip
        used |= cylinder.barrel | cylinder.rod
        cylinders.append(cylinder)
    return cylinders


def _rods_in_bores(solids: tuple[Solid, ...], tolerance: float, *, fixed: bool) -> list[Pair]:
    """Every long bore with a long shaft of another part in it."""
    faces = [(s, c) for s in solids for c in s.cylinders if c.full]
    bores = [(s, c) for s, c in faces if c.inner and 2 * c.half > 3.5 * c.radius and c.radius < 0.25 * s.size]
    shafts = [(s, c) for s, c in faces if not c.inner and 2 * c.half > 4 * c.radius]
    eyes, balls = [c for _, c in faces if c.inner], [b for s in solids for b in s.balls]
    pairs = (_pair(tube, bore, bar, shaft, (eyes, balls), tolerance) for tube, bore in bores for bar, shaft in shafts)
    return [pair for pair in pairs if pair is not None and (fixed or not pair.fixed)]


def _alike(one: Pair, other: Pair) -> bool:
    """True for a cylinder and itself, or its twin beside it: as wide, as far out, and parallel."""
    same = abs(one.bore.radius - other.bore.radius) < TWIN * other.bore.radius
    same = same and abs(one.shaft.radius - other.shaft.radius) < TWIN * other.shaft.radius
    apart = one.bore is not other.bore and one.bore.off(other.bore.center) > other.bore.radius
    delta = float((one.shaft.center - one.bore.center) @ other.direction)
    delta -= float((other.shaft.center - other.bore.center) @ other.direction)
    as_far = abs(delta) < TWIN * other.tube.size and float(one.direction @ other.direction) > PARALLEL_TWINS
    return one is other or (same and apart and as_far and one.shaft is not other.shaft)


def _pair(
    tube: Solid, bore: Cyl, bar: Solid, shaft: Cyl, hung: tuple[list[Cyl], list[Ball]], tolerance: float
) -> Pair | None:
    """What a bore and a shaft in it are of; `hung`: the eyes and the balls, or sockets, that it may hang on."""
    if tube.index == bar.index or not 0.25 * bore.radius < shaft.radius < 0.95 * bore.radius:
        return None
    if not coaxial(bore, shaft, 0.03, tolerance):
        return None
    direction = bore.direction
    a, b = shaft.interval(bore.center, direction)
    if a + b < 0:
        direction, (a, b) = -direction, (-b, -a)
    inside = min(b, bore.half) - max(a, -bore.half)
    out = b - bore.half
    if inside < 1.0 * bore.radius or out < 1.0 * shaft.radius:
        return None
    through = a < -bore.half - BEHIND * bore.radius
    low, high = tube.span(bore.center, direction)
    far = max(bar.span(bore.center, direction)[1], b)
    reach = 6 * bore.radius
    ends = [crossing(e, bore.center, direction, bore.radius) for e in hung[0]]
    places = [p for p in ends if p is not None]
    places += [float((b.center - bore.center) @ direction) for b in hung[1] if bore.off(b.center) < 0.1 * b.radius]
    behind = any(low - reach < p < bore.half for p in places)
    ahead = any(max(bore.half, b - reach) < p < far + reach for p in places)
    fixed = through or not (behind and ahead)
    if fixed and (bore.half < 0.5 * FIXED * bore.radius or shaft.half < 0.5 * FIXED * bore.radius):
        return None
    if fixed and a < -bore.half - tolerance and shaft.half < THROUGH * bore.half:
        return None
    return Pair(tube, bore, bar, shaft, direction, inside * bore.radius + 1e-3 * (high - low), fixed)


def crossing(eye: Cyl, origin: Floats, direction: Floats, radius: float) -> float | None:
    """Where along a line a bore crosses it at right angles, or None."""
    if abs(float(eye.direction @ direction)) > ACROSS:
        return None
    normal = np.cross(eye.direction, direction)
    delta = eye.center - origin
    skew = abs(float(delta @ normal)) / float(np.linalg.norm(normal))
    return float(delta @ direction) if skew < 0.5 * radius and abs(float(delta @ eye.direction)) < 12 * radius else None


def with_coaxial_parts(pair: Pair, solids: tuple[Solid, ...], used: set[int], tolerance: float) -> DrawnCylinder:
    """The parts turned about the cylinder's axis, each to the barrel or to the rod."""
    origin, d, r = pair.bore.center, pair.direction, pair.bore.radius
    mouth, bottom = pair.bore.half, -pair.bore.half
    start, end = pair.shaft.interval(origin, d)
    outside = _radius(pair.tube, origin, d)
    barrel, rod = {pair.tube.index}, {pair.bar.index}
    for s in solids:
        if s.index in used or s.index in barrel or s.index in rod or s.line is None or s.reach > 1.7 * outside:
            continue
        if not coaxial(s.line, pair.bore, 0.04, tolerance):
            continue
        low, high = s.span(origin, d)
        if high < bottom - 4 * r or low > end + 2 * r:
            continue
        middle = 0.5 * (low + high)
        error = 2.0 * (pair.bore.error + s.line.error)
        if s.reach <= 1.01 * r + error and high < mouth - 0.05 * r and low > bottom - 0.05 * r:
            # A rod that comes out at both ends has its piston in the middle.
            near_rod = start < bottom or (low <= start + 0.5 * r and high >= start - 1.5 * r)
            (rod if near_rod or middle - start < mouth - middle else barrel).add(s.index)
        elif middle > mouth and s.reach < 1.2 * outside and end - middle < middle - mouth:
            rod.add(s.index)
        else:
            barrel.add(s.index)
    return DrawnCylinder(frozenset(barrel), frozenset(rod), origin, d, r, pair.shaft.radius, fixed=pair.fixed)


def _radius(solid: Solid, origin: Floats, direction: Floats) -> float:
    delta = solid.points - origin
    radial = np.linalg.norm(delta - (delta @ direction)[:, None] * direction, axis=1)
    outer = [c.radius for c in solid.cylinders if not c.inner and c.full]
    return float(min(radial.max(), max(outer, default=float(radial.max()))))
