"""A file held against the machine that it was written from: that its joints let every body be where the kinematics
has it, over the strokes, that their limits do, and that each body weighs what the machine's does, where it does.

What holds in every pose joint by joint holds of the whole: the file can stand as the machine does, and each joint's
coordinate there follows from the bodies on both its sides.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from yellowiron.checks.values import StageJoint
from yellowiron.checks.view import View
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Joint, Mechanism, chained

PLACE = 1e-6
"""Metres, a metre from the joint: the bar of every export's poses."""
_MASS = 1e-6
"""Of a mass; of a moment of inertia 1e-5."""
_AGAIN = "Write the file again from the machine."


@dataclass(frozen=True, eq=False)
class Posed:
    """A pose of the machine: `strokes` by driven joint, and for each body its displacement (4, 4) from the drawn pose,
    in the machine frame."""

    strokes: Mapping[str, float]
    bodies: Mapping[str, Floats]


@dataclass(frozen=True, eq=False)
class _Miss:
    """By how much a joint misses (m, or past a limit m or rad), and in which pose."""

    by: float
    pose: Posed


def compare(view: View, mechanism: Mechanism, poses: Sequence[Posed]) -> tuple[Finding, ...]:
    """The findings of a file against its machine, and last how far they agree.

    `view`: a file of one of the formats that `export` writes. `poses`: of the machine, over its strokes. A distance
    that has a driven slide's name stands for its cylinder.
    """
    bodies = _bodies(view, mechanism)
    joints = [j for j in view.joints if j.enabled and all(end in bodies or not end for end in j.bodies)]
    worst, findings = 0.0, [*_missing(mechanism, bodies), *_masses(view, mechanism, bodies)]
    for joint in joints:
        off, past = _misses(joint, bodies, poses)
        worst = max(worst, off.by if off is not None else 0.0)
        findings += _told(joint, off, past)
    findings += _open(mechanism, joints, bodies)
    words = (
        f"Over {len(poses)} poses of its strokes the joints hold the bodies within "
        f"{worst * 1e6:.2g} µm of where the kinematics has them."
    )
    if not any(f.severity == "error" for f in findings):
        findings.append(Finding(code="EXP006", severity="info", where=view.name, message=words, hint=""))
    return tuple(findings)


def _folded(name: str) -> str:
    return re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")


def _bodies(view: View, mechanism: Mechanism) -> dict[str, str]:
    """Link → body of the machine, by name; what is fixed to one and is none itself (the half of a pin) goes with it."""
    ours = {_folded(body.name): body.name for body in mechanism.bodies}
    found = {path: ours[_folded(path)] for path in view.bodies if _folded(path) in ours}
    for joint in view.joints:
        for one, other in (joint.bodies, joint.bodies[::-1]) if joint.type == "fixed" else ():
            if one in view.bodies and one not in found and other in found:
                found[one] = found[other]
    return found


def _missing(mechanism: Mechanism, bodies: Mapping[str, str]) -> Iterator[Finding]:
    there = set(bodies.values())
    for body in mechanism.bodies:
        if body.name not in there:
            yield _found("EXP001", body.name, "The file has no link of this body.")


def _masses(view: View, mechanism: Mechanism, bodies: Mapping[str, str]) -> Iterator[Finding]:
    for path, name in bodies.items():
        if _folded(path) != _folded(name):
            continue
        read, body = view.bodies[path], mechanism.body(name)
        moments = np.linalg.eigvalsh(0.5 * (np.asarray(body.inertia) + np.asarray(body.inertia).T))
        if read.mass is None or abs(read.mass - body.mass) > _MASS * body.mass:
            yield _found("EXP004", path, f"It weighs {read.mass or 0.0:g} kg, the body {body.mass:g} kg.")
        elif read.center_of_mass is not None and _apart(read.center_of_mass, body.center_of_mass) > PLACE:
            away = 1e3 * _apart(read.center_of_mass, body.center_of_mass)
            yield _found("EXP004", path, f"Its centre of mass is {away:.3g} mm from the body's.")
        elif read.inertia is not None and np.abs(read.inertia - moments).max() > 1e-5 * moments.max():
            yield _found("EXP004", path, "Its moments of inertia are not the body's.")


def _apart(one: Floats, other: Iterable[float]) -> float:
    return float(np.linalg.norm(one - np.asarray(other)))


