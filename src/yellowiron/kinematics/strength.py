"""What a drive has to hold: the weight it feels through the linkage, and drives made strong enough for it. SI."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from yellowiron.kinematics.measuring.sheet import specified
from yellowiron.kinematics.solver.chain import ClosedChain, State
from yellowiron.kinematics.solver.pose_grid import PoseGrid
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import DEFAULT, GRAVITY, Joint, Mechanism, Site
from yellowiron.support.text import display

_STEP = 1e-4
"""Metres or radians to either side of a coordinate: for slopes."""
_SPARE = 1.5
"""A cylinder of unknown pressure holds so many times the weight on it."""
_USUAL = 0.9
"""In this share of its poses: near a dead point the lever is nothing."""
_MOST = 10.0
"""Drawn near a dead point it is made no stronger than so many times, if it is not so for its other poses."""
_POSES = 25


def beside(chain: ClosedChain, state: State, joint: str) -> tuple[list[State], float]:
    """The states a little below and above one along a joint's coordinate, and how far they are apart; 0 or less where
    the linkage locks."""
    place = chain.coordinate(state, joint)
    ends = [chain.reach({joint: place + step}, start=state)[0] for step in (-_STEP, _STEP)]
    return ends, chain.coordinate(ends[1], joint) - chain.coordinate(ends[0], joint)


def weight(chain: ClosedChain, state: State, joint: str) -> float:
    """Force (N) or torque (N·m) along a joint's coordinate that holds the machine's weight: the potential energy's
    slope, the root upright."""
    try:
        return GRAVITY * chain.raised_mass(state, joint)
    except np.linalg.LinAlgError:  # a dead point: no velocity of the coordinate moves anything
        return 0.0


def rated_load(mechanism: Mechanism) -> tuple[Site, float] | None:
    """Where the rated load is in the machine's tool, and its mass, kg: by the first of the template's rules whose value
    is known."""
    payload = mechanism.payload
    site = next((s for s in mechanism.sites if payload is not None and s.name == payload.site), None)
    for rated in payload.rated if payload is not None and site is not None else ():
        value = specified(mechanism, rated.specification)[0]
        if value is not None and value > 0.0 and site is not None:
            return site, rated.factor * value
    return None


def carried(chain: ClosedChain, state: State, joint: str, site: Site, mass: float) -> float:
    """What a mass (kg) at a site adds to the mass (kg, kg·m²) that a joint's drive sees; 0 at a dead point."""
    try:
        velocity = chain.point_velocity(state, joint, site.body, np.array(site.position))
    except np.linalg.LinAlgError:
        return 0.0
    return float(mass * velocity @ velocity)


def strong_enough(chain: ClosedChain, grids: list[PoseGrid], joints: dict[str, Joint]) -> tuple[Finding, ...]:
    """Raises, in `joints`, the force of the drives of those cylinders whose pressure is the template's where it cannot
    hold the machine's own weight; a finding for each."""
    findings = []
    guessed = {
        c.slide
        for c in chain.mechanism.cylinders
        if c.sources.get("pressure", "").startswith(DEFAULT) or not c.push_force > 0.0
    }
    for component, grid in zip(chain.components(), grids, strict=True):
        states = grid.states[:: max(1, len(grid.states) // _POSES)]
        for name in component.drivers:
            drive = joints[name].drive
            if name not in guessed or drive is None or drive.kind != "position" or not len(states):
                continue
            # Which way of the cylinder holds the weight depends on the pose.
            known = math.isfinite(drive.max_force)
            has = drive.forces if known else (1.0, 1.0)
            held, drawn = (
                [abs(force) / has[int(force > 0.0)] for force in forces]
                for forces in ([weight(chain, s, name) for s in states], [weight(chain, chain.drawn, name)])
            )
            usual = float(np.quantile(held, _USUAL))
            factor = _SPARE * max(usual, min(drawn[0], _MOST * (1.0 / _SPARE if known else usual)))
            if not factor > (1.0 if known else 0.0):
                continue
            force = factor * (drive.max_force if known else 1.0)
            less = f"with the template's pressure it has {display(drive.max_force, 'N')} and could not hold"
            words = (
                f"{less if known else 'nothing gives its force, which must hold'} the machine's own weight: it is "
                f"given {display(force, 'N')}, {_SPARE:g} times what that takes"
            )
            findings.append(Finding("KIN015", "warning", name, words, "Give pressure and weight, or a sheet."))
            source = f"{drive.source}; {_SPARE:g} times the machine's own weight on it"
            back = None if drive.reverse_force is None else factor * (drive.reverse_force if known else 1.0)
            stronger = replace(drive, max_force=force, reverse_force=back, source=source)
            joints[name] = replace(joints[name], drive=stronger)
    return tuple(findings)
