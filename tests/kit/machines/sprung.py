"""The small loader with its front wheels on hubs that slide up and down in the frame, on springs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from kit.machines import small_machine
from yellowiron.kinematics import complete
from yellowiron.model.assembly import Assembly
from yellowiron.model.mechanism import Body, Joint, Mechanism, Spring
from yellowiron.usd import write_machine

STIFFNESS, DAMPING, TRAVEL, HUB = 5e5, 3e4, 0.12, 60.0
"""N/m, N·s/m, metres either way, kg."""
SPRINGS = ("hub_l_joint", "hub_r_joint")


def make(spring: Spring | None = None) -> tuple[Mechanism, Assembly]:
    """The machine, completed by the kinematics, and the assembly it stands for; by default it stands as drawn."""
    mechanism, assembly = small_machine.make()
    spring = spring or Spring(STIFFNESS, DAMPING, as_drawn=True)
    wheels = {name: place for name, place in small_machine.WHEELS.items() if name.startswith("front")}
    hubs, slides = [], []
    for name, place in wheels.items():
        hub = f"hub_{name[-1]}"
        hubs.append(Body(hub, place, HUB, place, 0.05 * HUB * np.eye(3), (), np.zeros((0, 3))))
        slides.append(Joint(f"{hub}_joint", "prismatic", "frame", hub, place, (0.0, 0.0, 1.0), -TRAVEL, TRAVEL,
                            free=True, spring=spring))  # fmt: skip
    joints = [replace(j, body0=f"hub_{j.body1[-1]}") if j.body1 in wheels else j for j in mechanism.joints]
    bodies = (mechanism.bodies[0], *hubs, *mechanism.bodies[1:])
    return complete(replace(mechanism, bodies=bodies, joints=(*slides, *joints))), assembly


def write(folder: Path, spring: Spring | None = None) -> Path:
    """It as USD in a folder; its machine file."""
    mechanism, assembly = make(spring)
    return write_machine(mechanism, assembly, folder, name="sprung_loader")[0]
