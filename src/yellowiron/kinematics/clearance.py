"""Bodies that go through each other on the way of the strokes: which pairs, how deep, and in what pose.

Engines are told that a machine does not collide with itself, so nothing else says it: a bucket in the cab is a stroke
or a pin that is wrong, or a pose that the real machine's operator keeps away from.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from yellowiron.kinematics.solver.chain import ClosedChain, State
from yellowiron.kinematics.solver.pose_grid import explore
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import DEFAULT, ESTIMATE, UNKNOWN, Mechanism
from yellowiron.support.convex.solids import Convex
from yellowiron.support.vectors import Wound

DEEP = 0.02
"""Metres: what is no deeper than this only touches."""
_TRIED = 4
"""So many of the poses in which two bodies' solids are deepest in each other are looked at by what is drawn …"""
_LOOKED_AT = 40
"""… and so many of the deepest points."""
_POSES = 400
"""Poses in which two bodies are looked at, at most …"""
_FINEST = 15
"""… and of one coordinate."""
_GRAIN = 1.0 / 60.0
"""Of a body's size: how far apart the points of its surface are that stand for it."""
_INSIDE = 0.8
"""Of a winding number: what is drawn closed has 1 inside; between two plates of what is drawn open it may be half."""
_MOVES = 1e-6
_NAMED = 2
"""Of pairs that the same drivers lead to, how many are named beside the deepest."""


@dataclass(frozen=True)
class Meeting:
    """Two bodies of which one goes `depth` metres deeper into the other than as drawn, where the driven coordinates
    are at `at` (m, rad)."""

    one: str
    other: str
    depth: float
    at: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class Outline:
    """What a body is of, in its own frame, metres: the convex `solids` that it collides as, which may fill its hollows,
    and the `triangles` (n, 3, 3) that are drawn of it."""

    solids: Sequence[Convex]
    triangles: Floats


@dataclass(eq=False)
class _Body:
    """An outline, points (n, 3) on its solids' surfaces, and the boxes (solids, 3) of these."""

    outline: Outline
    points: Floats
    lows: Floats
    highs: Floats

    @staticmethod
    def of(outline: Outline) -> _Body:
        corners = np.concatenate([solid.corners for solid in outline.solids])
        grain = max(_GRAIN * float(np.linalg.norm(np.ptp(corners, axis=0))), 1e-3)
        points = np.concatenate([solid.surface(4.0 * grain) for solid in outline.solids])
        _, first = np.unique(np.round(points / grain), axis=0, return_index=True)
        lows, highs = (np.array([getattr(solid, end) for solid in outline.solids]) for end in ("low", "high"))
        return _Body(outline, points[np.sort(first)], lows, highs)

    @functools.cached_property
    def box(self) -> tuple[Floats, Floats]:
        return self.lows.min(axis=0), self.highs.max(axis=0)

    @functools.cached_property
    def wound(self) -> Wound:
        return Wound.of(self.outline.triangles)

    def depths(self, points: Floats) -> Floats:
        """How deep points (n, 3) are in one of its solids, 0 for those outside."""
        found = np.zeros(len(points))
        low, high = self.box
        rows = np.flatnonzero(_between_corners(points, low, high))
        if not len(rows):
            return found
        around = points[rows]
        reached = (self.lows < around.max(axis=0)) & (self.highs > around.min(axis=0))
        for number in np.flatnonzero(reached.all(axis=1)).tolist():
            solid = self.outline.solids[number]
            near = rows[_between_corners(around, solid.low, solid.high)]
            if len(near):
                found[near] = np.maximum(found[near], -solid.beyond(points[near]))
        return found

    def drawn_depth(self, points: Floats) -> float:
        """How deep the deepest of points (n, 3) is that is inside of what is drawn, too."""
        depths = self.depths(points)
        rows = np.argsort(-depths, kind="stable")[:_LOOKED_AT]
        rows = rows[depths[rows] > 0.0]
        if not len(rows):
            return 0.0
        inside = np.abs(self.wound.around(points[rows])) > _INSIDE
        return float((depths[rows] * inside).max())


def _between_corners(points: Floats, low: Floats, high: Floats) -> NDArray[np.bool_]:
    """Which of points (n, 3) are in the box between two corners (3,)."""
    inside = (points > low) & (points < high)
    return np.asarray(inside[:, 0] & inside[:, 1] & inside[:, 2])


def meetings(mechanism: Mechanism, outlines: Mapping[str, Outline]) -> tuple[Meeting, ...]:
    """The pairs of bodies that meet over the strokes, the deepest first; the two halves of a cylinder do not count.
    Poses are looked at by the solids, and the deepest by what is drawn; bodies without solids meet nothing."""
    chain = ClosedChain(mechanism)
    bodies = {name: _Body.of(own) for name, own in outlines.items() if own.solids}
    halves = {frozenset((cylinder.barrel, cylinder.rod)) for cylinder in mechanism.cylinders}
    ranges = {
        joint.name: (joint.lower, joint.upper)
        for joint in mechanism.joints
        if joint.name in chain.independent
        and joint.drive is not None
        and joint.lower is not None
        and joint.upper is not None
    }
    pairs: dict[tuple[str, ...], list[tuple[str, str]]] = {}
    for pair, drivers in _moved_by(chain, list(bodies), ranges):
        if frozenset(pair) in halves:
            continue
        pairs.setdefault(drivers, []).append(pair)
    found = []
    for drivers, own in pairs.items():
        points = max(2, min(_FINEST, int(_POSES ** (1.0 / len(drivers)))))
        states = explore(chain, {name: ranges[name] for name in drivers}, points=points).states
        placed = chain.placements([chain.drawn, *states])
        for one, other in own:
            indices = chain.body_index(one), chain.body_index(other)
            deepest, at = _deepest(bodies[one], bodies[other], placed, indices)
            if deepest > DEEP:
                pose = {name: chain.coordinate(states[at], name) for name in drivers}
                found.append(Meeting(one, other, deepest, pose))
    return tuple(sorted(found, key=lambda meeting: (-round(meeting.depth, 6), meeting.one, meeting.other)))


