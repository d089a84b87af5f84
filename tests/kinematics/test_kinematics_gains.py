"""Drive gains: stable well past the engines' step in any pose, as stiff as that allows; stated ones stay."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from planar_zbar import sketch, strokes, zbar_mechanism
from test_kinematics_crane import crane

from yellowiron.kinematics import ClosedChain, complete
from yellowiron.kinematics.gains import OUTRUN, RATE, STEP, position_gains
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Drive, Joint, Mechanism

HELD = "pressure times area: 400 kN; gains provisional"


def body(name: str, mass: float, at: tuple[float, float, float]) -> Body:
    return Body(name, at, mass, at, 0.4 * mass * np.eye(3), (), np.zeros((0, 3)))


def joint(name: str, kind: str, one: str, other: str, at: tuple[float, float, float], drive: Drive | None) -> Joint:
    axis = (1.0, 0.0, 0.0) if kind == "prismatic" else (0.0, 1.0, 0.0)
    return Joint(name, kind, one, other, at, axis, -0.5, 0.5, drive=drive)  # type: ignore[arg-type]


def slider(*, lying: float = 1e4) -> Mechanism:
    """A root, a pivot on it and a slide on that, both driven; without loops."""
    drive = Drive("position", 0.0, 0.0, 1e5, 0.2, HELD)
    return Mechanism(
        name="slider",
        equipment_type="test",
        root="root",
        bodies=(
            body("root", lying, (0.0, 0.0, 0.0)),
            body("arm", 900.0, (1.0, 0.0, 0.5)),
            body("rod", 300.0, (2.0, 0.0, 0.5)),
        ),
        joints=(
            joint("pivot", "revolute", "root", "arm", (0.0, 0.0, 0.5), drive),
            joint("slide", "prismatic", "arm", "rod", (1.0, 0.0, 0.5), drive),
        ),
    )  # fmt: skip


def by_hand(mechanism: Mechanism) -> tuple[Floats, Floats]:
    """Mass matrices of a chain without loops in the drawn pose, the root held and free, body by body."""
    columns = []
    for moving in (*mechanism.joints, *range(6)):
        speeds = []
        for each in mechanism.bodies:
            arm = np.asarray(each.center_of_mass)
            turn, shift = np.zeros(3), np.zeros(3)
            if isinstance(moving, int):
                (shift if moving < 3 else turn)[moving % 3] = 1.0
                shift = shift + np.cross(turn, arm)
            elif each.name in beyond(mechanism, moving):
                axis = np.asarray(moving.axis)
                if moving.type == "prismatic":
                    shift = axis
                else:
                    turn, shift = axis, np.cross(axis, arm - np.asarray(moving.anchor))
            speeds.append((shift, turn))
        columns.append(speeds)
    size = len(columns)
    matrix = np.zeros((size, size))
    for i in range(size):
        for j in range(size):
            matrix[i, j] = sum(
                b.mass * one[0] @ other[0] + one[1] @ np.asarray(b.inertia) @ other[1]
                for b, one, other in zip(mechanism.bodies, columns[i], columns[j], strict=True)
            )
    count = len(mechanism.joints)
    return matrix[:count, :count], np.linalg.inv(np.linalg.inv(matrix)[:count, :count])


def beyond(mechanism: Mechanism, moving: Joint) -> set[str]:
    """The bodies that a joint carries."""
    reached = {moving.body1}
    for other in mechanism.joints:
        if other.body0 in reached:
            reached.add(other.body1)
    return reached


def largest(masses: Floats, drives: list[Drive], step: float) -> float:
    """The spectral radius of a step of semi-implicit Euler with those drives' forces."""
    inverse = np.linalg.inv(masses + np.diag([d.armature for d in drives]))
    slowed = step * inverse @ np.diag([d.damping for d in drives])
    pulled = step * inverse @ np.diag([d.stiffness for d in drives])
    still = np.eye(len(drives))
    update = np.block([[still - slowed, -pulled], [step * (still - slowed), still - step * pulled]])
    return float(np.abs(np.linalg.eigvals(update)).max())


def test_masses_are_those_of_every_body_with_the_root_held_and_free():
    mechanism = slider()
    chain = ClosedChain(mechanism)
    for found, wanted in zip(chain.masses(chain.drawn), by_hand(mechanism), strict=True):
        assert found == pytest.approx(wanted, rel=1e-9)


def test_a_slide_on_a_free_root_moves_the_reduced_mass():
    mechanism = slider(lying=500.0)
    alone = replace(mechanism, bodies=mechanism.bodies[1:], joints=mechanism.joints[1:], root="arm")
    chain = ClosedChain(alone)
    held, free = chain.masses(chain.drawn)
    assert held[0, 0] == pytest.approx(300.0) and free[0, 0] == pytest.approx(900.0 * 300.0 / 1200.0)


def loader() -> Mechanism:
    drawing = sketch()
    return zbar_mechanism(drawing, strokes(drawing))


