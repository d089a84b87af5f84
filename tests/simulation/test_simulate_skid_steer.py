"""The skid steer example in engines: its strokes with and without the rated load, what it lifts, and how it drives with
its two sides."""

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


@pytest.fixture(scope="module")
def file(made_once: MadeOnce) -> Path:
    return built_example("skid_steer", made_once, "vertical")


@pytest.mark.parametrize("engine", ["mujoco", "physx"])
def test_full_strokes(file: Path, engine: str) -> None:
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    assert rated_payload(read_mechanism(file)).mass == pytest.approx(1300.0)
    result = simulate(file, engine=engine, payload_kg=1300.0)
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


@pytest.mark.parametrize("engine", ["mujoco", "newton", "physx"])
def test_it_drives_and_turns_with_its_two_sides(file: Path, engine: str) -> None:
    """Tyres that stand behind each other scrub: with 70 % of its weight on its rear ones friction leaves 28.6° of 45°
    for as far as they roll, more than under equal loads. With MuJoCo's own contacts they hop, and it turns by 13°."""
    in_engines.need(engine)
    import_engine(engine)
    result = drive(file, engine=engine)
    in_engines.assert_straight(result)
    assert result.turning_radius is None and result.spin_geometry == pytest.approx(math.radians(28.6), rel=0.01)
    assert result.spin == pytest.approx(result.spin_geometry, abs=math.radians(4.5))
    assert not list(driving_findings(result))


def test_it_lifts_what_it_is_rated_for(file: Path) -> None:
    figures = {f.test.name: f for f in run_tests(file, engine="mujoco")}
    tipping = figures["Tipping Load"]
    assert tipping.engine_value == pytest.approx(tipping.statics_value, rel=0.02)
    assert 2.0 * 1300.0 < tipping.engine_value < 2.5 * 1300.0
    assert figures["Breakout Force"].engine_value == pytest.approx(figures["Breakout Force"].statics_value, rel=0.05)
    assert figures["Rated Operating Capacity"].arrived
    assert not figures["Two and a Half Times the Rated Operating Capacity"].arrived
