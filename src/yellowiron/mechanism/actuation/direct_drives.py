"""Hinges that are driven directly, where the CAD model has no cylinder that could."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import replace

import networkx

from yellowiron.mechanism.actuation.cylinders import pivot_distance
from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.mechanism.placement import Placement
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import PROVISIONAL, STATED, Drive
from yellowiron.model.template import (
    COMMON_HINGE,
    ActuatorTemplate,
    CylinderTemplate,
    Follows,
    JointTemplate,
    Template,
)
from yellowiron.support.graphs import bridges

_PINS = "Check the pins of their linkage (in the studio, or by 'joints' in the alignment)."
_SIDES = re.compile(r"(?<=_)[lr](?=_)")
"""The side in a joint's name."""
_SHORTEST = 0.1
"""A cylinder's pivots are farther apart than this share of its barrel or rod."""
_LONGEST = 6
"""Joints from a barrel round to its rod, at most."""


def without_cylinders(
    template: Template, frames: Mapping[str, JointFrame], standing: Mapping[str, str]
) -> dict[str, JointFrame]:
    """Frames without the slides of `standing` cylinders and without all pins of their rods but one: what is left of
    such a cylinder hangs on its pins and moves nothing."""
    left = dict(frames)
    for cylinder in (c for a in template.actuators for c in a.cylinders if c.slide in standing and c.slide in frames):
        if not cylinder.pins:
            del left[cylinder.slide]
            continue
        barrel = next((b for b in _ends(left, cylinder.barrel_joint) if b in left[cylinder.slide].bodies), None)
        rods = {b for b in left.pop(cylinder.slide).bodies if b != barrel}
        left = {n: f for n, f in left.items() if n == cylinder.rod_joint or not rods & {*f.bodies}}
    return left


def out_of_reach(template: Template, frames: Mapping[str, JointFrame], placement: Placement) -> dict[str, str]:
    """Slides of cylinders that cannot move what they are for, and why: the hinge that they should turn is in no loop,
    as a link between was not found, or both pivots were found in one place. Cylinders with a joint of a user's document
    are left as they were told."""
    bodies = {name: frame.bodies for name, frame in frames.items()}
    size = _size_in(placement)
    loose, claimed = bridges(bodies), {name for actuator in template.actuators for name in actuator.joints}
    found: dict[str, str] = {}
    for actuator in (a for a in template.actuators if a.cylinders):
        whole = [c for c in actuator.cylinders if c.pins and {*c.joints} <= frames.keys()]
        whole = [c for c in whole if not any("joint" in frames[name].joint.documents for name in c.joints)]
        hinge = hinge_of(template, actuator, bodies, size, claimed)
        claimed |= {hinge} if hinge is not None else set()
        if whole and hinge in loose:
            found |= dict.fromkeys((c.slide for c in whole), f"nothing that joins them to '{bodies[hinge][1]}'")
        for cylinder in whole:
            apart = pivot_distance(*(frames[name] for name in cylinder.pins))
            if apart < _SHORTEST * max(size(b) for b in bodies[cylinder.slide]):
                found[cylinder.slide] = f"pivots {1e3 * apart:.0f} mm apart"
    return found


def _size_in(placement: Placement) -> Callable[[str], float]:
    return lambda body: placement.diagonal(placement.rows_of_body(body))


def with_direct_hinges(
    template: Template,
    frames: Mapping[str, JointFrame],
    placement: Placement,
    standing: Mapping[str, str],
    findings: list[Finding],
) -> tuple[Template, dict[str, str]]:
    """The template with a hinge in the place of the cylinders of every actuator that has none in the CAD model, and
    those hinges, each with its actuator. `standing` says of slides that were found why their cylinders cannot do it
    (MEC018).

    The hinge is one on any way from the barrel round to the rod, over the template's joints, that the CAD model has
    (`hinge_of`); one that another actuator's cylinders move is not taken.
    """
    claimed = {name for actuator in template.actuators for name in actuator.joints}
    bodies = {name: frame.bodies for name, frame in frames.items()}
    actuators: list[ActuatorTemplate] = []
    direct: dict[str, str] = {}
    for actuator in template.actuators:
        hinge = hinge_of(template, actuator, bodies, _size_in(placement), claimed) if actuator.cylinders else None
        if hinge is not None:
            claimed.add(hinge)
        wrong = {c.slide: standing[c.slide] for c in actuator.cylinders if c.slide in standing}
        whole = any({*c.joints} <= frames.keys() for c in actuator.cylinders)
        if hinge is not None and not whole:
            usual = not template.hinges.get(actuator.name, COMMON_HINGE).common
            findings.append(_told(actuator.name, hinge, next(iter(wrong.values()), None), usual=usual))
            direct[hinge] = actuator.name
            actuator = replace(actuator, kind="motor", cylinders=(), joints=(hinge,))
        elif whole:
            words = "Its cylinder does not work as it was found ({}): it stands as drawn."
            findings += [Finding("MEC018", "warning", slide, words.format(why), _PINS) for slide, why in wrong.items()]
        actuators.append(actuator)
    if not direct:
        return template, direct
    led = {twin: name for name in direct if (twin := _idle_twin(name, bodies, claimed)) is not None}
    joints = tuple(
        replace(j, drive="angular") if j.name in direct
        else replace(j, follows=Follows(led[j.name], kind="rod")) if j.name in led
        else j
        for j in template.joints
    )  # fmt: skip
    return replace(template, actuators=tuple(actuators), joints=joints), direct


