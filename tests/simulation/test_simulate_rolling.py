"""Wheels roll while a machine steers on the spot."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation import rated_payload, simulate
from yellowiron.simulation.commands import motions
from yellowiron.simulation.driving.rolling import axle_speeds, rolling
from yellowiron.simulation.strokes.comparison import Comparison
from yellowiron.usd import read_mechanism


def test_an_articulated_machine_bends_in_the_middle() -> None:
    """Front and rear frame each turn by half the angle between them, one each way, and no wheel slides."""
    length, half, rate = 1.7, 1.2, 0.4
    middles = np.array([[x, y] for x in (length, -length) for y in (half, -half)])
    turning = np.column_stack([-middles[:, 1], middles[:, 0]])
    drift = np.where(middles[:, :1] > 0.0, rate * turning, 0.0)
    axes, ahead = np.tile([0.0, 1.0], (4, 1)), np.tile([1.0, 0.0], (4, 1))
    front, rear = -0.5 * rate * half, 0.5 * rate * half
    assert axle_speeds(drift, axes, ahead, turning) == pytest.approx([front, -front, rear, -rear])


def test_what_moves_no_wheel_turns_none(mechanism: Mechanism) -> None:
    chain, moves = Comparison(mechanism).chain, motions(mechanism)
    targets = {move.joint: np.linspace(0.0, 0.01, 50) for move in moves if move.position}
    assert rolling(chain, (), moves, targets, 0.01) == {}


@pytest.mark.slow
def test_a_loaded_loader_follows_its_steering_on_the_ground(wheel_loader: Path) -> None:
    """With its wheels held still its cylinder would fall 80 mm behind, at the limit of its force."""
    payload = rated_payload(read_mechanism(wheel_loader)).mass
    result = simulate(wheel_loader, engine="mujoco", base="floating", payload_kg=payload, actuators=["steering"])
    (steering,) = result.actuators
    assert steering.lag < 0.03 and not result.findings
    assert steering.fastest > 0.8 * steering.speed
