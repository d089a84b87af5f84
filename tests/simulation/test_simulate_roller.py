"""The roller example in engines: strokes, driving straight on its drums, and the turn."""

from __future__ import annotations

import math
from pathlib import Path

import in_engines
import pytest

from kit.builds import MadeOnce
from kit.machines.drawn_examples import built_example
from yellowiron.simulation import drive, simulate
from yellowiron.simulation.driving.result import driving_findings
from yellowiron.simulation.driving.wheel import driven_wheels
from yellowiron.simulation.registry import import_engine
from yellowiron.usd import read_mechanism

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module", params=["tandem", "single"])
def file(request: pytest.FixtureRequest, made_once: MadeOnce) -> Path:
    return built_example("roller", made_once, request.param)


# In Newton it bends and drives as the wheel loader does.
@pytest.mark.parametrize(("engine", "actuators"), [("mujoco", None), ("physx", None)])
def test_full_strokes(file: Path, engine: str, actuators: list[str] | None) -> None:
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    result = simulate(file, engine=engine, actuators=actuators)
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


def test_it_drives_on_its_drums_and_bends(file: Path) -> None:
    """The drums roll their 5 m without a slip. In the turn a drum of 2 m scrubs at its ends, which by dry friction
    widens the circle: to less than 12 %."""
    wheels = driven_wheels(read_mechanism(file))
    assert all(w.actuator == "drive" for w in wheels) and len(wheels) in (2, 3)
    result = drive(file, engine="mujoco")
    in_engines.assert_straight(result)
    assert result.lock is not None and result.lock == pytest.approx(math.radians(40.0), rel=0.01)
    # Middles of the front drum (tandem: 4671 mm from the middle of the turn) or of the outer tyre (5616 - 285 mm).
    printed = 4.671 if len(wheels) == 2 else 5.331
    assert result.axes_radius is not None and result.axes_radius == pytest.approx(printed, rel=0.01)
    assert result.turning_radius is not None and result.geometry_radius is not None
    assert 1.0 <= result.turning_radius / result.axes_radius < 1.12
    # What friction along the whole drum leaves, which an engine is held against.
    assert 1.0 < result.geometry_radius / result.axes_radius < 1.12
    told = [f.where for f in driving_findings(result)]
    assert told == ([] if len(wheels) == 2 else ["turning radius"])
