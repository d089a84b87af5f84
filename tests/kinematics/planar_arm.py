"""A planar arm of three links without loops, each pivot driven within its own limits: every working range has an answer
in closed form. x forward, z up; angles counter-clockwise seen from the right, that is, raising is positive, so the
joints' +Y coordinates are their negatives."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Drive, Joint, Mechanism, Site

UP = (0.0, -1.0, 0.0)
"""Axis about which raising is positive."""


@dataclass(frozen=True)
class Arm:
    """Foot at (`x`, `z`); lengths of boom, arm and bucket; limits of the boom's pitch, of the arm's against the boom,
    of the bucket's against the arm (radians)."""

    x: float = 0.4
    z: float = 1.9
    boom: float = 5.7
    arm: float = 2.9
    bucket: float = 1.5
    booms: tuple[float, float] = (math.radians(-50.0), math.radians(60.0))
    arms: tuple[float, float] = (math.radians(-150.0), math.radians(-32.0))
    buckets: tuple[float, float] = (math.radians(-130.0), math.radians(40.0))

    def tip(self, pitch: float, fold: float, curl: float) -> np.ndarray:
        """(x, z) of the tip."""
        angles = np.cumsum([pitch, fold, curl])
        lengths = (self.boom, self.arm, self.bucket)
        at = [self.x, self.z]
        for length, angle in zip(lengths, angles, strict=True):
            at = [at[0] + length * math.cos(angle), at[1] + length * math.sin(angle)]
        return np.array(at)


def arm_mechanism(a: Arm) -> Mechanism:
    """The arm on a turntable, drawn straight out: boom, arm and bucket level, which need not be legal."""
    pins = np.cumsum([a.x, a.boom, a.arm, a.bucket])
    names = ("upper", "boom", "arm", "bucket")
    bodies = [
        Body("base", (0, 0, 0), 5000.0, (0, 0, 0.5), np.eye(3) * 1e3, (), np.array([[-2, -1.5, 0], [2, 1.5, 1.0]]))
    ]
    tail = np.array([[-2.4, 1.2, 1.1], [-2.4, -1.2, 2.4], [1.2, 1.4, 3.0], [0.0, 0.0, 0.9]])
    bodies.append(Body("upper", (0, 0, 1.0), 9000.0, (-1, 0, 1.5), np.eye(3) * 1e3, (), tail))
    joints = [Joint("swing", "revolute", "base", "upper", (0, 0, 1.0), (0, 0, 1), drive=_drive("velocity"))]
    limits = (a.booms, a.arms, a.buckets)
    for k, name in enumerate(names[1:]):
        start, end = pins[k], pins[k + 1]
        hull = np.array([[start, -0.2, a.z], [start, 0.2, a.z], [end, -0.2, a.z], [end, 0.2, a.z]])
        bodies.append(Body(name, (start, 0, a.z), 900.0, (0.5 * (start + end), 0, a.z), np.eye(3) * 100.0, (), hull))
        joints.append(
            Joint(
                f"{name}_joint", "revolute", names[k], name, (start, 0.0, a.z), UP,
                *limits[k], drive=_drive("position"),
            )
        )  # fmt: skip
    actuators = [Actuator("swing", "motor", (ActuatorJoint("swing"),))]
    actuators += [Actuator(name, "cylinder", (ActuatorJoint(f"{name}_joint"),)) for name in names[1:]]
    return Mechanism(
        name="arm",
        equipment_type="excavator",
        root="base",
        bodies=tuple(bodies),
        joints=tuple(joints),
        actuators=tuple(actuators),
        sites=(Site("tip", "bucket", (float(pins[3]), 0.0, a.z)),),
    )


def _drive(kind) -> Drive:
    return Drive(kind, 0.0, 0.0, 1e5, 1.0, "test")
