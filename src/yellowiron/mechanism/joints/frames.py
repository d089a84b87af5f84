"""Where a joint is: its axis and anchor, from its pin, else from the bores its two bodies share.

Pivots first, then slides, which run from one pivot of their cylinder to the other. Machine frame, metres.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from yellowiron.mechanism.bodies.hidden_wheels import HiddenWheel
from yellowiron.mechanism.joints.axes import Axis, machine_sense
from yellowiron.mechanism.joints.bearings import (
    Bearing,
    Rows,
    agree,
    ball_bearing,
    declared_bearing,
    eye_middle,
    given_bearing,
    lone_bearing,
    lone_slide,
    outline_bearing,
    pin_bearing,
    shared_bearing,
    slide_bearing,
)
from yellowiron.mechanism.placement import Placement
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.template import CylinderTemplate, JointTemplate, Template

TWIN_TYRE = 0.99
"""What reaches this share of a wheel's radius is its other tyre."""
BESIDE = 0.1
"""What is this share of a body's size farther from a line than the nearest of it is near that line."""
RAM = ("barrel", "rod")
"""Kinds of the halves of a cylinder."""
WHEELS = ("wheel", "sprocket", "idler", "roller", "carrier")
"""Kinds of roles that turn about their own axis of symmetry."""


@dataclass(frozen=True, eq=False)
class JointFrame:
    """A joint with its place: `bodies` in the template's order, `anchor` a point on the unit vector `axis`, `source`
    the evidence. `weight` says how well the direction is known: the square of the length (m²) that its cylinders
    span; `exact` whether any of them is one of the file's own, not one fitted to facets."""

    joint: JointTemplate
    bodies: tuple[str, str]
    anchor: Floats
    axis: Floats
    weight: float
    source: Mapping[str, Any]
    exact: bool = True


def joint_frames(
    placement: Placement, template: Template, hidden: Mapping[str, HiddenWheel] | None = None
) -> tuple[dict[str, JointFrame], list[Finding]]:
    """The frame of every joint that has one, by name in template order, and what is wrong with the others. `hidden`
    wheels bring their own."""
    findings: list[Finding] = []
    pivots: dict[str, JointFrame] = {}
    slides: list[tuple[JointTemplate, tuple[str, str]]] = []
    held: list[tuple[JointTemplate, tuple[str, str]]] = []
    made = {r.name for r in template.roles if r.hidden}
    for joint in template.joints:
        if made & set(joint.parts):
            if (frame := _axle(joint, template, hidden or {})) is not None:
                pivots[joint.name] = frame
            continue
        bodies = _bodies(joint, placement, template, findings)
        if bodies is None:
            continue
        if joint.type == "prismatic":
            slides.append((joint, bodies))
        elif joint.type == "fixed" and joint.at is None:
            pivots[joint.name] = weld(joint, bodies, placement, method="weld")
        elif joint.type == "fixed" and not any(template.role(part).kind == "pin" for part in joint.parts):
            held.append((joint, bodies))
        elif joint.name in placement.by_hand:
            line = Axis(*placement.axes[joint.name])
            bearing = given_bearing(placement, joint)
            pivots[joint.name] = _frame(joint, bodies, placement, bearing, line.point, machine_sense(line.direction))
        elif (
            frame := _pivot(joint, bodies, placement, template, [] if joint.type == "fixed" else findings)
        ) is not None:
            pivots[joint.name] = frame
        elif joint.type == "fixed":
            pivots[joint.name] = weld(joint, bodies, placement, method="weld")
    found = dict(pivots)
    for joint, bodies in held:
        # Nothing moves on it where it is held, and still it says which way its bodies point.
        frame = _slide(joint, bodies, placement, template, pivots, [])
        found[joint.name] = frame or weld(joint, bodies, placement, method="weld")
    for joint, bodies in slides:
        if (frame := _slide(joint, bodies, placement, template, pivots, findings)) is not None:
            found[joint.name] = frame
    return {j.name: found[j.name] for j in template.joints if j.name in found}, findings


def _axle(joint: JointTemplate, template: Template, hidden: Mapping[str, HiddenWheel]) -> JointFrame | None:
    """The axle of a hidden wheel; None for one that was not made."""
    wheel = next((hidden[part] for part in joint.parts if part in hidden), None)
    first, second = template.bodies_of(joint)
    if wheel is None or first is None or second is None:
        return None
    source = {"template": joint.name, "method": "hidden wheel: across the machine, over the track on the ground"}
    return JointFrame(joint, (first, second), wheel.center, wheel.axis, 0.0, source)


def weld(joint: JointTemplate, bodies: tuple[str, str], placement: Placement, *, method: str) -> JointFrame:
    """A fixed joint's frame: in the middle of the second body."""
    points = placement.points_of(placement.rows_of_body(bodies[1]))
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    source = {"template": joint.name, "method": method}
    return JointFrame(joint, bodies, middle, np.array([1.0, 0.0, 0.0]), 0.0, source)


