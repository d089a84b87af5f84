"""The dozer example in engines: all its cylinders over their strokes, and how it drives."""

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
    return built_example("dozer", made_once)


@pytest.mark.parametrize(
    ("engine", "actuators"), [("mujoco", None), ("newton", ["blade_tilt", "blade_angle"]), ("physx", None)]
)
def test_full_strokes(file: Path, engine: str, actuators: list[str] | None) -> None:
    """Measured: 4, 8 and 210 µm."""
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    result = simulate(file, engine=engine, actuators=actuators, base="fixed")
    assert result.completed and result.branches_kept and len(result.branches) == 6
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


def test_it_drives_straight(file: Path) -> None:
    """At a top speed that it does not reach on the way: it was told 5 % more than it was measured against."""
    result = drive(file, engine="mujoco")
    assert result.forward == pytest.approx(2.0, rel=0.01) and result.backward == pytest.approx(2.0, rel=0.01)
    assert result.sideways < 0.05 and abs(result.sunk) < 0.01