def _idle_twin(hinge: str, bodies: Mapping[str, tuple[str, str]], claimed: Collection[str]) -> str | None:
    """The hinge on the machine's other side that would turn with one that is driven, by a rod that is not there: of two
    steered knuckles without their tie rod. None where something else moves it, or joins the two."""
    twin = _SIDES.sub(lambda side: "r" if side[0] == "l" else "l", hinge, count=1)
    if twin == hinge or twin not in bodies or twin in claimed:
        return None
    shared = {*bodies[hinge]} & {*bodies[twin]}
    if len(shared) != 1:
        return None
    own, other = ({*bodies[name]} - shared for name in (hinge, twin))
    beyond = networkx.Graph(pair for pair in bodies.values() if not shared & {*pair})
    beyond.add_nodes_from(own | other)
    return None if networkx.has_path(beyond, *own, *other) else twin


def _told(actuator: str, hinge: str, reason: str | None, *, usual: bool) -> Finding:
    whose = "is usual" if usual else "machines' hinges usually are"
    how = f"directly, as far, fast and hard as {whose}."
    if reason is None:
        words = f"The CAD model has none of its cylinders: '{hinge}' is driven {how}"
        hint = "Give the hinge's Limit and max_force in a joints document (--data), or the cylinders in CAD."
        return Finding("MEC013", "warning", actuator, words, hint)
    words = f"Its cylinders do not work as they were found ({reason}): they stand as drawn, and '{hinge}' is driven "
    return Finding("MEC018", "warning", actuator, words + how, _PINS)


def direct_drives(direct: Collection[str], frames: Mapping[str, JointFrame]) -> dict[str, Drive]:
    """The position drives of hinges that are driven directly, by joint name."""
    drives = {}
    for name in sorted(direct):
        joint = frames[name].joint
        force = joint.max_force if joint.max_force is not None else math.inf
        speed = joint.max_velocity if joint.max_velocity is not None else math.inf
        stiffness, damping = joint.stiffness or 0.0, joint.damping or 0.0
        stated = [key for key, value in (("stiffness", stiffness), ("damping", damping)) if value]
        source = f"driven directly, without its cylinder; {PROVISIONAL}"
        source += f"; {STATED}{', '.join(stated)}" if stated else ""
        drives[name] = Drive("position", stiffness, damping, force, speed, source)
    return drives


def hinge_of(
    template: Template,
    actuator: ActuatorTemplate,
    bodies: Mapping[str, tuple[str, str]],
    size: Callable[[str], float],
    claimed: Collection[str] = (),
) -> str | None:
    """The hinge that an actuator's cylinders turn, of those that are there (joint → its `bodies`) and not `claimed`:
    that between the largest two bodies, before all one of a body that a wheel rolls on."""
    # What a barrel or a rod hangs on moves nothing but that.
    own = {name for each in template.actuators for c in each.cylinders for name in c.pins}
    ways = sorted((way for c in actuator.cylinders for way in _ways(template, c)), key=len)
    names = dict.fromkeys(j.name for way in ways for j in way if j.type == "revolute")
    fit = [name for name in names if name in bodies and name not in own and name not in claimed]
    sizes = {b: size(b) for name in fit for b in bodies[name]}
    wheels = {role.name for role in template.roles if role.kind == "wheel"}
    bearing = {b for pair in bodies.values() if wheels & {*pair} for b in pair}

    def weight(name: str) -> tuple[bool, float]:
        return bool(bearing & {*bodies[name]}), min(sizes[b] for b in bodies[name])

    return max(fit, key=weight, default=None)


def _ends(frames: Mapping[str, JointFrame], joint: str | None) -> tuple[str, ...]:
    return frames[joint].bodies if joint is not None and joint in frames else ()


def _ways(template: Template, cylinder: CylinderTemplate) -> Iterator[list[JointTemplate]]:
    """Joints from a cylinder's barrel to its rod, without its slide: every way that passes no body twice."""
    by_name = {j.name: j for j in template.joints}
    slide, hung = by_name.get(cylinder.slide), by_name.get(cylinder.barrel_joint or "")
    if slide is None or (hung is None and cylinder.barrel_joint is not None):
        return
    ends = template.bodies_of(slide)
    barrel = next((b for b in ends if hung is not None and b in template.bodies_of(hung)), ends[0])
    rod = next((b for b in ends if b != barrel), None)
    beside: dict[str | None, list[tuple[JointTemplate, str | None]]] = {}
    known = {role.name for role in template.roles}
    for joint in template.joints:
        if joint.name != cylinder.slide and known.issuperset(joint.parts):
            a, b = template.bodies_of(joint)
            beside.setdefault(a, []).append((joint, b))
            beside.setdefault(b, []).append((joint, a))
    stack: list[tuple[str | None, list[JointTemplate], frozenset[str | None]]] = [(barrel, [], frozenset({barrel}))]
    while stack:
        body, way, passed = stack.pop()
        if body == rod:
            yield way
            continue
        if len(way) < _LONGEST:
            for joint, other in beside.get(body, []):
                if other is not None and other not in passed:
                    stack.append((other, [*way, joint], passed | {other}))
