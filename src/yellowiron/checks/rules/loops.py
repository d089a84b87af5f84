"""Loops and freedom: what is closed can move, what is open is meant to, and axes are where the mechanism needs them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from yellowiron.checks.islands import Island, cylinders
from yellowiron.checks.loops import StageLoop
from yellowiron.checks.motion import LoopMotion
from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.tolerances import DEPENDENT, STILL
from yellowiron.checks.values import WORLD, StageBody, StageJoint, leaf
from yellowiron.checks.view import View
from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import angle_between_lines

_PARALLEL = math.radians(0.1)
_OFF_PINS = 3.0
"""Degrees."""
_OFF_WHEEL = math.radians(5.0)
_CENTRED = 0.1
"""Of a wheel's radius: its hinge passes this close to its middle."""
_BALANCED = 0.02
"""Of the size of what hangs on a hinge: with its centre of mass this close to the axis it does not swing."""


def _skewed(island: Island) -> list[tuple[StageJoint, float]]:
    """Hinges and slides of planar loops that are out of plane and cannot move, with the angle (rad)."""
    motion = island.motion
    if motion is None:
        return []
    out = [pair for loop in island.loops for pair in _out_of_plane(loop, island)]
    return list({joint.path: (joint, angle) for joint, angle in out if not motion.moves(joint)}.values())


def _out_of_plane(loop: StageLoop, island: Island) -> list[tuple[StageJoint, float]]:
    """The few hinges and slides of a planar loop that are out of its plane, with the angle (rad)."""
    hinges = [j for j in loop.joints if j.type == "revolute"]
    if len(loop.joints) < 4 or len(hinges) < 2:
        return []
    near = _with_neighbours(loop, island)
    normal = max((j.axis for j in hinges), key=lambda d: sum(_tilt(j, d) < _PARALLEL for j in near))
    off = [(j, _tilt(j, normal)) for j in loop.joints if j.type in ("revolute", "prismatic")]
    out = [(j, angle) for j, angle in off if angle > _PARALLEL]
    return out if len(out) * 2 <= len(off) else []


def _with_neighbours(loop: StageLoop, island: Island) -> list[StageJoint]:
    """The joints of a loop and of those that share one with it."""
    paths = {j.path for j in loop.joints}
    near = [o for o in island.loops if paths.intersection(j.path for j in o.joints)]
    return list({j.path: j for o in near for j in o.joints}.values())


def _tilt(joint: StageJoint, normal: Floats) -> float:
    """How far a hinge is from parallel, or a slide from square, to a plane's normal; π/2 for other joints."""
    if joint.type == "revolute":
        return angle_between_lines(joint.axis, normal)
    return math.pi / 2.0 - angle_between_lines(joint.axis, normal) if joint.type == "prismatic" else math.pi / 2.0


@rule(
    "CHK090",
    "error",
    "A pivot is missing or an axis is wrong: count the loop's joints, and compare their axes.",
)
def locked(view: View) -> Remarks:
    """A driven joint is locked by its loop."""
    for island in view.islands:
        if island.motion is None or _skewed(island):
            continue
        for joint in _of_loops(island):
            if joint.driven and not island.motion.moves(joint):
                yield joint.path, "Its loop does not let it move."


@rule(
    "CHK091",
    "warning",
    "A pivot is missing or an axis is wrong; if it is meant to hold still, make it a fixed joint.",
)
def still(view: View) -> Remarks:
    """A joint of a loop cannot move, nor is it a pivot of a cylinder beside the slide of two sections."""
    for island in view.islands:
        motion = island.motion
        if motion is None or _skewed(island):
            continue
        joints = [j for j in _of_loops(island) if j.type in ("revolute", "prismatic")]
        if any(j.driven and not motion.moves(j) for j in joints):
            continue
        for joint in joints:
            if not motion.moves(joint) and not any(_straight(loop, motion.moves) for loop in _around(island, joint)):
                yield joint.path, "Its loop does not let it move."


def _around(island: Island, joint: StageJoint) -> list[StageLoop]:
    return [loop for loop in island.loops if joint in loop.joints]


def _straight(loop: StageLoop, moves: Callable[[StageJoint], bool]) -> bool:
    """Whether slides side by side are all that moves in a loop, as a telescope's sections and the cylinder in them: the
    pivots of that stand still."""
    moving = [j for j in loop.joints if j.freedoms and moves(j)]
    if len(moving) < 2 or any(j.type != "prismatic" for j in moving):
        return False
    return all(angle_between_lines(moving[0].axis, j.axis) < _PARALLEL for j in moving)


@rule(
    "CHK092",
    "error",
    "Turn both its frames: a loop moves only when its hinges are parallel and its slides square to them.",
)
def skewed(view: View) -> Remarks:
    """An axis is out of its loop's plane."""
    for island in view.islands:
        for joint, angle in _skewed(island):
            other = "parallel to" if joint.type == "revolute" else "square to"
            yield (
                joint.path,
                f"Its axis is {math.degrees(angle):.4g}° from {other} the other hinges of its loop, which locks it.",
            )


def _of_loops(island: Island) -> list[StageJoint]:
    return [j for j in island.joints if j.path in island.in_loops and j.freedoms]


@rule(
    "CHK093",
    "warning",
    "A pin of its loop is missing, or a drive. A joint that is meant to be loose needs no change.",
)
def unheld(view: View) -> Remarks:
    """A body moves with nothing to hold it."""
    for island in view.islands:
        if not any(j.driven for j in island.joints):
            continue
        joints = [j for j in _open(island) if not j.record.get("free")]
        for group in _adjacent([*joints, *(j for j in _undetermined(island) if j not in joints)]):
            names = ", ".join(j.name for j in group[:5])
            yield group[0].path, f"With every drive at rest these still move: {names}{' …' if len(group) > 5 else ''}."


