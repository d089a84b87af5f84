"""The machine of a file as the tests take it: without its rings of track shoes, which no joint holds."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from yellowiron import usd
from yellowiron.kinematics import attached
from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Body, Joint, Mechanism, chained
from yellowiron.simulation.driving.wheel import pitch_radius
from yellowiron.simulation.engine import Base


def held_machine(usd_path: str | Path, base: Base) -> tuple[Mechanism, tuple[Body, ...]]:
    """The machine without bodies that nothing holds, and its bodies that differ from the file's: a sprocket has the
    inertia of the ring that would run around with it, as a hoop. Bare, it is so light that a motor's torque takes it
    past its speed within a step. `YellowironError` for a machine that would stand on them."""
    mechanism = usd.read_mechanism(usd_path)
    if mechanism.floating and base == "floating":
        raise YellowironError(
            "The machine stands on track shoes that are bodies of their own, which this test does not follow",
            where=str(usd_path),
            hint="Take a fixed base, or --test drive, or build it with --tracks belt.",
        )
    left = attached(mechanism)
    changed = {
        joint.body1: _ringed(left.body(joint.body1), joint, mechanism)
        for joint in (left.joints if mechanism.floating else ())
        if joint.drive is not None and joint.drive.kind == "velocity" and pitch_radius(mechanism, joint)
        and abs(joint.axis[1]) > abs(joint.axis[2])
    }  # fmt: skip
    return replace(left, bodies=tuple(changed.get(b.name, b) for b in left.bodies)), tuple(changed.values())


def _ringed(sprocket: Body, joint: Joint, mechanism: Mechanism) -> Body:
    """A sprocket with the inertia of the ring on its side: m r² about its axle, half of it across."""
    loose = chained(mechanism)
    mass = sum(b.mass for b in mechanism.bodies if b.name in loose and b.origin[1] * joint.anchor[1] > 0.0)
    axis = np.asarray(joint.axis, dtype=np.float64)
    hoop = mass * (pitch_radius(mechanism, joint) or 0.0) ** 2
    return replace(sprocket, inertia=sprocket.inertia + 0.5 * hoop * (np.eye(3) + np.outer(axis, axis)))
