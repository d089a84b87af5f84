"""A machine that yellowiron built, against what its build recorded in the file (`customData`, key `yellowiron`)."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from yellowiron.checks.islands import Island
from yellowiron.checks.loops import KINDS
from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.tolerances import FRAMES_APART
from yellowiron.checks.values import WORLD, StageDrive, StageJoint, direction
from yellowiron.checks.view import View
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Follows, by_first_leader
from yellowiron.support.record import BRAKE_GIVES
from yellowiron.support.text import with_article
from yellowiron.support.vectors import angle_between

_TURNED = math.radians(0.01)
_EDITED = 1e-4
"""Relative: what is written in single precision differs by less."""


def _document(view: View, name: str) -> Any:
    """One of the machine's JSON texts, or nothing where it is absent or damaged."""
    try:
        return json.loads(view.record.get(name, ""))
    except (json.JSONDecodeError, TypeError):
        return None


def _entries(view: View, name: str) -> list[Mapping[str, Any]]:
    found = _document(view, name)
    return [e for e in found if isinstance(e, dict)] if isinstance(found, list) else []


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _number(value: Any) -> float | None:
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else None


def _vector(value: Any) -> Floats | None:
    """A recorded vector (3,), or None where it is none."""
    try:
        found = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        return None
    return found if found.shape == (3,) and np.isfinite(found).all() else None


def _recorded(view: View) -> Iterator[tuple[StageJoint, Mapping[str, Any]]]:
    for joint in view.joints:
        if joint.record.get("kind") == "joint":
            yield joint, joint.record


@rule(
    "CHK120",
    "error",
    "Build again, or put the joint back: its loop is open.",
)
def gone(view: View) -> Remarks:
    """A joint that the build made is gone."""
    if not view.bodies:  # Physics=off: CHK027
        return
    there = {str(j.record.get("name")) for j in view.joints if j.enabled}
    for name in dict.fromkeys(_named_joints(view)):
        if name not in there:
            yield view.machine, f"The build recorded the joint '{name}', and it is not there or is switched off."


def _named_joints(view: View) -> Iterator[str]:
    """The joints that the record's loops, cylinders and actuators name."""
    for loop in _entries(view, "loops"):
        yield from (str(j) for j in _list(loop.get("joints")))
    for cylinder in _entries(view, "cylinders"):
        yield from (str(cylinder[k]) for k in ("slide", "barrel_joint", "rod_joint") if cylinder.get(k))
    for actuator in _entries(view, "actuators"):
        moved = (j.get("joint") for j in _list(actuator.get("joints")) if isinstance(j, dict))
        yield from (str(j) for j in moved if j)


@rule(
    "CHK121",
    "error",
    "Build again, or give it its type and bodies back.",
)
def changed(view: View) -> Remarks:
    """A joint is another one than the build made."""
    names = {p: str(b.record.get("name")) for p, b in view.bodies.items() if "name" in b.record}
    for joint, record in _recorded(view):
        kind = str(record.get("type"))
        closing = record.get("cut") and kind == "revolute"
        if joint.type != kind and not (closing and joint.type == "spherical"):
            yield joint.path, f"It is {joint.type}, and was built as {kind}."
        # The joints of a ring of shoes are excluded from the articulation too, and no cuts.
        if bool(record.get("cut") or record.get("floating")) != joint.cut:
            yield joint.path, f"It is {'cut' if joint.cut else 'not cut'}, and was built the other way."
        if "body0" in record:
            built = (str(record.get("body0")), str(record.get("body1")))
            said = _other_bodies(built, tuple(names.get(b, "") for b in joint.bodies))
            if said:
                yield joint.path, said


def _other_bodies(built: tuple[str, ...], found: tuple[str, ...]) -> str:
    """What there is to say of the bodies that a joint joins, by their names; "" where they are those of the build."""
    lost = [name for name, there in zip(built, found, strict=True) if not there]
    if lost:
        return f"It joins {built[0]} and {built[1]}, and {lost[0]} is no rigid body any more."
    if found != built:
        return f"It joins {found[0]} and {found[1]}, and was built to join {built[0]} and {built[1]}."
    return ""


@rule(
    "CHK122",
    "error",
    "Build again, or move its frames back: the record says where the CAD model has the pin.",
)
def moved(view: View) -> Remarks:
    """A joint is not on the pin that the build found."""
    for joint, record in _recorded(view):
        where, along = _vector(record.get("anchor")), _vector(record.get("axis"))
        if where is None or along is None:
            continue
        anchor = view.frame[:3, :3] @ where + view.frame[:3, 3]
        axis = view.frame[:3, :3] @ along
        for end, side in enumerate(joint.sides):
            if side.missing or not np.isfinite(side.position).all() or not np.isfinite(side.rotation).all():
                continue
            distance = float(np.linalg.norm(side.position - anchor))
            found = direction(side.rotation, joint.freedoms[0]) if len(joint.freedoms) == 1 else side.rotation[:, 0]
            angle = angle_between(found, axis)
            if distance > FRAMES_APART * max(1.0, float(np.abs(anchor).max()) / 10.0):
                yield joint.path, f"Its frame on body{end} is {1e3 * distance:.4g} mm from there."
            elif angle > _TURNED and joint.type != "fixed":
                yield joint.path, f"Its axis on body{end} is {math.degrees(angle):.4g}° off."
            elif joint.type == "revolute" and end and abs(joint.coordinate) > _TURNED:
                yield joint.path, f"Its frames are turned {math.degrees(joint.coordinate):.4g}° about its axis."


