"""Balls that what is drawn does not hold: a dozer's blade on the ball of its C-frame, without its pitch link.

A ball turns three ways, and the hydraulic cylinders and struts between its two bodies hold it in as many. Where some of
these are not drawn, it turns only as those that are drawn turn it: on one hinge, on two that cross, or not at all.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from yellowiron.mechanism.bodies.hidden_knuckles import HiddenKnuckle
from yellowiron.mechanism.joints.frames import RAM, JointFrame
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.rows import names_known
from yellowiron.model.template import JointTemplate, Role, Template
from yellowiron.support.vectors import unit

_LEVER = 0.1
"""What holds a ball does not run through it: its lever is at least this share of its distance from it."""
_OTHERWISE = 0.5
"""What turns a ball another way does so by this share (30°)."""


def with_held_balls(
    template: Template, frames: Mapping[str, JointFrame], findings: list[Finding]
) -> tuple[Template, dict[str, JointFrame], dict[str, HiddenKnuckle]]:
    """The template and its frames with hinges or welds for the balls that what is drawn does not hold, and the hidden
    bodies between hinges that cross, by name."""
    ends = {j.name: {*map(str, template.bodies_of(j))} for j in template.joints if names_known(j, template)}
    kinds = {r.name: r.kind for r in template.roles}
    roles, joints, found = list(template.roles), list(template.joints), dict(frames)
    hidden: dict[str, HiddenKnuckle] = {}
    for name, frame in frames.items():
        pair = {*frame.bodies}
        beside = [f for f in frames.values() if {*f.bodies} == pair]
        if frame.joint.type != "spherical" or len(beside) > 1 or any(kinds[b] in RAM for b in pair):
            continue
        holders = list(_holders(template, ends, pair))
        drawn = [h for h in holders if {*h} <= frames.keys()]
        if len(drawn) == len(holders):
            continue
        ways = _ways(frame.anchor, [(frames[h[0]].anchor, frames[h[-1]].anchor) for h in drawn])
        if len(ways) == 3:
            continue
        made, own = _hinges(frame, ways)
        if own is not None:
            roles.append(own)
            hidden[own.name] = HiddenKnuckle(own.name, frame.bodies[1], frame.anchor)
        joints = [k for j in joints for k in ([f.joint for f in made] if j.name == name else [j])]
        del found[name]
        found |= {f.joint.name: f for f in made}
        moves = {0: "they move as one", 1: "it turns on one hinge", 2: "it turns on two that cross"}[len(ways)]
        words = f"What holds this ball is not all drawn: {moves}, as what is drawn moves it."
        hint = "Draw its other cylinders and links, or give their parts these roles in the alignment."
        findings.append(Finding("MEC073", "warning", name, words, hint))
    result = replace(template, roles=tuple(roles), joints=tuple(joints))
    return result, {j.name: found[j.name] for j in result.joints if j.name in found}, hidden


def _holders(template: Template, ends: Mapping[str, set[str]], pair: set[str]) -> Iterator[tuple[str, ...]]:
    """The cylinders between two bodies (the joints of barrel, slide and rod) and the struts (a ball at either end)."""
    for cylinder in (c for a in template.actuators for c in a.cylinders):
        own = (cylinder.barrel_joint, cylinder.slide, cylinder.rod_joint)
        names = tuple(n for n in own if n is not None and n in ends)
        if len(names) == 3 and ends[names[0]] ^ ends[names[1]] ^ ends[names[2]] == pair:
            yield names
    for body in sorted({b for own in ends.values() for b in own} - pair):
        names = tuple(n for n, p in ends.items() if body in p)
        balls = all(template.joint(n).type == "spherical" for n in names)
        if len(names) == 2 and balls and ends[names[0]] ^ ends[names[1]] == pair:
            yield names


def _ways(ball: Floats, holders: list[tuple[Floats, Floats]]) -> list[Floats]:
    """The directions (3,) about which holders, from one point to another, turn what hangs on a ball: as many as are
    across each other, the longest lever first."""
    levers = [np.cross(end - ball, unit(end - start)) for start, end in holders]
    far = [float(np.linalg.norm(end - ball)) for _, end in holders]
    kept = [v for v, r in zip(levers, far, strict=True) if float(np.linalg.norm(v)) > _LEVER * r]
    ways: list[Floats] = []
    for lever in sorted(kept, key=lambda v: -round(float(np.linalg.norm(v)), 9)):
        left = unit(lever)
        for way in ways:
            left = left - float(left @ way) * way
        if float(np.linalg.norm(left)) > _OTHERWISE:
            ways.append(unit(left))
    return ways


def _hinges(frame: JointFrame, ways: list[Floats]) -> tuple[list[JointFrame], Role | None]:
    """What a ball becomes, and the role of the hidden body between two hinges."""
    joint, (carried, bearer) = frame.joint, frame.bodies
    if not ways:
        welded = replace(joint, type="fixed", drive=None, free=False)
        return [replace(frame, joint=welded, axis=np.array([1.0, 0.0, 0.0]), weight=0.0)], None
    turning = replace(joint, type="revolute")
    if len(ways) == 1:
        return [replace(frame, joint=turning, axis=ways[0], weight=0.0)], None
    between = Role(f"{carried}_cross", bearer, rigid=True)
    made = []
    for way, pair in zip(ways, ((bearer, between.name), (between.name, carried)), strict=True):
        other = JointTemplate(f"{pair[0]}2{pair[1]}_joint", "revolute", pair)
        made.append(replace(frame, joint=other, bodies=pair, axis=way, weight=0.0))
    return made, between
