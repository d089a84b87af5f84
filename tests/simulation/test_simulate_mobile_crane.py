"""The mobile crane example in engines: all its actuators over their strokes, rated loads hauled in at three radii,
where it tips beside the maker's load chart, and how it drives."""

from __future__ import annotations

import importlib
import math
from pathlib import Path
from types import ModuleType

import in_engines
import pytest

from kit.builds import MadeOnce
from kit.machines.drawn_examples import built_example
from yellowiron.kinematics import attached
from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.model.errors import YellowironError
from yellowiron.simulation import (
    ChartLoad,
    chart_stability,
    chart_tests,
    chart_tipping,
    drive,
    read_load_chart,
    run_tests,
    simulate,
)
from yellowiron.simulation.machine_tests.statics import supports
from yellowiron.simulation.registry import import_engine
from yellowiron.usd import read_mechanism

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def file(made_once: MadeOnce) -> Path:
    return built_example("mobile_crane", made_once, "working")


@pytest.fixture(scope="module")
def values() -> ModuleType:
    return importlib.import_module("mobile_crane.values")


@pytest.mark.parametrize(
    ("engine", "actuators"),
    [("mujoco", None), ("newton", ["hoist"]), ("physx", ["hoist", "front_outrigger_jack_left"])],
)
def test_full_strokes(file: Path, engine: str, actuators: list[str] | None) -> None:
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    result = simulate(file, engine=engine, actuators=actuators)
    assert result.base == "fixed" and result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


def test_it_lifts_what_it_is_rated_for_and_no_more_than_its_winch_can(file: Path) -> None:
    figures = {f.test.name: f for f in run_tests(file, engine="mujoco")}
    assert figures["Rated Load at its Radius"].arrived
    assert figures["Twice the Rated Load"].engine_value == pytest.approx(0.0, abs=0.02)
    luffing = figures["Boom Luffing Time"]
    assert luffing.statics_value == pytest.approx(45.0, rel=0.003) and luffing.engine_value is not None
    assert luffing.engine_value == pytest.approx(45.0, rel=0.03)
    tipping = figures["Tipping Load, Boom All Out"]
    assert tipping.engine_value == pytest.approx(tipping.statics_value, rel=0.1)