@rule(
    "CHK123",
    "warning",
    "Nothing to do if they were edited on purpose; the record says where the built ones came from.",
)
def edited_limits(view: View) -> Remarks:
    """A joint's limits are not those of the build."""
    for joint, record in _recorded(view):
        if joint.type not in ("revolute", "prismatic"):
            continue
        for name, value in (("lower", joint.lower), ("upper", joint.upper)):
            built = _number(record.get(name))
            if not _same(value, built):
                yield joint.path, f"Its {name} limit is {_say(value)}, and was built as {_say(built)} (m or rad)."


@rule(
    "CHK124",
    "warning",
    "Nothing to do if it was edited on purpose; the record says where the built one came from.",
)
def edited_drive(view: View) -> Remarks:
    """A joint's drive is not that of the build."""
    for joint, record in _recorded(view):
        if joint.cut:
            continue
        try:
            sprung = json.loads(record.get("spring", "null"))
            built = json.loads(record.get("drive", "null")) if sprung is None else {"kind": "position", **sprung}
        except (json.JSONDecodeError, TypeError):
            continue
        if (built is None) != (not joint.drives):
            yield (
                joint.path,
                f"It {'has' if joint.drives else 'has no'} drive, and was built {'with' if built else 'without'} one.",
            )
        elif isinstance(built, dict):
            drive = joint.drives[0]
            if _braked(drive, _number(built.get("brake"))):
                continue
            pairs = {
                "stiffness": (drive.stiffness, built.get("stiffness") if built.get("kind") == "position" else 0.0),
                "damping": (drive.damping, built.get("damping")),
                "maxForce": (drive.max_force, _strongest(built)),
            }
            for name, (value, before) in pairs.items():
                given = _number(before)
                if given is not None and not _same(value, given):
                    yield joint.path, f"Its {name} is {value:.5g}, and was built as {given:.5g} (SI)."


def _braked(drive: StageDrive, brake: float | None) -> bool:
    """Whether a drive is what the variant of set brakes makes of it: a spring as strong as its brake."""
    return bool(brake) and _same(drive.max_force, brake) and _same(drive.stiffness, (brake or 0.0) / BRAKE_GIVES)


def _strongest(built: dict[str, Any]) -> Any:
    """The attribute limits both ways: it is the stronger one's."""
    forces = [_number(built.get(name)) for name in ("max_force", "reverse_force")]
    known = [force for force in forces if force is not None]
    return max(known) if forces[0] is not None else None


@rule(
    "CHK125",
    "warning",
    "Nothing to do if it was edited on purpose; otherwise build again.",
)
def edited_mass(view: View) -> Remarks:
    """A body's mass is not that of the build."""
    for body in view.bodies.values():
        built = _number(body.record.get("mass"))
        if built is not None and not _same(body.mass, built):
            yield body.path, f"It is {_say(body.mass)} kg, and was built as {built:.5g} kg."


@rule(
    "CHK126",
    "error",
    "A joint is missing, added or turned: see the other findings, or build again.",
)
def mobility(view: View) -> Remarks:
    """The machine moves in more or fewer ways than the build found."""
    built = _document(view, "mobility")
    if not view.bodies or not isinstance(built, dict) or not isinstance(built.get("computed"), int):
        return
    own = [i for i in view.islands if any(b.path.startswith(f"{view.machine}/") for b in i.bodies)]
    freedoms = sum(_freedoms(island) for island in own if not island.floating)
    # One that follows another moves in no way of its own.
    freedoms -= sum(bool(j.leader) for island in own for j in island.joints if not j.cut)
    if freedoms != built["computed"]:
        yield view.machine, f"It moves in {freedoms} way(s), and was built to move in {built['computed']}."


@rule(
    "CHK127",
    "warning",
    "Nothing to do if it was edited on purpose; otherwise build again.",
)
def edited_leader(view: View) -> Remarks:
    """A joint does not follow what the build made it follow."""
    names = {j.path: str(j.record.get("name")) for j in view.joints}
    built = dict(_recorded_follows(view))
    for joint, record in _recorded(view):
        name = str(record.get("name"))
        # A file names the first leader of a chain.
        before = by_first_leader(name, built) if name in built else None
        now = names.get(joint.leader or "", "")
        if now != (before.joint if before is not None else ""):
            what = f"'{now}'" if now else "no joint"
            was = f"'{before.joint}'" if before is not None else "no joint"
            yield joint.path, f"It follows {what}, and was built to follow {was}."
        elif before is not None:
            for word, value, given in (("ratio", joint.ratio, before.ratio), ("offset", joint.offset, before.offset)):
                if not _same(value, given):
                    yield (
                        joint.path,
                        f"It follows with {with_article(word)} of {value:.5g}, and was built with {given:.5g} (SI).",
                    )


def _recorded_follows(view: View) -> Iterator[tuple[str, Follows]]:
    """Joint → what the build made it follow; damaged records are passed over."""
    for _, record in _recorded(view):
        try:
            said = json.loads(record.get("follows", "null"))
            if isinstance(said, dict):
                yield str(record.get("name")), Follows(str(said["joint"]), float(said["ratio"]), float(said["offset"]))
        except (json.JSONDecodeError, TypeError, KeyError, ValueError):
            continue


def _freedoms(island: Island) -> int:
    """In how many ways the joints of an island move, its base held; 0 where a frame is not a number."""
    if island.motion is None:
        return 0
    tree = [j for j in island.joints if j.path not in island.in_loops and j.type in KINDS]
    loose = [j for j in tree if WORLD not in j.bodies]
    one_way = [j for j in island.joints if j.type in ("revolute", "prismatic")]
    return sum(len(j.freedoms) for j in loose) + island.motion.rank(one_way)


def _same(value: float | None, built: float | None) -> bool:
    if value is None or built is None:
        return value is None and built is None
    return abs(value - built) <= _EDITED * max(abs(built), 1e-3)


def _say(value: float | None) -> str:
    return "none" if value is None else f"{value:.5g}"
