"""What each contact means, before anything is joined: pins and their hosts, rings in bores, faces that may turn."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from yellowiron.alignment.features.contacts import Fit, Flat, SharedAxis
from yellowiron.alignment.features.cylinders import DrawnCylinder
from yellowiron.alignment.features.solids import Cyl, Solid, coaxial, size_of
from yellowiron.alignment.features.telescopes import Nest, sliding_pairs
from yellowiron.alignment.features.wheels import Wheel
from yellowiron.alignment.tolerances import ACROSS, LEAST_SLEWING, PARALLEL

WIDE = 6.0
"""A sheet is this many times wider than thick; a hose is about three."""
THIN = 0.6
"""The least radius of the hole in each race of a slewing bearing, as a share of its outer radius."""


@dataclass(frozen=True, eq=False)
class Evidence:
    """The contacts of a CAD model, sorted by what they can mean.

    - `fasteners`: bars in bores (pins, bolts, shafts), which join nothing themselves;
    - `hosts`: fastener → the fits of the solids around it; `axes_of`: fastener → its axes;
    - `pinned`: solid → the axes it shares with a fastener (through a bush, too) or with another solid's shaft;
    - `about`: `pinned`, and for rings the axes that run through them;
    - `slight`: hoses, rails and sheets on no pin line, which go with others but hold nothing together; `sheets` of them
      are wide and flat, and may hold what only touches;
    - `bolted`: axes too thin to be a pivot, next to those through the cylinders' eyes;
    - `pressed`: rings in bores, (ring, host), which stay where they are;
    - `direct`: shafts of structural parts in bores, `races` of slewing bearings, empty bores side by side, (axis, fit);
    - `welds`, `turning`: flat contacts that hold, and those that allow turning about a shared axis;
    - `area`: m² of flat contact of a pair;
    - `nests`: sections that slide in each other;
    - `near`: pairs whose boxes touch; `touching(a, b)` asks the meshes.
    """

    solids: tuple[Solid, ...]
    axes: tuple[SharedAxis, ...]
    cylinders: tuple[DrawnCylinder, ...]
    wheels: tuple[Wheel, ...]
    near: tuple[tuple[int, int], ...]
    touching: Callable[[int, int], bool]
    fasteners: frozenset[int]
    hosts: dict[int, tuple[Fit, ...]]
    axes_of: dict[int, tuple[int, ...]]
    pinned: dict[int, frozenset[int]]
    about: dict[int, frozenset[int]]
    slight: frozenset[int]
    sheets: frozenset[int]
    bolted: frozenset[int]
    pressed: tuple[tuple[int, int], ...]
    direct: tuple[tuple[int, Fit], ...]
    races: tuple[tuple[int, Fit], ...]
    welds: tuple[Flat, ...]
    turning: tuple[Flat, ...]
    area: dict[tuple[int, int], float]
    nests: tuple[Nest, ...] = ()


def evidence_of(
    solids: tuple[Solid, ...],
    fits: list[Fit],
    bare: list[Fit],
    axes: list[SharedAxis],
    flats: list[Flat],
    cylinders: list[DrawnCylinder],
    wheels: list[Wheel],
    near: list[tuple[int, int]],
    touching: Callable[[int, int], bool],
    tolerance: float,
    *,
    slewing: bool = False,
    nests: tuple[Nest, ...] = (),
    stays: frozenset[int] = frozenset(),
    holes: bool = True,
) -> Evidence:
    """Sorts fits and flat contacts. Fits between a barrel and its rod, and between a wheel and its axle, slide. `bare`:
    empty bores side by side; `axes` number the fits first, then these. `slewing`: whatever round thing is as wide as a
    slewing bearing turns in its bore, though it is no thin ring. `stays`: bars that are no pins. Without `holes`
    what is turned about a pin's axis may turn though it has no bore."""
    owner: dict[int, tuple[str, int]] = {}
    for k, cylinder in enumerate(cylinders):
        owner.update(dict.fromkeys(cylinder.barrel, ("barrel", k)) | dict.fromkeys(cylinder.rod, ("rod", k)))
    for k, wheel in enumerate(wheels):
        owner.update(dict.fromkeys(wheel.members, ("wheel", k)))
    inner = {f.inner for f in fits}
    fasteners = frozenset(
        s.index
        for s in solids
        if s.shaft is not None and s.index in inner and s.index not in owner and s.index not in stays
    )
    number = {f: k for k, axis in enumerate(axes) for f in axis.fits}
    hosts: dict[int, list[Fit]] = {}
    axes_of: dict[int, set[int]] = {}
    pinned: dict[int, set[int]] = {s.index: set() for s in solids}
    size = size_of(solids)
    wide = LEAST_SLEWING * size
    pressed: list[Fit] = []
    direct: list[tuple[int, Fit]] = []
    races: list[tuple[int, Fit]] = []
    astray = {i for cylinder in cylinders if cylinder.apart for i in cylinder.rod}
    for k, fit in enumerate(fits):
        if {fit.inner, fit.outer} & astray:
            continue
        mine, theirs = owner.get(fit.inner), owner.get(fit.outer)
        if fit.inner in fasteners:
            hosts.setdefault(fit.inner, []).append(fit)
            axes_of.setdefault(fit.inner, set()).add(number[k])
            if fit.outer not in fasteners:
                pinned[fit.outer].add(number[k])
        elif fit.outer in fasteners or (mine is not None and theirs is not None) or _of_wheel(mine, theirs):
            continue
        elif fit.shaft.radius > wide and (slewing or solids[fit.inner].axis is None or _race(fit, solids)):
            races.append((number[k], fit))
        elif solids[fit.inner].axis is not None:
            pressed.append(fit)
        else:
            direct.append((number[k], fit))
            pinned[fit.inner].add(number[k])
            pinned[fit.outer].add(number[k])
    for k, fit in races:
        direct.append((k, fit))
        pinned[fit.inner].add(k)
        pinned[fit.outer].add(k)
    for k, fit in enumerate(bare, len(fits)):
        if not {fit.inner, fit.outer} & (fasteners | set(owner)):
            direct.append((number[k], fit))
            pinned[fit.inner].add(number[k])
            pinned[fit.outer].add(number[k])
    _through_rings(pinned, pressed, axes, tolerance)
    about = _about(solids, axes, pinned, tolerance, holes=holes)
    held = {i for f in pressed for i in (f.inner, f.outer)} | set(owner)
    slight = frozenset(astray) | frozenset(
        s.index for s in solids if not pinned[s.index] and s.index not in held and s.slight
    )
    sliding = sliding_pairs(nests, flats)
    welds: list[Flat] = []
    turning: list[Flat] = []
    for flat in sorted(flats, key=lambda f: (-round(f.area, 9), f.a, f.b)):
        if not {flat.a, flat.b} & (fasteners | slight) and (flat.a, flat.b) not in sliding:
            (turning if _may_turn(flat, axes, pinned, about) else welds).append(flat)
    area: dict[tuple[int, int], float] = {}
    for flat in welds:
        area[flat.a, flat.b] = area.get((flat.a, flat.b), 0.0) + flat.area
    return Evidence(
        solids,
        tuple(axes),
        tuple(cylinders),
        tuple(wheels),
        tuple(near),
        touching,
        fasteners,
        {p: tuple(f) for p, f in sorted(hosts.items())},
        {p: tuple(sorted(k)) for p, k in sorted(axes_of.items())},
        {i: frozenset(k) for i, k in pinned.items()},
        about,
        slight,
        frozenset(i for i in slight if _wide(solids[i])),
        _bolted(axes, cylinders, solids),
        tuple((f.inner, f.outer) for f in pressed),
        tuple(direct),
        tuple(races),
        tuple(welds),
        tuple(turning),
        area,
        nests,
    )


