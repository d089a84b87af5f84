"""What a joint template without a hierarchy implies, as the journal paper's Fig. A1 is printed.

The joint names say it: in `front_frame2boom_joint`, `Body` ["boom", "boom_pin"], the pin belongs to `front_frame`, the
body of the name that is missing from `Body`. A cylinder's barrel or rod without a pivot is welded to its frame.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace

from yellowiron.library.notation.validated_json import Document
from yellowiron.model.errors import TemplateError
from yellowiron.model.rows import split_index
from yellowiron.model.template import ActuatorTemplate, CylinderTemplate, JointTemplate, Role, Template
from yellowiron.support.graphs import bridges

_SIDE = re.compile(r"_([lr])(?=_|2|$)")
_KINDS = (("pin", "pin"), ("barrel", "barrel"), ("rod", "rod"), ("wheel", "wheel"), ("wheels", "wheel"),
          ("tyre", "tyre"), ("tire", "tyre"), ("frame", "frame"), ("chassis", "frame"))  # fmt: skip
_BASES = ("frame", "chassis", "undercarriage", "body")


def infer_roles(
    joints: tuple[JointTemplate, ...], document: Document
) -> tuple[tuple[Role, ...], tuple[JointTemplate, ...], str]:
    """The roles that a joint template implies, its joints (undriven ones outside every loop become free), and the root.

    `TemplateError` where a pin's body cannot be told.
    """
    bodies = _bodies(joints)
    pins = [(joint, part) for joint in joints for part in joint.parts if part not in bodies]
    # Names spelled out first: `rear` is then short for a body that another joint names in full.
    carriers = {part: _carrier(joint, part, bodies, spelled=True) for joint, part in pins}
    bodies += [c for c in dict.fromkeys(carriers.values()) if c is not None and c not in bodies]
    for joint, part in pins:
        carriers[part] = carriers[part] or _carrier(joint, part, bodies, spelled=False)
        if carriers[part] is None:
            raise TemplateError(
                f"Which body carries '{part}' of joint '{joint.name}' cannot be told",
                where=document.at(joint.name, "Body"),
                hint="Add a hierarchy.json, or name the joint after its two bodies: front_frame2boom_joint.",
            )
    bodies += [c for c in dict.fromkeys(carriers.values()) if c is not None and c not in bodies]
    ends = {j.name: tuple(carriers.get(p) or p for p in j.parts) for j in joints}
    root = _root(joints, ends, bodies)
    welded = _welded(joints, ends, root)
    roles = [_role(name, welded.get(name), rigid=name not in welded) for name in bodies]
    roles += [_role(name, carrier, rigid=False) for name, carrier in carriers.items()]
    # Parents first.
    ordered = sorted(roles, key=lambda r: r.parent is not None)
    loose = bridges({n: _through(welded, e) for n, e in ends.items()})
    return tuple(ordered), tuple(replace(j, free=j.free or (j.drive is None and j.name in loose)) for j in joints), root


def infer_actuators(template: Template) -> tuple[ActuatorTemplate, ...]:
    """Actuators for a template without `actuators.json`: one a driven joint, left and right twins together. Which twin
    retracts is not known; all signs are +1. A slide that turns at neither end, or at one and is between neither barrel
    nor rod, is no cylinder's: its drive is its own."""
    cylinders: dict[str, list[CylinderTemplate]] = {}
    strokes: dict[str, dict[str, str]] = {}
    motors: dict[str, list[str]] = {}
    for joint in template.joints:
        name = _SIDE.sub("", joint.name.removesuffix("_joint"))
        if joint.drive == "linear":
            barrel, rod = (_pivot(template, joint, body) for body in _barrel_first(template, joint))
            kinds = {template.role(split_index(part)[0]).kind for part in joint.parts}
            if not (barrel and rod) and (not (barrel or rod) or kinds.isdisjoint(("barrel", "rod"))):
                continue
            strokes[name] = {"stroke": joint.upper} if isinstance(joint.upper, str) else {}
            twins = cylinders.setdefault(name, [])
            twins.append(CylinderTemplate(joint.name, barrel, rod, passive=bool(twins), when=joint.when))
        elif joint.drive == "angular":
            motors.setdefault(name, []).append(joint.name)
    source = "One actuator for each drive of joints.json; there is no actuators.json."
    return (
        *(
            ActuatorTemplate(name, "cylinder", cylinders=tuple(c), specifications=strokes[name], source=source)
            for name, c in cylinders.items()
        ),
        *(ActuatorTemplate(name, "motor", joints=tuple(j), source=source) for name, j in motors.items()),
    )


def _pivots(template: Template, body: str | None) -> list[JointTemplate]:
    """The joints of a body that are not prismatic."""
    return [j for j in template.joints if j.type != "prismatic" and body in template.bodies_of(j)]


def _words_of(name: str) -> list[str]:
    """`steering_piston_rod_l` → its words."""
    return [w for w in re.split(r"[\s_-]+", name.casefold()) if w]


def _joined(name: str) -> str:
    """A name in lower case, its words joined by one `_`."""
    return "_".join(_words_of(name))


def _begins(name: str, words: str) -> bool:
    """Whether a name begins with all of some words: `front_frame` with `front`."""
    return bool(_words_of(words)) and _words_of(name)[: len(_words_of(words))] == _words_of(words)


