"""A template for a machine that the library does not have: documents from the bodies and joints found in a CAD model.

Every body is a role, every joint an entry whose `source` says what it was found by. Slides and their pivots are
actuators, twins together; wheels and what turns about the upright are motors; a hinge of no closed chain is driven by
itself. Limits are names of values that a sheet is asked for, or `--set` gives.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from yellowiron.library.notation.role_keys import matches
from yellowiron.library.proposal.likeness import Likeness
from yellowiron.library.proposal.naming import plain, proposed_names, title
from yellowiron.model.found import FoundJoint, FoundMachine
from yellowiron.model.specification import fold

Json = dict[str, Any]
STEEL = {
    "name": "structural steel", "density": 7850, "elasticity": 2.1e11, "static friction": 0.6, "dynamic friction": 0.5,
    "restitution": 0.1,
    "source": {
        "density, elasticity": "nominal for structural steel (EN 1993-1-1, 3.2.6)",
        "friction, restitution": "typical handbook range of steel on steel or rock",
    },
}  # fmt: skip
QUANTITIES = {
    "bore": ("Bore", "length", "the cylinder's force"),
    "rod_diameter": ("Rod Diameter", "length", "the cylinder's pull force"),
    "stroke": ("Stroke", "length", "upper limit of the cylinder's slide"),
    "closed_length": ("Closed Length", "length", "how far the drawn cylinder is out"),
}
OILS = {
    "pressure": ("Relief Pressure", "pressure", "the cylinders' force"),
    "flow": ("Pump Flow", "flow", "the cylinders' speed"),
}
MOTORS = {
    "speed": ("Speed", "angular_speed", "the motor's top speed"),
    "torque": ("Torque", "torque", "the motor's torque"),
}


@dataclass
class _Draft:
    """The template while it is written."""

    machine: FoundMachine
    names: list[str]
    reasons: list[str]
    like: Likeness
    joint_names: list[str] = field(default_factory=list)
    pins: dict[str, tuple[int, tuple[str, ...]]] = field(default_factory=dict)
    joints: Json = field(default_factory=dict)
    wanted: Json = field(default_factory=dict)
    actuators: Json = field(default_factory=dict)

    def want(self, name: str, dimension: str, use: str) -> str:
        """The name, wanted from now on."""
        entry = self.like.wanted.get(name) or {
            "dimension": dimension, "use": use, "synonyms": {"en": [name.casefold()]}
        }  # fmt: skip
        self.wanted.setdefault(name, entry)
        return name


@dataclass(frozen=True, eq=False)
class Proposal:
    """A template's `documents` by file name without suffix; `roles` of the bodies found and names of the `joints`, in
    their order; and the reasons, in `words` (Markdown)."""

    documents: Mapping[str, Json]
    roles: tuple[str, ...]
    joints: tuple[str, ...]
    words: str


def propose(machine: FoundMachine, *, name: str, like: Likeness | None = None) -> Proposal:
    """A template's documents for a machine that was found.

    `name` is the equipment type's; `like` says which roles of another type the parts play, and lends its entries.
    """
    names, reasons = proposed_names(machine)
    like = like or Likeness()
    _take_over(names, reasons, machine, like)
    draft = _Draft(machine, names, reasons, like)
    for joint in machine.joints:
        draft.joint_names.append(_joint_name(draft, joint))
    _pins(draft)
    _cylinders(draft)
    for k, joint in enumerate(machine.joints):
        draft.joints[draft.joint_names[k]] = _entry(draft, k, joint)
    _motors(draft)
    roles = [*draft.names, *draft.pins]

    def of_roles(entries: Json) -> Json:
        return {key: entry for key, entry in entries.items() if any(matches(role, key) for role in roles)}

    documents: dict[str, Json] = {
        "hierarchy": {name: {"rigid body": "N", "kind": "group", "child": _hierarchy(draft, machine.root)}},
        "joints": draft.joints,
        "materials": of_roles(like.materials) or {"*": STEEL},
        "collision": of_roles(like.collision) or _collision(draft),
    }
    documents |= {"wanted": draft.wanted} if draft.wanted else {}
    documents |= {"actuators": draft.actuators} if draft.actuators else {}
    return Proposal(documents, tuple(draft.names), tuple(draft.joint_names), _words(draft, name))


def _take_over(names: list[str], reasons: list[str], machine: FoundMachine, like: Likeness) -> None:
    """Names of another type's bodies for those that its alignment found among the parts."""
    found = {k: like.body(body.parts, body.kind) for k, body in enumerate(machine.bodies)}
    for k, role in found.items():
        if role is not None and list(found.values()).count(role) == 1:
            names[k], reasons[k] = role, f"plays the role {role} of the type {like.equipment_type}"
    kept = {k for k, reason in enumerate(reasons) if reason.startswith("plays the role")}
    for k in range(len(names)):
        while k not in kept and names.count(names[k]) > 1:
            names[k] += "_other"


