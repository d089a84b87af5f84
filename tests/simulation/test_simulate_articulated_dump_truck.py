"""The articulated dump truck example in engines: strokes on the ground, the body tipped with the rated load, driving
and bending."""

from __future__ import annotations

import math
from pathlib import Path

import in_engines
import pytest

from kit.builds import MadeOnce
from kit.machines.drawn_examples import built_example
from yellowiron.simulation import drive, rated_payload, run_tests, simulate
from yellowiron.simulation.driving.result import driving_findings
from yellowiron.simulation.registry import import_engine
from yellowiron.usd import read_mechanism

pytestmark = pytest.mark.slow
PAYLOAD = 36_300.0


@pytest.fixture(scope="module")
def file(made_once: MadeOnce) -> Path:
    return built_example("articulated_dump_truck", made_once)


# Its steering, on the ground too, in PhysX: the wheel loader's; its hoist in PhysX: below, loaded.
@pytest.mark.parametrize(
    ("engine", "payload", "actuators"),
    [("mujoco", 0.0, None), ("mujoco", PAYLOAD, ["hoist"]), ("newton", 0.0, ["hoist"])],
)
def test_full_strokes(file: Path, engine: str, payload: float, actuators: list[str] | None) -> None:
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    assert rated_payload(read_mechanism(file)).mass == pytest.approx(PAYLOAD)
    result = simulate(file, engine=engine, payload_kg=payload, actuators=actuators)
    assert result.base == "floating"  # in the air the trailer would roll over
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


@pytest.mark.parametrize("engine", ["mujoco", "physx"])
def test_loaded_it_is_not_bent_and_tipped_at_once(file: Path, engine: str) -> None:
    """It falls over then, by statics; lever by lever it holds its pins."""
    in_engines.need(engine)
    import_engine(engine)
    result = simulate(file, engine=engine, payload_kg=PAYLOAD)
    assert [(f.code, f.severity, f.where) for f in result.findings] == [("SIM011", "info", "together")]
    assert [p.name for p in result.phases] == ["settle", "steering", "hoist", "drive"]
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


@pytest.mark.parametrize("payload", [0.0, PAYLOAD])
def test_it_drives_and_bends(file: Path, payload: float) -> None:
    """Two axles behind each other scrub; by dry friction the rear one does not, and that is where it turns about. One
    wheel of the left beam on the block turns the beam."""
    result = drive(file, engine="mujoco", payload_kg=payload)
    in_engines.assert_straight(result)
    assert result.lock is not None and result.lock == pytest.approx(math.radians(45.0), rel=0.01)
    front, rear, tread = 0.99846, 4.0965, 2.68
    radius = (front * math.cos(result.lock) + rear) / math.sin(result.lock) + tread / 2
    assert result.geometry_radius == pytest.approx(radius, rel=0.01)
    assert result.turning_radius == pytest.approx(radius, rel=0.03)
    assert result.axle_angle == pytest.approx(result.axle_geometry, rel=0.05)
    assert list(driving_findings(result)) == []


def test_it_tips_what_it_is_rated_for(file: Path) -> None:
    figures = {f.test.name: f for f in run_tests(file, engine="mujoco")}
    for name, published in (("Body Raise Time", 11.9), ("Body Lower Time", 7.6)):
        assert figures[name].engine_value == pytest.approx(published, rel=0.03), name
        assert figures[name].statics_value == pytest.approx(published, rel=0.01), name
    assert figures["Rated Payload"].arrived and not figures["Twice the Rated Payload"].arrived
