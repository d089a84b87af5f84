"""The wheel loader example in MuJoCo, against the bars."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation import rated_payload, simulate
from yellowiron.simulation.driving.wheeled import drive
from yellowiron.simulation.engine import Base
from yellowiron.usd import read_mechanism

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def loader(wheel_loader: Path) -> Mechanism:
    return read_mechanism(wheel_loader)


@pytest.mark.parametrize(("base", "bar"), [("fixed", 5e-5), ("floating", 1e-4)])
def test_full_strokes_with_the_rated_payload(wheel_loader: Path, loader: Mechanism, base: Base, bar: float) -> None:
    payload = rated_payload(loader)
    assert payload.mass > 5000.0
    result = simulate(wheel_loader, engine="mujoco", base=base, payload_kg=payload.mass, payload_source=payload.source)
    assert result.completed and result.branches_kept and len(result.branches) == 6
    assert result.pin_error <= bar
    assert result.angle_error <= math.radians(0.01)
    assert not result.findings, result.findings


def test_it_drives_turns_and_climbs(wheel_loader: Path) -> None:
    result = drive(wheel_loader, engine="mujoco")
    assert result.forward == pytest.approx(5.0, rel=0.03)
    assert result.backward == pytest.approx(5.0, rel=0.03)
    assert result.lock is not None and math.degrees(result.lock) == pytest.approx(40.0, abs=1.0)
    assert result.turning_radius == pytest.approx(result.geometry_radius, rel=0.05)
    assert result.axle_angle == pytest.approx(result.axle_geometry, rel=0.05)
    assert result.highest_wheel is not None and result.highest_wheel < 0.02
