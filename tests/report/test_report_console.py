"""What a terminal shows."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np
from rich.console import Console

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Measurement
from yellowiron.report import alignment_table, measurement_table, simulation_table


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


def test_what_to_review_stands_with_its_reason_the_most_doubtful_first() -> None:
    alignment = Alignment(
        "excavator",
        np.eye(4),
        (
            PartAssignment("plate", "boom", "boom", 0.4, "touches boom alone", runner_up="arm"),
            PartAssignment("beam", "boom", "boom", 0.99, "3 of 3 joints"),
            PartAssignment("stub", "arm_pin", "arm", 0.2, "nearest to arm"),
        ),
        missing=("bucket", "bucket_pin"),
        to_review=("plate", "bucket", "bucket_pin", "arm_pin", "stub"),
        findings=(
            Finding("ALN001", "warning", "bucket", "No part plays bucket"),
            Finding("ALN014", "warning", "model", "The model is in inches"),
        ),
    )
    text = drawn(alignment_table(alignment))
    review = text[text.index("To review") : text.index("No part plays")]
    assert review.index("arm_pin") < review.index("plate")
    assert "touches boom alone" in review and "bucket" not in review
    assert text.count("bucket_pin") == 1, "a role that no part plays is told once"
    assert "ALN014" in text and "ALN001" not in text
