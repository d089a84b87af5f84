"""What each contact means, before anything is joined: pins and their hosts, rings in bores, faces that may turn."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from yellowiron.alignment.features.ball_joints import is_ball
from yellowiron.alignment.features.contacts import Fit, Flat, SharedAxis, shared_axes_of
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
class ContactEvidence:
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
    - `near`: pairs whose boxes touch; `touching(a, b)` asks the meshes;
    - `halves_within`: metres across a hinge that the two loose halves of one body are apart at most;
    - `rams`: the type has hydraulic cylinders without pins.
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
    halves_within: float = math.inf
    rams: bool = False


@dataclass(frozen=True, eq=False)
class Contacts:
    """What evidence is made of: `fits` of shafts in bores, `bare` empty bores side by side, `flats`, hydraulic
    cylinders, wheels, `near` pairs of solids and what asks whether their meshes touch; `tolerance` in metres. `nests`:
    sections that slide in each other; `stays`: bars that are no pins. Without `holes` what is turned about a pin's axis
    may turn though it has no bore; `rams`: the type has hydraulic cylinders without pins."""

    solids: tuple[Solid, ...]
    fits: list[Fit]
    bare: list[Fit]
    flats: list[Flat]
    cylinders: list[DrawnCylinder]
    wheels: list[Wheel]
    near: list[tuple[int, int]]
    touching: Callable[[int, int], bool]
    tolerance: float
    nests: tuple[Nest, ...] = ()
    stays: frozenset[int] = frozenset()
    holes: bool = True
    rams: bool = False


@dataclass(frozen=True, eq=False)
class _Roles:
    """What solids are before their fits are looked at: solid → its wheel, or half of a hydraulic cylinder (`owner`);
    bars in bores (`fasteners`); rods that are drawn out of their barrels' places (`astray`)."""

    owner: dict[int, tuple[str, int]]
    fasteners: frozenset[int]
    astray: frozenset[int]


@dataclass(frozen=True, eq=False)
class _Fits:
    """Fits by what they mean; the fields are those of `ContactEvidence`, and `number`: fit → axis."""

    number: dict[int, int]
    pinned: dict[int, set[int]]
    hosts: dict[int, list[Fit]] = field(default_factory=dict)
    axes_of: dict[int, set[int]] = field(default_factory=dict)
    pressed: list[Fit] = field(default_factory=list)
    direct: list[tuple[int, Fit]] = field(default_factory=list)
    races: list[tuple[int, Fit]] = field(default_factory=list)

    def pin_on(self, fit: Fit, axis: int) -> None:
        """Both of a fit's solids are on an axis."""
        self.pinned[fit.inner].add(axis)
        self.pinned[fit.outer].add(axis)


def evidence_of(contacts: Contacts, *, slewing: bool = False) -> ContactEvidence:
    """Sorts fits and flat contacts. Fits between a barrel and its rod, and between a wheel and its axle, slide. The
    axes number the fits first, then the bare bores. `slewing`: whatever round thing is as wide as a slewing bearing
    turns in its bore, though it is no thin ring."""
    solids = contacts.solids
    axes = shared_axes_of([*contacts.fits, *contacts.bare], contacts.tolerance)
    roles = _roles_of(contacts)
    fits = _sorted_fits(contacts, axes, roles, slewing=slewing)
    about = _about(solids, axes, fits.pinned, contacts.tolerance, holes=contacts.holes)
    slight = _slight(solids, roles, fits)
    welds, turning = _sorted_flats(contacts, axes, fits, about, roles.fasteners | slight)
    area: dict[tuple[int, int], float] = {}
    for flat in welds:
        area[flat.a, flat.b] = area.get((flat.a, flat.b), 0.0) + flat.area
    return ContactEvidence(
        solids=solids,
        axes=tuple(axes),
        cylinders=tuple(contacts.cylinders),
        wheels=tuple(contacts.wheels),
        near=tuple(contacts.near),
        touching=contacts.touching,
        fasteners=roles.fasteners,
        hosts={p: tuple(f) for p, f in sorted(fits.hosts.items())},
        axes_of={p: tuple(sorted(k)) for p, k in sorted(fits.axes_of.items())},
        pinned={i: frozenset(k) for i, k in fits.pinned.items()},
        about=about,
        slight=slight,
        sheets=frozenset(i for i in slight if _wide(solids[i])),
        bolted=_bolted(axes, contacts.cylinders, solids),
        pressed=tuple((f.inner, f.outer) for f in fits.pressed),
        direct=tuple(fits.direct),
        races=tuple(fits.races),
        welds=tuple(welds),
        turning=tuple(turning),
        area=area,
        nests=contacts.nests,
        rams=contacts.rams,
    )


def _roles_of(contacts: Contacts) -> _Roles:
    owner: dict[int, tuple[str, int]] = {}
    for k, cylinder in enumerate(contacts.cylinders):
        owner.update(dict.fromkeys(cylinder.barrel, ("barrel", k)) | dict.fromkeys(cylinder.rod, ("rod", k)))
    for k, wheel in enumerate(contacts.wheels):
        owner.update(dict.fromkeys(wheel.members, ("wheel", k)))
    inner = {f.inner for f in contacts.fits} - set(owner) - contacts.stays
    fasteners = frozenset(s.index for s in contacts.solids if s.shaft is not None and s.index in inner)
    astray = frozenset(i for cylinder in contacts.cylinders if cylinder.apart for i in cylinder.rod)
    return _Roles(owner, fasteners, astray)