def _pivot(template: Template, slide: JointTemplate, part: str) -> str:
    """The joint by which a barrel or rod turns on its frame; empty where it is welded to it."""
    role = template.role(split_index(part)[0])
    found = _pivots(template, role.name) if role.rigid else []
    same = [j for j in found if j.when == slide.when] or found
    return same[0].name if same else ""


def _barrel_first(template: Template, slide: JointTemplate) -> tuple[str, str]:
    first, second = slide.parts
    kinds = [template.role(split_index(p)[0]).kind for p in slide.parts]
    return (second, first) if kinds[1] == "barrel" or kinds[0] == "rod" else (first, second)


def _sides(joint: JointTemplate) -> list[tuple[str, str]]:
    """Every way to read the joint's name as `a2b`."""
    name = joint.name.removesuffix("_joint")
    return [(name[: m.start()], name[m.end() :]) for m in re.finditer("2", name) if 0 < m.start() < len(name) - 1]


def _bodies(joints: Iterable[JointTemplate]) -> list[str]:
    """Parts that are bodies: those a joint's name spells out, and both parts of a joint whose name is no `a2b`."""
    found: dict[str, None] = {}
    for joint in joints:
        sides = _sides(joint)
        for part in joint.parts:
            if not sides or any(_joined(part) in (_joined(a), _joined(b)) for a, b in sides):
                found[part] = None
    # Neither part spelled out by this name nor by another: take both for bodies.
    for joint in joints:
        if not any(part in found for part in joint.parts):
            found.update(dict.fromkeys(joint.parts))
    return list(found)


def _carrier(joint: JointTemplate, pin: str, bodies: list[str], *, spelled: bool) -> str | None:
    """The body that a pin moves with: the one the joint's name has and `Body` has not. `spelled`: the name has the
    other body in full; else it may be shortened."""
    other = joint.parts[1] if joint.parts[0] == pin else joint.parts[0]
    for a, b in _sides(joint):
        for here, missing in ((a, b), (b, a)):
            if _joined(here) == _joined(other) if spelled else _begins(other, here):
                return _named(missing, other, bodies)
    return None


def _named(name: str, other: str, bodies: list[str]) -> str:
    """The body of that name, or the frame whose name begins with it (`rear`: `rear_frame`), else a new body."""
    for body in bodies:
        if _joined(body) == _joined(name):
            return body
    frames = [b for b in bodies if b != other and _begins(b, name) and _words_of(b)[-1] in _BASES]
    return (frames or [name])[0]


def _root(joints: Iterable[JointTemplate], ends: Mapping[str, tuple[str, ...]], bodies: list[str]) -> str:
    """The first body that no joint leads to; `a2b` leads from a to b, other joints from the first of `Body`."""
    reached: set[str] = set()
    for joint in joints:
        first, second = ends[joint.name]
        leads_to = second
        for a, b in _sides(joint):
            spelled = _joined(first) == _joined(b) or _joined(second) == _joined(a)
            if spelled or (_begins(first, b) and _begins(second, a)):
                leads_to = first
        reached.add(leads_to)
    order = [b for b in dict.fromkeys(e for j in joints for e in ends[j.name]) if b not in reached]
    return (order or bodies)[0]


def _welded(joints: Iterable[JointTemplate], ends: Mapping[str, tuple[str, ...]], root: str) -> dict[str, str]:
    """Barrels and rods whose only joint is their slide → the frame they are welded to: the one beyond the frame that
    the cylinder's other half turns on, towards the root."""
    joints = tuple(joints)
    count: dict[str, int] = {}
    for pair in ends.values():
        for body in pair:
            count[body] = count.get(body, 0) + 1
    parents = _parents(joints, ends, root)
    welded: dict[str, str] = {}
    for slide in joints:
        if slide.type != "prismatic":
            continue
        for body, half in (ends[slide.name], ends[slide.name][::-1]):
            if count[body] != 1:
                continue
            frames = [
                b for j in joints if j.type != "prismatic" and half in ends[j.name] for b in ends[j.name] if b != half
            ]
            if frames and frames[0] in parents:
                welded[body] = parents[frames[0]]
    return welded


def _parents(joints: Iterable[JointTemplate], ends: Mapping[str, tuple[str, ...]], root: str) -> dict[str, str]:
    """Each body's neighbour towards the root, over every joint but slides."""
    parents: dict[str, str] = {}
    front = [root]
    while front:
        body = front.pop(0)
        for joint in joints:
            pair = ends[joint.name]
            if joint.type == "prismatic" or body not in pair:
                continue
            other = pair[1] if pair[0] == body else pair[0]
            if other != root and other not in parents:
                parents[other] = body
                front.append(other)
    return parents


def _through(welded: Mapping[str, str], pair: tuple[str, ...]) -> tuple[str, str]:
    return (welded.get(pair[0], pair[0]), welded.get(pair[1], pair[1]))


def _role(name: str, parent: str | None, *, rigid: bool) -> Role:
    words = _words_of(name)
    kind = next((kind for word, kind in _KINDS if word in words), "")
    side = next((w for w in reversed(words) if w in ("l", "r")), "")
    return Role(name, parent, rigid, kind=kind, side=side)
