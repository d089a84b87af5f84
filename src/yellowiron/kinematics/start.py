"""A legal start pose for a machine that is drawn outside its limits: the CAD model's parts are moved there, and what is
built from them starts in it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.kinematics.solver.chain import ClosedChain
from yellowiron.model.alignment import Alignment, Vector
from yellowiron.model.assembly import Assembly, DeclaredJoint, Node
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import DRAWN_OUTSIDE, Joint, Mechanism
from yellowiron.model.template import Template

INSIDE = 0.01
"""The start is this share of the joint's range inside its nearer limit."""
HANGING = 0.98
"""Least share of the way from a ball to the middle of what hangs on it that goes straight down."""


@dataclass(frozen=True, eq=False)
class Start:
    """Where an illegally drawn machine starts: `coordinates` of the joints that had to move (m, rad from the drawn
    pose), the (4, 4) `displacements` of the bodies in the machine frame, and what there is to say. `closed`: it was
    reached, so that every joint that follows is where its leader puts it."""

    coordinates: Mapping[str, float]
    displacements: Mapping[str, Floats]
    findings: tuple[Finding, ...]
    closed: bool = True


def legal_start(mechanism: Mechanism, held: Mapping[str, float] | None = None) -> Start | None:
    """The nearest pose in which no driven joint is outside its limits, every joint that follows is where its leader
    puts it, and every joint that is `held` in another position than drawn (from there, m or rad) is in it; None where
    the drawn pose is one.

    A joint whose limit cannot be reached on this branch of its loop stays where the linkage locks, with a finding.
    """
    wanted = {j.name: target for j in mechanism.joints if (target := _target(j)) is not None}
    held = {name: place for name, place in (held or {}).items() if any(j.name == name for j in mechanism.joints)}
    wanted |= held
    led = {j.name: j.follows for j in mechanism.joints if j.follows is not None and j.follows.offset}
    if not wanted and not led:
        return None
    chain = ClosedChain(mechanism)
    wanted = {name: target for name, target in wanted.items() if name in chain.independent}
    if not wanted and not led:
        return None
    state, share = chain.reach(wanted)
    coordinates = {name: chain.coordinate(state, name) for name in wanted}
    findings = []
    for name, value in coordinates.items():
        joint = mechanism.joint(name)
        if name in held:
            words = f"It is held {_shown(joint, value)} from where it is drawn: the machine starts there."
            hint = "Another of its positions is chosen with --set; 'drawn' is the CAD model's."
            findings.append(Finding("KIN012", "info", name, words, hint))
            continue
        words = f"It is drawn outside its limits {_range(joint)}: the machine starts {_shown(joint, value)} from there."
        hint = "Check the limits, stroke and closed length, or draw a legal pose."
        findings.append(Finding("KIN012", "warning", name, words, hint))
    for name, follows in led.items():
        coordinates[name] = chain.coordinate(state, name)
        words = f"'{follows.joint}' puts it {_shown(mechanism.joint(name), coordinates[name])} from where it is drawn: "
        hint = "The offset of its 'follows' says so; 0 is the drawn pose."
        findings.append(Finding("KIN012", "info", name, f"{words}the machine starts there.", hint))
    if share < 1.0:
        words = f"The linkage locks after {share:.0%} of the way to a legal start pose."
        first = next(iter((*wanted, *led)))
        findings.append(Finding("KIN012", "error", first, words, "Check stroke and closed length."))
    return Start(coordinates, _hung(mechanism, chain.pose(state)), tuple(findings), share == 1.0)


def _hung(mechanism: Mechanism, moves: Mapping[str, Floats]) -> dict[str, Floats]:
    """The bodies' displacements (4, 4), those of what hangs straight down on a free ball, and on nothing else, without
    the turn of what it hangs on: a hook on a jib that is pinned below its boom hangs straight down."""
    moved, bodies = dict(moves), {b.name: b for b in mechanism.bodies}
    for ball in (j for j in mechanism.joints if j.free and j.type == "spherical" and not j.cut):
        below = {ball.body1}
        while more := {j.body1 for j in mechanism.joints if not j.cut and j.body0 in below} - below:
            below |= more
        others = ({j.body0, j.body1} for j in mechanism.joints if j is not ball)
        if any(ends & below and ends - below for ends in others) or not below <= moved.keys():
            continue
        hanging = [bodies[name] for name in sorted(below)]
        middle = np.average([b.center_of_mass for b in hanging], axis=0, weights=[b.mass for b in hanging])
        down = np.subtract(middle, ball.anchor)
        if -down[2] < HANGING * float(np.linalg.norm(down)):
            continue
        upright = np.eye(4)
        upright[:3, 3] = (moves[ball.body0] @ [*ball.anchor, 1.0])[:3] - ball.anchor
        back = np.linalg.inv(moves[ball.body1])
        moved |= {body: upright @ back @ moves[body] for body in below}
    return moved


