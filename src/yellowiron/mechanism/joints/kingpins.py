"""Steered wheels whose knuckles are not drawn: each turns about an upright kingpin in its own middle.

Of a machine that is drawn from outside, wheels are all there is of a steered axle: no knuckle, no tie rod, no cylinder.
Such a wheel gets a knuckle that no part plays, and an upright axis through its middle; the first of an actuator's is
driven directly, the others turn alike, as a tie rod would have them. Wheels ahead of the machine's middle turn to the
side that is steered to, those behind it to the other.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import networkx
import numpy as np

from yellowiron.mechanism.bodies.hidden_knuckles import HiddenKnuckle
from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.mechanism.placement import Placement
from yellowiron.model.finding import Finding
from yellowiron.model.rows import names_known
from yellowiron.model.template import Follows, JointTemplate, Template

UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class _Steered:
    """A wheel on a knuckle that is not drawn: the names of the `knuckle`, of its hinge, of the wheel and its joint, and
    the actuator that steers it."""

    knuckle: str
    hinge: str
    wheel: str
    rolling: str
    actuator: str


def with_kingpins(
    whole: Template,
    drawn: Template,
    frames: Mapping[str, JointFrame],
    placement: Placement,
    findings: list[Finding],
) -> tuple[Template, dict[str, JointFrame], dict[str, str], dict[str, HiddenKnuckle]]:
    """The template `drawn` (the `whole` one without axles that are not drawn) and its frames with kingpins for the
    wheels that the whole one steers; the hinges that are driven for it, each with its actuator; the knuckles by
    name."""
    steered = list(_steered(whole, drawn, frames, placement))
    if not steered:
        return drawn, dict(frames), {}, {}
    wheels = [r.name for r in whole.roles if r.kind == "wheel"]
    ahead = [f.anchor[0] for f in frames.values() if {*f.bodies} & {*wheels}]
    middle = 0.5 * (min(ahead) + max(ahead))

    roles, joints, found = list(drawn.roles), list(drawn.joints), dict(frames)
    direct: dict[str, str] = {}
    knuckles: dict[str, HiddenKnuckle] = {}
    for one in steered:
        rolling = frames[one.rolling]
        carrier = next(b for b in rolling.bodies if b != one.wheel)
        leader = next((hinge for hinge, actuator in direct.items() if actuator == one.actuator), None)
        follows = Follows(leader, kind="rod") if leader is not None else None
        # What a user's document says of it holds.
        stated = next((j for j in whole.joints if j.name == one.hinge), JointTemplate(one.hinge, "revolute", ("", "")))
        hinge = replace(stated, parts=(carrier, one.knuckle), drive=None if follows else "angular", follows=follows)
        axis = UP if rolling.anchor[0] >= middle else -UP
        source = {"template": one.hinge, "method": "upright through the wheel's middle: no knuckle is drawn"}
        roles = [replace(r, rigid=True, optional=False) if r.name == one.knuckle else r for r in roles]
        joints = [j for j in joints if j.name != one.hinge] + [hinge]
        found[one.hinge] = JointFrame(hinge, (carrier, one.knuckle), rolling.anchor, axis, 0.0, source)
        first, second = (one.knuckle if b == carrier else b for b in rolling.bodies)
        found[one.rolling] = replace(rolling, bodies=(first, second))
        knuckles[one.knuckle] = HiddenKnuckle(one.knuckle, one.wheel, rolling.anchor)
        if leader is None:
            direct[one.hinge] = one.actuator
    actuators = tuple(
        replace(a, kind="motor", cylinders=(), joints=tuple(h for h, name in direct.items() if name == a.name))
        if a.name in direct.values() else a
        for a in drawn.actuators
    )  # fmt: skip
    for leading, actuator in direct.items():
        names = sorted(one.wheel for one in steered if one.actuator == actuator)
        words = f"No knuckle is drawn: {' and '.join(names)} are steered about upright axes through their middles"
        words += ", as far as is usual." if actuator in whole.hinges else "."
        hint = f"Give the Limit of '{leading}' in a joints document (--data), or the steered axle in CAD."
        findings.append(Finding("MEC038", "warning", actuator, words, hint))
    made = replace(drawn, roles=tuple(roles), joints=tuple(joints), actuators=actuators)
    return made, {j.name: found[j.name] for j in made.joints if j.name in found}, direct, knuckles


def _steered(
    whole: Template, drawn: Template, frames: Mapping[str, JointFrame], placement: Placement
) -> Iterator[_Steered]:
    """The wheels that an actuator of the whole template steers by knuckles of which none is drawn: bodies that carry a
    wheel each, and that its cylinders reach without passing what carries them."""
    joints = [j for j in whole.joints if names_known(j, whole)]
    ends = {j.name: (str(whole.bodies_of(j)[0]), str(whole.bodies_of(j)[1])) for j in joints}
    wheels = {r.name for r in whole.roles if r.kind == "wheel" and r.rigid}
    carried: dict[str, set[str]] = {}
    for pair in ends.values():
        for body, other in (pair, pair[::-1]):
            if other in wheels:
                carried.setdefault(body, set()).add(other)
    slides = {a.name: [c.slide for c in a.cylinders] for a in whole.actuators if a.cylinders}
    for joint in joints:
        wheel = next((b for b in ends[joint.name] if b in wheels), None)
        knuckle = next((b for b in ends[joint.name] if b != wheel), "")
        frame = frames.get(joint.name)
        if wheel is None or frame is None or placement.has_body(knuckle) or carried.get(knuckle) != {wheel}:
            continue
        if not whole.role(knuckle).side:  # a frame with one drum
            continue
        carrier = next(b for b in frame.bodies if b != wheel)
        if carrier == knuckle or drawn.body_of(knuckle) != carrier:
            continue
        linkage = networkx.Graph(pair for pair in ends.values() if carrier not in pair and not wheels & {*pair})
        linkage.add_node(knuckle)
        reached = networkx.node_connected_component(linkage, knuckle)
        if any(placement.has_body(b) and len(carried.get(b, ())) == 1 for b in reached):
            continue
        actuator = next((a for a, own in slides.items() if any({*ends[s]} & reached for s in own)), None)
        if actuator is not None:
            above = whole.body_of(str(whole.role(knuckle).parent))
            hinge = next((n for n, pair in ends.items() if {*pair} == {knuckle, above}), f"{carrier}2{knuckle}_joint")
            yield _Steered(knuckle, hinge, wheel, joint.name, actuator)
