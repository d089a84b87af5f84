"""Mechanisms of a few bodies whose motion is known by hand, one joint type or one collision token each."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import trimesh

from kit.machines.small_machine import shape
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, BodyPart, Drive, Joint, Mechanism
from yellowiron.usd import write_machine

G = 9.81
MASS, INERTIA, LENGTH, SWING = 10.0, 0.4, 1.0, 0.1
PIN = (0.0, 0.0, 2.0)
STIFFNESS = 2000.0
REACH = 0.5
"""Metres: the greatest distance of the distance joint."""
PERIOD = 2.0 * math.pi * math.sqrt((INERTIA + MASS * LENGTH**2) / (MASS * G * LENGTH))
"""Of a pendulum with its mass in one place, for small swings (Huygens)."""


def _body(name: str, place: tuple[float, ...], mass: float = MASS, inertia: float = INERTIA, **more: object) -> Body:
    rest = {"parts": (), "hull": np.zeros((0, 3)), **more}
    return Body(name, place, mass, place, inertia * np.eye(3), **rest)  # type: ignore[arg-type]


def _place(x: float, y: float) -> tuple[float, float, float]:
    return (x, y, PIN[2] - math.sqrt(LENGTH**2 - x * x - y * y))


def with_joint(kind: str) -> Mechanism:
    """`base`, and `bob` held by a joint of that type: a pendulum (revolute, spherical; fixed: to an arm that swings), a
    weight on a sprung slide (prismatic), or one that falls until its tether is taut (distance)."""
    x, y = LENGTH * math.sin(SWING), 0.0
    if kind == "spherical":
        x, y = 0.6 * x, 0.8 * x
    bob, base = _body("bob", _place(x, y)), _body("base", (0.0, 0.0, 2.0))
    down = (0.0, 0.0, -1.0)
    if kind in ("revolute", "spherical"):
        return _mechanism((base, bob), (Joint("held", kind, "base", "bob", PIN, (0, 1, 0), free=True),))
    if kind == "fixed":
        arm = _body("arm", PIN, 1e-3, 1e-3)
        pin = Joint("pin", "revolute", "base", "arm", PIN, (0, 1, 0), free=True)
        return _mechanism((base, arm, bob), (pin, Joint("held", "fixed", "arm", "bob", bob.origin, down)))
    weight = _body("bob", (0.0, 0.0, 1.0))
    if kind == "prismatic":
        damping = 2.0 * math.sqrt(STIFFNESS * MASS)
        drive = Drive("position", STIFFNESS, damping, 1e5, 10.0)
        slide = Joint("held", "prismatic", "base", "bob", weight.origin, down, -1.0, 1.0, drive=drive)
        return _mechanism((base, weight), (slide,), (Actuator("lift", "cylinder", (ActuatorJoint("held"),)),))
    slide = Joint("slide", "prismatic", "base", "bob", weight.origin, down, -2.0, 2.0, free=True)
    tether = Joint("held", "distance", "base", "bob", weight.origin, down, 0.0, REACH, cut=True)
    return _mechanism((base, weight), (slide, tether))


def _mechanism(bodies: tuple[Body, ...], joints: tuple[Joint, ...], actuators: tuple[Actuator, ...] = ()) -> Mechanism:
    return Mechanism("simple", "simple", bodies[0].name, bodies, joints, actuators=actuators)


SIZE = np.array([1.0, 0.6, 0.5])
"""The arch's box; it is open along y: 0.6 m wide and 0.3 m high."""
HEIGHT = 0.75
"""Of its feet over the ground, as drawn."""


def arch(token: str) -> tuple[Mechanism, Assembly]:
    """An arch that collides by a token, with a small wheel (a joint, so that it is an articulation)."""
    profile = np.array(
        [(-0.5, 0.0), (-0.3, 0.0), (-0.3, 0.3), (0.3, 0.3), (0.3, 0.0), (0.5, 0.0), (0.5, 0.5), (-0.5, 0.5)]
    )
    faces = [(0, 1, 2), (0, 2, 7), (7, 2, 3), (7, 3, 6), (3, 4, 5), (3, 5, 6)]
    front, back = (np.column_stack([profile[:, 0], np.full(8, y), profile[:, 1]]) for y in (-0.3, 0.3))
    sides = [t for i in range(8) for j in [(i + 1) % 8] for t in ((i, j, i + 8), (j, j + 8, i + 8))]
    ends = [*((a, c, b) for a, b, c in faces), *((a + 8, b + 8, c + 8) for a, b, c in faces)]
    mesh = trimesh.Trimesh(np.concatenate([front, back]), [*ends, *sides], process=False)
    mesh.fix_normals()
    made = shape("ARCH", mesh)
    place = np.eye(4)
    place[2, 3] = HEIGHT
    part = Part("ARCH/arch", "arch", ("ARCH",), made.key, place)
    hull = made.mesh.points + np.array([0.0, 0.0, HEIGHT])
    body = _body(
        "arch", (0.0, 0.0, HEIGHT), 100.0, 8.0, parts=(BodyPart(part.id, "arch", "", token, 100.0),), hull=hull
    )
    wheel = _body("wheel", (0.0, 0.0, HEIGHT + 0.4), 1.0, 0.01)
    joint = Joint("axle", "revolute", "arch", "wheel", wheel.origin, (0, 1, 0), free=True)
    return _mechanism((body, wheel), (joint,)), Assembly("ARCH", "step", 1.0, (part,), {made.key: made})


def write(folder: Path, mechanism: Mechanism, assembly: Assembly | None = None) -> Path:
    """As USD in a folder; the machine file."""
    none = Assembly("NONE", "step", 1.0, (), {})
    return write_machine(mechanism, assembly or none, folder, name="simple")[0]
