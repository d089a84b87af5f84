"""A machine whose hydraulic cylinders are forces between two points: fewer bodies and loops, hinges as coordinates."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Cylinder, Joint, Mechanism, Vector
from yellowiron.support.graphs import components, spanning_forest
from yellowiron.support.vectors import triple

ASIDE = 1e-3
"""Of a cylinder's length: so far off its line a pin may be, else its stroke is not the distance between its pins."""
_SAME = 1e-6
"""Metres between pins that are one."""

Ends = tuple[tuple[str, Vector], tuple[str, Vector]]
"""Two bodies with a point on each (machine frame, drawn pose)."""


@dataclass(frozen=True)
class Tendon:
    """What is left of a cylinder: its `slide`, which is no joint any more, the bodies that it was pinned to with the
    points there (machine frame, drawn pose), and their distance as drawn, metres: of a stroke `q` it is `length` + q.
    """

    cylinder: Cylinder
    slide: Joint
    ends: Ends
    length: float


def with_tendons(mechanism: Mechanism) -> tuple[Mechanism, tuple[Tendon, ...]]:
    """The machine without the halves of its cylinders, and the tendons that stand for those of them that are driven.

    A cylinder stays that has no pins (rams), whose pins are off its line, whose halves carry more than what is on their
    pins, or without which something would hang on nothing. Its mass is on its two pins as a lever's would be, so that
    the machine's mass and, as drawn, its centre are what they were. What was pinned to a pin of it is pinned to each
    other there; the tree runs over the pivots that are left, with as few cuts as there are loops, and what no drive
    moves in these has no limits but the strokes. `actuators`, `cylinders` and `loops` are as before.
    """
    joints, tendons, gone = list(mechanism.joints), [], dict[str, Tendon]()
    for cylinder in mechanism.cylinders:
        tendon = _tendon(cylinder, joints)
        needed = {mechanism.root, *mechanism.floating, *(name for each in gone.values() for name, _ in each.ends)}
        if tendon is None or {cylinder.barrel, cylinder.rod} & needed:
            continue
        left = _pinned_together(cylinder, tendon, joints)
        others = [b.name for b in mechanism.bodies if b.name not in {cylinder.barrel, cylinder.rod, *gone}]
        if _whole(mechanism, others, left):
            joints = left
            gone |= {cylinder.barrel: tendon, cylinder.rod: tendon}
            if tendon.slide.drive is not None:
                tendons.append(tendon)
    if not gone:
        return mechanism, ()
    ends = {name: tendon.ends for name, tendon in gone.items()}
    bodies = tuple(heavier(body, mechanism, ends) for body in mechanism.bodies if body.name not in gone)
    sites = tuple(site for site in mechanism.sites if site.body not in gone)
    kept = tuple(s for s in mechanism.sensors if s.body not in gone and not _of_lost(s.joint, joints, tendons))
    tree = tuple(_tree(mechanism, joints))
    return replace(mechanism, bodies=bodies, joints=tree, sites=sites, sensors=kept), tuple(tendons)


def _of_lost(joint: str, joints: Iterable[Joint], tendons: Iterable[Tendon]) -> bool:
    """Whether a sensor's joint is neither there nor a tendon."""
    return bool(joint) and joint not in {j.name for j in joints} | {t.slide.name for t in tendons}


def _tendon(cylinder: Cylinder, joints: Sequence[Joint]) -> Tendon | None:
    """Of a cylinder that pins hold on its line."""
    named = {joint.name: joint for joint in joints}
    slide = named.get(cylinder.slide)
    pins = [named[name] for name in cylinder.pins if name in named]
    led = {j.follows.joint for j in joints if j.follows is not None}
    if slide is None or len(pins) != 2 or slide.follows is not None or slide.name in led:
        return None
    points = [_on_line(pin, slide) for pin in pins]
    along, between = np.asarray(slide.axis), points[1] - points[0]
    length = float(np.linalg.norm(between))
    start, aside = np.asarray(slide.anchor), 0.0
    for point in points:
        off = point - start
        aside = max(aside, float(np.linalg.norm(off - (off @ along) * along)))
    for body, pin in ((cylinder.barrel, pins[0]), (cylinder.rod, pins[1])):
        others = [j for j in joints if body in (j.body0, j.body1) and j not in (slide, pin)]
        if not all(_one_pin(pin, other) for other in others) or body not in (pin.body0, pin.body1):
            return None
    if aside > ASIDE * length:
        return None
    held = [_other(pin, half) for pin, half in zip(pins, (cylinder.barrel, cylinder.rod), strict=True)]
    return Tendon(cylinder, slide, ((held[0], triple(points[0])), (held[1], triple(points[1]))), length)


