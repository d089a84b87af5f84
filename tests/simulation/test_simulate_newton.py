"""Newton on our USD, against the bars; skipped where newton is not installed."""

from __future__ import annotations

from pathlib import Path

import pytest
from in_engines import installed

from yellowiron.simulation import rated_payload, simulate
from yellowiron.simulation.driving.wheeled import drive
from yellowiron.simulation.engine import Base
from yellowiron.usd import read_mechanism

pytestmark = [pytest.mark.slow, installed("newton")]


@pytest.mark.parametrize(("base", "actuator"), [("fixed", "steering"), ("floating", "bucket")])
def test_full_strokes_with_the_rated_payload(wheel_loader: Path, base: Base, actuator: str) -> None:
    payload = rated_payload(read_mechanism(wheel_loader))
    result = simulate(wheel_loader, engine="newton", base=base, payload_kg=payload.mass, actuators=[actuator])
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings


def test_it_drives_turns_and_climbs(wheel_loader: Path) -> None:
    result = drive(wheel_loader, engine="newton")
    assert result.forward == pytest.approx(5.0, rel=0.03)
    assert result.backward == pytest.approx(5.0, rel=0.03)
    assert result.turning_radius == pytest.approx(result.geometry_radius, rel=0.05)
    assert result.axle_angle == pytest.approx(result.axle_geometry, rel=0.05)
    assert result.highest_wheel is not None and result.highest_wheel < 0.02


def test_the_small_loader(usd_file: Path) -> None:
    result = simulate(usd_file, engine="newton", base="floating", actuators=["boom"])
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings
