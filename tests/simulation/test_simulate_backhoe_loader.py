"""The backhoe loader example in engines: strokes, driving and steering, breakout forces."""

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
    return built_example("backhoe_loader", made_once)


# In the other engines what no other machine has: two cylinders that swing a boom against each other.
@pytest.mark.parametrize(
    ("engine", "actuators"), [("mujoco", None), ("newton", ["backhoe_swing"]), ("physx", ["backhoe_swing"])]
)
def test_full_strokes(file: Path, engine: str, actuators: list[str] | None) -> None:
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    result = simulate(file, engine=engine, actuators=actuators)
    assert result.base == "fixed" and result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


def test_it_drives_on_its_rear_wheels_and_steers_with_the_front_ones(file: Path) -> None:
    result = drive(file, engine="mujoco")
    in_engines.assert_straight(result)
    assert result.lock is not None and math.radians(38.0) < result.lock < math.radians(43.0)
    assert result.turning_radius == pytest.approx(result.geometry_radius, rel=0.02)
    assert list(driving_findings(result)) == []


def test_it_breaks_out_what_its_maker_prints(file: Path) -> None:
    figures = {f.test.name: f for f in run_tests(file, engine="mujoco")}
    for name, printed, bar in (("Loader Breakout Force", 58.9e3, 0.05), ("Bucket Digging Force", 55.9e3, 0.02)):
        assert figures[name].engine_value == pytest.approx(printed, rel=bar), name
        assert figures[name].statics_value == pytest.approx(figures[name].engine_value, rel=0.03), name
    assert figures["Dipper Digging Force"].statics_value == pytest.approx(29.5e3, rel=0.05)
    assert figures["Heaped Loader Bucket"].arrived