@pytest.mark.parametrize("machine", [crane(), loader(), slider()], ids=["crane", "loader", "slider"])
def test_steps_three_times_as_long_are_stable_in_any_pose(machine):
    """Poses by chance, not those the gains were made from; the root held and free, and all drives at once."""
    done = complete(machine)
    chain, chance = ClosedChain(done), np.random.default_rng(7)
    names = [n for n in chain.independent if done.joint(n).drive is not None]
    columns = [chain.independent.index(n) for n in names]
    drives = [drive for n in names if (drive := done.joint(n).drive) is not None]
    ranges = {n: (done.joint(n).lower, done.joint(n).upper) for n in names if done.joint(n).lower is not None}
    tried = 0
    for _ in range(60):
        state, share = chain.reach({n: float(chance.uniform(*r)) for n, r in ranges.items()})
        if share < 1.0:
            continue
        tried += 1
        for masses in chain.masses(state):
            own = np.linalg.inv(np.linalg.inv(masses)[np.ix_(columns, columns)])
            assert largest(own, drives, STEP) <= 1.0 + 1e-9
            assert largest(own, drives, 3.0 * STEP) <= 1.0 + 1e-9
    assert tried > 30


def test_a_target_is_followed_a_fiftieth_of_a_second_behind():
    drives = [j.drive for j in complete(crane()).joints if j.drive is not None and j.drive.kind == "position"]
    assert drives and all(d.damping / d.stiffness <= 0.02 for d in drives)


def test_weight_makes_no_drive_outrun_its_speed_and_full_force_hardly_slows_it():
    machine = slider()
    forces = {"pivot": 2e5, "slide": 1e3}
    joints = tuple(
        replace(j, drive=replace(j.drive, max_velocity=0.45, max_force=forces[j.name])) if j.drive is not None else j
        for j in machine.joints
    )
    done = complete(replace(machine, joints=joints))
    pivot = done.joint("pivot").drive
    held = 9.81 * (900.0 * 1.0 + 300.0 * 2.0)
    assert pivot.armature > 0.0 and "no load changes" in pivot.source
    assert held / pivot.damping <= 1.1 * OUTRUN * 0.45
    assert 2e5 / pivot.damping <= 1.1 * 0.12 * 0.45
    # Nothing lifts the slide, and the mass that it moves bears the damping that its force asks for.
    assert done.joint("slide").drive.armature == 0.0


def test_stated_gains_stay():
    stated = Drive("position", 5e6, 1e5, 1e6, 0.2, "template")
    assert position_gains(stated, 1e6, 1e5) == stated
    undamped = position_gains(replace(stated, damping=0.0), 1e6, 1e5)
    assert undamped.stiffness == 5e6 and undamped.damping == pytest.approx(2.0 * math.sqrt(5e6 * 1e5))


def test_provisional_gains_do_not_stay_unless_the_template_states_them():
    drive = Drive("position", 1e9, 1e9, 1e6, 0.2, HELD)
    found = position_gains(drive, 1e6, 1e4)
    assert found.damping == 1e6 and found.stiffness == pytest.approx(RATE * 1e6)
    assert "pressure times area: 400 kN; gains: a third" in found.source and "provisional" not in found.source
    assert position_gains(found, 2e6, 2e4) == found
    partly = position_gains(replace(drive, source=drive.source + "; template states damping"), 1e6, 1e4)
    assert partly.damping == 1e9 and partly.stiffness == pytest.approx(RATE * 1e9)


def test_what_is_heavy_is_held_softer_and_a_short_stroke_stiffer():
    drive = Drive("position", 0.0, 0.0, 1e9, 0.2, HELD)
    light, heavy = position_gains(drive, 1e6, 1e4), position_gains(drive, 1e6, 1e6)
    assert light.stiffness == pytest.approx(RATE * 1e6)
    assert heavy.damping / (2.0 * math.sqrt(heavy.stiffness * 1e6)) == pytest.approx(0.2)
    assert position_gains(drive, 1e6, 1e6, softest=3e7).stiffness == pytest.approx(3e7)
    assert position_gains(drive, 1e6, 1e6, softest=1e12).stiffness == pytest.approx(200.0 * 1e6)


def test_a_cylinder_whose_force_nothing_gives_is_as_strong_both_ways() -> None:
    """One way stayed without a limit: the file said infinite, and its record what holds the weight."""
    machine = crane()
    unlimited = Drive("position", 0.0, 0.0, math.inf, 0.3, HELD, reverse_force=math.inf)
    joints = tuple(replace(j, drive=unlimited) if j.name == "boom_ram" else j for j in machine.joints)
    cylinders = tuple(replace(c, push_force=0.0, pull_force=0.0) for c in machine.cylinders)
    done = complete(replace(machine, joints=joints, cylinders=cylinders))
    drive = done.joint("boom_ram").drive
    assert drive is not None and 1e4 < drive.max_force < 1e6
    assert drive.reverse_force == drive.max_force == drive.strongest
    assert "KIN015" in {f.code for f in done.findings}