def _moved_by(
    chain: ClosedChain, names: Sequence[str], ranges: Mapping[str, tuple[float, float]]
) -> Iterator[tuple[tuple[str, str], tuple[str, ...]]]:
    """Every two bodies that move against each other, with the drivers that move them."""
    moving: dict[tuple[str, str], list[str]] = {}
    for driver, (low, high) in ranges.items():
        states: list[State] = [chain.drawn, *(chain.reach({driver: end})[0] for end in (low, high))]
        rotations, origins = chain.placements(states)
        for one, other in itertools.combinations(names, 2):
            turned, moved = _between((rotations, origins), (chain.body_index(one), chain.body_index(other)))
            if max(float(np.ptp(turned, axis=0).max()), float(np.ptp(moved, axis=0).max())) > _MOVES:
                moving.setdefault((one, other), []).append(driver)
    most = int(np.log2(_POSES))
    for pair, drivers in moving.items():
        yield pair, tuple(drivers[:most])


def _between(placed: tuple[Floats, Floats], indices: tuple[int, int]) -> tuple[Floats, Floats]:
    """Rotations (n, 3, 3) and origins (n, 3) of the first body's frame in the second's."""
    rotations, origins = placed
    one, other = indices
    turned = np.einsum("nji,njk->nik", rotations[:, other], rotations[:, one])
    return turned, np.einsum("nji,nj->ni", rotations[:, other], origins[:, one] - origins[:, other])


def _deepest(one: _Body, other: _Body, placed: tuple[Floats, Floats], indices: tuple[int, int]) -> tuple[float, int]:
    """By how much two bodies are deeper in each other than in the first of the poses, and in which of the others."""
    turned, moved = _between(placed, indices)
    corners = np.array(list(itertools.product(*zip(*one.box, strict=True))))
    boxes = np.einsum("nij,kj->nki", turned, corners) + moved[:, None]
    near = ((boxes.max(axis=1) > other.box[0]) & (boxes.min(axis=1) < other.box[1])).all(axis=1)
    depths = np.zeros(len(near))

    def seen_from(pose: int) -> tuple[Floats, Floats]:
        """The points of each in the other's frame."""
        return one.points @ turned[pose].T + moved[pose], (other.points - moved[pose]) @ turned[pose]

    for pose in np.flatnonzero(near).tolist():
        first, second = seen_from(pose)
        depths[pose] = max(other.depths(first).max(), one.depths(second).max())

    def drawn(pose: int) -> float:
        first, second = seen_from(pose)
        return max(other.drawn_depth(first), one.drawn_depth(second))

    deepest = [pose for pose in np.argsort(-depths[1:], kind="stable")[:_TRIED] + 1 if depths[pose] > depths[0] + DEEP]
    if not deepest:
        return 0.0, 0
    found = [drawn(pose) for pose in deepest]
    at = int(np.argmax(found))
    return found[at] - drawn(0), int(deepest[at]) - 1


def clearance_findings(mechanism: Mechanism, found: Sequence[Meeting]) -> tuple[Finding, ...]:
    """KIN018, one for all meetings that the same drivers lead to: a warning where a stroke of theirs is no sheet's."""
    together: dict[tuple[str, ...], list[Meeting]] = {}
    for meeting in found:
        together.setdefault(tuple(meeting.at), []).append(meeting)
    return tuple(_told(mechanism, drivers, own) for drivers, own in together.items())


def _told(mechanism: Mechanism, drivers: Sequence[str], own: Sequence[Meeting]) -> Finding:
    cylinders = {cylinder.slide: cylinder for cylinder in mechanism.cylinders}
    open_, shares = [], []
    deepest = own[0]
    for name in drivers:
        joint, cylinder = mechanism.joint(name), cylinders.get(name)
        assert joint.lower is not None and joint.upper is not None
        share = (deepest.at[name] - joint.lower) / (joint.upper - joint.lower) if joint.upper > joint.lower else 0.0
        shares.append(f"{cylinder.name if cylinder else name} at {100.0 * share:.0f} %")
        if cylinder is not None and cylinder.sources.get("stroke", "").startswith((DEFAULT, ESTIMATE, UNKNOWN)):
            open_.append(cylinder.name)
    words = f"Over the strokes '{deepest.one}' goes {1e3 * deepest.depth:.0f} mm into '{deepest.other}'"
    words += f" ({', '.join(shares)})"
    others = [f"'{meeting.one}' and '{meeting.other}'" for meeting in own[1:]]
    if others:
        more = f" and {len(others) - _NAMED} more" if len(others) > _NAMED else ""
        words += f"; so do {', '.join(others[:_NAMED])}{more}"
    hint = "Engines are told to let them pass: keep targets away from there."
    if open_:
        hint = f"No sheet gives the stroke of {', '.join(open_)}: a sheet, or --set, may shorten it."
    return Finding("KIN018", "warning" if open_ else "info", deepest.one, words, hint)
