"""What a machine does that steers by its two sides' speeds, on tracks or tyres: it turns on the spot, and its slewing
body swings."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from yellowiron.kinematics import ClosedChain
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import GRAVITY, Mechanism, scrubbing
from yellowiron.simulation.commands import motions
from yellowiron.simulation.driving.sliding import center_of_mass, least_sliding, standing
from yellowiron.simulation.driving.wheel import GroundWheel
from yellowiron.simulation.engine import Engine, poses, tell
from yellowiron.simulation.ground import GROUND_FRICTION, UPRIGHT
from yellowiron.simulation.loads import SPARE, paces

DISTANCE, SPIN, SWING = 2.0, math.radians(45.0), math.radians(90.0)
"""What it does, at the speeds of its motors: metres forward and back, radians on the spot and of its slewing body."""
_UP = np.array([0.0, 0.0, 1.0])
_EASY = 0.1
"""Share of the speed gained otherwise, of a machine on tyres."""
_RAMP = 1.0
_REST = 1.0


def spin(
    engine: Engine,
    chain: ClosedChain,
    mechanism: Mechanism,
    both: Sequence[Sequence[GroundWheel]],
    top: float,
    timestep: float,
) -> dict[str, float]:
    """The two sides against each other at up to `top` (m/s): how far the root turned to the left, and how far it should
    have, radians.

    It gains speed as fast as `SPARE` of what motors and ground give can turn the machine as drawn. Tyres behind each
    other cannot all roll: what turns the machine is what their sliding across leaves, so that it gains speed ten times
    as slowly, and by dry friction under the weight that each bears it should turn by what `least_sliding` has for as
    far as they did roll.
    """
    left, right = both
    every, tyres = (*left, *right), bool(scrubbing(mechanism))
    half = 0.5 * float(np.mean([w.middle[1] for w in left]) - np.mean([w.middle[1] for w in right]))
    limit = (_EASY if tyres else 1.0) * SPARE * _push(mechanism, every) * half / _inertia(mechanism)
    root = [body.name for body in mechanism.bodies].index(mechanism.root)
    rims = {w.joint.name: sign * w.sign / w.radius for side, sign in ((left, -1.0), (right, 1.0)) for w in side}
    turned, rolled = 0.0, np.zeros(len(every))
    angles = _angles(engine, every, root)
    for speed in (*course(SPIN, top / half, limit, timestep).tolist(), *_rest(timestep)):
        turned += _turned(engine, {joint: rim * speed * half for joint, rim in rims.items()}, root)
        before, angles = angles, _angles(engine, every, root)
        rolled += (angles - before + math.pi) % (2.0 * math.pi) - math.pi
    if not tyres:
        return {"spin": turned, "spin_geometry": SPIN}
    middles, axes = np.array([w.middle[:2] for w in every]), np.array([w.axis[:2] for w in every])
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    under = standing(every, middles, axes, center_of_mass(chain, mechanism, chain.drawn)[:2])
    ways = rolled * [w.sign * w.radius for w in every]
    return {"spin": turned, "spin_geometry": float(least_sliding(under, ways)[2])}


def _angles(engine: Engine, found: Sequence[GroundWheel], root: int) -> Floats:
    """How far each wheel is turned about its axle on the root, radians within a turn."""
    rotations = poses(engine)[0]
    angles = []
    for wheel in found:
        spoke = np.cross(wheel.axis, _UP)
        turned = rotations[root].T @ rotations[wheel.body] @ spoke
        angles.append(math.atan2(float(np.cross(spoke, turned) @ wheel.axis), float(spoke @ turned)))
    return np.array(angles)


def swing(
    engine: Engine, chain: ClosedChain, mechanism: Mechanism, found: Sequence[GroundWheel], timestep: float
) -> dict[str, float]:
    """The body that a motor turns about the vertical, to the left; nothing where there is none."""
    driving = {w.joint.name for w in found}
    for motion in motions(mechanism):
        joint = mechanism.joint(motion.joint)
        if motion.position or motion.joint in driving or abs(joint.axis[2]) < UPRIGHT:
            continue
        limit = float(paces(chain, (motion,))[motion.joint].limits.min())
        body, left = [b.name for b in mechanism.bodies].index(joint.body1), math.copysign(1.0, joint.axis[2])
        turned = 0.0
        for speed in (*course(SWING, motion.speed, limit, timestep).tolist(), *_rest(timestep)):
            turned += _turned(engine, {motion.joint: left * speed}, body)
        return {"swing": turned, "swing_geometry": SWING}
    return {}


def course(amount: float, speed: float, limit: float, timestep: float) -> Floats:
    """Speeds (n,), one a step, that together go by `amount`, from rest to rest, at no more than `speed` and gaining it
    no faster than `limit`, nor in less than a second."""
    limit = min(limit, speed / _RAMP)
    top = min(speed, math.sqrt(amount * limit))
    ramp, time = top / limit, amount / top + top / limit
    now = (np.arange(math.ceil(time / timestep)) + 0.5) * timestep
    speeds = top * np.clip(np.minimum(now, time - now) / ramp, 0.0, 1.0)
    return np.asarray(speeds * amount / (speeds.sum() * timestep))


def _rest(timestep: float) -> list[float]:
    return [0.0] * round(_REST / timestep)


def _turned(engine: Engine, targets: Mapping[str, float], body: int) -> float:
    """One step; by how much a body's heading turned to the left."""
    before = poses(engine)[0][body]
    tell(engine, targets)
    engine.step()
    across = poses(engine)[0][body] @ before.T
    return math.atan2(across[1, 0], across[0, 0])


def _push(mechanism: Mechanism, found: Sequence[GroundWheel]) -> float:
    """Newtons with which the wheels together can push: their motors', at most the ground's friction."""
    forces = [w.joint.drive.max_force / w.radius for w in found if w.joint.drive is not None]
    return min(sum(forces), GROUND_FRICTION * GRAVITY * sum(body.mass for body in mechanism.bodies))


def _inertia(mechanism: Mechanism) -> float:
    """kg·m² of the machine as drawn about the vertical through its root's origin."""
    origin, total = np.asarray(mechanism.body(mechanism.root).origin), 0.0
    for body in mechanism.bodies:
        arm = (np.asarray(body.center_of_mass) - origin)[:2]
        total += float(np.asarray(body.inertia)[2, 2]) + body.mass * float(arm @ arm)
    return total
