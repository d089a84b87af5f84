"""`actuators.json` of a machine that was found: twins together, one motor for the wheels, one for every swing."""

from __future__ import annotations

import re

import numpy as np

from yellowiron.library.proposal.draft import Draft, Json, other_body
from yellowiron.library.proposal.naming import title
from yellowiron.model.found import FoundMachine
from yellowiron.model.specification import fold

QUANTITIES = {
    "bore": ("Bore", "length", "the cylinder's force"),
    "rod_diameter": ("Rod Diameter", "length", "the cylinder's pull force"),
    "stroke": ("Stroke", "length", "upper limit of the cylinder's slide"),
    "closed_length": ("Closed Length", "length", "how far the drawn cylinder is out"),
}
_OILS = {
    "pressure": ("Relief Pressure", "pressure", "the cylinders' force"),
    "flow": ("Pump Flow", "flow", "the cylinders' speed"),
}
_MOTORS = {
    "speed": ("Speed", "angular_speed", "the motor's top speed"),
    "torque": ("Torque", "torque", "the motor's torque"),
}
_HALVES = frozenset(
    ("cyl", "cylinder", "ram", "jack", "zylinder", "zyl", "barrel", "tube", "rod", "piston", "hydraulic")
)
"""Words of a hydraulic cylinder's parts that do not say which cylinder."""


def add_cylinders(draft: Draft) -> None:
    """One actuator for the cylinders between the same two bodies."""
    for (host, moved), members in _groups(draft).items():
        slides = [k for k, _, _ in members]
        known = draft.like.actuator([draft.joint_names[k] for k in slides])
        if known is not None:
            draft.actuators[known[0]] = known[1]
            _want_known(draft, known[1])
            continue
        name = _said(draft, slides) or draft.names[max(host, moved)]
        name = _own(draft, name, f"{name}_{len(draft.actuators)}")
        signs = _signs(draft.machine, host, moved, slides)
        cylinders = []
        for place, ((k, barrel, rod), sign) in enumerate(zip(members, signs, strict=True)):
            cylinder: Json = {
                "slide": draft.joint_names[k], "barrel_joint": draft.joint_names[barrel],
                "rod_joint": draft.joint_names[rod],
            }  # fmt: skip
            cylinders.append(cylinder | ({"sign": sign} if sign < 0 else {}) | ({"passive": "Y"} if place else {}))
        said = {q: draft.want(f"{title(name)} Cylinder {w}", d, use) for q, (w, d, use) in QUANTITIES.items()}
        said |= {q: draft.want(f"{w}", d, use) for q, (w, d, use) in _OILS.items()}
        draft.actuators[name] = {"kind": "cylinder", "cylinders": cylinders, "specifications": said}


def _groups(draft: Draft) -> dict[tuple[int, int], list[tuple[int, int, int]]]:
    """Cylinders by the two bodies they are between, the one with the barrel first: joints (slide, barrel's, rod's)."""
    groups: dict[tuple[int, int], list[tuple[int, int, int]]] = {}
    for k, slide in enumerate(draft.machine.joints):
        halves = {draft.machine.bodies[slide.a].kind, draft.machine.bodies[slide.b].kind}
        # Nearer to the root may be the one or the other: a hoist's rod often stands on the chassis.
        pair = (slide.a, slide.b) if draft.machine.bodies[slide.a].kind == "barrel" else (slide.b, slide.a)
        ends = _pivots(draft.machine, pair) if slide.type == "prismatic" and halves == {"barrel", "rod"} else None
        if ends is not None:
            hosts = [other_body(draft.machine.joints[e], c) for e, c in zip(ends, pair, strict=True)]
            groups.setdefault((hosts[0], hosts[1]), []).append((k, *ends))
    return groups


def _want_known(draft: Draft, entry: Json) -> None:
    """Asks for what another type's actuator names, as that type does."""
    for wanted in entry.get("specifications", {}).values():
        if wanted in draft.like.wanted:
            draft.want(wanted, "", "")


def _own(draft: Draft, name: str, other: str) -> str:
    """The name, or the other where an actuator has it already, as templates read names."""
    return other if fold(name) in map(fold, draft.actuators) else name


def _said(draft: Draft, slides: list[int]) -> str:
    """What some cylinders are called by the names of all their halves: `bucket` of `bucket_cyl1` and `bucket_cyl2`."""
    ends = [end for k in slides for end in (draft.machine.joints[k].a, draft.machine.joints[k].b)]
    said = [[re.sub(r"\d", "", w) for w in name.split("_")] for name in draft.names]
    # A word of every name, such as a robot's `link`, says nothing of one.
    words = [[w for w in said[end] if not all(w in other for other in said)] for end in ends]
    return "_".join(dict.fromkeys(w for w in words[0] if w and w not in _HALVES and all(w in o for o in words)))


def _pivots(machine: FoundMachine, pair: tuple[int, int]) -> tuple[int, int] | None:
    """The hinges at the two ends of a cylinder, a pair of bodies (barrel, rod); None without both."""
    found = []
    for end in pair:
        at = [
            k
            for k, j in enumerate(machine.joints)
            if j.type == "revolute" and end in (j.a, j.b) and other_body(j, end) not in pair
        ]
        found.append(at[0] if at else None)
    barrel, rod = found
    return None if barrel is None or rod is None else (barrel, rod)


def _signs(machine: FoundMachine, host: int, moved: int, slides: list[int]) -> list[int]:
    """Whether each cylinder extends (1) or retracts (−1) when the first one extends: by its side of the hinge between
    the two bodies."""
    hinge = next((j for j in machine.joints if j.type == "revolute" and {j.a, j.b} == {host, moved}), None)
    if hinge is None:
        return [1] * len(slides)
    arms = [
        float(
            np.cross(np.subtract(machine.joints[k].point, hinge.point), machine.joints[k].direction) @ hinge.direction
        )
        for k in slides
    ]
    return [1 if arm * arms[0] >= 0 else -1 for arm in arms]


def add_motors(draft: Draft) -> None:
    """One motor for all wheels, one for every slewing bearing."""
    machine = draft.machine
    known = draft.like.motors(draft.joint_names)
    for name, entry in known.items():
        draft.actuators[name] = entry
        _want_known(draft, entry)
    claimed = {j for entry in known.values() for j in entry["joints"]}
    wheels = []
    for k, joint in enumerate(machine.joints):
        if joint.type != "revolute" or joint.loop or draft.joint_names[k] in claimed:
            continue
        if "wheel" in (machine.bodies[joint.a].kind, machine.bodies[joint.b].kind):
            wheels.append(draft.joint_names[k])
        elif joint.upright and draft.joints[draft.joint_names[k]].get("Drive"):
            _motor(draft, draft.names[joint.b], [draft.joint_names[k]])
    if wheels:
        _motor(draft, "travel", wheels)


def _motor(draft: Draft, name: str, joints: list[str]) -> None:
    name = _own(draft, name, f"{name}_motor")
    said = {q: draft.want(f"{title(name)} {w}", d, use) for q, (w, d, use) in _MOTORS.items()}
    draft.actuators[name] = {"kind": "motor", "joints": joints, "specifications": said}
