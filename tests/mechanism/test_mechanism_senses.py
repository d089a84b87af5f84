"""A hinge that is driven in the place of its cylinders moves as these do: an actuator told more raises its boom."""

from __future__ import annotations

import numpy as np
import pytest

from kit.machines.defects import drawn
from kit.machines.drawers import DRAWERS
from kit.machines.partly_drawn import without
from kit.machines.synthetic import Machine
from yellowiron.kinematics import ClosedChain
from yellowiron.kinematics.solver.pose_grid import explore, joint_values
from yellowiron.model.mechanism import Actuator, Mechanism

CYLINDERS = ("cylinder", "piston_rod")
MOVED = {
    "loader": {"boom", "bucket", "steering"},
    "excavator": {"boom", "arm", "bucket"},
    "skid steer": {"boom", "bucket"},
    "telehandler": {"lift", "tilt", "steering", "rear_steering"},
    "forklift": {"tilt", "steering"},
    "rigid truck": {"hoist", "steering"},
    "articulated truck": {"hoist", "steering"},
    "roller": {"steering"},
    "wheeled excavator": {"boom", "adjust_boom", "arm", "bucket", "steering"},
}
"""What is told of each kind, whatever else it has."""
CHOICES = {
    "excavator": {"boom_cylinders": "single"},
    "skid steer": {"lift_path": "radial"},
    "wheeled excavator": {"boom_cylinders": "single", "boom_type": "two_piece"},
}


def machine_of(kind: str) -> tuple[Machine, str]:
    if kind in DRAWERS:
        make, template = DRAWERS[kind]
        return make(1), template
    return drawn(kind, 1), {"loader": "wheel_loader"}.get(kind, kind)


def turning(mechanism: Mechanism, actuator: Actuator, hinge: str, *, points: int = 9) -> float:
    """How far a hinge turns about its axis as an actuator goes from one end to the other."""
    chain, moved = ClosedChain(mechanism), actuator.joints[0]
    joint, about = mechanism.joint(moved.joint), mechanism.joint(hinge)
    assert joint.lower is not None and joint.upper is not None
    grid = explore(chain, {joint.name: (joint.lower, joint.upper)}, points=points)
    order = np.argsort(grid.values[:, 0])
    rotations, _ = chain.placements(grid.states)
    turn = np.unwrap(joint_values(chain, grid, about, rotations)[order])
    return moved.sign * float(turn[-1] - turn[0])


@pytest.mark.parametrize("kind", MOVED)
def test_a_hinge_moves_as_its_cylinders_would(kind: str) -> None:
    """Booms of models without cylinders sank where they were told to rise: their lift was measured at the ground."""
    machine, template = machine_of(kind)
    whole = without(machine, template, (), choices=CHOICES.get(kind))
    bare = without(machine, template, CYLINDERS, choices=CHOICES.get(kind))
    cylinders = {a.name: a for a in whole.actuators if a.cylinders}
    compared = set()
    for actuator in (a for a in bare.actuators if a.kind == "motor" and a.name in cylinders):
        hinge = bare.joint(actuator.joints[0].joint)
        alike = float(np.dot(hinge.axis, whole.joint(hinge.name).axis))
        by_cylinders = turning(whole, cylinders[actuator.name], hinge.name)
        assert by_cylinders * alike * actuator.joints[0].sign > 0.0, actuator.name
        compared.add(actuator.name)
    assert compared >= MOVED[kind]
