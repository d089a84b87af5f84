"""What a machine on its ground is not put through: poses in which it falls over, whatever the engine."""

from __future__ import annotations

import numpy as np

from yellowiron.kinematics import ClosedChain
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation.commands import Phase
from yellowiron.simulation.machine_tests.statics import stands

_POSES = 41
"""Of a phase's path, at equal times."""


def falls_over(mechanism: Mechanism, chain: ClosedChain, phase: Phase) -> Finding | None:
    """SIM011 where a machine that stands as drawn does not in some pose of a phase, by statics on its wheels, tracks
    and feet: as a dump truck that is bent to its lock and tipped with its load still aboard."""
    slides = [n for n in phase.targets if n in chain.independent and mechanism.joint(n).type == "prismatic"]
    if not slides or not stands(mechanism, chain, chain.drawn):
        return None
    steps = np.unique(np.linspace(0, phase.steps - 1, _POSES).round().astype(int))
    for state in chain.sweep({name: phase.targets[name][steps] for name in slides}):
        if not stands(mechanism, chain, state):
            at = ", ".join(f"{name} {_shown(chain.coordinate(state, name))}" for name in slides)
            words = f"the machine falls over with what it carries ({at}): not driven so"
            hint = "Its actuators are driven one by one; drive it empty (--payload 0) to see them move at once."
            return Finding("SIM011", "info", phase.name, words, hint)
    return None


def _shown(metres: float) -> str:
    return f"{1e3 * metres:+.0f} mm"