@pytest.fixture(scope="module")
def chart(values: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> tuple[ChartLoad, ...]:
    """The maker's 13 loads that stability bounds, read from a file."""
    radii = sorted({r for row in values.CHART.values() for r in row})
    lines = [",".join(["radius", *map(str, values.CHART)])]
    for r in radii:
        loads = [values.CHART[n].get(r) for n in values.CHART]
        lines.append(",".join([str(r), *("" if one is None else f"{1000.0 * one:g}" for one in loads)]))
    path = tmp_path_factory.mktemp("chart") / "chart.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    return read_load_chart(path)


def test_it_tips_where_the_maker_s_chart_says_that_stability_bounds_it(
    file: Path, values: ModuleType, chart: tuple[ChartLoad, ...]
) -> None:
    """The chart is the maker's; the masses are ours, drawn so that they add up to its weight and give its stability.
    It has one load for all directions: of them the front is the weakest."""
    assert len(chart) == 13
    for figure in chart_stability(file, chart, slewed=None):
        assert figure.tips_at == pytest.approx(values.STABILITY * figure.row.load, rel=0.1), figure
        assert figure.slewed == 0.0
    out = chart_stability(file, [ChartLoad(30.5, 40.0, 100.0)])
    assert out[0].tips_at is None and "cannot be reached" in out[0].reason


def test_over_its_sides_it_tips_about_the_floats_of_that_side(file: Path) -> None:
    """By hand: moments about the line through one side's floats, on which alone the crane stands as it tips."""
    row = ChartLoad(23.45, 12.0, 5000.0)
    mechanism = attached(read_mechanism(file))
    slew = next(a.joints[0].joint for a in mechanism.actuators if a.name == "slew")
    bench = Bench(mechanism)
    length, radius = {"kind": "distance", "sites": ["boom_foot", "boom_head"]}, {"kind": "radius", "joint": slew}
    drawn = bench.pose(
        (
            {"solve": [{"actuator": "telescope", "quantity": length, "value": row.boom_length}]},
            {"solve": [{"actuator": "luffing", "quantity": {**radius, "site": "boom_head"}, "value": row.radius}]},
        )
    )
    axis = mechanism.joint(slew)
    found = {}
    for side in (1.0, -1.0):
        (figure,) = chart_stability(file, [row], slewed=side * math.pi / 2)
        state, _ = bench.chain.reach({slew: side * axis.axis[2] * math.pi / 2}, start=drawn)
        edge = max(side * float(p[1]) for _, p in supports(mechanism, bench.chain, state))
        placed = {b.name: bench.chain.displacement(state, b.name) @ [*b.center_of_mass, 1.0] for b in mechanism.bodies}
        holding = sum(b.mass * (edge - side * placed[b.name][1]) for b in mechanism.bodies)
        load = holding / (row.radius + side * axis.anchor[1] - edge)
        assert figure.tips_at is not None
        found[side] = figure.tips_at - load
        assert figure.tips_at > row.load
    # The mass that the figure counts besides is the hook's and its rope's.
    hanging = sum(b.mass for b in mechanism.bodies if b.name in ("hook_block", "hoist_rope"))
    assert [*found.values()] == pytest.approx([hanging, hanging], rel=0.01)


def test_in_an_engine_it_tips_where_the_chart_says_in_its_weakest_direction(
    file: Path, values: ModuleType, chart: tuple[ChartLoad, ...]
) -> None:
    """A load that grew too fast set it rocking, and it tipped at 0.87 of the chart's limit with its boom far out. By
    statics all of the chart is looked at, above."""
    chart = chart[::2]
    hanging = sum(b.mass for b in read_mechanism(file).bodies if b.name in ("hook_block", "hoist_rope"))
    figures = run_tests(file, engine="mujoco", tests=chart_tipping(file, chart, slewed=None))
    for row, figure in zip(chart, figures, strict=True):
        assert figure.engine_value is not None and figure.statics_value is not None
        assert figure.engine_value == pytest.approx(figure.statics_value, rel=0.05)
        assert figure.engine_value + hanging == pytest.approx(values.STABILITY * row.load, rel=0.1)


def test_in_an_engine_it_tips_over_its_side_as_statics_says(file: Path, values: ModuleType) -> None:
    rows = [ChartLoad(n, r, 1000.0 * values.CHART[n][r]) for n, r in ((16.4, 11.0), (23.45, 14.0), (30.5, 20.0))]
    figures = run_tests(file, engine="mujoco", tests=chart_tipping(file, rows, slewed=math.pi / 2))
    for row, figure in zip(rows, figures, strict=True):
        assert figure.engine_value is not None and figure.statics_value is not None
        assert figure.engine_value == pytest.approx(figure.statics_value, rel=0.05)
        assert figure.engine_value > values.STABILITY * row.load


def test_rated_loads_are_hauled_in_at_three_radii(file: Path, values: ModuleType) -> None:
    rows = [ChartLoad(n, r, 1000.0 * load) for n, row in values.RATED.items() for r, load in row.items()]
    figures = run_tests(file, engine="mujoco", tests=chart_tests(file, rows))
    assert len(figures) == 3
    assert all(figure.arrived and figure.statics_value == 1.0 for figure in figures), figures


def test_a_chart_that_is_none_is_told(tmp_path: Path) -> None:
    (tmp_path / "chart.csv").write_text("radius,9.35\n3.5,heavy\n", encoding="utf-8")
    with pytest.raises(YellowironError, match="load chart cannot be read"):
        read_load_chart(tmp_path / "chart.csv")


@pytest.mark.parametrize("order", ["road", "working"])
def test_it_drives_and_turns_as_its_axles_say(made_once: MadeOnce, order: str) -> None:
    """As drawn at work its outriggers stand on the ground: they are raised before it drives."""
    result = drive(built_example("mobile_crane", made_once, order), engine="mujoco")
    in_engines.assert_straight(result)
    assert result.turning_radius == pytest.approx(result.geometry_radius, rel=0.05)
    assert result.turning_radius == pytest.approx(8.5, rel=0.05)  # published
