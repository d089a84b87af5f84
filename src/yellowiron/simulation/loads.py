"""What a drive has to do: the weight and the mass that it feels through the linkage. SI."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from yellowiron.kinematics import ClosedChain, weight
from yellowiron.model.geometry import Floats
from yellowiron.simulation.commands import Motion, Pace, sampled

SPARE = 0.8
"""Share of a drive's force, less the weight it holds, that the targets' acceleration may ask for."""
_POINTS = 13


def carried(
    chain: ClosedChain, moves: Sequence[Motion], targets: Mapping[str, Floats], timestep: float
) -> dict[str, Floats]:
    """The targets, and what a drive must be told so that its slide goes there with the machine's weight on it.

    A position drive is a spring: it holds a weight only some way short of its target, so it is sent that much further,
    as an operator does, but never past its joint's limits. Cylinders that no target is given for hold the drawn pose.
    Weights are those of the target pose, at the steps of `sampled`.
    """
    count = max((len(values) for values in targets.values()), default=0)
    told = dict(targets)
    held = [motion for motion in moves if motion.position]
    if not held or not count:
        return told
    wanted = {m.joint: targets.get(m.joint, np.zeros(count)) for m in held}
    steps = sampled(count, timestep)
    states = chain.sweep({joint: values[steps] for joint, values in wanted.items()})
    joints = [chain.mechanism.joint(motion.joint) for motion in held]
    soft = [(j, j.drive.stiffness) for j in joints if j.drive is not None and j.drive.stiffness > 0.0]
    # State by state: the linkage is brought to each once.
    sags = np.array([[weight(chain, state, j.name) / stiffness for j, stiffness in soft] for state in states])
    for number, (joint, _) in enumerate(soft if states else ()):
        told[joint.name] = wanted[joint.name] + np.interp(np.arange(count), steps[: len(sags)], sags[:, number])
        if joint.lower is not None and joint.upper is not None:
            told[joint.name] = np.clip(told[joint.name], joint.lower, joint.upper)
    return told


def paces(chain: ClosedChain, moves: tuple[Motion, ...]) -> Mapping[str, Pace]:
    """How fast each cylinder's target may gain speed along its stroke, and each motor's, the other actuators as drawn
    and the root held."""
    return {motion.joint: _pace(chain, motion) if motion.position else _motor(chain, motion) for motion in moves}


def _motor(chain: ClosedChain, motion: Motion) -> Pace:
    drive = chain.mechanism.joint(motion.joint).drive
    force = drive.max_force if drive is not None else math.inf
    limit = SPARE * force / chain.effective_mass(chain.drawn, motion.joint) if math.isfinite(force) else math.inf
    return Pace(np.zeros(1), np.array([limit]))


def _pace(chain: ClosedChain, motion: Motion) -> Pace:
    drive = chain.mechanism.joint(motion.joint).drive
    places: Floats = np.linspace(motion.low, motion.high, _POINTS)
    limits, masses, speeds = np.full(_POINTS, math.inf), np.full(_POINTS, math.nan), np.full((_POINTS, 2), math.inf)
    state = chain.drawn
    for number, place in enumerate(places.tolist()):
        state, fraction = chain.reach({motion.joint: place}, start=state)
        held = weight(chain, state, motion.joint)
        pull, push = drive.forces if drive is not None else (math.inf, math.inf)
        if fraction == 1.0 and math.isfinite(spare := min(push - held, pull + held)):
            spare = max(0.1 * min(push, pull), spare)
            masses[number] = chain.effective_mass(state, motion.joint)
            limits[number] = SPARE * spare / masses[number]
        if fraction == 1.0 and drive is not None and drive.rated:
            # A drive whose speed is limited has its force by how much slower than rated it is.
            hindered = np.maximum(0.0, np.array([-held, held])) / drive.damping
            speeds[number] = np.maximum(0.1 * np.array(drive.speeds), np.array(drive.speeds) - hindered)
    known = np.isfinite(masses)
    return Pace(places, limits, speeds, np.interp(places, places[known], masses[known]) if known.any() else None)
