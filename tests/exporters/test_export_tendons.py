"""Cylinders as tendons: fewer bodies, the same mass, the same strokes, the same poses."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from yellowiron.exporters import export_mjcf, unsaid, with_tendons
from yellowiron.kinematics import ClosedChain
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.sensor import Sensor


@pytest.fixture(scope="module")
def tendons_file(usd_file: Path, mechanism: Mechanism, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export_mjcf(mechanism, usd_file, tmp_path_factory.mktemp("tendons"), base="fixed", cylinders="tendons")


def test_halves_go_and_their_mass_stays(mechanism: Mechanism) -> None:
    reduced, tendons = with_tendons(mechanism)
    assert [t.slide.name for t in tendons] == [c.slide for c in mechanism.cylinders if not c.passive]
    halves = {half for c in mechanism.cylinders for half in (c.barrel, c.rod)}
    assert {b.name for b in reduced.bodies} == {b.name for b in mechanism.bodies} - halves
    for one in (mechanism, reduced):
        assert {j.body1 for j in one.joints if not j.cut} | {one.root} == {b.name for b in one.bodies}

    def moments(one: Mechanism) -> tuple[float, np.ndarray]:
        mass = sum(b.mass for b in one.bodies)
        return mass, sum((b.mass * np.asarray(b.center_of_mass) for b in one.bodies), np.zeros(3)) / mass

    (before, center), (after, now) = moments(mechanism), moments(reduced)
    assert after == pytest.approx(before, rel=1e-12)
    # Off the cylinders' own lines their halves' centres are not on them.
    assert np.linalg.norm(now - center) < 2e-3
    for body in reduced.bodies:
        values = np.linalg.eigvalsh(np.asarray(body.inertia))
        assert values[0] > 0.0 and values[0] + values[1] >= values[2] * (1.0 - 1e-9)


def test_a_cylinder_without_pins_stays(mechanism: Mechanism) -> None:
    first = replace(mechanism.cylinders[0], barrel_joint=None, rod_joint=None)
    ram = replace(mechanism, cylinders=(first, *mechanism.cylinders[1:]))
    reduced, tendons = with_tendons(ram)
    assert first.slide not in {t.slide.name for t in tendons}
    assert {first.barrel, first.rod} <= {b.name for b in reduced.bodies}
    assert any(first.name in words for words in unsaid(ram, to="mjcf-tendons"))


def test_pins_off_the_line_keep_their_cylinder(mechanism: Mechanism) -> None:
    first = mechanism.cylinders[0]
    joints = []
    for joint in mechanism.joints:
        if joint.name == first.rod_joint:
            joint = replace(joint, anchor=tuple(np.add(joint.anchor, (0.0, 0.0, 0.05))))
        joints.append(joint)
    _, tendons = with_tendons(replace(mechanism, joints=tuple(joints)))
    assert first.slide not in {t.slide.name for t in tendons}


def test_the_pin_of_three_holds_the_two_that_are_left(mechanism: Mechanism) -> None:
    cylinder = mechanism.cylinders[0]
    pin = mechanism.joint(cylinder.rod_joint or "")
    body = mechanism.bodies[-1]
    third = replace(body, name="third")
    on_rod = replace(pin, name="third_joint", body0=cylinder.rod, body1="third", cut=False)
    machine = replace(mechanism, bodies=(*mechanism.bodies, third), joints=(*mechanism.joints, on_rod))
    reduced, _ = with_tendons(machine)
    joint = reduced.joint("third_joint")
    assert {joint.body0, joint.body1} == {"third", pin.body1 if pin.body0 == cylinder.rod else pin.body0}


def test_full_strokes_end_where_the_machine_does(tendons_file: Path, mechanism: Mechanism) -> None:
    model = mujoco.MjModel.from_xml_path(str(tendons_file))
    assert model.nv < len([j for j in mechanism.joints if not j.cut and j.type != "fixed"])
    chain = ClosedChain(mechanism)
    reduced, tendons = with_tendons(mechanism)
    lengths = {t.slide.name: t.length for t in tendons}
    for actuator in mechanism.actuators:
        if actuator.kind != "cylinder":
            continue
        entry = actuator.joints[0]
        slide = mechanism.joint(entry.joint)
        assert slide.lower is not None and slide.upper is not None
        for end in (slide.lower, slide.upper):
            data = mujoco.MjData(model)
            data.ctrl[model.actuator(actuator.name).id] = entry.sign * end
            mujoco.mj_step(model, data, round(8.0 / model.opt.timestep))
            strokes = {name: float(data.ten_length[model.tendon(name).id]) - lengths[name] for name in lengths}
            assert strokes[slide.name] == pytest.approx(end, abs=0.01 * (slide.upper - slide.lower))
            state, _ = chain.reach(strokes, start=chain.drawn)
            for body in reduced.bodies:
                moved = (chain.displacement(state, body.name) @ np.append(body.origin, 1.0))[:3]
                if body.name in {j.body1 for loop in mechanism.loops for j in map(mechanism.joint, loop.joints)}:
                    assert np.linalg.norm(data.body(body.name).xpos - moved) < 5e-5  # m


def test_sensors_of_a_cylinder_read_its_tendon(usd_file: Path, mechanism: Mechanism, tmp_path: Path) -> None:
    cylinder = next(c for c in mechanism.cylinders if not c.passive)
    sensors = (
        Sensor("length", "cylinder_encoder", joint=cylinder.slide, cylinder=cylinder.name, parameters={}),
        Sensor("pressure", "cylinder_pressure", joint=cylinder.slide, cylinder=cylinder.name, parameters={}),
    )
    machine = replace(mechanism, sensors=sensors)
    path = export_mjcf(machine, usd_file, tmp_path, base="fixed", cylinders="tendons")
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    length = next(t.length for t in with_tendons(mechanism)[1] if t.slide.name == cylinder.slide)
    assert data.sensor("length").data[0] == pytest.approx(length, abs=1e-9)
    assert model.sensor("pressure").type[0] == mujoco.mjtSensor.mjSENS_TENDONACTFRC