def started(
    assembly: Assembly, template: Template, alignment: Alignment, start: Start
) -> tuple[Assembly, Template, Alignment]:
    """The CAD model with its parts moved to the start pose, the template with limits that count from there, and the
    alignment with its axes moved along."""
    frame = alignment.frame
    back = np.linalg.inv(frame)
    moves = {body: back @ move @ frame for body, move in start.displacements.items()}
    body_of = {a.part: a.body for a in alignment.parts}
    parts = tuple(
        replace(p, transform=moves[str(body_of[p.id])] @ p.transform) if body_of.get(p.id) in moves else p
        for p in assembly.parts
    )
    nodes = _nodes(assembly, {p.node: moves[str(body_of[p.id])] for p in assembly.parts if body_of.get(p.id) in moves})
    joints = []
    # A cylinder's slide counts from its closed length, wherever it is drawn.
    rams = {c.slide for a in template.actuators for c in a.cylinders}
    for joint in template.joints:
        if joint.follows is not None and start.closed:
            joint = replace(joint, follows=replace(joint.follows, offset=0.0))
        if joint.at and start.closed:
            joint = replace(joint, at=0.0)
        by = start.coordinates.get(joint.name, 0.0) if joint.name not in rams else 0.0
        lower = joint.lower - by if isinstance(joint.lower, float) else joint.lower
        upper = joint.upper - by if isinstance(joint.upper, float) else joint.upper
        joints.append(replace(joint, lower=lower, upper=upper) if by else joint)
    axes = {}
    for joint in template.joints:
        if joint.name in alignment.axes:
            body = next((b for b in template.bodies_of(joint) if b in moves), None)
            point, direction = alignment.axes[joint.name]
            axes[joint.name] = _moved(moves[body], point, direction) if body is not None else (point, direction)
    return (
        replace(assembly, parts=parts, joints=tuple(_declared(assembly, body_of, moves)), nodes=nodes),
        replace(template, joints=tuple(joints)),
        replace(alignment, axes=axes),
    )


def _nodes(assembly: Assembly, moves: Mapping[int | None, Floats]) -> tuple[Node, ...]:
    """The nodes of the scene tree, each moved with its own parts (`moves`), or where it carries none, with its
    parent."""
    carrying = {part.node for part in assembly.parts}
    by: list[Floats | None] = []
    for number, node in enumerate(assembly.nodes):
        above = None if node.parent is None else by[node.parent]
        by.append(moves.get(number) if number in carrying else above)
    return tuple(
        node if move is None else replace(node, transform=move @ node.transform)
        for node, move in zip(assembly.nodes, by, strict=True)
    )


def _declared(
    assembly: Assembly, body_of: Mapping[str, str | None], moves: Mapping[str, Floats]
) -> Iterator[DeclaredJoint]:
    """The joints that the file declares, moved with a body of theirs; limits, which counted from there, are gone."""
    links = assembly.links()
    for joint in assembly.joints:
        bodies = (str(body_of.get(part.id)) for link in joint.bodies for part in links.get(link, ()))
        body = next((b for b in bodies if b in moves), None)
        if body is None:
            yield joint
            continue
        anchor, axis = _moved(moves[body], joint.anchor, joint.axis)
        yield replace(joint, anchor=anchor, axis=axis, lower=None, upper=None)


def _target(joint: Joint) -> float | None:
    """Where a driven joint that is drawn outside its limits should start; None for any other."""
    if joint.drive is None or joint.lower is None or joint.upper is None or joint.lower > joint.upper:
        return None
    if joint.lower - DRAWN_OUTSIDE <= 0.0 <= joint.upper + DRAWN_OUTSIDE:
        return None
    margin = INSIDE * (joint.upper - joint.lower)
    return joint.lower + margin if joint.lower > 0.0 else joint.upper - margin


def _moved(matrix: Floats, point: Vector, direction: Vector) -> tuple[Vector, Vector]:
    x, y, z = (float(v) for v in matrix[:3, :3] @ np.array(point) + matrix[:3, 3])
    a, b, c = (float(v) for v in matrix[:3, :3] @ np.array(direction))
    return (x, y, z), (a, b, c)


def _range(joint: Joint) -> str:
    return f"{_shown(joint, joint.lower or 0.0)} … {_shown(joint, joint.upper or 0.0)}"


def _shown(joint: Joint, value: float) -> str:
    return f"{1e3 * value:+.1f} mm" if joint.type == "prismatic" else f"{math.degrees(value):+.2f}°"
