"""Joints that the CAD file itself declares (a robot description), beside those that its geometry shows.

| code   | severity | says                                                                                  |
|--------|----------|---------------------------------------------------------------------------------------|
| MEC080 | info     | how many declared joints agree with those found, and how well                         |
| MEC081 | warning  | a declared joint differs from the one found, or none was found between its bodies     |
| MEC082 | info     | declared joints that cannot be compared: a body of theirs draws nothing               |
| MEC083 | warning  | values that no sheet gives were taken from the limits of declared joints              |
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.mechanism.tolerances import PARALLEL
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly, DeclaredJoint, loop_axis
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Joint, Mechanism
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import Template
from yellowiron.support.text import with_article
from yellowiron.support.vectors import angle_between_lines

OFFSET = 5e-4
"""A declared and a found hinge, `PARALLEL`, agree if one runs past the other by less than this share of the machine's
size."""
_SAME_PIN = 1e-3
"""Metres by which the hinges of bodies that turn on one pin may run past each other."""
_TYPES = ("revolute", "prismatic", "spherical", "fixed")


@dataclass(frozen=True)
class ComparedJoint:
    """A joint that the file declares, beside what was found: the mechanism's joint, its type, the angle between the
    axes (radians) and how far the found axis runs past the declared anchor (metres; of a slide None). `agrees` is None
    where there is nothing to compare, `words` say why not."""

    name: str
    type: str
    bodies: tuple[str, str]
    joint: str = ""
    found: str = ""
    angle: float | None = None
    distance: float | None = None
    agrees: bool | None = None
    words: str = ""


@dataclass(frozen=True)
class DeclaredAxis:
    """A declared hinge or slide between two of the mechanism's bodies: a point on its axis and the unit vector, in the
    machine frame, metres."""

    name: str
    type: str
    bodies: frozenset[str]
    point: Floats
    axis: Floats


def declared_axes(assembly: Assembly, alignment: Alignment) -> tuple[DeclaredAxis, ...]:
    """The declared hinges and slides whose bodies the alignment knows."""
    played = _played(assembly, alignment)
    turn, move = alignment.frame[:3, :3], alignment.frame[:3, 3]
    found = []
    for joint in assembly.joints:
        one, other = (played.get(body) for body in joint.bodies)
        closes = joint.type == "spherical"
        axis = loop_axis(joint, assembly.joints) if closes else joint.axis
        if one is None or other is None or axis is None or joint.type not in ("revolute", "prismatic", "spherical"):
            continue
        point, kind = turn @ np.array(joint.anchor) + move, "revolute" if closes else joint.type
        found.append(DeclaredAxis(joint.name, kind, frozenset((one, other)), point, turn @ np.array(axis)))
    return tuple(found)


def compare_declared(mechanism: Mechanism, assembly: Assembly, alignment: Alignment) -> tuple[ComparedJoint, ...]:
    """Every declared joint beside the one that the mechanism has between the same bodies.

    `mechanism` is in the pose in which `assembly` is drawn. Left out are joints to the world, and welds within a body.
    """
    played = _played(assembly, alignment)
    size = _size(mechanism)
    compared = []
    for declared in assembly.joints:
        if declared.type not in _TYPES or "" in declared.bodies:
            continue
        ends = played.get(declared.bodies[0]), played.get(declared.bodies[1])
        if declared.type == "fixed" and (None in ends or ends[0] == ends[1]):
            continue
        one = _compared(declared, ends, mechanism, alignment.frame, size)
        if one is not None:
            compared.append(one)
    return tuple(compared)


def declared_findings(compared: Sequence[ComparedJoint], where: str) -> tuple[Finding, ...]:
    """MEC080 … MEC082."""
    alike = [c for c in compared if c.agrees]
    unlike = [c for c in compared if c.agrees is False]
    findings = []
    if alike or unlike:
        angle = max((math.degrees(c.angle) for c in alike if c.angle is not None), default=0.0)
        distance = max((1e3 * c.distance for c in alike if c.distance is not None), default=0.0)
        words = f"{len(alike)} of {len(alike) + len(unlike)} joints that the file declares agree with those found"
        words += f": axes within {angle:.2g}°, hinges within {distance:.2g} mm." if alike else "."
        findings.append(Finding("MEC080", "info", where, words))
    hint = "See which is right: the file's joint, or the pins and bores of its parts."
    findings += [Finding("MEC081", "warning", c.name, c.words, hint) for c in unlike]
    blank = [c.name for c in compared if c.agrees is None]
    if blank:
        words = f"Not compared, since nothing is drawn for one of their bodies: {', '.join(blank)}."
        findings.append(Finding("MEC082", "info", where, words))
    return tuple(findings)


def declared_values(
    mechanism: Mechanism,
    template: Template,
    assembly: Assembly,
    alignment: Alignment,
    compared: Sequence[ComparedJoint],
    specifications: Specifications,
) -> Specifications:
    """What the limits of declared joints say of values that nothing else gives (SI, source `geometry`): angles of
    hinges, travels of slides, strokes and closed lengths of cylinders. MEC083."""
    found: dict[str, Specification] = {}
    declared = {d.name: d for d in assembly.joints}
    played = _played(assembly, alignment)
    for one in compared:
        source = declared[one.name]
        if not one.agrees or one.found != one.type or source.lower is None or source.upper is None:
            continue
        joint = mechanism.joint(one.joint)
        turned = float(np.dot(alignment.frame[:3, :3] @ np.array(source.axis), joint.axis)) < 0.0
        # The other way round, too, where the mechanism's tree runs through it from the other end.
        turned ^= played.get(source.bodies[0]) == joint.body1
        low, high = (-source.upper, -source.lower) if turned else (source.lower, source.upper)
        unit = "m" if joint.type == "prismatic" else "rad"
        for name, value in _named(mechanism, template, joint, low, high):
            known = specifications.get(name)
            if name not in found and (known is None or known.status in ("missing", "unreadable")):
                reason = f"limits of the joint '{one.name}', which the CAD file declares"
                found[name] = Specification(name, value, unit, "ok", "geometry", confidence=0.5, reason=reason)
    if not found:
        return Specifications()
    words = f"Taken from the limits of joints that the file declares, since no sheet gives them: {', '.join(found)}."
    hint = "Limits of a robot are often a site's or a program's: check them against the machine's sheet."
    return Specifications(found, (Finding("MEC083", "warning", assembly.name, words, hint),))


def _named(
    mechanism: Mechanism, template: Template, joint: Joint, low: float, high: float
) -> Iterator[tuple[str, float]]:
    """Wanted names that a joint's range gives, with their values."""
    cylinder = next((c for c in mechanism.cylinders if c.slide == joint.name), None)
    if cylinder is not None:
        for actuator in template.actuators:
            if any(c.slide == joint.name for c in actuator.cylinders):
                lengths = {"stroke": high - low, "closed_length": cylinder.drawn_length + low}
                # A rod that is longer than its barrel: a limit that somebody made up.
                if 0.0 < lengths["stroke"] < lengths["closed_length"]:
                    yield from ((n, v) for q, v in lengths.items() if (n := actuator.specifications.get(q)))
        return
    entry = next((e for e in template.joints if e.name == joint.name), None)
    for stated, value in ((entry.lower, low), (entry.upper, high)) if entry is not None else ():
        if isinstance(stated, str):
            yield stated.lstrip("-− ").strip(), -value if stated.lstrip()[0] in "-−" else value


