"""Rigid clusters and the hinges between them.

What welds: flat contact, a ring in a bore, and two distinct pin lines in common. What never welds alone: contact across a
shared pin line (it may turn), and mere touching. A barrel, a rod or a wheel is never welded to another of these.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from yellowiron.align.contacts import PARALLEL, Fit, Flat, Line
from yellowiron.align.hydraulics import Ram
from yellowiron.align.solids import Solid
from yellowiron.align.wheels import Wheel


@dataclass(frozen=True)
class Cluster:
    """Solids that move as one. `kind`: `wheel`, `barrel`, `rod` or ""; `number` of that wheel or cylinder."""

    members: frozenset[int]
    kind: str = ""
    number: int = -1


@dataclass(frozen=True)
class Hinge:
    """Clusters `a` < `b` turn against each other about line `line`; `pins` are the solids through both."""

    a: int
    b: int
    line: int
    pins: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Structure:
    """What geometry alone says: clusters, hinges between them, slides (barrel, rod), the pins and bolts left out, and
    for each of these its hosts (solids with a bore around it)."""

    clusters: tuple[Cluster, ...]
    hinges: tuple[Hinge, ...]
    slides: tuple[tuple[int, int, int], ...]
    lines: tuple[Line, ...]
    hosts: dict[int, tuple[Fit, ...]] = field(default_factory=dict)


class _Groups:
    """Union-find that refuses to join two labelled groups, and leaves frozen ones alone."""

    def __init__(self, count: int) -> None:
        self.parent = list(range(count))
        self.label: dict[int, tuple[str, int]] = {}

    def find(self, i: int) -> int:
        while self.parent[i] != i:
            self.parent[i] = self.parent[self.parent[i]]
            i = self.parent[i]
        return i

    def tag(self, members: frozenset[int], label: tuple[str, int]) -> None:
        first, *rest = sorted(members)
        for other in rest:
            self.parent[self.find(other)] = self.find(first)
        self.label[self.find(first)] = label

    def kind(self, i: int) -> str:
        return self.label.get(self.find(i), ("", -1))[0]

    def join(self, i: int, j: int) -> bool:
        a, b = self.find(i), self.find(j)
        if a == b:
            return True
        la, lb = self.label.get(a), self.label.get(b)
        if (la is not None and lb is not None) or "wheel" in (self.kind(a), self.kind(b)):
            return False
        a, b = min(a, b), max(a, b)
        self.parent[b] = a
        label = la or lb
        self.label.pop(b, None)
        if label is not None:
            self.label[a] = label
        return True


def structure_of(
    solids: tuple[Solid, ...],
    fits: list[Fit],
    lines: list[Line],
    flats: list[Flat],
    rams: list[Ram],
    wheels: list[Wheel],
    *,
    touching: Callable[[int, int], bool],
    near: list[tuple[int, int]],
    leaves: bool,
    weak: bool = False,
) -> Structure:
    """Clusters and hinges. `touching(a, b)` tells whether two solids touch (asked sparingly), `near` the pairs whose
    boxes do; `leaves`: the template has bodies that hang on a single hinge; `weak`: groups that only touch are joined
    too (where the machine is not whole without)."""
    special = {i for r in rams for i in r.barrel | r.rod} | {i for w in wheels for i in w.members}
    inner = {f.inner for f in fits}
    fasteners = {s.index for s in solids if s.shaft is not None and s.index in inner and s.index not in special}
    groups = _Groups(len(solids))
    for k, ram in enumerate(rams):
        groups.tag(ram.barrel, ("barrel", k))
        groups.tag(ram.rod, ("rod", k))
    for k, wheel in enumerate(wheels):
        groups.tag(wheel.members, ("wheel", k))

    line_of = {f: k for k, line in enumerate(lines) for f in line.fits}
    pinned: dict[int, set[int]] = {s.index: set() for s in solids}
    hosts: dict[int, list[Fit]] = {}
    direct: list[tuple[int, Fit]] = []
    for k, fit in enumerate(fits):
        if fit.inner in fasteners:
            hosts.setdefault(fit.inner, []).append(fit)
            if fit.outer not in fasteners:
                pinned[fit.outer].add(line_of[k])
        elif fit.outer in fasteners or groups.find(fit.inner) == groups.find(fit.outer):
            continue
        elif _sliding(groups, fit):
            continue
        elif solids[fit.inner].axis is not None:
            groups.join(fit.inner, fit.outer)
        else:
            direct.append((line_of[k], fit))
            pinned[fit.inner].add(line_of[k])
            pinned[fit.outer].add(line_of[k])
    rails = [k for k in range(len(lines)) if any(k in p for p in pinned.values())]
    about = _about(solids, lines, rails)

    turning: list[Flat] = []
    for flat in sorted(flats, key=lambda f: (-round(f.area, 9), f.a, f.b)):
        if flat.a in fasteners or flat.b in fasteners:
            continue
        if _may_turn(flat, lines, pinned, about):
            turning.append(flat)
        else:
            groups.join(flat.a, flat.b)

    def lines_by_group() -> dict[int, set[int]]:
        result: dict[int, set[int]] = {}
        for i, on in pinned.items():
            if i not in fasteners:
                result.setdefault(groups.find(i), set()).update(on)
        return result

    _join_doubly_pinned(groups, lines_by_group)
    _attach_eyes(groups, solids, rams, lines, pinned, near, touching, fasteners)
    _join_doubly_pinned(groups, lines_by_group)
    wheel_lines = _wheel_lines(groups, solids, wheels, fasteners)
    _absorb_leaves(groups, solids, turning, lines_by_group, wheel_lines, leaves=leaves)
    if weak:
        _join_touching(groups, near, touching, about, fasteners)
        _join_doubly_pinned(groups, lines_by_group)
    return _collect(solids, groups, fasteners, hosts, direct, lines, line_of, fits, rams, wheels)


def _sliding(groups: _Groups, fit: Fit) -> bool:
    a, b = groups.kind(fit.inner), groups.kind(fit.outer)
    return "wheel" in (a, b) or (a != "" and b != "")


def _about(solids: tuple[Solid, ...], lines: list[Line], rails: list[int]) -> dict[int, set[int]]:
    """Solid → the pin lines that one of its cylinders lies about, whatever its radius."""
    about: dict[int, set[int]] = {s.index: set() for s in solids}
    if not rails:
        return about
    origins = np.array([lines[k].origin for k in rails])
    directions = np.array([lines[k].direction for k in rails])
    radii = np.array([lines[k].radius for k in rails])
    for s in solids:
        for c in s.cylinders:
            delta = c.center - origins
            off = np.linalg.norm(delta - np.einsum("ij,ij->i", delta, directions)[:, None] * directions, axis=1)
            good = (np.abs(directions @ c.direction) > PARALLEL) & (off < 0.05 * radii) & (c.arc > 2.0)
            about[s.index] |= {rails[i] for i in np.flatnonzero(good)}
    return about


def _may_turn(flat: Flat, lines: list[Line], pinned: dict[int, set[int]], about: dict[int, set[int]]) -> bool:
    """True where a contact allows turning about a line that both parts are on."""
    for k in sorted(about[flat.a] & about[flat.b]):
        line = lines[k]
        if abs(float(flat.normal @ line.direction)) < PARALLEL:
            continue
        if k in pinned[flat.a] and k in pinned[flat.b]:
            return True
        if line.off(flat.center) < 0.25 * flat.width:
            return True
    return False


def _join_doubly_pinned(groups: _Groups, lines_by_group: Callable[[], dict[int, set[int]]]) -> None:
    """Two distinct lines in common weld, again and again until nothing changes."""
    changed = True
    while changed:
        changed = False
        on = lines_by_group()
        by_line: dict[int, list[int]] = {}
        for group in sorted(on):
            for k in on[group]:
                by_line.setdefault(k, []).append(group)
        pairs = {(a, b) for found in by_line.values() for a in found for b in found if a < b}
        for a, b in sorted(pairs):
            if groups.find(a) != groups.find(b) and len(on[a] & on[b]) >= 2 and groups.join(a, b):
                changed = True


def _attach_eyes(
    groups: _Groups, solids: tuple[Solid, ...], rams: list[Ram], lines: list[Line], pinned: dict[int, set[int]],
    near: list[tuple[int, int]], touching: Callable[[int, int], bool], fasteners: set[int],
) -> None:  # fmt: skip
    """A barrel or rod without a pin line across it takes the touching group that has one."""
    for ram in rams:
        for part in (ram.barrel, ram.rod):
            root = groups.find(min(part))
            mine = {i for i in range(len(solids)) if groups.find(i) == root}
            if any(_crosses(lines[k], ram) for i in mine for k in pinned[i]):
                continue
            candidates = sorted(
                {(a if b in mine else b, b if b in mine else a) for a, b in near if (a in mine) != (b in mine)}
            )
            for other, own in candidates:
                if other in fasteners or not any(_crosses(lines[k], ram) for k in pinned[other]):
                    continue
                if touching(own, other) and groups.join(own, other):
                    break


def _crosses(line: Line, ram: Ram) -> bool:
    if abs(float(line.direction @ ram.direction)) > 0.05:
        return False
    normal = np.cross(line.direction, ram.direction)
    return abs(float((line.origin - ram.origin) @ normal)) / float(np.linalg.norm(normal)) < 0.6 * ram.bore


def _wheel_lines(
    groups: _Groups, solids: tuple[Solid, ...], wheels: list[Wheel], fasteners: set[int]
) -> dict[int, set[int]]:
    """Group → numbers of the wheels whose axis one of its cylinders lies about, near that wheel."""
    result: dict[int, set[int]] = {}
    for k, wheel in enumerate(wheels):
        for s in solids:
            if s.index in fasteners or groups.kind(s.index) == "wheel":
                continue
            if _beside(s, wheel):
                result.setdefault(groups.find(s.index), set()).add(k)
    return result


def _beside(s: Solid, wheel: Wheel) -> bool:
    for c in s.cylinders:
        if (
            c.arc < 2.0
            or abs(float(c.direction @ wheel.direction)) < PARALLEL
            or c.off(wheel.center) > 0.02 * wheel.radius
        ):
            continue
        low, high = c.interval(wheel.center, wheel.direction)
        if low < 1.0 * wheel.width and high > -1.0 * wheel.width:
            return True
    return False


def _absorb_leaves(
    groups: _Groups, solids: tuple[Solid, ...], turning: list[Flat], lines_by_group: Callable[[], dict[int, set[int]]],
    wheel_lines: dict[int, set[int]], *, leaves: bool,
) -> None:  # fmt: skip
    """Rings and spacers on a single line go with the only group they lie against."""
    on = lines_by_group()
    partners: dict[int, set[int]] = {}
    members: dict[int, list[int]] = {}
    for s in solids:
        members.setdefault(groups.find(s.index), []).append(s.index)
    for flat in turning:
        a, b = groups.find(flat.a), groups.find(flat.b)
        if a != b and "wheel" not in (groups.kind(a), groups.kind(b)):
            partners.setdefault(a, set()).add(b)
            partners.setdefault(b, set()).add(a)
    for group in sorted(partners):
        if groups.kind(group) or groups.find(group) != group:
            continue
        lines = len(on.get(group, set())) + len(wheel_lines.get(group, set()))
        rings = all(solids[i].axis is not None for i in members[group])
        found = {groups.find(p) for p in partners[group]} - {group}
        if lines <= 1 and (rings or (not leaves and not wheel_lines.get(group))) and len(found) == 1:
            groups.join(group, found.pop())


def _join_touching(
    groups: _Groups,
    near: list[tuple[int, int]],
    touching: Callable[[int, int], bool],
    about: dict[int, set[int]],
    fasteners: set[int],
) -> None:
    """Parts drawn into each other, or touching, belong together unless both lie about one pin line."""
    for a, b in near:
        if a in fasteners or b in fasteners or about[a] & about[b]:
            continue
        kinds = groups.kind(a), groups.kind(b)
        if groups.find(a) == groups.find(b) or "wheel" in kinds or all(kinds):
            continue
        if touching(a, b):
            groups.join(a, b)


def _collect(
    solids: tuple[Solid, ...], groups: _Groups, fasteners: set[int], hosts: dict[int, list[Fit]],
    direct: list[tuple[int, Fit]], lines: list[Line], line_of: dict[int, int], fits: list[Fit], rams: list[Ram], wheels: list[Wheel],
) -> Structure:  # fmt: skip
    gathered: dict[int, set[int]] = {}
    for s in solids:
        if s.index not in fasteners:
            gathered.setdefault(groups.find(s.index), set()).add(s.index)
    roots = sorted(gathered)
    number = {root: k for k, root in enumerate(roots)}
    clusters = tuple(Cluster(frozenset(gathered[r]), *groups.label.get(r, ("", -1))) for r in roots)

    def cluster(i: int) -> int:
        return number[groups.find(i)]

    pins: dict[tuple[int, int, int], set[int]] = {}
    for pin, around in hosts.items():
        for k in sorted({line_of[i] for i, f in enumerate(fits) if f.inner == pin}):
            found = sorted({cluster(f.outer) for f in around if f.outer not in fasteners})
            for x, a in enumerate(found):
                for b in found[x + 1 :]:
                    pins.setdefault((a, b, k), set()).add(pin)
    for k, fit in direct:
        a, b = sorted((cluster(fit.inner), cluster(fit.outer)))
        if a != b:
            pins.setdefault((a, b, k), set())
    all_lines = list(lines)
    for w, wheel in enumerate(wheels):
        own = cluster(wheel.tyre)
        beside = sorted({cluster(s.index) for s in solids if s.index not in fasteners and _beside(s, wheel)} - {own})
        all_lines.append(Line(wheel.center, wheel.direction, wheel.radius, ()))
        for other in beside:
            if clusters[other].kind != "wheel":
                pins.setdefault((min(own, other), max(own, other), len(lines) + w), set())
    hinges = tuple(Hinge(a, b, k, tuple(sorted(p))) for (a, b, k), p in sorted(pins.items()))
    slides = tuple((cluster(min(r.barrel)), cluster(min(r.rod)), k) for k, r in enumerate(rams))
    return Structure(clusters, hinges, slides, tuple(all_lines), {p: tuple(f) for p, f in sorted(hosts.items())})