# ---- bodies and pins ----
def _parents(machine: FoundMachine) -> dict[int, int]:
    """Body → the one it hangs on: the first joint that leads to it, outward from the root, slides last."""
    parent: dict[int, int] = {}
    reached = {machine.root}
    joints = sorted(machine.joints, key=lambda j: j.type == "prismatic")
    while True:
        ahead = next((j for j in joints if (j.a in reached) != (j.b in reached)), None)
        if ahead is None:
            return parent
        near, far = (ahead.a, ahead.b) if ahead.a in reached else (ahead.b, ahead.a)
        parent[far] = near
        reached.add(far)


def _hierarchy(draft: _Draft, root: int) -> Json:
    parents = _parents(draft.machine)
    rows = {f"{n}_{s}{many}": kind for n, kind, many in _ROWS for s in "lr"} if draft.machine.tracks == 2 else {}

    def entry(k: int) -> Json:
        body = draft.machine.bodies[k]
        child: Json = {pin: {"rigid body": "N", "kind": "pin"} for pin, (host, _) in draft.pins.items() if host == k}
        if k == root:
            child |= {row: {"rigid body": "N", "kind": kind} for row, kind in rows.items()}
        child |= {draft.names[c]: entry(c) for c in sorted(parents) if parents[c] == k}
        kind = draft.like.kind(draft.names[k]) or body.kind
        return {"rigid body": "Y"} | ({"kind": kind} if kind else {}) | ({"child": child} if child else {})

    return {draft.names[root]: entry(root)}


_HALVES = frozenset(
    ("cyl", "cylinder", "ram", "jack", "zylinder", "zyl", "barrel", "tube", "rod", "piston", "hydraulic")
)
"""Words of a hydraulic cylinder's parts that do not say which cylinder."""
_ROWS = (
    ("sprocket", "sprocket", ""), ("idler", "idler", ""), ("track_roller", "roller", "[*]"),
    ("carrier_roller", "carrier", "[*]"), ("track_shoe", "shoe", "[*]"),
)  # fmt: skip
"""Parts of a track that move with the root until the template says more (docs/tracks.md)."""


def _collision(draft: _Draft) -> Json:
    kinds = {"barrel": "analytic", "rod": "analytic", "wheel": "analytic"}
    shaped = {n: kinds[b.kind] for n, b in zip(draft.names, draft.machine.bodies, strict=True) if b.kind in kinds}
    return {"*": "convexHull", **shaped, **({"*_pin": "analytic"} if draft.pins else {})}


def _joint_name(draft: _Draft, joint: FoundJoint) -> str:
    a, b = draft.names[joint.a], draft.names[joint.b]
    between = "_2_" if a[-1].isdigit() else "2"
    name = draft.like.joint(a, b, joint.type) or plain(joint.name) or f"{a}{between}{b}_joint"
    while name in draft.joint_names:
        name = name.removesuffix("_joint") + "_other_joint"
    return name


def _pins(draft: _Draft) -> None:
    """A role for the parts of every pin, carried by the body that all joints on it have in common."""
    for joint in draft.machine.joints:
        same = [j for j in draft.machine.joints if j.pins == joint.pins]
        if not joint.pins or same[0] is not joint:
            continue
        common = set.intersection(*({j.a, j.b} for j in same)) or {joint.a}
        # Where the file says which body has the pin, that carries it.
        host = min(common, key=lambda k: (not set(joint.pins) <= set(draft.machine.bodies[k].parts), k))
        role = draft.like.pin(joint.pins)
        if role is None or role in draft.pins or role in draft.names:
            role = f"{draft.names[_other(joint, host) if host in (joint.a, joint.b) else joint.b]}_pin"
        stem, number = role, 2
        while role in draft.pins or role in draft.names:
            role, number = f"{stem}_{number}", number + 1
        draft.pins[role] = (host, joint.pins)


def _pin_of(draft: _Draft, joint: FoundJoint) -> str | None:
    """The role of a joint's pin, if one of its bodies carries it."""
    found = (r for r, (host, ids) in draft.pins.items() if ids == joint.pins and host in (joint.a, joint.b))
    return next(found, None)