def _wide(s: Solid) -> bool:
    """True for a thin part much wider than thick, and no pipe: area²/(4·volume·length) is width over thickness."""
    area = s.surface
    round_ = sum(c.radius * c.arc * 2 * c.half for c in s.cylinders if c.full)
    return bool(s.volume > 0 and area**2 > WIDE * 4 * s.volume * s.size and round_ < 0.2 * area)


def _race(fit: Fit, solids: tuple[Solid, ...]) -> bool:
    """True for two wide thin rings one in the other: the races of a slewing bearing, which turn."""
    return all(s.axis is not None and s.hole > THIN * s.reach for s in (solids[fit.inner], solids[fit.outer]))


def tables_of(solids: tuple[Solid, ...], flats: list[Flat]) -> list[Fit]:
    """A fit for every two parts that lie flat on each other with round ends about one axis, as wide as a slewing
    bearing: a turntable that is only drawn as faces."""
    if not solids:
        return []
    size = size_of(solids)
    found = []
    for flat in flats:
        for a, b in itertools.product(*(_ends(solids[i], flat, LEAST_SLEWING * size) for i in (flat.a, flat.b))):
            if coaxial(a, b, 0.02):
                found.append(Fit(flat.a, flat.b, a, b, 0.0, b.off(a.center)))
                break
    return found