def _on_line(pin: Joint, slide: Joint) -> Floats:
    """The point of a pin's axis nearest to the slide's line; a ball's own. A pin is anchored anywhere on its axis."""
    at = np.asarray(pin.anchor, dtype=np.float64)
    if pin.type != "revolute":
        return at
    axis, along = np.asarray(pin.axis), np.asarray(slide.axis)
    across = np.cross(axis, along)
    square = float(across @ across)
    if square < _SAME:
        return at
    return np.asarray(at + float(np.cross(np.subtract(slide.anchor, at), along) @ across) / square * axis)


def _one_pin(one: Joint, other: Joint) -> bool:
    """Whether two pivots turn about one line."""
    apart = np.subtract(other.anchor, one.anchor)
    axis = np.asarray(one.axis)
    off = apart - (apart @ axis) * axis
    pivots = one.type == other.type == "revolute"
    return pivots and float(np.linalg.norm(off)) < _SAME and abs(float(axis @ np.asarray(other.axis))) > 1.0 - _SAME


def _other(joint: Joint, body: str) -> str:
    return joint.body1 if joint.body0 == body else joint.body0


def _pinned_together(cylinder: Cylinder, tendon: Tendon, joints: Iterable[Joint]) -> list[Joint]:
    """The joints without the cylinder's; what else was on its pins is on the body that the tendon pulls there."""
    ends = dict(zip((cylinder.barrel, cylinder.rod), (name for name, _ in tendon.ends), strict=True))
    left = []
    for joint in joints:
        if joint.name in (cylinder.slide, *cylinder.pins):
            continue
        for half, held in ends.items():
            if half in (joint.body0, joint.body1):
                joint = replace(joint, body0=held, body1=_other(joint, half))
        left.append(joint)
    return left


def _whole(mechanism: Mechanism, bodies: Iterable[str], joints: Iterable[Joint]) -> bool:
    """Whether joints hold all these bodies to what the trees begin with."""
    ends = [_ends(joint, mechanism) for joint in joints if joint.type != "distance"]
    return len(components((_head(body, mechanism) for body in bodies), ends)) == 1


def _ends(joint: Joint, mechanism: Mechanism) -> tuple[str, str]:
    return _head(joint.body0, mechanism), _head(joint.body1, mechanism)


def _head(body: str, mechanism: Mechanism) -> str:
    """The body; those that trees begin with are as one."""
    return mechanism.root if body in mechanism.floating else body


def _tree(mechanism: Mechanism, joints: Sequence[Joint]) -> Iterator[Joint]:
    """The joints, in their order: those that lead to a body from the root, the others cut. Slides, driven joints and
    those that follow are in the tree, then what was, then pivots."""

    def rank(joint: Joint) -> tuple[bool, bool, bool]:
        stays = joint.type == "prismatic" or joint.drive is not None or joint.follows is not None
        return not stays, joint.cut, joint.type == "spherical"

    links = sorted((joint for joint in joints if joint.type != "distance"), key=rank)
    forest, _ = spanning_forest(links, lambda joint: _ends(joint, mechanism))
    inside = {joint.name for joint in forest}
    reached = {mechanism.root, *mechanism.floating}
    turned: set[str] = set()
    while grown := [j for j in joints if j.name in inside and len({j.body0, j.body1} & reached) == 1]:
        turned |= {j.name for j in grown if j.body1 in reached}
        reached |= {body for j in grown for body in (j.body0, j.body1)}
    looped = {name for loop in mechanism.loops for name in (*loop.joints, loop.cut)}
    for joint in joints:
        if joint.name in looped and joint.drive is None and joint.spring is None:
            joint = replace(joint, lower=None, upper=None)
        if joint.name not in inside:
            yield replace(joint, cut=True)
            continue
        if joint.name in turned:
            joint = replace(joint, body0=joint.body1, body1=joint.body0, axis=triple(-np.asarray(joint.axis)))
        yield replace(joint, cut=False)


def heavier(body: Body, mechanism: Mechanism, gone: Mapping[str, Ends]) -> Body:
    """A body with what bodies that are `gone` weigh at their ends on it, as points: as levers on their two pins they
    would."""
    points: list[tuple[float, Floats]] = []
    for name, ends in gone.items():
        half = mechanism.body(name)
        (first, start), (second, end) = ends
        along = np.subtract(end, start)
        share = float(np.subtract(half.center_of_mass, start) @ along) / float(along @ along)
        for held, part, at in ((first, 1.0 - share, start), (second, share, end)):
            if held == body.name:
                points.append((part * half.mass, np.asarray(at, dtype=np.float64)))
    if not points:
        return body
    own = np.asarray(body.center_of_mass, dtype=np.float64)
    mass = body.mass + sum(m for m, _ in points)
    center = (body.mass * own + sum((m * at for m, at in points), np.zeros(3))) / mass
    inertia = np.asarray(body.inertia, dtype=np.float64).copy()
    for m, place in ((body.mass, own), *points):
        arm = place - center
        inertia += m * (float(arm @ arm) * np.eye(3) - np.outer(arm, arm))
    return replace(body, mass=mass, center_of_mass=triple(center), inertia=inertia)
