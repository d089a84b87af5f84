"""The telehandler example in engines: strokes, sections on chains, driving and steering by two wheels or four, what it
lifts and where it tips."""

from __future__ import annotations

import math
from pathlib import Path

import in_engines
import pytest

from kit.builds import MadeOnce
from kit.machines.drawn_examples import built_example, drawn_example, steered_example
from yellowiron.kinematics import measure
from yellowiron.simulation import drive, run_tests, simulate
from yellowiron.simulation.driving.result import DrivingResult, driving_findings
from yellowiron.simulation.registry import import_engine

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def file(made_once: MadeOnce) -> Path:
    return built_example("telehandler", made_once, "two")


@pytest.fixture(scope="module")
def driven(file: Path) -> DrivingResult:
    return drive(file, engine="mujoco")


# The telescope in the other engines is that of three sections, below: in Newton it is all that no other machine has.
@pytest.mark.parametrize(("engine", "actuators"), [("mujoco", None), ("physx", ["steering", "tilt"])])
def test_full_strokes(file: Path, engine: str, actuators: list[str] | None) -> None:
    _strokes(file, engine, actuators)


@pytest.mark.parametrize("engine", ["mujoco", "newton", "physx"])
def test_sections_that_follow_on_chains_go_as_far_as_they_should(made_once: MadeOnce, engine: str) -> None:
    _strokes(built_example("telehandler", made_once, "three"), engine, ["telescope"])


@pytest.mark.parametrize("engine", ["mujoco", "physx"])
def test_it_levels_its_frame_and_stands_on_its_stabilizers(made_once: MadeOnce, engine: str) -> None:
    _strokes(built_example("telehandler", made_once, "three"), engine, ["levelling", "stabilizer_left"])


def _strokes(file: Path, engine: str, actuators: list[str] | None) -> None:
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    result = simulate(file, engine=engine, actuators=actuators)
    assert result.base == "fixed" and result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


def test_it_drives_on_all_wheels_and_steers_with_the_front_ones(driven: DrivingResult) -> None:
    in_engines.assert_straight(driven)
    assert driven.lock is not None and math.radians(43.0) < driven.lock < math.radians(49.0)
    assert driven.turning_radius == pytest.approx(driven.geometry_radius, rel=0.02)
    assert list(driving_findings(driven)) == []


def test_steered_by_all_wheels_it_turns_in_little_more_than_half(driven: DrivingResult, made_once: MadeOnce) -> None:
    machine = steered_example("telehandler", drawn_example("telehandler", made_once, "two"), made_once, "all")
    all_ = drive(machine.usd, engine="mujoco")
    assert driven.turning_radius is not None and all_.turning_radius is not None
    # Its four axes do not meet, steered as two wheels want it: where the middle is then, friction decides.
    assert 0.5 < all_.turning_radius / driven.turning_radius < 0.7
    # Four tyres hold the steering back: it comes to its lock seconds after it was told to, and is measured there.
    assert all_.lock is not None and all_.lock > 1.9 * math.radians(46.0)
    assert list(driving_findings(all_)) == []
    # The sheet's turning radius is another steering mode's.
    radius = next(m for m in measure(machine.mechanism) if m.name == "Turning Radius")
    assert radius.model is not None and radius.spec is None and "steering_mode=front" in radius.reason


def test_it_lifts_its_rated_capacity_and_takes_the_time_that_is_printed(file: Path) -> None:
    figures = {f.test.name: f for f in run_tests(file, engine="mujoco")}
    tipping = figures["Tipping Load at Maximum Reach"]
    assert tipping.engine_value == pytest.approx(tipping.statics_value, rel=0.03)
    assert tipping.engine_value > 1250.0
    assert figures["Rated Capacity Through the Lift"].arrived
    assert figures["Three Times the Rated Capacity"].engine_value == pytest.approx(0.0, abs=0.02)
    for name, printed in (("Boom Lift Time", 9.0), ("Boom Extend Time", 5.54)):
        assert figures[name].statics_value == pytest.approx(printed, rel=0.003), name
        assert figures[name].engine_value == pytest.approx(printed, rel=0.03), name