def _open(island: Island) -> Iterator[StageJoint]:
    """Joints outside any loop that nothing drives or holds and that do not stay where they are by balance."""
    for joint in island.joints:
        if joint.path in island.in_loops or joint.cut or joint.driven or joint.held or WORLD in joint.bodies:
            continue
        if joint.type not in ("revolute", "prismatic", "spherical") or joint.lower == joint.upper is not None:
            continue
        if joint.type != "revolute" or not _balanced(joint, island.beyond(joint)):
            yield joint


def _balanced(joint: StageJoint, beyond: tuple[StageBody, ...]) -> bool:
    """Whether what a hinge carries has its centre of mass on the axis, like a wheel; unknown masses are given that."""
    if not beyond or any(b.center_of_mass is None or not b.mass for b in beyond):
        return True
    masses = np.array([b.mass for b in beyond])
    center = masses @ np.array([b.center_of_mass for b in beyond]) / masses.sum()
    arm = np.cross(joint.axis, center - joint.sides[0].position)
    boxes = [b.bounds for b in beyond if b.bounds is not None]
    size = max((float(np.linalg.norm(b[1] - b[0])) for b in boxes), default=0.0)
    return bool(np.linalg.norm(arm) <= _BALANCED * size)


def _undetermined(island: Island) -> list[StageJoint]:
    """Hinges and slides of loops that still move with every driven one held."""
    motion = island.motion
    if motion is None or not motion.space.size:
        return []
    joints = _of_loops(island)
    holding = [j for j in joints if j.driven or j.held or j.record.get("free")]
    rest = motion.holding(holding)
    return [j for j in joints if j.type in ("revolute", "prismatic") and j not in holding and rest.moves(j)]


def _adjacent(joints: list[StageJoint]) -> list[list[StageJoint]]:
    """Joints in groups that share bodies."""
    groups: list[list[StageJoint]] = []
    for joint in joints:
        touching = [g for g in groups if any(set(joint.bodies).intersection(o.bodies) - {WORLD} for o in g)]
        merged = [*(j for g in touching for j in g), joint]
        groups = [g for g in groups if g not in touching] + [merged]
    return groups


@rule(
    "CHK094",
    "warning",
    "Of twin cylinders drive one at twice the force, the other not at all. Elsewhere a pivot of the loop is missing.",
)
def fighting(view: View) -> Remarks:
    """Drives hold each other."""
    for island in view.islands:
        motion = island.motion
        if motion is None or _skewed(island):
            continue
        driven = [j for j in _of_loops(island) if j.driven and j.type in ("revolute", "prismatic")]
        moving = [j for j in driven if motion.moves(j)]
        free = motion.rank(moving)
        if moving and free < len(moving):
            names = ", ".join(j.name for j in _dependent(motion, moving))
            yield (
                _dependent(motion, moving)[-1].path,
                f"{names} are driven, and their loops leave them fewer freedoms than drives.",
            )


def _dependent(motion: LoopMotion, joints: list[StageJoint]) -> list[StageJoint]:
    """The joints whose motions depend on each other's."""
    rows = motion.part(joints)
    left, values, _ = np.linalg.svd(rows)
    lost = left[:, int((values > DEPENDENT).sum()) :]
    return [j for j, share in zip(joints, np.abs(lost).max(axis=1, initial=0.0), strict=True) if share > STILL]


@rule(
    "CHK095",
    "warning",
    "Turn the slide's frames: barrel and rod move on the line between their eyes.",
)
def off_pins(view: View) -> Remarks:
    """A cylinder does not point along its pins."""
    for island in view.islands:
        for slide, before, after in cylinders(island):
            line = after.sides[0].position - before.sides[0].position
            axis = slide.axis
            hinge = next((p.axis for p in (before, after) if p.type == "revolute"), None)
            if hinge is not None:
                line, axis = line - (line @ hinge) * hinge, axis - (axis @ hinge) * hinge
            if np.linalg.norm(line) < 1e-3 * island.size or np.linalg.norm(axis) < 0.1:
                continue
            angle = math.degrees(angle_between_lines(axis, line))
            if angle > _OFF_PINS:
                yield slide.path, f"It slides {angle:.4g}° off the line between {before.name} and {after.name}."


@rule(
    "CHK096",
    "warning",
    "Turn both frames of the hinge to the wheel's axis.",
)
def off_wheel(view: View) -> Remarks:
    """A wheel turns about another axis than its own."""
    for island in view.islands:
        for joint in island.joints:
            if joint.type != "revolute" or joint.path in island.in_loops:
                continue
            for path in joint.bodies:
                for center, radius, axis in _discs(view, path):
                    near = float(np.linalg.norm(center - joint.sides[0].position)) < _CENTRED * radius
                    angle = angle_between_lines(axis, joint.axis)
                    if near and angle > _OFF_WHEEL:
                        yield (
                            joint.path,
                            f"It turns {leaf(path)} about an axis {math.degrees(angle):.4g}° off its own.",
                        )
                        break


def _discs(view: View, path: str) -> Iterator[tuple[Floats, float, Floats]]:
    """Centre, radius and axis of the wheels a body may be: its flat cylinders, and its inertia where it is a disc's."""
    body = view.bodies.get(path)
    if body is None:
        return
    for collider in view.colliders:
        flat = collider.shape == "Cylinder" and collider.height < 2.0 * collider.radius
        if collider.body == path and flat and collider.bounds is not None and collider.axis is not None:
            yield collider.bounds.mean(axis=0), collider.radius, collider.axis
    if body.disc_axis is not None and body.center_of_mass is not None and body.bounds is not None:
        yield body.center_of_mass, 0.5 * float((body.bounds[1] - body.bounds[0]).max()), body.disc_axis
