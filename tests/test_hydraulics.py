"""The oil between levers and cylinders, against flow = area × speed and power = pressure × flow."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from yellowiron.hydraulics import CUSHION, SPOOL, TO_OIL, Hydraulics
from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Cylinder, Drive, Joint, Mechanism

PRESSURE, STEP = 30e6, 0.001
PISTON, RING = 0.01, 0.006
"""m²."""
FLOW = 0.004
"""m³/s: 240 l/min."""


def cylinder(name: str, *, passive: bool = False) -> Cylinder:
    forces = {"push_force": PRESSURE * PISTON, "pull_force": PRESSURE * RING}
    return Cylinder(
        name, f"{name}_barrel", f"{name}_rod", f"{name}_slide", None, None, 0.11, 0.07, 1.0, 1.5, 2.0, PRESSURE,
        speed=FLOW / PISTON, passive=passive, **forces,
    )  # fmt: skip


def slide(name: str, areas: tuple[float, float]) -> Joint:
    """(retracting, extending) areas; the speeds are those of the whole flow."""
    drive = Drive(
        "position", 1e8, 1e6, PRESSURE * areas[1], FLOW / areas[1],
        reverse_force=PRESSURE * areas[0], reverse_velocity=FLOW / areas[0],
    )  # fmt: skip
    return Joint(f"{name}_slide", "prismatic", "root", name, (0, 0, 0), (1, 0, 0), -0.5, 0.5, drive=drive)


def machine(**changes: Any) -> Mechanism:
    """A boom, a bucket that dumps by retracting, and steering by two cylinders, one of which goes the other way."""
    both = (PISTON + RING, PISTON + RING)
    joints = (slide("boom", (RING, PISTON)), slide("bucket", (RING, PISTON)), slide("steer_l", both))
    twin = replace(slide("steer_r", both), drive=None)
    bodies = tuple(
        Body(name, (0, 0, 0), 1.0, (0, 0, 0), np.eye(3), (), np.zeros((0, 3)))
        for name in ("root", "boom", "bucket", "steer_l", "steer_r")
    )
    made = Mechanism(
        name="machine",
        equipment_type="test",
        root="root",
        bodies=bodies,
        joints=(*joints, twin),
        cylinders=(cylinder("boom"), cylinder("bucket"), cylinder("steer_l"), cylinder("steer_r", passive=True)),
        actuators=(
            Actuator("boom", "cylinder", (ActuatorJoint("boom_slide"),), ("boom",)),
            Actuator("dump", "cylinder", (ActuatorJoint("bucket_slide", -1),), ("bucket",)),
            Actuator(
                "steering",
                "cylinder",
                (ActuatorJoint("steer_l_slide"), ActuatorJoint("steer_r_slide", -1)),
                ("steer_l", "steer_r"),
            ),
        ),
    )
    return replace(made, **changes)


REST = {"boom_slide": 0.0, "bucket_slide": 0.0, "steer_l_slide": 0.0}


def run(hydraulics: Hydraulics, levers: dict[str, float], seconds: float, **forces: float) -> dict[str, float]:
    """The strokes after a time, the drives following exactly."""
    strokes = dict(REST)
    for _ in range(round(seconds / STEP)):
        strokes = hydraulics.step(levers, strokes, STEP, forces=forces)
    return strokes


def test_circuits_are_the_areas_that_the_pump_fills() -> None:
    circuits = Hydraulics(machine()).circuits
    assert circuits["boom"].areas == pytest.approx((RING, PISTON))
    assert circuits["steering"].areas == pytest.approx((PISTON + RING, PISTON + RING))
    assert Hydraulics(machine()).flow == pytest.approx(FLOW)


def test_a_valve_opens_over_its_time_and_the_slide_goes_at_rated_speed() -> None:
    hydraulics = Hydraulics(machine())
    strokes = run(hydraulics, {"boom": 1.0}, 1.0)
    # Half of the time that the valve takes is lost, and all of it counts from the first step's end.
    assert strokes["boom_slide"] == pytest.approx(FLOW / PISTON * (1.0 - 0.5 * SPOOL), abs=2.0 * STEP * FLOW / PISTON)
    assert hydraulics.speeds["boom"] == pytest.approx(FLOW / PISTON)
    assert strokes["bucket_slide"] == 0.0


def test_a_lever_s_sense_is_the_actuator_s() -> None:
    hydraulics = Hydraulics(machine())
    strokes = run(hydraulics, {"dump": 0.5}, 0.4)
    assert hydraulics.speeds["dump"] == pytest.approx(-0.5 * FLOW / RING)
    assert strokes["bucket_slide"] < 0.0
    assert hydraulics.controls(strokes)["dump"] == -strokes["bucket_slide"]


def test_the_flow_is_shared() -> None:
    hydraulics = Hydraulics(machine())
    run(hydraulics, {"boom": 1.0, "dump": 1.0, "steering": 1.0}, 0.5)
    speeds = hydraulics.speeds
    flows = speeds["boom"] * PISTON, -speeds["dump"] * RING, speeds["steering"] * (PISTON + RING)
    assert sum(flows) == pytest.approx(FLOW)
    assert flows == pytest.approx([FLOW / 3.0] * 3)
    plenty = Hydraulics(machine(), flow=3.0 * FLOW)
    run(plenty, {"boom": 1.0, "dump": 1.0, "steering": 1.0}, 0.5)
    assert plenty.speeds["boom"] == pytest.approx(FLOW / PISTON)


def test_the_engine_s_power_is_shared_by_pressure_and_what_pulls_needs_none() -> None:
    sheet = {"Net Power": {"value": 50e3 / TO_OIL, "unit": "W", "status": "ok"}}
    hydraulics = Hydraulics(machine(specifications=sheet))
    assert hydraulics.power == pytest.approx(50e3)
    load = 0.8 * PRESSURE * PISTON
    run(hydraulics, {"boom": 1.0}, 0.5, boom_slide=load)
    assert hydraulics.speeds["boom"] * load == pytest.approx(50e3)
    hydraulics = Hydraulics(machine(specifications=sheet))
    run(hydraulics, {"boom": -1.0}, 0.5, boom_slide=load)  # lowered: its weight does it
    assert hydraulics.speeds["boom"] == pytest.approx(-FLOW / RING)
    assert Hydraulics(machine(), power=1e9).power == 1e9 and Hydraulics(machine()).power == np.inf


def test_a_load_is_held_where_the_valve_closes() -> None:
    hydraulics = Hydraulics(machine())
    strokes = run(hydraulics, {"boom": 1.0}, 0.3)
    for _ in range(round(2.0 * SPOOL / STEP)):
        strokes = hydraulics.step({}, strokes, STEP)
    held = strokes["boom_slide"]
    sagged = {**strokes, "boom_slide": held - 0.002}
    for _ in range(500):
        assert hydraulics.step({}, sagged, STEP)["boom_slide"] == pytest.approx(held, abs=1e-12)


def test_a_slide_reaches_rated_speed_against_its_drive_s_own_damping() -> None:
    """Whose force at rated speed is many times the relief's: levers through the oil were a tenth as fast as the
    pump."""
    drive = replace(slide("boom", (RING, PISTON)).drive, damping=1e7)
    hydraulics = Hydraulics(
        machine(joints=(replace(slide("boom", (RING, PISTON)), drive=drive), *machine().joints[1:]))
    )
    stroke, speed, mass = -0.4, 0.0, 2e4
    fastest = 0.0
    for _ in range(1000):
        target = hydraulics.step({"boom": 1.0}, {**REST, "boom_slide": stroke}, STEP)["boom_slide"]
        # The drive as an engine has it, its damping implicit.
        push = min(1e8 * (target - stroke), 1e7 * FLOW / PISTON)
        force = max(-PRESSURE * RING, min(PRESSURE * PISTON, push - 1e7 * speed))
        free = (speed + STEP / mass * push) / (1.0 + STEP / mass * 1e7)
        bound = speed + STEP / mass * PRESSURE * PISTON
        speed = min(free, bound) if force > 0.0 else free
        stroke += STEP * speed
        fastest = max(fastest, speed)
    assert fastest == pytest.approx(FLOW / PISTON, rel=0.03)


def test_against_a_wall_the_target_stays_within_the_drive_s_reach() -> None:
    """Else it would have run away, and the slide would jump when the wall gives way."""
    hydraulics = Hydraulics(machine())
    for _ in range(2000):
        targets = hydraulics.step({"boom": 1.0}, REST, STEP)
    assert targets["boom_slide"] == pytest.approx(PRESSURE * PISTON / 1e8)


@pytest.mark.parametrize(("implicit", "rate"), [(False, 1000.0), (True, 120.0)])
def test_drives_of_long_steps_reach_rated_speed_too(implicit: bool, rate: float) -> None:
    """Of an engine that pulls to where a slide is, and of one that pulls to where it will be: PhysX's reached a fifth
    of it at 120 Hz. Neither is ever given more than the relief's force."""
    seconds, stiffness, damping, mass = 1.0 / rate, 1e8, 1.8e6, 2e4
    drive = replace(slide("boom", (RING, PISTON)).drive, stiffness=stiffness, damping=damping)
    joint = replace(slide("boom", (RING, PISTON)), drive=drive)
    hydraulics = Hydraulics(machine(joints=(joint, *machine().joints[1:])), implicit=implicit)
    stroke, speed, fastest = -0.4, 0.0, 0.0
    for _ in range(round(0.8 * rate)):
        target = hydraulics.step({"boom": 1.0}, {**REST, "boom_slide": stroke}, seconds)["boom_slide"]
        ahead = seconds if implicit else 0.0
        inertia = mass + seconds * (damping + ahead * stiffness)
        speed = (mass * speed + seconds * stiffness * (target - stroke)) / inertia
        force = stiffness * (target - stroke - ahead * speed) - damping * speed
        assert force < 1.01 * PRESSURE * PISTON
        stroke, fastest = stroke + seconds * speed, max(fastest, speed)
    assert fastest == pytest.approx(FLOW / PISTON, rel=0.03)


