"""The wheeled excavator example in engines: strokes, driving and steering, its bucket's force and what it lifts."""

from __future__ import annotations

import math
from pathlib import Path

import in_engines
import pytest

from kit.builds import MadeOnce
from kit.machines.drawn_examples import built_example
from yellowiron.simulation import drive, run_tests, simulate
from yellowiron.simulation.driving.result import driving_findings
from yellowiron.simulation.registry import import_engine

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def file(made_once: MadeOnce) -> Path:
    return built_example("wheeled_excavator", made_once)


# Its boom, arm and bucket in the other engines: the excavator's; its steering, with two tie rods, in Newton here alone.
@pytest.mark.parametrize(
    ("engine", "actuators"), [("mujoco", None), ("newton", ["steering"]), ("physx", ["steering", "stabilizer_left"])]
)
def test_full_strokes(file: Path, engine: str, actuators: list[str] | None) -> None:
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    result = simulate(file, engine=engine, actuators=actuators)
    assert result.base == "fixed" and result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


def test_it_drives_on_all_wheels_and_turns_about_one_point(file: Path) -> None:
    """Its tyres, far from their kingpins, hold the steering back from its lock by some degrees."""
    result = drive(file, engine="mujoco")
    in_engines.assert_straight(result)
    assert result.lock is not None and math.radians(34.0) < result.lock < math.radians(42.0)
    assert result.turning_radius == pytest.approx(result.geometry_radius, rel=0.02)
    assert list(driving_findings(result)) == []


def test_it_digs_with_the_force_that_is_printed_and_lifts_its_heaped_bucket(file: Path) -> None:
    figures = {
        f.test.name: f for f in run_tests(file, engine="mujoco", names=["Bucket Digging Force", "Bucket Payload"])
    }
    force = figures["Bucket Digging Force"]
    assert force.engine_value == pytest.approx(102e3, rel=0.03)
    assert force.statics_value == pytest.approx(force.engine_value, rel=0.01)
    assert figures["Bucket Payload"].arrived
