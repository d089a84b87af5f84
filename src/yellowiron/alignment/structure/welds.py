"""Joining what holds together, and being careful about it: one false weld between two bodies sinks a whole machine.

A pin that nothing turns on is a contradiction, and so are two bodies with two hinges between them. Careful welding
joins first what raises no suspicion, then the least suspicious, and keeps back what would end in such a contradiction.
"""

from __future__ import annotations

import math

from yellowiron.alignment.features.contacts import SharedAxis
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.structure.contact_evidence import ContactEvidence
from yellowiron.alignment.structure.rigid_groups import Groups

Pairs = list[tuple[int, int]]
AxesByGroup = dict[int, set[int]]
"""Group → the pin lines it is on."""


def axes_by_group(groups: Groups, evidence: ContactEvidence, *, without: frozenset[int] = frozenset()) -> AxesByGroup:
    """Group → the axes that its members share with pins and bolts, save those `without`."""
    result: AxesByGroup = {}
    for i, on in evidence.pinned.items():
        if i not in evidence.fasteners and on - without:
            result.setdefault(groups.find(i), set()).update(on - without)
    return result


def join_doubly_pinned(groups: Groups, evidence: ContactEvidence) -> None:
    """Two distinct axes in common weld, again and again until nothing changes; not what is too far apart to be the two
    loose halves of one body (`halves_within`): arms to the left and to the right of a machine share their hinges' lines
    too."""
    changed = True
    while changed:
        changed = False
        on = axes_by_group(groups, evidence)
        pairs = {(a, b) for found in _by_axis(on).values() for a in found for b in found if a < b}
        for a, b in sorted(pairs):
            common = on[a] & on[b]
            if groups.find(a) == groups.find(b) or len(common) < 2 or _far_apart(groups, evidence, a, b, min(common)):
                continue
            changed |= groups.join(a, b)


def _far_apart(groups: Groups, evidence: ContactEvidence, a: int, b: int, axis: int) -> bool:
    """True if two groups are farther apart along a common axis than loose halves of one body are."""
    if evidence.halves_within == math.inf:
        return False
    along = evidence.axes[axis].direction
    reach = {a: [math.inf, -math.inf], b: [math.inf, -math.inf]}
    for solid in evidence.solids:
        ends = reach.get(groups.find(solid.index))
        if ends is not None:
            places = solid.points @ along
            ends[:] = min(ends[0], float(places.min())), max(ends[1], float(places.max()))
    return max(reach[a][0] - reach[b][1], reach[b][0] - reach[a][1]) > evidence.halves_within


def weld(groups: Groups, evidence: ContactEvidence, pairs: Pairs, *, careful: bool) -> Pairs:
    """Joins pairs of solids, strongest first as given; returns those that a careful one kept back."""
    if not careful:
        for a, b in pairs:
            groups.join(a, b)
        join_doubly_pinned(groups, evidence)
        return []
    waiting = pairs
    while True:
        before = len(waiting)
        waiting = _plain(groups, evidence, waiting)
        join_doubly_pinned(groups, evidence)
        if len(waiting) < before:
            continue
        pair = _least_suspicious(groups, evidence, waiting)
        if pair is None:
            return waiting
        groups.join(*pair)
        join_doubly_pinned(groups, evidence)


def _by_axis(on: AxesByGroup) -> dict[int, list[int]]:
    result: dict[int, list[int]] = {}
    for group in sorted(on):
        for k in on[group]:
            result.setdefault(k, []).append(group)
    return result


def _plain(groups: Groups, evidence: ContactEvidence, pairs: Pairs) -> Pairs:
    """Joins the pairs whose groups share no pin line and hinge on no common third; returns the others."""
    on = axes_by_group(groups, evidence, without=evidence.bolted)
    by_axis = _by_axis(on)

    def beside(axes: set[int]) -> set[int]:
        return {groups.find(g) for k in axes for g in by_axis[k]}

    rest: Pairs = []
    for a, b in pairs:
        ga, gb = groups.find(a), groups.find(b)
        if ga == gb or not groups.may_join(ga, gb):
            continue
        la, lb = on.get(ga, set()), on.get(gb, set())
        thirds = (beside(la) & beside(lb)) - {ga, gb} if la and lb else set()
        if la & lb or any(
            _hinges(groups, evidence, t, ga, la, on) and _hinges(groups, evidence, t, gb, lb, on) for t in thirds
        ):
            rest.append((a, b))
            continue
        groups.join(ga, gb)
        on.pop(ga, None)
        on.pop(gb, None)
        on[groups.find(ga)] = la | lb
    return rest


def _hinges(groups: Groups, evidence: ContactEvidence, third: int, group: int, axes: set[int], on: AxesByGroup) -> bool:
    """True if a third group hinges on one of these axes beside a group, not on the machine's other side."""
    return any(not _far_apart(groups, evidence, third, group, k) for k in axes & on.get(third, set()))


def _least_suspicious(groups: Groups, evidence: ContactEvidence, pairs: Pairs) -> tuple[int, int] | None:
    """The pair whose smaller group is on the fewest axes, among those that leave something turning on each axis."""
    on = axes_by_group(groups, evidence, without=evidence.bolted)
    by_axis = _by_axis(on)
    members: dict[int, list[Solid]] = {}
    for s in evidence.solids:
        members.setdefault(groups.find(s.index), []).append(s)
    loose = {k: {g for g in found if _loose(members.get(g, []), evidence.axes[k])} for k, found in by_axis.items()}
    best: tuple[tuple[int, int, int], tuple[int, int]] | None = None
    for order, (a, b) in enumerate(pairs):
        ga, gb = groups.find(a), groups.find(b)
        if ga == gb or not groups.may_join(ga, gb) or ga not in members or gb not in members:
            continue
        la, lb = on.get(ga, set()), on.get(gb, set())
        common = la & lb
        if len(common) != 1 or groups.kind(ga) or groups.kind(gb):
            continue
        k = next(iter(common))
        if not set(by_axis[k]) - {ga, gb} - loose[k]:
            continue
        key = (min(len(la), len(lb)), len(la) + len(lb), order)
        if best is None or key < best[0]:
            best = (key, (a, b))
    return best[1] if best is not None else None


def _loose(members: list[Solid], axis: SharedAxis) -> bool:
    """True for washers and spacers: groups of nothing but rings about the axis."""
    return all(_turned_about(s, axis) for s in members)


def _turned_about(s: Solid, axis: SharedAxis) -> bool:
    return s.axis is not None and axis.off(s.axis.center) < 0.1 * axis.radius