@pytest.mark.parametrize(("implicit", "rate"), [(False, 1000.0), (True, 120.0)])
def test_what_has_gained_its_speed_takes_no_more_power_than_there_is(implicit: bool, rate: float) -> None:
    """A boom that goes at rated speed meets a load of nine tenths of its force: until the oil had slowed it, its drive
    did a seventh (at 1 kHz) to a third (at 120 Hz) more than the engine has."""
    seconds, stiffness, damping, mass, power = 1.0 / rate, 1e8, 1.8e6, 2e4, 50e3
    drive = replace(slide("boom", (RING, PISTON)).drive, stiffness=stiffness, damping=damping)
    joint = replace(slide("boom", (RING, PISTON)), drive=drive)
    hydraulics = Hydraulics(machine(joints=(joint, *machine().joints[1:])), implicit=implicit, power=power)
    stroke, speed, force, most = -0.4, 0.0, 0.0, 0.0
    for step in range(round(0.8 * rate)):
        load = 0.9 * PRESSURE * PISTON if step > 0.5 * rate else 0.0
        known = {**REST, "boom_slide": stroke}
        target = hydraulics.step({"boom": 1.0}, known, seconds, forces={"boom_slide": force})["boom_slide"]
        ahead = seconds if implicit else 0.0
        inertia = mass + seconds * (damping + ahead * stiffness)
        speed = (mass * speed + seconds * (stiffness * (target - stroke) - load)) / inertia
        force = stiffness * (target - stroke - ahead * speed) - damping * speed
        stroke, most = stroke + seconds * speed, max(most, force * speed)
    assert most < 1.1 * power
    assert speed == pytest.approx(power / (0.9 * PRESSURE * PISTON), rel=0.05), "and goes on with what there is"