def _ends(solid: Solid, flat: Flat, least: float) -> list[Cyl]:
    """The round bosses of a part, of at least a radius, that end at a flat contact; its axis, if it is round itself."""
    bosses = [solid.axis] if solid.axis is not None else [c for c in solid.cylinders if c.full and not c.inner]
    return [
        c
        for c in bosses
        if c.radius >= least
        and abs(float(flat.normal @ c.direction)) > PARALLEL
        and (c is solid.axis or abs(abs(float((flat.center - c.center) @ c.direction)) - c.half) < 0.05 * c.radius)
    ]


def _of_wheel(mine: tuple[str, int] | None, theirs: tuple[str, int] | None) -> bool:
    return any(o is not None and o[0] == "wheel" for o in (mine, theirs))


def crosses(axis: SharedAxis, cylinder: DrawnCylinder) -> bool:
    """True if an axis runs across a hydraulic cylinder's axis: through one of its eyes, or its trunnion."""
    if abs(float(axis.direction @ cylinder.direction)) > ACROSS:
        return False
    normal = np.cross(axis.direction, cylinder.direction)
    return abs(float((axis.origin - cylinder.origin) @ normal)) / float(np.linalg.norm(normal)) < 0.6 * cylinder.bore


def _bolted(axes: list[SharedAxis], cylinders: list[DrawnCylinder], solids: tuple[Solid, ...]) -> frozenset[int]:
    eyes = [
        ln.radius for ln in axes for cylinder in cylinders if crosses(ln, cylinder) and ln.radius > 0.2 * cylinder.bore
    ]
    size = size_of(solids)
    least = 0.7 * min(eyes) if eyes else 0.0018 * size
    return frozenset(k for k, axis in enumerate(axes) if axis.radius < least)


def _through_rings(pinned: dict[int, set[int]], pressed: list[Fit], axes: list[SharedAxis], tolerance: float) -> None:
    """What holds a bush is on the axis of the pin in the bush."""
    changed = True
    while changed:
        changed = False
        for fit in pressed:
            for k in sorted(pinned[fit.inner] - pinned[fit.outer]):
                if axes[k].off(fit.bore.center) < max(2 * tolerance, 0.1 * axes[k].radius):
                    pinned[fit.outer].add(k)
                    changed = True


def _about(
    solids: tuple[Solid, ...], axes: list[SharedAxis], pinned: dict[int, set[int]], tolerance: float, *, holes: bool
) -> dict[int, frozenset[int]]:
    about = {i: frozenset(on) for i, on in pinned.items()}
    rails = sorted({k for on in pinned.values() for k in on})
    if not rails:
        return about
    origins = np.array([axes[k].origin for k in rails])
    directions = np.array([axes[k].direction for k in rails])
    radii = np.array([axes[k].radius for k in rails])
    for s in solids:
        if s.axis is None or (holes and s.hole == 0.0):
            continue
        delta = s.axis.center - origins
        off = np.linalg.norm(delta - np.einsum("ij,ij->i", delta, directions)[:, None] * directions, axis=1)
        parallel = np.abs(directions @ s.axis.direction) > PARALLEL
        good = parallel & (off < np.maximum(2 * tolerance, 0.05 * radii)) & (not holes or s.hole > 0.95 * radii)
        about[s.index] |= {rails[i] for i in np.flatnonzero(good)}
    return about


def _may_turn(
    flat: Flat, axes: list[SharedAxis], pinned: dict[int, set[int]], about: dict[int, frozenset[int]]
) -> bool:
    """True where a contact allows turning about an axis that both parts are on."""
    for k in sorted(about[flat.a] & about[flat.b]):
        axis = axes[k]
        if abs(float(flat.normal @ axis.direction)) < PARALLEL:
            continue
        if k in pinned[flat.a] and k in pinned[flat.b]:
            return True
        if axis.off(flat.center) < 0.25 * flat.width:
            return True
    return False
