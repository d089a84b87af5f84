"""The forklift example in engines: its rams, chains and ties under the rated load, and what its cylinders can lift."""

from __future__ import annotations

from pathlib import Path

import in_engines
import pytest

from kit.builds import MadeOnce
from kit.machines.drawn_examples import build_example
from kit.machines.forklifts import SHEET, drawn
from yellowiron.simulation import rated_payload, run_tests, simulate
from yellowiron.simulation.registry import import_engine
from yellowiron.usd import read_mechanism

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def file(made_once: MadeOnce) -> Path:
    return build_example("forklift", drawn("simplex", made_once), made_once, named=True, sheet=SHEET).machine.usd


@pytest.mark.parametrize(
    ("engine", "actuators"),
    [("mujoco", ["tilt", "steering"]), ("physx", ["lift", "tilt", "steering"])],
)
def test_full_strokes_with_the_rated_load(file: Path, engine: str, actuators: list[str]) -> None:
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    payload = rated_payload(read_mechanism(file))
    assert payload.mass == pytest.approx(7000.0)
    result = simulate(file, engine=engine, payload_kg=payload.mass, actuators=actuators)
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


def test_its_cylinders_lift_what_it_is_rated_for(file: Path) -> None:
    """The truck tips where its sheet's axle loads say: 7 t take 3400 of 5200 kg off the rear axle, 10.7 t all of it.
    The relief pressure lets through less than half as much again: two rams of 80 mm at 19.1 MPa hold 9.3 t on the chain
    with the carriage and the inner mast."""
    tipping, rated, more = run_tests(file, engine="mujoco")
    assert tipping.engine_value == pytest.approx(tipping.statics_value, rel=0.02)
    assert tipping.engine_value == pytest.approx(5200.0 * 7000.0 / (5200.0 - 1800.0), rel=0.05)
    assert rated.engine_value == pytest.approx(1.0) and more.engine_value == pytest.approx(0.0, abs=0.02)
