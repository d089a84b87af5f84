"""Sensors on the hand-made crane: every mount, and what happens where it is not there."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from mechanism_machine import frame_along, machine, specifications, template

from yellowiron.mechanism import build_mechanism
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.sensor import PARAMETERS, Sensor, SensorTemplate


def build(*entries: SensorTemplate, **changes: Any) -> Mechanism:
    made = machine(**changes)
    return build_mechanism(made[0], template(sensors=entries), made[1], specifications(), name="crane")


def place(kind: str = "imu", **mount: Any) -> Sensor:
    (sensor,) = build(SensorTemplate("s", kind, mount)).sensors  # type: ignore[arg-type]
    return sensor


def test_at_a_position_in_the_machine_frame() -> None:
    sensor = place(role="arm", position=(1.0, 0.2, 3.0), offset=(0.0, 0.0, 0.5))
    assert (sensor.body, sensor.position) == ("arm", (1.0, 0.2, 3.5))
    assert (sensor.x_axis, sensor.z_axis) == ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0))


def test_the_cad_frame_does_not_matter() -> None:
    entry = SensorTemplate("s", "imu", {"role": "arm", "at": (0.1, 0.5, 0.5), "on": "top"})
    (first,), (second,) = (build(entry, frame=f).sensors for f in (None, frame_along((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))))
    assert second.position == pytest.approx(first.position, abs=2e-6)


def test_by_shares_of_a_roles_parts() -> None:
    """A pin role is its own parts only; a body's role is all that moves with it."""
    assert place(role="arm_pin").position == pytest.approx((0.0, 0.0, 1.0), abs=1e-6)
    assert place(role="arm_pin").body == "base"
    assert place(role="arm", at=(1.0, 0.5, 0.0)).position[0] == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("side", "axis", "end"), [("top", 2, 1.05), ("left", 1, 0.25), ("right", 1, -0.25), ("front", 0, 2.0)]
)
def test_out_to_the_surface(side: str, axis: int, end: float) -> None:
    sensor = place(role="arm", at=(0.25, 0.5, 0.5), on=side)
    assert sensor.position[axis] == pytest.approx(end)


def test_orientation_is_roll_pitch_yaw() -> None:
    down = place(role="arm", orientation=(0.0, math.pi / 6, 0.0))
    assert down.x_axis == pytest.approx((math.cos(math.pi / 6), 0.0, -0.5))
    left = place(role="arm", orientation=(0.0, 0.0, math.pi / 2))
    assert left.x_axis == pytest.approx((0.0, 1.0, 0.0))
    assert np.dot(down.x_axis, down.z_axis) == pytest.approx(0.0, abs=1e-12)


def test_on_a_site() -> None:
    built = build(SensorTemplate("s", "camera", {"site": "tip"}))
    (site,), (sensor,) = built.sites, built.sensors
    assert (sensor.body, sensor.x_axis, sensor.z_axis) == (site.body, site.x_axis, site.z_axis)
    assert sensor.position == pytest.approx(site.position, abs=1e-6)


def test_on_joints_and_cylinders() -> None:
    built = build(
        SensorTemplate("angle", "joint_encoder", {"joint": "base2arm"}),
        SensorTemplate("stroke", "cylinder_encoder", {"cylinder": "slide"}),
        SensorTemplate("pressure", "cylinder_pressure", {"actuator": "lift"}, {"maximum": 4e7}),
    )
    (cylinder,) = built.cylinders
    assert [(s.name, s.joint, s.cylinder, s.body) for s in built.sensors] == [
        ("angle", "base2arm", "", ""),
        ("stroke", "slide", cylinder.name, ""),
        ("pressure", "slide", cylinder.name, ""),
    ]
    defaults = {key: p.default for key, p in PARAMETERS["cylinder_pressure"].items()}
    assert built.sensors[2].parameters == {**defaults, "maximum": 4e7}


@pytest.mark.parametrize(
    ("kind", "mount"),
    [
        ("imu", {"role": "hook"}),
        ("camera", {"site": "nose"}),
        ("joint_encoder", {"joint": "base2hook"}),
        ("cylinder_encoder", {"cylinder": "base2arm"}),
        ("cylinder_pressure", {"actuator": "dig"}),
    ],
)
def test_a_mount_that_is_not_there_is_left_out_aloud(kind: str, mount: dict[str, Any]) -> None:
    built = build(SensorTemplate("s", kind, mount))  # type: ignore[arg-type]
    assert not built.sensors
    assert [f.where for f in built.findings if f.code == "MEC060"] == ["s"]


def test_parts_that_are_missing_take_their_sensor_along() -> None:
    assembly, alignment = machine()
    parts = tuple(replace(a, role=None, body=None) if a.role in ("arm", "rod_pin") else a for a in alignment.parts)
    plan = template(sensors=(SensorTemplate("s", "imu", {"role": "arm"}),))
    built = build_mechanism(assembly, plan, replace(alignment, parts=parts), specifications(), name="crane")
    assert not built.sensors