def _played(assembly: Assembly, alignment: Alignment) -> dict[str, str | None]:
    return assembly.played({a.part: a.body for a in alignment.parts})


def _size(mechanism: Mechanism) -> float:
    clouds = [body.hull for body in mechanism.bodies if len(body.hull)]
    return float(np.linalg.norm(np.ptp(np.concatenate(clouds), axis=0))) if clouds else 0.0


def _compared(
    declared: DeclaredJoint, ends: tuple[str | None, str | None], mechanism: Mechanism, frame: Floats, size: float
) -> ComparedJoint | None:
    """One joint; None for a weld of two bodies that no joint ties together."""
    name, kind, bodies = declared.name, declared.type, declared.bodies
    title = f"Declared {kind} between '{bodies[0]}' and '{bodies[1]}'"
    if ends[0] is None or ends[1] is None:
        return ComparedJoint(name, kind, bodies, words=f"{title}: nothing is drawn for one of them.")
    if ends[0] == ends[1]:
        words = f"{title}: both are parts of one body, '{ends[0]}'."
        return ComparedJoint(name, kind, bodies, agrees=False, words=words)
    anchor = frame[:3, :3] @ np.array(declared.anchor) + frame[:3, 3]
    axis = frame[:3, :3] @ np.array(declared.axis)
    direct = [j for j in mechanism.joints if {j.body0, j.body1} == set(ends)]
    if not direct and kind == "fixed":
        return None
    found = min(direct or _across(mechanism, ends), key=lambda j: _rank(j, kind, anchor, axis), default=None)
    if found is None:
        words = f"{title}: no joint was found between '{ends[0]}' and '{ends[1]}'."
        return ComparedJoint(name, kind, bodies, agrees=False, words=words)
    return _beside(declared, title, found, anchor, axis, OFFSET * size)