def _bodies(
    joint: JointTemplate, placement: Placement, template: Template, findings: list[Finding]
) -> tuple[str, str] | None:
    """The two bodies a joint joins, or None with a finding. An optional body that is not there takes its joints
    along."""
    roles = {r.name: r for r in template.roles}
    unknown = [part for part in joint.parts if part not in roles]
    if unknown:
        words = f"The joint names '{unknown[0]}', which is no part of the template."
        findings.append(Finding("MEC001", "error", joint.name, words, "Correct its Body."))
        return None
    a, b = template.bodies_of(joint)
    if a is None or b is None or a == b:
        words = f"'{joint.parts[0]}' and '{joint.parts[1]}' move with {a} and {b}: the joint does not join two bodies."
        hint = "Name two parts of different rigid bodies."
        findings.append(Finding("MEC001", "error", joint.name, words, hint))
        return None
    absent = [body for body in (a, b) if not placement.has_body(body)]
    if any(not roles[body].optional for body in absent):
        words = f"No part of the CAD model is '{absent[0]}': the joint is left out."
        findings.append(Finding("MEC002", "error", joint.name, words, "Give its parts that role in the alignment."))
    return None if absent else (a, b)


def _pivot(
    joint: JointTemplate,
    bodies: tuple[str, str],
    placement: Placement,
    template: Template,
    findings: list[Finding],
) -> JointFrame | None:
    """A pivot: on its pin, else on the bores both bodies have; a wheel without either on its own axis of symmetry."""
    pins = [row for part in joint.parts if not template.role(part).rigid for row in placement.rows_of_role(part)]
    if joint.type == "spherical" and (ball := ball_bearing(placement, _rows(placement, bodies))) is not None:
        return _frame(joint, bodies, placement, ball, ball.line.point, ball.line.direction)
    wheel = next((part for part in joint.parts if template.role(part).kind in WHEELS), None)
    bearing = pin_bearing(placement, pins, bodies) or shared_bearing(placement, _rows(placement, bodies))
    # A pin that shows no axis (an open or faceted one) is none.
    if joint.name in placement.axes and (bearing is None or not pins or not len(bearing.features)):
        found = Axis(*placement.axes[joint.name])
        if bearing is None or not agree(bearing.line, found):
            bearing = lone_bearing(placement, bodies, found)
    bearing = bearing or declared_bearing(placement, bodies, "revolute")
    if bearing is None and wheel is not None:
        bearing = outline_bearing(placement, placement.rows_of_body(wheel))
    if bearing is None:
        words = f"'{bodies[0]}' and '{bodies[1]}' have no pin and no common bore: the joint is left out."
        findings.append(Finding("MEC005", "error", joint.name, words, "Give its pin that role in the alignment."))
        return None
    findings += bearing.findings(joint.name)
    line = bearing.line
    middle = line.at(0.5 * sum(bearing.reach)) if wheel is None else _wheel_middle(placement, wheel, line)
    if joint.type == "spherical" and (eye := eye_middle(placement, bearing, bodies, pins)) is not None:
        middle = eye
    if joint.type == "spherical" and not pins:
        middle = _on_its_body(middle, line, placement, max(bodies, key=template.depth))
    return _frame(joint, bodies, placement, bearing, middle, machine_sense(line.direction))


def _on_its_body(point: Floats, line: Axis, placement: Placement, body: str) -> Floats:
    """A ball's middle on a line: where the body reaches near that line, in the middle if the point is beside it (what
    is round about the line of twins may be the other's)."""
    points = placement.points_of(placement.rows_of_body(body))
    off = line.distance(points)
    along = line.along(points[off <= off.min() + BESIDE * float(np.linalg.norm(np.ptp(points, axis=0)))])
    low, high = float(along.min()), float(along.max())
    return point if low <= float(line.along(point[None])[0]) <= high else line.at(0.5 * (low + high))


def _slide(
    joint: JointTemplate,
    bodies: tuple[str, str],
    placement: Placement,
    template: Template,
    pivots: Mapping[str, JointFrame],
    findings: list[Finding],
) -> JointFrame | None:
    """A slide: on the bore that barrel and rod share, at the foot of the rod's pivot, pointing from the first body's
    pivot to the second's. That of a cylinder without pins is on its rams, if they are drawn, and points the way that
    they push the second body."""
    cylinder = next((c for a in template.actuators for c in a.cylinders if c.slide == joint.name and not c.pins), None)
    rams = drawn_rams(cylinder, placement, template, bodies) if cylinder is not None else ()
    ends = [_end_pivot(body, bodies, pivots) for body in bodies]
    tips = [end.anchor if end is not None else None for end in ends]
    hinge = ends[0].axis if ends[0] is not None and ends[0].joint.type == "revolute" else None
    rows = _rows(placement, bodies) if not rams else _together(rams)
    if cylinder is not None:
        tips, hinge = [None, None], None
    bearing = slide_bearing(placement, rows, (tips[0], tips[1]), hinge)
    sense = None
    if joint.name in placement.by_hand:
        bearing, sense = given_bearing(placement, joint), placement.axes[joint.name][1]
    elif joint.name in placement.axes:
        found = Axis(*placement.axes[joint.name])
        sense = found.direction if cylinder is None else None
        sections = not any(template.role(body).kind in RAM for body in bodies)  # in each other, without a rod
        guessed = bearing is not None and bearing.doubt is not None and sections
        if bearing is None or guessed or (not rams and not agree(bearing.line, found)):
            bearing = lone_slide(placement, bodies, found)
            bearing = replace(bearing, doubt=None) if sections else bearing
    bearing = bearing or declared_bearing(placement, bodies, "prismatic")
    if bearing is None:
        words = f"'{bodies[0]}' and '{bodies[1]}' share no bore: the slide is left out."
        hint = "Check which parts are barrel and rod in the alignment."
        findings.append(Finding("MEC005", "error", joint.name, words, hint))
        return None
    findings += bearing.findings(joint.name)
    if cylinder is not None and sense is None:
        sense = _outwards(bearing.line, cylinder, rams, placement, template, bodies)
    places = [
        tip if tip is not None else placement.points_of(placement.rows_of_body(body)).mean(axis=0)
        for tip, body in zip(tips, bodies, strict=True)
    ]
    line = bearing.line
    ahead = (sense if sense is not None else places[1] - places[0]) @ line.direction >= 0.0
    outwards = line.direction if ahead else -line.direction
    rod = next((i for i, body in enumerate(bodies) if template.role(body).kind == "rod"), 1)
    return _frame(joint, bodies, placement, bearing, line.foot(places[rod]), outwards)


def _rows(placement: Placement, bodies: tuple[str, str]) -> Rows:
    """The parts of both of two bodies."""
    return placement.rows_of_body(bodies[0]), placement.rows_of_body(bodies[1])


def drawn_rams(
    cylinder: CylinderTemplate, placement: Placement, template: Template, bodies: tuple[str, str]
) -> tuple[Rows, ...]:
    """The parts of each of a cylinder's rams that is drawn whole, those of the slide's first body first."""
    found = []
    for pair in cylinder.rams:
        rows = {template.body_of(half): _rows_of(half, placement, template) for half in pair}
        if all(rows.get(body) for body in bodies):
            found.append((rows[bodies[0]], rows[bodies[1]]))
    return tuple(found)


def _rows_of(half: str, placement: Placement, template: Template) -> tuple[int, ...]:
    """The parts of a ram's half: of the body that it is, else of that role."""
    return placement.rows_of_body(half) if template.role(half).rigid else placement.rows_of_role(half)


def _together(rams: Sequence[Rows]) -> Rows:
    return tuple(row for one in rams for row in one[0]), tuple(row for one in rams for row in one[1])


def barrel_end(cylinder: CylinderTemplate, template: Template, bodies: tuple[str, str]) -> int:
    """Which of a slide's two bodies has the barrel of a cylinder without pins: as its rams say, else by the bodies'
    kinds, else the first."""
    if cylinder.rams:
        return bodies.index(str(template.body_of(cylinder.rams[0][0])))
    kinds = [template.role(body).kind for body in bodies]
    return 1 if kinds[1] == "barrel" or kinds[0] == "rod" else 0


def _outwards(
    line: Axis,
    cylinder: CylinderTemplate,
    rams: Sequence[Rows],
    placement: Placement,
    template: Template,
    bodies: tuple[str, str],
) -> Floats:
    """The way that a cylinder without pins pushes the second of its slide's bodies: to where its rod comes out; where
    that is not drawn, or it comes out alike at both ends, its rod's body goes up, left or forward."""
    turned = barrel_end(cylinder, template, bodies)
    sign = -1.0 if turned else 1.0
    if rams and not cylinder.rod_through:
        barrel, rod = (line.along(placement.points_of(rams[0][k])) for k in (turned, 1 - turned))
        return sign * (1.0 if rod.max() - barrel.max() >= barrel.min() - rod.min() else -1.0) * line.direction
    return sign * machine_sense(line.direction)


def _end_pivot(body: str, slide: tuple[str, str], pivots: Mapping[str, JointFrame]) -> JointFrame | None:
    """The pivot by which a barrel or rod hangs on the rest of the machine."""
    other = slide[1] if body == slide[0] else slide[0]
    return next((p for p in pivots.values() if body in p.bodies and other not in p.bodies), None)


def _wheel_middle(placement: Placement, wheel: str, line: Axis) -> Floats:
    """Where a wheel's axis meets its mid-plane: the middle of the part that reaches farthest from the axis, or of the
    two of twin tyres."""
    reach = {row: float(line.distance(placement.points(row)).max()) for row in placement.rows_of_body(wheel)}
    tyres = [row for row, far in reach.items() if far > TWIN_TYRE * max(reach.values())]
    along = np.concatenate([line.along(placement.points(row)) for row in tyres])
    return line.at(float(0.5 * (along.min() + along.max())))


def _frame(
    joint: JointTemplate, bodies: tuple[str, str], placement: Placement, bearing: Bearing, anchor: Floats, axis: Floats
) -> JointFrame:
    low, high = bearing.reach
    source = {"template": joint.name, **bearing.evidence(placement)}
    return JointFrame(joint, bodies, anchor, axis, (high - low) ** 2, source, bearing.exact)