def _sorted_fits(contacts: Contacts, axes: list[SharedAxis], roles: _Roles, *, slewing: bool) -> _Fits:
    """Each fit by what it means: of a fastener in its host, of races, of a ring in its bore, of a part's own shaft. A
    ball turns in its socket, whatever else it is of: a barrel that hangs in one."""
    solids, fasteners, owner = contacts.solids, roles.fasteners, roles.owner
    number = {f: k for k, axis in enumerate(axes) for f in axis.fits}
    fits = _Fits(number, {s.index: set() for s in solids})
    wide = LEAST_SLEWING * size_of(solids)
    for k, fit in enumerate(contacts.fits):
        if {fit.inner, fit.outer} & roles.astray:
            continue
        if fit.inner in fasteners:
            fits.hosts.setdefault(fit.inner, []).append(fit)
            fits.axes_of.setdefault(fit.inner, set()).add(number[k])
            if fit.outer not in fasteners:
                fits.pinned[fit.outer].add(number[k])
        elif fit.outer in fasteners or _slides(fit, owner):
            continue
        elif fit.shaft.radius > wide and (slewing or solids[fit.inner].axis is None or _race(fit, solids)):
            fits.races.append((number[k], fit))
        elif solids[fit.inner].axis is not None and not is_ball(fit, solids[fit.inner]):
            fits.pressed.append(fit)
        else:
            fits.direct.append((number[k], fit))
            fits.pin_on(fit, number[k])
    for axis, fit in fits.races:
        fits.direct.append((axis, fit))
        fits.pin_on(fit, axis)
    for k, fit in enumerate(contacts.bare, len(contacts.fits)):
        if not {fit.inner, fit.outer} & fasteners and _is_eye(fit, owner, contacts.cylinders):
            fits.direct.append((number[k], fit))
            fits.pin_on(fit, number[k])
    _through_rings(fits.pinned, fits.pressed, axes, contacts.tolerance)
    return fits


def _is_eye(fit: Fit, owner: dict[int, tuple[str, int]], cylinders: list[DrawnCylinder]) -> bool:
    """Whether an empty bore of a hydraulic cylinder's own part is its eye, across it; those of wheels are none."""
    owned = [owner[i] for i in (fit.inner, fit.outer) if i in owner]
    return len(owned) < 2 and all(
        kind != "wheel" and abs(float(fit.shaft.direction @ cylinders[k].direction)) < ACROSS for kind, k in owned
    )


def _slides(fit: Fit, owner: dict[int, tuple[str, int]]) -> bool:
    """True for a barrel and its rod, and for whatever turns on a wheel's axis."""
    mine, theirs = owner.get(fit.inner), owner.get(fit.outer)
    return (mine is not None and theirs is not None) or any(o is not None and o[0] == "wheel" for o in (mine, theirs))


def _slight(solids: tuple[Solid, ...], roles: _Roles, fits: _Fits) -> frozenset[int]:
    """Hoses, rails and sheets on no axis, and rods that are astray."""
    held = {i for f in fits.pressed for i in (f.inner, f.outer)} | set(roles.owner)
    thin = (s.index for s in solids if not fits.pinned[s.index] and s.index not in held and s.slight)
    return roles.astray | frozenset(thin)


def _sorted_flats(
    contacts: Contacts, axes: list[SharedAxis], fits: _Fits, about: dict[int, frozenset[int]], idle: frozenset[int]
) -> tuple[list[Flat], list[Flat]]:
    """Flat contacts that hold and those that allow turning, largest first, save those of `idle` solids and of sections
    that slide on each other."""
    sliding = sliding_pairs(contacts.nests, contacts.flats)
    welds: list[Flat] = []
    turning: list[Flat] = []
    for flat in sorted(contacts.flats, key=lambda f: (-round(f.area, 9), f.a, f.b)):
        if not {flat.a, flat.b} & idle and (flat.a, flat.b) not in sliding:
            (turning if _may_turn(flat, axes, fits.pinned, about) else welds).append(flat)
    return welds, turning


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


def runs_across(axis: SharedAxis, cylinder: DrawnCylinder) -> bool:
    """True if an axis runs across a hydraulic cylinder's axis: through one of its eyes, or its trunnion."""
    if abs(float(axis.direction @ cylinder.direction)) > ACROSS:
        return False
    normal = np.cross(axis.direction, cylinder.direction)
    return abs(float((axis.origin - cylinder.origin) @ normal)) / float(np.linalg.norm(normal)) < 0.6 * cylinder.bore


def _bolted(axes: list[SharedAxis], cylinders: list[DrawnCylinder], solids: tuple[Solid, ...]) -> frozenset[int]:
    eyes = [
        ln.radius
        for ln in axes
        for cylinder in cylinders
        if runs_across(ln, cylinder) and ln.radius > 0.2 * cylinder.bore
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