# ---- joints ----
def _entry(draft: _Draft, k: int, joint: FoundJoint) -> Json:
    a, b = draft.names[joint.a], draft.names[joint.b]
    name = draft.joint_names[k]
    kind = {"revolute": "Revolute", "prismatic": "Prismatic", "fixed": "Fixed"}[joint.type]
    entry: Json = {"joint_type": kind, "Body": [a, b]}
    pin = _pin_of(draft, joint) if joint.type == "revolute" else None
    if pin is not None:
        entry["Body"] = [b if draft.pins[pin][0] == joint.a else a, pin]
    known = draft.like.joint_entry(name)
    if known is not None:
        entry |= known
        for limit in known.get("Limit", ()):
            if isinstance(limit, str) and (wanted := limit.lstrip("-").strip()) in draft.like.wanted:
                draft.want(wanted, "", "")
    elif joint.type == "prismatic":
        entry |= _slide(draft, k)
    elif joint.type == "revolute" and not joint.loop:
        entry |= _free(draft, joint)
    declared = any(body.name for body in draft.machine.bodies)
    return entry | {"source": joint.reason if declared else f"found by: {joint.reason}"}


def _slide(draft: _Draft, k: int) -> Json:
    name = draft.joint_names[k]
    for actuator, entry in draft.actuators.items():
        if any(c["slide"] == name for c in entry.get("cylinders", ())):
            stroke = entry["specifications"].get("stroke", f"{title(actuator)} Stroke")
            return {"Limit": ["0", draft.want(stroke, "length", QUANTITIES["stroke"][2])], "Drive": ["Linear Drive"]}
    moved = title(draft.names[draft.machine.joints[k].b])
    back = draft.want(f"{moved} Travel In", "length", "how far it goes in from the drawn pose")
    out = draft.want(f"{moved} Travel Out", "length", "how far it goes out from the drawn pose")
    # In a closed chain it is the cylinder that moves it.
    return {"Limit": [f"-{back}", out]} | ({} if draft.machine.joints[k].loop else {"Drive": ["Linear Drive"]})


def _free(draft: _Draft, joint: FoundJoint) -> Json:
    """A hinge of no closed chain: a wheel's, a slewing bearing's, an axle's, or one without its cylinder."""
    machine = draft.machine
    if "wheel" in (machine.bodies[joint.a].kind, machine.bodies[joint.b].kind):
        return {"Drive": ["Angular Drive"], "free": "Y"}
    if joint.upright:
        return {"Drive": ["Angular Drive"]}
    moved = title(draft.names[joint.b])
    low = draft.want(f"{moved} Angle Down", "angle", "how far it turns one way from the drawn pose")
    high = draft.want(f"{moved} Angle Up", "angle", "how far it turns the other way from the drawn pose")
    limits: Json = {"Limit": [f"-{low}", high]}
    carries = {
        c for j in machine.joints for c in (j.a, j.b) if "wheel" in (machine.bodies[j.a].kind, machine.bodies[j.b].kind)
    }
    return limits | ({"free": "Y"} if joint.b in carries else {"Drive": ["Angular Drive"]})


# ---- actuators ----
def _cylinders(draft: _Draft) -> None:
    """One actuator for the cylinders between the same two bodies."""
    groups: dict[tuple[int, int], list[tuple[int, int, int]]] = {}
    for k, slide in enumerate(draft.machine.joints):
        halves = {draft.machine.bodies[slide.a].kind, draft.machine.bodies[slide.b].kind}
        ends = _pivots(draft.machine, k) if slide.type == "prismatic" and halves == {"barrel", "rod"} else None
        if ends is not None:
            hosts = [_other(draft.machine.joints[e], c) for e, c in zip(ends, (slide.a, slide.b), strict=True)]
            groups.setdefault((hosts[0], hosts[1]), []).append((k, *ends))
    for (host, moved), members in groups.items():
        slides = [draft.joint_names[k] for k, _, _ in members]
        known = draft.like.actuator(slides)
        if known is not None:
            draft.actuators[known[0]] = known[1]
            for wanted in known[1].get("specifications", {}).values():
                draft.want(wanted, "", "") if wanted in draft.like.wanted else None
            continue
        name = _said(draft, [k for k, _, _ in members]) or draft.names[max(host, moved)]
        name = _own(draft, name, f"{name}_{len(draft.actuators)}")
        signs = _signs(draft.machine, host, moved, [k for k, _, _ in members])
        cylinders = []
        for place, ((k, barrel, rod), sign) in enumerate(zip(members, signs, strict=True)):
            cylinder: Json = {
                "slide": draft.joint_names[k], "barrel_joint": draft.joint_names[barrel],
                "rod_joint": draft.joint_names[rod],
            }  # fmt: skip
            cylinders.append(cylinder | ({"sign": sign} if sign < 0 else {}) | ({"passive": "Y"} if place else {}))
        said = {q: draft.want(f"{title(name)} Cylinder {w}", d, use) for q, (w, d, use) in QUANTITIES.items()}
        said |= {q: draft.want(f"{w}", d, use) for q, (w, d, use) in OILS.items()}
        draft.actuators[name] = {"kind": "cylinder", "cylinders": cylinders, "specifications": said}


