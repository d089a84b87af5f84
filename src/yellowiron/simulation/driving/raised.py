"""What is raised before a machine drives: outriggers' jacks, stabilisers, a blade or bucket on the ground."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from yellowiron.kinematics import ClosedChain, State
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation.commands import Motion, motions
from yellowiron.simulation.driving.wheel import GroundWheel
from yellowiron.simulation.ground import standing_bodies

CLEAR = 0.15
"""Metres that something is raised by, or as far as it goes, …"""
_RISES = 0.02
"""… if that is no less than this."""
_SAMPLES = 21


def raised(mechanism: Mechanism, chain: ClosedChain, wheels: Sequence[GroundWheel]) -> Mapping[Motion, float]:
    """Targets, m or rad from the drawn pose, that raise whatever stands on the ground beside the wheels, each thing by
    the actuator that raises it most; what none raises (a track frame) is left."""
    rolling = {mechanism.bodies[wheel.body].name for wheel in wheels}
    feet = [name for name in standing_bodies(mechanism) if name not in rolling]
    best: dict[str, tuple[float, Motion, float]] = {}
    for motion in motions(mechanism) if feet else ():
        for end in (motion.low, motion.high) if motion.position else ():
            places = np.linspace(0.0, end, _SAMPLES)
            states = chain.sweep({motion.joint: places})
            for foot, heights in _rises(mechanism, chain, feet, states).items() if states else ():
                high = [number for number, height in enumerate(heights) if height >= CLEAR]
                number = high[0] if high else int(np.argmax(heights))
                if heights[number] > max(_RISES, best[foot][0] if foot in best else 0.0):
                    best[foot] = (heights[number], motion, float(places[number]))
    targets: dict[Motion, float] = {}
    for _, motion, target in best.values():
        targets[motion] = max(target, targets.get(motion, 0.0), key=abs)
    return targets


def _rises(
    mechanism: Mechanism, chain: ClosedChain, bodies: Sequence[str], states: Sequence[State]
) -> dict[str, list[float]]:
    """How far bodies' lowest points have risen in states, m."""
    found: dict[str, list[float]] = {}
    for name in bodies:
        hull = np.asarray(mechanism.body(name).hull)
        lowest = float(hull[:, 2].min())
        poses = (chain.displacement(state, name) for state in states)
        found[name] = [float((hull @ pose[2, :3] + pose[2, 3]).min()) - lowest for pose in poses]
    return found
