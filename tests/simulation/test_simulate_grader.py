"""The grader example in engines: all its cylinders over their strokes, and how it drives."""

from __future__ import annotations

from pathlib import Path

import in_engines
import pytest

from kit.builds import MadeOnce
from kit.machines.drawn_examples import built_example
from yellowiron.simulation import drive, simulate
from yellowiron.simulation.registry import import_engine

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def file(made_once: MadeOnce) -> Path:
    return built_example("grader", made_once)


@pytest.mark.parametrize(
    ("engine", "actuators"),
    [("mujoco", None), ("newton", ["blade_lift_left", "blade_lift_right", "centre_shift"]), ("physx", None)],
)
def test_full_strokes(file: Path, engine: str, actuators: list[str] | None) -> None:
    """Measured: 3, 3 and 90 µm."""
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    result = simulate(file, engine=engine, actuators=actuators, base="fixed")
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


def test_it_drives_straight(file: Path) -> None:
    """On its tandems, whose wheels follow each other by their chains."""
    result = drive(file, engine="mujoco")
    assert result.forward == pytest.approx(5.0, rel=0.01) and result.backward == pytest.approx(5.0, rel=0.01)
    assert result.sideways < 0.05 and abs(result.sunk) < 0.01
