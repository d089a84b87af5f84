"""What a terminal shows."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from rich.console import Console

from yellowiron.model.mechanism import Measurement
from yellowiron.report import measurement_table, simulation_table


def drawn(renderable: Any) -> str:
    console = Console(width=160)
    with console.capture() as captured:
        console.print(renderable)
    return captured.get()


def test_a_zero_has_no_minus() -> None:
    found = [
        Measurement("A", "A", 2.0, 2.0 - 1e-9, "m", -5e-8, "checked"),
        Measurement("B", "B", 2.0, 2.0 - 1e-9, "rad", None, "checked"),
        Measurement("C", "C", 2.0, 1.9, "m", -5.0, "checked"),
    ]
    shown = drawn(measurement_table([asdict(m) for m in found]))
    assert "-0.000" not in shown and shown.count("+0.000") == 2
    assert "-5.000 %" in shown


def test_joints_of_one_actuator_are_told_apart() -> None:
    wheel = {
        "actuator": "drive", "reached_low": 0.0, "reached_high": 0.0, "stroke": 0.0, "speed": 12.0,
        "final_error_percent": 0.0, "unit": "rad",
    }  # fmt: skip
    lift = {**wheel, "actuator": "boom", "joint": "lift_joint", "reached_high": 0.5, "stroke": 0.52, "unit": "m"}
    hinge = {**lift, "actuator": "arm", "unit": "rad"}
    document = {
        "engine": "mujoco", "version": "4", "base": "fixed", "dt_s": 0.001, "payload_kg": 0.0, "steps_per_second": 1,
        "pin_error_mm": 0.0, "angle_error_deg": 0.0, "branches_kept": True, "findings": [],
        "actuators": [lift, hinge, {**wheel, "joint": "left_joint"}, {**wheel, "joint": "right_joint"}],
    }  # fmt: skip
    shown = drawn(simulation_table(document))
    assert "drive, left_joint" in shown and "drive, right_joint" in shown
    assert "lift_joint" not in shown
    assert "500 mm" in shown and "28.648 °" in shown  # a hinge driven without its cylinder moves by an angle