def test_a_cylinder_is_slowed_before_its_end() -> None:
    """Evenly over its cushion, else a machine jolts; it arrives all the same."""
    strokes, speeds = dict(REST), []
    hydraulics = Hydraulics(machine())
    for _ in range(3000):
        before = strokes["boom_slide"]
        strokes = hydraulics.step({"boom": 1.0}, strokes, STEP)
        speeds.append((strokes["boom_slide"] - before) / STEP)
    rated, moving = FLOW / PISTON, [speed for speed in speeds if speed > 0.0]
    slowing = -np.diff(moving[int(np.argmax(speeds)) :]) / STEP
    assert max(moving) == pytest.approx(rated) and moving[-1] < 0.15 * rated
    assert slowing[:-2].max() == pytest.approx(rated**2 / (2.0 * CUSHION), rel=0.1)
    assert strokes["boom_slide"] == 0.5


def test_strokes_end() -> None:
    assert run(Hydraulics(machine()), {"boom": 1.0}, 3.0)["boom_slide"] == 0.5


def test_what_it_does_not_have_is_said() -> None:
    with pytest.raises(KeyError, match="'swing' has no cylinder here"):
        Hydraulics(machine()).step({"swing": 1.0}, REST, STEP)
    with pytest.raises(YellowironError, match="rated speed"):
        Hydraulics(machine(cylinders=()))