def _beside(
    declared: DeclaredJoint, title: str, found: Joint, anchor: Floats, axis: Floats, offset: float
) -> ComparedJoint:
    """A declared joint at `anchor` along `axis` in the machine frame, beside the one found, which may run past it by
    `offset` metres."""
    kind = declared.type
    angle = angle_between_lines(found.axis, axis) if kind in ("revolute", "prismatic") and found.type == kind else None
    turns = kind in ("revolute", "spherical") and found.type in ("revolute", "spherical")
    distance = _distance(found, anchor) if turns else None
    # A point that closes a loop stands for a hinge: the rest of the loop holds its axis.
    alike = found.type == kind or (kind == "spherical" and found.type == "revolute")
    agrees = alike and (angle or 0.0) <= PARALLEL and (distance or 0.0) <= offset
    words = "" if agrees else f"{title}; found is {with_article(found.type)} joint"
    if not agrees and alike:
        words += f", its axis {math.degrees(angle):.2f}° off" if angle is not None else ""
        words += f", {1e3 * distance:.1f} mm beside" if distance is not None else ""
    words = words and f"{words}."
    return ComparedJoint(declared.name, kind, declared.bodies, found.name, found.type, angle, distance, agrees, words)


def _across(mechanism: Mechanism, ends: tuple[str | None, str | None]) -> list[Joint]:
    """Joints of the one body with a third, about the same line as one of that third with the other: several bodies turn
    on one pin."""
    found = []
    for one in mechanism.joints:
        for other in mechanism.joints:
            pairs = {one.body0, one.body1}, {other.body0, other.body1}
            if ends[0] not in pairs[0] or ends[1] not in pairs[1] or len(pairs[0] & pairs[1]) != 1 or one is other:
                continue
            same = (
                angle_between_lines(one.axis, other.axis) < PARALLEL
                and _distance(one, np.array(other.anchor)) < _SAME_PIN
            )
            if one.type == other.type == "revolute" and same:
                found.append(one)
    return found


def _rank(joint: Joint, kind: str, anchor: Floats, axis: Floats) -> tuple[bool, float, float]:
    return joint.type != kind, round(angle_between_lines(joint.axis, axis), 6), _distance(joint, anchor)


def _distance(joint: Joint, anchor: Floats) -> float:
    return float(np.linalg.norm(np.cross(anchor - np.array(joint.anchor), joint.axis)))
