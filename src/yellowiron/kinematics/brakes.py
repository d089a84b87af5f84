"""Parking brakes of the motors: what holds the machine, and what slews on it, on a slope. SI."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from yellowiron.kinematics.solver.chain import ClosedChain, State
from yellowiron.kinematics.solver.pose_grid import PoseGrid
from yellowiron.kinematics.strength import rated_load
from yellowiron.model.mechanism import GRAVITY, Joint, Mechanism, Site, hanging

SLOPE = math.radians(20.0)
"""The slope that brakes hold on, with the rated load: 36 %. ISO 10265 asks crawlers for 30 %, ISO 3450 others for 15 to
20 %."""
_SPARE = 1.25
"""… and so many times what that takes."""
_LEVEL = 0.9
"""Least part along y of a wheel's axis, and along z of a slewing one's."""
_POSES = 64
"""Poses, at most, that those of a further group of coupled actuators are combined with."""


def set_brakes(chain: ClosedChain, grids: Sequence[PoseGrid], joints: dict[str, Joint]) -> None:
    """Gives the velocity drives of pivots in `joints` their parking brakes, N·m.

    Motors of wheels and tracks share what holds the machine's weight and rated load on the slope, each by the radius of
    what it turns; one with a vertical axis holds what it slews in the pose that takes most.
    """
    motors = [
        joint
        for joint in joints.values()
        if joint.drive is not None and joint.drive.kind == "velocity" and joint.type == "revolute" and not joint.cut
    ]
    load = rated_load(chain.mechanism)
    weight = GRAVITY * (sum(b.mass for b in chain.mechanism.bodies) + (load[1] if load is not None else 0.0))
    travelling = [joint for joint in motors if abs(joint.axis[1]) > _LEVEL]
    for joint in travelling:
        torque = _SPARE * weight * math.sin(SLOPE) * _radius(chain.mechanism, joint) / len(travelling)
        joints[joint.name] = _braked(joint, torque)
    for joint in motors:
        if abs(joint.axis[2]) > _LEVEL and joint.name in chain.independent:
            arm = max(_moment(chain, pose, joint, load) for pose in _poses(chain, grids))
            joints[joint.name] = _braked(joint, _SPARE * GRAVITY * math.sin(SLOPE) * arm)


def _braked(joint: Joint, torque: float) -> Joint:
    assert joint.drive is not None
    return replace(joint, drive=replace(joint.drive, brake=torque))


def _radius(mechanism: Mechanism, joint: Joint) -> float:
    """Of the body that a joint turns, about its axis, metres."""
    body = mechanism.body(joint.body1)
    drawn = np.asarray(body.hull).reshape(-1, 3) - np.asarray(joint.anchor)
    across = np.linalg.norm(np.cross(drawn, np.asarray(joint.axis)), axis=1)
    return max([float(across.max(initial=0.0)), *(shape.radius for shape in body.shapes if shape.size is None)])


def _poses(chain: ClosedChain, grids: Sequence[PoseGrid]) -> list[State]:
    """The drawn pose, and the ends of all strokes with one another, as far as these are not too many."""
    poses = [chain.drawn]
    for component, grid in zip(chain.components(), grids, strict=True):
        ends = [grid.states[corner] for corner in grid.corners]
        poses += [chain.combined(end, component, pose) for pose in poses[:_POSES] for end in ends]
    return poses


def _moment(chain: ClosedChain, pose: State, joint: Joint, load: tuple[Site, float] | None) -> float:
    """Mass times distance from a vertical axis of all that the joint carries, and of the load on it, kg·m."""
    carried = hanging(chain.mechanism, [joint.body1])
    moved = chain.pose(pose)
    masses = [(b.name, b.mass, b.center_of_mass) for b in chain.mechanism.bodies if b.name in carried]
    if load is not None and load[0].body in carried:
        masses.append((load[0].body, load[1], load[0].position))
    arms = [mass * ((moved[name] @ [*at, 1.0])[:2] - np.asarray(joint.anchor)[:2]) for name, mass, at in masses]
    return float(np.linalg.norm(np.sum(arms, axis=0)))
