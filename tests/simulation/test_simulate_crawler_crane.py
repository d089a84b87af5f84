"""The crawler crane example in engines: all its levers over their strokes, rated loads hauled in at three radii, where
it tips."""

from __future__ import annotations

import importlib
import math
from pathlib import Path
from types import ModuleType

import pytest
from in_engines import installed

from kit.builds import MadeOnce
from kit.machines.drawn_examples import built_example
from yellowiron.simulation import ChartLoad, chart_stability, chart_tests, chart_tipping, run_tests, simulate

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def file(made_once: MadeOnce) -> Path:
    return built_example("crawler_crane", made_once, "working")


@pytest.fixture(scope="module")
def values() -> ModuleType:
    return importlib.import_module("crawler_crane.values")


def test_full_strokes(file: Path) -> None:
    result = simulate(file, engine="mujoco")
    assert result.completed and result.branches_kept and not result.findings, result.findings
    assert result.pin_error < 5e-5
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


@pytest.mark.parametrize("engine", ["mujoco", pytest.param("physx", marks=installed("physx"))])
def test_it_tips_where_statics_says(file: Path, engine: str) -> None:
    """Its tracks' ends are a little off the ground, so that it rocks by a tenth of a degree before it tips: that was
    taken for tipping (45 and 73 % too early)."""
    (tipping,) = run_tests(file, engine=engine, names=["Tipping Load at Maximum Radius"])
    assert tipping.engine_value is not None and tipping.statics_value is not None
    assert tipping.engine_value == pytest.approx(tipping.statics_value, rel=0.02)


@pytest.mark.parametrize("engine", ["mujoco", pytest.param("physx", marks=installed("physx"))])
def test_over_its_side_it_tips_about_the_middle_of_a_track(file: Path, engine: str) -> None:
    """It is weakest there. Statics had it stand on its shoes' outer edges, which touch nothing in the file."""
    row = ChartLoad(10.0, 6.0, 20_000.0)
    (weakest,) = chart_stability(file, [row], slewed=None)
    assert abs(weakest.slewed) == pytest.approx(math.pi / 2)
    (tipping,) = run_tests(file, engine=engine, tests=chart_tipping(file, [row], slewed=None))
    assert tipping.engine_value is not None and tipping.statics_value is not None
    assert tipping.engine_value == pytest.approx(tipping.statics_value, rel=0.02)


def test_rated_loads_are_hauled_in_at_three_radii_and_are_stable(file: Path, values: ModuleType) -> None:
    rows = [ChartLoad(10.0, radius, load) for radius, load in values.RATED.items()]
    figures = run_tests(file, engine="mujoco", tests=chart_tests(file, rows))
    assert len(figures) == 3 and all(figure.arrived for figure in figures), figures
    for figure in chart_stability(file, rows):
        assert figure.tips_at is not None and figure.tips_at > 1.27 * figure.row.load, figure
    (other,) = chart_stability(file, [ChartLoad(20.0, 6.0, 1000.0)])
    assert other.tips_at is None and "its boom is 10.00 m long, not 20 m" in other.reason