def _own(draft: _Draft, name: str, other: str) -> str:
    """The name, or the other where an actuator has it already, as templates read names."""
    return other if fold(name) in map(fold, draft.actuators) else name


def _said(draft: _Draft, slides: list[int]) -> str:
    """What some cylinders are called by the names of all their halves: `bucket` of `bucket_cyl1` and `bucket_cyl2`."""
    ends = [end for k in slides for end in (draft.machine.joints[k].a, draft.machine.joints[k].b)]
    said = [[re.sub(r"\d", "", w) for w in name.split("_")] for name in draft.names]
    # A word of every name, such as a robot's `link`, says nothing of one.
    words = [[w for w in said[end] if not all(w in other for other in said)] for end in ends]
    return "_".join(dict.fromkeys(w for w in words[0] if w and w not in _HALVES and all(w in o for o in words)))


def _pivots(machine: FoundMachine, slide: int) -> tuple[int, int] | None:
    """The hinges at the two ends of a cylinder, barrel's (or first body's) and rod's; None without both."""
    joint = machine.joints[slide]
    found = []
    for end in (joint.a, joint.b):
        at = [
            k
            for k, j in enumerate(machine.joints)
            if j.type == "revolute" and end in (j.a, j.b) and _other(j, end) not in (joint.a, joint.b)
        ]
        found.append(at[0] if at else None)
    barrel, rod = found
    return None if barrel is None or rod is None else (barrel, rod)


def _other(joint: FoundJoint, end: int) -> int:
    return joint.b if joint.a == end else joint.a


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


def _motors(draft: _Draft) -> None:
    """One motor for all wheels, one for every slewing bearing."""
    machine = draft.machine
    known = draft.like.motors(draft.joint_names)
    for name, entry in known.items():
        draft.actuators[name] = entry
        for wanted in entry.get("specifications", {}).values():
            draft.want(wanted, "", "") if wanted in draft.like.wanted else None
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


def _motor(draft: _Draft, name: str, joints: list[str]) -> None:
    name = _own(draft, name, f"{name}_motor")
    said = {q: draft.want(f"{title(name)} {w}", d, use) for q, (w, d, use) in MOTORS.items()}
    draft.actuators[name] = {"kind": "motor", "joints": joints, "specifications": said}


# ---- words ----
def _words(draft: _Draft, name: str) -> str:
    machine = draft.machine
    lines = [
        f"# {name}: proposed from a CAD model",
        "",
        "## Bodies",
        "",
        "| role | kind | parts | why | name |",
        "|---|---|---|---|---|",
    ]
    for k, body in enumerate(machine.bodies):
        parts = "<br>".join(_cell(p) for p in body.parts[:5]) + (
            f"<br>… {len(body.parts)} in all" if len(body.parts) > 5 else ""
        )
        lines.append(
            f"| `{draft.names[k]}` | {body.kind} | {parts} | {_cell(body.reason)} | {_cell(draft.reasons[k])} |"
        )
    lines += ["", "## Joints", "", "| joint | type | found by | point (CAD, m) | direction |", "|---|---|---|---|---|"]
    for k, joint in enumerate(machine.joints):
        place = [", ".join(f"{v + 0.0:.4f}" for v in vector) for vector in (joint.point, joint.direction)]
        place = ["", ""] if joint.type == "fixed" else place
        lines.append(f"| `{draft.joint_names[k]}` | {joint.type} | {_cell(joint.reason)} | {place[0]} | {place[1]} |")
    if machine.findings:
        lines += ["", "## To look at", ""]
        lines += [f"- {f.code} ({_cell(f.where)}): {f.message} {f.hint}" for f in machine.findings]
    return "\n".join(lines) + "\n"


def _cell(text: str) -> str:
    return re.sub(r"([|`<])", r"\\\1", text)