def _misses(joint: StageJoint, bodies: Mapping[str, str], poses: Sequence[Posed]) -> tuple[_Miss | None, _Miss | None]:
    """Where a joint misses its bodies' places by most, and where its limits are passed by most; None where never."""
    off: _Miss | None = None
    past: _Miss | None = None
    for pose in poses:
        moved = [pose.bodies[bodies[end]] if end else np.eye(4) for end in joint.bodies]
        missed, coordinate = _between(joint, moved[0], moved[1])
        if joint.type == "distance" and coordinate is not None:
            missed = abs(coordinate - pose.strokes.get(joint.path, coordinate))
        if off is None or missed > off.by:
            off = _Miss(missed, pose)
        if coordinate is not None:
            low, high = joint.lower, joint.upper
            if joint.type == "revolute" and low is not None and high is not None:
                # An angle is known up to a turn, and a limit may lie past half of one.
                middle = 0.5 * (low + high)
                coordinate = middle + math.remainder(coordinate - middle, math.tau)
            beyond = max(
                low - coordinate if low is not None else -math.inf, coordinate - high if high is not None else -math.inf
            )
            if beyond > PLACE and (past is None or beyond > past.by):
                past = _Miss(beyond, pose)
    return off, past


def _between(joint: StageJoint, first: Floats, second: Floats) -> tuple[float, float | None]:
    """How far (m, over points a metre from the joint) a joint is from letting its sides be displaced so (4, 4), and its
    coordinate there."""
    ends = [
        (m[:3, :3] @ s.position + m[:3, 3], m[:3, :3] @ s.rotation)
        for m, s in zip((first, second), joint.sides, strict=True)
    ]
    gap = ends[1][0] - ends[0][0]
    turn = Rotation.from_matrix(ends[0][1].T @ ends[1][1]).as_rotvec()
    if joint.type == "spherical":
        return float(np.linalg.norm(gap)), None
    if joint.type == "revolute":
        about = float(Rotation.from_matrix(ends[0][1].T @ ends[1][1]).as_euler("xyz")[0])
        return float(np.linalg.norm(gap) + np.linalg.norm(ends[1][1][:, 0] - ends[0][1][:, 0])), about
    if joint.type == "prismatic":
        along = float(gap @ ends[0][1][:, 0])
        return float(np.linalg.norm(gap - along * ends[0][1][:, 0]) + np.linalg.norm(turn)), along
    if joint.type == "fixed":
        return float(np.linalg.norm(gap) + np.linalg.norm(turn)), None
    if joint.type == "distance":
        return 0.0, float(np.linalg.norm(gap) - np.linalg.norm(joint.sides[1].position - joint.sides[0].position))
    return 0.0, None


def _told(joint: StageJoint, off: _Miss | None, past: _Miss | None) -> Iterator[Finding]:
    if off is not None and off.by > PLACE:
        at = _strokes(off.pose)
        yield _found("EXP002", joint.path, f"It misses its bodies' places by {1e3 * off.by:.3g} mm {at}.")
    if past is not None:
        shown = f"{1e3 * past.by:.3g} mm" if joint.type == "prismatic" else f"{math.degrees(past.by):.3g}°"
        yield _found("EXP003", joint.path, f"Its limits stop the machine {shown} early {_strokes(past.pose)}.")


def _strokes(pose: Posed) -> str:
    moved = ", ".join(f"{name} {value:.4g}" for name, value in pose.strokes.items() if abs(value) > 1e-9)
    return f"({moved})" if moved else "(as drawn)"


def _open(mechanism: Mechanism, joints: Sequence[StageJoint], bodies: Mapping[str, str]) -> Iterator[Finding]:
    """Of the machine's joints those that nothing in the file stands for."""
    absent = chained(mechanism) | {body.name for body in mechanism.bodies} - set(bodies.values())
    held = {frozenset(bodies.get(end, "") for end in joint.bodies) for joint in joints}
    left = [j for j in mechanism.joints if j.body0 not in absent and j.body1 not in absent and j.type != "distance"]
    gone = [j for j in left if frozenset((j.body0, j.body1)) not in held]
    if cuts := _named(j for j in gone if j.cut):
        yield Finding(
            code="EXP005", severity="info", where="joints",
            message=f"These pins of its loops are open here: {cuts}.",
            hint="URDF has no loops: keep joints.json beside the file, and let joint_states.py close them.",
        )  # fmt: skip
    for joint in gone:
        if not joint.cut:
            yield _found("EXP001", joint.name, "The file has no joint between its two bodies.")


def _named(joints: Iterable[Joint]) -> str:
    return ", ".join(joint.name for joint in joints)


def _found(code: str, where: str, message: str) -> Finding:
    return Finding(code=code, severity="error", where=where, message=message, hint=_AGAIN)
